/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the residuals F(t, y, y') that IDA solves. Their Jacobians must agree with differences, and
 * the residuals must be zero at the solution of the equations of motion. Equations (5) and (7) are
 * those of docs/theory/formulations.md. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "dynamics/dynamics.h"
#include "every_element.h"
#include "joint_scenes.h"
#include "mechanism/manifold.h"
#include "models.h"

enum { SIZE_MAX_DAE = 360, STATES = 5 };

static const baum_residual FORMS[] = {BAUM_RESIDUAL_INDEX1, BAUM_RESIDUAL_INDEX2,
                                      BAUM_RESIDUAL_INDEX3, BAUM_RESIDUAL_GGL};
enum { FORM_COUNT = sizeof FORMS / sizeof FORMS[0] };

/* Returns the k-th number of a fixed sequence in [-1, 1]. */
static double scatter(int k)
{
  double x = 0.6180339887498949 * (k + 1);
  return 2.0 * (x - floor(x)) - 1.0;
}

/* The arguments y and y' of a residual. The columns of its Jacobian belong to the displacements of
 * q, to v and to the multipliers. */
typedef struct point {
  const baum_mechanism *mechanism;
  double y[SIZE_MAX_DAE];
  double dy[SIZE_MAX_DAE];
  double scale[SIZE_MAX_DAE]; /* scales of the columns */
  int size;                   /* number of columns */
  int shift;                  /* nq - nv: v and the multipliers in column j are y[j + shift] */
} point;

/* Sets the scales of the columns. With these scales, the results of the tests do not depend on
 * units. Coordinates have their own scales. The scale of a velocity is the scale of its coordinate,
 * divided by one second. The scale of a multiplier lambda is E / d. Here E is the largest value of
 * m scale^2 / s^2 among all coordinates, where m is the mass of a coordinate and s is one second.
 * d is the norm of the row of J that belongs to the lambda, with columns multiplied by the scales
 * of the coordinates. The scale of a multiplier mu of GGL is the scale of the lambda of the same
 * row, multiplied by one second. */
static void set_scales(baum_workspace *w, point *p)
{
  const baum_mechanism *m = w->mechanism;
  double displacement[SIZE_MAX_DAE];
  double energy = 0.0;
  assert_int_equal(baum_i_need_metric(w), BAUM_OK);
  assert_int_equal(baum_i_position_stage(w, 0.0, m->design_q), BAUM_OK);
  baum_i_row_displacements(w, displacement);
  for (int i = 0; i < m->nv; i++) {
    p->scale[i] = p->scale[m->nv + i] = m->scale[i];
    energy = fmax(energy, w->metric[i] * m->scale[i] * m->scale[i]);
  }
  for (int i = 2 * m->nv; i < p->size; i++) {
    p->scale[i] = energy / displacement[(i - 2 * m->nv) % m->nc];
  }
}

/* Returns a random state near the design configuration. Its velocities, accelerations and
 * multipliers are at most as large as their scales. */
static point random_point(baum_workspace *w, baum_residual index, int seed)
{
  const baum_mechanism *m = w->mechanism;
  point p = {.mechanism = m, .shift = m->nq - m->nv};
  double moved[SIZE_MAX_DAE];
  double rate[SIZE_MAX_DAE];
  p.size = baum_i_residual_size(m, index) - p.shift;
  assert_true(p.size + p.shift <= SIZE_MAX_DAE);
  set_scales(w, &p);
  for (int i = 0; i < p.size; i++) {
    moved[i] = 0.1 * p.scale[i] * scatter(seed + i);
    rate[i] = p.scale[i] * scatter(seed + 1000 + i);
    if (i >= m->nv) {
      p.y[i + p.shift] = p.scale[i] * scatter(seed + i);
      p.dy[i + p.shift] = rate[i];
    }
  }
  baum_i_move_from(m, m->design_q, 1.0, moved, p.y);
  baum_i_rate(m, p.y, rate, p.dy);
  return p;
}

/* Changes y by `step` along column j, and y' by c times this change. */
static void move_along(point *p, double c, int j, double step)
{
  const baum_mechanism *m = p->mechanism;
  if (j >= m->nv) {
    p->y[j + p->shift] += step;
    p->dy[j + p->shift] += c * step;
    return;
  }
  double unit[SIZE_MAX_DAE] = {0.0};
  double from[SIZE_MAX_DAE];
  unit[j] = 1.0;
  memcpy(from, p->y, sizeof from);
  baum_i_move(m, step, unit, p->y);
  for (int i = 0; i < m->nq; i++) {
    p->dy[i] += c * (p->y[i] - from[i]);
  }
}

/* Computes column j of dF/dy + c dF/dy' by a central difference of the residual F. The
 * pseudo-inverse N^+ converts the nq rows of q' - N v to nv rows. */
static void difference_column(baum_workspace *w, const baum_dae *dae, double c, const point *p,
                              int j, double *column)
{
  const baum_mechanism *m = p->mechanism;
  double residuals[2][SIZE_MAX_DAE];
  double room[3 * SIZE_MAX_DAE];
  double step = 1e-5 * p->scale[j];
  for (int k = 0; k < 2; k++) {
    point moved = *p;
    move_along(&moved, c, j, k == 0 ? -step : step);
    assert_int_equal(baum_i_residual(w, dae, 0.3, moved.y, moved.dy, residuals[k]), BAUM_OK);
  }
  for (int i = 0; i < p->size + p->shift; i++) {
    residuals[1][i] = (residuals[1][i] - residuals[0][i]) / (2.0 * step);
  }
  memcpy(column, baum_i_tangent(m, p->y, residuals[1], room), (size_t)m->nv * sizeof *column);
  memcpy(column + m->nv, residuals[1] + m->nq, (size_t)(p->size - m->nv) * sizeof *column);
}

typedef struct square {
  double at[SIZE_MAX_DAE][SIZE_MAX_DAE]; /* row-major */
} square;

static void difference_all(baum_workspace *w, const baum_dae *dae, double c, const point *p,
                           square *out)
{
  for (int j = 0; j < p->size; j++) {
    double column[SIZE_MAX_DAE];
    difference_column(w, dae, c, p, j, column);
    for (int i = 0; i < p->size; i++) {
      out->at[i][j] = column[i];
    }
  }
}

static void write_dense(const baum_i_residual_matrix *matrix, const double *values, int size,
                        square *out)
{
  const int32_t *columns = baum_i_residual_matrix_pattern(matrix)->start;
  const int32_t *rows = baum_i_residual_matrix_pattern(matrix)->row;
  memset(out, 0, sizeof *out);
  for (int j = 0; j < size; j++) {
    for (int32_t k = columns[j]; k < columns[j + 1]; k++) {
      assert_true(k == columns[j] || rows[k] > rows[k - 1]);
      out->at[rows[k]][j] = values[k];
    }
  }
}

/* Returns the largest difference between corresponding scaled entries, as a fraction of the largest
 * entry in their row. */
static double largest_difference(const square *got, const square *want, const point *p)
{
  double worst = 0.0;
  for (int i = 0; i < p->size; i++) {
    double largest = DBL_MIN;
    double apart = 0.0;
    for (int j = 0; j < p->size; j++) {
      double difference = fabs(got->at[i][j] - want->at[i][j]) * p->scale[j];
      largest = fmax(largest, fabs(want->at[i][j]) * p->scale[j]);
      apart = isnan(difference) || difference > apart ? difference : apart;
    }
    worst = isnan(apart) || apart / largest > worst ? apart / largest : worst;
  }
  return worst;
}

static double check_jacobian(baum_workspace *w, baum_residual index)
{
  static square got;
  static square want;
  const baum_dae dae = {index, 3.0, 5.0};
  const double c = 7.0;
  double worst = 0.0;
  baum_i_residual_matrix *matrix = NULL;
  assert_int_equal(baum_i_residual_matrix_create(w, index, &matrix), BAUM_OK);
  const baum_i_compressed *pattern = baum_i_residual_matrix_pattern(matrix);
  double *values = malloc((size_t)pattern->start[pattern->n] * sizeof *values);
  for (int k = 0; k < STATES; k++) {
    point p = random_point(w, index, 97 * k);
    assert_int_equal(baum_i_residual_matrix_fill(matrix, w, &dae, c, 0.3, p.y, p.dy, values),
                     BAUM_OK);
    write_dense(matrix, values, p.size, &got);
    difference_all(w, &dae, c, &p, &want);
    worst = fmax(worst, largest_difference(&got, &want, &p));
  }
  free(values);
  baum_i_residual_matrix_destroy(matrix);
  return worst;
}

/* Central differences with a step of 1e-5 of the scale have a truncation error of 1e-10 and also
 * rounding errors. If a user function gives no Jacobian, the matrix itself also contains
 * differences. A wrong term causes a deviation of 1e-3 or more. */
static void check_all_forms(const char *name, const baum_mechanism *mechanism)
{
  for (int f = 0; f < FORM_COUNT; f++) {
    baum_workspace *w = NULL;
    assert_int_equal(baum_workspace_create(mechanism, &w), BAUM_OK);
    double worst = check_jacobian(w, FORMS[f]);
    print_message("%-24s form %d: %.1e\n", name, (int)FORMS[f], worst);
    if (!(worst <= 2e-7)) {
      fail_msg("%s, form %d: %g", name, (int)FORMS[f], worst);
    }
    baum_workspace_destroy(w);
  }
}

/* Checks the residual of index 1 with factors on the gains of the rows. The factors are from 0.1 to
 * 10. */
static void check_row_gains(const char *name, const baum_mechanism *mechanism)
{
  double factors[SIZE_MAX_DAE];
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(mechanism, &w), BAUM_OK);
  for (int i = 0; i < mechanism->nc; i++) {
    factors[i] = pow(10.0, scatter(i));
  }
  w->row_gains = factors;
  double worst = check_jacobian(w, BAUM_RESIDUAL_INDEX1);
  if (!(worst <= 2e-7)) { /* the same tolerance as in check_all_forms() */
    fail_msg("%s, gains of rows: %g", name, worst);
  }
  baum_workspace_destroy(w);
}

