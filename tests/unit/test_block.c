/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the block solver alone. Its results are compared with solutions in quadruple precision. The
 * loops of the solver exist in two versions, a plain one and one for this processor, and both are
 * tested. test_block_structure.c tests how the solver couples joints, and
 * tests/physics/test_random_mechanisms.c tests the solver in random mechanisms. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "assert_near.h"
#include "construct.h"
#include "dynamics/block_path.h"
#include "mechanism/planar/frames.h"
#include "models.h"
#include "saddle.h"

enum { MOST_UNKNOWNS = 400, MOST_BODIES = 60 };

/* The function tables of the block solver, except the table for pins. */
typedef struct tables {
  const baum_i_block_sides_kernel *sides;
  const baum_i_block_kernel *solution;
} tables;

static const tables plain = {&baum_i_block_sides_kernel_plain, &baum_i_block_kernel_plain};

/* Returns the tables that the library chooses for this processor. */
static tables own_tables(void)
{
  model m;
  baum_workspace *w = NULL;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m.mechanism, &w), BAUM_OK);
  tables out = {w->path->sides_kernel, w->path->kernel};
  baum_workspace_destroy(w);
  model_destroy(&m);
  return out;
}

/* ---- a system of equations ---- */

typedef struct equations {
  saddle s;
  unsigned char diagonal[MOST_BODIES];
  unsigned char fixed[MOST_BODIES];
  baum_i_block_pin pins[4 * MOST_BODIES];
} equations;

static equations *make(uint64_t seed, int bodies)
{
  equations *x = calloc(1, sizeof *x);
  assert_non_null(x);
  x->s = saddle_make_random(seed, bodies);
  assert_true(x->s.structure.mass_block_count <= MOST_BODIES);
  assert_true(x->s.structure.row_block_count <= 4 * MOST_BODIES);
  assert_true(x->s.structure.nv + x->s.structure.nc <= MOST_UNKNOWNS);
  return x;
}

static void unmake(equations *x)
{
  saddle_free(&x->s);
  free(x);
}

/* Gives every body that has three velocities the mass matrix of a planar body. */
static void make_planar(equations *x)
{
  for (int i = 0; i < x->s.structure.mass_block_count; i++) {
    const baum_i_mass_block *body = &x->s.structure.mass_blocks[i];
    double *m = x->s.mass + body->value;
    if (body->size == 3) {
      x->diagonal[i] = 1;
      const double mass[9] = {m[0], 0.0, 0.0, 0.0, m[0], 0.0, 0.0, 0.0, m[8]};
      memcpy(m, mass, sizeof mass);
    }
  }
}

static baum_status create(const equations *x, int *hub, baum_i_block **out)
{
  const baum_i_block_layout layout = {.structure = &x->s.structure,
                                      .pins = x->pins,
                                      .diagonal = x->diagonal,
                                      .omitted = x->s.values.omitted,
                                      .fixed = x->fixed};
  return baum_i_block_create(&layout, hub, out);
}

static baum_i_pivots factor(const equations *x, const tables *t, baum_i_block *b)
{
  static const double zeros[MOST_UNKNOWNS] = {0.0};
  double rates[MOST_UNKNOWNS];
  assert_true(baum_i_block_set_mass(b, x->s.mass));
  assert_true(baum_i_block_factor_dense(b, x->s.mass));
  t->sides->set_force(b, x->s.f);
  const baum_i_block_rows rows = {.jacobian = x->s.jacobian,
                                  .v = zeros,
                                  .phi = zeros,
                                  .nu = zeros,
                                  .gamma = x->s.r,
                                  .bending = 1.0,
                                  .phi_rate = rates};
  t->sides->set(b, &rows);
  t->solution->couple(b);
  return t->solution->eliminate(b);
}

static void refine(const tables *t, baum_i_block *b, int times)
{
  for (int k = 0; k < times; k++) {
    baum_i_block_find_residual(b);
    (void)t->solution->correct(b);
  }
}

static void read(equations *x, const tables *t, baum_i_block *b)
{
  memset(x->s.lambda, 0, (size_t)x->s.structure.nc * sizeof *x->s.lambda);
  assert_true(t->solution->read_motion(b, x->s.a));
  t->solution->read_lambda(b, x->s.lambda);
}

static void solve(equations *x, const tables *t, int refinements)
{
  baum_i_block *b = NULL;
  assert_int_equal(create(x, NULL, &b), BAUM_OK);
  assert_int_not_equal(factor(x, t, b), BAUM_I_PIVOTS_BAD);
  t->solution->substitute(b, x->s.lambda);
  refine(t, b, refinements);
  read(x, t, b);
  baum_i_block_destroy(b);
}

