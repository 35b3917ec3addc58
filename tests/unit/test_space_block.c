/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the two versions of the solver of mechanisms in space (linear/space_block.h): the plain
 * one, and the one for this processor. The tests call the functions of the solver in the order of
 * an evaluation. Before each call, both versions receive the same data.
 * tests/physics/test_spatial_accuracy.c compares results with quadruple precision. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "assert_near.h"
#include "construct.h"
#include "dynamics/block_path.h"
#include "random_spatial.h"
#include "spatial.h"
#include "spatial_scenes.h"

enum { MOST = 400 };

/* One mechanism in two workspaces. The second workspace uses the plain version. */
typedef struct pair {
  baum_workspace *w[2];
  baum_i_block_path *path[2];
  baum_i_space *space[2];
} pair;

static void use_plain(baum_i_block_path *path)
{
  path->space_kernel = &baum_i_space_kernel_plain;
  path->refine_kernel = &baum_i_space_refine_kernel_plain;
  path->space_sides = &baum_i_space_sides_kernel_plain;
  path->factor_kernel = &baum_i_space_factor_kernel_plain;
  path->residual_kernel = &baum_i_space_residual_kernel_plain;
  path->bodies_kernel = &baum_i_space_bodies_kernel_plain;
  path->joints_kernel = &baum_i_space_joints_kernel_plain;
}

/* Evaluates both workspaces in the design configuration with random velocities. Returns false if
 * the mechanism does not use the solver of mechanisms in space. */
static bool make_pair(const baum_mechanism *m, pair *p)
{
  static const baum_i_right_side right = {
    .bending = 1.0, .damping = 3.0, .stiffness = 2.0, .force = true};
  double q[MOST];
  double v[MOST];
  chance c = chance_of(5);
  memset(p, 0, sizeof *p);
  assert_true(m->nq <= MOST && m->nc <= MOST);
  for (int i = 0; i < m->nv; i++) {
    v[i] = chance_number(&c, -2.0, 2.0);
  }
  for (int k = 0; k < 2; k++) {
    assert_int_equal(baum_workspace_create(m, &p->w[k]), BAUM_OK);
    assert_int_equal(baum_workspace_design(p->w[k], q, NULL), BAUM_OK);
    p->path[k] = p->w[k]->path;
    if (!p->path[k] || !p->path[k]->space) {
      return false;
    }
    p->space[k] = p->path[k]->space;
  }
  use_plain(p->path[1]);
  for (int k = 0; k < 2; k++) {
    assert_int_equal(baum_i_block_path_evaluate(p->w[k], p->path[k], 0.0, q, v, &right), BAUM_OK);
  }
  return true;
}

static double largest(const double *x, int count)
{
  double most = 0.0;
  for (int i = 0; i < count; i++) {
    most = fmax(most, fabs(x[i]));
  }
  return most;
}

/* The tolerance is relative to `size` or to the largest number, whichever is larger. */
static void assert_close(const double *got, const double *want, int count, double tolerance,
                         double size)
{
  double most = fmax(size, largest(want, count));
  for (int i = 0; i < count; i++) {
    ASSERT_NEAR(got[i], want[i], 0.0, tolerance * most);
  }
}

static void copy_motion(const pair *p)
{
  size_t motion = BAUM_I_SPACE_MOTION * (size_t)p->space[0]->body_count;
  memcpy(p->space[1]->motion, p->space[0]->motion, motion * sizeof(double));
  memcpy(p->space[1]->pull, p->space[0]->pull, motion * sizeof(double));
}

/* Copies the data of sides, nodes and couplings to the second workspace. */
static void copy_numbers(const pair *p)
{
  const baum_i_space *from = p->space[0];
  const baum_i_space *to = p->space[1];
  memcpy(to->sides, from->sides, (size_t)from->numbers_of_sides * sizeof(double));
  memcpy(to->nodes, from->nodes, (size_t)from->numbers_of_nodes * sizeof(double));
  memcpy(to->off, from->off, (size_t)from->numbers_off * sizeof(double));
  memcpy(to->rest, from->rest, (size_t)from->numbers_of_rows * sizeof(double));
  memcpy(to->measures, from->measures, (size_t)from->node_count * sizeof *from->measures);
  size_t motion = BAUM_I_SPACE_MOTION * (size_t)from->body_count;
  memcpy(to->free, from->free, motion * sizeof(double));
  memcpy(to->force, from->force, motion * sizeof(double));
  copy_motion(p);
}