static void check_model(const char *name, baum_status status, model *m)
{
  assert_int_equal(status, BAUM_OK);
  check_all_forms(name, m->mechanism);
  check_row_gains(name, m->mechanism);
  model_destroy(m);
}

static void the_jacobian_agrees_with_differences_for_bodies_with_a_motor(void **state)
{
  (void)state;
  model m;
  check_model("slider-crank", model_slider_crank_build((model_slider_crank){.driven = true}, &m),
              &m);
  check_model(
    "slider-crank, mm",
    model_slider_crank_build((model_slider_crank){.driven = true, .units = &MODEL_MILLI}, &m), &m);
}

static void the_jacobian_agrees_with_differences_for_redundant_rows(void **state)
{
  (void)state;
  model m;
  check_model("two guides",
              model_slider_crank_build((model_slider_crank){.doubled_guide = true}, &m), &m);
}

/* The entries of the metric W of GGL are masses, but not less than a lower bound. In this test one
 * body has no mass, so its entry is the lower bound. */
static void the_jacobian_agrees_with_differences_for_a_body_without_mass(void **state)
{
  (void)state;
  model m;
  check_model("parallelogram", model_parallelogram_build(MODEL_THIRD_BY_A_ROD, 1.0, &m), &m);
}

static void the_jacobian_agrees_with_differences_for_every_element(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  check_all_forms("every element", parts.mechanism);
  check_row_gains("every element", parts.mechanism);
  baum_mechanism_destroy(parts.mechanism);
}