static double largest_of(const double *x, int count)
{
  double largest = 0.0;
  for (int i = 0; i < count; i++) {
    largest = fmax(largest, fabs(x[i]));
  }
  return largest;
}

/* Compares a solution. For accelerations, the tolerance is relative to the largest acceleration,
 * and for multipliers to the largest multiplier. */
static void assert_solution(const equations *x, const double *want, double tolerance)
{
  int nv = x->s.structure.nv;
  int nc = x->s.structure.nc;
  for (int i = 0; i < nv + nc; i++) {
    double got = i < nv ? x->s.a[i] : x->s.lambda[i - nv];
    double size = i < nv ? largest_of(want, nv) : largest_of(want + nv, nc);
    ASSERT_NEAR(got, want[i], 0.0, tolerance * size);
  }
}

/* Tests the solver twice: without iterative refinement, as in most evaluations, and with two steps
 * of refinement. In these systems, the condition number of J M^(-1/2) is up to 1e5. The condition
 * number of the Schur complement J M^-1 J^T is the square of this number. */
static void assert_solved(equations *x)
{
  const tables own = own_tables();
  const tables *both[] = {&plain, &own};
  double want[MOST_UNKNOWNS];
  saddle_solve(&x->s, want);
  for (int k = 0; k < 2; k++) {
    solve(x, both[k], 0);
    assert_solution(x, want, 1e-9);
    solve(x, both[k], 2);
    assert_solution(x, want, 1e-13);
  }
}

/* ---- solutions ---- */

static void dense_masses_are_solved(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 40; seed++) {
    equations *x = make(seed, 2 + (int)seed);
    assert_solved(x);
    unmake(x);
  }
}

static void diagonal_masses_among_dense_ones_are_solved(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 40; seed++) {
    equations *x = make(seed, 2 + (int)seed);
    make_planar(x);
    assert_solved(x);
    unmake(x);
  }
}

/* First omits every fourth row. This changes the pairs of rows, called nodes, that the solver
 * forms, and leaves some nodes without a row. Then omits all rows. */
static void omitted_rows_have_no_influence(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    equations *x = make(seed, 8);
    saddle_use_omitted(&x->s);
    for (int i = 0; i < x->s.structure.nc; i += 4) {
      x->s.omitted[i] = 1;
      x->s.r[i] = 1e30; /* must never be read */
    }
    assert_solved(x);
    memset(x->s.omitted, 1, (size_t)x->s.structure.nc);
    assert_solved(x);
    unmake(x);
  }
}

/* The solver treats a fixed body as ground. The result must be the same as with a zero force on
 * this body and zero columns of J for it. */
static void fixed_bodies_are_ground(void **state)
{
  (void)state;
  int tested = 0;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    equations *x = make(seed, 9);
    make_planar(x);
    double jacobian[2 * MOST_UNKNOWNS];
    double force[3];
    int at = -1;
    for (int i = 1; i < 8; i++) {
      at = x->diagonal[i] ? i : at;
    }
    if (at < 0) {
      unmake(x);
      continue;
    }
    const baum_i_mass_block *body = &x->s.structure.mass_blocks[at];
    assert_true(x->s.jacobian_count <= 2 * MOST_UNKNOWNS);
    memcpy(jacobian, x->s.jacobian, (size_t)x->s.jacobian_count * sizeof *jacobian);
    memcpy(force, x->s.f + body->first, sizeof force);
    memset(x->s.f + body->first, 0, sizeof force);
    for (int k = 0; k < x->s.structure.row_block_count; k++) {
      const baum_i_row_block *rows = &x->s.structure.row_blocks[k];
      for (int i = 0; i < rows->rows * rows->cols; i++) {
        int column = rows->col[i % rows->cols];
        bool is_its = column >= body->first && column < body->first + 3;
        x->s.jacobian[rows->value + i] *= is_its ? 0.0 : 1.0;
      }
    }
    double want[MOST_UNKNOWNS];
    saddle_solve(&x->s, want);
    memcpy(x->s.jacobian, jacobian, (size_t)x->s.jacobian_count * sizeof *jacobian);
    memcpy(x->s.f + body->first, force, sizeof force);
    x->fixed[at] = 1;
    solve(x, &plain, 2);
    assert_solution(x, want, 1e-12);
    tested++;
    unmake(x);
  }
  assert_true(tested > 10);
}

