/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares cubic splines with those of GSL. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <gsl/gsl_interp.h>
#include <cmocka.h>

#include "assert_near.h"
#include "base/cubic_spline.h"
#include "saddle.h"

enum { MOST = 200 };

/* Draws random intervals between 0.01 and 1, and values between -1 and 1. Second derivatives may
 * therefore reach 1e5. */
static void draw_points(int32_t count, uint64_t *seed, double *times, double *values)
{
  for (int32_t i = 0; i < count; i++) {
    double length = 0.505 + 0.495 * saddle_random(seed);
    times[i] = i == 0 ? 10.0 * saddle_random(seed) : times[i - 1] + length;
    values[i] = saddle_random(seed);
  }
}

/* Compares the spline with GSL's spline, over the whole range and at the given points. */
static void assert_agrees(const baum_i_cubic_spline *spline, const gsl_interp *want)
{
  double length = spline->times[spline->count - 1] - spline->times[0];
  for (int k = 0; k <= 400 + spline->count; k++) {
    double t = k > 400 ? spline->times[k - 401] : spline->times[0] + k / 400.0 * length;
    t = fmin(t, spline->times[spline->count - 1]);
    double s[3];
    double s_want[3];
    baum_i_cubic_spline_evaluate(spline, t, s);
    const double *x = spline->times;
    const double *y = spline->values;
    assert_int_equal(gsl_interp_eval_e(want, x, y, t, NULL, &s_want[0]), 0);
    assert_int_equal(gsl_interp_eval_deriv_e(want, x, y, t, NULL, &s_want[1]), 0);
    assert_int_equal(gsl_interp_eval_deriv2_e(want, x, y, t, NULL, &s_want[2]), 0);
    /* Slopes of up to about 100 are divided by intervals of 0.01, which amplifies rounding
     * errors. */
    ASSERT_NEAR(s[0], s_want[0], 0.0, 1e-13);
    ASSERT_NEAR(s[1], s_want[1], 0.0, 1e-11);
    ASSERT_NEAR(s[2], s_want[2], 0.0, 1e-9);
  }
}

static void check_splines(const gsl_interp_type *type, int32_t least, bool periodic)
{
  uint64_t seed = 1;
  for (int round = 0; round < 100; round++) {
    double times[MOST];
    double values[MOST];
    double bends[MOST];
    int32_t count = round < 10 ? least + round : least + round * (MOST - least) / 100;
    draw_points(count, &seed, times, values);
    values[count - 1] = periodic ? values[0] : values[count - 1];
    baum_i_cubic_spline spline = {count, times, values, bends};
    gsl_interp *want = gsl_interp_alloc(type, (size_t)count);
    assert_int_equal(gsl_interp_init(want, times, values, (size_t)count), 0);
    assert_int_equal(baum_i_cubic_spline_fit(&spline, periodic), BAUM_OK);
    assert_agrees(&spline, want);
    gsl_interp_free(want);
  }
}

static void natural_splines_agree_with_gsl(void **state)
{
  (void)state;
  check_splines(gsl_interp_cspline, 3, false);
}

static void periodic_splines_agree_with_gsl(void **state)
{
  (void)state;
  check_splines(gsl_interp_cspline_periodic, 3, true);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(natural_splines_agree_with_gsl),
    cmocka_unit_test(periodic_splines_agree_with_gsl),
  };
  return cmocka_run_group_tests_name("cubic_spline", tests, NULL, NULL);
}
