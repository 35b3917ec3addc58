/* SPDX-License-Identifier: BSD-3-Clause */
/* Parts of spatial mechanisms. The states of the bodies are computed with axes that are moved from
 * body to body. */
#ifndef BAUM_I_CATALOG_SPATIAL_PARTS_H
#define BAUM_I_CATALOG_SPATIAL_PARTS_H

#include "catalog/parts.h"

/* Moving axes: their position, orientation and velocities. */
typedef struct baum_i_axes {
  double r[3]; /* [m] origin, in ground axes */
  double v[3]; /* [m/s] velocity of the origin, in ground axes */
  double p[4]; /* [-] unit quaternion w, x, y, z, which transforms from these axes to ground axes */
  double w[3]; /* [rad/s] angular velocity, in these axes */
} baum_i_axes;

extern const double baum_i_zeros[3]; /* three zeros: the origin, or no velocity */

/* Returns axes that are parallel to the ground axes. Their origin is a moving point. */
baum_i_axes baum_i_axes_at(const double r[3], const double v[3]);
/* Rotates the axes about one of them (0 is x, 1 is y, 2 is z) by an angle whose rate is `rate`. */
void baum_i_axes_turn(baum_i_axes *axes, int axis, double angle, double rate);
/* Moves the origin of the axes to the point (x, y, z), which is given in these axes and fixed to
 * them. */
void baum_i_axes_go(baum_i_axes *axes, double x, double y, double z);
/* Returns axes whose origin is `origin` and whose x axis points to `end`. Their z axis is
 * perpendicular to the x axis of the ground. */
baum_i_axes baum_i_axes_between(const baum_i_axes *origin, const baum_i_axes *end);
/* Writes the direction of one of the axes (0 is x, 1 is y, 2 is z), in ground axes. */
void baum_i_axes_direction(const baum_i_axes *axes, int axis, double out[3]);
/* Returns the state of the body that has these axes. */
baum_i_body_state baum_i_axes_state(const baum_i_axes *axes);

/* The two bodies of a joint, and its point and its axis in ground axes, in the design
 * configuration. */
typedef struct baum_i_place {
  baum_body_id a;
  baum_body_id b;
  const double *point;
  const double *axis; /* NULL if the joint has no axis */
} baum_i_place;

/* Defines `six_laws`, the laws of six drivers. Each law calls DRIVE with the number of its driver
 * as the first argument. The argument `user` cannot contain this number, because `user` is NULL in
 * the catalogue. */
#define BAUM_I_SIX_LAW(DRIVE, K)                        \
  static int law_##K(double t, double s[3], void *user) \
  {                                                     \
    (void)user;                                         \
    return DRIVE(K, t, s);                              \
  }
#define BAUM_I_SIX_LAWS(DRIVE) \
  BAUM_I_SIX_LAW(DRIVE, 0)     \
  BAUM_I_SIX_LAW(DRIVE, 1)     \
  BAUM_I_SIX_LAW(DRIVE, 2)     \
  BAUM_I_SIX_LAW(DRIVE, 3)     \
  BAUM_I_SIX_LAW(DRIVE, 4)     \
  BAUM_I_SIX_LAW(DRIVE, 5)     \
  static baum_law_fn *const six_laws[6] = {law_0, law_1, law_2, law_3, law_4, law_5};

/* Sets gravity in the direction of -z. */
void baum_i_parts_gravity_z(baum_i_parts *parts, double downwards);
/* Adds a body that has these principal moments of inertia and starts in this state. */
baum_body_id baum_i_parts_spatial_body(baum_i_parts *parts, const char *name, double mass,
                                       const double inertia[3], baum_i_body_state at);
baum_joint_id baum_i_parts_spatial_revolute(baum_i_parts *parts, const char *name,
                                            baum_i_place place);
void baum_i_parts_spherical(baum_i_parts *parts, const char *name, baum_i_place place);
baum_joint_id baum_i_parts_prismatic(baum_i_parts *parts, const char *name, baum_i_place place);
void baum_i_parts_universal(baum_i_parts *parts, const char *name, baum_i_place place,
                            const double axis_b[3]);

#endif
