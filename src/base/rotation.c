/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/rotation.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/sincos.h"

/* For angles x below this, sin(x) / x is 1 up to rounding. The quotient is then not computed,
 * because it could be 0 / 0. */
static const double TINY = 1e-12;

void baum_i_quaternion_exp(const double rotation[3], double p[4])
{
  double half = 0.5 * sqrt(baum_i_dot3(rotation, rotation));
  bool small = half <= 0.7; /* true for most rotations in a step */
  double sine = small ? baum_i_sine_kernel(half, 0.0) : sin(half);
  double factor = half > TINY ? 0.5 * sine / half : 0.5;
  p[0] = small ? baum_i_cosine_kernel(half, 0.0) : cos(half);
  for (int i = 0; i < 3; i++) {
    p[1 + i] = factor * rotation[i];
  }
}

/* p and -p represent the same rotation. The function uses the sign for which w >= 0, because the
 * angle is then at most pi. */
void baum_i_quaternion_log(const double p[4], double rotation[3])
{
  double sine = sqrt(baum_i_dot3(p + 1, p + 1));
  double factor = sine > TINY ? 2.0 * atan2(sine, fabs(p[0])) / sine : 2.0;
  for (int i = 0; i < 3; i++) {
    rotation[i] = copysign(factor, p[0]) * p[1 + i];
  }
}

/* The matrix determines 4 p p^T, whose rows are multiples of p. The row with the largest diagonal
 * entry is normalized, because this row is the longest one. */
void baum_i_quaternion_of(const double axes[9], double p[4])
{
  const double trace = axes[0] + axes[4] + axes[8];
  const double diagonal[4] = {1.0 + trace, 1.0 + 2.0 * axes[0] - trace, 1.0 + 2.0 * axes[4] - trace,
                              1.0 + 2.0 * axes[8] - trace};
  const double outer[4][4] = {
    {diagonal[0], axes[7] - axes[5], axes[2] - axes[6], axes[3] - axes[1]},
    {axes[7] - axes[5], diagonal[1], axes[1] + axes[3], axes[2] + axes[6]},
    {axes[2] - axes[6], axes[1] + axes[3], diagonal[2], axes[5] + axes[7]},
    {axes[3] - axes[1], axes[2] + axes[6], axes[5] + axes[7], diagonal[3]}};
  int best = 0;
  for (int i = 1; i < 4; i++) {
    best = diagonal[i] > diagonal[best] ? i : best;
  }
  const double length = copysign(baum_i_quaternion_length(outer[best]), outer[best][0]);
  for (int i = 0; i < 4; i++) {
    p[i] = outer[best][i] / length;
  }
}

/* Set x to c x + s y, and y to c y - s x. Each of the two vectors has three numbers, which are
 * `stride` apart in memory. */
static void rotate_pair(double c, double s, int stride, double *x, double *y)
{
  for (int k = 0; k < 3 * stride; k += stride) {
    double old = x[k];
    x[k] = c * old + s * y[k];
    y[k] = c * y[k] - s * old;
  }
}

/* Make six sweeps of Jacobi's rotations (1846). About three sweeps already reduce the off-diagonal
 * entries to rounding errors. Each rotation puts the smaller moment first. */
void baum_i_principal_axes(const double matrix[9], double moments[3], double axes[9])
{
  static const int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  double a[9];
  memcpy(a, matrix, sizeof a);
  for (int i = 0; i < 9; i++) {
    axes[i] = i % 4 == 0;
  }
  for (int n = 0; n < 18; n++) {
    int i = pairs[n % 3][0];
    int j = pairs[n % 3][1];
    double angle = 0.5 * atan2(-2.0 * a[3 * i + j], a[4 * j] - a[4 * i]);
    rotate_pair(cos(angle), sin(angle), 3, a + i, a + j);
    rotate_pair(cos(angle), sin(angle), 1, a + (ptrdiff_t)3 * i, a + (ptrdiff_t)3 * j);
    rotate_pair(cos(angle), sin(angle), 1, axes + (ptrdiff_t)3 * i, axes + (ptrdiff_t)3 * j);
  }
  for (int i = 0; i < 3; i++) {
    moments[i] = a[4 * i];
  }
}

void baum_i_normalize3(double x[3])
{
  double largest = fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
  for (int i = 0; i < 3; i++) {
    x[i] /= largest;
  }
  double length = sqrt(baum_i_dot3(x, x));
  for (int i = 0; i < 3; i++) {
    x[i] /= length;
  }
}

void baum_i_complete_axes(const double z[3], double x[3], double y[3])
{
  int least = fabs(z[0]) <= fabs(z[1]) ? 0 : 1;
  least = fabs(z[2]) < fabs(z[least]) ? 2 : least;
  const double away[3] = {least == 0, least == 1, least == 2};
  baum_i_cross(away, z, x);
  double length = sqrt(baum_i_dot3(x, x));
  for (int i = 0; i < 3; i++) {
    x[i] /= length;
  }
  baum_i_cross(z, x, y);
}
