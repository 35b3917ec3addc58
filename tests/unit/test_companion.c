/* SPDX-License-Identifier: BSD-3-Clause */
/* The companion of a run is a second integration that estimates the error. The tests cover its
 * estimates and its warnings, runs that do not need it, and runs that abandon it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "models.h"
#include "runs.h"

static const double SPAN = 2.0; /* [s] about one swing of the pendulum A01 */

/* Counts the warnings that the step is too long. Sets *advised to the step that the last of these
 * warnings recommends. */
static int64_t count_warnings(const baum_integrator *integrator, double step, double *advised)
{
  model m;
  baum_simulation_options o = baum_simulation_options_default();
  int64_t found = 0;
  o.integrator = integrator;
  o.step = step;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  baum_simulation *run = create_run(m.mechanism, &o);
  assert_true(baum_simulation_advance_to(run, SPAN) >= BAUM_OK);
  baum_counters c = counters_of(run);
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

/* In a step of 0.1 s the pendulum moves by about half a radian. This is too long for methods of
 * order 1, but suitable for methods of order 4 and higher. A step of 0.4 s is too long for rk4. */
static void the_longest_accurate_step_depends_on_the_order(void **state)
{
  (void)state;
  double advised = 0.0;
  assert_int_equal(count_warnings(baum_euler(), 0.1, &advised), 1);
  assert_int_equal(count_warnings(baum_semi_implicit_euler(), 0.1, &advised), 1);
  assert_int_equal(count_warnings(baum_rk4(), 0.1, &advised), 0);
  assert_int_equal(count_warnings(baum_rk8(), 0.1, &advised), 0);
  assert_int_equal(count_warnings(baum_rk4(), 0.4, &advised), 1);
}

static void a_tenth_of_the_advised_step_is_not_too_long(void **state)
{
  (void)state;
  const baum_integrator *const methods[] = {baum_euler(), baum_semi_implicit_euler(), baum_rk2()};
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    double advised = 0.0;
    double again = 0.0;
    assert_int_equal(count_warnings(methods[k], 0.2, &advised), 1);
    assert_true(advised > 0.0 && advised < 0.2);
    /* The warning recommended this step early in the run. Later parts of the motion need a smaller
     * step. A tenth of the recommended step suffices. */
    assert_int_equal(count_warnings(methods[k], advised / 10.0, &again), 0);
  }
}

/* ---- accuracy of the estimate ---- */

/* Runs the pendulum, a particle on a rod, to SPAN. Sets *error to the largest position error at 40
 * times. */
static baum_counters run_pendulum(baum_simulation_options o, double *error)
{
  enum { TIMES = 40 };
  model m;
  baum_simulation_options fine = baum_simulation_options_default();
  fine.integrator = baum_rk8();
  fine.rtol = 1e-12;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  baum_simulation *run = create_run(m.mechanism, &o);
  baum_simulation *exact = create_run(m.mechanism, &fine);
  *error = 0.0;
  for (int k = 1; k <= TIMES; k++) {
    assert_true(baum_simulation_advance_to(run, k * SPAN / TIMES) >= BAUM_OK);
    assert_int_equal(baum_simulation_advance_to(exact, k * SPAN / TIMES), BAUM_OK);
    for (int i = 0; i < 2; i++) {
      *error = fmax(*error, fabs(baum_simulation_q(run)[i] - baum_simulation_q(exact)[i]));
    }
  }
  baum_counters c = counters_of(run);
  baum_simulation_destroy(run);
  baum_simulation_destroy(exact);
  model_destroy(&m);
  return c;
}

static void estimates_agree_with_the_error(void **state)
{
  (void)state;
  static const double steps[] = {2e-4, 1e-3, 2e-3, 1e-2, 1e-2, 0.05, 2e-3};
  const baum_integrator *const methods[] = {
    baum_euler(),  baum_semi_implicit_euler(), baum_rk2(), baum_rk3(), baum_ab2(), baum_rk4(),
    baum_rattle(),
  };
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    double error = 0.0;
    o.integrator = methods[k];
    o.step = steps[k];
    o.error_check = true;
    baum_counters c = run_pendulum(o, &error);
    ASSERT_NEAR(c.error_estimate, error, 0.2, 2e-4); /* an estimate within 20 % suffices */
    assert_int_equal(c.doubts, c.error_estimate > 0.03);
  }
}

