/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests Runge-Kutta pairs with variable steps: the interpolant, the number of evaluations, and the
 * causes of shorter steps. test_rk_tables.c tests the coefficients of the pairs, and
 * test_integrators.c tests the common properties of all integrators. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/planar.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "integrator_run.h"
#include "one_coordinate.h"

/* ---- both pairs with all formulations ---- */

typedef struct method {
  const baum_integrator *integrator;
  baum_formulation formulation;
  int dense_order;
} method;

typedef void method_test(const method *m);

static void for_each(method_test *test)
{
  const baum_integrator *const pairs[2] = {baum_dp5(), baum_rk8()};
  static const int dense_orders[2] = {4, 7};
  for (int k = 0; k < 2; k++) {
    for (const baum_formulation *f = pairs[k]->formulations; *f; f++) {
      test(&(method){pairs[k], *f, dense_orders[k]});
    }
  }
}

static void open_run(integrator_run *run, baum_mechanism *mechanism, const method *m, double rtol)
{
  integrator_setup setup = integrator_setup_make(mechanism, m->integrator, m->formulation);
  setup.fixed = false;
  setup.rtol = rtol;
  assert_int_equal(integrator_run_open(run, &setup), BAUM_OK);
}

static void interpolate_at(integrator_run *run, double t)
{
  check(run->integrator->interpolate(run->self, &run->problem, t, run->q, run->v));
}

static int64_t rejected(const integrator_run *run)
{
  baum_i_statistics statistics;
  run->integrator->statistics(run->self, &statistics);
  return statistics.rejected;
}

/* ---- the interpolant ---- */

/* Returns the largest error inside the first step. max_step enforces the step h. The tolerance
 * would allow a step that is ten times as long. */
static double error_inside(const method *m, double h)
{
  baum_mechanism *mechanism = make_pendulum();
  integrator_run run;
  double largest = 0.0;
  open_run(&run, mechanism, m, 0.5);
  run.problem.max_step = h;
  assert_int_equal(integrator_run_step(&run), BAUM_OK);
  assert_true(run.state.t == h);
  for (int i = 1; i < 8; i++) {
    double q[2];
    double v[2];
    pendulum_motion(0.125 * i * h, q, v);
    interpolate_at(&run, 0.125 * i * h);
    largest = fmax(largest, motion_error(2, run.q, run.v, q, v, 4.43));
  }
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
  return largest;
}

/* The error inside a step must be of order h^(order + 1). Higher terms increase the measured order
 * slightly. Shorter steps would avoid this, but then the errors would be rounding errors. */
static void check_order_inside(const method *m)
{
  double longest = m->dense_order == 4 ? 0.1 : 0.2;
  double first = error_inside(m, longest);
  double last = error_inside(m, 0.25 * longest);
  double order = log2(first / last) / 2.0 - 1.0;
  if (!(order >= m->dense_order - 0.2 && order <= m->dense_order + 0.8)) {
    fail_msg("%s, %s: order %.2f inside a step, errors %.3g and %.3g", m->integrator->name,
             baum_formulation_name(m->formulation), order, first, last);
  }
}

static void interpolants_have_the_stated_order(void **state)
{
  (void)state;
  for_each(check_order_inside);
}

/* Computes q' at one end of the step from values of the interpolant inside the step, by a one-sided
 * difference of order 2. */
static double rate_at_end(integrator_run *run, double t, double inwards, double at_end)
{
  interpolate_at(run, t + inwards);
  double near = run->q[0];
  interpolate_at(run, t + 2.0 * inwards);
  return (4.0 * near - 3.0 * at_end - run->q[0]) / (2.0 * inwards);
}

/* At both ends of every step, the interpolant must have the q, v and q' of the state. Successive
 * interpolants then form a continuously differentiable curve. */
