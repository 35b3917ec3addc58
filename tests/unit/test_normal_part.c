/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the normal part P x = M^-1 J^T (J M^-1 J^T)^-1 J x of a vector x. The library computes P x
 * with the factors of its last solution. Two properties define P: J P x = J x, and P x is
 * M-orthogonal to every y with J y = 0. A second function computes P x from J x instead of x. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "dynamics/block_path.h"
#include "models.h"
#include "random_mechanism.h"

enum { MECHANISMS = 60, SIZE = 400 };

typedef struct vectors {
  double v[SIZE];
  double x[SIZE];
  double normal[SIZE];
  double other[SIZE];
  double other_normal[SIZE];
  double out[SIZE];
} vectors;

static void draw_vector(chance *c, int n, double *x)
{
  for (int i = 0; i < n; i++) {
    x[i] = chance_number(c, -1.0, 1.0);
  }
}

static double dot(int n, const double *x, const double *y)
{
  double sum = 0.0;
  for (int i = 0; i < n; i++) {
    sum += x[i] * y[i];
  }
  return sum;
}

static double largest(int n, const double *x)
{
  double most = 0.0;
  for (int i = 0; i < n; i++) {
    most = fmax(most, fabs(x[i]));
  }
  return most;
}

/* Checks that J (x - P x) = 0, except in omitted rows. */
static void check_rows(baum_workspace *w, vectors *d)
{
  const baum_mechanism *m = w->mechanism;
  double rest[SIZE];
  for (int i = 0; i < m->nv; i++) {
    rest[i] = d->x[i] - d->normal[i];
  }
  memset(d->out, 0, sizeof d->out);
  baum_i_jacobian_times(&w->structure, w->jacobian, rest, d->out);
  for (int i = 0; i < m->nc; i++) {
    bool omitted = w->rows.count > 0 && w->rows.omitted[i];
    /* The tolerance is the rounding error of a solution without refinement. The condition number is
     * below 1e4. */
    ASSERT_NEAR(omitted ? 0.0 : d->out[i], 0.0, 0.0, 1e-9 * (1.0 + largest(m->nv, d->normal)));
  }
}

static void check_orthogonal(baum_workspace *w, vectors *d)
{
  int n = w->mechanism->nv;
  for (int i = 0; i < n; i++) {
    d->other[i] -= d->other_normal[i];
  }
  memset(d->out, 0, sizeof d->out);
  baum_i_mass_times(&w->structure, w->mass, d->normal, d->out);
  double size = 1.0 + largest(n, d->out) * largest(n, d->other) * n;
  ASSERT_NEAR(dot(n, d->other, d->out), 0.0, 0.0, 1e-9 * size);
}

/* Computes P x from J x, and compares the result with P x computed from x. */
static void check_by_rows(baum_workspace *w, vectors *d)
{
  double *rows = d->other;
  memset(rows, 0, sizeof d->other);
  baum_i_jacobian_times(&w->structure, w->jacobian, d->x, rows);
  assert_int_equal(baum_i_least_with_rows(w, rows, d->out), BAUM_OK);
  for (int i = 0; i < w->mechanism->nv; i++) {
    /* The tolerance is the rounding error of two solutions without refinement. */
    ASSERT_NEAR(d->out[i], d->normal[i], 0.0, 1e-9 * (1.0 + largest(w->mechanism->nv, d->normal)));
  }
}

/* Checks P with random vectors. Returns false if the configuration is singular. */
static bool check_mechanism(baum_workspace *w, chance *c)
{
  const baum_mechanism *m = w->mechanism;
  static vectors d;
  assert_true(m->nv <= SIZE && m->nc <= SIZE);
  draw_vector(c, m->nv, d.v);
  draw_vector(c, m->nv, d.x);
  draw_vector(c, m->nv, d.other);
  if (baum_i_acceleration(w, 0.0, m->design_q, d.v, 0.0, 0.0) != BAUM_OK || w->near_singular > 0) {
    return false;
  }
  assert_int_equal(baum_i_normal_part(w, d.x, d.normal), BAUM_OK);
  assert_int_equal(baum_i_normal_part(w, d.other, d.other_normal), BAUM_OK);
  assert_int_equal(baum_i_need_jacobian(w), BAUM_OK);
  assert_int_equal(baum_i_evaluate_mass(w), BAUM_OK);
  check_rows(w, &d);
  check_orthogonal(w, &d);
  check_by_rows(w, &d);
  return true;
}