static void both_versions_of_the_loops_agree(void **state)
{
  (void)state;
  const tables own = own_tables();
  for (uint64_t seed = 1; seed <= 40; seed++) {
    double want[MOST_UNKNOWNS];
    equations *x = make(seed, 10);
    make_planar(x);
    int nv = x->s.structure.nv;
    int nc = x->s.structure.nc;
    solve(x, &plain, 1);
    memcpy(want, x->s.a, (size_t)nv * sizeof *want);
    memcpy(want + nv, x->s.lambda, (size_t)nc * sizeof *want);
    solve(x, &own, 1);
    assert_solution(x, want, 1e-12);
    unmake(x);
  }
}

/* ---- pivots ---- */

/* Makes one body with two rows of J. The rows are equal except for one entry, which differs by
 * `apart`. */
static equations *make_close_rows(double apart)
{
  equations *x = calloc(1, sizeof *x);
  assert_non_null(x);
  x->s = saddle_make_dense(3, 2);
  x->diagonal[0] = 1;
  for (int i = 0; i < 3; i++) {
    x->s.mass[4 * i] = 1.0;
    x->s.f[i] = 1.0 + i;
    x->s.jacobian[i] = 0.5 + i;
    x->s.jacobian[3 + i] = 0.5 + i;
  }
  x->s.jacobian[3] += apart;
  x->s.r[0] = 1.0;
  x->s.r[1] = -1.0;
  return x;
}

static void pivots_tell_how_close_to_singular_a_system_is(void **state)
{
  (void)state;
  static const struct {
    double apart;
    baum_i_pivots pivots;
  } cases[] = {{1.0, BAUM_I_PIVOTS_GOOD},  {0.1, BAUM_I_PIVOTS_GOOD}, {1e-3, BAUM_I_PIVOTS_WEAK},
               {1e-4, BAUM_I_PIVOTS_WEAK}, {1e-6, BAUM_I_PIVOTS_BAD}, {0.0, BAUM_I_PIVOTS_BAD}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    equations *x = make_close_rows(cases[k].apart);
    baum_i_block *b = NULL;
    assert_int_equal(create(x, NULL, &b), BAUM_OK);
    assert_int_equal(factor(x, &plain, b), cases[k].pivots);
    baum_i_block_destroy(b);
    unmake(x);
  }
}

static void refinement_restores_the_accuracy_lost_by_weak_pivots(void **state)
{
  (void)state;
  double want[5];
  equations *x = make_close_rows(1e-4);
  saddle_solve(&x->s, want);
  solve(x, &plain, 0);
  double lost = fabs(x->s.lambda[0] - want[3]) / fabs(want[3]);
  solve(x, &plain, 2);
  assert_true(lost > 1e-12); /* otherwise there is nothing to restore */
  assert_solution(x, want, 1e-14);
  unmake(x);
}

static void masses_that_are_not_positive_are_reported(void **state)
{
  (void)state;
  baum_i_block *b = NULL;
  equations *x = make(3, 4);
  const baum_i_mass_block *body = &x->s.structure.mass_blocks[1];
  assert_int_equal(create(x, NULL, &b), BAUM_OK);
  assert_true(baum_i_block_factor_dense(b, x->s.mass));
  x->s.mass[body->value + body->size + 1] = 0.0; /* changes only the entry on the diagonal */
  assert_false(baum_i_block_factor_dense(b, x->s.mass));
  baum_i_block_destroy(b);
  unmake(x);
  x = make_close_rows(1.0);
  x->s.mass[4] = 0.0;
  assert_int_equal(create(x, NULL, &b), BAUM_OK);
  assert_false(baum_i_block_set_mass(b, x->s.mass));
  x->s.mass[4] = 1.0;
  assert_true(baum_i_block_set_mass(b, x->s.mass));
  baum_i_block_destroy(b);
  unmake(x);
}

/* ---- pins, in whole mechanisms ---- */

static void use_plain(baum_workspace *w)
{
  w->path->kernel = &baum_i_block_kernel_plain;
  w->path->sides_kernel = &baum_i_block_sides_kernel_plain;
  w->path->pins_kernel = &baum_i_pins_kernel_plain;
  w->point.kernel = &baum_i_frames_kernel_plain;
}

/* The tolerance is relative to the largest number in `want`, or to `scale` if that is larger.
 * `scale` is the size of the terms whose sum gives `want`. */
static void assert_near_all(const double *got, const double *want, int count, double tolerance,
                            double scale)
{
  double size = fmax(largest_of(want, count), scale);
  for (int i = 0; i < count; i++) {
    ASSERT_NEAR(got[i], want[i], 0.0, tolerance * size);
  }
}

/* Compares three results for a mechanism in its design configuration: from both versions of the
 * loops, and from the solver of the whole system. */
