/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests saddle-point systems in extreme cases: unusual units, very different masses, bodies without
 * mass, singular configurations, and rows that contradict each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linear/scale.h"
#include "saddle_solver.h"

#define PI 3.14159265358979323846

/* ---- size and units ---- */

/* Changes the unit of length from 1 m to 1 m / per_metre. Coordinates j with j % 3 == 2 are angles.
 * All other coordinates, and all rows, are lengths. */
static void change_unit(saddle *system, double per_metre)
{
  for (int b = 0; b < system->structure.mass_block_count; b++) {
    const baum_i_mass_block *block = &system->mass_blocks[b];
    system->mass[block->value + 8] *= per_metre * per_metre;
    system->f[block->first] *= per_metre;
    system->f[block->first + 1] *= per_metre;
    system->f[block->first + 2] *= per_metre * per_metre;
  }
  for (int b = 0; b < system->structure.row_block_count; b++) {
    const baum_i_row_block *block = &system->row_blocks[b];
    for (int k = 0; k < block->rows * block->cols; k++) {
      bool turns = block->col[k % block->cols] % 3 == 2;
      system->jacobian[block->value + k] *= turns ? per_metre : 1.0;
    }
  }
  for (int i = 0; i < system->structure.nc; i++) {
    system->r[i] *= per_metre;
  }
}

static saddle make_four_bars(int loops, double angle)
{
  saddle system = saddle_make_four_bar(loops);
  uint64_t seed = 17;
  saddle_pose_four_bar(&system, angle);
  saddle_make_consistent(&system, seed);
  for (int j = 0; j < system.structure.nv; j++) {
    system.f[j] = saddle_random(&seed);
  }
  return system;
}

/* Solves a system in metres and in another unit, and compares the accelerations in metres. Returns
 * the worse of the two qualities that the solver reports. */