static void the_jacobian_agrees_with_differences_for_every_joint(void **state)
{
  (void)state;
  for (int k = 0; k < JOINT_SCENES; k++) {
    baum_mechanism *mechanism = joint_scene_make(&joint_scenes[k]);
    check_all_forms(joint_scenes[k].name, mechanism);
    check_row_gains(joint_scenes[k].name, mechanism);
    baum_mechanism_destroy(mechanism);
  }
}

static void the_jacobian_agrees_with_differences_for_bodies_with_a_spring(void **state)
{
  (void)state;
  model m;
  check_model("Andrews", model_andrews_bodies(&m), &m);
  check_model("Andrews, mm", model_andrews_bodies_in(&MODEL_MILLI, &m), &m);
}

static void the_jacobian_agrees_with_differences_for_user_functions(void **state)
{
  (void)state;
  model m;
  check_model("Andrews, angles", model_andrews_angles(true, &m), &m);
  check_model("Andrews, Phi only", model_andrews_angles(false, &m), &m);
}

static void the_jacobian_agrees_with_differences_for_rows_that_depend_on_time(void **state)
{
  (void)state;
  model m;
  check_model("car axis", model_car_axis(true, &m), &m);
}

static void check_index_1_at_the_solution(const double *row_gains)
{
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = true}, &m), BAUM_OK);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(m.mechanism, &w), BAUM_OK);
  w->row_gains = row_gains;
  const baum_dae dae = {BAUM_RESIDUAL_INDEX1, 30.0, 50.0};
  point p = random_point(w, BAUM_RESIDUAL_INDEX1, 5);
  int nv = m.mechanism->nv;
  int nc = m.mechanism->nc;
  assert_int_equal(
    baum_workspace_acceleration(w, 0.3, p.y, p.y + nv, 30.0, 50.0, p.dy + nv, p.y + 2 * nv),
    BAUM_OK);
  memcpy(p.dy, p.y + nv, (size_t)nv * sizeof(double));
  double residual[SIZE_MAX_DAE];
  assert_int_equal(baum_workspace_residual(w, &dae, 0.3, p.y, p.dy, residual), BAUM_OK);
  double size = 1.0;
  for (int i = 0; i < 2 * nv + nc; i++) {
    size = fmax(size, fmax(fabs(p.y[i]), fabs(p.dy[i])));
  }
  for (int i = 0; i < 2 * nv + nc; i++) {
    /* The tolerance is the rounding error of sums whose terms are as large as `size`. */
    ASSERT_NEAR(residual[i], 0.0, 0.0, 1e-13 * size);
  }
  baum_workspace_destroy(w);
  model_destroy(&m);
}

