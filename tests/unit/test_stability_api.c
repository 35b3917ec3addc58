/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the public functions for stability: their results, and the arguments that they refuse. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "integrate/integrator.h"

#define ASSERT_REFUSED(call, want, message)         \
  do {                                              \
    assert_int_equal((call), (want));               \
    assert_string_equal(baum_message(), (message)); \
  } while (0)

typedef struct fact {
  const baum_integrator *(*integrator)(void);
  double limit; /* the largest stable alpha h if alpha = beta */
} fact;

static const fact FACTS[] = {
  {baum_euler, 2.0},
  {baum_semi_implicit_euler, 0.8284271247461903}, /* 2 sqrt 2 - 2 */
  {baum_rk2, 2.0},
  /* This limit and the next one were computed in Python, by bisection of |R| - 1, where R is the
   * stability polynomial. */
  {baum_rk3, 2.5127453266183286},
  {baum_rk4, 2.785293563405282},
  {baum_ab2, 1.0},
  {baum_ab3, 6.0 / 11.0},
  {baum_ab4, 0.3},
};
enum { FACT_COUNT = sizeof FACTS / sizeof FACTS[0] };

static void limits_are_the_published_ones(void **state)
{
  (void)state;
  for (int k = 0; k < FACT_COUNT; k++) {
    const baum_integrator *integrator = FACTS[k].integrator();
    double limit = 0.0;
    double from = 7.0;
    double to = 7.0;
    int32_t count = 0;
    assert_int_equal(baum_stability_limit(integrator, 1.0, &limit), BAUM_OK);
    ASSERT_NEAR(limit, FACTS[k].limit, 1e-12, 0.0);
    assert_int_equal(baum_stability_intervals(integrator, 1.0, 1, &from, &to, &count), BAUM_OK);
    assert_int_equal(count, 1);
    assert_true(from == 0.0);
    ASSERT_NEAR(to, limit, 1e-12, 0.0);
    assert_int_equal(baum_stability_intervals(integrator, 1.0, 0, NULL, NULL, &count), BAUM_OK);
    assert_int_equal(count, 1);
  }
}

static double radius_at(const baum_integrator *integrator, double alpha_h, double beta2_h2)
{
  baum_amplification out;
  assert_int_equal(baum_stability_at(integrator, alpha_h, beta2_h2, &out, sizeof out), BAUM_OK);
  ASSERT_NEAR(out.damping, 1.0 - out.spectral_radius, 0.0, 1e-14 * (1.0 + out.spectral_radius));
  return out.spectral_radius;
}

static void best_points_are_at_least_as_good_as_best_points_of_a_ray(void **state)
{
  (void)state;
  for (int k = 0; k < FACT_COUNT; k++) {
    const baum_integrator *integrator = FACTS[k].integrator();
    double alpha_h = 0.0;
    double beta2_h2 = 0.0;
    double on_ray = 0.0;
    assert_int_equal(baum_stability_best(integrator, &alpha_h, &beta2_h2), BAUM_OK);
    assert_int_equal(baum_stability_best_on_ray(integrator, 1.0, &on_ray), BAUM_OK);
    double best = radius_at(integrator, alpha_h, beta2_h2);
    double ray = radius_at(integrator, on_ray, on_ray * on_ray);
    assert_true(on_ray > 0.0 && on_ray < FACTS[k].limit);
    assert_true(best <= ray + 1e-9 && ray < 1.0);
  }
}

/* The library stores the best points of Adams-Bashforth methods. A search must find the same
 * points. */
static void the_search_finds_the_stored_best_points(void **state)
{
  (void)state;
  int known = 0;
  for (int k = 0; k < FACT_COUNT; k++) {
    baum_i_method method = FACTS[k].integrator()->method;
    double best[2] = {method.best[0], method.best[1]};
    if (best[0] > 0.0) {
      double found[2];
      method.best[0] = 0.0;
      baum_i_stability_best(&method, &found[0], &found[1]);
      ASSERT_NEAR(best[0], found[0], 1e-9, 0.0); /* the accuracy of the search is 1e-10 */
      ASSERT_NEAR(best[1], found[1], 1e-9, 0.0);
      known++;
    }
  }
  assert_int_equal(known, 3);
}

