/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the gains of whole runs: the pilot run of the rule `auto`, the step limit, and the
 * counters. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "models.h"
#include "runs.h"

/* A pilot run makes 5 steps with 3 evaluations each. The first of these evaluations, at the initial
 * state, has already been made. */
enum { PILOT_EVALUATIONS = 14 };

static baum_simulation *start_run(const baum_mechanism *m, const baum_integrator *integrator,
                                  double step, baum_gains gains)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.formulation = BAUM_FORMULATION_BAUMGARTE;
  o.gains = gains;
  o.step = step;
  o.rtol = isnan(step) ? 1e-6 : (double)NAN;
  return create_run(m, &o);
}

static double auto_alpha(const baum_mechanism *m, const baum_integrator *integrator)
{
  baum_simulation *run = start_run(m, integrator, (double)NAN, baum_gains_auto());
  double alpha = counters_of(run).alpha;
  baum_simulation_destroy(run);
  return alpha;
}

/* Makes a pendulum from a particle of 1 kg on a rod of 1 m. The pendulum is at rest at `angle` from
 * the upward vertical. */
static baum_mechanism *pendulum_at(double angle, const baum_user_force_def *force)
{
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  baum_body_id body;
  baum_mechanism *m = create_mechanism();
  bob.position[0] = sin(angle);
  bob.position[1] = cos(angle);
  assert_int_equal(baum_mechanism_add_planar_particle(m, &bob, &body), BAUM_OK);
  rod.body_a = BAUM_GROUND;
  rod.body_b = body;
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  assert_int_equal(baum_mechanism_add_planar_distance(m, &rod, NULL), BAUM_OK);
  if (force) {
    baum_user_force_def on_bob = *force;
    on_bob.bodies = &body;
    on_bob.body_count = 1;
    assert_int_equal(baum_mechanism_add_user_force(m, &on_bob, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

/* ---- the pilot run ---- */

static void auto_uses_the_mean_rate_of_the_pilot_run(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_andrews_bodies(&m), BAUM_OK);
  /* A torque of 0.033 N m accelerates the crank from rest. The rate is max(|v|/L, sqrt(|a|/L)),
   * where L is the characteristic length. This rate is 119 1/s at the start, and its mean over the
   * first 3.75 rad of the exact motion is 336 1/s. The pilot run has five steps, which give this
   * mean to within 20 %. */
  ASSERT_NEAR(auto_alpha(m.mechanism, baum_rk8()), 0.1 * 336.0, 0.2, 0.0);
  model_destroy(&m);
}

static void the_pilot_run_costs_14_evaluations_which_are_counted(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_four_bar(&m), BAUM_OK);
  baum_simulation *with = start_run(m.mechanism, baum_rk4(), 1e-3, baum_gains_auto());
  baum_simulation *without = start_run(m.mechanism, baum_rk4(), 1e-3, baum_gains_fixed(1.0, 1.0));
  assert_int_equal(counters_of(with).evaluations - counters_of(without).evaluations,
                   PILOT_EVALUATIONS);
  assert_int_equal(counters_of(with).steps, 0);
  assert_true(baum_simulation_time(with) == 0.0);
  assert_memory_equal(baum_simulation_q(with), baum_simulation_q(without), 9 * sizeof(double));
  assert_memory_equal(baum_simulation_v(with), baum_simulation_v(without), 9 * sizeof(double));
  assert_non_null(strstr(baum_simulation_explain(with), "1/s, the mean rate over a pilot run)"));
  baum_simulation_destroy(with);
  baum_simulation_destroy(without);
  model_destroy(&m);
}

static void auto_gives_the_same_gains_each_time(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_sundials_slider_crank(&m), BAUM_OK);
  double first = auto_alpha(m.mechanism, baum_rk8());
  assert_true(first > 0.0);
  for (int k = 0; k < 3; k++) {
    assert_true(auto_alpha(m.mechanism, baum_rk8()) == first);
    assert_true(auto_alpha(m.mechanism, baum_dp5()) == first);
  }
  model_destroy(&m);
}

static void auto_does_not_depend_on_units(void **state)
{
  (void)state;
  model si;
  model milli;
  assert_int_equal(model_four_bar(&si), BAUM_OK);
  assert_int_equal(model_four_bar_in(&MODEL_MILLI, &milli), BAUM_OK);
  /* The data in other units are rounded differently. Five steps amplify these rounding errors, so
   * the results are not exactly equal. */
  ASSERT_NEAR(auto_alpha(milli.mechanism, baum_rk8()) * MODEL_MILLI.time,
              auto_alpha(si.mechanism, baum_rk8()), 1e-9, 0.0);
  model_destroy(&si);
  model_destroy(&milli);
}

static void at_a_slow_start_auto_uses_at_least_the_rate_of_gravity(void **state)
{
  (void)state;
  static const double angles[] = {1e-2, 1e-4, 1e-7, 0.0};
  for (int k = 0; k < 4; k++) {
    baum_mechanism *m = pendulum_at(angles[k], NULL);
    double alpha = auto_alpha(m, baum_rk8());
    assert_true(alpha >= 0.1 * sqrt(9.81) * (1.0 - 1e-12));
    assert_true(alpha <= 0.1 * 1.5 * sqrt(9.81)); /* the mean rate is below 1.5 sqrt(g / L) */
    baum_mechanism_destroy(m);
  }
}

static int fail_later(double t, const double *q, const double *v, const double *inputs, double *out,
                      void *user)
{
  (void)q, (void)v, (void)inputs;
  out[0] = out[1] = 0.0;
  return t > *(const double *)user ? -1 : 0;
}

/* The force fails at times that the pilot run reaches. This must not prevent the creation of the
 * run. */
static void a_failure_in_the_pilot_run_does_not_fail_the_creation(void **state)
{
  (void)state;
  static double limit = 0.3;
  baum_user_force_def force = baum_user_force_def_default();
  force.force = fail_later;
  force.user = &limit;
  baum_mechanism *m = pendulum_at(1.6, &force);
  baum_simulation *run = start_run(m, baum_rk4(), 1e-3, baum_gains_auto());
  assert_true(counters_of(run).alpha > 0.0);
  assert_int_equal(counters_of(run).warnings, 0);
  assert_int_equal(baum_simulation_advance_to(run, 0.25), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(run, 0.35), BAUM_ERR_CALLBACK);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void auto_gains_are_larger_if_drivers_take_all_degrees_of_freedom(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = true}, &m), BAUM_OK);
  ASSERT_NEAR(auto_alpha(m.mechanism, baum_rk8()), 2.0 * 150.0, 1e-3, 0.0);
  if (baum_has("sundials")) {
    ASSERT_NEAR(auto_alpha(m.mechanism, baum_cvode_bdf()), 40.0 * 150.0, 1e-3, 0.0);
    ASSERT_NEAR(auto_alpha(m.mechanism, baum_ida()), 40.0 * 150.0, 1e-3, 0.0);
  }
  model_destroy(&m);
}

