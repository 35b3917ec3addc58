/* SPDX-License-Identifier: BSD-3-Clause */
/* Builds a mechanism from parts. After the first failure nothing more is added, and
 * baum_i_parts_finish() returns that failure. */
#ifndef BAUM_I_CATALOG_PARTS_H
#define BAUM_I_CATALOG_PARTS_H

#include <baum/baum.h>

typedef struct baum_i_parts {
  baum_mechanism *mechanism;
  baum_status status;
} baum_i_parts;

enum { BAUM_I_BODY_WIDTH = 7 }; /* largest number of coordinates of a body */

/* Positions and velocities of a body. */
typedef struct baum_i_body_state {
  double q[BAUM_I_BODY_WIDTH];
  double v[BAUM_I_BODY_WIDTH];
} baum_i_body_state;

/* Velocities that the definition of a body gives. */
typedef enum baum_i_given {
  BAUM_I_GIVE_ALL,
  BAUM_I_GIVE_ROTATION, /* the angular velocity, which is held */
  BAUM_I_GIVE_NONE
} baum_i_given;

/* Makes a call unless an earlier call has failed. */
#define BAUM_I_UNLESS_FAILED(parts, call) \
  ((parts)->status = (parts)->status == BAUM_OK ? (call) : (parts)->status)

/* A point on a body, in the axes of the body. */
typedef struct baum_i_spot {
  baum_body_id body;
  double point[2];
} baum_i_spot;

/* A moving point, in ground axes. */
typedef struct baum_i_mover {
  double r[2];
  double v[2];
} baum_i_mover;

/* Moves by the vector (x, y), given in axes that are at `angle` to the ground and rotate at
 * `rate`. */
void baum_i_mover_go(baum_i_mover *mover, double angle, double rate, double x, double y);

/* Returns the state of a body with this centre of mass. */
baum_i_body_state baum_i_mover_state(const baum_i_mover *centre, double angle, double rate);

/* Finds an intersection of the circles of radius ra about a and rb about b: the one to the left of
 * the line from a to b, or to the right if side is -1. NaN if they do not intersect. */
void baum_i_meet(const double a[2], double ra, const double b[2], double rb, double side,
                 double out[2]);

baum_i_parts baum_i_parts_begin(void);
void baum_i_parts_gravity(baum_i_parts *parts, double downwards);
baum_body_id baum_i_parts_particle(baum_i_parts *parts, const baum_planar_particle_def *def);
baum_body_id baum_i_parts_body(baum_i_parts *parts, const baum_planar_body_def *def);
baum_body_id baum_i_parts_body_at(baum_i_parts *parts, const char *name, double mass,
                                  double inertia, baum_i_body_state at, baum_i_given given);
baum_joint_id baum_i_parts_pin(baum_i_parts *parts, const char *name, baum_i_spot a, baum_i_spot b);
/* A pin at (xa, 0) of body a and (xb, 0) of body b. */
baum_joint_id baum_i_parts_hinge(baum_i_parts *parts, const char *name, baum_body_id a, double xa,
                                 baum_body_id b, double xb);
/* Guides a slider along the line y = height of the ground, through the slider's centre of mass.
 * `along` shifts both points of the guide along this line. */
void baum_i_parts_guide(baum_i_parts *parts, const char *name, baum_body_id slider, double height,
                        double along);
void baum_i_parts_rod(baum_i_parts *parts, const char *name, baum_i_spot a, baum_i_spot b,
                      double length);
/* Adds a driver at a constant rate. */
void baum_i_parts_motor(baum_i_parts *parts, baum_joint_id joint, double value, double rate);
/* Adds the constraint of `def` with its name, row count and functions, on one body. */
void baum_i_parts_constraint(baum_i_parts *parts, baum_body_id body, baum_user_constraint_def def);
/* Freezes the mechanism. On failure *out is NULL. */
baum_status baum_i_parts_finish(baum_i_parts *parts, baum_mechanism **out);

#endif
