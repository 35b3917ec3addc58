/* SPDX-License-Identifier: BSD-3-Clause */
/* A body on a pin without gravity, from rest at 0, turned by a torque that jumps at three times. Its motion is known:
 * polynomials of degree 2 in time, which every method of order 2 follows to rounding if it keeps to one side of a jump.
 * Include after cmocka.h.
 */
#ifndef BAUM_TEST_TORQUE_JUMPS_H
#define BAUM_TEST_TORQUE_JUMPS_H

#include "step_mode.h"

enum { JUMPS = 3 };

/* One on the grid of STEP, two off it; the last two nearer to each other than a step. */
static const double TIMES[JUMPS] = {0.5, 1.2345, 1.2361};
static const double TORQUE[JUMPS + 1] = {3.0, -8.0, 50.0, 1.0}; /* [N m]; inertia 1 kg m^2 */
static const double STEP = 0.01;
static const double RTOL = 1e-8;

/* At a jump it has the value of afterwards. */
static inline double torque_at(double t)
{
  int k = 0;
  while (k < JUMPS && t >= TIMES[k]) {
    k++;
  }
  return TORQUE[k];
}

typedef struct turned {
  double angle;
  double rate;
  double work; /* of the torque */
} turned;

/* Before 0 the torque is the first. */
static inline turned exact_at(double t)
{
  turned out = {0.0, 0.0, 0.0};
  double from = 0.0;
  for (int k = 0; k <= JUMPS && (from < t || k == 0); k++) {
    double h = (k < JUMPS ? fmin(TIMES[k], t) : t) - from;
    double change = h * (out.rate + 0.5 * h * TORQUE[k]);
    out.angle += change;
    out.work += change * TORQUE[k];
    out.rate += h * TORQUE[k];
    from += h;
  }
  return out;
}

static inline double error_now(const baum_simulation *run)
{
  turned want = exact_at(baum_simulation_time(run));
  return fmax(fabs(baum_simulation_q(run)[2] - want.angle),
              fabs(baum_simulation_v(run)[2] - want.rate));
}

/* Fixed steps of order 2 and higher: rounding of about 200 steps. Eulers have their error of (h/2) |torque| t in the
 * angle. Steps of their own: ten tolerances of rates up to 6 rad/s. */
static inline double allowed(step_mode mode)
{
  if (!mode.fixed) {
    return 10.0 * RTOL * 6.0;
  }
  bool first = baum_integrator_order(mode.integrator) == 1;
  return first ? 0.5 * STEP * 8.0 * 2.0 : 1e-12;
}

/* Works are off by these errors, by torques up to 50 N m and rates up to 6 rad/s. */
static inline double allowed_work(step_mode mode)
{
  return (50.0 + 6.0) * allowed(mode);
}

static inline baum_counters counters_of(baum_simulation *run)
{
  baum_counters counters;
  assert_int_equal(baum_simulation_counters(run, &counters, sizeof counters), BAUM_OK);
  return counters;
}

#endif
