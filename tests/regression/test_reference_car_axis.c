/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the car axis with the catalogue's samples, which have 18 digits. It has four user
 * coordinates and two rows that depend on time. It is tested with and without functions for the
 * derivatives of these rows. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "assert_near.h"
#include "catalog/data/car_axis.h"
#include "reference_test.h"
#include "runs.h"

static const reference AXIS = {.name = "car axis",
                               .samples = CAR_AXIS_SAMPLES,
                               .width = CAR_AXIS_WIDTH,
                               .t = CAR_AXIS_T,
                               .q = CAR_AXIS_Q[0],
                               .lengths = "mmmm"};

static void adams_reaches_the_reference_with_derivatives_given(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_car_axis(true, &m), BAUM_OK);
  baum_simulation_options options = adams_options();
  assert_reached(&AXIS, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

static void adams_reaches_the_reference_with_phi_alone(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_car_axis(false, &m), BAUM_OK);
  baum_simulation_options options = adams_options();
  reference phi_alone = AXIS;
  phi_alone.name = "car axis, Phi alone";
  assert_reached(&phi_alone, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

static void rk4_with_projection_reaches_the_reference(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_car_axis(true, &m), BAUM_OK);
  /* Springs of 1 N/m with masses of 5e-4 kg oscillate at 45 rad/s. The error is about (45
   * h)^4 = 4e-10, divided by 5!. */
  assert_reached_by_rk4(&AXIS, m.mechanism, 1e-4, 1e-10);
  model_destroy(&m);
}

static void multipliers_are_the_negative_of_the_test_set(void **state)
{
  (void)state;
  const baum_channel channels[2] = {baum_channel_of(BAUM_V), baum_channel_of(BAUM_LAMBDA)};
  enum { ROW = 6 };
  model m;
  assert_int_equal(model_car_axis(true, &m), BAUM_OK);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.formulation = BAUM_FORMULATION_PROJECTION;
  options.step = 1e-4;
  double rows[CAR_AXIS_SAMPLES * ROW];
  baum_simulation *run = create_run(m.mechanism, &options);
  assert_int_equal(
    baum_simulation_sample(run, CAR_AXIS_T, CAR_AXIS_SAMPLES, channels, 2, rows, NULL), BAUM_OK);
  for (int i = 0; i < CAR_AXIS_SAMPLES; i++) {
    for (int k = 0; k < 4; k++) {
      /* The error of the positions is below 1e-10, as tested above. The error of the velocities is
       * larger by a factor of 45 1/s. */
      ASSERT_NEAR(rows[i * ROW + k], CAR_AXIS_V[i][k], 0.0, 4.5e-9);
    }
    for (int k = 0; k < 2; k++) {
      /* The same error of the positions is multiplied by the stiffness of 1 N/m. */
      ASSERT_NEAR(rows[i * ROW + 4 + k], -CAR_AXIS_LAMBDA[i][k], 0.0, 1e-10);
    }
  }
  baum_simulation_destroy(run);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(adams_reaches_the_reference_with_derivatives_given),
    cmocka_unit_test(adams_reaches_the_reference_with_phi_alone),
    cmocka_unit_test(rk4_with_projection_reaches_the_reference),
    cmocka_unit_test(multipliers_are_the_negative_of_the_test_set),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
