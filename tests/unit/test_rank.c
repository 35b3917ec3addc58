/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "assert_near.h"
#include "saddle.h"

enum { MOST = 64 };

static const double tolerance = 1e-10;

static void fill_with_ones(double *x, int count)
{
  for (int k = 0; k < count; k++) {
    x[k] = 1.0;
  }
}

/* Makes random rows. Each row that `dependent` marks is a random linear combination of the
 * independent rows before it. */
static saddle make_rows(int nv, int nc, const unsigned char *dependent, uint64_t seed)
{
  saddle system = saddle_make_dense(nv, nc);
  for (int i = 0; i < nc; i++) {
    double *row = system.jacobian + (size_t)i * (size_t)nv;
    for (int j = 0; j < nv && !dependent[i]; j++) {
      row[j] = saddle_random(&seed);
    }
    for (int k = 0; k < i && dependent[i]; k++) {
      double part = dependent[k] ? 0.0 : saddle_random(&seed);
      for (int j = 0; j < nv; j++) {
        row[j] += part * system.jacobian[k * nv + j];
      }
    }
  }
  return system;
}

static void assert_rank(const saddle *system, const double *column_scale, int want,
                        const unsigned char *dependent)
{
  unsigned char independent[MOST];
  int rank = -1;
  /* All rows have the same mark, so they are chosen in their order. */
  memset(independent, 7, sizeof independent);
  assert_int_equal(baum_i_jacobian_rank(&system->structure, system->jacobian, column_scale,
                                        tolerance, &rank, independent),
                   BAUM_OK);
  assert_int_equal(rank, want);
  for (int i = 0; i < system->structure.nc; i++) {
    assert_int_equal(independent[i], !dependent[i]);
  }
}

static void later_rows_depend_on_earlier_rows(void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int round = 0; round < 50; round++) {
    unsigned char dependent[MOST] = {0};
    double ones[MOST] = {0};
    int nc = 3 + round % 20;
    int rank = nc;
    for (int i = 2; i < nc; i++) {
      dependent[i] = saddle_random(&seed) > 0.3;
      rank -= dependent[i];
    }
    saddle system = make_rows(nc + 3, nc, dependent, seed);
    fill_with_ones(ones, MOST);
    assert_rank(&system, ones, rank, dependent);
    saddle_free(&system);
  }
}

static void sizes_of_rows_and_columns_do_not_matter(void **state)
{
  (void)state;
  uint64_t seed = 5;
  for (int round = 0; round < 50; round++) {
    const unsigned char dependent[8] = {0, 0, 0, 1, 0, 1, 0, 1};
    double column_scale[10];
    saddle system = make_rows(10, 8, dependent, seed);
    for (int j = 0; j < 10; j++) {
      column_scale[j] = pow(10.0, 12.0 * saddle_random(&seed));
      for (int i = 0; i < 8; i++) {
        system.jacobian[i * 10 + j] /= column_scale[j];
      }
    }
    for (int i = 0; i < 8; i++) {
      double size = pow(10.0, 100.0 * saddle_random(&seed));
      for (int j = 0; j < 10; j++) {
        system.jacobian[i * 10 + j] *= size;
      }
    }
    assert_rank(&system, column_scale, 5, dependent);
    saddle_free(&system);
  }
}

/* Row 2 is the sum of rows 0 and 1. Row 4 is the sum of rows 1, 2 and 3. The cases mark no row, one
 * row and two rows. Marked rows must be chosen before other rows. */
static void marked_rows_are_chosen_first(void **state)
{
  (void)state;
  static const double rows[5][4] = {
    {1, 0, 0, 1}, {0, 1, 0, 0}, {1, 1, 0, 1}, {0, 0, 1, 0}, {1, 2, 1, 1}};
  static const unsigned char marked[3][5] = {{0, 0, 0, 0, 0}, {0, 0, 1, 0, 0}, {0, 0, 0, 1, 1}};
  static const unsigned char want[3][5] = {{1, 1, 0, 1, 0}, {1, 0, 1, 1, 0}, {1, 0, 0, 1, 1}};
  const double ones[] = {1.0, 1.0, 1.0, 1.0};
  saddle system = saddle_make_dense(4, 5);
  memcpy(system.jacobian, rows, sizeof rows);
  for (int k = 0; k < 3; k++) {
    unsigned char independent[5];
    int rank = -1;
    memcpy(independent, marked[k], sizeof independent);
    assert_int_equal(
      baum_i_jacobian_rank(&system.structure, system.jacobian, ones, tolerance, &rank, independent),
      BAUM_OK);
    assert_int_equal(rank, 3);
    assert_memory_equal(independent, want[k], sizeof independent);
  }
  saddle_free(&system);
}

static void the_tolerance_applies_to_the_remainder_of_a_unit_row(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(2, 2);
  const double ones[] = {1.0, 1.0};
  unsigned char independent[2] = {0};
  int rank;
  system.jacobian[0] = system.jacobian[2] = 100.0;
  system.jacobian[3] = 100.0 * 1e-6;
  for (int k = 0; k < 2; k++) {
    double around = k == 0 ? 0.9e-6 : 1.1e-6;
    assert_int_equal(
      baum_i_jacobian_rank(&system.structure, system.jacobian, ones, around, &rank, independent),
      BAUM_OK);
    assert_int_equal(rank, 2 - k);
    assert_true(independent[0] == 1 && independent[1] == 1 - k);
  }
  saddle_free(&system);
}

