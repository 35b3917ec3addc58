/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests stability limits, dead-beat points and the nearest points with given damping. A point is a
 * pair (A, B) with A = alpha h and B = (beta h)^2. The roots of a method are called z. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "methods.h"

/* ---- Limits --------------------------------------------------------------- */

static void limits_are_the_known_ones(void **state)
{
  (void)state;
  double critical[ONE_STEP_COUNT] = {
    [EULER] = 2.0,
    [SEMI_IMPLICIT_EULER] = 2.0 * sqrt(2.0) - 2.0,
    [RK2] = 2.0,
    /* This number and the next one were computed in Python, by bisection of |R| - 1, where R is the
     * stability polynomial. */
    [RK3] = 2.5127453266183286,
    [RK4] = 2.785293563405282,
  };
  double taylor[ONE_STEP_COUNT] = {
    [EULER] = 1.0,
    [SEMI_IMPLICIT_EULER] = sqrt(3.0) - 1.0, /* a root of 2 A^2 = 4 - 4 A */
    [RK2] = 1.5436890126920764,              /* a root of A^3 - 2 A^2 + 2 A = 2 */
    [RK3] = 1.6791988470387638,
    [RK4] = 1.9122666654063936,
  };
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    ASSERT_NEAR(baum_i_stability_limit(&methods[m], 1.0), critical[m], 1e-12, 0.0);
    ASSERT_NEAR(baum_i_stability_limit(&methods[m], sqrt(0.5)), taylor[m], 1e-12, 0.0);
  }
}

/* The damping ratio is zeta = alpha / beta. For explicit Euler, the boundary of the stability
 * region is B = 2 A if zeta < 1, and B = 4 A - 4 if zeta > 1. For semi-implicit Euler, the boundary
 * is B = 4 - 4 A. The limits are the points of these lines at which B = (A / zeta)^2. */
static void limits_of_both_euler_methods_are_exact_for_any_damping_ratio(void **state)
{
  (void)state;
  for (int k = -30; k <= 30; k++) {
    double zeta = pow(10.0, 0.2 * k);
    double z2 = zeta * zeta;
    double euler = zeta <= 1.0 ? 2.0 * z2 : 2.0 / (1.0 + sqrt(1.0 - 1.0 / z2));
    double semi_implicit = 2.0 * zeta / (zeta + sqrt(z2 + 1.0));
    ASSERT_NEAR(baum_i_stability_limit(&methods[EULER], zeta), euler, 1e-11, 0.0);
    ASSERT_NEAR(baum_i_stability_limit(&methods[SEMI_IMPLICIT_EULER], zeta), semi_implicit, 1e-11,
                0.0);
  }
}

static void limits_exist_for_extreme_damping_ratios(void **state)
{
  (void)state;
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    double overdamped = 0.5 * (m == RK3 ? 2.5127453266183286 : m == RK4 ? 2.785293563405282 : 2.0);
    ASSERT_NEAR(baum_i_stability_limit(&methods[m], 1e12), overdamped, 1e-12, 0.0);
    ASSERT_NEAR(baum_i_stability_limit(&methods[m], 1.7e308), overdamped, 1e-12, 0.0);
    ASSERT_NEAR(baum_i_stability_limit(&methods[m], 1e-300), 0.0, 0.0, 1e-290);
  }
}

static void everything_below_a_limit_is_stable_and_just_above_is_not(void **state)
{
  (void)state;
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    for (double zeta = 0.02; zeta < 40.0; zeta *= 1.3) {
      double limit = baum_i_stability_limit(&methods[m], zeta);
      for (int k = 1; k <= 1000; k++) {
        double A = limit * k / 1000.0 * (1.0 - 1e-9);
        assert_true(baum_i_amplification_growth(&methods[m], A, A * A / (zeta * zeta)) < 0.0);
      }
      double A = limit * (1.0 + 1e-9);
      assert_true(baum_i_amplification_growth(&methods[m], A, A * A / (zeta * zeta)) > 0.0);
    }
  }
}

static void a_method_may_have_no_limit_or_no_stable_point(void **state)
{
  (void)state;
  static const baum_i_method always = {
    .kind = BAUM_I_METHOD_ONE_STEP, .degree = 0, .coefficients = {0.5}};
  static const baum_i_method never = {
    .kind = BAUM_I_METHOD_ONE_STEP, .degree = 1, .coefficients = {1.0, -1.0}};
  assert_true(isinf(baum_i_stability_limit(&always, 1.0)));
  assert_true(baum_i_stability_limit(&never, 1.0) == 0.0);
}

/* ---- Dead-beat ------------------------------------------------------------ */

