/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "methods.h"
#include "stabilization/schur_cohn.h"

enum { POLYNOMIALS = 20000 };

/* Multiplies p by (z - root). */
static void multiply(baum_i_polynomial *p, double re, double im)
{
  p->degree++;
  p->c[p->degree][0] = p->c[p->degree][1] = 0.0;
  for (int k = p->degree; k >= 0; k--) {
    double below[2] = {k > 0 ? p->c[k - 1][0] : 0.0, k > 0 ? p->c[k - 1][1] : 0.0};
    double here[2] = {p->c[k][0], p->c[k][1]};
    p->c[k][0] = below[0] - (re * here[0] - im * here[1]);
    p->c[k][1] = below[1] - (re * here[1] + im * here[0]);
  }
}

/* Makes a polynomial with random roots. All of them satisfy |z| <= most. Returns the largest
 * |z|. */
static double from_roots(uint64_t *seed, int degree, double most, baum_i_polynomial *p)
{
  *p = (baum_i_polynomial){.c = {{1.0, 0.0}}};
  double largest = 0.0;
  for (int k = 0; k < degree; k++) {
    double size = most * sqrt(uniform(seed, 0.0, 1.0));
    double angle = uniform(seed, 0.0, 6.283185307179586);
    multiply(p, size * cos(angle), size * sin(angle));
    largest = fmax(largest, size);
  }
  return largest;
}

static void the_sign_of_the_margin_tells_whether_all_roots_are_inside(void **state)
{
  (void)state;
  uint64_t seed = 1;
  int inside = 0;
  for (int n = 0; n < POLYNOMIALS; n++) {
    baum_i_polynomial p;
    int degree = 1 + n % BAUM_I_SCHUR_COHN_DEGREE;
    double largest = from_roots(&seed, degree, 1.2, &p);
    double radius = uniform(&seed, 0.3, 1.5);
    /* If the largest root is within 1e-3 of the circle, rounding errors may decide the sign. */
    if (fabs(largest - radius) > 1e-3) {
      assert_int_equal(baum_i_schur_cohn_margin(&p, radius) > 0.0, largest < radius);
      inside += largest < radius;
    }
  }
  assert_true(inside > POLYNOMIALS / 10 && inside < POLYNOMIALS * 9 / 10);
}

static void the_radius_is_the_modulus_of_the_largest_root(void **state)
{
  (void)state;
  uint64_t seed = 2;
  for (int n = 0; n < POLYNOMIALS / 10; n++) {
    baum_i_polynomial p;
    double most = pow(10.0, uniform(&seed, -3.0, 3.0));
    double largest = from_roots(&seed, 1 + n % 4, most, &p);
    /* Two random roots may be as close to each other as 1e-3. This causes errors of 1e-16 / 1e-3.
     * In addition, the bisection has an error of 1e-10. */
    ASSERT_NEAR(baum_i_schur_cohn_radius(&p), largest, 1e-9, 0.0);
  }
}

static void multiple_roots_have_the_stated_accuracy(void **state)
{
  (void)state;
  for (int m = 1; m <= 4; m++) {
    baum_i_polynomial p = {.c = {{1.0, 0.0}}};
    for (int k = 0; k < m; k++) {
      multiply(&p, 0.48, 0.64);
    }
    /* The file schur_cohn.h states the relative error 1e-16^(1/(m+1)) for a root of multiplicity
     * m. */
    ASSERT_NEAR(baum_i_schur_cohn_radius(&p), 0.8, 4.0 * pow(1e-16, 1.0 / (m + 1)) + 1e-10, 0.0);
  }
}

static void roots_on_the_circle_are_not_inside(void **state)
{
  (void)state;
  /* The polynomial z^2 - z, with the roots 0 and 1. */
  const baum_i_polynomial one = {2, {{0.0, 0.0}, {-1.0, 0.0}, {1.0, 0.0}}};
  /* The polynomial z^2 + 1, with the roots i and -i. */
  const baum_i_polynomial pair = {2, {{1.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}}};
  assert_true(baum_i_schur_cohn_margin(&one, 1.0) <= 0.0);
  assert_true(baum_i_schur_cohn_margin(&pair, 1.0) <= 0.0);
  assert_true(baum_i_schur_cohn_margin(&one, 1.0 + 1e-9) > 0.0);
  assert_true(baum_i_schur_cohn_margin(&pair, 1.0 + 1e-9) > 0.0);
}

static void coefficients_that_overflow_give_an_infinite_radius(void **state)
{
  (void)state;
  const double numbers[] = {1e200, (double)INFINITY, (double)NAN};
  for (int k = 0; k < 3; k++) {
    baum_i_polynomial p = {2, {{numbers[k], 0.0}, {0.0, 0.0}, {1.0, 0.0}}};
    assert_true(isinf(baum_i_schur_cohn_radius(&p)));
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_sign_of_the_margin_tells_whether_all_roots_are_inside),
    cmocka_unit_test(the_radius_is_the_modulus_of_the_largest_root),
    cmocka_unit_test(multiple_roots_have_the_stated_accuracy),
    cmocka_unit_test(roots_on_the_circle_are_not_inside),
    cmocka_unit_test(coefficients_that_overflow_give_an_infinite_radius),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
