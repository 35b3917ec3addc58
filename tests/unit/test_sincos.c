/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the sines and cosines of src/base/sincos.h, and the frames that are computed with them. The
 * references are sinl() and cosl() in long double. Both functions reduce the argument exactly, and
 * their results have eleven more bits than a double. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>

#include <baum/planar.h>

#include "base/hot.h"
#include "base/sincos.h"
#include "construct.h"
#include "dynamics/dynamics.h"
#include "mechanism/planar/frames.h"
#include "saddle.h" /* for random numbers */

#define PI 3.14159265358979323846

enum { BODIES = 7 }; /* not a multiple of the vector length */

/* The largest allowed error, in units in the last place of the exact value. */
static const double ONE_ULP = 1.0;

/* Skips the test if long double is not longer than double. This is the case on some processors and
 * under valgrind. */
static void skip_without_long_double(void)
{
  volatile long double one = 1.0L;
  if (one + 0x1p-60L == one) {
    skip();
  }
}

/* Returns the error in units in the last place of the exact value. */
static double ulps(double got, long double exact)
{
  double near = fabs((double)exact);
  double ulp = near > 0.0 ? nextafter(near, (double)INFINITY) - near : DBL_TRUE_MIN;
  return (double)(fabsl((long double)got - exact) / (long double)ulp);
}

static double worse(double a, double b)
{
  return isnan(a) || a > b ? a : b;
}

/* Returns the error of the sine or of the cosine, whichever is larger. */
static double error_of(double x, double sine, double cosine)
{
  return worse(ulps(sine, sinl((long double)x)), ulps(cosine, cosl((long double)x)));
}

static double error_at(double x)
{
  double sine;
  double cosine;
  baum_i_sincos(x, &sine, &cosine);
  return error_of(x, sine, cosine);
}

static double error_on_both_sides(double x)
{
  return worse(error_at(x), error_at(-x));
}

/* ---- the function ---- */

static void random_angles_are_right_to_one_ulp(void **state)
{
  (void)state;
  skip_without_long_double();
  static const double sizes[] = {0.1, 1.0, PI, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6};
  uint64_t seed = 1;
  for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
    double worst = 0.0;
    for (int i = 0; i < 100000; i++) {
      worst = worse(error_at(sizes[k] * saddle_random(&seed)), worst);
    }
    printf("up to %-8g %.3f ulp\n", sizes[k], worst);
    assert_true(worst <= ONE_ULP);
  }
}

/* Tests all multiples of pi/2 up to the limit, and the doubles next to them. At these angles the
 * sine or the cosine is smallest, so that the reduction cancels most digits. */
static void neighbours_of_all_multiples_of_a_right_angle_are_right(void **state)
{
  (void)state;
  skip_without_long_double();
  static const long double half_pi = 1.57079632679489661923132169163975144L;
  double worst = 0.0;
  for (int n = 1; n * (PI / 2) < baum_i_sincos_limit; n++) {
    double x = (double)((long double)n * half_pi);
    worst = worse(error_on_both_sides(x), worst);
    worst = worse(error_on_both_sides(nextafter(x, 0.0)), worst);
    worst = worse(error_on_both_sides(nextafter(x, (double)INFINITY)), worst);
  }
  assert_true(worst <= ONE_ULP);
}

/* Tests the doubles next to odd multiples of pi/4, where the reduction changes to the next multiple
 * of pi/2. */
static void neighbours_of_odd_multiples_of_half_a_right_angle_are_right(void **state)
{
  (void)state;
  skip_without_long_double();
  double worst = 0.0;
  for (int n = 1; n * (PI / 4) < baum_i_sincos_limit; n += 2) {
    double x = n * (PI / 4);
    worst = worse(error_on_both_sides(x), worst);
    worst = worse(error_on_both_sides(nextafter(x, 0.0)), worst);
    worst = worse(error_on_both_sides(nextafter(x, (double)INFINITY)), worst);
  }
  assert_true(worst <= ONE_ULP);
}

static void tiny_angles_are_their_own_sines(void **state)
{
  (void)state;
  for (double x = 1e-9; x > 0.0; x *= 0.1) {
    double sine;
    double cosine;
    baum_i_sincos(x, &sine, &cosine);
    /* x^3 / 6 and x^2 / 2 are smaller than rounding errors. */
    assert_true(sine == x && cosine == 1.0);
    baum_i_sincos(-x, &sine, &cosine);
    assert_true(sine == -x && cosine == 1.0);
  }
}

static void zero_has_exact_values(void **state)
{
  (void)state;
  double sine;
  double cosine;
  baum_i_sincos(0.0, &sine, &cosine);
  assert_true(sine == 0.0 && cosine == 1.0);
  baum_i_sincos(-0.0, &sine, &cosine);
  assert_true(sine == 0.0 && cosine == 1.0);
}

static void values_at_the_limit_are_right(void **state)
{
  (void)state;
  skip_without_long_double();
  double inside = nextafter(baum_i_sincos_limit, 0.0);
  assert_true(baum_i_sincos_limit == 1e6);
  assert_true(error_on_both_sides(baum_i_sincos_limit) <= ONE_ULP);
  assert_true(error_on_both_sides(inside) <= ONE_ULP);
}

