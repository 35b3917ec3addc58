/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the slider-crank of SUNDIALS' idaSlCrank_dns with the catalogue's reference, which has
 * 20 digits. The mechanism is built of two bodies. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "catalog/data/slider_crank_sundials.h"
#include "reference_test.h"

static const reference SIX = {.name = "SUNDIALS slider-crank",
                              .samples = SUNDIALS_SLIDER_CRANK_SAMPLES,
                              .width = 6,
                              .t = SUNDIALS_SLIDER_CRANK_T,
                              .entry = "slider_crank_sundials",
                              .lengths = "mmrmmr"};

static void adams_reaches_the_reference_within_1e_8(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_sundials_slider_crank(&m), BAUM_OK);
  baum_simulation_options options = adams_options();
  assert_reached(&SIX, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

static void rk4_with_projection_reaches_the_reference(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_sundials_slider_crank(&m), BAUM_OK);
  /* The angular velocities w are about 1 rad/s. The error is therefore about (w h)^4 / 5! =
   * 2e-12. */
  assert_reached_by_rk4(&SIX, m.mechanism, 1.0 / 256, 1e-10);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(adams_reaches_the_reference_within_1e_8),
    cmocka_unit_test(rk4_with_projection_reaches_the_reference),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
