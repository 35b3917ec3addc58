/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares a crank-rocker four-bar under gravity with the catalogue's reference, which has 15
 * digits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "catalog/data/four_bar.h"
#include "reference_test.h"

static const reference NINE = {.name = "four-bar",
                               .samples = FOUR_BAR_SAMPLES,
                               .width = 9,
                               .t = FOUR_BAR_T,
                               .entry = "four_bar",
                               .lengths = "mmrmmrmmr"};

static void adams_reaches_the_reference_within_1e_8(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  baum_simulation_options options = adams_options();
  assert_reached(&NINE, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

static void ida_with_ggl_reaches_the_reference_within_1e_6(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  baum_simulation_options options = ggl_options();
  assert_reached(&NINE, m.mechanism, &options, 1e-6);
  model_destroy(&m);
}

/* Only 1e-9 is required, because an initial error grows by a factor of 1e4 in these 5 s. */
static void adams_reaches_the_reference_within_1e_9_at_tight_tolerances(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  baum_simulation_options options = adams_options();
  options.rtol = 1e-14;
  reference_run run = reference_compare(&NINE, m.mechanism, &options);
  printf("\nfour-bar: cvode_adams, rtol 1e-14: error %.2e, steps %lld %s\n", run.error,
         (long long)run.counters.steps, run.message);
  assert_true(run.error <= 1e-9);
  model_destroy(&m);
}

static void rk4_with_projection_reaches_the_reference(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  /* The angular velocities w reach 9 rad/s. The error is about (w h)^4 = 1.5e-12, multiplied by the
   * angle, which is at most 9 rad/s x 5 s. */
  assert_reached_by_rk4(&NINE, m.mechanism, 1.0 / 8192, 1e-10);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(adams_reaches_the_reference_within_1e_8),
    cmocka_unit_test(adams_reaches_the_reference_within_1e_9_at_tight_tolerances),
    cmocka_unit_test(ida_with_ggl_reaches_the_reference_within_1e_6),
    cmocka_unit_test(rk4_with_projection_reaches_the_reference),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
