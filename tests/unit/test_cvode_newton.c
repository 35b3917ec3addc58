/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the linear systems of CVODE BDF. They are (I - gamma df/dy) x = r with y = (q, v) and f =
 * (v, a). Each test solves the system for a random right-hand side r with the sparse matrix. It
 * then inserts the solution x into the system, and computes (df/dy) x by central differences of
 * f. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "every_element.h"
#include "models.h"
#include "random_mechanism.h"

#if BAUM_HAVE_SUNDIALS
#include "integrate/cvode_newton.h"
#include "mechanism/manifold.h"

enum { SIZE = 200, STATES = 5, MECHANISMS = 40 };

/* The linear solver of CVODE BDF and the data that it needs, but without CVODE. */
typedef struct solver {
  baum_workspace *workspace;
  baum_i_problem problem;
  baum_i_sundials sundials;
  baum_i_cvode_newton newton;
  int n;             /* nv */
  double unit[SIZE]; /* units of displacements (scale) and of velocities (scale per second) */
} solver;

static void open_solver(solver *s, const baum_mechanism *m, baum_formulation formulation)
{
  *s = (solver){.n = m->nv};
  assert_true(m->nq + m->nv <= SIZE);
  assert_int_equal(baum_workspace_create(m, &s->workspace), BAUM_OK);
  s->problem = (baum_i_problem){.workspace = s->workspace,
                                .formulation = formulation,
                                .alpha = 3.0,
                                .beta = 5.0,
                                .direction = 1.0,
                                .step = (double)NAN,
                                .rtol = 1e-6,
                                .rate = 1.0,
                                .max_step = (double)INFINITY,
                                .tolerance_q = 1.0,
                                .tolerance_v = 1.0,
                                .tolerance_lambda = (double)INFINITY};
  for (int i = 0; i < m->nv; i++) {
    s->unit[i] = s->unit[m->nv + i] = m->scale[i];
  }
  s->sundials.problem = &s->problem;
  assert_int_equal(baum_i_sundials_open(&s->sundials, m->nq + m->nv), BAUM_OK);
  assert_int_equal(baum_i_cvode_newton_open(&s->newton, &s->sundials), BAUM_OK);
}

static void close_solver(solver *s)
{
  baum_i_cvode_newton_close(&s->newton);
  baum_i_sundials_close(&s->sundials);
  baum_workspace_destroy(s->workspace);
}

/* Converts a change y of (q, v) to displacements and velocities (2 nv). */
static void to_tangent(const solver *s, const double *q, const double *y, double *out)
{
  const baum_mechanism *m = s->workspace->mechanism;
  double room[3 * SIZE];
  memcpy(out, baum_i_tangent(m, q, y, room), (size_t)s->n * sizeof *out);
  memcpy(out + s->n, y + m->nq, (size_t)s->n * sizeof *out);
}

/* Solves (I - gamma df/dy) x = r at y = (q, v) as CVODE BDF does. Both x and r consist of
 * displacements and velocities. */
static baum_status solve_newton(solver *s, double t, const double *y, double gamma, const double *r,
                                double *x)
{
  SUNLinearSolver front = s->newton.solver;
  N_Vector right = s->sundials.vectors[0];
  N_Vector solution = s->sundials.vectors[1];
  BAUM_I_TRY(baum_i_cvode_newton_fill(&s->newton, t, y, gamma));
  const baum_mechanism *m = s->workspace->mechanism;
  baum_i_rate(m, y, r, N_VGetArrayPointer(right));
  memcpy(N_VGetArrayPointer(right) + m->nq, r + s->n, (size_t)s->n * sizeof *r);
  bool solved =
    SUNLinSolSetup(front, NULL) == 0 && SUNLinSolSolve(front, NULL, solution, right, 0.0) == 0;
  to_tangent(s, y, N_VGetArrayPointer(solution), x);
  return solved ? BAUM_OK : BAUM_ERR_SINGULAR;
}

/* Evaluates f at y. The result consists of the rates of the displacements, N^+(q) q', and of the
 * accelerations. Returns false if the configuration is singular or nearly so. */
