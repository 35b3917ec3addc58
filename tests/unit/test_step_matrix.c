/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the matrix of the iteration in an implicit step. A displacement d changes the residual. The
 * test computes this change by differences, and uses it as the right side of a system with the
 * matrix. The solution must be d again. The mechanism contains every kind of element. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "dynamics/step_matrix.h"
#include "every_element.h"

enum { SIZE = EVERY_NQ + EVERY_NV + EVERY_NC, N = EVERY_NV + EVERY_NC };

typedef struct point {
  double y[SIZE];
  double dy[SIZE];
} point;

/* Fills y and y' with irregular numbers of about 1. Positions are near the design configuration. */
static void fill_point(baum_workspace *w, point *p)
{
  memset(p, 0, sizeof *p);
  assert_int_equal(baum_workspace_design(w, p->y, NULL), BAUM_OK);
  for (int i = 0; i < SIZE; i++) {
    double x = sin(7.3 * i + 1.0);
    p->y[i] = i < EVERY_NQ ? p->y[i] + 0.01 * x : x;
    p->dy[i] = cos(3.1 * i);
  }
}

/* Changes q and lambda along the direction d. Also changes v and v', in the ratios that r
 * prescribes. */
static void move_point(baum_workspace *w, const point *from, const double *d, double by,
                       const baum_i_step_ratios *r, point *to)
{
  double dx[EVERY_NV];
  *to = *from;
  for (int i = 0; i < EVERY_NV; i++) {
    dx[i] = by * d[i];
    to->y[EVERY_NQ + i] += by * r->by_v * d[i];
    to->dy[EVERY_NQ + i] += by * r->by_a * d[i];
  }
  assert_int_equal(baum_workspace_move(w, dx, to->y), BAUM_OK);
  for (int i = 0; i < EVERY_NC; i++) {
    to->y[EVERY_NQ + EVERY_NV + i] += by * d[EVERY_NV + i] / r->scale;
  }
}

static void residual_at(baum_workspace *w, const point *p, double scale, double out[N])
{
  const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX3};
  double all[SIZE];
  assert_int_equal(baum_i_residual(w, &dae, 0.1, p->y, p->dy, all), BAUM_OK);
  for (int i = 0; i < N; i++) {
    out[i] = (i < EVERY_NV ? scale : 1.0) * all[EVERY_NQ + i];
  }
}

static void solving_for_a_change_of_the_residual_gives_the_displacement(void **state)
{
  (void)state;
  const baum_i_step_ratios ratios = {.by_v = 20.0, .by_a = 300.0, .scale = 1.0 / 250.0};
  every_element parts = every_element_make(NULL);
  baum_workspace *w = NULL;
  baum_i_step_matrix *matrix = NULL;
  point p;
  point ends[2];
  double d[N];
  double change[2][N];
  assert_int_equal(baum_workspace_create(parts.mechanism, &w), BAUM_OK);
  assert_int_equal(baum_i_step_matrix_create(w, &matrix), BAUM_OK);
  fill_point(w, &p);
  for (int i = 0; i < N; i++) {
    d[i] = cos(5.7 * i);
  }
  for (int k = 0; k < 2; k++) {
    move_point(w, &p, d, k == 0 ? 1e-5 : -1e-5, &ratios, &ends[k]);
    residual_at(w, &ends[k], ratios.scale, change[k]);
  }
  for (int i = 0; i < N; i++) {
    change[0][i] = (change[0][i] - change[1][i]) / 2e-5;
  }
  assert_int_equal(baum_i_step_matrix_factor(matrix, w, &ratios, 0.1, p.y, p.dy), BAUM_OK);
  baum_i_step_matrix_solve(matrix, change[0]);
  for (int i = 0; i < N; i++) {
    ASSERT_NEAR(change[0][i], d[i], 0.0, 1e-5); /* truncation error times condition number */
  }
  baum_i_step_matrix_destroy(matrix);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(solving_for_a_change_of_the_residual_gives_the_displacement),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
