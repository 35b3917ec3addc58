/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests stability regions: their outlines, best points and intervals, and regions that consist of
 * several parts (islands). */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "methods.h"

enum { POINTS = 4000, COLUMNS = 120, ROWS = 160 };

static double alpha_h[POINTS];
static double beta2_h2[POINTS];

/* A method with the stability polynomial R(x) = 1 + x (x + 2) (x + 3) / 6. With critical damping,
 * alpha = beta and x = -alpha h. The method is then stable up to alpha h = 2, and again from alpha
 * h = 3 to the point where R = -1. */
static const baum_i_method island = {
  .kind = BAUM_I_METHOD_ONE_STEP, .degree = 3, .coefficients = {1.0, 1.0, 5.0 / 6.0, 1.0 / 6.0}};

static int outline(const baum_i_method *method, double radius)
{
  baum_i_outline out = {POINTS, alpha_h, beta2_h2, -1};
  baum_i_stability_outline(method, radius - 1.0, &out);
  assert_in_range(out.count, 0, POINTS);
  return out.count;
}

/* Returns the area inside the closed curve that begins at `from`. The area is positive if the curve
 * is counter-clockwise. Sets *to to the beginning of the next curve. */
static double area(int from, int count, int *to)
{
  double sum = 0.0;
  int k = from;
  while (k + 1 < count && !isnan(alpha_h[k + 1])) {
    sum += alpha_h[k] * beta2_h2[k + 1] - beta2_h2[k] * alpha_h[k + 1];
    k++;
  }
  /* The last point is the first point again, so the curve is closed. */
  assert_true(k > from + 2);
  assert_true(alpha_h[from] == alpha_h[k] && beta2_h2[from] == beta2_h2[k]);
  *to = k + 2;
  return 0.5 * sum;
}

/* Returns the area of all parts of the region, minus the area of their holes. Curves run clockwise
 * around parts, and counter-clockwise around holes. */
static double region_area(int count, int *parts)
{
  double sum = 0.0;
  *parts = 0;
  for (int from = 0; from < count; (*parts)++) {
    sum -= area(from, count, &from);
  }
  return sum;
}

static void outlines_have_the_given_radius(void **state)
{
  (void)state;
  static const double radii[] = {1.0, 0.9, 0.5, 1.3};
  for (int m = 0; m < METHOD_COUNT; m++) {
    for (int r = 0; r < 4; r++) {
      int count = outline(&methods[m], radii[r]);
      for (int k = 0; k < count; k++) {
        if (alpha_h[k] > 1e-12 && beta2_h2[k] > 1e-12) {
          double got = amplification_at(m, alpha_h[k], beta2_h2[k]).spectral_radius;
          /* The points are found by 42 bisections. The spectral radius of rk8 changes steeply,
           * which amplifies the errors of the points. */
          ASSERT_NEAR(got, radii[r], 0.0, 1e-9);
        }
      }
    }
  }
}

static double most(const double *values, int count)
{
  double out = 0.0;
  for (int k = 0; k < count; k++) {
    out = fmax(out, values[k]);
  }
  return out;
}

/* Computes the area of the region by counting the points of a fine grid that are inside the
 * region. */
static double counted_area(int method, double radius, double A, double B)
{
  int inside = 0;
  for (int k = 0; k < COLUMNS * ROWS; k++) {
    double p[2] = {A * (k % COLUMNS + 0.5) / COLUMNS, B * ((k / COLUMNS) + 0.5) / ROWS};
    inside += baum_i_amplification_within(&methods[method], p[0], p[1], radius - 1.0);
  }
  return A * B * inside / (COLUMNS * ROWS);
}

static void outlined_areas_agree_with_counted_areas(void **state)
{
  (void)state;
  static const double radii[] = {1.0, 0.9, 0.6};
  for (int m = 0; m < METHOD_COUNT; m++) {
    for (int r = 0; r < 3; r++) {
      int count = outline(&methods[m], radii[r]);
      double A = most(alpha_h, count);
      double B = most(beta2_h2, count);
      int parts;
      double got = region_area(count, &parts);
      /* The boundary passes through about 2 / 120 of the cells of the grid. The count includes each
       * of these cells completely or not at all. */
      ASSERT_NEAR(got, counted_area(m, radii[r], A, B), 0.0, 0.01 * A * B);
      assert_true((count > 0) == (parts > 0));
    }
  }
}

