/* SPDX-License-Identifier: BSD-3-Clause */
/* Evaluates the joints of the oracle (spatial_oracle.h) along a motion, together with their time
 * derivatives. */
#ifndef BAUM_TEST_ORACLE_MOTION_H
#define BAUM_TEST_ORACLE_MOTION_H

#include "jet.h"
#include "spatial_oracle.h"

/* The position of a body and the columns of its rotation matrix A, each with its time derivatives,
 * and the six velocities of the body. */
typedef struct motion {
  jet r[3];
  jet axes[3][3];
  wide six[6];
} motion;

/* The motions of all bodies at constant velocities. */
typedef struct instant {
  const spatial_oracle *o;
  double t;
  const wide *q;
  motion bodies[ORACLE_BODIES];
} instant;

static inline wide dot3(const wide a[3], const wide b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross3(const wide a[3], const wide b[3], wide out[3])
{
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3;
    int k = (i + 2) % 3;
    out[i] = a[j] * b[k] - a[k] * b[j];
  }
}

/* Every body of the oracle has six velocities, as a spatial body has. Returns which of the six is
 * the k-th velocity that the library gives this body. */
int oracle_six_of(const oracle_body *body, int k);

/* Returns the motion of a body at constant velocities. */
motion oracle_motion_of(const oracle_body *body, const wide *q, const wide six[6]);

/* Computes the vector A s. */
void oracle_turned(const motion *m, const wide s[3], jet out[3]);

/* Writes the velocities or accelerations v of all bodies as six numbers for each body. */
void oracle_spread(const spatial_oracle *o, const double *v, wide six[][6]);
instant oracle_instant_at(const spatial_oracle *o, double t, const wide *q, const double *v);
/* Computes the motions of all bodies at rest in the design configuration. */
void oracle_design_motions(const spatial_oracle *o, motion bodies[ORACLE_BODIES]);
/* Returns the same configuration without velocities. */
instant oracle_stop(const instant *now);
/* Replaces the velocities of one body. */
void oracle_set_velocities(instant *now, int body, const wide six[6]);

/* Computes cosine and sine. */
void oracle_turn(wide angle, wide *cosine, wide *sine);

/* The vectors of a joint during a motion. */
typedef struct moving {
  jet e[3]; /* the vector from body_a's point to body_b's point */
  jet axes[2][3][3];
} moving;

moving oracle_moving_of(const oracle_joint *joint, const motion *bodies);

/* Computes the angular velocity of a body in ground axes. Only its value and its first derivative
 * are known. */
void oracle_angular_velocity(const motion *m, jet out[3]);

/* Evaluates a coordinate of a joint. */
jet oracle_coordinate_of(const oracle_joint *joint, int number, const motion *bodies);

/* Evaluates all rows of a joint, and returns how many there are. If flow = 0, the prescribed values
 * of drivers are treated as constant in time, and the prescribed velocities of user constraints as
 * zero. The value of a row of velocity level is 0. Its first two derivatives are J v - nu and the
 * derivative of J v - nu. */
int oracle_rows_of(const spatial_oracle *o, const oracle_joint *joint, const motion *bodies,
                   double t, int flow, jet out[ORACLE_ROWS]);

/* Returns whether a row of a joint is of velocity level. */
bool oracle_is_velocity_row(const oracle_joint *joint, int row);

/* Lists the bodies of a joint in the order of the library, and returns how many there are. Ground
 * is listed only for joints between two bodies. */
int oracle_members_of(const spatial_oracle *o, const oracle_joint *joint,
                      int members[ORACLE_MEMBERS]);

/* Returns the joint itself. For a driver, returns the driven joint. */
const oracle_joint *oracle_pair_of(const spatial_oracle *o, const oracle_joint *joint);

/* Computes the vector from the origin of body_b to the point at which the reaction of the joint
 * acts on body_b. */
void oracle_reaction_arm(const oracle_joint *joint, const motion *bodies, wide arm[3]);

/* These functions are in oracle_contact.c. The first four evaluate the rows of a rolling disc, of
 * knife edges, of a point on a curve and of a user constraint. The last one computes the point of
 * contact in ground axes, or the point of the blade. */
int oracle_disc_rows(const oracle_joint *joint, const motion *bodies, jet *out);
int oracle_edge_rows(const oracle_joint *joint, const motion *bodies, jet *out);
int oracle_curve_rows(const oracle_joint *joint, const motion *bodies, jet *out);
int oracle_user_rows(const spatial_oracle *o, const oracle_joint *joint, const motion *bodies,
                     double t, int flow, jet *out);
void oracle_contact_point(const oracle_joint *joint, const motion *bodies, jet out[3]);
/* Returns whether a joint is a planar or a spatial knife edge. */
bool oracle_is_edge(const oracle_joint *joint);

/* Computes the six generalized forces on every body: gravity, gyroscopic moments and the forces of
 * all elements. */
void oracle_forces_at(const instant *now, wide six[][6]);
/* Adds a force at a point, and a moment, to the six generalized forces of a body. All arguments are
 * in ground axes. */
void oracle_add_wrench(const motion *body, const wide point[3], const wide force[3],
                       const wide moment[3], wide six[6]);
/* Multiplies a vector by the inertia tensor of a body. */
void oracle_inertia_times(const oracle_body *body, const wide x[3], wide out[3]);

#endif