/* ---- the functions in their order ---- */

static void compare_geometry(const pair *p)
{
  const baum_i_space *a = p->space[0];
  const baum_i_space *b = p->space[1];
  for (int k = 0; k < a->node_count; k++) {
    const baum_i_space_node *node = &a->list[k];
    int part = baum_i_space_part(node->rows);
    double terms = 10.0; /* the size of the terms of J a0 - r */
    for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
      const baum_i_space_side *side = &a->side_list[s];
      double size = largest(a->bodies[side->body].whiten, 12);
      const double *free = a->free + (ptrdiff_t)BAUM_I_SPACE_MOTION * side->body;
      terms = fmax(terms, fmax(size, 1.0) * largest(free, BAUM_I_SPACE_MOTION));
      assert_close(b->sides + side->turn, a->sides + side->turn, part, 1e-13, size);
      assert_close(b->sides + side->move, a->sides + side->move, part, 1e-13, 1.0);
    }
    int vector = baum_i_space_vector(node->rows);
    const double *x = a->nodes + node->at;
    const double *y = b->nodes + node->at;
    assert_close(y, x, vector, 1e-12, terms);
    assert_close(y + vector, x + vector, vector, 1e-12, 10.0);
    assert_close(y + 2 * vector, x + 2 * vector, 4 * node->rows, 1e-12, 0.0);
  }
  for (int t = 1; t < a->body_count; t++) {
    ptrdiff_t at = (ptrdiff_t)BAUM_I_SPACE_MOTION * t;
    double size = largest(a->bodies[t].whiten, 12);
    assert_close(b->free + at, a->free + at, BAUM_I_SPACE_MOTION, 1e-12, size);
    assert_close(b->force + at, a->force + at, BAUM_I_SPACE_MOTION, 1e-12, size);
  }
  assert_close(p->w[1]->phi, p->w[0]->phi, p->w[0]->mechanism->nc, 1e-13, 1.0);
  assert_close(p->w[1]->phi_rate, p->w[0]->phi_rate, p->w[0]->mechanism->nc, 1e-13, 1.0);
  assert_close(p->w[1]->gamma, p->w[0]->gamma, p->w[0]->mechanism->nc, 1e-13, 1.0);
}

static void compare_couplings(const pair *p)
{
  const baum_i_space *a = p->space[0];
  for (int k = 0; k < 2; k++) {
    p->path[k]->factor_kernel->couple(p->space[k], 0, p->space[k]->stage_count);
  }
  for (int e = 0; e < a->coupling_count; e++) {
    int end = e + 1 < a->coupling_count ? a->couplings[e + 1].at : a->numbers_off;
    int at = a->couplings[e].at;
    assert_close(p->space[1]->off + at, a->off + at, end - at, 1e-12, 0.0);
  }
}

static void compare_nodes(const pair *p, double tolerance)
{
  const baum_i_space *a = p->space[0];
  double lambda[2][MOST] = {{0.0}};
  for (int k = 0; k < 2; k++) {
    p->path[k]->space_kernel->read_lambda(p->space[k], lambda[k]);
  }
  assert_close(lambda[1], lambda[0], p->w[0]->mechanism->nc, tolerance, 0.0);
  int motion = BAUM_I_SPACE_MOTION * a->body_count;
  assert_close(p->space[1]->motion, a->motion, motion, tolerance, largest(a->free, motion));
}

static void compare_residuals(const pair *p)
{
  const baum_i_space *a = p->space[0];
  int motion = BAUM_I_SPACE_MOTION * a->body_count;
  chance c = chance_of(6);
  for (int i = 0; i < motion; i++) { /* makes the residuals large */
    a->motion[i] *= 1.0 + chance_number(&c, -0.1, 0.1);
  }
  for (int k = 0; k < a->node_count; k++) {
    for (int i = 0; i < a->list[k].rows; i++) {
      a->nodes[a->list[k].at + i] *= 1.0 + chance_number(&c, -0.1, 0.1);
    }
  }
  copy_numbers(p);
  for (int k = 0; k < 2; k++) {
    p->path[k]->residual_kernel->find(p->space[k]);
  }
  assert_close(p->space[1]->pull, a->pull, motion, 1e-13, 0.0);
  assert_close(p->space[1]->rest, a->rest, a->numbers_of_rows, 1e-13, 0.0);
}

