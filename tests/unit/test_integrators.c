/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs the same tests for every integrator of this build with each of its formulations. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "integrator_run.h"

/* ---- the common tests ---- */

/* An integrator with one of its formulations. The step is fixed or variable. */
typedef struct method {
  const baum_integrator *integrator;
  baum_formulation formulation;
  bool fixed; /* whether the step is fixed */
} method;

typedef void battery_fn(const method *m);

static const char *kind_of_step(const method *m)
{
  return m->fixed ? "fixed step" : "variable step";
}

static integrator_setup setup_of(baum_mechanism *mechanism, const method *m)
{
  integrator_setup setup = integrator_setup_make(mechanism, m->integrator, m->formulation);
  setup.fixed = m->fixed;
  return setup;
}

/* Calls a test for every integrator of this build, with each of its formulations and each kind of
 * step. */
static void for_each(battery_fn *test)
{
  for (int k = 0; baum_integrator_at(k); k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    for (const baum_formulation *f = integrator->formulations; *f; f++) {
      if (integrator->step) {
        test(&(method){integrator, *f, true});
      }
      if (integrator->advance) {
        test(&(method){integrator, *f, false});
      }
    }
  }
}

/* Returns the error at time t. If the run goes backwards in time, returns the error at -t. */
static double error_at(baum_mechanism *mechanism, const integrator_setup *setup, double t,
                       motion_fn *motion, double rate)
{
  integrator_run run;
  double q[2];
  double v[2];
  (void)mechanism;
  if (integrator_run_open(&run, setup) != BAUM_OK ||
      integrator_run_to(&run, setup->direction * t) != BAUM_OK) {
    fail_msg("%s: %s", setup->integrator->name, baum_message());
  }
  motion(setup->direction * t, q, v);
  double error = motion_error(2, run.q, run.v, q, v, rate);
  integrator_run_close(&run);
  return error;
}

/* Returns the largest allowed error for rtol = 1e-6 or h = 1e-3. The motions have rates of 2 to 10
 * 1/s. The error for index 3 may be larger, because its velocities are inaccurate. */
static double allowed(const integrator_setup *setup)
{
  /* The allowed error for each order. The first entry is for variable steps. From order 5 on, the
   * errors are rounding errors of 2000 steps and of the reference. */
  static const double BY_ORDER[] = {2e-4, 5e-2, 3e-5, 3e-7, 3e-9, 1e-11, 1e-11, 1e-11, 1e-11};
  /* The error constants of Adams methods, 5/12, 3/8 and 251/720, are larger than the error
   * constants of Runge-Kutta methods, which are about 1/k!. */
  double wide = setup->integrator->method.kind == BAUM_I_METHOD_ADAMS_BASHFORTH ? 30.0 : 1.0;
  return setup->formulation == BAUM_FORMULATION_INDEX3
           ? 3e-2
           : wide * BY_ORDER[setup->fixed ? baum_integrator_order(setup->integrator) : 0];
}

static void check_motion(baum_mechanism *mechanism, const method *m, motion_fn *motion, double rate)
{
  integrator_setup setup = setup_of(mechanism, m);
  for (int sign = -1; sign <= 1; sign += 2) {
    setup.direction = sign;
    double error = error_at(mechanism, &setup, 2.0, motion, rate);
    if (!(error <= allowed(&setup))) {
      fail_msg("%s, %s, %s, direction %d: error %.3g, allowed %.3g", m->integrator->name,
               kind_of_step(m), baum_formulation_name(m->formulation), sign, error,
               allowed(&setup));
    }
  }
  baum_mechanism_destroy(mechanism);
}

static void throw_it(const method *m)
{
  check_motion(make_throw(), m, throw_motion, 10.0);
}

static void oscillate(const method *m)
{
  check_motion(make_oscillator(), m, oscillator_motion, 2.0);
}

static void swing(const method *m)
{
  check_motion(make_pendulum(), m, pendulum_motion, 4.43);
}

