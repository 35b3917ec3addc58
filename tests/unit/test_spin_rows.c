/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests spin rows (linear/space_block.h): mechanisms with thin bodies receive them, and the block
 * solver then agrees with KLU, which does not need them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "dynamics/block_path.h"
#include "random_mechanism.h"
#include "spatial.h"

enum { SIZE = 128, VECTORS = 5 };

/* The same mechanism with the block solver and with KLU. */
typedef struct twins {
  model m;
  baum_workspace *w[2];
  double q[SIZE];
  double v[SIZE];
} twins;

static void make_twins(model_spatial which, twins *t)
{
  check(model_spatial_build(which, 10, &t->m));
  check(baum_workspace_create(t->m.mechanism, &t->w[0]));
  check(baum_workspace_create(t->m.mechanism, &t->w[1]));
  t->w[1]->choice = BAUM_I_KKT_KLU;
  check(baum_i_use_blocks(t->w[1]));
  check(baum_workspace_design(t->w[0], t->q, t->v));
  check(baum_workspace_assemble(t->w[0], 0.0, t->q, t->v, NULL, 0));
}

static void destroy_twins(twins *t)
{
  baum_workspace_destroy(t->w[0]);
  baum_workspace_destroy(t->w[1]);
  model_destroy(&t->m);
}

static int count_spin_rows(const baum_i_space *space)
{
  int count = 0;
  for (int k = 0; k < space->node_count; k++) {
    count += space->list[k].spin != 0 ? 1 : 0;
  }
  return count;
}

static void assert_close(const double *got, const double *want, int count)
{
  double most = 0.0;
  for (int i = 0; i < count; i++) {
    most = fmax(most, fabs(want[i]));
  }
  for (int i = 0; i < count; i++) {
    ASSERT_NEAR(got[i], want[i], 0.0, 1e-10 * most);
  }
}

/* Compares accelerations, multipliers, and the solutions for other right-hand sides. */
static void compare_solutions(const twins *t, const double *x)
{
  const baum_mechanism *m = t->m.mechanism;
  double normal[2][SIZE];
  double least[2][SIZE];
  double rows[SIZE] = {0.0};
  for (int k = 0; k < 2; k++) {
    check(baum_i_acceleration(t->w[k], 0.0, t->q, t->v, 10.0, 10.0));
    check(baum_i_normal_part(t->w[k], x, normal[k]));
  }
  assert_close(t->w[0]->a, t->w[1]->a, m->nv);
  assert_close(t->w[0]->lambda, t->w[1]->lambda, m->nc);
  baum_i_jacobian_times(&t->w[1]->structure, t->w[1]->jacobian, x, rows);
  for (int k = 0; k < 2; k++) {
    check(baum_i_least_with_rows(t->w[k], rows, least[k]));
  }
  assert_close(normal[0], normal[1], m->nv);
  assert_close(least[0], least[1], m->nv);
  for (int k = 0; k < 2; k++) {
    check(baum_i_change_of_velocities(t->w[k], 0.0, t->q, x));
  }
  assert_close(t->w[0]->a, t->w[1]->a, m->nv);
}

static void solutions_with_spin_rows_are_the_same(void **state)
{
  static const model_spatial thin[] = {MODEL_BRICARD, MODEL_SLENDER_BRICARD, MODEL_FLYBALL};
  static const int bodies[] = {5, 5, 3};
  (void)state;
  chance c = chance_of(1);
  for (int i = 0; i < 3; i++) {
    twins t;
    make_twins(thin[i], &t);
    assert_int_equal(count_spin_rows(t.w[0]->path->space), bodies[i]);
    check(baum_i_acceleration(t.w[0], 0.0, t.q, t.v, 10.0, 10.0));
    assert_true(t.w[0]->path->refinements == 0);
    for (int k = 0; k < VECTORS; k++) {
      double x[SIZE];
      for (int j = 0; j < t.m.mechanism->nv; j++) {
        x[j] = chance_number(&c, -1.0, 1.0);
      }
      compare_solutions(&t, x);
    }
    destroy_twins(&t);
  }
}

static void mechanisms_with_large_pivots_have_no_spin_rows(void **state)
{
  static const model_spatial others[] = {MODEL_STEWART, MODEL_QUADRUPED, MODEL_REVOLUTE_CHAIN};
  (void)state;
  for (int i = 0; i < 3; i++) {
    twins t;
    make_twins(others[i], &t);
    assert_int_equal(count_spin_rows(t.w[0]->path->space), 0);
    destroy_twins(&t);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(solutions_with_spin_rows_are_the_same),
    cmocka_unit_test(mechanisms_with_large_pivots_have_no_spin_rows),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