static void compare_corrections(const pair *p)
{
  double a[2][MOST] = {{0.0}};
  double change[2];
  double amplification[2];
  copy_numbers(p);
  for (int k = 0; k < 2; k++) {
    const baum_i_space_refine_kernel *kernel = p->path[k]->refine_kernel;
    assert_false(kernel->check(p->space[k]));
    change[k] = kernel->correct(p->space[k]);
    amplification[k] = kernel->amplification(p->space[k]);
    assert_true(p->path[k]->space_kernel->read_motion(p->space[k], a[k]));
  }
  compare_nodes(p, 1e-11);
  /* The island in which rounding errors grow most may be the island with the largest change. */
  ASSERT_NEAR(change[1], change[0], fmax(1e-9, 1e-13 * amplification[0]), 0.0);
  ASSERT_NEAR(amplification[1], amplification[0], 1e-9, 0.0);
  /* Rounding errors of accelerations are multiplied by the amplification. */
  double tolerance = fmax(1e-10, 1e-14 * amplification[0]);
  assert_close(a[1], a[0], p->w[0]->mechanism->nv, tolerance, 0.0);
  for (int k = 0; k < 2; k++) {
    assert_true(p->path[k]->refine_kernel->correct_rows(p->space[k]) < 1e-6);
    assert_true(p->path[k]->space_kernel->read_motion(p->space[k], a[k]));
  }
  assert_close(a[1], a[0], p->w[0]->mechanism->nv, tolerance, 0.0);
}

/* Returns false if the mechanism does not use the solver of mechanisms in space, or if the pivots
 * are weak. If they are weak, rounding errors grow, so only the geometry and the couplings are
 * compared. */
static bool compare(const baum_mechanism *m)
{
  pair p;
  bool good = make_pair(m, &p);
  if (good) {
    compare_geometry(&p);
    copy_numbers(&p);
    compare_couplings(&p);
    copy_numbers(&p);
    for (int k = 0; k < 2; k++) {
      baum_i_pivots pivots =
        p.path[k]->factor_kernel->eliminate(p.space[k], 0, p.space[k]->stage_count);
      p.path[k]->space_kernel->substitute(p.space[k], p.w[k]->lambda);
      good = good && pivots == BAUM_I_PIVOTS_GOOD;
    }
  }
  if (good && largest(p.space[0]->free, BAUM_I_SPACE_MOTION * p.space[0]->body_count) > 0.0) {
    compare_nodes(&p, 1e-10);
    copy_numbers(&p);
    compare_residuals(&p);
    compare_corrections(&p);
  }
  for (int k = 0; k < 2; k++) {
    baum_workspace_destroy(p.w[k]);
  }
  return good;
}

/* ---- tests ---- */

static void both_versions_agree_for_scenes(void **state)
{
  (void)state;
  int compared = 0;
  for (int k = 0; k < MODEL_SPATIAL_COUNT; k++) {
    model m;
    assert_int_equal(model_spatial_build((model_spatial)k, 12, &m), BAUM_OK);
    compared += compare(m.mechanism) ? 1 : 0;
    model_destroy(&m);
  }
  assert_true(compared >= 5);
}

/* The mechanisms have joints of all kinds, redundant rows, loops, particles and planar bodies. */
static void both_versions_agree_for_random_mechanisms(void **state)
{
  static random_spatial room;
  (void)state;
  int compared = 0;
  for (uint64_t seed = 0; seed < 200; seed++) {
    random_spatial_make(&room, seed, seed % 2 == 1);
    compared += compare(room.mechanism) ? 1 : 0;
    random_spatial_destroy(&room);
  }
  assert_true(compared >= 50);
}

