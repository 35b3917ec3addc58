/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests saddle-point systems: products with the matrix, solutions, and systems that are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "saddle_solver.h"

#define PI 3.14159265358979323846

/* ---- products ---- */

static void products_agree_with_the_dense_matrix(void **state)
{
  (void)state;
  saddle system = saddle_make_random(7, 9);
  int nv = system.structure.nv;
  int n = nv + system.structure.nc;
  double *matrix = calloc((size_t)n * (size_t)n, sizeof *matrix);
  double *y = calloc((size_t)n, sizeof *y);
  assert_true(matrix && y);
  saddle_write_dense(&system, matrix);
  baum_i_mass_times(&system.structure, system.mass, system.f, y);
  baum_i_jacobian_transposed_times(&system.structure, system.jacobian, system.r, y);
  baum_i_jacobian_times(&system.structure, system.jacobian, system.f, y + nv);
  for (int i = 0; i < n; i++) {
    double want = 0.0;
    for (int j = 0; j < n; j++) {
      want += matrix[i * n + j] * (j < nv ? system.f[j] : system.r[j - nv]);
    }
    /* The limit is the rounding error of sums of about 20 numbers of up to 2. */
    ASSERT_NEAR(y[i], want, 0.0, 1e-14);
  }
  free(matrix);
  free(y);
  saddle_free(&system);
}

static void products_are_added_to_the_result(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(1, 1);
  double y = 10.0;
  double x = 3.0;
  system.mass[0] = 2.0;
  system.jacobian[0] = 5.0;
  baum_i_mass_times(&system.structure, system.mass, &x, &y);
  ASSERT_NEAR(y, 16.0, 0.0, 0.0);
  baum_i_jacobian_times(&system.structure, system.jacobian, &x, &y);
  ASSERT_NEAR(y, 31.0, 0.0, 0.0);
  baum_i_jacobian_transposed_times(&system.structure, system.jacobian, &x, &y);
  ASSERT_NEAR(y, 46.0, 0.0, 0.0);
  saddle_free(&system);
}

/* ---- solutions ---- */

static void random_systems_are_solved_to_rounding_by_every_backend(void **state)
{
  (void)state;
  for (int k = 0; k < CHOICES; k++) {
    for (uint64_t seed = 1; seed <= 40; seed++) {
      saddle system = saddle_make_random(seed, 2 + (int)seed);
      baum_i_kkt *kkt = make_solver(&system, choices[k]);
      solve_and_compare(kkt, &system, 1e-10);              /* the condition number is about 1e5 */
      assert_true(saddle_backward_error(&system) < 3e-14); /* the solver's own limit is 2.2e-14 */
      assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_GOOD);
      assert_string_equal(baum_i_kkt_backend(kkt), names[k]);
      baum_i_kkt_destroy(kkt);
      saddle_free(&system);
    }
  }
}

