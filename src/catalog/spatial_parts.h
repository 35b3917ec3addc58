/* SPDX-License-Identifier: BSD-3-Clause */
/* Parts of spatial mechanisms, and axes that are moved from body to body to compute their
 * states. */
#ifndef BAUM_I_CATALOG_SPATIAL_PARTS_H
#define BAUM_I_CATALOG_SPATIAL_PARTS_H

#include "catalog/parts.h"

/* Moving axes. */
typedef struct baum_i_axes {
  double r[3]; /* [m] origin, ground axes */
  double v[3]; /* [m/s] of the origin, ground axes */
  double p[4]; /* [-] unit quaternion w, x, y, z: from these axes to ground axes */
  double w[3]; /* [rad/s] angular velocity, in these axes */
} baum_i_axes;

extern const double baum_i_zeros[3]; /* the origin, or no velocity */

/* Returns axes parallel to the ground's, with their origin at a moving point. */
baum_i_axes baum_i_axes_at(const double r[3], const double v[3]);
/* Rotates about one of these axes (0 x, 1 y, 2 z) by an angle that changes at `rate`. */
void baum_i_axes_turn(baum_i_axes *axes, int axis, double angle, double rate);
/* Moves the origin to the point (x, y, z), which is fixed in these axes. */
void baum_i_axes_go(baum_i_axes *axes, double x, double y, double z);
/* Returns axes at `origin` whose x axis points to `end`, and whose z axis is perpendicular to the
 * ground's x axis. */
baum_i_axes baum_i_axes_between(const baum_i_axes *origin, const baum_i_axes *end);
/* Returns the state of a body with these axes. */
baum_i_body_state baum_i_axes_state(const baum_i_axes *axes);

/* The bodies of a joint, and its point and axis in ground axes in the design configuration. */
typedef struct baum_i_place {
  baum_body_id a;
  baum_body_id b;
  const double *point;
  const double *axis; /* NULL: the joint has none */
} baum_i_place;

/* Gravity along -z. */
void baum_i_parts_gravity_z(baum_i_parts *parts, double downwards);
/* Adds a body with these principal moments of inertia and this state. */
baum_body_id baum_i_parts_spatial_body(baum_i_parts *parts, const char *name, double mass,
                                       const double inertia[3], baum_i_body_state at);
baum_joint_id baum_i_parts_spatial_revolute(baum_i_parts *parts, const char *name,
                                            baum_i_place place);
void baum_i_parts_spherical(baum_i_parts *parts, const char *name, baum_i_place place);
void baum_i_parts_prismatic(baum_i_parts *parts, const char *name, baum_i_place place);
void baum_i_parts_universal(baum_i_parts *parts, const char *name, baum_i_place place,
                            const double axis_b[3]);

#endif