static void regions_of_both_euler_methods_are_the_known_triangles(void **state)
{
  (void)state;
  int parts;
  int count = outline(&methods[EULER], 1.0);
  ASSERT_NEAR(region_area(count, &parts), 2.0, 1e-3, 0.0); /* the triangle (0,0) (1,0) (2,4) */
  assert_int_equal(parts, 1);
  ASSERT_NEAR(most(alpha_h, count), 2.0, 1e-9, 0.0);
  ASSERT_NEAR(most(beta2_h2, count), 4.0, 1e-9, 0.0);
  count = outline(&methods[SEMI_IMPLICIT_EULER], 1.0);
  ASSERT_NEAR(region_area(count, &parts), 2.0, 1e-3, 0.0); /* the triangle (0,0) (1,0) (0,4) */
  ASSERT_NEAR(most(beta2_h2, count), 4.0, 1e-9, 0.0);
}

static void at_most_capacity_points_are_written_and_all_are_counted(void **state)
{
  (void)state;
  int all = outline(&methods[RK4], 0.5);
  double third = alpha_h[2];
  assert_true(all > 100);
  double a[4] = {7.0, 7.0, 7.0, 7.0};
  double b[4] = {7.0, 7.0, 7.0, 7.0};
  baum_i_outline out = {3, a, b, -1};
  baum_i_stability_outline(&methods[RK4], -0.5, &out);
  assert_int_equal(out.count, all);
  assert_true(a[2] == third && a[3] == 7.0 && b[3] == 7.0);
  out = (baum_i_outline){0, NULL, NULL, -1};
  baum_i_stability_outline(&methods[RK4], -0.5, &out);
  assert_int_equal(out.count, all);
}

static void a_region_that_is_empty_or_unbounded_has_no_outline(void **state)
{
  (void)state;
  static const baum_i_method always = {
    .kind = BAUM_I_METHOD_ONE_STEP, .degree = 0, .coefficients = {0.5}};
  assert_int_equal(outline(&methods[AB4], 0.8), 0);
  assert_int_equal(outline(&always, 1.0), 0);
}

/* ---- Islands -------------------------------------------------------------- */

static void islands_appear_as_parts_and_intervals_and_in_searches(void **state)
{
  (void)state;
  double from[4];
  double to[4];
  int parts;
  int count = outline(&island, 1.0);
  (void)region_area(count, &parts);
  assert_true(parts >= 2);
  assert_int_equal(baum_i_stability_intervals(&island, 1.0, 4, from, to), 2);
  ASSERT_NEAR(from[0], 0.0, 0.0, 0.0);
  ASSERT_NEAR(to[0], 2.0, 1e-9, 0.0);
  ASSERT_NEAR(from[1], 3.0, 1e-9, 0.0);
  double x = to[1];
  ASSERT_NEAR(x * (x - 2.0) * (x - 3.0), 12.0, 1e-9, 0.0); /* R(-x) = -1 at this end */
  ASSERT_NEAR(baum_i_stability_limit(&island, 1.0), 2.0, 1e-9, 0.0);
  /* The function writes only as many intervals as there is room for, but it counts all of them. */
  from[1] = 7.0;
  assert_int_equal(baum_i_stability_intervals(&island, 1.0, 1, from, to), 2);
  assert_true(from[1] == 7.0);
  double A;
  double B;
  baum_i_stability_nearest(&island, 3.6, 14.0, &A, &B);
  assert_true(baum_i_amplification_within(&island, A, B, -0.1));
  assert_true(hypot(A - 3.6, B - 14.0) < 1.5); /* other parts of the region are more than 6 away */
}

static void intervals_of_all_methods_begin_at_zero(void **state)
{
  (void)state;
  for (int m = 0; m < METHOD_COUNT; m++) {
    for (double zeta = 0.02; zeta < 40.0; zeta *= 1.3) {
      double from = 7.0;
      double to = 7.0;
      int count = baum_i_stability_intervals(&methods[m], zeta, 1, &from, &to);
      assert_true(count >= 1 && from == 0.0);
      ASSERT_NEAR(to, baum_i_stability_limit(&methods[m], zeta), 1e-14, 0.0);
    }
  }
}

static void stable_rays_have_one_interval_and_unstable_rays_have_none(void **state)
{
  (void)state;
  static const baum_i_method always = {
    .kind = BAUM_I_METHOD_ONE_STEP, .degree = 0, .coefficients = {0.5}};
  static const baum_i_method never = {
    .kind = BAUM_I_METHOD_ONE_STEP, .degree = 1, .coefficients = {1.0, -1.0}};
  double from = 7.0;
  double to = 7.0;
  assert_int_equal(baum_i_stability_intervals(&always, 1.0, 1, &from, &to), 1);
  assert_true(from == 0.0 && isinf(to));
  assert_int_equal(baum_i_stability_intervals(&never, 1.0, 1, &from, &to), 0);
  assert_true(baum_i_stability_best_on_ray(&never, 1.0) == 0.0);
}