static void the_index_1_residual_vanishes_at_the_solution_of_the_stabilized_equations(void **state)
{
  (void)state;
  double factors[SIZE_MAX_DAE];
  for (int i = 0; i < SIZE_MAX_DAE; i++) {
    factors[i] = pow(10.0, 0.5 * scatter(i));
  }
  check_index_1_at_the_solution(NULL);
  check_index_1_at_the_solution(factors);
}

/* At a state on the constraints, the residual is zero for the accelerations and multipliers of (5)
 * and for mu = 0. A mu that is not zero changes only the first nv rows, by W^-1 J^T mu. */
static void the_ggl_residual_vanishes_on_the_constraints_with_mu_zero(void **state)
{
  (void)state;
  model m;
  assert_int_equal(
    model_slider_crank_build((model_slider_crank){.driven = true, .moving = true}, &m), BAUM_OK);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(m.mechanism, &w), BAUM_OK);
  const baum_dae dae = {.index = BAUM_RESIDUAL_GGL};
  int nv = m.mechanism->nv;
  int nc = m.mechanism->nc;
  point p = {.size = 2 * nv + 2 * nc};
  double residual[SIZE_MAX_DAE];
  double jacobian[SIZE_MAX_DAE * SIZE_MAX_DAE];
  double mass[SIZE_MAX_DAE * SIZE_MAX_DAE];
  assert_int_equal(baum_workspace_design(w, p.y, p.y + nv), BAUM_OK);
  assert_int_equal(
    baum_workspace_acceleration(w, 0.0, p.y, p.y + nv, 0.0, 0.0, p.dy + nv, p.y + 2 * nv), BAUM_OK);
  memcpy(p.dy, p.y + nv, (size_t)nv * sizeof(double));
  assert_int_equal(baum_workspace_residual(w, &dae, 0.0, p.y, p.dy, residual), BAUM_OK);
  double size = 1.0;
  for (int i = 0; i < 2 * nv + nc; i++) {
    size = fmax(size, fmax(fabs(p.y[i]), fabs(p.dy[i])));
  }
  for (int i = 0; i < p.size; i++) {
    /* The tolerance is the rounding error of sums whose terms are as large as `size`. */
    ASSERT_NEAR(residual[i], 0.0, 0.0, 1e-13 * size);
  }
  p.y[2 * nv + nc] = 0.5;
  assert_int_equal(baum_workspace_residual(w, &dae, 0.0, p.y, p.dy, residual), BAUM_OK);
  assert_int_equal(baum_workspace_jacobian(w, 0.0, p.y, jacobian), BAUM_OK);
  assert_int_equal(baum_workspace_mass(w, 0.0, p.y, mass), BAUM_OK);
  for (int i = 0; i < nv; i++) {
    /* In this mechanism W is the diagonal of M, because no entry is at the lower bound. */
    ASSERT_NEAR(residual[i], 0.5 * jacobian[i] / mass[i * nv + i], 1e-13, 1e-13 * size);
  }
  baum_workspace_destroy(w);
  model_destroy(&m);
}

