/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares derivatives with five-point differences. A difference is (8 (f_1 - f_-1) - (f_2 - f_-2))
 * / (12 h), with h = 1e-3. The truncation error is h^4 f''''' / 30, which is 3e-14 times the fifth
 * derivative. Rounding errors are about 1e-12 f. At the states of test_point_random(), f and its
 * fifth derivative may be several thousand. The tolerance, absolute and relative, is therefore
 * 1e-8. */
#include "derivatives.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "mechanism/general/columns.h"
#include "mechanism/manifold.h"

static const double STEP = 1e-3;
static const double TOLERANCE = 1e-8;

enum { MATRIX = TEST_SIZE_MAX * TEST_SIZE_MAX };

/* Fixed arguments of the functions below. With these, the functions depend only on the state. */
typedef struct directions {
  double w[TEST_SIZE_MAX];
  double lambda[TEST_SIZE_MAX];
  int coordinate; /* which coordinate of the first joint is tested */
} directions;

typedef void state_fn(test_point *p, const directions *d, double *out);

static directions some_directions(void)
{
  directions d = {.coordinate = 0};
  uint64_t seed = 17;
  for (int i = 0; i < TEST_SIZE_MAX; i++) {
    d.w[i] = test_uniform(&seed, -2.0, 2.0);
    d.lambda[i] = test_uniform(&seed, -5.0, 5.0);
  }
  return d;
}

/* ---- blocks of all elements added to full matrices ---- */

static void spread_rows(const test_point *p, const double *blocks, double *full)
{
  memset(full, 0, MATRIX * sizeof *full);
  for (int k = 0; k < p->mechanism->joint_count; k++) {
    const baum_i_joint *joint = p->mechanism->joints[k];
    const baum_i_span *span = &joint->span;
    for (int i = 0; i < joint->rows; i++) {
      for (int j = 0; j < span->nl; j++) {
        full[(joint->row + i) * p->nv + span->columns[j]] +=
          blocks[joint->jacobian + i * span->nl + j];
      }
    }
  }
}

static void spread_square(const test_point *p, const baum_i_span *span, const double *block,
                          double *full)
{
  for (int i = 0; i < span->nl; i++) {
    for (int j = 0; j < span->nl; j++) {
      full[span->columns[i] * p->nv + span->columns[j]] += block[i * span->nl + j];
    }
  }
}

static void spread_joint_squares(const test_point *p, const double *blocks, double *full)
{
  memset(full, 0, MATRIX * sizeof *full);
  for (int k = 0; k < p->mechanism->joint_count; k++) {
    const baum_i_joint *joint = p->mechanism->joints[k];
    spread_square(p, &joint->span, blocks + joint->square, full);
  }
}

static void spread_force_squares(const test_point *p, const double *blocks, double *full)
{
  memset(full, 0, MATRIX * sizeof *full);
  for (int k = 0; k < p->mechanism->force_count; k++) {
    const baum_i_force *force = p->mechanism->forces[k];
    spread_square(p, &force->span, blocks + force->square, full);
  }
}

/* ---- functions of the state ---- */

/* Fills the values with NaN. This shows whether a function adds to old values, or does not set a
 * value. */
static void spoil(double *values, int count)
{
  for (int i = 0; i < count; i++) {
    values[i] = (double)NAN;
  }
}

static void full_jacobian(test_point *p, double *full)
{
  double blocks[MATRIX];
  spoil(blocks, p->mechanism->jacobian_size);
  assert_int_equal(baum_i_mechanism_jacobian(&p->point, blocks), BAUM_OK);
  spread_rows(p, blocks, full);
}

static void phi_of(test_point *p, const directions *d, double *out)
{
  (void)d;
  spoil(out, p->nc);
  assert_int_equal(baum_i_mechanism_phi(&p->point, out), BAUM_OK);
}

static void nu_of(test_point *p, const directions *d, double *out)
{
  (void)d;
  spoil(out, p->nc);
  assert_int_equal(baum_i_mechanism_nu(&p->point, out), BAUM_OK);
}

static void gamma_of(test_point *p, const directions *d, double *out)
{
  (void)d;
  spoil(out, p->nc);
  assert_int_equal(baum_i_mechanism_gamma(&p->point, out), BAUM_OK);
}

static void product_of(test_point *p, const double *x, double *out)
{
  double jacobian[MATRIX];
  full_jacobian(p, jacobian);
  for (int i = 0; i < p->nc; i++) {
    out[i] = 0.0;
    for (int j = 0; j < p->nv; j++) {
      out[i] += jacobian[i * p->nv + j] * x[j];
    }
  }
}

static void jw_of(test_point *p, const directions *d, double *out)
{
  product_of(p, d->w, out);
}

static void jtl_of(test_point *p, const directions *d, double *out)
{
  double jacobian[MATRIX];
  full_jacobian(p, jacobian);
  for (int j = 0; j < p->nv; j++) {
    out[j] = 0.0;
    for (int i = 0; i < p->nc; i++) {
      out[j] += jacobian[i * p->nv + j] * d->lambda[i];
    }
  }
}

/* Computes Phi' = J v - nu. */
static void rate_of(test_point *p, const directions *d, double *out)
{
  double nu[TEST_SIZE_MAX];
  nu_of(p, d, nu);
  product_of(p, p->v, out);
  for (int i = 0; i < p->nc; i++) {
    out[i] -= nu[i];
  }
}

static void force_of(test_point *p, const directions *d, double *out)
{
  (void)d;
  assert_int_equal(baum_i_mechanism_force(&p->point, out), BAUM_OK);
}

static void potential_of(test_point *p, const directions *d, double *out)
{
  (void)d;
  assert_int_equal(baum_i_mechanism_potential(&p->point, out), BAUM_OK);
}

/* ---- the joint's coordinate ---- */

static baum_i_coordinate coordinate_at(const test_point *p, const directions *d)
{
  const baum_i_joint *joint = p->mechanism->joints[0];
  baum_i_coordinate c;
  joint->type->coordinate(joint, d->coordinate, &p->point, &c);
  return c;
}

/* Copies the columns that belong to the first joint's bodies to an array of all nv columns.
 * wide_of() does the reverse. */
static void spread_wide(const test_point *p, const double *wide, double *full)
{
  const baum_i_joint *joint = p->mechanism->joints[0];
  memset(full, 0, (size_t)p->nv * sizeof *full);
  baum_i_columns_scatter_any(p->mechanism, &joint->span, joint->type->width, wide, full);
}

static void wide_of(const test_point *p, const double *full, double wide[BAUM_I_PAIR_COLUMNS])
{
  const baum_i_joint *joint = p->mechanism->joints[0];
  baum_i_columns_gather(&p->point, &joint->span, joint->type->width, full, wide);
}

static void value_of(test_point *p, const directions *d, double *out)
{
  *out = coordinate_at(p, d).value;
}

static void coordinate_rate_of(test_point *p, const directions *d, double *out)
{
  *out = coordinate_at(p, d).rate;
}

static void coordinate_gamma_of(test_point *p, const directions *d, double *out)
{
  *out = coordinate_at(p, d).gamma;
}

static void coordinate_gradient_of(test_point *p, const directions *d, double *out)
{
  spread_wide(p, coordinate_at(p, d).gradient, out);
}

static void coordinate_jw_of(test_point *p, const directions *d, double *out)
{
  double gradient[TEST_SIZE_MAX];
  coordinate_gradient_of(p, d, gradient);
  *out = 0.0;
  for (int i = 0; i < p->nv; i++) {
    *out += gradient[i] * d->w[i];
  }
}

/* ---- differences ---- */

static void evaluate_at(test_point *p, const test_point *from, double step,
                        const double direction[1 + 2 * TEST_SIZE_MAX], state_fn *fn,
                        const directions *d, double *out)
{
  p->t = from->t + step * direction[0];
  baum_i_move_from(p->mechanism, from->q, step, direction + 1, p->q);
  for (int i = 0; i < p->nv; i++) {
    p->v[i] = from->v[i] + step * direction[1 + TEST_SIZE_MAX + i];
  }
  test_point_update(p);
  fn(p, d, out);
}

/* Computes the derivative of fn(t, q, v) along a direction. */
static void slope(test_point *p, const double direction[1 + 2 * TEST_SIZE_MAX], state_fn *fn,
                  const directions *d, int count, double *out)
{
  const test_point from = *p;
  double f[4][TEST_SIZE_MAX];
  static const double places[4] = {-2.0, -1.0, 1.0, 2.0};
  for (int k = 0; k < 4; k++) {
    evaluate_at(p, &from, places[k] * STEP, direction, fn, d, f[k]);
  }
  for (int i = 0; i < count; i++) {
    out[i] = (8.0 * (f[2][i] - f[1][i]) - (f[3][i] - f[0][i])) / (12.0 * STEP);
  }
  *p = from;
  test_point_update(p);
}

static void compare(const char *what, int row, int column, double got, double difference)
{
  if (fabs(got - difference) > TOLERANCE * (1.0 + fabs(difference))) {
    print_error("%s, row %d, column %d\n", what, row, column);
  }
  ASSERT_NEAR(got, difference, TOLERANCE, TOLERANCE);
}

/* Checks that a matrix (count x nv) is the derivative of fn, either with respect to q or with
 * respect to v. */
static void check_matrix(test_point *p, const char *what, bool in_q, state_fn *fn,
                         const directions *d, int count, const double *matrix)
{
  for (int j = 0; j < p->nv; j++) {
    double direction[1 + 2 * TEST_SIZE_MAX] = {0.0};
    double column[TEST_SIZE_MAX];
    direction[1 + (in_q ? 0 : TEST_SIZE_MAX) + j] = 1.0;
    slope(p, direction, fn, d, count, column);
    for (int i = 0; i < count; i++) {
      compare(what, i, j, matrix[i * p->nv + j], column[i]);
    }
  }
}

/* Checks that sign * values is the time derivative of fn. The velocities v are constant. If
 * `moving` is set, q' = v, otherwise q is constant as well. */
static void check_in_time(test_point *p, const char *what, bool moving, state_fn *fn,
                          const directions *d, int count, double sign, const double *values)
{
  double direction[1 + 2 * TEST_SIZE_MAX] = {1.0};
  double difference[TEST_SIZE_MAX];
  if (moving) {
    memcpy(direction + 1, p->v, (size_t)p->nv * sizeof(double));
  }
  slope(p, direction, fn, d, count, difference);
  for (int i = 0; i < count; i++) {
    compare(what, i, -1, sign * values[i], difference[i]);
  }
}

/* ---- joints ---- */

/* Sets rows of velocity level to zero, because Phi of these rows is zero. */
static void clear_velocity_rows(const test_point *p, int columns, double *values)
{
  for (int i = 0; i < p->nc; i++) {
    for (int j = 0; j < columns && baum_i_is_velocity_row(p->mechanism, i); j++) {
      values[i * columns + j] = 0.0;
    }
  }
}

static void check_first_derivatives(test_point *p)
{
  double full[MATRIX];
  double values[TEST_SIZE_MAX];
  const directions d = some_directions();
  full_jacobian(p, full);
  clear_velocity_rows(p, p->nv, full);
  check_matrix(p, "J", true, phi_of, &d, p->nc, full);
  nu_of(p, &d, values);
  clear_velocity_rows(p, 1, values);
  check_in_time(p, "nu", false, phi_of, &d, p->nc, -1.0, values);
  gamma_of(p, &d, values);
  check_in_time(p, "gamma", true, rate_of, &d, p->nc, -1.0, values);
}

typedef struct joint_arrays {
  double jw_q[MATRIX];
  double jtl_q[MATRIX];
  double gamma_q[MATRIX];
  double gamma_v[MATRIX];
  double nu_q[MATRIX];
} joint_arrays;

static void linearize_joints(test_point *p, const directions *d, const baum_i_joint_blocks *blocks)
{
  assert_int_equal(baum_i_mechanism_linearize_joints(&p->point, d->w, d->lambda, blocks), BAUM_OK);
}

/* Checks that every block has the same values whether it is requested alone or together with the
 * others. */
static void check_blocks_alone(test_point *p, const directions *d, const joint_arrays *all)
{
  size_t rows = (size_t)p->mechanism->jacobian_size * sizeof(double);
  size_t squares = (size_t)p->mechanism->joint_square_size * sizeof(double);
  double alone[MATRIX];
  linearize_joints(p, d, &(baum_i_joint_blocks){.jw_q = alone});
  assert_memory_equal(alone, all->jw_q, rows);
  linearize_joints(p, d, &(baum_i_joint_blocks){.jtl_q = alone});
  assert_memory_equal(alone, all->jtl_q, squares);
  linearize_joints(p, d, &(baum_i_joint_blocks){.gamma_q = alone});
  assert_memory_equal(alone, all->gamma_q, rows);
  linearize_joints(p, d, &(baum_i_joint_blocks){.gamma_v = alone});
  assert_memory_equal(alone, all->gamma_v, rows);
}

static void check_second_derivatives(test_point *p)
{
  joint_arrays all;
  double full[MATRIX];
  const directions d = some_directions();
  baum_i_joint_blocks blocks = {all.jw_q, all.jtl_q, all.gamma_q, all.gamma_v, all.nu_q};
  linearize_joints(p, &d, &blocks);
  spread_rows(p, all.jw_q, full);
  check_matrix(p, "(J w)_q", true, jw_of, &d, p->nc, full);
  spread_joint_squares(p, all.jtl_q, full);
  check_matrix(p, "(J^T lambda)_q", true, jtl_of, &d, p->nv, full);
  spread_rows(p, all.gamma_q, full);
  check_matrix(p, "gamma_q", true, gamma_of, &d, p->nc, full);
  spread_rows(p, all.gamma_v, full);
  check_matrix(p, "gamma_v", false, gamma_of, &d, p->nc, full);
  spread_rows(p, all.nu_q, full);
  check_matrix(p, "nu_q", true, nu_of, &d, p->nc, full);
  check_blocks_alone(p, &d, &all);
}

void check_joint_derivatives(test_point *p)
{
  check_first_derivatives(p);
  check_second_derivatives(p);
}

static void check_coordinate(test_point *p, int number)
{
  const baum_i_joint *joint = p->mechanism->joints[0];
  directions d = some_directions();
  d.coordinate = number;
  baum_i_coordinate c = coordinate_at(p, &d);
  double full[MATRIX];
  spread_wide(p, c.gradient, full);
  check_matrix(p, "coordinate_q", true, value_of, &d, 1, full);
  check_matrix(p, "rate_v", false, coordinate_rate_of, &d, 1, full);
  check_in_time(p, "coordinate rate", true, value_of, &d, 1, 1.0, &c.rate);
  check_in_time(p, "coordinate gamma", true, coordinate_rate_of, &d, 1, -1.0, &c.gamma);

  double w[BAUM_I_PAIR_COLUMNS];
  baum_i_coordinate_blocks blocks;
  wide_of(p, d.w, w);
  joint->type->coordinate_linearize(joint, number, &p->point, w, 1.0, &blocks);
  spread_wide(p, blocks.jw_q, full);
  check_matrix(p, "coordinate (J w)_q", true, coordinate_jw_of, &d, 1, full);
  spread_wide(p, blocks.rate_q, full);
  check_matrix(p, "coordinate rate_q", true, coordinate_rate_of, &d, 1, full);
  spread_wide(p, blocks.gamma_q, full);
  check_matrix(p, "coordinate gamma_q", true, coordinate_gamma_of, &d, 1, full);
  spread_wide(p, blocks.gamma_v, full);
  check_matrix(p, "coordinate gamma_v", false, coordinate_gamma_of, &d, 1, full);
  memset(full, 0, sizeof full);
  double packed[BAUM_I_PAIR_COLUMNS * BAUM_I_PAIR_COLUMNS];
  baum_i_columns_pack_square(p->mechanism, &joint->span, joint->type->width, blocks.jtl_q, packed);
  spread_square(p, &joint->span, packed, full);
  check_matrix(p, "coordinate_qq", true, coordinate_gradient_of, &d, p->nv, full);
}

void check_coordinate_derivatives(test_point *p)
{
  const baum_joint_coordinate *all = p->mechanism->joints[0]->type->coordinates;
  assert_int_not_equal(all[0], BAUM_COORDINATE_FIRST);
  for (int k = 0; all[k] != BAUM_COORDINATE_FIRST; k++) {
    check_coordinate(p, k);
  }
}

/* ---- forces ---- */

void check_force_derivatives(test_point *p)
{
  double blocks_q[MATRIX];
  double blocks_v[MATRIX];
  double full[MATRIX];
  const directions d = some_directions();
  baum_i_force_blocks blocks = {blocks_q, blocks_v};
  assert_int_equal(baum_i_mechanism_linearize_forces(&p->point, &blocks), BAUM_OK);
  spread_force_squares(p, blocks_q, full);
  check_matrix(p, "force_q", true, force_of, &d, p->nv, full);
  spread_force_squares(p, blocks_v, full);
  check_matrix(p, "force_v", false, force_of, &d, p->nv, full);

  size_t size = (size_t)p->mechanism->force_square_size * sizeof(double);
  double alone[MATRIX];
  blocks = (baum_i_force_blocks){.force_q = alone};
  assert_int_equal(baum_i_mechanism_linearize_forces(&p->point, &blocks), BAUM_OK);
  assert_memory_equal(alone, blocks_q, size);
  blocks = (baum_i_force_blocks){.force_v = alone};
  assert_int_equal(baum_i_mechanism_linearize_forces(&p->point, &blocks), BAUM_OK);
  assert_memory_equal(alone, blocks_v, size);
}

void check_potential_gradient(test_point *p)
{
  const directions d = some_directions();
  double force[TEST_SIZE_MAX];
  memset(p->v, 0, sizeof p->v);
  test_point_update(p);
  force_of(p, &d, force);
  for (int j = 0; j < p->nv; j++) {
    force[j] = -force[j];
  }
  check_matrix(p, "potential_q", true, potential_of, &d, 1, force);
}
