/* SPDX-License-Identifier: BSD-3-Clause */
/* The pendulum A01 is released level with its pivot and swings for 2000 s, which are 845 periods.
 * Its motion is known in closed form:
 *
 *   sin(angle / 2) = k sn(w t + K),   k^2 = 1/2,   w^2 = g / L,   x = -sin angle,   y = -cos angle
 *
 * K is the complete elliptic integral of the first kind, and L is the length. The angle is measured
 * from the lowest point. The function sn is computed in long double by the arithmetic-geometric
 * mean (M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, 1964, 16.4).
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#include "a01_pendulum_reference.h"
#include "assert_near.h"
#include "models.h"
#include "runs.h"

enum { MEANS = 8, ROWS = 5 };

static const double TIMES[ROWS] = {10.0, 100.0, 500.0, 1000.0, 2000.0};

static void closed_form(double t, double q[2])
{
  const long double half_pi = acosl(0.0L);
  long double a[MEANS + 1] = {1.0L};
  long double b[MEANS + 1] = {sqrtl(0.5L)};
  long double c[MEANS + 1] = {sqrtl(0.5L)};
  for (int k = 0; k < MEANS; k++) {
    a[k + 1] = (a[k] + b[k]) / 2;
    b[k + 1] = sqrtl(a[k] * b[k]);
    c[k + 1] = (a[k] - b[k]) / 2;
  }
  long double quarter = half_pi / a[MEANS];
  long double u = fmodl(sqrtl(9.81L) * (long double)t + quarter, 4 * quarter);
  long double phi = ldexpl(a[MEANS] * u, MEANS);
  for (int k = MEANS; k > 0; k--) {
    phi = (phi + asinl(c[k] / a[k] * sinl(phi))) / 2;
  }
  long double angle = 2 * asinl(sqrtl(0.5L) * sinl(phi));
  q[0] = (double)-sinl(angle);
  q[1] = (double)-cosl(angle);
}

static void the_closed_form_agrees_with_the_table(void **state)
{
  (void)state;
  for (int k = 0; k < A01_PENDULUM_SAMPLES; k++) {
    double q[2];
    closed_form(A01_PENDULUM_T[k], q);
    for (int i = 0; i < 2; i++) {
      /* The table has 17 digits. It uses g = 9.81 exactly, and the mechanism uses the nearest
       * double. */
      ASSERT_NEAR(q[i], A01_PENDULUM_Q[k][i], 0.0, 1e-14);
    }
  }
}

/* Prints how the error grows, and returns the last error. If the period has a constant relative
 * error, the error grows like t. If the energy drifts, it grows like t^2. */
static double follow(const model *m, const baum_simulation_options *o)
{
  double error = 0.0;
  double first = 0.0;
  baum_simulation *run = create_run(m->mechanism, o);
  printf("%s, rtol %.0e:", baum_integrator_name(o->integrator), o->rtol);
  for (int k = 0; k < ROWS; k++) {
    double q[2];
    assert_int_equal(baum_simulation_advance_to(run, TIMES[k]), BAUM_OK);
    closed_form(TIMES[k], q);
    const double *x = baum_simulation_q(run);
    error = hypot(x[0] - q[0], x[1] - q[1]);
    first = k == 1 ? error : first;
    printf("  %g s %.1e", TIMES[k], error);
  }
  printf("  like t^%.1f from 100 s on\n", log(error / first) / log(TIMES[ROWS - 1] / TIMES[1]));
  baum_simulation_destroy(run);
  return error;
}

static void the_error_of_a_pendulum_stays_small_for_2000_s(void **state)
{
  (void)state;
  model m;
  baum_simulation_options o = baum_simulation_options_default();
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  o.integrator = baum_rk8();
  o.rtol = 1e-13;
  /* The limit is a hundred times the measured error, because rounding may be different on other
   * processors. */
  assert_true(follow(&m, &o) <= 1e-6);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_closed_form_agrees_with_the_table),
    cmocka_unit_test(the_error_of_a_pendulum_stays_small_for_2000_s),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
