/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests one step of the torque-free rotation of a rigid body, and the principal axes that this step
 * uses. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "base/rotation.h"
#include "integrate/free_rotation.h"

static const double TILT[4] = {0.7, -0.1, 0.5, 0.5};
static const double MOMENTUM[3] = {0.9, -0.4, 0.6};

/* Principal moments of inertia of all kinds, in any order. There are general, slender and flat
 * bodies, a sphere, and symmetric bodies whose third moment is larger or smaller than the other
 * two. */
static const double MOMENTS[][3] = {{1.0, 2.0, 2.7},   {2.0, 0.2, 2.1}, {2.9, 1.4, 1.5},
                                    {2.0, 2.0, 0.5},   {1.0, 1.6, 1.0}, {2.0, 1e-3, 2.0},
                                    {1.0, 2.0, 2.999}, {1.5, 1.5, 1.5}};
enum { KINDS = sizeof MOMENTS / sizeof *MOMENTS };

/* Writes A diag(moments) A^T. A is the rotation TILT if `tilted`, otherwise the identity. */
static void tensor_of(const double moments[3], bool tilted, double out[9])
{
  double p[4] = {1.0, 0.0, 0.0, 0.0};
  double axes[9];
  if (tilted) {
    memcpy(p, TILT, sizeof p);
    baum_i_quaternion_normalize(p);
  }
  baum_i_rotation_of(p, axes);
  for (int i = 0; i < 9; i++) {
    out[i] = 0.0;
    for (int k = 0; k < 3; k++) {
      out[i] += axes[3 * (i / 3) + k] * moments[k] * axes[3 * (i % 3) + k];
    }
  }
}

static void principal_axes_are_sorted_and_give_the_tensor(void **state)
{
  (void)state;
  for (int n = 0; n < 2 * KINDS; n++) {
    double tensor[9];
    double moments[3];
    double axes[9];
    tensor_of(MOMENTS[n / 2], n % 2 == 1, tensor);
    baum_i_principal_axes(tensor, moments, axes);
    assert_true(moments[0] <= moments[1] + 1e-15 && moments[1] <= moments[2] + 1e-15);
    for (int i = 0; i < 9; i++) {
      double again = 0.0;
      double product = 0.0;
      for (int k = 0; k < 3; k++) {
        again += axes[3 * k + i / 3] * moments[k] * axes[3 * k + i % 3];
        product += axes[3 * (i / 3) + k] * axes[3 * (i % 3) + k];
      }
      ASSERT_NEAR(again, tensor[i], 0.0, 4e-15);
      ASSERT_NEAR(product, i % 4 == 0, 0.0, 2e-15);
    }
  }
}

/* The orientation p (unit quaternion), and the angular momentum m in body axes. */
typedef struct motion {
  double p[4];
  double m[3];
} motion;

static motion move(const double inertia[9], const motion *from, double time, int steps)
{
  const baum_i_free_rotation body = baum_i_free_rotation_of(inertia);
  motion now = *from;
  double h = time / steps;
  for (int k = 0; k < steps; k++) {
    double w[3];
    double by[4];
    double before[4];
    baum_i_rotate_freely(&body, h, now.m, w);
    const double rotation[3] = {h * w[0], h * w[1], h * w[2]};
    baum_i_quaternion_exp(rotation, by);
    memcpy(before, now.p, sizeof before);
    baum_i_quaternion_product(before, by, now.p);
  }
  return now;
}

static double apart(const motion *a, const motion *b)
{
  double largest = 0.0;
  for (int i = 0; i < 4; i++) {
    largest = fmax(largest, fabs(a->p[i] - b->p[i]));
  }
  return largest;
}

static motion start_of(void)
{
  motion out = {.p = {0.5, 0.5, -0.5, 0.5}};
  memcpy(out.m, MOMENTUM, sizeof out.m);
  return out;
}

static void check_momentum_in_space(const motion *a, const motion *b)
{
  double axes[9];
  double in_space[2][3];
  baum_i_rotation_of(a->p, axes);
  baum_i_turn(axes, a->m, in_space[0]);
  baum_i_rotation_of(b->p, axes);
  baum_i_turn(axes, b->m, in_space[1]);
  for (int i = 0; i < 3; i++) {
    ASSERT_NEAR(in_space[1][i], in_space[0][i], 0.0, 1e-13);
  }
}

/* Compares the error of a step h with the error of a step h / 2. The reference uses steps of
 * h / 64. For symmetric bodies the method is exact. */
static void rotations_are_of_order_two_and_keep_the_momentum(void **state)
{
  (void)state;
  for (int n = 0; n < 2 * KINDS; n++) {
    const double *moments = MOMENTS[n / 2];
    double tensor[9];
    double error[2];
    const motion from = start_of();
    tensor_of(moments, n % 2 == 1, tensor);
    const motion want = move(tensor, &from, 2.0, 40 * 64);
    for (int k = 0; k < 2; k++) {
      const motion got = move(tensor, &from, 2.0, 40 << k);
      check_momentum_in_space(&from, &got);
      error[k] = apart(&got, &want);
    }
    bool symmetric =
      moments[0] == moments[1] || moments[1] == moments[2] || moments[0] == moments[2];
    if (symmetric) {
      /* The method is exact. The limit is a rounding error of 1e-14, divided by the smallest
       * moment, which is 1e-3. */
      assert_true(error[0] <= 1e-11);
    } else {
      assert_true(error[0] >= 1e-7);
      ASSERT_NEAR(error[0] / error[1], 4.0, 0.02, 0.0);
    }
  }
}

static void rotations_are_symmetric(void **state)
{
  (void)state;
  for (int n = 0; n < 2 * KINDS; n++) {
    double tensor[9];
    const motion from = start_of();
    tensor_of(MOMENTS[n / 2], n % 2 == 1, tensor);
    motion there = move(tensor, &from, 4.0, 20);
    motion back = move(tensor, &there, -4.0, 20);
    assert_true(apart(&from, &there) > 0.1);
    assert_true(apart(&from, &back) <= 1e-11);
  }
}

/* One step rotates the body by 13.6 rad, which is more than two revolutions. */
static void rotations_about_principal_axes_are_exact(void **state)
{
  (void)state;
  for (int n = 0; n < 3 * KINDS; n++) {
    const double *moments = MOMENTS[n / 3];
    int axis = n % 3;
    double tensor[9];
    motion from = {.p = {1.0}};
    from.m[axis] = 1.7 * moments[axis];
    tensor_of(moments, false, tensor);
    const motion got = move(tensor, &from, 8.0, 1);
    ASSERT_NEAR(fabs(got.p[0]), fabs(cos(0.5 * 1.7 * 8.0)), 0.0, 1e-13);
    ASSERT_NEAR(fabs(got.p[1 + axis]), fabs(sin(0.5 * 1.7 * 8.0)), 0.0, 1e-13);
    ASSERT_NEAR(got.m[axis], from.m[axis], 1e-15, 0.0);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(principal_axes_are_sorted_and_give_the_tensor),
    cmocka_unit_test(rotations_are_of_order_two_and_keep_the_momentum),
    cmocka_unit_test(rotations_are_symmetric),
    cmocka_unit_test(rotations_about_principal_axes_are_exact),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
