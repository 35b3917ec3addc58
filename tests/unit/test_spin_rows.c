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

/* ---- rounding of the raised tensor ---- */

static baum_body_id add_rod(baum_mechanism *m, double axial, const double at[3])
{
  baum_body_id body;
  baum_spatial_body_def rod = baum_spatial_body_def_default();
  memcpy(rod.position, at, sizeof rod.position);
  rod.inertia[0] = axial / 12.0;
  rod.inertia[1] = 1.0 / 12.0;
  rod.inertia[2] = 1.0 / 12.0;
  check(baum_mechanism_add_spatial_body(m, &rod, &body));
  return body;
}

static void add_ball(baum_mechanism *m, baum_body_id body, double x)
{
  baum_spatial_spherical_def ball = baum_spatial_spherical_def_default();
  ball.body_a = BAUM_GROUND;
  ball.body_b = body;
  ball.point[0] = x;
  ball.point[1] = 0.0;
  ball.point[2] = 0.0;
  check(baum_mechanism_add_spatial_spherical(m, &ball, NULL));
}

static void add_hinge(baum_mechanism *m, baum_body_id a, baum_body_id b, const double point[3],
                      const double axis[3])
{
  baum_spatial_revolute_def hinge = baum_spatial_revolute_def_default();
  hinge.body_a = a;
  hinge.body_b = b;
  memcpy(hinge.point, point, sizeof hinge.point);
  memcpy(hinge.axis, axis, sizeof hinge.axis);
  check(baum_mechanism_add_spatial_revolute(m, &hinge, NULL));
}

/* Two rods in one line on balls at their far ends, with a hinge between them. Only their moments of
 * inertia about the line, 1e-9 and 1.1e-8 of the others, resist a moment about the line. Rounding
 * of raised tensors is 1e-7 of these moments. A third rod has weak pivots without a spin row. */
static void spin_rows_keep_small_moments_of_inertia(void **state)
{
  (void)state;
  const double axial[2] = {1e-9, 1.1e-8};
  baum_mechanism *m = NULL;
  baum_workspace *w = NULL;
  check(baum_mechanism_create(&m));
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  baum_body_id a = add_rod(m, axial[0], (const double[]){0.5, 0.0, 0.0});
  baum_body_id b = add_rod(m, axial[1], (const double[]){1.5, 0.0, 0.0});
  baum_body_id alone = add_rod(m, 1e-9, (const double[]){0.5, 5.0, 0.0});
  add_ball(m, a, 0.0);
  add_ball(m, b, 2.0);
  add_hinge(m, a, b, (const double[]){1.0, 0.001, 0.0}, (const double[]){0.1, 1.0, 0.7});
  add_hinge(m, BAUM_GROUND, alone, (const double[]){0.0, 5.1, 0.05},
            (const double[]){1.0, 1.0, 0.5});
  baum_spatial_load_def load = baum_spatial_load_def_default();
  load.body = a;
  load.moment[0] = 1e-9;
  check(baum_mechanism_add_spatial_load(m, &load, NULL));
  check(baum_mechanism_freeze(m));
  check(baum_workspace_create(m, &w));
  assert_true(count_spin_rows(w->path->space) > 1);
  double q[21];
  double v[18];
  double out[18];
  check(baum_workspace_design(w, q, v));
  memset(v, 0, sizeof v);
  check(baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, out, NULL));
  assert_true(w->solved_by == w->path);
  ASSERT_NEAR(out[3], 12e-9 / (axial[0] + axial[1]), 1e-11, 0.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

/* ---- choice ---- */

static int fail_before_one(double t, double s[3], void *user)
{
  (void)user;
  s[0] = 0.0;
  s[1] = 0.0;
  s[2] = 0.0;
  return t < 1.0 ? 1 : 0;
}

/* Pivots cannot be measured if a user function fails at t = 0. */
static void a_failing_function_only_prevents_spin_rows(void **state)
{
  (void)state;
  baum_mechanism *m = NULL;
  baum_workspace *w = NULL;
  baum_joint_id joint;
  check(baum_mechanism_create(&m));
  baum_body_id rod = add_rod(m, 1e-6, (const double[]){0.5, 0.0, 0.0});
  baum_spatial_revolute_def hinge = baum_spatial_revolute_def_default();
  hinge.body_a = BAUM_GROUND;
  hinge.body_b = rod;
  memset(hinge.point, 0, sizeof hinge.point);
  hinge.axis[0] = 0.0;
  hinge.axis[1] = 1.0;
  hinge.axis[2] = 0.0;
  check(baum_mechanism_add_spatial_revolute(m, &hinge, &joint));
  baum_driver_def driver = baum_driver_def_default();
  driver.joint = joint;
  driver.law = fail_before_one;
  check(baum_mechanism_add_driver(m, &driver, NULL));
  check(baum_mechanism_freeze(m));
  check(baum_workspace_create(m, &w));
  assert_non_null(w->path);
  assert_int_equal(count_spin_rows(w->path->space), 0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
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
    cmocka_unit_test(spin_rows_keep_small_moments_of_inertia),
    cmocka_unit_test(a_failing_function_only_prevents_spin_rows),
    cmocka_unit_test(mechanisms_with_large_pivots_have_no_spin_rows),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
