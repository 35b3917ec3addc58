/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the amplification of Adams-Bashforth methods with the matrix of one step. The roots z of
 * a method depend on A = alpha h and B = (beta h)^2. The roots of mu^2 + 2 A mu + B = 0 are called
 * mu. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "methods.h"

enum { POINTS = 400, MOST = 8, SQUARINGS = 40 };

/* The matrix of one step. It multiplies a vector that consists of (x, v) and of the derivatives
 * (x', v') at earlier steps. */
typedef struct matrix {
  int n;
  double a[MOST][MOST];
} matrix;

/* Returns the matrix of one step for x'' = -2 A x' - B x with h = 1. It multiplies the vector (x,
 * v, f(n-1), f(n-2), ...), where f denotes the derivatives of (x, v). */
static matrix step_matrix(const baum_i_method *method, double A, double B)
{
  const double rate[2][2] = {{0.0, 1.0}, {-B, -2.0 * A}};
  const double *b = method->coefficients;
  matrix m = {.n = 2 * method->degree};
  for (int i = 0; i < 2; i++) {
    m.a[i][i] = 1.0;
    for (int k = 0; k < 2; k++) {
      m.a[i][k] += b[0] * rate[i][k];
      if (method->degree > 1) {
        m.a[2 + i][k] = rate[i][k];
      }
    }
    for (int j = 1; j < method->degree; j++) {
      m.a[i][2 * j + i] = b[j];
      if (j + 1 < method->degree) {
        m.a[2 * (j + 1) + i][2 * j + i] = 1.0;
      }
    }
  }
  return m;
}

/* Replaces m by m^2, divided by its largest element. Returns the logarithm of that element. */
static double square(matrix *m)
{
  matrix out = {.n = m->n};
  double most = 0.0;
  for (int i = 0; i < m->n; i++) {
    for (int j = 0; j < m->n; j++) {
      for (int k = 0; k < m->n; k++) {
        out.a[i][j] += m->a[i][k] * m->a[k][j];
      }
      most = fmax(most, fabs(out.a[i][j]));
    }
  }
  for (int i = 0; i < m->n; i++) {
    for (int j = 0; j < m->n; j++) {
      m->a[i][j] = out.a[i][j] / most;
    }
  }
  return log(most);
}

/* Returns the spectral radius by Gelfand's formula |M^N|^(1/N), with N = 2^40. */
static double matrix_radius(matrix m)
{
  double sum = 0.0;
  double weight = 1.0;
  for (int k = 0; k < SQUARINGS; k++) {
    weight *= 0.5;
    sum += weight * square(&m);
  }
  return exp(sum);
}

/* Chooses a random point (A, B) in a box that is 0.1 to 10 times as large as the stability
 * region. */
static void random_point(uint64_t *seed, int method, double point[2])
{
  double limit = baum_i_stability_limit(&methods[method], 1.0);
  double scale = limit * pow(10.0, uniform(seed, -1.0, 1.0));
  point[0] = scale * uniform(seed, -0.3, 2.0);
  point[1] = scale * scale * uniform(seed, -0.5, 4.0);
}

static void radius_is_the_spectral_radius_of_the_step_matrix(void **state)
{
  (void)state;
  uint64_t seed = 1;
  for (int k = 0; k < POINTS; k++) {
    for (int m = AB2; m <= AB4; m++) {
      double p[2];
      random_point(&seed, m, p);
      double want = matrix_radius(step_matrix(&methods[m], p[0], p[1]));
      /* Each of the 40 squarings has half the weight of the previous one, so rounding errors do not
       * add up. The radius is accurate if the largest roots are simple. */
      ASSERT_NEAR(amplification_at(m, p[0], p[1]).spectral_radius, want, 1e-9, 0.0);
    }
  }
}

static void within_agrees_with_the_radius(void **state)
{
  (void)state;
  uint64_t seed = 2;
  int within = 0;
  for (int k = 0; k < POINTS; k++) {
    for (int m = EULER; m < METHOD_COUNT; m++) {
      double p[2];
      random_point(&seed, m, p);
      double growth = baum_i_amplification_growth(&methods[m], p[0], p[1]);
      double level = uniform(&seed, -0.7, 0.3);
      bool want = growth <= level;
      within += want;
      assert_int_equal(baum_i_amplification_within(&methods[m], p[0], p[1], level), want);
      /* If two of the largest roots nearly coincide, baum_i_amplification_within() has an error of
       * up to 1e-5 of the radius. */
      double off = 1e-5 * (1.0 + growth);
      assert_true(baum_i_amplification_within(&methods[m], p[0], p[1], growth + off));
      assert_false(baum_i_amplification_within(&methods[m], p[0], p[1], growth - off));
    }
  }
  assert_true(within > POINTS); /* out of POINTS * METHOD_COUNT points */
}