static bool evaluate(const solver *s, double t, const double *q, const double *y, double *f)
{
  const baum_mechanism *m = s->workspace->mechanism;
  double rate[SIZE];
  int64_t before = s->workspace->near_singular;
  baum_status status = baum_i_problem_acceleration(&s->problem, t, y, y + m->nq);
  assert_true(status == BAUM_OK || status == BAUM_ERR_SINGULAR);
  baum_i_rate(m, y, y + m->nq, rate);
  memcpy(rate + m->nq, s->workspace->a, (size_t)s->n * sizeof *rate);
  to_tangent(s, q, rate, f);
  return status == BAUM_OK && s->workspace->near_singular == before;
}

/* Returns the largest component of x, where each component is divided by its unit. */
static double size_of(const solver *s, const double *x)
{
  double largest = 0.0;
  for (int i = 0; i < 2 * s->n; i++) {
    largest = fmax(largest, fabs(x[i]) / s->unit[i]);
  }
  return largest;
}

/* Computes (df/dy) x by a central difference of order 4, with an error of about 1e-12 of the size
 * of f. Returns false if one of the configurations is nearly singular. */
static bool differentiate(const solver *s, double t, const double *y, const double *x, double *out)
{
  static const double places[4] = {-2.0, -1.0, 1.0, 2.0};
  static const double weights[4] = {1.0 / 12.0, -2.0 / 3.0, 2.0 / 3.0, -1.0 / 12.0};
  double step = 1e-3 / size_of(s, x);
  const baum_mechanism *m = s->workspace->mechanism;
  bool regular = true;
  memset(out, 0, 2 * (size_t)s->n * sizeof *out);
  for (int k = 0; k < 4; k++) {
    double moved[SIZE];
    double f[SIZE];
    baum_i_move_from(m, y, places[k] * step, x, moved);
    for (int i = 0; i < s->n; i++) {
      moved[m->nq + i] = y[m->nq + i] + places[k] * step * x[s->n + i];
    }
    regular = evaluate(s, t, y, moved, f) && regular;
    for (int i = 0; i < 2 * s->n; i++) {
      out[i] += weights[k] * f[i] / step;
    }
  }
  return regular;
}

/* Returns |x - gamma (df/dy) x - r| as a fraction of the largest of these three vectors. Returns
 * NaN near a singular configuration. */
static double defect_of(solver *s, double t, const double *y, double gamma, const double *r)
{
  double x[SIZE];
  double change[SIZE];
  double defect[SIZE];
  if (!evaluate(s, t, y, y, change)) {
    return (double)NAN;
  }
  assert_int_equal(solve_newton(s, t, y, gamma, r, x), BAUM_OK);
  bool regular = differentiate(s, t, y, x, change);
  for (int i = 0; i < 2 * s->n; i++) {
    change[i] *= gamma;
    defect[i] = x[i] - change[i] - r[i];
  }
  double size = fmax(size_of(s, r), fmax(size_of(s, x), size_of(s, change)));
  return regular ? size_of(s, defect) / size : (double)NAN;
}

/* The largest defects that the tests accept. A wrong or missing term causes a defect of at least
 * 1e-3. If all terms are correct and all derivatives are given, the defects have a median of 4e-12
 * and a maximum of 4e-8. If the matrix contains differences of user functions, the measured defect
 * reaches 1e-5 near singular configurations. */
static const double EXACT = 1e-6;
static const double BY_DIFFERENCES = 5e-5;

/* Checks random states near the design configuration. These states need not satisfy the
 * constraints. Returns the number of states that are not near a singular configuration. */
static int check_states(solver *s, double tolerance, chance *c)
{
  const double gammas[] = {1e-3, -1e-2, 0.1};
  int checked = 0;
  for (int k = 0; k < STATES; k++) {
    const baum_mechanism *m = s->workspace->mechanism;
    double x[SIZE];
    double y[SIZE];
    double r[SIZE];
    for (int i = 0; i < 2 * s->n; i++) {
      x[i] = s->unit[i] * chance_number(c, -1.0, 1.0);
      r[i] = s->unit[i] * chance_number(c, -1.0, 1.0);
    }
    baum_i_move_from(m, m->design_q, 0.02, x, y);
    memcpy(y + m->nq, x + s->n, (size_t)s->n * sizeof *y);
    baum_i_place_fixed_bodies(m, y);
    baum_i_rest_fixed_bodies(m, y + m->nq);
    baum_i_rest_fixed_bodies(m, r);
    baum_i_rest_fixed_bodies(m, r + s->n);
    double defect = defect_of(s, 0.1 * k, y, gammas[k % 3], r);
    checked += isnan(defect) ? 0 : 1;
    if (defect > tolerance) {
      fail_msg("state %d: defect %.2g", k, defect);
    }
  }
  return checked;
}

