/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares a chain of three rods with the catalogue's reference, which has 17 digits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "catalog/data/chain.h"
#include "reference_test.h"

static const reference NINE = {.name = "chain N = 3",
                               .samples = CHAIN_SAMPLES,
                               .width = 9,
                               .t = CHAIN_T,
                               .entry = "chain_3",
                               .lengths = "mmrmmrmmr"};

static void adams_reaches_the_reference_within_1e_9(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_chain_3(&m), BAUM_OK);
  baum_simulation_options options = adams_options();
  assert_reached(&NINE, m.mechanism, &options, 1e-9);
  model_destroy(&m);
}

static void rk4_with_projection_reaches_the_reference(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_chain_3(&m), BAUM_OK);
  /* The angular velocities w reach 40 rad/s for a short time. The error is therefore about (w
   * h)^4 = 6e-10. */
  assert_reached_by_rk4(&NINE, m.mechanism, 1.0 / 8192, 1e-9);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(adams_reaches_the_reference_within_1e_9),
    cmocka_unit_test(rk4_with_projection_reaches_the_reference),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
