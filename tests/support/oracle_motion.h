/* SPDX-License-Identifier: BSD-3-Clause */
/* Evaluates the joints of the oracle (spatial_oracle.h) along a motion, together with their time
 * derivatives. */
#ifndef BAUM_TEST_ORACLE_MOTION_H
#define BAUM_TEST_ORACLE_MOTION_H

#include "jet.h"
#include "spatial_oracle.h"

/* The position of a body and the columns of its rotation matrix A, each with its time
 * derivatives. */
typedef struct motion {
  jet r[3];
  jet axes[3][3];
} motion;

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

/* Returns which of the six velocities of a spatial body is the k-th velocity of this body. */
int oracle_six_of(const oracle_body *body, int k);

/* Returns the motion of a body at constant velocities. */
motion oracle_motion_of(const oracle_body *body, const wide *q, const wide six[6]);

/* Computes the vector A s. */
void oracle_turned(const motion *m, const wide s[3], jet out[3]);

/* Evaluates a coordinate of a joint. */
jet oracle_coordinate_of(const oracle_joint *joint, int number, const motion *bodies);

/* Evaluates all rows of a joint, and returns how many there are. If flow = 0, the prescribed values
 * of drivers are treated as constant in time. */
int oracle_rows_of(const spatial_oracle *o, const oracle_joint *joint, const motion *bodies,
                   double t, int flow, jet out[ORACLE_ROWS]);

#endif
