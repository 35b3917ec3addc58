/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the general sparse LU: solutions, pivots that are kept or chosen again, and singular
 * matrices. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "linear/sparse_lu.h"

/* The matrix [ a 0 2 ; 1 b 0 ; 0 3 4 ] in compressed columns. Its determinant is 4 a b + 6. */
static const int32_t COLUMNS[] = {0, 2, 4, 6};
static const int32_t ROWS[] = {0, 1, 1, 2, 0, 2};

static void fill(double a, double b, double values[6])
{
  const double all[6] = {a, 1.0, b, 3.0, 2.0, 4.0};
  memcpy(values, all, sizeof all);
}

static void check_solution(baum_i_sparse_lu *lu, double a, double b)
{
  double values[6];
  fill(a, b, values);
  assert_int_equal(baum_i_sparse_lu_factor(lu, values), BAUM_OK);
  double x[3] = {a * 1.0 + 2.0 * 3.0, 1.0 + b * 2.0, 3.0 * 2.0 + 4.0 * 3.0};
  baum_i_sparse_lu_solve(lu, x);
  for (int i = 0; i < 3; i++) {
    /* The errors are only rounding errors, because the matrix is well-conditioned. */
    ASSERT_NEAR(x[i], i + 1.0, 1e-14, 0.0);
  }
}

static void several_matrices_are_solved_with_the_same_pivots(void **state)
{
  (void)state;
  baum_i_sparse_lu *lu = NULL;
  assert_int_equal(baum_i_sparse_lu_create(3, COLUMNS, ROWS, &lu), BAUM_OK);
  for (int k = 0; k < 5; k++) {
    check_solution(lu, 5.0 + k, 7.0 - k);
  }
  baum_i_sparse_lu_work work = baum_i_sparse_lu_get_work(lu);
  assert_int_equal(work.factorizations, 5);
  assert_int_equal(work.full_factorizations, 1);
  baum_i_sparse_lu_destroy(lu);
}

/* The pivots of the first matrix, a and b, become small. The solver must then choose other
 * pivots. */
static void pivots_that_become_small_are_replaced(void **state)
{
  (void)state;
  baum_i_sparse_lu *lu = NULL;
  assert_int_equal(baum_i_sparse_lu_create(3, COLUMNS, ROWS, &lu), BAUM_OK);
  check_solution(lu, 100.0, 100.0);
  check_solution(lu, 1e-14, 1e-14);
  assert_int_equal(baum_i_sparse_lu_get_work(lu).full_factorizations, 2);
  baum_i_sparse_lu_destroy(lu);
}

static void a_matrix_without_full_rank_is_reported(void **state)
{
  (void)state;
  baum_i_sparse_lu *lu = NULL;
  double values[6];
  assert_int_equal(baum_i_sparse_lu_create(3, COLUMNS, ROWS, &lu), BAUM_OK);
  fill(1.0, -1.5, values);
  assert_int_equal(baum_i_sparse_lu_factor(lu, values), BAUM_ERR_SINGULAR);
  check_solution(lu, 5.0, 7.0); /* a later matrix must be solved */
  fill(1.0, -1.5, values);
  assert_int_equal(baum_i_sparse_lu_factor(lu, values), BAUM_ERR_SINGULAR);
  baum_i_sparse_lu_destroy(lu);
  baum_i_sparse_lu_destroy(NULL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(several_matrices_are_solved_with_the_same_pivots),
    cmocka_unit_test(pivots_that_become_small_are_replaced),
    cmocka_unit_test(a_matrix_without_full_rank_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