static void the_public_jacobian_first_reports_its_size(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(m.mechanism, &w), BAUM_OK);
  const baum_dae dae = {BAUM_RESIDUAL_INDEX3, 0.0, 0.0};
  const double y[5] = {-1.0, 0.0, 0.0, 0.0, 0.0};
  const double dy[5] = {0};
  baum_sparse sparse = {0};
  assert_int_equal(baum_workspace_residual_jacobian(w, &dae, 1.0, 0.0, y, dy, &sparse), BAUM_OK);
  assert_true(sparse.nonzeros > 0 && sparse.nonzeros <= 25);
  int32_t columns[6];
  int32_t rows[25];
  double values[25];
  sparse = (baum_sparse){columns, rows, values, 0};
  assert_int_equal(baum_workspace_residual_jacobian(w, &dae, 1.0, 0.0, y, dy, &sparse), BAUM_OK);
  assert_int_equal(columns[5], sparse.nonzeros);
  assert_int_equal(baum_workspace_residual_jacobian(w, &dae, NAN, 0.0, y, dy, &sparse),
                   BAUM_ERR_ARGUMENT);
  baum_workspace_destroy(w);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_jacobian_agrees_with_differences_for_bodies_with_a_motor),
    cmocka_unit_test(the_jacobian_agrees_with_differences_for_bodies_with_a_spring),
    cmocka_unit_test(the_jacobian_agrees_with_differences_for_redundant_rows),
    cmocka_unit_test(the_jacobian_agrees_with_differences_for_a_body_without_mass),
    cmocka_unit_test(the_jacobian_agrees_with_differences_for_every_element),
    cmocka_unit_test(the_jacobian_agrees_with_differences_for_every_joint),
    cmocka_unit_test(the_jacobian_agrees_with_differences_for_user_functions),
    cmocka_unit_test(the_jacobian_agrees_with_differences_for_rows_that_depend_on_time),
    cmocka_unit_test(the_index_1_residual_vanishes_at_the_solution_of_the_stabilized_equations),
    cmocka_unit_test(the_ggl_residual_vanishes_on_the_constraints_with_mu_zero),
    cmocka_unit_test(the_public_jacobian_first_reports_its_size),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
