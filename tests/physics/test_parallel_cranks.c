/* SPDX-License-Identifier: BSD-3-Clause */
/* Three parallel cranks rotate freely, like the wheels of a locomotive. Their pins to ground are
 * not on one line. In every configuration, one row is redundant. Whichever row is omitted, the
 * other rows are singular in some configurations. The choice of the omitted row must therefore
 * change during the motion. With every integrator and formulation, the cranks must move like a
 * pendulum of the same inertia. No singular configuration may be reported. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "models.h"
#include "runs.h"
#include "step_mode.h"

enum { NV = 12 };

static const double ANGLE = 0.3;
static const double RATE = 8.0; /* [rad/s] fast enough for full revolutions */
static const double END = 4.0;  /* [s] about five revolutions */
static const double STEP = 1e-3;
static const double RTOL = 1e-8;

static model make(bool framed)
{
  const model_parallelogram_data data = {
    .which = MODEL_THREE_CRANKS, .angle = ANGLE, .rate = RATE, .above = 1.5, .framed = framed};
  model m;
  check(model_parallelogram_build_of(&data, &m));
  return m;
}

/* ---- the pendulum ---- */

/* Computes derivatives for the cranks. x[0] is their common angle, and x[1] is their common angular
 * velocity. The centre of the coupler moves on a circle of 1 m. */
static void fall(const double x[2], double dx[2])
{
  double inertia = 3.0 / 3.0 + 2.0;
  double weight = (3.0 / 2.0 + 2.0) * 9.81;
  dx[0] = x[1];
  dx[1] = -weight * cos(x[0]) / inertia;
}

/* Returns the angle after the time `span`, computed by the classical Runge-Kutta method with steps
 * of 1e-4 s. It is accurate to 1e-13. */
static double swing(double span)
{
  double x[2] = {ANGLE, RATE};
  int count = (int)lround(span / 1e-4);
  double h = span / count;
  for (int k = 0; k < count; k++) {
    double d[4][2];
    double y[2];
    fall(x, d[0]);
    for (int s = 1; s < 4; s++) {
      double part = s < 3 ? 0.5 * h : h;
      y[0] = x[0] + part * d[s - 1][0];
      y[1] = x[1] + part * d[s - 1][1];
      fall(y, d[s]);
    }
    for (int i = 0; i < 2; i++) {
      x[i] += h / 6.0 * (d[0][i] + 2.0 * d[1][i] + 2.0 * d[2][i] + d[3][i]);
    }
  }
  return x[0];
}

/* ---- full revolutions ---- */

static baum_simulation *start(const model *m, step_mode mode, baum_formulation formulation)
{
  baum_simulation_options options = step_mode_options(mode, STEP, RTOL);
  options.formulation = formulation;
  return create_run(m->mechanism, &options);
}

/* Returns the largest allowed error. Methods of order 1 are too inaccurate at this step to be
 * judged. The errors of other fixed-step methods are the sum of two parts: a multiple of (omega
 * h)^p, where p is the order, and rounding errors. The first part grows with the number of
 * revolutions. With variable steps the limit is 1e5 rtol. BDF and IDA restart whenever the omitted
 * rows change, and have errors of about 1e4 rtol. The errors of other methods are about 10 rtol. */
static double allowed(step_mode mode)
{
  int order = baum_integrator_order(mode.integrator);
  if (!mode.fixed) {
    return 1e5 * RTOL;
  }
  return order > 1 ? fmin(0.1, 1e-11 + 1000.0 * pow(RATE * STEP, order)) : (double)INFINITY;
}

static void go_round(step_mode mode, baum_formulation formulation, double want)
{
  model m = make(false);
  baum_simulation *run = start(&m, mode, formulation);
  check(baum_simulation_advance_to(run, END));
  baum_counters counters = counters_of(run);
  double error = fabs(baum_simulation_q(run)[2] - want);
  printf("%-20s %-8s %-12s error %.1e, violation %.1e\n", baum_integrator_name(mode.integrator),
         mode.fixed ? "fixed" : "variable", baum_formulation_name(formulation), error,
         counters.max_phi);
  assert_true(error <= allowed(mode));
  assert_true(counters.max_phi <= 1e-2);
  assert_int_equal(counters.near_singular_intervals, 0);
  baum_simulation_destroy(run);
  model_destroy(&m);
}