/* Checks a mechanism without factors on the gains, and with factors between 0.1 and 10 on the gains
 * of every second row. */
static int check_mechanism(const baum_mechanism *mechanism, baum_formulation formulation,
                           double tolerance, chance *c)
{
  solver s;
  double factors[SIZE];
  open_solver(&s, mechanism, formulation);
  int checked = check_states(&s, tolerance, c);
  for (int i = 0; i < mechanism->nc && i < SIZE; i++) {
    factors[i] = i % 2 == 0 ? 1.0 : pow(10.0, chance_number(c, -1.0, 1.0));
  }
  if (formulation == BAUM_FORMULATION_BAUMGARTE && mechanism->nc <= SIZE) {
    s.workspace->row_gains = factors;
    assert_int_equal(check_states(&s, tolerance, c) > 0, checked > 0);
  }
  close_solver(&s);
  return checked;
}

static void check_model(baum_status status, double tolerance, model *m)
{
  assert_int_equal(status, BAUM_OK);
  chance c = chance_of(7);
  assert_int_equal(check_mechanism(m->mechanism, BAUM_FORMULATION_BAUMGARTE, tolerance, &c),
                   STATES);
  assert_int_equal(check_mechanism(m->mechanism, BAUM_FORMULATION_PROJECTION, tolerance, &c),
                   STATES);
  model_destroy(m);
}

static void models_with_a_motor_springs_and_redundant_rows(void **state)
{
  (void)state;
  model m;
  check_model(model_slider_crank_build((model_slider_crank){.driven = true}, &m), EXACT, &m);
  check_model(model_slider_crank_build((model_slider_crank){.doubled_guide = true}, &m), EXACT, &m);
  check_model(model_andrews_bodies(&m), EXACT, &m);
  check_model(model_parallelogram_build(MODEL_THREE_CRANKS, 1.0, &m), EXACT, &m);
}

static void models_with_user_functions_with_and_without_derivatives(void **state)
{
  (void)state;
  model m;
  check_model(model_andrews_angles(true, &m), BY_DIFFERENCES, &m);
  check_model(model_andrews_angles(false, &m), BY_DIFFERENCES, &m);
  check_model(model_car_axis(false, &m), BY_DIFFERENCES, &m);
}

/* The mechanism contains springs and dampers, both with constants and with laws. It also contains
 * drivers, inputs, user constraints and user forces. */
static void one_of_every_element(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  chance c = chance_of(3);
  assert_int_equal(check_mechanism(parts.mechanism, BAUM_FORMULATION_BAUMGARTE, BY_DIFFERENCES, &c),
                   STATES);
  baum_mechanism_destroy(parts.mechanism);
}

static void bodies_and_joints_of_all_kinds_under_loads(void **state)
{
  (void)state;
  const random_kind kind = {.bodies = 5,
                            .joints = 5,
                            .pins = 30,
                            .particles = 20,
                            .coordinates = 20,
                            .span = 3.0,
                            .loads = 4,
                            .velocity_rows = 2};
  int checked = 0;
  for (uint64_t seed = 1; seed <= MECHANISMS; seed++) {
    static random_mechanism random;
    random_mechanism_make(&random, seed, &kind);
    checked +=
      check_mechanism(random.mechanism, BAUM_FORMULATION_BAUMGARTE, BY_DIFFERENCES, &random.chance);
    random_mechanism_destroy(&random);
  }
  assert_true(checked > MECHANISMS * STATES / 2);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(models_with_a_motor_springs_and_redundant_rows),
    cmocka_unit_test(models_with_user_functions_with_and_without_derivatives),
    cmocka_unit_test(one_of_every_element),
    cmocka_unit_test(bodies_and_joints_of_all_kinds_under_loads),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

#include "without_sundials.h"

#endif