static void accurate_runs_have_no_companion(void **state)
{
  (void)state;
  baum_simulation_options o = baum_simulation_options_default();
  double error = 0.0;
  o.integrator = baum_rk4();
  o.step = 1e-3;
  assert_true(run_pendulum(o, &error).error_estimate == 0.0);
}

static void runs_with_variable_steps_are_checked_on_request(void **state)
{
  (void)state;
  for (int k = 0; baum_integrator_at(k); k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_integrator_at(k);
    if (!baum_integrator_has_variable_step(o.integrator)) {
      continue;
    }
    double error = 0.0;
    o.rtol = 1e-4;
    assert_true(isnan(run_pendulum(o, &error).error_estimate));
    o.error_check = true;
    baum_counters c = run_pendulum(o, &error);
    assert_true(c.error_estimate > 0.1 * error && c.error_estimate < 10.0 * error);
    assert_int_equal(c.doubts, 0);
  }
}

/* Samples inside a step are interpolated, which adds an error. The estimate is the same whether one
 * call returns all samples or each call returns one sample. */
static void estimates_include_samples_inside_steps(void **state)
{
  (void)state;
  enum { TIMES = 40 };
  double times[TIMES];
  double rows[TIMES][2];
  int64_t done = 0;
  model m;
  baum_simulation_options o = baum_simulation_options_default();
  const baum_channel channel = baum_channel_of(BAUM_Q);
  double error = 0.0;
  o.integrator = baum_rk8();
  o.rtol = 1e-9;
  o.error_check = true;
  const baum_counters one_by_one = run_pendulum(o, &error);
  assert_in_range(one_by_one.steps, 10, TIMES); /* samples are inside steps */
  for (int k = 0; k < TIMES; k++) {
    times[k] = (k + 1) * SPAN / TIMES;
  }
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  baum_simulation *run = create_run(m.mechanism, &o);
  assert_int_equal(baum_simulation_sample(run, times, TIMES, &channel, 1, rows[0], &done), BAUM_OK);
  assert_int_equal(done, TIMES);
  baum_counters c = counters_of(run);
  ASSERT_NEAR(c.error_estimate, one_by_one.error_estimate, 0.0, 0.0);
  ASSERT_NEAR(c.error_estimate, error, 0.2, 0.0);
  baum_simulation_destroy(run);
  model_destroy(&m);
}

/* A companion needs a smaller tolerance than its run, and a method that integrates. */
static void an_estimate_that_is_impossible_is_refused(void **state)
{
  (void)state;
  baum_simulation_options o = baum_simulation_options_default();
  double error = 0.0;
  o.integrator = baum_rk8();
  o.error_check = true;
  o.rtol = 1e-13;
  assert_true(run_pendulum(o, &error).error_estimate > 1e-14);
  model m;
  baum_simulation *run = NULL;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  o.rtol = 1e-14;
  assert_int_equal(baum_simulation_create(m.mechanism, &o, &run), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "must be at least 2e-14 with error_check"));
  o.integrator = baum_kinematics();
  o.rtol = (double)NAN;
  assert_int_equal(baum_simulation_create(m.mechanism, &o, &run), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "error_check is set, but kinematics does not integrate"));
  assert_null(run);
  model_destroy(&m);
}

/* The run reverses the direction of time inside a step. The run and its companion restart at this
 * point. */
static void estimates_continue_after_a_restart_inside_a_step(void **state)
{
  (void)state;
  enum { TURNS = 50 };
  for (int k = 0; baum_integrator_at(k); k++) {
    model m;
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_integrator_at(k);
    if (!baum_integrator_has_variable_step(o.integrator)) {
      continue;
    }
    o.rtol = 1e-4;
    o.error_check = true;
    assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
    baum_simulation *run = create_run(m.mechanism, &o);
    for (int i = 1; i <= TURNS; i++) {
      assert_int_equal(baum_simulation_advance_to(run, SPAN * i / TURNS), BAUM_OK);
      assert_int_equal(baum_simulation_advance_to(run, SPAN * (i - 0.3) / TURNS), BAUM_OK);
    }
    baum_counters c = counters_of(run);
    assert_true(c.error_estimate > 0.0);
    baum_simulation_destroy(run);
    model_destroy(&m);
  }
}

/* ---- events between steps ---- */