/* With the formulation UNSTABILIZED, the violation grows whenever the omitted rows change
 * (docs/limits.md). */
static void every_method_makes_full_revolutions(void **state)
{
  (void)state;
  double want = swing(END);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      if (baum_integrator_offers(step_mode_at(i).integrator, (baum_formulation)f)) {
        go_round(step_mode_at(i), (baum_formulation)f, want);
      }
    }
  }
}

/* ---- other effects of the choice of rows ---- */

static void goes_on_a_second(const model *m, baum_solver solver)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = STEP;
  options.solver = solver;
  baum_simulation *run = create_run(m->mechanism, &options);
  check(baum_simulation_advance_to(run, 1.0));
  baum_counters counters = counters_of(run);
  assert_true(fabs(baum_simulation_q(run)[2] - swing(1.0)) <= 1e-9);
  assert_int_equal(counters.near_singular_intervals, 0);
  baum_simulation_destroy(run);
}

static void every_solver_makes_full_revolutions(void **state)
{
  (void)state;
  model m = make(false);
  goes_on_a_second(&m, BAUM_SOLVER_BLOCK);
  goes_on_a_second(&m, BAUM_SOLVER_KLU);
  goes_on_a_second(&m, BAUM_SOLVER_QR);
  model_destroy(&m);
}

/* The pin of one crank is on a body that is welded to ground. No row of the weld may be omitted,
 * because the weld alone fixes this body. */
static void rows_that_fix_a_body_are_not_omitted(void **state)
{
  (void)state;
  model m = make(true);
  goes_on_a_second(&m, BAUM_SOLVER_AUTO);
  model_destroy(&m);
}

/* Takes states of one run at times up to 0.8 s, sets them in a second run, and continues from each
 * for 0.2 s. In these states, the rows that the second run chose when it was created may be nearly
 * dependent. */
static void setting_a_state_chooses_again_which_rows_are_omitted(void **state)
{
  (void)state;
  model there = make(false);
  model here = make(false);
  step_mode rk8 = {baum_rk8(), false};
  baum_simulation *from = start(&there, rk8, BAUM_FORMULATION_PROJECTION);
  baum_simulation *to = start(&here, rk8, BAUM_FORMULATION_PROJECTION);
  for (double t = 0.05; t < 0.8; t += 0.05) {
    check(baum_simulation_advance_to(from, t));
    check(baum_simulation_set_state(to, t, baum_simulation_q(from), baum_simulation_v(from)));
    check(baum_simulation_advance_to(to, t + 0.2));
    baum_counters counters = counters_of(to);
    /* The limit is 100 rtol. */
    assert_true(fabs(baum_simulation_q(to)[2] - swing(t + 0.2)) <= 1e-6);
    assert_int_equal(counters.near_singular_intervals, 0);
  }
  baum_simulation_destroy(from);
  baum_simulation_destroy(to);
  model_destroy(&there);
  model_destroy(&here);
}

/* When the omitted rows change, the run must not remove a violation that the user has given. */
static void changing_the_omitted_rows_keeps_a_given_violation(void **state)
{
  (void)state;
  model m = make(false);
  baum_simulation_options options = baum_simulation_options_default();
  double q[NV];
  options.integrator = baum_rk4();
  options.step = STEP;
  options.formulation = BAUM_FORMULATION_UNSTABILIZED;
  options.start = BAUM_START_AS_GIVEN;
  baum_simulation *run = create_run(m.mechanism, &options);
  memcpy(q, baum_simulation_q(run), sizeof q);
  q[0] += 1e-6;
  check(baum_simulation_set_state(run, 0.0, q, baum_simulation_v(run)));
  check(baum_simulation_advance_to(run, 0.3)); /* a third of a revolution */
  assert_true(fabs(baum_simulation_q(run)[0] - cos(baum_simulation_q(run)[2]) / 2) > 1e-7);
  assert_true(fabs(baum_simulation_q(run)[2] - swing(0.3)) <= 1e-3);
  baum_simulation_destroy(run);
  model_destroy(&m);
}

