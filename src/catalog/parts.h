/* SPDX-License-Identifier: BSD-3-Clause */
/* Putting a mechanism together: after the first failure nothing more happens, and
 * baum_i_parts_finish() tells. */
#ifndef BAUM_I_CATALOG_PARTS_H
#define BAUM_I_CATALOG_PARTS_H

#include <baum/baum.h>

typedef struct baum_i_parts {
  baum_mechanism *mechanism;
  baum_status status;
} baum_i_parts;

/* A point on a body, in its axes. */
typedef struct baum_i_spot {
  baum_body_id body;
  double point[2];
} baum_i_spot;

/* A point that moves, in ground axes. */
typedef struct baum_i_mover {
  double r[2];
  double v[2];
} baum_i_mover;

/* Go on to the point (x, y) in axes that stand at an angle and turn at a rate. */
void baum_i_mover_go(baum_i_mover *mover, double angle, double rate, double x, double y);

/* The three positions and velocities of a body whose centre of mass is there. */
void baum_i_mover_state(const baum_i_mover *centre, double angle, double rate, double q[3],
                        double v[3]);

/* Where circles of radii ra about a and rb about b meet, to the left of the way from a to b, or to
 * the right where side is
 * -1; NaN where they do not. */
void baum_i_meet(const double a[2], double ra, const double b[2], double rb, double side,
                 double out[2]);

baum_i_parts baum_i_parts_begin(void);
void baum_i_parts_gravity(baum_i_parts *parts, double downwards);
baum_body_id baum_i_parts_particle(baum_i_parts *parts, const baum_planar_particle_def *def);
/* q and v (3) in the place of the definition's; NULL: those of the definition. */
baum_body_id baum_i_parts_body(baum_i_parts *parts, const baum_planar_body_def *def,
                               const double *q, const double *v);
baum_body_id baum_i_parts_coordinates(baum_i_parts *parts, const baum_coordinates_def *def);
baum_joint_id baum_i_parts_pin(baum_i_parts *parts, const char *name, baum_i_spot a, baum_i_spot b);
/* A pin at (xa, 0) of body a and (xb, 0) of body b. */
baum_joint_id baum_i_parts_hinge(baum_i_parts *parts, const char *name, baum_body_id a, double xa,
                                 baum_body_id b, double xb);
/* A slider on the line y = height of the ground through its centre of mass; `along` moves both
 * points of the guide along it. */
void baum_i_parts_guide(baum_i_parts *parts, const char *name, baum_body_id slider, double height,
                        double along);
void baum_i_parts_rod(baum_i_parts *parts, const char *name, baum_i_spot a, baum_i_spot b,
                      double length);
void baum_i_parts_driver(baum_i_parts *parts, const baum_driver_def *def);
void baum_i_parts_constraint(baum_i_parts *parts, const baum_user_constraint_def *def);
void baum_i_parts_spring(baum_i_parts *parts, const baum_planar_spring_def *def);
void baum_i_parts_load(baum_i_parts *parts, const baum_planar_load_def *def);
/* Freeze; on failure there is no mechanism. */
baum_status baum_i_parts_finish(baum_i_parts *parts, baum_mechanism **out);

#endif
