/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests Adams-Bashforth methods: their formulas, target times between grid points, and restarts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "check.h"
#include "integrator_run.h"
#include "one_coordinate.h"
#include "runs.h"

typedef const baum_integrator *method_fn(void);
static method_fn *const METHODS[] = {baum_ab2, baum_ab3, baum_ab4};
enum { METHOD_COUNT = 3, STEPS = 12 };

/* ---- one coordinate: x'' = t^power, or u - x with the input u ---- */

static int push(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)v;
  out[0] = inputs ? inputs[0] - q[0] : pow(t, *(const int *)user);
  return 0;
}

static integrator_setup setup_of(baum_mechanism *mechanism, const baum_integrator *integrator)
{
  integrator_setup setup =
    integrator_setup_make(mechanism, integrator, BAUM_FORMULATION_UNSTABILIZED);
  setup.step = 0.125;
  return setup;
}

/* ---- formulas ---- */

/* A method of order k integrates the force t^p exactly if p < k. This is also true of the
 * Runge-Kutta method that computes the first steps of a run. */
static void forces_of_time_are_integrated_exactly_up_to_the_order(void **state)
{
  (void)state;
  for (int k = 0; k < METHOD_COUNT; k++) {
    const baum_integrator *integrator = METHODS[k]();
    for (int power = 0; power < integrator->order; power++) {
      baum_mechanism *mechanism = one_coordinate(0.0, 0.0, push, &power, NULL);
      integrator_setup setup = setup_of(mechanism, integrator);
      integrator_run run;
      assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
      assert_int_equal(integrator_run_to(&run, 1.5), BAUM_OK);
      ASSERT_NEAR(run.v[0], pow(1.5, power + 1) / (power + 1), 1e-14, 0.0); /* rounding */
      integrator_run_close(&run);
      baum_mechanism_destroy(mechanism);
    }
  }
}

/* For the force t^p with p = k, the velocity error of one step is C k! h^(k+1), where C is the
 * error constant of the method. */
static void a_force_of_the_next_power_shows_the_error_constant(void **state)
{
  static const double CONSTANT[] = {5.0 / 12.0, 3.0 / 8.0, 251.0 / 720.0};
  static const double FACTORIAL[] = {2.0, 6.0, 24.0};
  (void)state;
  for (int k = 0; k < METHOD_COUNT; k++) {
    int power = METHODS[k]()->order;
    baum_mechanism *mechanism = one_coordinate(0.0, 0.0, push, &power, NULL);
    integrator_setup setup = setup_of(mechanism, METHODS[k]());
    integrator_run run;
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    assert_int_equal(integrator_run_to(&run, 0.5), BAUM_OK);
    double before = run.v[0];
    assert_int_equal(integrator_run_to(&run, 1.5), BAUM_OK);
    double exact = (pow(1.5, power + 1) - pow(0.5, power + 1)) / (power + 1);
    double error = exact - (run.v[0] - before);
    double h = setup.step;
    ASSERT_NEAR(error, CONSTANT[k] * FACTORIAL[k] * pow(h, power), 1e-9, 0.0); /* rounding */
    integrator_run_close(&run);
    baum_mechanism_destroy(mechanism);
  }
}

/* A step is x_{n+1} = x_n + h sum b_j x'_{n-j}, and the same formula applies to v. The coefficients
 * b_j must be those from which the library computes stability. */
static void steps_use_the_coefficients_of_the_stability_analysis(void **state)
{
  (void)state;
  for (int k = 0; k < METHOD_COUNT; k++) {
    const baum_integrator *integrator = METHODS[k]();
    const double *b = integrator->method.coefficients;
    baum_mechanism *mechanism = make_oscillator();
    integrator_setup setup = setup_of(mechanism, integrator);
    integrator_run run;
    double x[STEPS];
    double v[STEPS];
    assert_int_equal(integrator->method.kind, BAUM_I_METHOD_ADAMS_BASHFORTH);
    assert_int_equal(integrator->method.degree, integrator->order);
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    for (int n = 0; n < STEPS; n++) {
      x[n] = run.state_q[0];
      v[n] = run.state_v[0];
      assert_int_equal(integrator_run_step(&run), BAUM_OK);
    }
    for (int n = integrator->order; n < STEPS; n++) {
      double want_x = x[n - 1];
      double want_v = v[n - 1];
      for (int j = 0; j < integrator->order; j++) {
        want_x += setup.step * b[j] * v[n - 1 - j];
        want_v += setup.step * b[j] * -4.0 * x[n - 1 - j];
      }
      ASSERT_NEAR(x[n], want_x, 0.0, 1e-15);
      ASSERT_NEAR(v[n], want_v, 0.0, 2e-15);
    }
    integrator_run_close(&run);
    baum_mechanism_destroy(mechanism);
  }
}

