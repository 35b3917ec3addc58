/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/rotation.h"

/* Below, sin(x) / x is 1 to rounding and a quotient could be 0 / 0. */
static const double TINY = 1e-12;

void baum_i_quaternion_exp(const double rotation[3], double p[4])
{
  double half = 0.5 * sqrt(baum_i_dot3(rotation, rotation));
  double factor = half > TINY ? 0.5 * sin(half) / half : 0.5;
  p[0] = cos(half);
  for (int i = 0; i < 3; i++) {
    p[1 + i] = factor * rotation[i];
  }
}

/* p and -p are the same rotation; the one with w >= 0 has the smaller angle. */
void baum_i_quaternion_log(const double p[4], double rotation[3])
{
  double sine = sqrt(baum_i_dot3(p + 1, p + 1));
  double factor = sine > TINY ? 2.0 * atan2(sine, fabs(p[0])) / sine : 2.0;
  for (int i = 0; i < 3; i++) {
    rotation[i] = copysign(factor, p[0]) * p[1 + i];
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