static void deadbeat_points_are_the_known_ones(void **state)
{
  (void)state;
  static const double want[ONE_STEP_COUNT][2] = {
    [EULER] = {1.0, 1.0},
    [SEMI_IMPLICIT_EULER] = {0.5, 1.0},
    [RK2] = {1.0, 2.0},
    /* This row and the next one follow from the roots of the stability polynomial, which were found
     * by the Durand-Kerner iteration in Python. */
    [RK3] = {0.701964181008339, 3.7592297596248},
    [RK4] = {1.7294442310677054, 3.7812527897746273},
  };
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    double A = 0.0;
    double B = 0.0;
    assert_true(baum_i_stability_deadbeat(&methods[m], &A, &B));
    ASSERT_NEAR(A, want[m][0], 1e-12, 0.0);
    ASSERT_NEAR(B, want[m][1], 1e-12, 0.0);
    ASSERT_NEAR(amplification_at(m, A, B).spectral_radius, 0.0, 0.0, 1e-14);
  }
}

static void deadbeat_of_both_euler_methods_is_exact(void **state)
{
  (void)state;
  for (int m = EULER; m <= SEMI_IMPLICIT_EULER; m++) {
    double A = 0.0;
    double B = 0.0;
    assert_true(baum_i_stability_deadbeat(&methods[m], &A, &B));
    assert_true(A == (m == EULER ? 1.0 : 0.5) && B == 1.0);
    assert_true(amplification_at(m, A, B).spectral_radius == 0.0);
  }
}

/* Each row gives A and the spectral radius of the best point with alpha = beta. The published
 * values have two digits. */
static void least_radii_with_critical_damping_are_the_published_ones(void **state)
{
  (void)state;
  static const double want[ONE_STEP_COUNT][2] = {
    [EULER] = {1.0, 0.0}, [SEMI_IMPLICIT_EULER] = {0.73, 0.68},
    [RK2] = {1.0, 0.5},   [RK3] = {1.60, 0.0},
    [RK4] = {1.60, 0.27},
  };
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    double best = 2.0;
    double where = 0.0;
    for (int k = 1; k < 3000; k++) {
      double A = 1e-3 * k;
      double radius = amplification_at(m, A, A * A).spectral_radius;
      where = radius < best ? A : where;
      best = fmin(best, radius);
    }
    ASSERT_NEAR(where, want[m][0], 0.0, 6e-3);
    ASSERT_NEAR(best, want[m][1], 0.0, 6e-3);
  }
}

/* ---- Nearest good point --------------------------------------------------- */

typedef struct point {
  double A;
  double B;
} point;

static point nearest(int method, double A, double B)
{
  point good = {HUGE_VAL, HUGE_VAL};
  baum_i_stability_nearest(&methods[method], A, B, &good.A, &good.B);
  return good;
}

static double segment_distance(point w, point p, point q)
{
  double a[2] = {q.A - p.A, q.B - p.B};
  double t = ((w.A - p.A) * a[0] + (w.B - p.B) * a[1]) / (a[0] * a[0] + a[1] * a[1]);
  t = fmin(fmax(t, 0.0), 1.0);
  return hypot(p.A + t * a[0] - w.A, p.B + t * a[1] - w.B);
}

/* Returns the distance from w to the region of the plane (A, B) in which both roots have
 * |z| <= 0.9. For Euler methods this region is a triangle. At its corners the two roots are (r, r),
 * (-r, -r) and (r, -r), with r = 0.9. */
static double triangle_distance(int method, point w)
{
  double r = 0.9;
  point corner[3] = {
    {1.0 - r, (1.0 - r) * (1.0 - r)}, {1.0 + r, (1.0 + r) * (1.0 + r)}, {1.0, 1.0 - r * r}};
  double least = HUGE_VAL;
  for (int k = 0; k < 3 && method == SEMI_IMPLICIT_EULER; k++) {
    corner[k].A -= 0.5 * corner[k].B;
  }
  for (int k = 0; k < 3; k++) {
    least = fmin(least, segment_distance(w, corner[k], corner[(k + 1) % 3]));
  }
  return least;
}

static void a_good_point_is_its_own_nearest_good_point(void **state)
{
  (void)state;
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    point got = nearest(m, 0.4, 0.3);
    assert_true(got.A == 0.4 && got.B == 0.3);
  }
}

