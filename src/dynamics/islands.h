/* SPDX-License-Identifier: BSD-3-Clause */
/* Islands: bodies that joints hold together, ground left out. What happens in one does not reach
 * another but through forces: accelerations and multipliers are found one island at a time. */
#ifndef BAUM_I_DYNAMICS_ISLANDS_H
#define BAUM_I_DYNAMICS_ISLANDS_H

#include "dynamics/dynamics.h"

typedef struct baum_i_island {
  int bodies;
  int joints; /* drivers and user constraints are joints too */
  int rows;
  int velocities;
  int
    degrees_of_freedom; /* -1: unknown, as redundant rows could not be told from contradicting ones */
  bool moved;           /* some row depends on time */
  bool immobile;        /* no freedom, and nothing that moves it */
} baum_i_island;

typedef struct baum_i_islands {
  int count;
  baum_i_island *island; /* (count) in the order of their first bodies */
  int *of_body;          /* (body_count + 1), ground first; -1: ground and what is one with it */
  int *of_joint;         /* (joint_count); -1: a joint within what is one with ground */
  bool *immobile;        /* (body_count + 1) bodies that can never move */
  int immobile_count;    /* without ground */
} baum_i_islands;

/* From the graph of joints and the workspace's redundancy. BAUM_OK or BAUM_ERR_MEMORY; then *out is
 * empty. */
baum_status baum_i_find_islands(const baum_workspace *workspace, baum_i_islands *out);
void baum_i_islands_clear(baum_i_islands *islands); /* a zeroed one is fine */

#endif