static void new_values_on_the_same_structure_keep_the_pivots(void **state)
{
  (void)state;
  uint64_t seed = 11;
  saddle system = saddle_make_random(seed, 12);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_KLU);
  for (int k = 0; k < 50; k++) {
    for (int i = 0; i < system.jacobian_count; i++) {
      system.jacobian[i] *= 1.0 + 0.01 * saddle_random(&seed);
    }
    solve_and_compare(kkt, &system, 1e-10);
  }
  baum_i_kkt_counters counters = baum_i_kkt_get_counters(kkt);
  assert_int_equal(counters.factorizations, 50);
  assert_int_equal(counters.full_factorizations, 1);
  assert_int_equal(counters.fallbacks, 0);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void omitted_rows_have_no_multiplier_and_no_influence(void **state)
{
  (void)state;
  for (int k = 0; k < CHOICES; k++) {
    saddle system = saddle_make_random(3, 10);
    saddle_use_omitted(&system);
    baum_i_kkt *kkt = make_solver(&system, choices[k]);
    for (int i = 0; i < system.structure.nc; i += 4) {
      system.omitted[i] = 1;
      system.r[i] = 1e30; /* must never be read */
    }
    solve_and_compare(kkt, &system, 1e-10);
    for (int i = 0; i < system.structure.nc; i += 4) {
      assert_true(system.lambda[i] == 0.0);
    }
    memset(system.omitted, 0, (size_t)system.structure.nc);
    for (int i = 0; i < system.structure.nc; i += 4) {
      system.r[i] = 1.0;
    }
    solve_and_compare(kkt, &system, 1e-10);
    memset(system.omitted, 1, (size_t)system.structure.nc);
    solve_and_compare(kkt, &system, 1e-10);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void a_shift_makes_dependent_rows_solvable(void **state)
{
  (void)state;
  for (int k = 0; k < CHOICES; k++) {
    saddle system = saddle_make_dense(5, 3);
    uint64_t seed = 5;
    saddle_use_shift(&system);
    for (int j = 0; j < 5; j++) {
      system.mass[(ptrdiff_t)6 * j] = 1.0 + j;
      system.jacobian[j] = system.jacobian[5 + j] = saddle_random(&seed);
      system.jacobian[10 + j] = saddle_random(&seed);
      system.f[j] = saddle_random(&seed);
    }
    system.r[0] = 1.0;
    system.r[1] = -2.0;
    system.shift[0] = 0.5;
    system.shift[1] = 0.25;
    baum_i_kkt *kkt = make_solver(&system, choices[k]);
    solve_and_compare(kkt, &system, 1e-12);
    assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_GOOD);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void one_velocity_without_constraints_is_a_division(void **state)
{
  (void)state;
  for (int k = 0; k < CHOICES; k++) {
    saddle system = saddle_make_dense(1, 0);
    system.structure.row_block_count = 0;
    system.mass[0] = 8.0;
    system.f[0] = 3.0;
    baum_i_kkt *kkt = make_solver(&system, choices[k]);
    assert_int_equal(factor(kkt, &system), BAUM_OK);
    assert_int_equal(baum_i_kkt_solve(kkt, system.f, NULL, system.a, NULL), BAUM_OK);
    ASSERT_NEAR(system.a[0], 0.375, 0.0, 0.0);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void as_many_rows_as_velocities_leave_no_degree_of_freedom(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(3, 3);
  for (int j = 0; j < 3; j++) {
    system.mass[(ptrdiff_t)4 * j] = 1.0;
    system.jacobian[(ptrdiff_t)4 * j] = 2.0;
    system.r[j] = j;
  }
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  solve_and_compare(kkt, &system, 1e-15);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void two_blocks_may_share_rows(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(4, 2);
  uint64_t seed = 2;
  for (int j = 0; j < 4; j++) {
    system.mass[(ptrdiff_t)5 * j] = 1.0 + j;
    system.f[j] = saddle_random(&seed);
  }
  for (int k = 0; k < 8; k++) {
    system.jacobian[k] = saddle_random(&seed);
  }
  baum_i_row_block halves[2] = {{.rows = 2, .cols = 2, .col = system.columns},
                                {.rows = 2, .cols = 2, .col = system.columns + 2, .value = 4}};
  system.structure.row_blocks = halves;
  system.structure.row_block_count = 2;
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  solve_and_compare(kkt, &system, 1e-13);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void a_zero_right_hand_side_gives_a_zero_solution(void **state)
{
  (void)state;
  for (int k = 0; k < CHOICES; k++) {
    saddle system = saddle_make_random(4, 5);
    memset(system.f, 0, (size_t)system.structure.nv * sizeof *system.f);
    memset(system.r, 0, (size_t)system.structure.nc * sizeof *system.r);
    baum_i_kkt *kkt = make_solver(&system, choices[k]);
    assert_int_equal(factor(kkt, &system), BAUM_OK);
    assert_int_equal(solve(kkt, &system), BAUM_OK);
    assert_true(largest_of(system.a, system.structure.nv) == 0.0);
    assert_true(largest_of(system.lambda, system.structure.nc) == 0.0);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

/* ---- refusals ---- */

static void solving_before_factoring_is_singular(void **state)
{
  (void)state;
  saddle system = saddle_make_random(1, 3);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_SINGULAR);
  assert_true(baum_i_kkt_rcond(kkt) == 0.0);
  assert_int_equal(solve(kkt, &system), BAUM_ERR_SINGULAR);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void matrices_that_are_not_finite_are_refused(void **state)
{
  (void)state;
  const double bad[] = {NAN, INFINITY, -INFINITY};
  for (int k = 0; k < 9; k++) {
    saddle system = saddle_make_random(1, 4);
    saddle_use_shift(&system);
    double *places[] = {system.mass + system.mass_blocks[2].value + 1,
                        system.jacobian + system.row_blocks[1].value, system.shift + 3};
    baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
    solve_and_compare(kkt, &system, 1e-12);
    double good = *places[k / 3];
    *places[k / 3] = bad[k % 3];
    assert_int_equal(factor(kkt, &system), BAUM_ERR_NOT_FINITE);
    assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_SINGULAR);
    assert_int_equal(solve(kkt, &system), BAUM_ERR_SINGULAR);
    *places[k / 3] = good;
    solve_and_compare(kkt, &system, 1e-12);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void a_right_hand_side_that_is_not_finite_changes_nothing(void **state)
{
  (void)state;
  saddle system = saddle_make_random(1, 4);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  assert_int_equal(factor(kkt, &system), BAUM_OK);
  system.a[0] = 123.0;
  system.lambda[0] = 456.0;
  double *places[] = {system.f + 1, system.r + 2};
  for (int k = 0; k < 2; k++) {
    double good = *places[k];
    *places[k] = NAN;
    assert_int_equal(solve(kkt, &system), BAUM_ERR_NOT_FINITE);
    *places[k] = good;
  }
  assert_true(system.a[0] == 123.0 && system.lambda[0] == 456.0);
  assert_int_equal(solve(kkt, &system), BAUM_OK);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

/* Replaces every 6 x 6 block of M by the mass matrix of a slender rod along (1, 2, 2), and sorts
 * the columns of J. The array of the values of M keeps its gaps between the blocks. */
static void make_rods(saddle *system)
{
  static const double axis[3] = {1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
  for (int b = 0; b < system->structure.mass_block_count; b++) {
    const baum_i_mass_block *block = &system->mass_blocks[b];
    double *m = system->mass + block->value;
    for (int k = 0; k < 36 && block->size == 6; k++) {
      int i = k / 6;
      int j = k % 6;
      double turn = i > 2 && j > 2 ? (1.0 - 1e-6) * axis[i - 3] * axis[j - 3] : 0.0;
      m[k] = (i == j ? 1.0 : 0.0) - turn;
    }
  }
  for (int b = 0; b < system->structure.row_block_count; b++) {
    const baum_i_row_block *block = &system->row_blocks[b];
    int *col = system->columns + (block->col - system->columns);
    for (int i = 1; i < block->cols; i++) {
      for (int k = i; k > 0 && col[k] < col[k - 1]; k--) {
        int kept = col[k];
        col[k] = col[k - 1];
        col[k - 1] = kept;
      }
    }
  }
}

static void slender_tensors_are_whitened_in_blocks_with_gaps(void **state)
{
  (void)state;
  for (int k = 0; k < CHOICES; k++) {
    saddle system = saddle_make_random(5, 9);
    make_rods(&system);
    baum_i_kkt *kkt = make_solver(&system, choices[k]);
    /* Rounding errors of the tensors are magnified by the ratio 1e6 of the moments of inertia. */
    solve_and_compare(kkt, &system, 1e-9);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void destroying_null_does_nothing(void **state)
{
  (void)state;
  baum_i_kkt_destroy(NULL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(products_agree_with_the_dense_matrix),
    cmocka_unit_test(products_are_added_to_the_result),
    cmocka_unit_test(random_systems_are_solved_to_rounding_by_every_backend),
    cmocka_unit_test(new_values_on_the_same_structure_keep_the_pivots),
    cmocka_unit_test(omitted_rows_have_no_multiplier_and_no_influence),
    cmocka_unit_test(a_shift_makes_dependent_rows_solvable),
    cmocka_unit_test(one_velocity_without_constraints_is_a_division),
    cmocka_unit_test(as_many_rows_as_velocities_leave_no_degree_of_freedom),
    cmocka_unit_test(two_blocks_may_share_rows),
    cmocka_unit_test(slender_tensors_are_whitened_in_blocks_with_gaps),
    cmocka_unit_test(a_zero_right_hand_side_gives_a_zero_solution),
    cmocka_unit_test(solving_before_factoring_is_singular),
    cmocka_unit_test(matrices_that_are_not_finite_are_refused),
    cmocka_unit_test(a_right_hand_side_that_is_not_finite_changes_nothing),
    cmocka_unit_test(destroying_null_does_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