/* A light rod joins a bob to a slider on the x axis. When the rod becomes perpendicular to the
 * axis, the rod stops the bob in a time that is shorter than a step. With rk4 and steps of 1 ms,
 * the final position is wrong by 0.64 m, and the energy grows from 2.2 J by 2.9 J. */
static baum_mechanism *make_taut_rod(void)
{
  const double mass = 0.0014776077955897843;
  baum_body_id rod;
  baum_body_id bob;
  baum_planar_body_def body = baum_planar_body_def_default();
  body.mass = mass;
  body.inertia = mass / 12.0;
  body.position[0] = 0.4;
  body.position[1] = -0.3;
  body.angle = -0.6435011087932844;
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  particle.position[0] = 0.8;
  particle.position[1] = -0.6;
  particle.velocity[0] = 0.9558384584553545;
  particle.velocity[1] = -1.8884285084166446;
  baum_planar_pin_in_slot_def slot = baum_planar_pin_in_slot_def_default();
  slot.point_a[0] = slot.point_a[1] = 0.0;
  slot.point_b[0] = -0.5;
  slot.point_b[1] = 0.0;
  slot.axis[0] = 1.0;
  slot.axis[1] = 0.0;
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.point_a[0] = 0.5;
  pin.point_a[1] = pin.point_b[0] = pin.point_b[1] = 0.0;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_body(m, &body, &rod), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_particle(m, &particle, &bob), BAUM_OK);
  slot.body_a = BAUM_GROUND;
  slot.body_b = pin.body_a = rod;
  pin.body_b = bob;
  assert_int_equal(baum_mechanism_add_planar_pin_in_slot(m, &slot, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_revolute(m, &pin, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static void runs_that_miss_a_short_event_warn(void **state)
{
  (void)state;
  static const double steps[] = {2e-3, 1.5e-3, 1e-3, 9e-4, 8e-4, 7e-4};
  baum_mechanism *m = make_taut_rod();
  for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++) {
    for (int f = BAUM_FORMULATION_BAUMGARTE; f <= BAUM_FORMULATION_PROJECTION; f++) {
      baum_simulation_options o = baum_simulation_options_default();
      o.integrator = baum_rk4();
      o.formulation = (baum_formulation)f;
      o.step = steps[k];
      baum_simulation *run = create_run(m, &o);
      baum_status status = baum_simulation_advance_to(run, 1.5);
      baum_counters c = counters_of(run);
      assert_true(status < BAUM_OK || c.doubts > 0);
      baum_simulation_destroy(run);
    }
  }
  baum_mechanism_destroy(m);
}

/* ---- drivers with corners ---- */

/* The law of a driver that rotates by 3 rad in 0.3 s and then rests. */
static int ramp(double t, double s[3], void *user)
{
  (void)user;
  s[0] = fmin(t, 0.3) * 10.0;
  s[1] = t < 0.3 ? 10.0 : 0.0;
  s[2] = 0.0;
  return 0;
}

/* The driver prescribes a velocity with a jump at 0.3 s. The acceleration does not contain the
 * impulse that this jump requires. The estimate must not count the jump as an error. */
static void jumps_of_driver_velocities_are_not_counted_as_errors(void **state)
{
  (void)state;
  const baum_integrator *const methods[] = {baum_rk4(), baum_semi_implicit_euler(), baum_rattle(),
                                            baum_rk8()};
  baum_planar_body_def crank = baum_planar_body_def_default();
  baum_body_id body;
  baum_driver_def driver = baum_driver_def_default();
  driver.law = ramp;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_body(m, &crank, &body), BAUM_OK);
  driver.joint = add_planar_pin(m, NULL, BAUM_GROUND, body, 0.0, 0.0);
  assert_int_equal(baum_mechanism_add_driver(m, &driver, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = methods[k];
    o.step = 1e-3;
    o.error_check = true;
    baum_simulation *run = create_run(m, &o);
    assert_true(baum_simulation_advance_to(run, 1.0) >= BAUM_OK);
    baum_counters c = counters_of(run);
    assert_true(c.error_estimate < 0.01);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* A controller sets a force every few steps. After each change, four steps have no estimate. The
 * error is therefore known if a change comes every six steps, but not if one comes every five
 * steps. */
static void errors_are_known_if_inputs_change_every_six_steps(void **state)
{
  (void)state;
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_planar_load_def load = baum_planar_load_def_default();
  load.force[0] = 1.0;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_particle(m, &bob, &load.body), BAUM_OK);
  assert_int_equal(baum_mechanism_add_input(m, NULL, 0.0, &load.input), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_load(m, &load, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  for (int steps = 5; steps <= 6; steps++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_rk4();
    o.step = 1e-3;
    baum_simulation *run = create_run(m, &o);
    for (int k = 0; k < 100; k++) {
      check(baum_simulation_set_input(run, load.input, sin(k)));
      check(baum_simulation_step(run, steps));
    }
    assert_int_equal(isnan(counters_of(run).error_estimate), steps == 5);
    /* Estimates of steps before a new start do not count. */
    const double q[2] = {0.0, 0.0};
    check(baum_simulation_step(run, 100000));
    check(baum_simulation_set_state(run, 0.0, q, q));
    for (int k = 0; k < 100; k++) {
      check(baum_simulation_set_input(run, load.input, sin(k)));
      check(baum_simulation_step(run, steps));
    }
    assert_int_equal(isnan(counters_of(run).error_estimate), steps == 5);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* ---- runs that abandon their companion ---- */

/* The companion is a run with rk8. A damper with the decay rate 1e6 1/s would force rk8 to steps of
 * a microsecond. */
static void stiff_runs_abandon_their_companion(void **state)
{
  (void)state;
  baum_body_id body;
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_planar_spring_def spring = baum_planar_spring_def_default();
  bob.velocity[0] = 1.0;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_particle(m, &bob, &body), BAUM_OK);
  spring.body_a = BAUM_GROUND;
  spring.body_b = body;
  spring.point_a[0] = -1.0;
  spring.point_a[1] = spring.point_b[0] = spring.point_b[1] = 0.0;
  spring.damping = 1e6;
  spring.stiffness = 1e6;
  assert_int_equal(baum_mechanism_add_planar_spring(m, &spring, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_generalized_alpha();
  o.step = 1e-3;
  for (int requested = 0; requested < 2; requested++) {
    o.error_check = requested;
    baum_simulation *run = create_run(m, &o);
    check(baum_simulation_advance_to(run, 1.0));
    baum_counters c = counters_of(run);
    assert_true(isnan(c.error_estimate));
    assert_int_equal(c.warnings, requested);
    if (requested) {
      baum_warning warning;
      check(baum_simulation_warning(run, 0, &warning, sizeof warning));
      assert_int_equal(warning.code, BAUM_WARNING_ERROR_UNKNOWN);
      assert_int_equal(warning.count, 1);
      assert_non_null(strstr(warning.text, "ten times as many evaluations"));
    }
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* ---- warnings ---- */

static void warning_codes_have_names(void **state)
{
  (void)state;
  assert_string_equal(baum_warning_name(BAUM_WARNING_REDUNDANT_ROWS), "redundant_rows");
  for (int k = BAUM_WARNING_REDUNDANT_ROWS; k <= BAUM_WARNING_ERROR_UNKNOWN; k++) {
    assert_non_null(baum_warning_name((baum_warning_code)k));
  }
  for (int k = BAUM_WARNING_BRANCH; k <= BAUM_WARNING_WRONG_DERIVATIVE; k++) {
    assert_non_null(baum_warning_name((baum_warning_code)k));
  }
  assert_null(baum_warning_name((baum_warning_code)0));
  assert_null(baum_warning_name((baum_warning_code)99));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_longest_accurate_step_depends_on_the_order),
    cmocka_unit_test(a_tenth_of_the_advised_step_is_not_too_long),
    cmocka_unit_test(estimates_agree_with_the_error),
    cmocka_unit_test(accurate_runs_have_no_companion),
    cmocka_unit_test(runs_with_variable_steps_are_checked_on_request),
    cmocka_unit_test(estimates_include_samples_inside_steps),
    cmocka_unit_test(an_estimate_that_is_impossible_is_refused),
    cmocka_unit_test(estimates_continue_after_a_restart_inside_a_step),
    cmocka_unit_test(runs_that_miss_a_short_event_warn),
    cmocka_unit_test(jumps_of_driver_velocities_are_not_counted_as_errors),
    cmocka_unit_test(errors_are_known_if_inputs_change_every_six_steps),
    cmocka_unit_test(stiff_runs_abandon_their_companion),
    cmocka_unit_test(warning_codes_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
