/* SPDX-License-Identifier: BSD-3-Clause */
/* Fixed steps that are too long for a motion are warned of, once, with a step that will do. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "models.h"

static const double SPAN = 2.0; /* [s], a swing of A01 */

/* Warnings that say "is too long"; the step that the last of them advises. */
static int64_t count_warnings(const baum_integrator *integrator, double step, double *advised)
{
  model m;
  baum_simulation *run = NULL;
  baum_simulation_options o = baum_simulation_options_default();
  baum_counters c;
  int64_t found = 0;
  o.integrator = integrator;
  o.step = step;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  assert_int_equal(baum_simulation_create(m.mechanism, &o, &run), BAUM_OK);
  assert_true(baum_simulation_advance_to(run, SPAN) >= BAUM_OK);
  assert_int_equal(baum_simulation_counters(run, &c, sizeof c), BAUM_OK);
  for (int64_t k = 0; k < c.warnings; k++) {
    baum_warning warning;
    assert_int_equal(baum_simulation_warning(run, k, &warning, sizeof warning), BAUM_OK);
    const char *advice = strstr(warning.text, "take a step below ");
    if (warning.code == BAUM_WARNING_ACCURACY && advice) {
      assert_int_equal(sscanf(advice, "take a step below %lf s", advised), 1);
      found++;
    }
  }
  baum_simulation_destroy(run);
  model_destroy(&m);
  return found;
}

/* Half a radian a step is too long for low orders and good for order 4 and more. */
static void steps_are_judged_by_the_order(void **state)
{
  (void)state;
  double advised = 0.0;
  assert_int_equal(count_warnings(baum_euler(), 0.1, &advised), 1);
  assert_int_equal(count_warnings(baum_semi_implicit_euler(), 0.1, &advised), 1);
  assert_int_equal(count_warnings(baum_rk4(), 0.1, &advised), 0);
  assert_int_equal(count_warnings(baum_rk8(), 0.1, &advised), 0);
  assert_int_equal(count_warnings(baum_rk4(), 0.4, &advised), 1);
}

static void the_advised_step_is_not_too_long(void **state)
{
  (void)state;
  const baum_integrator *const methods[] = {baum_euler(), baum_semi_implicit_euler(), baum_rk2()};
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    double advised = 0.0;
    double again = 0.0;
    assert_int_equal(count_warnings(methods[k], 0.2, &advised), 1);
    assert_true(advised > 0.0 && advised < 0.2);
    /* The advice came early in the run and is for the way until there. */
    assert_int_equal(count_warnings(methods[k], advised / 10.0, &again), 0);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(steps_are_judged_by_the_order),
    cmocka_unit_test(the_advised_step_is_not_too_long),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