static void a_grid_has_the_radii_of_its_points(void **state)
{
  (void)state;
  enum { COLUMNS = 4, ROWS = 3 };
  const double alpha_h[2] = {0.1, 0.4};
  const double beta2_h2[2] = {0.2, 0.0};
  double radius[COLUMNS * ROWS + 1];
  for (int k = 0; k < FACT_COUNT; k++) {
    const baum_integrator *integrator = FACTS[k].integrator();
    radius[COLUMNS * ROWS] = 7.0;
    assert_int_equal(baum_stability_grid(integrator, alpha_h, beta2_h2, COLUMNS, ROWS, radius),
                     BAUM_OK);
    for (int j = 0; j < ROWS; j++) {
      for (int i = 0; i < COLUMNS; i++) {
        ASSERT_NEAR(radius[j * COLUMNS + i], radius_at(integrator, 0.1 + 0.1 * i, 0.2 - 0.1 * j),
                    /* For a double root, the error is the square root of the rounding error. */
                    1e-7, 0.0);
      }
    }
    assert_true(radius[COLUMNS * ROWS] == 7.0);
  }
  assert_int_equal(baum_stability_grid(baum_rk4(), alpha_h, beta2_h2, 1, 1, radius), BAUM_OK);
  ASSERT_NEAR(radius[0], radius_at(baum_rk4(), 0.1, 0.2), 1e-14, 0.0);
}

/* Tests a ray that almost coincides with an axis (damping ratio 5e-324), and a grid whose width
 * overflows. */
static void extreme_numbers_have_an_answer(void **state)
{
  (void)state;
  const double all[2] = {-1.5e308, 1.5e308};
  double radius[3];
  for (int k = 0; k < FACT_COUNT; k++) {
    const baum_integrator *integrator = FACTS[k].integrator();
    double alpha_h = 7.0;
    int32_t count = 0;
    assert_int_equal(baum_stability_limit(integrator, DBL_TRUE_MIN, &alpha_h), BAUM_OK);
    /* The limit is proportional to the damping ratio. */
    assert_true(alpha_h >= 0.0 && alpha_h < 1e-300);
    assert_int_equal(baum_stability_intervals(integrator, DBL_TRUE_MIN, 0, NULL, NULL, &count),
                     BAUM_OK);
    assert_int_equal(baum_stability_best_on_ray(integrator, DBL_TRUE_MIN, &alpha_h), BAUM_OK);
    assert_true(alpha_h >= 0.0 && alpha_h < 1e-300);
    assert_int_equal(baum_stability_grid(integrator, all, all, 3, 1, radius), BAUM_OK);
    assert_true(radius[0] > 1.0 && radius[1] > 1.0 && radius[2] > 1.0);
  }
}

static void outlines_are_counted_and_closed(void **state)
{
  (void)state;
  enum { CAPACITY = 2000 };
  static double alpha_h[CAPACITY];
  static double beta2_h2[CAPACITY];
  const double levels[] = {1.0, 0.9};
  for (int32_t k = 0; baum_integrator_at(k); k++) {
    for (int r = 0; r < 2; r++) {
      int32_t all = -1;
      int32_t count = -1;
      const baum_integrator *integrator = baum_integrator_at(k);
      baum_status status = baum_stability_outline(integrator, levels[r], 0, NULL, NULL, &all);
      if (status != BAUM_OK) {
        assert_int_equal(status, BAUM_ERR_UNSUPPORTED);
        continue;
      }
      assert_in_range(all, 100, CAPACITY); /* 2000 is the capacity that the header recommends */
      assert_int_equal(
        baum_stability_outline(integrator, levels[r], CAPACITY, alpha_h, beta2_h2, &count),
        BAUM_OK);
      assert_int_equal(count, all);
      int32_t last = 0; /* the last point of the first curve, which is closed */
      while (last + 1 < count && !isnan(alpha_h[last + 1])) {
        last++;
      }
      assert_true(last > 2 && alpha_h[0] == alpha_h[last] && beta2_h2[0] == beta2_h2[last]);
    }
  }
}

