/* SPDX-License-Identifier: BSD-3-Clause */
/* Residual forms and their Jacobian: against differences, and zero at the solution of (7). */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "dynamics/dynamics.h"
#include "models.h"

enum { SIZE_MAX_DAE = 80, STATES = 5 };

/* Deterministic numbers in [-1, 1]. */
static double scatter(int k)
{
  double x = 0.6180339887498949 * (k + 1);
  return 2.0 * (x - floor(x)) - 1.0;
}

typedef struct point {
  double y[SIZE_MAX_DAE];
  double dy[SIZE_MAX_DAE];
  int size;
} point;

/* A state near the drawing with velocities, accelerations and multipliers of size 1. */
static point random_point(const baum_mechanism *m, int seed)
{
  point p = {.size = 2 * m->nv + m->nc};
  assert_true(p.size <= SIZE_MAX_DAE);
  for (int i = 0; i < p.size; i++) {
    p.y[i] = scatter(seed + i);
    p.dy[i] = scatter(seed + 1000 + i);
  }
  for (int i = 0; i < m->nq; i++) {
    p.y[i] = m->drawn_q[i] + 0.1 * m->scale[i] * scatter(seed + i);
  }
  return p;
}

/* Column j of dF/dy + c dF/dy', by central differences of the residual along (e_j, c e_j). */
static void difference_column(baum_workspace *w, const baum_dae *dae, double c, point p, int j,
                              double *column)
{
  double high[SIZE_MAX_DAE];
  double low[SIZE_MAX_DAE];
  double step = 1e-5;
  double y = p.y[j];
  double dy = p.dy[j];
  p.y[j] = y + step;
  p.dy[j] = dy + c * step;
  assert_int_equal(baum_i_residual(w, dae, 0.3, p.y, p.dy, high), BAUM_OK);
  p.y[j] = y - step;
  p.dy[j] = dy - c * step;
  assert_int_equal(baum_i_residual(w, dae, 0.3, p.y, p.dy, low), BAUM_OK);
  for (int i = 0; i < p.size; i++) {
    column[i] = (high[i] - low[i]) / (2.0 * step);
  }
}

static void check_column(const baum_i_residual_matrix *matrix, const double *values, int j,
                         const double *want, int size)
{
  const int32_t *columns = baum_i_residual_matrix_columns(matrix);
  const int32_t *rows = baum_i_residual_matrix_rows(matrix);
  double got[SIZE_MAX_DAE] = {0};
  for (int32_t k = columns[j]; k < columns[j + 1]; k++) {
    assert_true(k == columns[j] || rows[k] > rows[k - 1]);
    got[rows[k]] = values[k];
  }
  double largest = 1.0;
  for (int i = 0; i < size; i++) {
    largest = fmax(largest, fabs(want[i]));
  }
  for (int i = 0; i < size; i++) {
    /* Truncation of a central difference with step 1e-5 and its rounding: 1e-10 of the largest entry and of the
     * residual, which is larger than the entries; the Jacobian of user functions is itself a difference. */
    ASSERT_NEAR(got[i], want[i], 2e-6, 2e-6 * largest);
  }
}

static void check_jacobian(baum_workspace *w, baum_residual index)
{
  const baum_dae dae = {index, 3.0, 5.0};
  const double c = 7.0;
  baum_i_residual_matrix *matrix = NULL;
  assert_int_equal(baum_i_residual_matrix_create(w, index, &matrix), BAUM_OK);
  double *values = malloc((size_t)baum_i_residual_matrix_nonzeros(matrix) * sizeof *values);
  for (int k = 0; k < STATES; k++) {
    point p = random_point(w->mechanism, 97 * k);
    assert_int_equal(baum_i_residual_matrix_fill(matrix, w, &dae, c, 0.3, p.y, p.dy, values),
                     BAUM_OK);
    for (int j = 0; j < p.size; j++) {
      double want[SIZE_MAX_DAE];
      difference_column(w, &dae, c, p, j, want);
      check_column(matrix, values, j, want, p.size);
    }
  }
  free(values);
  baum_i_residual_matrix_destroy(matrix);
}

static void check_model(baum_status status, model *m)
{
  assert_int_equal(status, BAUM_OK);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(m->mechanism, &w), BAUM_OK);
  check_jacobian(w, BAUM_RESIDUAL_INDEX1);
  check_jacobian(w, BAUM_RESIDUAL_INDEX3);
  baum_workspace_destroy(w);
  model_destroy(m);
}

static void the_jacobian_is_that_of_differences_for_bodies_with_a_motor(void **state)
{
  (void)state;
  model m;
  check_model(model_slider_crank_build((model_slider_crank){.driven = true}, &m), &m);
}

static void the_jacobian_is_that_of_differences_for_bodies_with_a_spring(void **state)
{
  (void)state;
  model m;
  check_model(model_andrews_bodies(&m), &m);
}

static void the_jacobian_is_that_of_differences_for_user_functions(void **state)
{
  (void)state;
  model m;
  check_model(model_andrews_angles(true, &m), &m);
  check_model(model_andrews_angles(false, &m), &m);
}

static void the_jacobian_is_that_of_differences_for_rows_that_depend_on_time(void **state)
{
  (void)state;
  model m;
  check_model(model_car_axis(true, &m), &m);
}

static void the_index_1_residual_vanishes_at_the_solution_of_the_stabilized_equations(void **state)
{
  (void)state;
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = true}, &m), BAUM_OK);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(m.mechanism, &w), BAUM_OK);
  const baum_dae dae = {BAUM_RESIDUAL_INDEX1, 30.0, 50.0};
  point p = random_point(m.mechanism, 5);
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
    /* rounding of sums whose terms are of that size */
    ASSERT_NEAR(residual[i], 0.0, 0.0, 1e-13 * size);
  }
  baum_workspace_destroy(w);
  model_destroy(&m);
}

static void the_public_jacobian_tells_its_size_first(void **state)
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
    cmocka_unit_test(the_jacobian_is_that_of_differences_for_bodies_with_a_motor),
    cmocka_unit_test(the_jacobian_is_that_of_differences_for_bodies_with_a_spring),
    cmocka_unit_test(the_jacobian_is_that_of_differences_for_user_functions),
    cmocka_unit_test(the_jacobian_is_that_of_differences_for_rows_that_depend_on_time),
    cmocka_unit_test(the_index_1_residual_vanishes_at_the_solution_of_the_stabilized_equations),
    cmocka_unit_test(the_public_jacobian_tells_its_size_first),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
