/* SPDX-License-Identifier: BSD-3-Clause */
/* Islands: bodies that joints hold together, ground and fixed bodies left out. What happens in one
 * does not reach another but through forces: accelerations and multipliers are found one island at
 * a time. */
#ifndef BAUM_I_DYNAMICS_ISLANDS_H
#define BAUM_I_DYNAMICS_ISLANDS_H

#include "mechanism/mechanism.h"

typedef struct baum_i_island {
  int bodies;
  int joints; /* drivers and user constraints are joints too */
  int rows;
} baum_i_island;

/* How many there are, and the first with most bodies (zeros: there is none). BAUM_OK or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_count_islands(const baum_mechanism *mechanism, int *count,
                                 baum_i_island *largest);

/* How many joints each body has (body_count + 1), in memory for the caller to free. BAUM_OK or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_count_joints(const baum_mechanism *mechanism, int **joints);

#endif
