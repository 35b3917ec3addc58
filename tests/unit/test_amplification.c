/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the roots z by which one step multiplies a constraint violation. The roots depend on A =
 * alpha h and B = (beta h)^2. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "methods.h"

enum { POINTS = 20000 };

static void is_class(int method, double alpha_h, double beta2_h2, baum_stability want)
{
  baum_amplification got = amplification_at(method, alpha_h, beta2_h2);
  if (got.stability != want) {
    print_error("method %d at (%.17g, %.17g): radius - 1 = %.3g\n", method, alpha_h, beta2_h2,
                got.spectral_radius - 1.0);
  }
  assert_int_equal(got.stability, want);
}

/* Checks that the roots of an Euler method are those of z^2 + c1 z + c0: their sum must be -c1, and
 * their product c0. */
static void has_polynomial(int method, double A, double B, double c1, double c0)
{
  baum_amplification got = amplification_at(method, A, B);
  double(*z)[2] = got.z;
  double scale = 1.0 + fabs(c1) + fabs(c0);
  ASSERT_NEAR(z[0][0] + z[1][0], -c1, 0.0, 1e-14 * scale);
  ASSERT_NEAR(z[0][1] + z[1][1], 0.0, 0.0, 1e-14 * scale);
  ASSERT_NEAR(z[0][0] * z[1][0] - z[0][1] * z[1][1], c0, 0.0, 1e-14 * scale);
}

static void both_eulers_have_the_roots_of_their_polynomials(void **state)
{
  (void)state;
  uint64_t seed = 1;
  for (int k = 0; k < POINTS; k++) {
    double A = uniform(&seed, -1.0, 3.0);
    double B = uniform(&seed, -1.0, 5.0);
    has_polynomial(EULER, A, B, 2.0 * A - 2.0, B - 2.0 * A + 1.0);
    has_polynomial(SEMI_IMPLICIT_EULER, A, B, B + 2.0 * A - 2.0, 1.0 - 2.0 * A);
  }
}

static void explicit_euler_is_stable_in_its_triangle(void **state)
{
  (void)state;
  uint64_t seed = 2;
  for (int k = 0; k < POINTS; k++) {
    double A = uniform(&seed, -0.5, 2.5);
    double B = uniform(&seed, -0.5, 4.5);
    bool stable = 0.0 < B && B < 2.0 * A && B > 4.0 * A - 4.0;
    is_class(EULER, A, B, stable ? BAUM_STABLE : BAUM_UNSTABLE);
  }
}

static void semi_implicit_euler_is_stable_in_its_own_triangle(void **state)
{
  (void)state;
  uint64_t seed = 3;
  for (int k = 0; k < POINTS; k++) {
    double A = uniform(&seed, -0.5, 1.5);
    double B = uniform(&seed, -0.5, 4.5);
    bool stable = 0.0 < A && A < 1.0 && 0.0 < B && B < 4.0 - 4.0 * A;
    is_class(SEMI_IMPLICIT_EULER, A, B, stable ? BAUM_STABLE : BAUM_UNSTABLE);
  }
}

static void edges_of_the_triangles_are_marginal(void **state)
{
  (void)state;
  uint64_t seed = 4;
  for (int k = 0; k < 1000; k++) {
    double s = uniform(&seed, 0.0, 1.0);
    is_class(EULER, s, 0.0, BAUM_MARGINAL);
    is_class(EULER, 2.0 * s, 4.0 * s, BAUM_MARGINAL);
    is_class(EULER, 1.0 + s, 4.0 * s, BAUM_MARGINAL);
    is_class(SEMI_IMPLICIT_EULER, s, 0.0, BAUM_MARGINAL);
    is_class(SEMI_IMPLICIT_EULER, 0.0, 4.0 * s, BAUM_MARGINAL);
    is_class(SEMI_IMPLICIT_EULER, s, 4.0 - 4.0 * s, BAUM_MARGINAL);
  }
}

/* At (A, B) = (2, 4), explicit Euler has the double root z = -1, which is on the unit circle. If A
 * and B are rounded, this root splits into two roots that are 1e-8 apart. The library must not
 * report these roots as unstable. */
static void double_roots_on_the_circle_survive_the_rounding_of_gains(void **state)
{
  (void)state;
  uint64_t seed = 5;
  for (int k = 0; k < 1000; k++) {
    double h = pow(10.0, uniform(&seed, -8.0, 0.0));
    double alpha = 2.0 / h;
    double beta = sqrt(4.0) / h;
    is_class(EULER, alpha * h, (beta * h) * (beta * h), BAUM_MARGINAL);
  }
  is_class(SEMI_IMPLICIT_EULER, 0.0, 4.0, BAUM_MARGINAL);
}

