/* SPDX-License-Identifier: BSD-3-Clause */
/* Provokes the messages that no other test provokes. tests/layout/check_messages.py --untriggered
 * lists messages that no test provokes at all. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "construct.h"
#include "message.h"
#include "models.h"
#include "runs.h"
#include "simulate/run.h"
#include "study_entries.h"

/* Makes a rod of 1 m on a pin. If `driven` is set, a driver rotates it at 1 rad/s. */
static baum_mechanism *rod_on_a_pin(bool driven)
{
  baum_body_id rod;
  baum_mechanism *m = create_mechanism();
  baum_planar_body_def body = baum_planar_body_def_default();
  body.position[0] = 0.5;
  assert_int_equal(baum_mechanism_add_planar_body(m, &body, &rod), BAUM_OK);
  baum_joint_id pin = add_planar_pin(m, NULL, BAUM_GROUND, rod, 0.0, 0.0);
  if (driven) {
    baum_driver_def driver = baum_driver_def_default();
    driver.joint = pin;
    driver.rate = 1.0;
    assert_int_equal(baum_mechanism_add_driver(m, &driver, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static baum_simulation_options fixed_step(const baum_integrator *integrator, double step)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.step = step;
  return o;
}

static void ground_has_no_definition(void **state)
{
  (void)state;
  baum_mechanism *m = rod_on_a_pin(false);
  baum_planar_body_def def;
  ASSERT_SAYS(baum_mechanism_get_planar_body(m, BAUM_GROUND, &def, sizeof def), BAUM_ERR_ARGUMENT,
              "ground has no definition");
  baum_mechanism_destroy(m);
}

static void kinematics_keeps_no_energy_account(void **state)
{
  (void)state;
  baum_mechanism *m = rod_on_a_pin(true);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  o.energy_account = true;
  check_run_refused(m, &o, BAUM_ERR_UNSUPPORTED, "energy_account|kinematics");
  baum_mechanism_destroy(m);
}

/* At a time of 1e12 s, neighbouring doubles are 1.2e-4 s apart. A shorter step must be refused. */
static void a_step_below_the_rounding_of_time_is_an_error(void **state)
{
  (void)state;
  baum_mechanism *m = rod_on_a_pin(false);
  baum_simulation_options o = fixed_step(baum_rk4(), 1e-6);
  o.start_time = 1e12;
  baum_simulation *run = create_run(m, &o);
  ASSERT_SAYS(baum_simulation_step(run, 1), BAUM_ERR_STEP, "t = 1000000000000 s|1e-06 s|rounding");
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* With Euler's method, alpha h = beta h = 1 is dead-beat. If the gains of a row are multiplied by
 * 1.97, a step leaves 0.97 of this row's violation. This must cause a warning. */
static void factors_that_hardly_damp_cause_a_warning(void **state)
{
  (void)state;
  const double factors[] = {1.0, 1.97};
  baum_mechanism *m = rod_on_a_pin(false);
  baum_simulation_options o = fixed_step(baum_euler(), 1e-3);
  o.gains = baum_gains_scaled(1.0, 1.0);
  o.row_gains = factors;
  o.row_gain_count = 2;
  baum_simulation *run = create_run(m, &o);
  baum_warning warning = {0};
  assert_int_equal(baum_simulation_warning(run, 0, &warning, sizeof warning), BAUM_OK);
  assert_int_equal(warning.code, BAUM_WARNING_GAINS);
  assert_non_null(strstr(warning.text, "1.97"));
  assert_non_null(strstr(warning.text, "row_gains"));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static bool ends_with(const char *text, const char *end)
{
  return strlen(text) >= strlen(end) && strcmp(text + strlen(text) - strlen(end), end) == 0;
}

/* The message of a warning must end with the heading of its entry in docs/cookbook/warnings.md. If
 * the text before the heading is too long, this text is cut. */
static void messages_of_warnings_end_with_the_heading_of_their_entry(void **state)
{
  (void)state;
  char longest[2 * sizeof((baum_warning *)NULL)->text];
  memset(longest, 'x', sizeof longest - 1);
  longest[sizeof longest - 1] = '\0';
  baum_mechanism *m = rod_on_a_pin(false);
  baum_simulation_options o = fixed_step(baum_euler(), 1e-3);
  baum_simulation *run = create_run(m, &o);
  for (int k = 0; k < 2; k++) {
    baum_i_run_warn(run, BAUM_WARNING_SINGULAR_START, 0.25, BAUM_I_NO_JOINT, "short");
    baum_i_run_warn(run, BAUM_WARNING_BRANCH, 0.25, BAUM_I_NO_JOINT, "%s", longest);
  }
  baum_warning warning = {0};
  assert_int_equal(baum_simulation_warning(run, 0, &warning, sizeof warning), BAUM_OK);
  assert_string_equal(warning.text,
                      "short (2 times, the last at t = 0.25 s) [warning 104 singular_start]");
  assert_int_equal(baum_simulation_warning(run, 1, &warning, sizeof warning), BAUM_OK);
  assert_int_equal(strlen(warning.text), sizeof warning.text - 1);
  assert_true(ends_with(warning.text, "xx [warning 100 branch]"));
  assert_int_equal(baum_simulation_step(run, 1), BAUM_WARNED);
  assert_true(ends_with(baum_message(), " [warning 104 singular_start]"));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* A free particle moves at 1e300 m/s. Its accelerations are finite, but its position overflows in a
 * step of 1e9 s. */
static void a_step_to_infinity_is_an_error(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_planar_particle_def ball = baum_planar_particle_def_default();
  ball.velocity[0] = 1e300;
  ball.velocity[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_particle(m, &ball, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  baum_simulation_options o = fixed_step(baum_euler(), 1e9);
  o.formulation = BAUM_FORMULATION_UNSTABILIZED;
  baum_simulation *run = create_run(m, &o);
  ASSERT_SAYS(baum_simulation_step(run, 1), BAUM_ERR_NOT_FINITE, "t = 0 s|1e+09 s|not finite");
  assert_true(baum_simulation_time(run) == 0.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static int no_solution(double t, double *q, double *v, double *lambda, void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)lambda;
  (void)user;
  return -1;
}

static void a_study_that_has_run_keeps_its_reference(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  const baum_study_options options = small_study_options();
  baum_study *study = small_study(m.mechanism, &options);
  assert_true(baum_study_run(study) >= BAUM_OK);
  ASSERT_SAYS(baum_study_set_solution(study, no_solution, NULL, 9.0), BAUM_ERR_STATE,
              "baum_study_set_solution|the reference");
  baum_study_reference r;
  assert_int_equal(baum_study_reference_read(study, &r, sizeof r), BAUM_OK);
  double t = 0.0;
  assert_int_equal(baum_study_reference_sample(study, r.samples - 1, &t, NULL, NULL, NULL),
                   BAUM_OK);
  const int32_t missing[] = {-1, r.samples};
  for (int i = 0; i < 2; i++) {
    ASSERT_SAYS(baum_study_reference_sample(study, missing[i], &t, NULL, NULL, NULL),
                BAUM_ERR_ARGUMENT, "baum_study_reference_sample: k is");
  }
  baum_study_destroy(study);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(ground_has_no_definition),
    cmocka_unit_test(kinematics_keeps_no_energy_account),
    cmocka_unit_test(a_step_below_the_rounding_of_time_is_an_error),
    cmocka_unit_test(factors_that_hardly_damp_cause_a_warning),
    cmocka_unit_test(messages_of_warnings_end_with_the_heading_of_their_entry),
    cmocka_unit_test(a_step_to_infinity_is_an_error),
    cmocka_unit_test(a_study_that_has_run_keeps_its_reference),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
