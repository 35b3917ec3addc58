/* SPDX-License-Identifier: BSD-3-Clause */
/* A torque acts on a pinned body, without gravity. The torque jumps at three times. Between the
 * jumps the exact motion is a polynomial of degree 2. If no step crosses a jump, methods of order 2
 * and higher reproduce this motion to rounding. Generalized-alpha is an exception, see allowed().
 * Include after cmocka.h. */
#ifndef BAUM_TEST_TORQUE_JUMPS_H
#define BAUM_TEST_TORQUE_JUMPS_H

#include <math.h>
#include <string.h>

#include "step_mode.h"

enum { JUMPS = 3 };

/* The times of the jumps [s]. The first is a multiple of STEP, and the other two are not. The last
 * two are less than a step apart. */
static const double TIMES[JUMPS] = {0.5, 1.2345, 1.2361};
/* [N m] the torque before, between and after the jumps. The moment of inertia about the pin is 1
 * kg m^2. */
static const double TORQUE[JUMPS + 1] = {3.0, -8.0, 50.0, 1.0};
static const double STEP = 0.01;
static const double RTOL = 1e-8;

static inline double torque_at(double t)
{
  int k = 0;
  while (k < JUMPS && t >= TIMES[k]) {
    k++;
  }
  return TORQUE[k];
}

/* The angle and the angular velocity of the body, and the work of the torque. */
typedef struct exact_motion {
  double angle;
  double rate;
  double work;
} exact_motion;

/* Computes the exact motion. It starts at rest at t = 0. For t < 0 the torque has its first
 * value. */
static inline exact_motion exact(double t)
{
  exact_motion out = {0};
  double from = 0.0;
  for (int k = 0; k <= JUMPS && (from < t || k == 0); k++) {
    double to = k < JUMPS ? fmin(TIMES[k], t) : t;
    double h = to - from;
    double change = h * (out.rate + 0.5 * h * TORQUE[k]);
    out.angle += change;
    out.work += change * TORQUE[k];
    out.rate += h * TORQUE[k];
    from = to;
  }
  return out;
}

static inline double error_now(const baum_simulation *run)
{
  exact_motion want = exact(baum_simulation_time(run));
  return fmax(fabs(baum_simulation_q(run)[2] - want.angle),
              fabs(baum_simulation_v(run)[2] - want.rate));
}

/* Returns the largest allowed error. For variable steps, it is ten times rtol, multiplied by the
 * largest angular velocity, 6 rad/s. For Euler methods, it is (h/2) |torque| t, the error of the
 * angle. For generalized-alpha, it is 20 times h^2 times 50 N m, because the acceleration in the
 * first step after a jump has a lower order. For all other methods, it is the rounding error of
 * about 200 steps. */
static inline double allowed(step_mode mode)
{
  if (!mode.fixed) {
    return 10.0 * RTOL * 6.0;
  }
  bool alpha = strcmp(baum_integrator_name(mode.integrator), "generalized_alpha") == 0;
  bool first = baum_integrator_order(mode.integrator) == 1;
  return first ? 0.5 * STEP * 8.0 * 2.0 : (alpha ? STEP * STEP * 50.0 * 20.0 : 1e-12);
}

#endif