/* In a method of order k, each of the first k - 1 steps is a Runge-Kutta step with four
 * evaluations. Each later step needs only one evaluation. */
static void a_step_costs_one_evaluation_after_the_first_steps(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_pendulum();
  for (int k = 0; k < METHOD_COUNT; k++) {
    integrator_setup setup = setup_of(mechanism, METHODS[k]());
    integrator_run run;
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    int64_t before = run.workspace->evaluations;
    assert_int_equal(integrator_run_to(&run, 1.25), BAUM_OK);
    assert_int_equal(run.workspace->evaluations - before, 10 + 3 * (METHODS[k]()->order - 1));
    integrator_run_close(&run);
  }
  baum_mechanism_destroy(mechanism);
}

/* ---- runs of the oscillator x'' = u - x ---- */

static baum_simulation *start_run(const baum_mechanism *mechanism,
                                  const baum_integrator *integrator, double step)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = BAUM_FORMULATION_UNSTABILIZED;
  options.step = step;
  return create_run(mechanism, &options);
}

/* A function that makes a run with a fixed step and returns the error at the end of the run. */
typedef double error_fn(const baum_integrator *integrator, double step);

/* Computes the order of every method from its errors with two step sizes, and checks this order.
 * The larger step size is 2^3 times the smaller one. Error terms of higher order change the result
 * by less than 0.2. */
static void demand_order(error_fn *error)
{
  for (int k = 0; k < METHOD_COUNT; k++) {
    const baum_integrator *integrator = METHODS[k]();
    double coarse = error(integrator, 1.0 / 64.0);
    double fine = error(integrator, 1.0 / 512.0);
    double order = log2(coarse / fine) / 3.0;
    if (!(fabs(order - integrator->order) <= 0.2)) {
      fail_msg("%s: order %.2f, errors %.3g and %.3g", integrator->name, order, coarse, fine);
    }
  }
}

/* An input jumps at t = 1. If the method continued to use derivatives from before the jump, its
 * order would fall to one. */
static double error_with_jump(const baum_integrator *integrator, double step)
{
  baum_input_id u;
  baum_mechanism *mechanism = one_coordinate(1.0, 0.0, push, NULL, &u);
  baum_simulation *run = start_run(mechanism, integrator, step);
  check(baum_simulation_advance_to(run, 1.0));
  check(baum_simulation_set_input(run, u, 3.0));
  check(baum_simulation_advance_to(run, 3.0));
  baum_counters c = counters_of(run);
  assert_int_equal(c.restarts, 1);
  double want = 3.0 + (cos(1.0) - 3.0) * cos(2.0) - sin(1.0) * sin(2.0);
  double error = fabs(baum_simulation_q(run)[0] - want);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return error;
}

static void a_jump_of_an_input_does_not_cost_the_order(void **state)
{
  (void)state;
  demand_order(error_with_jump);
}

/* Two of the target times are between grid points. The last step before each of them is shortened,
 * and the method restarts there. */
static double error_with_short_steps(const baum_integrator *integrator, double step)
{
  baum_input_id u;
  baum_mechanism *mechanism = one_coordinate(1.0, 0.0, push, NULL, &u);
  baum_simulation *run = start_run(mechanism, integrator, step);
  check(baum_simulation_advance_to(run, 1.0 + step / 3.0));
  check(baum_simulation_advance_to(run, 2.0 + 0.4 * step));
  check(baum_simulation_advance_to(run, 3.0 + 0.4 * step));
  baum_counters c = counters_of(run);
  assert_int_equal(c.short_steps, 2);
  assert_int_equal(c.restarts, 2);
  double error = fabs(baum_simulation_q(run)[0] - cos(3.0 + 0.4 * step));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return error;
}

static void targets_off_the_grid_do_not_cost_the_order(void **state)
{
  (void)state;
  demand_order(error_with_short_steps);
}

