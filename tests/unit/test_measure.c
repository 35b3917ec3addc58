/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the functions of base/measure_hot.c with plain loops. Hot files are compiled in two
 * versions, and both are tested. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "base/hot.h"
#include "base/measure.h"

enum { MOST = 23 };

static const baum_i_measure_kernel *kernel_of(int k)
{
  bool wide = k == 1 && baum_i_hot_is_wide();
  (void)wide; /* builds for other processors have only one table */
  return BAUM_I_HOT_TABLE(wide, baum_i_measure_kernel);
}

static void fill(double *x, double seed)
{
  for (int i = 0; i < MOST; i++) {
    x[i] = sin(seed + 1.7 * i);
  }
}

static void sizes_agree_with_plain_loops(void **state)
{
  (void)state;
  double x[MOST];
  double scale[MOST];
  for (int n = 0; n <= MOST; n++) {
    fill(x, n);
    double size = 0.0;
    double scaled = 0.0;
    for (int i = 0; i < n; i++) {
      scale[i] = 0.5 + i % 3;
      size = fmax(size, fabs(x[i]));
      scaled = fmax(scaled, fabs(x[i]) / scale[i]);
    }
    for (int k = 0; k < 2; k++) {
      assert_true(kernel_of(k)->largest(n, x) == size);
      assert_true(kernel_of(k)->largest_scaled(n, x, scale) == scaled);
      assert_true(kernel_of(k)->is_finite(n, x));
    }
  }
}

static void numbers_that_are_not_finite_are_found_everywhere(void **state)
{
  (void)state;
  const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
  double x[MOST];
  double scale[MOST];
  for (int i = 0; i < MOST; i++) {
    scale[i] = 1.5;
  }
  for (int i = 0; i < 3 * MOST; i++) {
    fill(x, 1.0);
    x[i / 3] = bad[i % 3];
    for (int k = 0; k < 2; k++) {
      assert_true(isnan(kernel_of(k)->largest(MOST, x)));
      assert_false(kernel_of(k)->is_finite(MOST, x));
      bool is_infinite = isinf(kernel_of(k)->largest_scaled(MOST, x, scale));
      assert_true(is_infinite == (i % 3 != 0));
    }
  }
}

/* If q is a polynomial of degree 4 in t, the estimated errors of positions and velocities are 0.
 * The test then changes v at the end of the step by e. This changes the estimated error dv of the
 * velocities from 0 to e. The estimated error of the positions is dq + h dv / 2, where dq is either
 * given or computed from the samples. If dq = 0 is given, the error of the positions becomes
 * h e / 2. If dq is computed, dq becomes -h e / 2, so the error of the positions stays 0. The
 * result of local_error() is the error of the positions plus `period` times the error of the
 * velocities. */
static void polynomials_have_no_local_error(void **state)
{
  (void)state;
  enum { TIMES = 5 };
  const double h = 0.25;
  double numbers[TIMES][3][MOST]; /* q, v and a at the times 0, -h, ..., -4 h */
  double scale[MOST];
  double nothing[MOST] = {0.0};
  for (int k = 0; k < TIMES; k++) {
    double t = -k * h;
    for (int i = 0; i < MOST; i++) {
      scale[i] = 1.0 + i;
      double c = scale[i] * cos(i);
      numbers[k][0][i] = c * (1.0 + t * (2.0 + t * (3.0 + t * (4.0 + t * 5.0))));
      numbers[k][1][i] = c * (2.0 + t * (6.0 + t * (12.0 + t * 20.0)));
      numbers[k][2][i] = c * (6.0 + t * (24.0 + t * 60.0));
    }
  }
  baum_i_step_samples s = {.q = {numbers[1][0], numbers[0][0]},
                           .v = {numbers[1][1], numbers[0][1]},
                           .scale = scale,
                           .h = h,
                           .period = 2.0};
  for (int k = 0; k < TIMES; k++) {
    s.a[k] = numbers[k][2];
  }
  for (int k = 0; k < 2; k++) {
    /* The error of the Hermite rule is h^5 / 720 times the fifth derivative of q, which is 0. Only
     * the rounding errors of terms below 6 remain. */
    ASSERT_NEAR(kernel_of(k)->local_error(MOST, &s), 0.0, 0.0, 1e-14);
  }
  numbers[0][1][MOST - 1] += 0.5 * scale[MOST - 1]; /* e = 0.5 */
  s.dq = nothing;
  for (int k = 0; k < 2; k++) {
    double want = 0.5 * h * 0.5 + 2.0 * 0.5;
    ASSERT_NEAR(kernel_of(k)->local_error(MOST, &s), want, 1e-14, 0.0);
  }
  s.dq = NULL;
  for (int k = 0; k < 2; k++) {
    ASSERT_NEAR(kernel_of(k)->local_error(MOST, &s), 2.0 * 0.5, 1e-13, 0.0);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(sizes_agree_with_plain_loops),
    cmocka_unit_test(numbers_that_are_not_finite_are_found_everywhere),
    cmocka_unit_test(polynomials_have_no_local_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