static int check_by(baum_i_kkt_choice choice, bool blocks, const random_kind *kind)
{
  int checked = 0;
  for (uint64_t seed = 1; seed <= MECHANISMS; seed++) {
    static random_mechanism random;
    random_mechanism_make(&random, seed, kind);
    baum_workspace *w = NULL;
    assert_int_equal(baum_i_workspace_create(random.mechanism, choice, &w), BAUM_OK);
    assert_int_equal(baum_i_find_rows(w, 0.0, random.mechanism->design_q), BAUM_OK);
    if (blocks) {
      assert_int_equal(baum_i_use_blocks(w), BAUM_OK);
    }
    bool done = check_mechanism(w, &random.chance);
    checked += done && (w->solved_by != NULL) == blocks ? 1 : 0;
    baum_workspace_destroy(w);
    random_mechanism_destroy(&random);
  }
  return checked;
}

static const random_kind KIND = {.bodies = 8,
                                 .joints = 9,
                                 .particles = 20,
                                 .coordinates = 20,
                                 .pins = 50,
                                 .constant = false,
                                 .span = 10.0,
                                 .loads = 3,
                                 .velocity_rows = 2};

static void the_block_solver_gives_the_normal_part(void **state)
{
  (void)state;
  assert_true(check_by(BAUM_I_KKT_AUTO, true, &KIND) > MECHANISMS / 2);
}

static void the_solvers_of_the_whole_system_give_the_normal_part(void **state)
{
  (void)state;
  assert_true(check_by(BAUM_I_KKT_KLU, false, &KIND) > MECHANISMS / 2);
  assert_true(check_by(BAUM_I_KKT_QR, false, &KIND) > MECHANISMS / 2);
}

/* ---- weak pivots ---- */

/* Adds a body and joins it to the previous one at (x, 0, 0). The centre of the body is elsewhere,
 * and its moments of inertia are so small that the pivots of the joint are weak. */
static baum_body_id add_small_body(baum_mechanism *m, bool in_space, baum_body_id before, double x,
                                   chance *c)
{
  baum_body_id body;
  double inertia = chance_decade(c, 1e-6, 1e-4);
  if (in_space) {
    baum_spatial_body_def def = baum_spatial_body_def_default();
    baum_spatial_revolute_def hinge = baum_spatial_revolute_def_default();
    for (int i = 0; i < 3; i++) {
      def.inertia[i] = inertia;
      def.position[i] = chance_number(c, -1.0, 1.0) + (i == 0 ? x : 0.0);
      hinge.point[i] = i == 0 ? x : 0.0;
      hinge.axis[i] = chance_number(c, -1.0, 1.0);
    }
    assert_int_equal(baum_mechanism_add_spatial_body(m, &def, &body), BAUM_OK);
    hinge.body_a = before;
    hinge.body_b = body;
    assert_int_equal(baum_mechanism_add_spatial_revolute(m, &hinge, NULL), BAUM_OK);
  } else {
    baum_planar_body_def def = baum_planar_body_def_default();
    def.inertia = inertia;
    def.position[0] = x + chance_number(c, -1.0, 1.0);
    def.position[1] = chance_number(c, -1.0, 1.0);
    assert_int_equal(baum_mechanism_add_planar_body(m, &def, &body), BAUM_OK);
    add_planar_pin(m, NULL, before, body, x, 0.0);
  }
  return body;
}

/* Adds a body without joints, whose normal part is 0. Its mass times the reciprocal of its mass is
 * not 1 after rounding. */