static baum_simulation *start_with_account(const model *m, const baum_integrator *integrator)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.rtol = RTOL;
  options.energy_account = true;
  return create_run(m->mechanism, &options);
}

/* One run is saved, and the buffer is restored in another run, which may omit other rows. After
 * that, the other run must omit the same rows as the saved run. */
static void a_restored_run_omits_the_same_rows_as_the_saved_run(void **state)
{
  (void)state;
  static unsigned char buffer[1 << 16];
  model m = make(false);
  baum_simulation *from = start_with_account(&m, baum_rk8());
  for (double t = 0.1; t < 1.0; t += 0.1) {
    size_t size = 0;
    baum_simulation *to = start_with_account(&m, baum_rk8());
    check(baum_simulation_advance_to(from, t));
    check(baum_simulation_save(from, buffer, sizeof buffer, &size));
    check(baum_simulation_restore(to, buffer, size));
    check(baum_simulation_advance_to(from, t + 0.09));
    check(baum_simulation_advance_to(to, t + 0.09));
    assert_memory_equal(baum_simulation_q(from), baum_simulation_q(to), NV * sizeof(double));
    assert_memory_equal(baum_simulation_v(from), baum_simulation_v(to), NV * sizeof(double));
    baum_simulation_destroy(to);
  }
  baum_simulation_destroy(from);
  model_destroy(&m);
}

static void the_energy_residual_is_small(void **state)
{
  (void)state;
  model m = make(false);
  baum_simulation *run = start_with_account(&m, baum_rk8());
  baum_energy_account account;
  check(baum_simulation_advance_to(run, END));
  check(baum_simulation_energy_account(run, &account, sizeof account));
  assert_true(fabs(account.residual) <= 100.0 * RTOL * account.kinetic);
  baum_simulation_destroy(run);
  model_destroy(&m);
}

/* At every angle, the angular acceleration of the cranks is -weight cos(angle) / inertia, with the
 * same weight and inertia as in fall(). If two cranks are in line with the coupler, the rows of
 * these two cranks alone are singular. */
static void accelerations_are_right_where_the_initial_rows_are_singular(void **state)
{
  (void)state;
  model m = make(false);
  baum_workspace *w = NULL;
  double q[NV];
  double v[NV] = {0.0};
  double a[NV];
  check(baum_workspace_create(m.mechanism, &w));
  for (int k = 0; k <= 200; k++) {
    double angle = 0.05 * k;
    const double feet[3][2] = {{0.0, 0.0}, {2.0, 0.0}, {1.0, 1.5}};
    const int first[3] = {0, 3, 9};
    for (int i = 0; i < 3; i++) {
      q[first[i]] = feet[i][0] + cos(angle) / 2;
      q[first[i] + 1] = feet[i][1] + sin(angle) / 2;
      q[first[i] + 2] = angle;
    }
    q[6] = 1.0 + cos(angle);
    q[7] = sin(angle);
    q[8] = 0.0;
    double want[2];
    fall((double[2]){angle, 0.0}, want);
    check(baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, a, NULL));
    for (int i = 0; i < 3; i++) {
      assert_true(fabs(a[first[i] + 2] - want[1]) <= 1e-11);
    }
    check(baum_workspace_project(w, 0.0, q, v));
  }
  baum_workspace_destroy(w);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_method_makes_full_revolutions),
    cmocka_unit_test(every_solver_makes_full_revolutions),
    cmocka_unit_test(rows_that_fix_a_body_are_not_omitted),
    cmocka_unit_test(setting_a_state_chooses_again_which_rows_are_omitted),
    cmocka_unit_test(changing_the_omitted_rows_keeps_a_given_violation),
    cmocka_unit_test(a_restored_run_omits_the_same_rows_as_the_saved_run),
    cmocka_unit_test(the_energy_residual_is_small),
    cmocka_unit_test(accelerations_are_right_where_the_initial_rows_are_singular),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