static void nearest_points_of_both_euler_methods_are_on_their_triangles(void **state)
{
  (void)state;
  uint64_t seed = 1;
  for (int k = 0; k < 200; k++) {
    int m = k % 2 == 0 ? EULER : SEMI_IMPLICIT_EULER;
    double far = k < 100 ? 1.0 : 100.0;
    point w = {far * uniform(&seed, -0.5, 2.5), far * uniform(&seed, -0.5, 4.5)};
    point got = nearest(m, w.A, w.B);
    double moved = hypot(got.A - w.A, got.B - w.B);
    assert_true(amplification_at(m, got.A, got.B).spectral_radius <= 0.9 + 1e-14);
    if (moved > 0.0) {
      ASSERT_NEAR(moved, triangle_distance(m, w), 1e-6, 1e-8);
    }
  }
}

enum { COLUMNS = 300, ROWS = 500 };

/* Points with |z| <= 0.9 are called good in this test. A box with one corner at the origin contains
 * all of them. Returns the opposite corner of this box. */
static point box(int method)
{
  double limit = baum_i_stability_limit(&methods[method], 1.0);
  return (point){1.2 * limit, (method >= AB2 && method <= AB4 ? 2.4 : 1.5) *
                                fmax(limit * limit, 4.0 * (method < AB2))};
}

/* Returns the distance from w to the nearest good point of a grid over this box. */
static double grid_distance(int method, point w)
{
  point most = box(method);
  double least = HUGE_VAL;
  for (int k = 0; k < COLUMNS * ROWS; k++) {
    point p = {most.A * (k % COLUMNS) / COLUMNS, most.B * (k / COLUMNS) / ROWS};
    double distance = hypot(p.A - w.A, p.B - w.B);
    if (distance < least && baum_i_amplification_within(&methods[method], p.A, p.B, -0.1)) {
      least = distance;
    }
  }
  return least;
}

static void no_good_grid_point_is_much_nearer(void **state)
{
  (void)state;
  uint64_t seed = 2;
  for (int k = 0; k < 200; k++) {
    int m = k % METHOD_COUNT;
    double size = k < 100 ? 1.0 : 0.05;
    point most = box(m);
    point w = {size * most.A * uniform(&seed, -0.2, 1.5),
               size * most.B * uniform(&seed, -0.1, 1.5)};
    point got = nearest(m, w.A, w.B);
    /* The search uses the test of Schur and Cohn, whose rounding errors differ from those of the
     * spectral radius. */
    assert_true(amplification_at(m, got.A, got.B).spectral_radius <= 0.9 + 1e-10);
    /* At a sharp tip of the region of RK3, the point that the search finds may be 1 % farther away
     * than the point of the grid. */
    assert_true(hypot(got.A - w.A, got.B - w.B) <= 1.01 * grid_distance(m, w));
  }
}

static void far_points_have_a_nearest_good_point(void **state)
{
  (void)state;
  for (int m = 0; m < METHOD_COUNT; m++) {
    point got = nearest(m, 1e150, 1e300);
    assert_true(amplification_at(m, got.A, got.B).spectral_radius <= 0.9 + 1e-14);
    got = nearest(m, 1.0, HUGE_VAL);
    assert_true(amplification_at(m, got.A, got.B).spectral_radius <= 0.9 + 1e-14);
  }
}

static void the_search_also_ends_for_methods_without_a_limit(void **state)
{
  (void)state;
  static const baum_i_method weak = {
    .kind = BAUM_I_METHOD_ONE_STEP, .degree = 0, .coefficients = {0.95}};
  static const baum_i_method strong = {
    .kind = BAUM_I_METHOD_ONE_STEP, .degree = 0, .coefficients = {0.5}};
  double A = 0.0;
  double B = 0.0;
  baum_i_stability_nearest(&weak, 1.0, 1.0, &A, &B);
  baum_i_stability_nearest(&strong, 3.0, 4.0, &A, &B);
  assert_true(A == 3.0 && B == 4.0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(limits_are_the_known_ones),
    cmocka_unit_test(limits_of_both_euler_methods_are_exact_for_any_damping_ratio),
    cmocka_unit_test(limits_exist_for_extreme_damping_ratios),
    cmocka_unit_test(everything_below_a_limit_is_stable_and_just_above_is_not),
    cmocka_unit_test(a_method_may_have_no_limit_or_no_stable_point),
    cmocka_unit_test(deadbeat_points_are_the_known_ones),
    cmocka_unit_test(deadbeat_of_both_euler_methods_is_exact),
    cmocka_unit_test(least_radii_with_critical_damping_are_the_published_ones),
    cmocka_unit_test(a_good_point_is_its_own_nearest_good_point),
    cmocka_unit_test(nearest_points_of_both_euler_methods_are_on_their_triangles),
    cmocka_unit_test(no_good_grid_point_is_much_nearer),
    cmocka_unit_test(far_points_have_a_nearest_good_point),
    cmocka_unit_test(the_search_also_ends_for_methods_without_a_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
