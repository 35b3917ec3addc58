/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests systems with dependent rows, which the rank-revealing QR backend solves. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "assert_near.h"
#include "linear/backend.h"
#include "saddle.h"

enum { NV = 7, NC = 5, N = NV + NC };

/* Makes a system of five rows. Row 3 equals row 0, and row 4 is row 1 minus row 2. The masses are
 * 1, and the largest entry in each of rows 0 to 3 is 1. Scaling therefore does not change these
 * rows. */
static saddle make_dependent(void)
{
  saddle system = saddle_make_dense(NV, NC);
  uint64_t seed = 9;
  for (int j = 0; j < NV; j++) {
    system.mass[(ptrdiff_t)j * (NV + 1)] = 1.0;
    system.f[j] = saddle_random(&seed);
    for (int i = 0; i < 3; i++) {
      system.jacobian[i * NV + j] = i == j ? 1.0 : ldexp(floor(8.0 * saddle_random(&seed)), -4);
    }
    system.jacobian[3 * NV + j] = system.jacobian[j];
    system.jacobian[4 * NV + j] = system.jacobian[NV + j] - system.jacobian[2 * NV + j];
  }
  saddle_make_consistent(&system, 4);
  return system;
}

/* Solves the system without its rows 3 and 4. */
static void solve_independent(saddle *system, double *want)
{
  saddle_use_omitted(system);
  system->omitted[3] = system->omitted[4] = 1;
  saddle_solve(system, want);
  system->values.omitted = NULL;
}

static baum_i_kkt *make_solver(const saddle *system, baum_i_kkt_choice choice)
{
  baum_i_kkt *kkt = NULL;
  assert_int_equal(baum_i_kkt_create(&system->structure, choice, &kkt), BAUM_OK);
  return kkt;
}

static baum_status factor_and_solve(baum_i_kkt *kkt, saddle *system)
{
  assert_int_equal(baum_i_kkt_factor(kkt, &system->values), BAUM_OK);
  return baum_i_kkt_solve(kkt, system->f, system->r, system->a, system->lambda);
}

