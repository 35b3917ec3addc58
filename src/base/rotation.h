/* SPDX-License-Identifier: BSD-3-Clause */
/* Vectors in space, rotation matrices A (row-major), and unit quaternions p in Hamilton's
 * convention with w as the first number. A and p transform vectors from body to ground axes: x = A
 * s. The memory of a result must not overlap with the arguments.
 */
#ifndef BAUM_I_BASE_ROTATION_H
#define BAUM_I_BASE_ROTATION_H

#include <float.h>
#include <math.h>

#define BAUM_I_REVOLUTION 6.283185307179586 /* [rad] */

static inline double baum_i_dot3(const double a[3], const double b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void baum_i_cross(const double a[3], const double b[3], double out[3])
{
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Add h x to y. */
static inline void baum_i_add_scaled3(double h, const double x[3], double y[3])
{
  for (int i = 0; i < 3; i++) {
    y[i] += h * x[i];
  }
}

/* Set out = A s, which transforms s to ground axes. */
static inline void baum_i_turn(const double axes[9], const double s[3], double out[3])
{
  for (int i = 0; i < 3; i++) {
    out[i] = baum_i_dot3(axes + 3 * i, s);
  }
}

/* Set out = A^T x, which transforms x to body axes. */
static inline void baum_i_turn_back(const double axes[9], const double x[3], double out[3])
{
  for (int i = 0; i < 3; i++) {
    out[i] = axes[i] * x[0] + axes[3 + i] * x[1] + axes[6 + i] * x[2];
  }
}

/* Set `out` to the product of the quaternions a and b. */
static inline void baum_i_quaternion_product(const double a[4], const double b[4], double out[4])
{
  out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
  out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
  out[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
  out[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

static inline double baum_i_quaternion_length(const double p[4])
{
  return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]);
}

/* Make the length of a quaternion 1. A quaternion whose length is already 1 up to rounding is not
 * changed, so that reading a state and setting it again changes nothing. */
static inline void baum_i_quaternion_normalize(double p[4])
{
  double length = baum_i_quaternion_length(p);
  if (fabs(length - 1.0) <= 4.0 * DBL_EPSILON) {
    return;
  }
  for (int i = 0; i < 4; i++) {
    p[i] /= length;
  }
}

/* Compute the rotation matrix A of a unit quaternion. */
static inline void baum_i_rotation_of(const double p[4], double axes[9])
{
  const double w = p[0], x = p[1], y = p[2], z = p[3];
  axes[0] = 1.0 - 2.0 * (y * y + z * z);
  axes[1] = 2.0 * (x * y - w * z);
  axes[2] = 2.0 * (x * z + w * y);
  axes[3] = 2.0 * (x * y + w * z);
  axes[4] = 1.0 - 2.0 * (x * x + z * z);
  axes[5] = 2.0 * (y * z - w * x);
  axes[6] = 2.0 * (x * z - w * y);
  axes[7] = 2.0 * (y * z + w * x);
  axes[8] = 1.0 - 2.0 * (x * x + y * y);
}

/* Compute the unit quaternion of a rotation vector. The direction of this vector is the axis of the
 * rotation, and its length is the angle. */
void baum_i_quaternion_exp(const double rotation[3], double p[4]);

/* Compute the rotation vector of a unit quaternion. The length of this vector is at most pi. */
void baum_i_quaternion_log(const double p[4], double rotation[3]);

/* Compute the unit quaternion of a rotation matrix, with w >= 0 (Shepperd 1978). */
void baum_i_quaternion_of(const double axes[9], double p[4]);

/* Find the principal moments of a symmetric matrix, in ascending order. The rows of the rotation
 * matrix `axes` are the principal axes. */
void baum_i_principal_axes(const double matrix[9], double moments[3], double axes[9]);

/* Divide a vector by its length, which must not be 0. Works even if the squares of its numbers
 * overflow. */
void baum_i_normalize3(double x[3]);

/* Set x to a unit vector orthogonal to the unit vector z, and y to the cross product of z and x. */
void baum_i_complete_axes(const double z[3], double x[3], double y[3]);

#endif