static void compare(const baum_mechanism *m, double tolerance)
{
  baum_workspace *w[3];
  double q[MOST_UNKNOWNS];
  double v[MOST_UNKNOWNS];
  assert_true(m->nv <= MOST_UNKNOWNS);
  for (int k = 0; k < 3; k++) {
    assert_int_equal(baum_workspace_create(m, &w[k]), BAUM_OK);
    assert_non_null(w[k]->path);
    assert_int_equal(baum_workspace_design(w[k], q, v), BAUM_OK);
  }
  for (int i = 0; i < m->nv; i++) {
    v[i] = isnan(v[i]) ? 0.1 * i : v[i];
  }
  use_plain(w[1]);
  baum_i_paths_destroy(&(baum_i_paths){w[2]->path, w[2]->motion});
  w[2]->path = NULL;
  w[2]->motion = NULL;
  for (int k = 0; k < 3; k++) {
    assert_int_equal(baum_i_acceleration(w[k], 0.0, q, v, 5.0, 7.0), BAUM_OK);
    assert_near_all(w[k]->a, w[0]->a, m->nv, tolerance, 0.0);
    /* If the mechanism is at rest, the multipliers may be mere rounding errors of the forces. */
    double force = largest_of(w[0]->force, m->nv);
    assert_near_all(w[k]->lambda, w[0]->lambda, m->nc, tolerance, force);
  }
  for (int k = 0; k < 3; k++) {
    baum_workspace_destroy(w[k]);
  }
}

static void compare_model(baum_status status, model m)
{
  assert_int_equal(status, BAUM_OK);
  compare(m.mechanism, 1e-12);
  model_destroy(&m);
}

static void accelerations_agree_for_both_versions_and_the_whole_system(void **state)
{
  (void)state;
  model m;
  model_slider_crank crank = {.driven = true, .angle = 1.0, .moving = true};
  model_n_four_bar bars = model_n_four_bar_a02(20);
  double angle[50];
  for (int k = 0; k < 50; k++) {
    angle[k] = sin(k);
  }
  model_chain chain = {.links = 50, .angle = angle};
  baum_status status = model_slider_crank_build(crank, &m);
  compare_model(status, m);
  crank.doubled_guide = true;
  status = model_slider_crank_build(crank, &m);
  compare_model(status, m);
  status = model_andrews_bodies(&m);
  compare_model(status, m);
  status = model_andrews_angles(true, &m);
  compare_model(status, m);
  status = model_car_axis(true, &m);
  compare_model(status, m);
  status = model_n_four_bar_build(&bars, &m);
  compare_model(status, m);
  status = model_chain_build(&chain, &m);
  compare_model(status, m);
}

static baum_body_id add_body(baum_mechanism *m, double x, double y)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.position[0] = x;
  def.position[1] = y;
  def.mass = 1.0 + x;
  assert_int_equal(baum_mechanism_add_planar_body(m, &def, &id), BAUM_OK);
  return id;
}

/* Two pins between the same bodies have one redundant row. This row is omitted, and the other row
 * of the same pin then forms a node alone. Both rows of a third pin are redundant. */
static void several_pins_between_the_same_bodies(void **state)
{
  (void)state;
  for (int pins = 1; pins <= 4; pins++) {
    baum_mechanism *m = create_mechanism();
    baum_body_id a = add_body(m, 0.5, 0.2);
    baum_body_id b = add_body(m, 1.5, -0.3);
    add_planar_pin(m, NULL, BAUM_GROUND, a, 0.0, 0.0);
    for (int k = 0; k < pins; k++) {
      add_planar_pin(m, NULL, k % 2 ? a : b, k % 2 ? b : a, k < 2 ? 1.0 : 1.2, k % 2 ? 0.4 : 0.0);
    }
    assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
    compare(m, 1e-12);
    baum_mechanism_destroy(m);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(dense_masses_are_solved),
    cmocka_unit_test(diagonal_masses_among_dense_ones_are_solved),
    cmocka_unit_test(omitted_rows_have_no_influence),
    cmocka_unit_test(fixed_bodies_are_ground),
    cmocka_unit_test(both_versions_of_the_loops_agree),
    cmocka_unit_test(pivots_tell_how_close_to_singular_a_system_is),
    cmocka_unit_test(refinement_restores_the_accuracy_lost_by_weak_pivots),
    cmocka_unit_test(masses_that_are_not_positive_are_reported),
    cmocka_unit_test(accelerations_agree_for_both_versions_and_the_whole_system),
    cmocka_unit_test(several_pins_between_the_same_bodies),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