static baum_i_kkt_quality compare_units(double angle, double per_metre, double tolerance)
{
  baum_i_kkt_quality worst = BAUM_I_KKT_GOOD;
  double rcond[2];
  double a[2][15];
  for (int k = 0; k < 2; k++) {
    saddle system = make_four_bars(2, angle);
    double unit = k == 0 ? 1.0 : per_metre;
    change_unit(&system, unit);
    baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
    assert_int_equal(factor(kkt, &system), BAUM_OK);
    assert_int_equal(solve(kkt, &system), BAUM_OK);
    for (int j = 0; j < 15; j++) {
      a[k][j] = system.a[j] / (j % 3 == 2 ? 1.0 : unit);
    }
    rcond[k] = baum_i_kkt_rcond(kkt);
    worst = baum_i_kkt_get_quality(kkt) > worst ? baum_i_kkt_get_quality(kkt) : worst;
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
  for (int j = 0; j < 15; j++) {
    ASSERT_NEAR(a[1][j], a[0][j], 0.0, tolerance);
  }
  /* The scale factors d_j and e_i of the solver are powers of two. Each of them therefore
   * compensates a change of unit to within a factor of two. */
  assert_true(rcond[0] <= 64.0 * rcond[1] && rcond[1] <= 64.0 * rcond[0]);
  return worst;
}

static void the_unit_of_length_does_not_matter(void **state)
{
  (void)state;
  const double units[] = {1e3, 1e-3, 39.37, 1e9, 1e-9};
  for (int k = 0; k < 5; k++) {
    assert_int_equal(compare_units(1.0, units[k], 1e-14), BAUM_I_KKT_GOOD);
    /* Rounding errors are divided by the distance from the singular configuration, which is 1e-4
     * rad. */
    assert_int_equal(compare_units(1e-4, units[k], 1e-10), BAUM_I_KKT_GOOD);
  }
}

static void masses_of_very_different_size_are_all_accurate(void **state)
{
  (void)state;
  /* Every second body is made 1e-27 to 1e21 times as heavy as the others. */
  for (int exponent = -27; exponent <= 21; exponent += 3) {
    saddle system = make_four_bars(3, 1.0);
    double want[MOST_UNKNOWNS];
    for (int b = 0; b < system.structure.mass_block_count; b += 2) {
      for (int k = 0; k < 9; k++) {
        system.mass[system.mass_blocks[b].value + k] *= pow(10.0, exponent);
      }
    }
    baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
    assert_int_equal(factor(kkt, &system), BAUM_OK);
    assert_int_equal(solve(kkt, &system), BAUM_OK);
    saddle_solve(&system, want);
    for (int j = 0; j < system.structure.nv; j++) {
      ASSERT_NEAR(system.a[j], want[j], 1e-11, 1e-11); /* accelerations are about 1 */
    }
    if (abs(exponent) <= 18) {
      assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_GOOD);
    }
    assert_int_equal(baum_i_kkt_get_counters(kkt).fallbacks, 0);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void values_near_the_ends_of_the_range_are_solved(void **state)
{
  (void)state;
  const double sizes[] = {1e-150, 1e150};
  for (int k = 0; k < 4; k++) {
    saddle system = make_four_bars(1, 1.0);
    double want[MOST_UNKNOWNS];
    for (int i = 0; i < system.mass_count; i++) {
      system.mass[i] *= sizes[k % 2];
    }
    for (int i = 0; i < system.jacobian_count; i++) {
      system.jacobian[i] *= sizes[k / 2];
    }
    saddle_make_consistent(&system, 3);
    baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
    assert_int_equal(factor(kkt, &system), BAUM_OK);
    for (int j = 0; j < system.structure.nv; j++) {
      system.f[j] *= sizes[k % 2];
    }
    assert_int_equal(solve(kkt, &system), BAUM_OK);
    saddle_solve(&system, want);
    assert_solution(&system, want, 1e-12);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void values_beyond_the_range_of_scaling_are_solved_or_refused(void **state)
{
  (void)state;
  const double sizes[] = {1e-300, 1e-200, 1e200, 1e300};
  for (int k = 0; k < 16; k++) {
    saddle system = make_four_bars(1, 1.0);
    for (int i = 0; i < system.mass_count; i++) {
      system.mass[i] *= sizes[k % 4];
    }
    for (int i = 0; i < system.jacobian_count; i++) {
      system.jacobian[i] *= sizes[k / 4];
    }
    baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
    baum_status status = factor(kkt, &system);
    status = status == BAUM_OK ? solve(kkt, &system) : status;
    if (status == BAUM_OK && baum_i_kkt_get_quality(kkt) == BAUM_I_KKT_GOOD) {
      assert_true(saddle_backward_error(&system) < 3e-14);
    } else {
      assert_true(status == BAUM_OK || status == BAUM_ERR_SINGULAR);
    }
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

/* ---- massless bodies ---- */

static void a_body_without_mass_is_solved_where_joints_hold_it(void **state)
{
  (void)state;
  for (int k = 0; k < CHOICES; k++) {
    saddle system = make_four_bars(2, 1.0);
    for (int b = 3; b < 5; b++) {
      memset(system.mass + system.mass_blocks[b].value, 0, 9 * sizeof(double));
    }
    baum_i_kkt *kkt = make_solver(&system, choices[k]);
    solve_and_compare(kkt, &system, 1e-12);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

/* Makes a line of particles, each of which is tied to the next one. Only the first has mass. */
static saddle make_massless_row(int particles)
{
  saddle system = saddle_make_dense(particles, particles - 1);
  system.mass[0] = 2.0;
  for (int i = 0; i < particles - 1; i++) {
    system.jacobian[i * particles + i] = 1.0;
    system.jacobian[i * particles + i + 1] = -1.0;
  }
  for (int j = 0; j < particles; j++) {
    system.f[j] = 1.0 + j;
  }
  return system;
}

static void scales_spread_along_bodies_without_mass(void **state)
{
  (void)state;
  saddle system = make_massless_row(6);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  solve_and_compare(kkt, &system, 1e-15);
  ASSERT_NEAR(system.a[5], 10.5, 1e-15, 0.0); /* the sum of the forces divided by the mass */
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_GOOD);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void a_free_body_without_mass_is_singular_under_load(void **state)
{
  (void)state;
  saddle system = make_massless_row(3);
  system.jacobian[5] = 0.0; /* the last particle is no longer tied */
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  assert_int_equal(factor(kkt, &system), BAUM_OK);
  assert_int_equal(solve(kkt, &system), BAUM_ERR_SINGULAR);
  system.f[2] = 0.0;
  assert_int_equal(solve(kkt, &system), BAUM_OK);
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_NEAR_SINGULAR);
  ASSERT_NEAR(system.a[2], 0.0, 0.0, 1e-15);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void a_system_without_mass_is_solved_by_its_rows(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(2, 2);
  const double jacobian[] = {3.0, 1.0, 0.0, 2.0};
  memcpy(system.jacobian, jacobian, sizeof jacobian);
  system.r[0] = 5.0;
  system.r[1] = 4.0;
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  solve_and_compare(kkt, &system, 1e-15);
  ASSERT_NEAR(system.a[0], 1.0, 1e-15, 0.0);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

/* ---- singular configurations ---- */

/* Solves the system for 720 angles, in steps of half a degree. Skips the flat configurations, which
 * are singular. */
static void turn_and_solve(int loops, double start)
{
  saddle system = make_four_bars(loops, start);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  for (int k = 0; k < 720; k++) {
    double angle = start + k * PI / 360.0;
    if (fabs(sin(angle)) < 1e-9) {
      continue;
    }
    saddle_pose_four_bar(&system, angle);
    assert_int_equal(factor(kkt, &system), BAUM_OK);
    assert_int_equal(solve(kkt, &system), BAUM_OK);
    assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_GOOD);
    assert_true(saddle_backward_error(&system) < 3e-14);
  }
  baum_i_kkt_counters counters = baum_i_kkt_get_counters(kkt);
  assert_in_range(counters.full_factorizations, 1, 20);
  assert_int_equal(counters.fallbacks, 0);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void a_full_revolution_from_a_degenerate_configuration_is_solved_everywhere(void **state)
{
  (void)state;
  /* The start angles are 90 degrees, 45 degrees and 1 rad. At the first two angles, some entries
   * of the matrix are zero or equal, except for rounding. */
  const double starts[] = {PI / 2.0, PI / 4.0, 1.0};
  for (int k = 0; k < 3; k++) {
    turn_and_solve(1, starts[k]);
    turn_and_solve(6, starts[k]);
  }
}

static void pivots_that_have_become_small_are_chosen_again(void **state)
{
  (void)state;
  /* J is a rotation matrix. Its diagonal entries become zero every 180 degrees, so they cannot
   * always be the pivots. test_klu.c shows what happens if these pivots are kept. */
  saddle system = saddle_make_dense(2, 2);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_KLU);
  system.r[0] = 1.0;
  system.r[1] = 2.0;
  for (int k = 0; k <= 4; k++) {
    double angle = k * PI / 2.0;
    system.jacobian[0] = system.jacobian[3] = cos(angle);
    system.jacobian[1] = sin(angle);
    system.jacobian[2] = -sin(angle);
    solve_and_compare(kkt, &system, 1e-15);
    assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_GOOD);
    assert_int_equal(baum_i_kkt_get_counters(kkt).full_factorizations, k + 1);
  }
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void errors_grow_as_the_inverse_distance_from_a_singularity(void **state)
{
  (void)state;
  for (int exponent = 0; exponent <= 11; exponent++) {
    double distance = pow(10.0, -exponent);
    saddle system = make_four_bars(1, distance);
    double want[MOST_UNKNOWNS];
    baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
    assert_int_equal(factor(kkt, &system), BAUM_OK);
    assert_int_equal(solve(kkt, &system), BAUM_OK);
    saddle_solve(&system, want);
    for (int j = 0; j < system.structure.nv; j++) {
      /* The error is 5 eps / distance. */
      ASSERT_NEAR(system.a[j], want[j], 0.0, 1e-15 / distance + 1e-15);
    }
    assert_int_equal(baum_i_kkt_get_counters(kkt).fallbacks, 0);
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

static void the_solver_reports_a_nearly_singular_configuration(void **state)
{
  (void)state;
  saddle system = make_four_bars(1, 1e-12);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  assert_int_equal(factor(kkt, &system), BAUM_OK);
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_NEAR_SINGULAR);
  assert_true(baum_i_kkt_rcond(kkt) < 1e-10 && baum_i_kkt_rcond(kkt) > 0.0);
  saddle_pose_four_bar(&system, 0.3);
  assert_int_equal(factor(kkt, &system), BAUM_OK);
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_GOOD);
  assert_string_equal(baum_i_kkt_backend(kkt), "klu");
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

static void qr_takes_over_in_a_singular_configuration_only(void **state)
{
  (void)state;
  saddle system = make_four_bars(1, 0.0);
  baum_i_kkt *kkt = make_solver(&system, BAUM_I_KKT_AUTO);
  assert_int_equal(factor(kkt, &system), BAUM_OK);
  assert_int_equal(solve(kkt, &system), BAUM_OK);
  assert_string_equal(baum_i_kkt_backend(kkt), "qr");
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_NEAR_SINGULAR);
  assert_true(baum_i_kkt_rcond(kkt) == 0.0);
  assert_int_equal(baum_i_kkt_get_counters(kkt).fallbacks, 1);
  saddle_pose_four_bar(&system, 0.3);
  saddle_make_consistent(&system, 3);
  solve_and_compare(kkt, &system, 1e-13);
  assert_string_equal(baum_i_kkt_backend(kkt), "klu");
  assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_GOOD);
  assert_int_equal(baum_i_kkt_get_counters(kkt).fallbacks, 1);
  baum_i_kkt_destroy(kkt);
  saddle_free(&system);
}

/* ---- contradictions ---- */

/* Rows 0 to 2 are multiples of the same row. Their right-hand sides agree except for `error`. */
static saddle make_repeated(double error)
{
  saddle system = saddle_make_dense(4, 4);
  uint64_t seed = 23;
  for (int j = 0; j < 4; j++) {
    system.mass[(ptrdiff_t)5 * j] = 1.0 + j;
    system.f[j] = saddle_random(&seed);
    double x = saddle_random(&seed);
    for (int i = 0; i < 3; i++) {
      system.jacobian[4 * i + j] = (1.0 + i) * x; /* the row multiplied by 1, 2 and 3 */
    }
    system.jacobian[12 + j] = saddle_random(&seed);
  }
  for (int i = 0; i < 4; i++) {
    system.r[i] = 1.0 + i;
  }
  system.r[1] += error;
  return system;
}

static void repeated_rows_that_agree_are_solved(void **state)
{
  (void)state;
  static const baum_i_kkt_choice able[] = {BAUM_I_KKT_AUTO, BAUM_I_KKT_QR};
  for (int k = 0; k < 4; k++) {
    /* The solver tolerates a contradiction if it is less than 1e-8 times the right-hand sides. */
    saddle system = make_repeated(k % 2 == 0 ? 0.0 : 1e-10);
    baum_i_kkt *kkt = make_solver(&system, able[k / 2]);
    assert_int_equal(factor(kkt, &system), BAUM_OK);
    assert_int_equal(solve(kkt, &system), BAUM_OK);
    assert_int_equal(baum_i_kkt_get_quality(kkt), BAUM_I_KKT_NEAR_SINGULAR);
    double row[4] = {0.0};
    baum_i_jacobian_times(&system.structure, system.jacobian, system.a, row);
    for (int i = 0; i < 4; i++) {
      ASSERT_NEAR(row[i], system.r[i], 0.0, k % 2 == 0 ? 1e-13 : 1e-10);
    }
    baum_i_kkt_destroy(kkt);
    saddle_free(&system);
  }
}

/* The contradictions have both signs and sizes from 1e-6 to 1e12. Compared with the largest
 * contradiction, the other right-hand sides are negligible. If the matrix was factored, the same
 * factors must afterwards solve the system without the contradiction. */
static void rows_that_contradict_each_other_are_refused(void **state)
{
  (void)state;
  static const double errors[] = {1e-6, -1e-3, 1.0, -1e3, 1e12};
  for (int k = 0; k < CHOICES; k++) {
    for (int e = 0; e < 5; e++) {
      saddle system = make_repeated(errors[e]);
      baum_i_kkt *kkt = make_solver(&system, choices[k]);
      baum_status status = factor(kkt, &system);
      /* KLU finds the rank deficiency when it factors the matrix. The least-squares solver finds
       * the contradiction only when it solves. */
      assert_int_equal(status, choices[k] == BAUM_I_KKT_KLU ? BAUM_ERR_SINGULAR : BAUM_OK);
      system.a[0] = 123.0;
      assert_int_equal(solve(kkt, &system), BAUM_ERR_SINGULAR);
      assert_true(system.a[0] == 123.0);
      system.r[1] -= errors[e];
      assert_int_equal(solve(kkt, &system), status);
      baum_i_kkt_destroy(kkt);
      saddle_free(&system);
    }
  }
}

static void scales_of_the_smallest_and_largest_numbers_are_powers_of_two(void **state)
{
  (void)state;
  static const double sizes[] = {0x1p-1074, 0x1p-1020, 1.0, 0x1p+1023};
  for (int k = 0; k < 16; k++) {
    saddle system = saddle_make_dense(2, 1);
    double scale[3];
    system.mass[0] = system.mass[3] = sizes[k / 4];
    system.jacobian[0] = sizes[k % 4];
    baum_i_scale_compute(&system.structure, &system.values, scale);
    for (int i = 0; i < 3; i++) {
      int exponent;
      assert_true(isnormal(scale[i]) && frexp(scale[i], &exponent) == 0.5);
    }
    saddle_free(&system);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_unit_of_length_does_not_matter),
    cmocka_unit_test(masses_of_very_different_size_are_all_accurate),
    cmocka_unit_test(values_near_the_ends_of_the_range_are_solved),
    cmocka_unit_test(values_beyond_the_range_of_scaling_are_solved_or_refused),
    cmocka_unit_test(a_body_without_mass_is_solved_where_joints_hold_it),
    cmocka_unit_test(scales_spread_along_bodies_without_mass),
    cmocka_unit_test(a_free_body_without_mass_is_singular_under_load),
    cmocka_unit_test(a_system_without_mass_is_solved_by_its_rows),
    cmocka_unit_test(a_full_revolution_from_a_degenerate_configuration_is_solved_everywhere),
    cmocka_unit_test(pivots_that_have_become_small_are_chosen_again),
    cmocka_unit_test(errors_grow_as_the_inverse_distance_from_a_singularity),
    cmocka_unit_test(the_solver_reports_a_nearly_singular_configuration),
    cmocka_unit_test(qr_takes_over_in_a_singular_configuration_only),
    cmocka_unit_test(repeated_rows_that_agree_are_solved),
    cmocka_unit_test(rows_that_contradict_each_other_are_refused),
    cmocka_unit_test(scales_of_the_smallest_and_largest_numbers_are_powers_of_two),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