static void a_thrown_particle_moves_on_its_parabola(void **state)
{
  (void)state;
  for_each(throw_it);
}

static void an_oscillator_keeps_time(void **state)
{
  (void)state;
  for_each(oscillate);
}

static void a_pendulum_swings_forward_and_backward_in_time(void **state)
{
  (void)state;
  for_each(swing);
}

/* From 0.7 s on, the force fails at every call. It either returns "stop" (-1), or asks for smaller
 * steps (1). The run must fail, and must keep the state at the end of the last good step. */
static void run_into_fault(const method *m)
{
  for (int answer = -1; answer <= 1; answer += 2) {
    force_fault fault = {.after = 0.7, .answer = answer};
    baum_mechanism *mechanism = make_faulty_pendulum(&fault);
    integrator_setup setup = setup_of(mechanism, m);
    integrator_run run;
    double q[2];
    double v[2];
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    baum_status status = integrator_run_to(&run, 1.0);
    if (status != BAUM_ERR_CALLBACK || !strstr(baum_message(), "faulty")) {
      fail_msg("%s, %s, answer %d: %s: %s", m->integrator->name,
               baum_formulation_name(m->formulation), answer, baum_status_name(status),
               baum_message());
    }
    assert_true(run.state.t > 0.5 && run.state.t <= 0.7 + 1.001e-3);
    pendulum_motion(run.state.t, q, v);
    assert_true(motion_error(2, run.state_q, run.state_v, q, v, 4.43) <= allowed(&setup));
    integrator_run_close(&run);
    baum_mechanism_destroy(mechanism);
  }
}

static void a_failing_function_leaves_the_last_good_step(void **state)
{
  (void)state;
  for_each(run_into_fault);
}