static double error_there_and_back(const baum_integrator *integrator, double step)
{
  baum_input_id u;
  baum_mechanism *mechanism = one_coordinate(1.0, 0.0, push, NULL, &u);
  baum_simulation *run = start_run(mechanism, integrator, step);
  check(baum_simulation_advance_to(run, 1.0));
  check(baum_simulation_advance_to(run, -2.0));
  double error = fabs(baum_simulation_q(run)[0] - cos(2.0));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return error;
}

static void reversing_does_not_cost_the_order(void **state)
{
  (void)state;
  demand_order(error_there_and_back);
}

/* The motion is x = cos t. At t = 1, the run is set to the state of this motion at t = 5. */
static double error_with_set_state(const baum_integrator *integrator, double step)
{
  baum_input_id u;
  baum_mechanism *mechanism = one_coordinate(1.0, 0.0, push, NULL, &u);
  baum_simulation *run = start_run(mechanism, integrator, step);
  const double q[1] = {cos(5.0)};
  const double v[1] = {-sin(5.0)};
  check(baum_simulation_advance_to(run, 1.0));
  check(baum_simulation_set_state(run, 5.0, q, v));
  check(baum_simulation_advance_to(run, 7.0));
  double error = fabs(baum_simulation_q(run)[0] - cos(7.0));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return error;
}

static void set_state_does_not_cost_the_order(void **state)
{
  (void)state;
  demand_order(error_with_set_state);
}

/* Samples at one third and at two thirds of every step do not change any digit of the motion. The
 * samples are as accurate as the results at grid points. */
static void samples_between_grid_points_are_accurate_and_change_nothing(void **state)
{
  (void)state;
  enum { SAMPLES = 300 };
  const baum_channel channel = baum_channel_of(BAUM_Q);
  double times[SAMPLES];
  double rows[SAMPLES];
  const double step = 1.0 / 64.0;
  for (int i = 0; i < SAMPLES; i++) {
    times[i] = step * (i + 1) / 3.0;
  }
  for (int k = 0; k < METHOD_COUNT; k++) {
    baum_input_id u;
    baum_mechanism *mechanism = one_coordinate(1.0, 0.0, push, NULL, &u);
    baum_simulation *sampled = start_run(mechanism, METHODS[k](), step);
    baum_simulation *plain = start_run(mechanism, METHODS[k](), step);
    check(baum_simulation_sample(sampled, times, SAMPLES, &channel, 1, rows, NULL));
    check(baum_simulation_advance_to(plain, times[SAMPLES - 1]));
    assert_true(baum_simulation_q(sampled)[0] == baum_simulation_q(plain)[0]);
    assert_true(baum_simulation_v(sampled)[0] == baum_simulation_v(plain)[0]);
    double on_grid = 0.0;
    double off_grid = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
      double error = fabs(rows[i] - cos(times[i]));
      double *most = i % 3 == 2 ? &on_grid : &off_grid;
      *most = fmax(*most, error);
    }
    assert_true(on_grid > 0.0);
    assert_true(off_grid <= 1.1 * on_grid); /* one shortened step adds only a little error */
    baum_simulation_destroy(sampled);
    baum_simulation_destroy(plain);
    baum_mechanism_destroy(mechanism);
  }
}

static void projection_is_not_offered(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_pendulum();
  for (int k = 0; k < METHOD_COUNT; k++) {
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = METHODS[k]();
    options.step = 1e-3;
    options.formulation = BAUM_FORMULATION_PROJECTION;
    check_run_refused(mechanism, &options, BAUM_ERR_UNSUPPORTED,
                      "does not offer the formulation projection|offers baumgarte, unstabilized");
    assert_int_equal(METHODS[k]()->formulations[0], BAUM_FORMULATION_BAUMGARTE);
  }
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(forces_of_time_are_integrated_exactly_up_to_the_order),
    cmocka_unit_test(a_force_of_the_next_power_shows_the_error_constant),
    cmocka_unit_test(steps_use_the_coefficients_of_the_stability_analysis),
    cmocka_unit_test(a_step_costs_one_evaluation_after_the_first_steps),
    cmocka_unit_test(a_jump_of_an_input_does_not_cost_the_order),
    cmocka_unit_test(targets_off_the_grid_do_not_cost_the_order),
    cmocka_unit_test(reversing_does_not_cost_the_order),
    cmocka_unit_test(set_state_does_not_cost_the_order),
    cmocka_unit_test(samples_between_grid_points_are_accurate_and_change_nothing),
    cmocka_unit_test(projection_is_not_offered),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