/* ---- frames, in both builds of the hot files ---- */

typedef struct frames {
  baum_mechanism *mechanism;
  baum_workspace *workspace;
  double q[3 * BODIES];
} frames;

static frames make_frames(bool plain)
{
  frames f = {0};
  f.mechanism = create_mechanism();
  baum_planar_body_def def = baum_planar_body_def_default();
  for (int k = 0; k < BODIES; k++) {
    assert_int_equal(baum_mechanism_add_planar_body(f.mechanism, &def, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(f.mechanism), BAUM_OK);
  assert_int_equal(baum_workspace_create(f.mechanism, &f.workspace), BAUM_OK);
  if (plain) {
    f.workspace->point.kernel = &baum_i_frames_kernel_plain;
  }
  return f;
}

static void free_frames(frames *f)
{
  baum_workspace_destroy(f->workspace);
  baum_mechanism_destroy(f->mechanism);
}

/* Sets the angles of the bodies and returns the frames. */
static const baum_i_frame *frames_at(frames *f, const double angle[BODIES])
{
  for (int k = 0; k < BODIES; k++) {
    f->q[3 * k + 2] = angle[k];
  }
  baum_i_point_set(&f->workspace->point, 0.0, f->q, NULL);
  return f->workspace->point.frames + 1;
}

/* The build with fused multiply-add rounds differently, but its errors are not larger. */
static void frames_of_both_builds_are_right_to_one_ulp(void **state)
{
  (void)state;
  skip_without_long_double();
  for (int plain = 0; plain < 2; plain++) {
    frames f = make_frames(plain == 1);
    uint64_t seed = 2;
    double worst = 0.0;
    for (int i = 0; i < 100000; i++) {
      double angle[BODIES];
      double size = i % 2 == 0 ? 10.0 : 1e6;
      for (int k = 0; k < BODIES; k++) {
        double x = size * saddle_random(&seed);
        angle[k] = i % 3 == 0 ? round(x / (PI / 2)) * (PI / 2) : x;
      }
      const baum_i_frame *frame = frames_at(&f, angle);
      for (int k = 0; k < BODIES; k++) {
        worst = worse(error_of(angle[k], frame[k].s, frame[k].c), worst);
      }
    }
    printf("frames, %s: %.3f ulp\n", plain || !baum_i_hot_is_wide() ? "plain" : "wide", worst);
    free_frames(&f);
    assert_true(worst <= ONE_ULP);
  }
}

/* For an angle that is too large for sincos.h, the C library is used. The results for the other
 * angles in the same vector must not change. */
static void frames_of_large_angles_are_those_of_the_c_library(void **state)
{
  (void)state;
  static const double far[] = {1000000.5, -1e7, 1e9, -3e15, 1e22, -1.7e308};
  for (int plain = 0; plain < 2; plain++) {
    frames f = make_frames(plain == 1);
    for (size_t i = 0; i < sizeof far / sizeof *far; i++) {
      for (int at = 0; at < BODIES; at++) {
        double angle[BODIES] = {0.1, 1.1, 2.1, 3.1, 4.1, 5.1, 6.1};
        const baum_i_frame *frame = frames_at(&f, angle);
        baum_i_frame near[BODIES];
        for (int k = 0; k < BODIES; k++) {
          near[k] = frame[k];
        }
        angle[at] = far[i];
        frame = frames_at(&f, angle);
        for (int k = 0; k < BODIES; k++) {
          assert_true(frame[k].s == (k == at ? sin(far[i]) : near[k].s));
          assert_true(frame[k].c == (k == at ? cos(far[i]) : near[k].c));
        }
      }
    }
    free_frames(&f);
  }
}

static void frames_of_angles_that_are_not_finite_are_nan(void **state)
{
  (void)state;
  static const double bad[] = {(double)INFINITY, -(double)INFINITY, (double)NAN};
  for (int plain = 0; plain < 2; plain++) {
    frames f = make_frames(plain == 1);
    for (int i = 0; i < 3; i++) {
      double angle[BODIES] = {0.0, 0.0, bad[i], 0.0, 0.0, 0.0, bad[i]};
      const baum_i_frame *frame = frames_at(&f, angle);
      for (int k = 0; k < BODIES; k++) {
        bool is_bad = k == 2 || k == 6;
        assert_true(is_bad ? isnan(frame[k].s) && isnan(frame[k].c)
                           : frame[k].s == 0.0 && frame[k].c == 1.0);
      }
    }
    free_frames(&f);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(random_angles_are_right_to_one_ulp),
    cmocka_unit_test(neighbours_of_all_multiples_of_a_right_angle_are_right),
    cmocka_unit_test(neighbours_of_odd_multiples_of_half_a_right_angle_are_right),
    cmocka_unit_test(tiny_angles_are_their_own_sines),
    cmocka_unit_test(zero_has_exact_values),
    cmocka_unit_test(values_at_the_limit_are_right),
    cmocka_unit_test(frames_of_both_builds_are_right_to_one_ulp),
    cmocka_unit_test(frames_of_large_angles_are_those_of_the_c_library),
    cmocka_unit_test(frames_of_angles_that_are_not_finite_are_nan),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