/* ---- length of steps ---- */

static void steps_of_explicit_methods_stay_in_the_stability_region(void **state)
{
  (void)state;
  static const double ALPHA = 1e4;
  static const double END = 0.05;
  baum_mechanism *m = pendulum_at(1.6, NULL);
  for (int k = 0; k < 2; k++) {
    const baum_integrator *integrator = k == 0 ? baum_dp5() : baum_rk8();
    double limit = 0.0;
    assert_int_equal(baum_stability_limit(integrator, 1.0, &limit), BAUM_OK);
    baum_simulation *run = start_run(m, integrator, (double)NAN, baum_gains_fixed(ALPHA, ALPHA));
    assert_non_null(strstr(baum_simulation_explain(run), "variable step, at most "));
    assert_int_equal(baum_simulation_advance_to(run, END), BAUM_OK);
    assert_true((double)counters_of(run).steps >= END * ALPHA / limit);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* ---- counters ---- */

static void counters_report_the_effective_damping(void **state)
{
  (void)state;
  baum_mechanism *m = pendulum_at(1.6, NULL);
  baum_simulation *run = start_run(m, baum_rk4(), 1e-3, baum_gains_fixed(5.0, 5.0));
  baum_counters c = counters_of(run);
  /* If alpha = beta, the characteristic equation has the double root s = -alpha. A step of rk4
   * multiplies Phi by exp(-alpha h), with an error of about (alpha h)^5 / 120. */
  ASSERT_NEAR(c.spectral_radius, exp(-5e-3), 1e-13, 0.0);
  ASSERT_NEAR(c.damping, 5.0, 1e-9, 0.0);
  baum_simulation_destroy(run);
  run = start_run(m, baum_euler(), 1e-3, baum_gains_deadbeat());
  c = counters_of(run);
  assert_true(c.spectral_radius == 0.0 && isinf(c.damping));
  baum_simulation_destroy(run);
  run = start_run(m, baum_rk8(), (double)NAN, baum_gains_fixed(5.0, 5.0));
  c = counters_of(run);
  assert_true(isnan(c.spectral_radius) && isnan(c.damping));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* ---- factors on the gains of single rows ---- */

/* Makes two particles at rest, one on the x axis and one on the y axis. Both are 1.1 m from the
 * origin, but the rods that join them to the origin are 1 m long. There is no gravity. */
static baum_mechanism *two_long_rods(void)
{
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0), BAUM_OK);
  for (int k = 0; k < 2; k++) {
    baum_planar_particle_def bob = baum_planar_particle_def_default();
    baum_planar_distance_def rod = baum_planar_distance_def_default();
    bob.position[k] = 1.1;
    assert_int_equal(baum_mechanism_add_planar_particle(m, &bob, &rod.body_b), BAUM_OK);
    rod.body_a = BAUM_GROUND;
    memset(rod.point_a, 0, sizeof rod.point_a);
    memset(rod.point_b, 0, sizeof rod.point_b);
    rod.length = 1.0;
    assert_int_equal(baum_mechanism_add_planar_distance(m, &rod, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static baum_simulation_options with_factors(const double *factors, int count, baum_solver solver)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_euler();
  o.formulation = BAUM_FORMULATION_BAUMGARTE;
  o.gains = baum_gains_fixed(10.0, 20.0);
  o.step = 1e-3;
  o.start = BAUM_START_AS_GIVEN;
  o.solver = solver;
  o.row_gains = factors;
  o.row_gain_count = count;
  return o;
}

static void a_factor_multiplies_the_gains_of_its_row(void **state)
{
  (void)state;
  static const double factors[2] = {1.0, 3.0};
  static const baum_solver solvers[3] = {BAUM_SOLVER_BLOCK, BAUM_SOLVER_KLU, BAUM_SOLVER_QR};
  baum_mechanism *m = two_long_rods();
  for (int k = 0; k < 3; k++) {
    baum_simulation_options o = with_factors(factors, 2, solvers[k]);
    baum_simulation *run = create_run(m, &o);
    /* The acceleration along each rod is a = -(beta f)^2 Phi, where f is the factor of its row. Phi
     * depends on how the rows are scaled, so the test compares only the ratio of the two
     * velocities. Across the rods the velocities are zero. */
    assert_true(baum_simulation_step(run, 1) >= BAUM_OK);
    const double *v = baum_simulation_v(run);
    assert_true(v[0] < 0.0);
    ASSERT_NEAR(v[3] / v[0], 9.0, 1e-12, 0.0);
    assert_true(v[1] == 0.0 && v[2] == 0.0);
    /* In the second step, a = -2 alpha f Phi' - (beta f)^2 Phi. The second term adds the same
     * velocity in both steps. The test subtracts this velocity twice, so that only the velocity
     * that comes from the first term remains. */
    double first[2] = {v[0], v[3]};
    assert_true(baum_simulation_step(run, 1) >= BAUM_OK);
    v = baum_simulation_v(run);
    /* Phi has not changed, because the first step of Euler's method leaves q unchanged. gamma
     * contributes less than the tolerance. */
    for (int i = 0; i < 2; i++) {
      double damped = v[3 * i] - 2.0 * first[i];
      double want = -2.0 * 10.0 * factors[i] * 1e-3 * first[i];
      double moved = 400.0 * factors[i] * factors[i] * 1e-3 * 1e-3 * fabs(first[i]);
      ASSERT_NEAR(damped, want, 0.0, 1.3 * moved);
    }
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* The block solver computes the rows of pins from their arms, but reads the rows of a guide from J.
 * In both cases it must apply the factors. */
static void solvers_agree_on_factors(void **state)
{
  (void)state;
  static const double factors[8] = {0.5, 0.5, 2.0, 2.0, 1.0, 3.0, 0.25, 0.75};
  static const baum_solver solvers[2] = {BAUM_SOLVER_BLOCK, BAUM_SOLVER_KLU};
  model m;
  double ends[2][9];
  assert_int_equal(model_slider_crank_build((model_slider_crank){.rough = true}, &m), BAUM_OK);
  for (int k = 0; k < 2; k++) {
    baum_simulation_options o = with_factors(factors, 8, solvers[k]);
    o.step = 1e-4;
    o.gains = baum_gains_fixed(500.0, 500.0);
    baum_simulation *run = create_run(m.mechanism, &o);
    assert_true(baum_simulation_step(run, 20) >= BAUM_OK);
    memcpy(ends[k], baum_simulation_v(run), sizeof ends[k]);
    baum_simulation_destroy(run);
  }
  for (int i = 0; i < 9; i++) {
    ASSERT_NEAR(ends[0][i], ends[1][i], 1e-9, 1e-9); /* at velocities of up to 150 rad/s */
  }
  model_destroy(&m);
}

static void invalid_factors_are_refused(void **state)
{
  (void)state;
  double factors[2] = {1.0, 400.0}; /* alpha h = 0.01 x 400 = 4 is unstable */
  baum_mechanism *m = two_long_rods();
  baum_simulation_options o = with_factors(factors, 2, BAUM_SOLVER_AUTO);
  check_run_refused(m, &o, BAUM_ERR_UNSTABLE, "row_gains[1] = 400, of joint");
  check_run_refused(m, &o, BAUM_ERR_UNSTABLE, "gains alpha = 4000 1/s, beta = 8000 1/s with euler");
  o.row_gain_count = 3;
  check_run_refused(m, &o, BAUM_ERR_ARGUMENT, "row_gain_count is 3, must be nc = 2, the number of");
  o.row_gain_count = 2;
  factors[1] = -1.0;
  check_run_refused(m, &o, BAUM_ERR_ARGUMENT, "row_gains[1], of joint");
  factors[1] = (double)NAN;
  check_run_refused(m, &o, BAUM_ERR_ARGUMENT, "must be finite and > 0");
  factors[1] = 2.0;
  o.gains = (baum_gains){0};
  o.formulation = BAUM_FORMULATION_PROJECTION;
  check_run_refused(m, &o, BAUM_ERR_ARGUMENT, "only baumgarte has gains");
  o.row_gains = NULL;
  check_run_refused(m, &o, BAUM_ERR_ARGUMENT, "row_gain_count is 2, but row_gains is NULL");
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(auto_uses_the_mean_rate_of_the_pilot_run),
    cmocka_unit_test(the_pilot_run_costs_14_evaluations_which_are_counted),
    cmocka_unit_test(auto_gives_the_same_gains_each_time),
    cmocka_unit_test(auto_does_not_depend_on_units),
    cmocka_unit_test(at_a_slow_start_auto_uses_at_least_the_rate_of_gravity),
    cmocka_unit_test(a_failure_in_the_pilot_run_does_not_fail_the_creation),
    cmocka_unit_test(auto_gains_are_larger_if_drivers_take_all_degrees_of_freedom),
    cmocka_unit_test(steps_of_explicit_methods_stay_in_the_stability_region),
    cmocka_unit_test(counters_report_the_effective_damping),
    cmocka_unit_test(a_factor_multiplies_the_gains_of_its_row),
    cmocka_unit_test(solvers_agree_on_factors),
    cmocka_unit_test(invalid_factors_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
