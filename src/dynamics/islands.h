/* SPDX-License-Identifier: BSD-3-Clause */
/* An island is a set of bodies that are connected by joints. Ground and fixed bodies do not belong
 * to any island. Islands influence each other only through forces. Accelerations and multipliers
 * can therefore be computed for each island separately. */
#ifndef BAUM_I_DYNAMICS_ISLANDS_H
#define BAUM_I_DYNAMICS_ISLANDS_H

#include "mechanism/mechanism.h"

typedef struct baum_i_island {
  int bodies;
  int joints; /* includes drivers and user constraints */
  int rows;
} baum_i_island;

/* Count the islands, and describe the island with the most bodies in *largest. If there are no
 * islands, all numbers in *largest are 0. Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_count_islands(const baum_mechanism *mechanism, int *count,
                                 baum_i_island *largest);

/* Number the islands. *island receives a new array (body_count + 1), which the caller frees. Entry
 * k is the number of the island to which body k belongs. The ground (entry 0) and every fixed body
 * belong to no island; each gets a number that no other body has. Returns BAUM_OK or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_number_islands(const baum_mechanism *mechanism, int **island);

/* Return the number of the island that a joint belongs to. If the joint connects only fixed bodies,
 * return 0, the number of the ground. */
int baum_i_island_of_joint(const baum_mechanism *mechanism, const int *island,
                           const baum_i_joint *joint);

/* Count the joints of each body. *joints receives a new array (body_count + 1), which the caller
 * frees. Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_count_joints(const baum_mechanism *mechanism, int **joints);

#endif
