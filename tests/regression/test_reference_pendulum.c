/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares two pendulums with tests/data. Each pendulum is built in two ways: with a distance
 * joint, and with one user function. The first pendulum is A01 of IFToMM and A Coruna, over 10 s.
 * Its table has 17 digits and agrees with the closed form, which contains elliptic functions. The
 * second pendulum is SUNDIALS' cvPendulum_dns, over 30 s. Its period is exactly 2 s. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "a01_pendulum_reference.h"
#include "reference_test.h"
#include "sundials_pendulum_reference.h"

static const reference A01 = {.name = "A01 pendulum",
                              .samples = A01_PENDULUM_SAMPLES,
                              .width = A01_PENDULUM_WIDTH,
                              .t = A01_PENDULUM_T,
                              .q = A01_PENDULUM_Q[0],
                              .lengths = "mm"};

static const reference SUNDIALS = {.name = "SUNDIALS pendulum",
                                   .samples = SUNDIALS_PENDULUM_SAMPLES,
                                   .width = SUNDIALS_PENDULUM_WIDTH,
                                   .t = SUNDIALS_PENDULUM_T,
                                   .q = SUNDIALS_PENDULUM_Q[0],
                                   .lengths = "mm"};

static void reach_with_adams(const reference *with, const model_pendulum *data)
{
  model m;
  baum_simulation_options options = adams_options();
  assert_int_equal(model_pendulum_rod(data, &m), BAUM_OK);
  assert_reached(with, m.mechanism, &options, 1e-8);
  model_destroy(&m);
  assert_int_equal(model_pendulum_circle(data, &m), BAUM_OK);
  reference by_function = *with;
  char name[64];
  (void)snprintf(name, sizeof name, "%s, Phi alone", with->name);
  by_function.name = name;
  assert_reached(&by_function, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

static void adams_reaches_a01_within_1e_8(void **state)
{
  (void)state;
  need_sundials();
  reach_with_adams(&A01, &MODEL_PENDULUM_A01);
}

static void adams_reaches_the_pendulum_of_sundials_within_1e_8(void **state)
{
  (void)state;
  need_sundials();
  reach_with_adams(&SUNDIALS, &MODEL_PENDULUM_SUNDIALS);
}

static void rk4_with_projection_reaches_both_references(void **state)
{
  (void)state;
  model m;
  /* The angular velocity is below 5.3 rad/s. For the two steps h below, (5.3 h)^4 is 4e-11 and
   * 3e-12. The error is about this number times the angle covered (40 and 120 rad), divided by
   * 5!. */
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  assert_reached_by_rk4(&A01, m.mechanism, 1.0 / 2048, 1e-10);
  model_destroy(&m);
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_SUNDIALS, &m), BAUM_OK);
  assert_reached_by_rk4(&SUNDIALS, m.mechanism, 1.0 / 4096, 1e-10);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(adams_reaches_a01_within_1e_8),
    cmocka_unit_test(adams_reaches_the_pendulum_of_sundials_within_1e_8),
    cmocka_unit_test(rk4_with_projection_reaches_both_references),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
