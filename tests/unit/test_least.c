/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the search for the minimum of a function of one variable, and Hermite polynomials through
 * positions and velocities. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "base/least.h"
#include "mechanism/model.h"
#include "simulate/hermite.h"

/* ---- minima ---- */

typedef struct counted {
  baum_i_function *function;
  int count;
} counted;

static double count(void *user, double t)
{
  counted *c = user;
  c->count++;
  return c->function(NULL, t);
}

static double parabola(void *user, double t)
{
  (void)user;
  return (t - 0.3) * (t - 0.3);
}

static double edge(void *user, double t)
{
  (void)user;
  return fabs(t - 0.7);
}

static double falls(void *user, double t)
{
  (void)user;
  return -t;
}

static double wall(void *user, double t)
{
  (void)user;
  return t < 0.5 ? (double)INFINITY : (t - 0.55) * (t - 0.55) + 1.0;
}

/* Fails if the search needs more than `most` evaluations of the function. The golden section search
 * alone would need 30 of them for an accuracy of 1e-6. */
static void assert_found(baum_i_function *function, double place, int most)
{
  const double ends[2] = {0.0, 1.0};
  counted c = {function, 0};
  double at;
  double least = baum_i_least(count, &c, ends, 1e-6, 60, &at);
  ASSERT_NEAR(least, function(NULL, at), 0.0, 0.0);
  ASSERT_NEAR(at, place, 0.0, 3e-6); /* three times the tolerance of the search */
  assert_in_range(c.count, 1, most);
}

static void minima_are_found_in_few_evaluations(void **state)
{
  (void)state;
  assert_found(parabola, 0.3, 8);
  assert_found(edge, 0.7, 45);
  assert_found(falls, 1.0, 40);
  assert_found(wall, 0.55, 40);
}

static void a_search_ends_after_the_given_number_of_evaluations(void **state)
{
  (void)state;
  const double ends[2] = {0.0, 1.0};
  counted c = {edge, 0};
  double at;
  double least = baum_i_least(count, &c, ends, 1e-12, 5, &at);
  assert_int_equal(c.count, 5);
  ASSERT_NEAR(least, edge(NULL, at), 0.0, 0.0);
}

/* ---- polynomials ---- */

enum { KNOTS = BAUM_I_HERMITE_MOST };
static const double TIMES[KNOTS] = {10.0, 10.1, 10.25, 10.3};

/* Returns (t - 10.2)^power and sets its derivative. */
static double power_at(double t, int power, double *rate)
{
  double x = t - 10.2;
  *rate = power > 0 ? power * pow(x, power - 1) : 0.0;
  return pow(x, power);
}

/* Interpolates a single coordinate, whose value is `from` + (t - 10.2)^power. The second element of
 * each result must not change. */
static void assert_power(int count, int power, double from, double t)
{
  double q[KNOTS];
  double v[KNOTS];
  baum_i_knot knots[KNOTS];
  for (int k = 0; k < count; k++) {
    q[k] = from + power_at(TIMES[k], power, &v[k]);
    knots[k] = (baum_i_knot){.t = TIMES[k], .q = &q[k], .v = &v[k]};
  }
  static const baum_mechanism line = {.nq = 1, .nv = 1, .flat = true};
  double work[4];
  double got[2] = {0.0, -1.0};
  double rate[2] = {0.0, -1.0};
  double want_rate;
  double want = from + power_at(t, power, &want_rate);
  baum_i_hermite(&line, knots, count, t, got, rate, work);
  /* The rounding error of q is 1e-16 times `from`. The interpolation amplifies this error by the
   * sum of the absolute values of its weights, which at 10.4 s is 340 for q and 12500 for q'. */
  ASSERT_NEAR(got[0], want, 0.0, 1e-13 + 3.4e-14 * from);
  ASSERT_NEAR(rate[0], want_rate, 0.0, 1e-12 + 1.25e-12 * from);
  assert_true(got[1] == -1.0 && rate[1] == -1.0);
}

static void polynomials_up_to_the_degree_are_exact(void **state)
{
  (void)state;
  static const double at[] = {10.0, 10.03, 10.25, 10.29, 10.4};
  for (int count = 1; count <= KNOTS; count++) {
    for (int power = 0; power <= 2 * count - 1; power++) {
      for (size_t k = 0; k < sizeof at / sizeof at[0]; k++) {
        assert_power(count, power, 0.0, at[k]);
        assert_power(count, power, 1e4, at[k]); /* like an angle after many revolutions */
      }
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(minima_are_found_in_few_evaluations),
    cmocka_unit_test(a_search_ends_after_the_given_number_of_evaluations),
    cmocka_unit_test(polynomials_up_to_the_degree_are_exact),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