static void no_stabilization_and_beta_zero_are_marginal_for_every_method(void **state)
{
  (void)state;
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    is_class(m, 0.0, 0.0, BAUM_MARGINAL);
    is_class(m, 0.3, 0.0, BAUM_MARGINAL);
    assert_true(amplification_at(m, 0.3, 0.0).spectral_radius == 1.0);
  }
  is_class(EULER, 1.5, 0.0, BAUM_UNSTABLE);
}

static void taylor_gains_with_explicit_euler_are_marginal_despite_rounding(void **state)
{
  (void)state;
  uint64_t seed = 6;
  for (int k = 0; k < 1000; k++) {
    double h = pow(10.0, uniform(&seed, -8.0, 0.0));
    double alpha = 1.0 / h;
    double beta = sqrt(2.0) / h;
    is_class(EULER, alpha * h, (beta * h) * (beta * h), BAUM_MARGINAL);
  }
}

static void small_gains_are_stable_down_to_the_margin(void **state)
{
  (void)state;
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    is_class(m, 1e-11, 1e-22, BAUM_STABLE);
    is_class(m, 1e-13, 1e-26, BAUM_MARGINAL);
    /* The two roots of semi-implicit Euler differ by sqrt(A B). */
    ASSERT_NEAR(baum_i_amplification_growth(&methods[m], 1e-13, 1e-26), -1e-13, 1e-6, 0.0);
  }
}

/* Compares spectral radii at two points (A, B) with their closed forms. The points are (1, 1) and
 * (1, 2). The Taylor gains give the second point. */
static void spectral_radii_have_their_closed_forms(void **state)
{
  (void)state;
  static const double want[ONE_STEP_COUNT][2] = {
    [EULER] = {0.0, 1.0},
    /* The golden ratio, and 1 + sqrt(2). */
    [SEMI_IMPLICIT_EULER] = {1.6180339887498949, 2.4142135623730951},
    [RK2] = {0.5, 0.0},
    [RK3] = {1.0 / 3.0, 0.47140452079103168}, /* 1 - 1 + 1/2 - 1/6, and |1 + i| / 3 */
    [RK4] = {0.375, 0.37267799624996495},     /* 9/24, and sqrt(5) / 6 */
  };
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    ASSERT_NEAR(amplification_at(m, 1.0, 1.0).spectral_radius, want[m][0], 1e-14, 0.0);
    ASSERT_NEAR(amplification_at(m, 1.0, 2.0).spectral_radius, want[m][1], 1e-14, 1e-15);
  }
}

/* ---- The methods themselves, on x'' = -2 A x' - B x with h = 1 --------------- */

typedef struct oscillator {
  double A;
  double B;
} oscillator;

static void rate(const oscillator *o, const double y[2], double out[2])
{
  out[0] = y[1];
  out[1] = -2.0 * o->A * y[1] - o->B * y[0];
}

static void euler_step(const oscillator *o, double y[2])
{
  double f[2];
  rate(o, y, f);
  y[0] += f[0];
  y[1] += f[1];
}

static void semi_implicit_step(const oscillator *o, double y[2])
{
  y[1] += -2.0 * o->A * y[1] - o->B * y[0];
  y[0] += y[1];
}

/* Sets f to the time derivative at the state y + weight k. */
static void stage(const oscillator *o, const double y[2], double weight, const double k[2],
                  double f[2])
{
  rate(o, (const double[2]){y[0] + weight * k[0], y[1] + weight * k[1]}, f);
}

static void midpoint_step(const oscillator *o, double y[2])
{
  double k1[2];
  double k2[2];
  rate(o, y, k1);
  stage(o, y, 0.5, k1, k2);
  y[0] += k2[0];
  y[1] += k2[1];
}

/* Makes a step of Heun's third-order method. */
static void heun_step(const oscillator *o, double y[2])
{
  double k1[2];
  double k2[2];
  double k3[2];
  rate(o, y, k1);
  stage(o, y, 1.0 / 3.0, k1, k2);
  stage(o, y, 2.0 / 3.0, k2, k3);
  for (int i = 0; i < 2; i++) {
    y[i] += (k1[i] + 3.0 * k3[i]) / 4.0;
  }
}