/* After a function has returned "stop", the step must not call it again. */
static void stop_at_once(const method *m)
{
  force_fault fault = {.after = 0.7, .answer = -1};
  baum_mechanism *mechanism = make_faulty_pendulum(&fault);
  integrator_setup setup = setup_of(mechanism, m);
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  while (integrator_run_step(&run) == BAUM_OK) {
    fault.calls = 0;
  }
  /* Only the calls in the failing step are counted, up to the call that returned "stop". */
  assert_true(fault.calls <= 16);
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void a_function_that_returns_stop_is_not_called_again(void **state)
{
  (void)state;
  for_each(stop_at_once);
}

/* After a failure, restarts the run at another time, and then backwards in time. */
static void restart_after_failure(const method *m)
{
  if (m->fixed || !m->integrator->restart) {
    return;
  }
  force_fault fault = {.after = 0.7, .answer = -1};
  baum_mechanism *mechanism = make_faulty_pendulum(&fault);
  integrator_setup setup = setup_of(mechanism, m);
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  assert_int_equal(integrator_run_to(&run, 1.0), BAUM_ERR_CALLBACK);
  baum_i_statistics before;
  m->integrator->statistics(run.self, &before);
  fault.after = (double)INFINITY;
  double q[2];
  double v[2];
  pendulum_motion(0.0, q, v);
  assert_int_equal(integrator_run_restart(&run, 100.0, q, v, 1.0), BAUM_OK);
  assert_int_equal(integrator_run_to(&run, 101.0), BAUM_OK);
  pendulum_motion(1.0, q, v);
  assert_true(motion_error(2, run.q, run.v, q, v, 4.43) <= allowed(&setup));
  assert_int_equal(integrator_run_restart(&run, 1.0, q, v, -1.0), BAUM_OK);
  assert_int_equal(integrator_run_to(&run, 0.0), BAUM_OK);
  pendulum_motion(0.0, q, v);
  assert_true(motion_error(2, run.q, run.v, q, v, 4.43) <= allowed(&setup));
  baum_i_statistics after;
  m->integrator->statistics(run.self, &after);
  bool iterates = before.nonlinear_iterations > 0;
  assert_true(after.nonlinear_iterations >= before.nonlinear_iterations + iterates);
  assert_true(after.rejected >= before.rejected);
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void a_restart_works_after_a_failure_and_backwards(void **state)
{
  (void)state;
  for_each(restart_after_failure);
}

/* The run fails twice, and then the force works again. The run must continue from the last good
 * state. */
static void continue_after_failures(const method *m)
{
  force_fault fault = {.after = 0.7, .answer = -1};
  baum_mechanism *mechanism = make_faulty_pendulum(&fault);
  integrator_setup setup = setup_of(mechanism, m);
  integrator_run run;
  double q[2];
  double v[2];
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  assert_int_equal(integrator_run_to(&run, 1.0), BAUM_ERR_CALLBACK);
  assert_int_equal(integrator_run_to(&run, 1.0), BAUM_ERR_CALLBACK);
  fault.after = (double)INFINITY;
  assert_int_equal(integrator_run_to(&run, 1.0), BAUM_OK);
  pendulum_motion(1.0, q, v);
  assert_true(motion_error(2, run.q, run.v, q, v, 4.43) <= allowed(&setup));
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void a_run_continues_when_the_force_works_again(void **state)
{
  (void)state;
  for_each(continue_after_failures);
}

/* Interpolates inside the last step and at both of its ends. Other times must be refused. */
static void interpolate_in_last_step(const method *m)
{
  if (m->fixed) {
    return;
  }
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup = setup_of(mechanism, m);
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  double begin = 0.0;
  while (run.state.t < 0.8) {
    begin = run.state.t;
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
  }
  for (int k = 0; k <= 4; k++) {
    double t = begin + 0.25 * k * (run.state.t - begin);
    double q[2];
    double v[2];
    assert_int_equal(m->integrator->interpolate(run.self, &run.problem, t, run.q, run.v), BAUM_OK);
    pendulum_motion(t, q, v);
    assert_true(motion_error(2, run.q, run.v, q, v, 4.43) <= allowed(&setup));
  }
  ASSERT_NEAR(run.q[0], run.state_q[0], 0.0, 1e-14);
  assert_int_equal(m->integrator->interpolate(run.self, &run.problem, 3.0, run.q, run.v),
                   BAUM_ERR_INTEGRATOR);
  assert_non_null(strstr(baum_message(), m->integrator->name));
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void positions_inside_the_last_step_are_interpolated(void **state)
{
  (void)state;
  for_each(interpolate_in_last_step);
}

/* The tolerance is below rounding, so that the first step becomes too short. The run must fail, and
 * its message must advise to raise rtol. */
static void use_too_small_tolerance(const method *m)
{
  if (m->fixed) {
    return;
  }
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup = setup_of(mechanism, m);
  setup.rtol = 1e-18;
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  assert_int_equal(integrator_run_step(&run), BAUM_ERR_STEP);
  assert_non_null(strstr(baum_message(), "raise rtol"));
  assert_true(run.state.t == 0.0 && run.state_q[0] == 1.0);
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void too_small_tolerances_make_the_step_fail(void **state)
{
  (void)state;
  for_each(use_too_small_tolerance);
}

/* Near 1e15 s, neighbouring doubles are 0.125 s apart. The end of a shorter step therefore cannot
 * be represented. The run must fail. */
static void run_at_late_time(const method *m)
{
  if (m->fixed) {
    return;
  }
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup = setup_of(mechanism, m);
  integrator_run run;
  double q[2];
  double v[2];
  pendulum_motion(0.3, q, v);
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  assert_int_equal(integrator_run_restart(&run, 1e15, q, v, 1.0), BAUM_OK);
  baum_status status = integrator_run_to(&run, 1e15 + 10.0);
  if (status != BAUM_ERR_STEP && status != BAUM_ERR_CONVERGENCE) {
    fail_msg("%s: %s: %s", m->integrator->name, baum_status_name(status), baum_message());
  }
  assert_true(strncmp(baum_message(), "t = 1e+15 s", 11) == 0);
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void a_step_below_the_rounding_of_time_fails(void **state)
{
  (void)state;
  for_each(run_at_late_time);
}

/* ---- order ---- */

static double error_with_step(const method *m, double step)
{
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup = setup_of(mechanism, m);
  setup.step = step;
  if (m->integrator->gains == BAUM_GAINS_DEADBEAT) {
    setup.gain = 0.5 / step; /* a gain that is stable with both Euler methods */
  }
  double error = error_at(mechanism, &setup, 1.6, pendulum_motion, 4.43);
  baum_mechanism_destroy(mechanism);
  return error;
}

/* Computes the order of a method from two errors: with the step COARSE, and with this step halved
 * three times. COARSE is short enough for the leading error term to dominate. It is long enough for
 * all errors to be far above rounding (1e-13). For orders 5 and 8, no step satisfies both
 * conditions. Their step is halved only twice, and a larger deviation is allowed. */
static void observe_order(const method *m)
{
  static const double COARSE[] = {0.0, 4e-4, 4e-3, 4e-3, 4e-3, 1.25e-2, 0.0, 0.0, 0.1};
  if (!m->fixed) {
    return;
  }
  int wanted = m->integrator->order;
  int halvings = wanted > 4 ? 2 : 3;
  double first = error_with_step(m, COARSE[wanted]);
  double last = error_with_step(m, ldexp(COARSE[wanted], -halvings));
  double order = log2(first / last) / halvings;
  if (!(order >= wanted - 0.2 && order <= wanted + (wanted > 4 ? 0.6 : 0.2))) {
    fail_msg("%s, %s: order %.3f observed, errors %.3g and %.3g", m->integrator->name,
             baum_formulation_name(m->formulation), order, first, last);
  }
}

static void fixed_step_methods_have_their_order(void **state)
{
  (void)state;
  for_each(observe_order);
}

/* ---- tolerances ---- */

/* BDF methods receive a fraction of rtol, but at least 1e-13. With smaller tolerances they would
 * need more steps, but their errors would not become smaller, because of rounding. */
static void bdf_is_given_a_portion_of_rtol(void **state)
{
  (void)state;
  for (int32_t k = 0; BAUM_HAVE_SUNDIALS && baum_integrator_at(k); k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    double portion = integrator == baum_cvode_bdf() ? 20.0 / 137.0 : 1.0;
    portion = integrator == baum_ida() ? 1.0 / 3.0 : portion;
    ASSERT_NEAR(baum_i_integrator_portion(integrator, 1e-2), portion, 1e-15, 0.0);
    ASSERT_NEAR(baum_i_integrator_portion(integrator, 1e-12), portion, 1e-15, 0.0);
    ASSERT_NEAR(baum_i_integrator_portion(integrator, 2e-13), fmax(portion, 0.5), 1e-15, 0.0);
    assert_true(baum_i_integrator_portion(integrator, 1e-13) == 1.0);
    assert_true(baum_i_integrator_portion(integrator, 1e-15) == 1.0);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_thrown_particle_moves_on_its_parabola),
    cmocka_unit_test(an_oscillator_keeps_time),
    cmocka_unit_test(a_pendulum_swings_forward_and_backward_in_time),
    cmocka_unit_test(a_failing_function_leaves_the_last_good_step),
    cmocka_unit_test(a_function_that_returns_stop_is_not_called_again),
    cmocka_unit_test(a_restart_works_after_a_failure_and_backwards),
    cmocka_unit_test(a_run_continues_when_the_force_works_again),
    cmocka_unit_test(positions_inside_the_last_step_are_interpolated),
    cmocka_unit_test(too_small_tolerances_make_the_step_fail),
    cmocka_unit_test(a_step_below_the_rounding_of_time_fails),
    cmocka_unit_test(fixed_step_methods_have_their_order),
    cmocka_unit_test(bdf_is_given_a_portion_of_rtol),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