/* The mechanism is a planar four-bar with pins. Its coupler carries a spatial body. */
static void both_versions_agree_for_planar_pins(void **state)
{
  (void)state;
  baum_body_id bob;
  baum_mechanism *m = create_mechanism();
  spatial_build_planar_four_bar(m);
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.position[2] = 0.3;
  assert_int_equal(baum_mechanism_add_spatial_body(m, &def, &bob), BAUM_OK);
  baum_spatial_spherical_def ball = baum_spatial_spherical_def_default();
  ball.body_a = baum_mechanism_body_at(m, 1);
  ball.body_b = bob;
  memset(ball.point, 0, sizeof ball.point);
  assert_int_equal(baum_mechanism_add_spatial_spherical(m, &ball, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_true(compare(m));
  baum_mechanism_destroy(m);
}

/* A chain of bodies on a helix. Points stay on planes of the next body but one, so that the
 * elimination has fill. */
static baum_mechanism *make_net(int bodies)
{
  baum_mechanism *m = create_mechanism();
  baum_body_id ids[3] = {BAUM_GROUND, BAUM_GROUND, BAUM_GROUND};
  for (int i = 0; i < bodies; i++) {
    baum_spatial_body_def def = baum_spatial_body_def_default();
    baum_spatial_spherical_def ball = baum_spatial_spherical_def_default();
    baum_spatial_point_on_plane_def plane = baum_spatial_point_on_plane_def_default();
    memmove(ids, ids + 1, 2 * sizeof *ids);
    for (int c = 0; c < 3; c++) {
      const double phase = 0.4 * i + 1.6 * c;
      def.position[c] = c < 2 ? cos(phase) : 0.1 * i;
      ball.point[c] = c < 2 ? cos(phase - 0.2) : 0.1 * i - 0.05;
      plane.point[c] = c < 2 ? 1.2 * cos(phase - 0.4) : 0.1 * i - 0.1;
      plane.axis[c] = cos(1.3 * i + c);
    }
    assert_int_equal(baum_mechanism_add_spatial_body(m, &def, &ids[2]), BAUM_OK);
    ball.body_a = ids[1];
    ball.body_b = ids[2];
    plane.body_b = ids[2];
    assert_int_equal(baum_mechanism_add_spatial_spherical(m, &ball, NULL), BAUM_OK);
    plane.body_a = ids[0];
    if (i > 1) {
      assert_int_equal(baum_mechanism_add_spatial_point_on_plane(m, &plane, NULL), BAUM_OK);
    }
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static void stages_do_not_change_the_solution(void **state)
{
  enum { BODIES = 300 };
  static const baum_i_right_side right = {
    .bending = 1.0, .damping = 3.0, .stiffness = 2.0, .force = true};
  static double q[7 * BODIES];
  static double v[6 * BODIES];
  static double a[6 * BODIES];
  static double lambda[4 * BODIES];
  baum_workspace *w;
  chance c = chance_of(6);
  (void)state;
  baum_mechanism *m = make_net(BODIES);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  assert_int_equal(baum_workspace_design(w, q, NULL), BAUM_OK);
  for (int i = 0; i < m->nv; i++) {
    v[i] = chance_number(&c, -2.0, 2.0);
  }
  baum_i_block_path *path = w->path;
  assert_true(path && path->space && path->only_hot && path->space->stage_count > 2);
  assert_true(path->space->stages[1].target > 0);
  assert_int_equal(baum_i_block_path_solve(w, path, 0.0, q, v, &right), BAUM_OK);
  memcpy(a, w->a, (size_t)m->nv * sizeof *a);
  memcpy(lambda, w->lambda, (size_t)m->nc * sizeof *lambda);
  path->only_hot = false; /* all stages at once */
  assert_int_equal(baum_i_block_path_solve(w, path, 0.0, q, v, &right), BAUM_OK);
  assert_true(largest(a, m->nv) > 1.0);
  assert_close(a, w->a, m->nv, 1e-12, 0.0);
  assert_close(lambda, w->lambda, m->nc, 1e-12, 0.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(both_versions_agree_for_scenes),
    cmocka_unit_test(both_versions_agree_for_random_mechanisms),
    cmocka_unit_test(both_versions_agree_for_planar_pins),
    cmocka_unit_test(stages_do_not_change_the_solution),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
