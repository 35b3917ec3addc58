/* SPDX-License-Identifier: BSD-3-Clause */
/* Motions of two bodies, along which derivatives are computed. */
#ifndef BAUM_I_MECHANISM_SPATIAL_SPATIAL_MOTION_H
#define BAUM_I_MECHANISM_SPATIAL_SPATIAL_MOTION_H

#include <string.h>

#include "mechanism/spatial/spatial.h"

/* The velocities of the origins and the angular velocities of body_a and body_b, in ground axes. */
typedef struct baum_i_spatial_motion {
  double v[2][3];
  double w[2][3];
} baum_i_spatial_motion;

/* Returns the motion of two frames. */
static inline baum_i_spatial_motion baum_i_spatial_motion_at(const baum_i_spatial_frame *a,
                                                             const baum_i_spatial_frame *b)
{
  baum_i_spatial_motion out;
  memcpy(out.v[0], a->v, sizeof out.v[0]);
  memcpy(out.v[1], b->v, sizeof out.v[1]);
  memcpy(out.w[0], a->w, sizeof out.w[0]);
  memcpy(out.w[1], b->w, sizeof out.w[1]);
  return out;
}

/* Returns the motion whose velocities are `twelve`. In this array, angular velocities are in body
 * axes. */
static inline baum_i_spatial_motion baum_i_spatial_motion_of(
  const baum_i_spatial_frame *a, const baum_i_spatial_frame *b,
  const double twelve[BAUM_I_PAIR_COLUMNS])
{
  baum_i_spatial_motion out;
  memcpy(out.v[0], twelve, sizeof out.v[0]);
  memcpy(out.v[1], twelve + 6, sizeof out.v[1]);
  baum_i_turn(a->axes, twelve + 3, out.w[0]);
  baum_i_turn(b->axes, twelve + 9, out.w[1]);
  return out;
}

/* Returns the motion in which the velocity of one column is 1 and all others are 0. */
static inline baum_i_spatial_motion baum_i_spatial_unit_motion(const baum_i_spatial_frame *a,
                                                               const baum_i_spatial_frame *b,
                                                               int column)
{
  double twelve[BAUM_I_PAIR_COLUMNS] = {0.0};
  twelve[column] = 1.0;
  return baum_i_spatial_motion_of(a, b, twelve);
}

#endif
