/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the control of the step size. The tests compare its formulas with values that were computed
 * by hand, and check its bounds and the steps that it chooses for a known error. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "integrate/step_control.h"

static baum_i_step_control begin_control(void)
{
  baum_i_step_control control;
  baum_i_step_control_begin(&control, 5, 0.1);
  assert_true(control.step == 0.1 && !control.refused);
  return control;
}

static void after_the_first_step_only_its_error_counts(void **state)
{
  (void)state;
  baum_i_step_control control = begin_control();
  baum_i_step_control_accept(&control, 0.1, 1.0 / 32.0);
  ASSERT_NEAR(control.step, 0.1 * 0.85 * 2.0, 1e-15, 0.0);
}

/* Two successive steps of the same length have the same error, 1/32. The formula that uses the
 * previous error gives a slightly shorter step than the formula that uses only the last error. */
static void a_constant_error_shortens_the_step_slightly(void **state)
{
  (void)state;
  baum_i_step_control control = begin_control();
  baum_i_step_control_accept(&control, 0.1, 1.0 / 32.0);
  baum_i_step_control_accept(&control, 0.1, 1.0 / 32.0);
  double b = 0.1 / 5.0;
  ASSERT_NEAR(control.step, 0.1 * 0.85 * pow(1.0 / 32.0, 1.75 * b - 0.2), 1e-15, 0.0);
}

/* From one step to the next, the error grows fourfold. The control expects that it will grow in the
 * same way again, and chooses a shorter step. */
static void the_growth_of_the_error_is_extrapolated(void **state)
{
  (void)state;
  baum_i_step_control control = begin_control();
  baum_i_step_control_accept(&control, 0.1, 0.125);
  baum_i_step_control_accept(&control, 0.1, 0.5);
  ASSERT_NEAR(control.step, 0.1 * 0.85 * pow(0.5 * 4.0, -0.2), 1e-15, 0.0);
}

static void steps_change_within_bounds(void **state)
{
  (void)state;
  baum_i_step_control control = begin_control();
  baum_i_step_control_accept(&control, 0.1, 0.0);
  ASSERT_NEAR(control.step, 0.6, 1e-15, 0.0);
  baum_i_step_control_refuse(&control, 0.6, 1e300);
  ASSERT_NEAR(control.step, 0.12, 1e-15, 0.0);
  baum_i_step_control_refuse(&control, 0.12, 1.0000001);
  ASSERT_NEAR(control.step, 0.12 * 0.85, 1e-7, 0.0);
  baum_i_step_control_refuse(&control, 0.1, (double)NAN);
  ASSERT_NEAR(control.step, 0.05, 1e-15, 0.0);
}

static void after_a_refusal_steps_do_not_grow_at_once(void **state)
{
  (void)state;
  baum_i_step_control control = begin_control();
  baum_i_step_control_refuse(&control, 0.1, 3.0);
  baum_i_step_control_accept(&control, 0.05, 1e-6);
  assert_true(control.step == 0.05);
  baum_i_step_control_accept(&control, 0.05, 1e-6);
  assert_true(control.step > 0.1);
}

/* The error is c(t) h^5, where c changes by a factor of a hundred. At most one step in twenty may
 * be refused. At least half of the steps must have an error above a tenth of the tolerance.
 * Otherwise the steps would be too short. */
static void a_varying_error_is_followed(void **state)
{
  (void)state;
  baum_i_step_control control = begin_control();
  int taken = 0;
  int refused = 0;
  int used = 0;
  for (double t = 0.0; t < 100.0;) {
    double h = control.step;
    double error = exp(2.3 * sin(t)) * pow(10.0 * h, 5.0);
    if (error > 1.0) {
      baum_i_step_control_refuse(&control, h, error);
      refused++;
      continue;
    }
    baum_i_step_control_accept(&control, h, error);
    t += h;
    taken++;
    used += error > 0.1 ? 1 : 0;
  }
  assert_true(20 * refused <= taken);
  assert_true(2 * used >= taken);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(after_the_first_step_only_its_error_counts),
    cmocka_unit_test(a_constant_error_shortens_the_step_slightly),
    cmocka_unit_test(the_growth_of_the_error_is_extrapolated),
    cmocka_unit_test(steps_change_within_bounds),
    cmocka_unit_test(after_a_refusal_steps_do_not_grow_at_once),
    cmocka_unit_test(a_varying_error_is_followed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