/* Evaluates p(z) = z^k - z^(k-1) - mu sum b_j z^(k-1-j) for both values of mu, and returns the
 * smaller of the two values |p(z)|. */
static double residual(int method, double A, double B, const double z[2])
{
  double least = HUGE_VAL;
  double root = A * A - B;
  for (int sign = -1; sign <= 1; sign += 2) {
    double mu[2] = {-A + (root > 0.0 ? sign * sqrt(root) : 0.0),
                    root < 0.0 ? sign * sqrt(-root) : 0.0};
    double p[2] = {1.0, 0.0}; /* evaluated by Horner's rule */
    for (int j = 0; j < methods[method].degree; j++) {
      double b = methods[method].coefficients[j];
      double next[2] = {p[0] * z[0] - p[1] * z[1] - mu[0] * b,
                        p[0] * z[1] + p[1] * z[0] - mu[1] * b};
      p[0] = next[0] - (j == 0 ? 1.0 : 0.0);
      p[1] = next[1];
    }
    least = fmin(least, hypot(p[0], p[1]));
  }
  return least;
}

static void both_z_are_roots_and_the_larger_comes_first(void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int k = 0; k < POINTS; k++) {
    for (int m = AB2; m <= AB4; m++) {
      double p[2];
      random_point(&seed, m, p);
      baum_amplification a = amplification_at(m, p[0], p[1]);
      double scale = pow(1.0 + a.spectral_radius, methods[m].degree);
      for (int i = 0; i < 2; i++) { /* the tolerance allows for rounding errors of powers of z */
        ASSERT_NEAR(residual(m, p[0], p[1], a.z[i]), 0.0, 0.0, 1e-13 * scale);
      }
      assert_true(hypot(a.z[0][0], a.z[0][1]) >= hypot(a.z[1][0], a.z[1][1]) - 1e-12);
      ASSERT_NEAR(a.damping, 1.0 - a.spectral_radius, 0.0, 1e-14 * scale);
    }
  }
}

/* If the gains are small, z = exp(mu) = 1 + mu + ... In each step a violation decreases by the
 * fraction A. This fraction must have full relative accuracy. */
static void small_gains_keep_their_digits(void **state)
{
  (void)state;
  for (int m = AB2; m <= AB4; m++) {
    for (double A = 1e-3; A > 1e-11; A *= 0.1) {
      ASSERT_NEAR(baum_i_amplification_growth(&methods[m], A, A * A), expm1(-A),
                  3.0 * A * A + 1e-12, 0.0);
    }
    assert_int_equal(amplification_at(m, 1e-11, 1e-22).stability, BAUM_STABLE);
    assert_int_equal(amplification_at(m, 0.0, 0.0).stability, BAUM_MARGINAL);
    assert_int_equal(amplification_at(m, 0.1, 0.0).stability, BAUM_MARGINAL);
  }
}

/* At the end of the stable interval of real mu, z = -1. This gives mu = 2 (-1)^k / sum b_j
 * (-1)^(k-1-j). */
static void limits_with_critical_damping_are_the_published_ones(void **state)
{
  (void)state;
  static const double want[] = {1.0, 6.0 / 11.0, 3.0 / 10.0};
  for (int m = AB2; m <= AB4; m++) {
    ASSERT_NEAR(baum_i_stability_limit(&methods[m], 1.0), want[m - AB2], 1e-12, 0.0);
  }
}

static void gains_that_overflow_are_unstable(void **state)
{
  (void)state;
  for (int m = AB2; m <= AB4; m++) {
    assert_int_equal(amplification_at(m, 1e200, 1e300).stability, BAUM_UNSTABLE);
    assert_int_equal(amplification_at(m, 1.0, (double)INFINITY).stability, BAUM_UNSTABLE);
    assert_true(isinf(amplification_at(m, 1e300, 1e10).spectral_radius));
    assert_false(baum_i_amplification_within(&methods[m], 1e300, 1e10, 0.0));
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(radius_is_the_spectral_radius_of_the_step_matrix),
    cmocka_unit_test(within_agrees_with_the_radius),
    cmocka_unit_test(both_z_are_roots_and_the_larger_comes_first),
    cmocka_unit_test(small_gains_keep_their_digits),
    cmocka_unit_test(limits_with_critical_damping_are_the_published_ones),
    cmocka_unit_test(gains_that_overflow_are_unstable),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