static void check_joined_steps(const method *m)
{
  baum_mechanism *mechanism = make_pendulum();
  integrator_run run;
  open_run(&run, mechanism, m, 1e-5);
  while (run.state.t < 2.0) {
    baum_i_state before = {.t = run.state.t};
    double q[2] = {run.state_q[0], run.state_q[1]};
    double v[2] = {run.state_v[0], run.state_v[1]};
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
    interpolate_at(&run, before.t);
    assert_memory_equal(run.q, q, sizeof q);
    assert_memory_equal(run.v, v, sizeof v);
    double inwards = 1e-4 * (run.state.t - before.t);
    /* The error of the difference is (1e-4 h)^2 q''' / 3, with h < 0.3 and q''' < 100. */
    ASSERT_NEAR(rate_at_end(&run, before.t, inwards, q[0]), v[0], 0.0, 1e-7);
    ASSERT_NEAR(rate_at_end(&run, run.state.t, -inwards, run.state_q[0]), run.state_v[0], 0.0,
                1e-7);
    interpolate_at(&run, run.state.t);
    for (int i = 0; i < 2; i++) {
      ASSERT_NEAR(run.q[i], run.state_q[i], 0.0, 1e-15);
      ASSERT_NEAR(run.v[i], run.state_v[i], 0.0, 1e-14);
    }
  }
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void interpolants_of_successive_steps_join_smoothly(void **state)
{
  (void)state;
  for_each(check_joined_steps);
}

/* Interpolation must not change any bit of the motion. Interpolation may only add the evaluations
 * of the extra stages, once per step. */
static void check_motion_with_interpolation(const method *m)
{
  baum_mechanism *mechanism = make_pendulum();
  integrator_run plain;
  integrator_run watched;
  open_run(&plain, mechanism, m, 1e-6);
  open_run(&watched, mechanism, m, 1e-6);
  int extra = m->dense_order == 7 ? 3 : 0;
  int64_t looked = 0;
  while (plain.state.t < 3.0) {
    double begin = watched.state.t;
    assert_int_equal(integrator_run_step(&plain), BAUM_OK);
    assert_int_equal(integrator_run_step(&watched), BAUM_OK);
    assert_true(plain.state.t == watched.state.t);
    assert_memory_equal(plain.state_q, watched.state_q, 2 * sizeof(double));
    assert_memory_equal(plain.state_v, watched.state_v, 2 * sizeof(double));
    for (int i = 0; i < 3; i++) {
      interpolate_at(&watched, begin + 0.3 * i * (watched.state.t - begin));
    }
    looked++;
  }
  assert_int_equal(watched.workspace->evaluations - plain.workspace->evaluations, looked * extra);
  integrator_run_close(&plain);
  integrator_run_close(&watched);
  baum_mechanism_destroy(mechanism);
}

static void interpolation_does_not_change_the_motion(void **state)
{
  (void)state;
  for_each(check_motion_with_interpolation);
}

/* ---- steps ---- */

/* A step needs one evaluation for each stage. The first step needs one more. If rk8 interpolates in
 * the last step, this step needs three more. */
static void count_evaluations(const method *m)
{
  baum_mechanism *mechanism = make_pendulum();
  integrator_run run;
  open_run(&run, mechanism, m, 1e-6);
  run.problem.max_step = 0.02;
  int64_t before = run.workspace->evaluations;
  assert_int_equal(integrator_run_to(&run, 0.2), BAUM_OK);
  assert_int_equal(rejected(&run), 0);
  int extra = m->dense_order == 7 && run.state.t != 0.2 ? 3 : 0;
  int stages = m->dense_order == 4 ? 6 : 12;
  assert_int_equal(run.workspace->evaluations - before, 1 + stages * run.steps + extra);
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void a_step_costs_one_evaluation_for_each_stage(void **state)
{
  (void)state;
  for_each(count_evaluations);
}

static void check_max_step(const method *m)
{
  for (int sign = -1; sign <= 1; sign += 2) {
    baum_mechanism *mechanism = make_pendulum();
    integrator_run run;
    open_run(&run, mechanism, m, 1e-2);
    run.problem.max_step = 0.03;
    run.problem.direction = sign;
    double before = 0.0;
    while (fabs(run.state.t) < 0.5) {
      assert_int_equal(integrator_run_step(&run), BAUM_OK);
      double h = sign * (run.state.t - before);
      /* The step h is a difference of two times, which are rounded. */
      assert_true(h > 0.0 && h <= 0.03 + 1e-16);
      before = run.state.t;
    }
    integrator_run_close(&run);
    baum_mechanism_destroy(mechanism);
  }
}

static void no_step_is_longer_than_max_step(void **state)
{
  (void)state;
  for_each(check_max_step);
}

/* If max_step changes between two steps, the next step must obey it. */
static void a_new_max_step_acts_at_once(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_throw();
  integrator_run run;
  open_run(&run, mechanism, &(method){baum_rk8(), BAUM_FORMULATION_BAUMGARTE, 7}, 1e-2);
  for (int k = 1; k <= 5; k++) {
    double before = run.state.t;
    run.problem.max_step = 0.01 * k;
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
    ASSERT_NEAR(run.state.t - before, 0.01 * k, 0.0, 1e-15);
  }
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

/* ---- causes of shorter steps ---- */

/* A force of zero that fails in calls number `from` to from + times - 1. Calls are counted from
 * 0. */
typedef struct hiccup {
  int calls;
  int from;
  int times;
  int answer; /* 0: the force sets NaN */
} hiccup;

static int answer_hiccup(double t, const double *q, const double *v, const double *inputs,
                         double *out, void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  hiccup *h = user;
  int call = h->calls++;
  bool fails = call >= h->from && call < h->from + h->times;
  if (fails && h->answer == 0) {
    out[0] = (double)NAN;
    return 0;
  }
  return fails ? h->answer : 0;
}

static baum_mechanism *make_hiccup(hiccup *h)
{
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  baum_user_force_def force = baum_user_force_def_default();
  baum_body_id id;
  baum_mechanism *mechanism = create_mechanism();
  bob.position[0] = 1.0;
  bob.velocity[0] = bob.velocity[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_particle(mechanism, &bob, &id), BAUM_OK);
  rod.body_a = BAUM_GROUND;
  rod.body_b = id;
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  assert_int_equal(baum_mechanism_add_planar_distance(mechanism, &rod, NULL), BAUM_OK);
  force.bodies = &id;
  force.body_count = 1;
  force.force = answer_hiccup;
  force.user = h;
  assert_int_equal(baum_mechanism_add_user_force(mechanism, &force, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  return mechanism;
}

/* After the run has reached 0.06 s, the force fails in calls number `from` and from + 1. Each
 * failure halves the step, which is then repeated. The motion must be accurate nevertheless. */
static void check_recovery(const method *m)
{
  for (int answer = 0; answer <= 1; answer++) {
    for (int from = 1; from <= 26; from++) {
      hiccup h = {.answer = answer, .times = 0};
      baum_mechanism *mechanism = make_hiccup(&h);
      integrator_run run;
      double q[2];
      double v[2];
      open_run(&run, mechanism, m, 1e-8);
      run.problem.max_step = 0.05;
      assert_int_equal(integrator_run_to(&run, 0.06), BAUM_OK);
      h = (hiccup){.answer = answer, .from = from, .times = 2};
      int64_t before = rejected(&run);
      assert_int_equal(integrator_run_to(&run, 1.0), BAUM_OK);
      assert_in_range(rejected(&run) - before, 2, 2);
      pendulum_motion(1.0, q, v);
      assert_true(motion_error(2, run.q, run.v, q, v, 4.43) <= 1e-6);
      integrator_run_close(&run);
      baum_mechanism_destroy(mechanism);
    }
  }
}

static void runs_recover_from_evaluations_that_fail_twice(void **state)
{
  (void)state;
  for_each(check_recovery);
}

/* The force x'^2 acts on 1 kg. If x'(0) = 1 m/s, the motion is x' = 1 / (1 - t), which becomes
 * infinite at t = 1 s. */
static int push(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)t;
  (void)q;
  (void)inputs;
  (void)user;
  out[0] = v[0] * v[0];
  return 0;
}

static void a_motion_without_bound_ends_with_a_step_error(void **state)
{
  (void)state;
  const baum_integrator *const pairs[2] = {baum_dp5(), baum_rk8()};
  for (int k = 0; k < 2; k++) {
    baum_mechanism *mechanism = one_coordinate(0.0, 1.0, push, NULL, NULL);
    integrator_run run;
    open_run(&run, mechanism, &(method){pairs[k], BAUM_FORMULATION_UNSTABILIZED, 0}, 1e-6);
    assert_int_equal(integrator_run_to(&run, 2.0), BAUM_ERR_STEP);
    assert_non_null(strstr(baum_message(), "grow without bound"));
    assert_non_null(strstr(baum_message(), pairs[k]->name));
    /* The exact motion becomes infinite at t = 1 s. Errors of the steps shift this time a
     * little. */
    assert_true(isfinite(run.state_q[0]) && isfinite(run.state_v[0]));
    ASSERT_NEAR(run.state.t, 1.0, 0.0, 1e-4);
    integrator_run_close(&run);
    baum_mechanism_destroy(mechanism);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(interpolants_have_the_stated_order),
    cmocka_unit_test(interpolants_of_successive_steps_join_smoothly),
    cmocka_unit_test(interpolation_does_not_change_the_motion),
    cmocka_unit_test(a_step_costs_one_evaluation_for_each_stage),
    cmocka_unit_test(no_step_is_longer_than_max_step),
    cmocka_unit_test(a_new_max_step_acts_at_once),
    cmocka_unit_test(runs_recover_from_evaluations_that_fail_twice),
    cmocka_unit_test(a_motion_without_bound_ends_with_a_step_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