/* ---- Methods without a region --------------------------------------------- */

static void every_integrator_has_a_statement(void **state)
{
  (void)state;
  assert_null(baum_stability_statement(NULL));
  for (int32_t k = 0; baum_integrator_at(k); k++) {
    const char *text = baum_stability_statement(baum_integrator_at(k));
    assert_non_null(text);
    assert_in_range(strlen(text), 40, 400);
  }
  assert_non_null(strstr(baum_stability_statement(baum_euler()), "Fixed step"));
  assert_non_null(strstr(baum_stability_statement(baum_dp5()), "caps the step"));
  assert_non_null(strstr(baum_stability_statement(baum_kinematics()), "nothing to stabilize"));
  if (BAUM_HAVE_SUNDIALS) {
    assert_non_null(strstr(baum_stability_statement(baum_cvode_bdf()), "0.618"));
    assert_non_null(strstr(baum_stability_statement(baum_ida()), "0.618"));
    assert_non_null(strstr(baum_stability_statement(baum_cvode_adams()), "Adams-Moulton"));
  }
}

static void methods_without_a_region_are_refused(void **state)
{
  (void)state;
  static const char why[] = "kinematics solves positions from the constraints, so there is nothing "
                            "to stabilize and no region";
  const baum_integrator *k = baum_kinematics();
  double x = 7.0;
  double y = 7.0;
  int32_t n = 7;
  const double range[2] = {0.0, 1.0};
  ASSERT_REFUSED(baum_stability_intervals(k, 1.0, 0, NULL, NULL, &n), BAUM_ERR_UNSUPPORTED, why);
  ASSERT_REFUSED(baum_stability_best_on_ray(k, 1.0, &x), BAUM_ERR_UNSUPPORTED, why);
  ASSERT_REFUSED(baum_stability_best(k, &x, &y), BAUM_ERR_UNSUPPORTED, why);
  ASSERT_REFUSED(baum_stability_grid(k, range, range, 1, 1, &x), BAUM_ERR_UNSUPPORTED, why);
  ASSERT_REFUSED(baum_stability_outline(k, 1.0, 0, NULL, NULL, &n), BAUM_ERR_UNSUPPORTED, why);
  ASSERT_REFUSED(baum_stability_deadbeat(baum_ab2(), &x, &y), BAUM_ERR_UNSUPPORTED,
                 "ab2 uses several past steps, so no gains remove a violation in two steps; "
                 "baum_stability_best() returns the point of fastest decay");
  baum_amplification out;
  assert_int_equal(baum_stability_at(baum_rattle(), 1.0, 1.0, &out, sizeof out), BAUM_OK);
  assert_int_equal(out.stability, BAUM_WITHOUT_GAINS);
  assert_true(isnan(out.spectral_radius) && isnan(out.damping) && isnan(out.z[1][1]));
  assert_int_equal(baum_stability_at(k, 1.0, 1.0, &out, sizeof out), BAUM_OK);
  assert_int_equal(out.stability, BAUM_WITHOUT_GAINS);
  ASSERT_REFUSED(baum_stability_best(baum_rattle(), &x, &y), BAUM_ERR_UNSUPPORTED,
                 "rattle keeps the constraints by itself, without gains, so it has no region of "
                 "stability");
  assert_true(x == 7.0 && y == 7.0 && n == 7);
}

/* ---- Arguments ------------------------------------------------------------ */

