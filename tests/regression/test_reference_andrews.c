/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares Andrews' squeezing mechanism with the catalogue's samples. The mechanism is built from
 * user functions of 7 angles, with and without a Jacobian. It is also built from 7 rigid bodies.
 * The samples were computed for this project, and are correct to 15 digits; the published values
 * have only 10 digits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "assert_near.h"
#include "catalog/data/andrews.h"
#include "reference_test.h"
#include "runs.h"

static const reference ANGLES = {.name = "Andrews, 7 angles",
                                 .samples = ANDREWS_SAMPLES,
                                 .width = ANDREWS_WIDTH,
                                 .t = ANDREWS_T,
                                 .q = ANDREWS_Q[0],
                                 .lengths = "rrrrrrr"};

static void adams_reaches_the_reference_in_angles_with_a_given_jacobian(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_andrews_angles(true, &m), BAUM_OK);
  baum_simulation_options options = adams_options();
  assert_reached(&ANGLES, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

static void adams_reaches_the_reference_in_angles_with_phi_alone(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_andrews_angles(false, &m), BAUM_OK);
  baum_simulation_options options = adams_options();
  reference phi_alone = ANGLES;
  phi_alone.name = "Andrews, 7 angles, Phi alone";
  assert_reached(&phi_alone, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

static void adams_reaches_the_reference_with_seven_bodies(void **state)
{
  (void)state;
  need_sundials();
  model m;
  assert_int_equal(model_andrews_bodies(&m), BAUM_OK);
  int32_t nq = 0;
  int32_t nc = 0;
  assert_int_equal(baum_mechanism_sizes(m.mechanism, &nq, NULL, &nc), BAUM_OK);
  assert_int_equal(nq, 21);
  assert_int_equal(nc, 20);
  baum_simulation_options options = adams_options();
  reference bodies = ANGLES;
  bodies.name = "Andrews, 7 bodies";
  bodies.columns = model_andrews_from_bodies;
  assert_reached(&bodies, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

static void ida_with_ggl_reaches_the_reference_within_1e_6(void **state)
{
  (void)state;
  need_sundials();
  model m;
  baum_simulation_options options = ggl_options();
  assert_int_equal(model_andrews_angles(true, &m), BAUM_OK);
  assert_reached(&ANGLES, m.mechanism, &options, 1e-6);
  model_destroy(&m);
  assert_int_equal(model_andrews_bodies(&m), BAUM_OK);
  reference bodies = ANGLES;
  bodies.name = "Andrews, 7 bodies";
  bodies.columns = model_andrews_from_bodies;
  assert_reached(&bodies, m.mechanism, &options, 1e-6);
  model_destroy(&m);
}

static void rk4_with_projection_reaches_the_reference(void **state)
{
  (void)state;
  model m;
  /* The crank rotates at up to 1.4e3 rad/s, and by 16 rad in total. The error is about (1.4e3
   * h)^4 = 7e-10, multiplied by 16 and divided by 5!. */
  double step = 0.03 / 8192;
  assert_int_equal(model_andrews_angles(true, &m), BAUM_OK);
  assert_reached_by_rk4(&ANGLES, m.mechanism, step, 1e-10);
  model_destroy(&m);
  assert_int_equal(model_andrews_bodies(&m), BAUM_OK);
  reference bodies = ANGLES;
  bodies.name = "Andrews, 7 bodies";
  bodies.columns = model_andrews_from_bodies;
  assert_reached_by_rk4(&bodies, m.mechanism, step, 1e-10);
  model_destroy(&m);
}

static void multipliers_have_the_sign_of_the_equations(void **state)
{
  (void)state;
  const baum_channel channels[2] = {baum_channel_of(BAUM_V), baum_channel_of(BAUM_LAMBDA)};
  enum { ROW = 13 };
  model m;
  assert_int_equal(model_andrews_angles(true, &m), BAUM_OK);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.formulation = BAUM_FORMULATION_PROJECTION;
  options.step = 0.03 / 8192;
  double rows[ANDREWS_SAMPLES * ROW];
  baum_simulation *run = create_run(m.mechanism, &options);
  assert_int_equal(baum_simulation_sample(run, ANDREWS_T, ANDREWS_SAMPLES, channels, 2, rows, NULL),
                   BAUM_OK);
  for (int i = 0; i < ANDREWS_SAMPLES; i++) {
    for (int k = 0; k < 7; k++) {
      /* The error of the positions was measured above to be 3e-12. The error of the velocities is
       * larger by a factor of about 1e3 1/s, because the crank rotates this fast. */
      ASSERT_NEAR(rows[i * ROW + k], ANDREWS_V[i][k], 0.0, 1e-8);
    }
    for (int k = 0; k < 6; k++) {
      /* Forces change by 4530 N/m x 0.03 m within some tenths of a radian. This is about 1e3 N/rad.
       * An error of 3e-12 rad therefore causes an error of 3e-9 N. */
      ASSERT_NEAR(rows[i * ROW + 7 + k], ANDREWS_LAMBDA[i][k], 0.0, 1e-8);
    }
  }
  baum_simulation_destroy(run);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(adams_reaches_the_reference_in_angles_with_a_given_jacobian),
    cmocka_unit_test(adams_reaches_the_reference_in_angles_with_phi_alone),
    cmocka_unit_test(adams_reaches_the_reference_with_seven_bodies),
    cmocka_unit_test(ida_with_ggl_reaches_the_reference_within_1e_6),
    cmocka_unit_test(rk4_with_projection_reaches_the_reference),
    cmocka_unit_test(multipliers_have_the_sign_of_the_equations),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