static void add_free_body(baum_mechanism *m, bool in_space)
{
  if (in_space) {
    baum_spatial_body_def def = baum_spatial_body_def_default();
    def.mass = 49.0;
    assert_int_equal(baum_mechanism_add_spatial_body(m, &def, NULL), BAUM_OK);
  } else {
    baum_planar_body_def def = baum_planar_body_def_default();
    def.mass = 49.0;
    assert_int_equal(baum_mechanism_add_planar_body(m, &def, NULL), BAUM_OK);
  }
}

static void assert_same(int n, const double *x, const double *y)
{
  for (int i = 0; i < n; i++) {
    ASSERT_NEAR(x[i], y[i], 0.0, 1e-10);
  }
}

/* Compares the normal part with that of the solver of the whole system. Returns whether pivots were
 * weak. */
static bool compare_solvers(const baum_mechanism *m, chance *c)
{
  static vectors d[2];
  baum_workspace *w[2];
  double rows[SIZE] = {0.0};
  draw_vector(c, m->nv, d[0].v);
  draw_vector(c, m->nv, d[0].x);
  for (int k = 0; k < 2; k++) {
    baum_i_kkt_choice choice = k == 0 ? BAUM_I_KKT_AUTO : BAUM_I_KKT_KLU;
    assert_int_equal(baum_i_workspace_create(m, choice, &w[k]), BAUM_OK);
    assert_int_equal(k == 0 ? baum_i_use_blocks(w[k]) : BAUM_OK, BAUM_OK);
    assert_int_equal(baum_i_acceleration(w[k], 0.0, m->design_q, d[0].v, 0.0, 0.0), BAUM_OK);
    assert_int_equal(baum_i_normal_part(w[k], d[0].x, d[k].normal), BAUM_OK);
  }
  baum_i_jacobian_times(&w[1]->structure, w[1]->jacobian, d[0].x, rows);
  assert_int_equal(baum_i_least_with_rows(w[0], rows, d[0].out), BAUM_OK);
  bool weak = w[0]->solved_by && w[0]->solved_by->weak;
  assert_same(m->nv, d[0].normal, d[1].normal);
  assert_same(m->nv, d[0].out, d[1].normal);
  baum_workspace_destroy(w[0]);
  baum_workspace_destroy(w[1]);
  return weak;
}

static void weak_pivots_do_not_spoil_the_normal_part(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    chance c = chance_of(3);
    int weak = 0;
    for (int i = 0; i < MECHANISMS; i++) {
      baum_mechanism *m = create_mechanism();
      baum_body_id body = BAUM_GROUND;
      for (int n = 0; n < 3; n++) {
        body = add_small_body(m, k == 1, body, n, &c);
      }
      add_free_body(m, k == 1);
      assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
      weak += compare_solvers(m, &c) ? 1 : 0;
      baum_mechanism_destroy(m);
    }
    assert_true(weak > MECHANISMS / 2);
  }
}

static void without_rows_the_normal_part_is_zero(void **state)
{
  (void)state;
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  particle.mass = 1.0;
  baum_mechanism *mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_particle(mechanism, &particle, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(mechanism, &w), BAUM_OK);
  const double x[2] = {1.0, 2.0};
  double out[2] = {3.0, 4.0};
  assert_int_equal(baum_i_acceleration(w, 0.0, x, x, 0.0, 0.0), BAUM_OK);
  assert_int_equal(baum_i_normal_part(w, x, out), BAUM_OK);
  assert_true(out[0] == 0.0 && out[1] == 0.0);
  out[0] = 3.0;
  assert_int_equal(baum_i_least_with_rows(w, x, out), BAUM_OK);
  assert_true(out[0] == 0.0 && out[1] == 0.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_block_solver_gives_the_normal_part),
    cmocka_unit_test(the_solvers_of_the_whole_system_give_the_normal_part),
    cmocka_unit_test(weak_pivots_do_not_spoil_the_normal_part),
    cmocka_unit_test(without_rows_the_normal_part_is_zero),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