static void a_joint_added_twice_is_found(void **state)
{
  (void)state;
  saddle system = saddle_make_four_bar(3);
  unsigned char dependent[MOST] = {0};
  double ones[MOST] = {0};
  fill_with_ones(ones, MOST);
  saddle_pose_four_bar(&system, 0.7);
  assert_rank(&system, ones, 20, dependent);
  /* Adds the last joint again, with the same values. */
  baum_i_row_block blocks[11];
  memcpy(blocks, system.row_blocks, 10 * sizeof *blocks);
  blocks[10] = blocks[9];
  blocks[10].row = 20;
  system.structure.row_blocks = blocks;
  system.structure.row_block_count = 11;
  system.structure.nc = 22;
  dependent[20] = dependent[21] = 1;
  assert_rank(&system, ones, 20, dependent);
  saddle_free(&system);
}

static void joints_of_a_sparse_mechanism_added_twice_are_found(void **state)
{
  (void)state;
  for (uint64_t seed = 1; seed <= 30; seed++) {
    saddle system = saddle_make_random(seed, 9);
    unsigned char dependent[MOST] = {0};
    double ones[MOST] = {0};
    baum_i_row_block blocks[18];
    int count = system.structure.row_block_count;
    int nc = system.structure.nc;
    fill_with_ones(ones, MOST);
    memcpy(blocks, system.row_blocks, (size_t)count * sizeof *blocks);
    for (int k = 0; k < 4; k++) {
      blocks[count + k] = blocks[(k * 5 + (int)seed) % count];
      blocks[count + k].row = system.structure.nc;
      for (int i = 0; i < blocks[count + k].rows; i++) {
        dependent[system.structure.nc++] = 1;
      }
    }
    system.structure.row_blocks = blocks;
    system.structure.row_block_count = count + 4;
    assert_true(system.structure.nc <= MOST && system.structure.nv <= MOST);
    assert_rank(&system, ones, nc, dependent);
    saddle_free(&system);
  }
}

static void a_flat_four_bar_has_one_dependent_row(void **state)
{
  (void)state;
  saddle system = saddle_make_four_bar(1);
  unsigned char independent[8] = {0};
  const double scale[] = {1.0, 1.0, 3.4641, 1.0, 1.0, 3.4641, 1.0, 1.0, 3.4641};
  int rank;
  const double angles[] = {0.0, 1e-6};
  for (int k = 0; k < 2; k++) {
    saddle_pose_four_bar(&system, angles[k]);
    assert_int_equal(baum_i_jacobian_rank(&system.structure, system.jacobian, scale, tolerance,
                                          &rank, independent),
                     BAUM_OK);
    assert_int_equal(rank, 7 + k);
  }
  saddle_free(&system);
}

static void rows_of_zeros_are_dependent(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(3, 3);
  const unsigned char dependent[] = {1, 0, 1};
  const double ones[] = {1.0, 1.0, 1.0};
  system.jacobian[4] = 1e-200;
  assert_rank(&system, ones, 1, dependent);
  system.jacobian[4] = 0.0;
  const unsigned char all[] = {1, 1, 1};
  assert_rank(&system, ones, 0, all);
  saddle_free(&system);
}

static void the_rank_is_at_most_the_number_of_velocities(void **state)
{
  (void)state;
  const unsigned char drawn[] = {0, 0, 0, 0, 0, 0};
  const unsigned char dependent[] = {0, 0, 1, 1, 1, 1};
  saddle system = make_rows(2, 6, drawn, 8);
  const double ones[] = {1.0, 1.0};
  assert_rank(&system, ones, 2, dependent);
  saddle_free(&system);
}

static void no_rows_have_rank_zero(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(3, 0);
  const double ones[] = {1.0, 1.0, 1.0};
  const unsigned char none[MOST] = {0};
  assert_rank(&system, ones, 0, none);
  saddle_free(&system);
}

static void numbers_that_are_not_finite_are_refused(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(2, 1);
  double scale[] = {1.0, 1.0};
  unsigned char independent = 7;
  int rank = -1;
  system.jacobian[0] = NAN;
  assert_int_equal(
    baum_i_jacobian_rank(&system.structure, system.jacobian, scale, tolerance, &rank, &independent),
    BAUM_ERR_NOT_FINITE);
  system.jacobian[0] = 1.0;
  scale[0] = INFINITY;
  assert_int_equal(
    baum_i_jacobian_rank(&system.structure, system.jacobian, scale, tolerance, &rank, &independent),
    BAUM_ERR_NOT_FINITE);
  assert_int_equal(rank, -1);
  assert_int_equal(independent, 7);
  saddle_free(&system);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(later_rows_depend_on_earlier_rows),
    cmocka_unit_test(sizes_of_rows_and_columns_do_not_matter),
    cmocka_unit_test(marked_rows_are_chosen_first),
    cmocka_unit_test(the_tolerance_applies_to_the_remainder_of_a_unit_row),
    cmocka_unit_test(a_joint_added_twice_is_found),
    cmocka_unit_test(joints_of_a_sparse_mechanism_added_twice_are_found),
    cmocka_unit_test(a_flat_four_bar_has_one_dependent_row),
    cmocka_unit_test(rows_of_zeros_are_dependent),
    cmocka_unit_test(the_rank_is_at_most_the_number_of_velocities),
    cmocka_unit_test(no_rows_have_rank_zero),
    cmocka_unit_test(numbers_that_are_not_finite_are_refused),
  };
  return cmocka_run_group_tests_name("rank", tests, NULL, NULL);
}