static void wrong_arguments_of_rays_are_refused(void **state)
{
  (void)state;
  const baum_integrator *e = baum_euler();
  double x = 7.0;
  double y = 7.0;
  int32_t n = 7;
  ASSERT_REFUSED(baum_stability_intervals(NULL, 1.0, 1, &x, &y, &n), BAUM_ERR_ARGUMENT,
                 "stability: integrator is NULL, must be one such as baum_euler()");
  ASSERT_REFUSED(baum_stability_intervals(e, -1.0, 1, &x, &y, &n), BAUM_ERR_ARGUMENT,
                 "stability: damping_ratio is -1, must be finite and > 0");
  ASSERT_REFUSED(baum_stability_intervals(e, 1.0, -1, &x, &y, &n), BAUM_ERR_ARGUMENT,
                 "capacity is -1, must be >= 0");
  ASSERT_REFUSED(baum_stability_intervals(e, 1.0, 1, NULL, &y, &n), BAUM_ERR_ARGUMENT,
                 "stability: from is NULL, must be given");
  ASSERT_REFUSED(baum_stability_intervals(e, 1.0, 1, &x, NULL, &n), BAUM_ERR_ARGUMENT,
                 "stability: to is NULL, must be given");
  ASSERT_REFUSED(baum_stability_intervals(e, 1.0, 1, &x, &y, NULL), BAUM_ERR_ARGUMENT,
                 "stability: count is NULL, must be given");
  ASSERT_REFUSED(baum_stability_best_on_ray(e, (double)NAN, &x), BAUM_ERR_ARGUMENT,
                 "stability: damping_ratio is nan, must be finite and > 0");
  ASSERT_REFUSED(baum_stability_best_on_ray(e, 1.0, NULL), BAUM_ERR_ARGUMENT,
                 "stability: alpha_h is NULL, must be given");
  assert_true(x == 7.0 && y == 7.0 && n == 7);
}

static void wrong_arguments_of_the_plane_are_refused(void **state)
{
  (void)state;
  const baum_integrator *e = baum_euler();
  double x = 7.0;
  double y = 7.0;
  int32_t n = 7;
  const double range[2] = {0.0, 1.0};
  const double endless[2] = {0.0, (double)INFINITY};
  ASSERT_REFUSED(baum_stability_best(e, NULL, &y), BAUM_ERR_ARGUMENT,
                 "stability: alpha_h is NULL, must be given");
  ASSERT_REFUSED(baum_stability_best(e, &x, NULL), BAUM_ERR_ARGUMENT,
                 "stability: beta2_h2 is NULL, must be given");
  ASSERT_REFUSED(baum_stability_grid(e, NULL, range, 1, 1, &x), BAUM_ERR_ARGUMENT,
                 "stability: alpha_h is NULL, must be given");
  ASSERT_REFUSED(baum_stability_grid(e, range, endless, 1, 1, &x), BAUM_ERR_ARGUMENT,
                 "stability: beta2_h2 is inf, must be finite");
  ASSERT_REFUSED(baum_stability_grid(e, range, range, 0, 1, &x), BAUM_ERR_ARGUMENT,
                 "columns is 0 and rows is 1, must be >= 1");
  ASSERT_REFUSED(baum_stability_grid(e, range, range, 1, 1, NULL), BAUM_ERR_ARGUMENT,
                 "stability: radius is NULL, must be given");
  ASSERT_REFUSED(baum_stability_outline(e, 0.0, 1, &x, &y, &n), BAUM_ERR_ARGUMENT,
                 "stability: radius is 0, must be finite and > 0");
  ASSERT_REFUSED(baum_stability_outline(e, 1.0, 1, &x, NULL, &n), BAUM_ERR_ARGUMENT,
                 "stability: beta2_h2 is NULL, must be given");
  ASSERT_REFUSED(baum_stability_outline(e, 1.0, 1, &x, &y, NULL), BAUM_ERR_ARGUMENT,
                 "stability: count is NULL, must be given");
  assert_true(x == 7.0 && y == 7.0 && n == 7);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(limits_are_the_published_ones),
    cmocka_unit_test(best_points_are_at_least_as_good_as_best_points_of_a_ray),
    cmocka_unit_test(the_search_finds_the_stored_best_points),
    cmocka_unit_test(a_grid_has_the_radii_of_its_points),
    cmocka_unit_test(extreme_numbers_have_an_answer),
    cmocka_unit_test(outlines_are_counted_and_closed),
    cmocka_unit_test(every_integrator_has_a_statement),
    cmocka_unit_test(methods_without_a_region_are_refused),
    cmocka_unit_test(wrong_arguments_of_rays_are_refused),
    cmocka_unit_test(wrong_arguments_of_the_plane_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