static void klu_alone_reports_dependent_rows_as_singular(void **state)
{
  (void)state;
  saddle system = make_dependent();
  memset(system.jacobian + (size_t)4 * NV, 0, NV * sizeof *system.jacobian);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_KLU);
  assert_int_equal(baum_i_kkt_factor(kkt, &system.values), BAUM_ERR_SINGULAR);
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_SINGULAR);
  assert_int_equal(baum_i_kkt_solve(kkt, system.f, system.r, system.a, system.lambda),
                   BAUM_ERR_SINGULAR);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void dependent_rows_leave_accelerations_unique(void **state)
{
  (void)state;
  const baum_i_kkt_choice choices[] = {BAUM_I_KKT_AUTO, BAUM_I_KKT_QR};
  for (int k = 0; k < 2; k++) {
    saddle system = make_dependent();
    double want[N];
    solve_independent(&system, want);
    baum_i_kkt *kkt = make_solver(&system, choices[k]);
    assert_int_equal(factor_and_solve(kkt, &system), BAUM_OK);
    assert_string_equal(baum_i_kkt_backend(kkt), "qr");
    assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_NEAR_SINGULAR);
    assert_int_equal(baum_i_kkt_get_counters(kkt).fallbacks, k == 0);
    for (int j = 0; j < NV; j++) {
      ASSERT_NEAR(system.a[j], want[j], 0.0, 1e-13);
    }
    assert_true(saddle_backward_error(&system) < 1e-13);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void multipliers_that_are_not_unique_have_the_least_norm(void **state)
{
  (void)state;
  saddle system = make_dependent();
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  assert_int_equal(factor_and_solve(kkt, &system), BAUM_OK);
  /* The multipliers have the least norm if they are orthogonal to every w with J^T w = 0. In this
   * system, the vectors (1, 0, 0, -1, 0) and (0, 1, -1, 0, -1) span these w. The norm is computed
   * from the scaled multipliers. Rows 0 to 3 have the scale 1. Row 4 may have another scale e,
   * because it is a difference of rows. */
  const double *lambda = system.lambda;
  double largest = 0.0;
  for (int j = 0; j < NV; j++) {
    largest = fmax(largest, fabs(system.jacobian[4 * NV + j]));
  }
  double e = largest >= 1.0 ? 1.0 / exp2(floor(log2(largest))) : 2.0;
  ASSERT_NEAR(lambda[0] - lambda[3], 0.0, 0.0, 1e-13);
  ASSERT_NEAR(lambda[1] - lambda[2] - lambda[4] / (e * e), 0.0, 0.0, 1e-13);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void rounding_errors_in_dependent_rows_are_tolerated(void **state)
{
  (void)state;
  saddle system = make_dependent();
  double want[N];
  solve_independent(&system, want);
  for (int j = 0; j < NV; j++) {
    system.jacobian[3 * NV + j] *= 1.0 + (j % 2 ? 2.2e-16 : -2.2e-16);
  }
  for (int i = 0; i < NC; i++) {
    system.r[i] += (i % 2 ? 1e-12 : -1e-12);
  }
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  assert_int_equal(factor_and_solve(kkt, &system), BAUM_OK);
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_NEAR_SINGULAR);
  for (int j = 0; j < NV; j++) {
    ASSERT_NEAR(system.a[j], want[j], 0.0, 1e-11);
  }
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void rows_that_contradict_each_other_are_singular(void **state)
{
  (void)state;
  saddle system = make_dependent();
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  system.r[3] += 1e-3;
  system.a[0] = 123.0;
  system.lambda[0] = 456.0;
  assert_int_equal(factor_and_solve(kkt, &system), BAUM_ERR_SINGULAR);
  assert_true(system.a[0] == 123.0 && system.lambda[0] == 456.0);
  system.r[3] -= 1e-3;
  assert_int_equal(factor_and_solve(kkt, &system), BAUM_OK);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void the_units_of_dependent_rows_do_not_matter(void **state)
{
  (void)state;
  const double units[] = {1e-9, 1e-3, 1e3, 1e9};
  for (int k = 0; k < 4; k++) {
    saddle system = make_dependent();
    double want[N];
    solve_independent(&system, want);
    /* Changes the units of rows 3 and 4, and the unit of velocity 5. */
    for (int j = 0; j < NV; j++) {
      system.jacobian[3 * NV + j] *= units[k];
      system.jacobian[4 * NV + j] *= units[3 - k];
    }
    for (int i = 0; i < NC; i++) {
      system.jacobian[i * NV + 5] *= units[k];
    }
    system.r[3] *= units[k];
    system.r[4] *= units[3 - k];
    system.mass[(ptrdiff_t)5 * (NV + 1)] *= units[k] * units[k];
    system.f[5] *= units[k];
    baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
    assert_int_equal(factor_and_solve(kkt, &system), BAUM_OK);
    assert_string_equal(baum_i_kkt_backend(kkt), "qr");
    for (int j = 0; j < NV; j++) {
      ASSERT_NEAR(system.a[j] * (j == 5 ? units[k] : 1.0), want[j], 0.0, 1e-12);
    }
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void more_rows_than_velocities_are_solved_if_they_are_consistent(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(2, 5);
  uint64_t seed = 1;
  system.mass[0] = 3.0;
  system.mass[3] = 5.0;
  for (int k = 0; k < 10; k++) {
    system.jacobian[k] = saddle_random(&seed);
  }
  saddle_make_consistent(&system, 2);
  double want[2] = {system.a[0], system.a[1]};
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  assert_int_equal(factor_and_solve(kkt, &system), BAUM_OK);
  ASSERT_NEAR(system.a[0], want[0], 0.0, 1e-14);
  ASSERT_NEAR(system.a[1], want[1], 0.0, 1e-14);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void rows_of_zeros_have_no_multipliers(void **state)
{
  (void)state;
  saddle system = make_dependent();
  memset(system.jacobian, 0, (size_t)NC * NV * sizeof *system.jacobian);
  memset(system.r, 0, NC * sizeof *system.r);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  assert_int_equal(factor_and_solve(kkt, &system), BAUM_OK);
  for (int j = 0; j < NV; j++) {
    ASSERT_NEAR(system.a[j], system.f[j], 1e-15, 0.0);
  }
  for (int i = 0; i < NC; i++) {
    ASSERT_NEAR(system.lambda[i], 0.0, 0.0, 1e-15);
  }
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void qr_estimates_how_singular_a_matrix_is(void **state)
{
  (void)state;
  saddle system = saddle_make_four_bar(1);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_QR);
  saddle_pose_four_bar(&system, 1.0);
  assert_int_equal(baum_i_kkt_factor(kkt, &system.values), BAUM_OK);
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_GOOD);
  saddle_pose_four_bar(&system, 1e-11);
  assert_int_equal(baum_i_kkt_factor(kkt, &system.values), BAUM_OK);
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_NEAR_SINGULAR);
  saddle_pose_four_bar(&system, 0.0);
  assert_int_equal(baum_i_kkt_factor(kkt, &system.values), BAUM_OK);
  assert_true(baum_i_kkt_rcond(kkt) == 0.0);
  baum_i_kkt_counters counters = baum_i_kkt_get_counters(kkt);
  assert_int_equal(counters.full_factorizations, 3);
  assert_int_equal(counters.fallbacks, 0);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void destroying_null_does_nothing(void **state)
{
  (void)state;
  baum_i_qr_ops.destroy(NULL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(klu_alone_reports_dependent_rows_as_singular),
    cmocka_unit_test(dependent_rows_leave_accelerations_unique),
    cmocka_unit_test(multipliers_that_are_not_unique_have_the_least_norm),
    cmocka_unit_test(rounding_errors_in_dependent_rows_are_tolerated),
    cmocka_unit_test(rows_that_contradict_each_other_are_singular),
    cmocka_unit_test(the_units_of_dependent_rows_do_not_matter),
    cmocka_unit_test(more_rows_than_velocities_are_solved_if_they_are_consistent),
    cmocka_unit_test(rows_of_zeros_have_no_multipliers),
    cmocka_unit_test(qr_estimates_how_singular_a_matrix_is),
    cmocka_unit_test(destroying_null_does_nothing),
  };
  return cmocka_run_group_tests_name("qr", tests, NULL, NULL);
}
