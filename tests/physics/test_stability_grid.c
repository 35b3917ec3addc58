/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the predicted stability with the stability of runs, for a pendulum. Also tests the
 * Taylor gains. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "stability_grid.h"

#define DEFINE(integrator) DEFINE_GRID(integrator, PENDULUM)
EVERY_INTEGRATOR(DEFINE)

enum { TAYLOR_STEPS = 400 };

/* With the Taylor gains, both factors z by which the modes change in a step satisfy z^2 = -1.
 * Violations must therefore repeat with Phi(n + 2) = -Phi(n), where n counts steps. Because Phi' =
 * 0 at the start, Phi(1) = Phi(0). */
static void watch_circle(physics_mechanism which)
{
  model m = build_mechanism(which);
  checked_run consistent = start_consistent(&m);
  checked_run checked = start(&m, &consistent, baum_euler(), step_of(which), baum_gains_taylor());
  double phi[TAYLOR_STEPS + 1][PHYSICS_NC] = {{0.0}};
  double worst = 0.0;
  for (int n = 0; n <= TAYLOR_STEPS; n++) {
    evaluate_phi(&checked, phi[n]);
    check(baum_simulation_step(checked.run, 1));
  }
  for (int n = 2; n <= TAYLOR_STEPS; n++) {
    for (int i = 0; i < checked.nc; i++) {
      assert_true(phi[n][i] * phi[n - 2][i] < 0.0);
      worst = fmax(worst, fabs(phi[n][i] + phi[n - 2][i]) / fabs(phi[0][i]));
    }
  }
  printf("taylor, %s: row 0 over 8 steps:", mechanism_name(which));
  for (int n = 0; n < 8; n++) {
    printf(" %+.2e", phi[n][0]);
  }
  printf("; largest |Phi(n) + Phi(n - 2)| / |Phi(0)| of %d rows in %d steps %.1e\n", checked.nc,
         TAYLOR_STEPS, worst);
  /* Relative to the characteristic length, the initial violations are at least 1e-7. In each step,
   * the motion adds h^2 |gamma|, which is about 1e-10. */
  assert_true(worst < 1e-2);
  destroy_checked_run(&checked);
  destroy_checked_run(&consistent);
  model_destroy(&m);
}

static void with_taylor_gains_violations_repeat_every_four_steps(void **state)
{
  (void)state;
  watch_circle(PENDULUM);
  watch_circle(FREE_CRANK);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    EVERY_INTEGRATOR(LIST_GRID)
      cmocka_unit_test(with_taylor_gains_violations_repeat_every_four_steps),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
