/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions that build a mechanism from parts. After the first failure they add nothing more, and
 * baum_i_parts_finish() returns the status of this failure. */
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

/* Tells which velocities the definition of a body gives. */
typedef enum baum_i_given {
  BAUM_I_GIVE_ALL,
  BAUM_I_GIVE_ROTATION, /* only the angular velocity, which assembly must keep */
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

/* A moving point, with position and velocity in ground axes. */
typedef struct baum_i_mover {
  double r[2];
  double v[2];
} baum_i_mover;

/* Moves the point by the vector (x, y). This vector is given in axes that are at `angle` to the
 * ground axes and rotate with the angular velocity `rate`. */
void baum_i_mover_go(baum_i_mover *mover, double angle, double rate, double x, double y);

/* Returns the state of a body whose centre of mass is this moving point. */
baum_i_body_state baum_i_mover_state(const baum_i_mover *centre, double angle, double rate);

/* Finds an intersection of two circles, one with radius ra about a, the other with radius rb about
 * b. If side is -1, finds the intersection to the right of the line from a to b, otherwise the one
 * to the left. Returns NaN if the circles do not intersect. */
void baum_i_meet(const double a[2], double ra, const double b[2], double rb, double side,
                 double out[2]);

baum_i_parts baum_i_parts_begin(void);
void baum_i_parts_gravity(baum_i_parts *parts, double downwards);
baum_body_id baum_i_parts_particle(baum_i_parts *parts, const baum_planar_particle_def *def);
baum_body_id baum_i_parts_body(baum_i_parts *parts, const baum_planar_body_def *def);
baum_body_id baum_i_parts_body_at(baum_i_parts *parts, const char *name, double mass,
                                  double inertia, baum_i_body_state at, baum_i_given given);
baum_joint_id baum_i_parts_pin(baum_i_parts *parts, const char *name, baum_i_spot a, baum_i_spot b);
/* Adds a pin. It is at (xa, 0) on body a and at (xb, 0) on body b. */
baum_joint_id baum_i_parts_hinge(baum_i_parts *parts, const char *name, baum_body_id a, double xa,
                                 baum_body_id b, double xb);
/* Adds a guide that keeps the centre of mass of a slider on the line y = `height`, which is fixed
 * to the ground. Both points of the guide are shifted by `along` in the direction of this line. */
void baum_i_parts_guide(baum_i_parts *parts, const char *name, baum_body_id slider, double height,
                        double along);
void baum_i_parts_rod(baum_i_parts *parts, const char *name, baum_i_spot a, baum_i_spot b,
                      double length);
/* Adds a driver that moves a joint at a constant rate. */
void baum_i_parts_motor(baum_i_parts *parts, baum_joint_id joint, double value, double rate);
/* Adds a driver that moves a joint by a law. */
void baum_i_parts_law(baum_i_parts *parts, const char *name, baum_joint_id joint, baum_law_fn *law);
/* Adds a constraint on one body. Its name, its number of rows and its functions are those of
 * `def`. */
void baum_i_parts_constraint(baum_i_parts *parts, baum_body_id body, baum_user_constraint_def def);
/* Freezes the mechanism. If this or an earlier call failed, *out is NULL. */
baum_status baum_i_parts_finish(baum_i_parts *parts, baum_mechanism **out);

#endif