/* ---- Best points ---------------------------------------------------------- */

static void no_grid_point_is_better_than_the_best(void **state)
{
  (void)state;
  for (int m = 0; m < METHOD_COUNT; m++) {
    double A;
    double B;
    int count = outline(&methods[m], 1.0);
    baum_i_stability_best(&methods[m], &A, &B);
    assert_true(A > 0.0 && B > 0.0);
    double best = amplification_at(m, A, B).spectral_radius;
    double box[2] = {most(alpha_h, count), most(beta2_h2, count)};
    for (int k = 0; k < COLUMNS * ROWS; k++) {
      double p[2] = {box[0] * (k % COLUMNS + 0.5) / COLUMNS, box[1] * (k / COLUMNS + 0.5) / ROWS};
      assert_false(baum_i_amplification_within(&methods[m], p[0], p[1], best - 1.0 - 1e-9));
    }
    /* Random points near the best one are also not better. */
    uint64_t seed = 3;
    for (int k = 0; k < 10000; k++) {
      double near = pow(10.0, uniform(&seed, -6.0, -1.0));
      double p[2] = {A * (1.0 + near * uniform(&seed, -1.0, 1.0)),
                     B * (1.0 + near * uniform(&seed, -1.0, 1.0))};
      assert_false(baum_i_amplification_within(&methods[m], p[0], p[1], best - 1.0 - 1e-9));
    }
  }
}

/* Each row gives A = alpha h and the spectral radius of a best point. At a best point, alpha = beta
 * and the two largest roots z have the same modulus. For AB2, these roots are z = 1 / sqrt(3) and z
 * = -1 / sqrt(3). Their sum 1 - 3 A / 2 is therefore zero. The values for AB3 and AB4 were computed
 * in Python. The roots were found by the Durand-Kerner iteration, and A by nested intervals. */
static void best_points_of_adams_bashforth_are_the_known_ones(void **state)
{
  (void)state;
  static const double want[3][2] = {{2.0 / 3.0, 0.57735026918962576},
                                    {0.35869565217, 0.69156407481},
                                    {0.2146443386, 0.80700734808}};
  for (int m = AB2; m <= AB4; m++) {
    double A;
    double B;
    assert_false(baum_i_stability_deadbeat(&methods[m], &A, &B));
    baum_i_stability_best(&methods[m], &A, &B);
    ASSERT_NEAR(A, want[m - AB2][0], 1e-6, 0.0);
    ASSERT_NEAR(B, A * A, 1e-6, 0.0);
    ASSERT_NEAR(amplification_at(m, A, B).spectral_radius, want[m - AB2][1], 1e-6, 0.0);
  }
}

static void no_point_of_a_ray_is_better_than_the_best(void **state)
{
  (void)state;
  for (int m = 0; m < METHOD_COUNT; m++) {
    for (double zeta = 0.05; zeta < 20.0; zeta *= 1.7) {
      double A = baum_i_stability_best_on_ray(&methods[m], zeta);
      double growth = baum_i_amplification_growth(&methods[m], A, A * A / (zeta * zeta));
      double from[8];
      double to[8];
      int count = baum_i_stability_intervals(&methods[m], zeta, 8, from, to);
      assert_true(A > 0.0 && growth < 0.0 && count <= 8);
      for (int k = 0; k < 2000; k++) {
        double a = to[count - 1] * (k + 0.5) / 2000.0;
        assert_false(
          baum_i_amplification_within(&methods[m], a, a * a / (zeta * zeta), growth - 1e-9));
      }
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(outlines_have_the_given_radius),
    cmocka_unit_test(outlined_areas_agree_with_counted_areas),
    cmocka_unit_test(regions_of_both_euler_methods_are_the_known_triangles),
    cmocka_unit_test(at_most_capacity_points_are_written_and_all_are_counted),
    cmocka_unit_test(a_region_that_is_empty_or_unbounded_has_no_outline),
    cmocka_unit_test(islands_appear_as_parts_and_intervals_and_in_searches),
    cmocka_unit_test(intervals_of_all_methods_begin_at_zero),
    cmocka_unit_test(stable_rays_have_one_interval_and_unstable_rays_have_none),
    cmocka_unit_test(no_grid_point_is_better_than_the_best),
    cmocka_unit_test(best_points_of_adams_bashforth_are_the_known_ones),
    cmocka_unit_test(no_point_of_a_ray_is_better_than_the_best),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
