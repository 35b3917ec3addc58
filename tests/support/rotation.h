/* SPDX-License-Identifier: BSD-3-Clause */
/* Vectors, and unit quaternions (scalar part w first) that rotate body axes into ground axes. */
#ifndef BAUM_TEST_ROTATION_H
#define BAUM_TEST_ROTATION_H

#include <math.h>

static inline void cross(const double a[3], const double b[3], double out[3])
{
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void quaternion_product(const double a[4], const double b[4], double out[4])
{
  out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
  out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
  out[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
  out[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

static inline void quaternion_normalize(double p[4])
{
  double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]);
  for (int i = 0; i < 4; i++) {
    p[i] /= length;
  }
}

/* Writes the rotation matrix A of a quaternion, row by row. */
static inline void rotation_matrix(const double p[4], double a[9])
{
  const double w = p[0], x = p[1], y = p[2], z = p[3];
  const double rows[9] = {
    1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z),       2.0 * (x * z + w * y),
    2.0 * (x * y + w * z),       1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),
    2.0 * (x * z - w * y),       2.0 * (y * z + w * x),       1.0 - 2.0 * (x * x + y * y)};
  for (int i = 0; i < 9; i++) {
    a[i] = rows[i];
  }
}

/* Computes A s. */
static inline void rotate(const double p[4], const double s[3], double out[3])
{
  double a[9];
  rotation_matrix(p, a);
  for (int i = 0; i < 3; i++) {
    out[i] = a[3 * i] * s[0] + a[3 * i + 1] * s[1] + a[3 * i + 2] * s[2];
  }
}

#endif