static void classical_step(const oscillator *o, double y[2])
{
  double k1[2];
  double k2[2];
  double k3[2];
  double k4[2];
  rate(o, y, k1);
  stage(o, y, 0.5, k1, k2);
  stage(o, y, 0.5, k2, k3);
  stage(o, y, 1.0, k3, k4);
  for (int i = 0; i < 2; i++) {
    y[i] += (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0;
  }
}

typedef void step_function(const oscillator *o, double y[2]);

static step_function *const steps[ONE_STEP_COUNT] = {euler_step, semi_implicit_step, midpoint_step,
                                                     heun_step, classical_step};

/* Returns the mean growth of log |y| per step, over steps 200 to 2000. After every step, |y| is
 * scaled to 1. */
static double observed_log_radius(int method, const oscillator *o)
{
  double y[2] = {1.0, 0.3};
  double sum = 0.0;
  for (int k = 0; k < 2000; k++) {
    steps[method](o, y);
    double size = hypot(y[0], y[1]);
    y[0] /= size;
    y[1] /= size;
    sum += k < 200 ? 0.0 : log(size);
  }
  return sum / 1800.0;
}

/* Compares the trace and the determinant of the matrix of one step with the sum and the product of
 * the predicted roots. */
static void agrees_with_the_step_matrix(int method, const oscillator *o)
{
  double first[2] = {1.0, 0.0};
  double second[2] = {0.0, 1.0};
  steps[method](o, first);
  steps[method](o, second);
  baum_amplification got = amplification_at(method, o->A, o->B);
  double(*z)[2] = got.z;
  ASSERT_NEAR(z[0][0] + z[1][0], first[0] + second[1], 1e-11, 1e-11);
  ASSERT_NEAR(z[0][0] * z[1][0] - z[0][1] * z[1][1], first[0] * second[1] - first[1] * second[0],
              1e-11, 1e-11);
}

static void spectral_radius_is_the_observed_growth(void **state)
{
  (void)state;
  uint64_t seed = 7;
  for (int k = 0; k < 500; k++) {
    oscillator o = {uniform(&seed, 0.0, 3.0), uniform(&seed, 0.0, 9.0)};
    for (int m = 0; m < ONE_STEP_COUNT; m++) {
      agrees_with_the_step_matrix(m, &o);
      double radius = amplification_at(m, o.A, o.B).spectral_radius;
      /* If the roots are complex, log |y| oscillates about its mean growth. Over 1800 steps the
       * oscillation averages out. */
      ASSERT_NEAR(observed_log_radius(m, &o), log(radius), 0.0, 5e-3);
    }
  }
}

static void the_larger_root_comes_first_and_gives_the_radius(void **state)
{
  (void)state;
  uint64_t seed = 8;
  for (int k = 0; k < POINTS; k++) {
    int m = k % ONE_STEP_COUNT;
    baum_amplification a = amplification_at(m, uniform(&seed, 0.0, 3.0), uniform(&seed, -1.0, 9.0));
    assert_true(hypot(a.z[0][0], a.z[0][1]) >= hypot(a.z[1][0], a.z[1][1]) - 1e-14);
    assert_true(a.spectral_radius == hypot(a.z[0][0], a.z[0][1]));
  }
}

static void numbers_beyond_double_are_infinitely_unstable(void **state)
{
  (void)state;
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    is_class(m, 1e200, 1e300, BAUM_UNSTABLE);
    is_class(m, 1e300, 1e10, BAUM_UNSTABLE);
    is_class(m, 1.0, (double)INFINITY, BAUM_UNSTABLE);
    is_class(m, (double)INFINITY, (double)INFINITY, BAUM_UNSTABLE);
  }
  assert_true(isinf(amplification_at(RK4, 1e200, 1e300).spectral_radius));
  assert_true(isinf(amplification_at(RK4, 1.0, 1e300).spectral_radius));
}

static void a_variable_step_has_no_radius(void **state)
{
  (void)state;
  static const baum_i_method variable = {
    .kind = BAUM_I_METHOD_VARIABLE_STEP, .degree = 0, .coefficients = {0.0}};
  baum_amplification a = {.struct_size = 77};
  baum_i_amplification(&variable, 1.0, 1.0, &a);
  assert_int_equal(a.stability, BAUM_VARIABLE_STEP);
  assert_true(isnan(a.spectral_radius));
  for (int k = 0; k < 4; k++) {
    assert_true(isnan(a.z[k / 2][k % 2]));
  }
  assert_int_equal(a.struct_size, 77);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(both_eulers_have_the_roots_of_their_polynomials),
    cmocka_unit_test(explicit_euler_is_stable_in_its_triangle),
    cmocka_unit_test(semi_implicit_euler_is_stable_in_its_own_triangle),
    cmocka_unit_test(edges_of_the_triangles_are_marginal),
    cmocka_unit_test(double_roots_on_the_circle_survive_the_rounding_of_gains),
    cmocka_unit_test(no_stabilization_and_beta_zero_are_marginal_for_every_method),
    cmocka_unit_test(taylor_gains_with_explicit_euler_are_marginal_despite_rounding),
    cmocka_unit_test(small_gains_are_stable_down_to_the_margin),
    cmocka_unit_test(spectral_radii_have_their_closed_forms),
    cmocka_unit_test(spectral_radius_is_the_observed_growth),
    cmocka_unit_test(the_larger_root_comes_first_and_gives_the_radius),
    cmocka_unit_test(numbers_beyond_double_are_infinitely_unstable),
    cmocka_unit_test(a_variable_step_has_no_radius),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
