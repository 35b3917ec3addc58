/* SPDX-License-Identifier: BSD-3-Clause */
/* An island is a set of bodies that joints connect, without ground and fixed bodies. Islands
 * interact only through forces, so accelerations and multipliers can be found island by island. */
#ifndef BAUM_I_DYNAMICS_ISLANDS_H
#define BAUM_I_DYNAMICS_ISLANDS_H

#include "mechanism/mechanism.h"

typedef struct baum_i_island {
  int bodies;
  int joints; /* including drivers and user constraints */
  int rows;
} baum_i_island;

/* Count the islands, and describe the one with most bodies. All its numbers are 0 if there is none.
 * Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_count_islands(const baum_mechanism *mechanism, int *count,
                                 baum_i_island *largest);

/* Count the joints of each body in a new array (body_count + 1) that the caller frees. Returns
 * BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_count_joints(const baum_mechanism *mechanism, int **joints);

#endif
