/* SPDX-License-Identifier: BSD-3-Clause */
#include "integrate/free_rotation.h"

#include <stddef.h>
#include <string.h>

#include "base/rotation.h"

baum_i_free_rotation baum_i_free_rotation_of(const double inertia[9])
{
  baum_i_free_rotation out;
  double moments[3];
  double axes[9];
  double inverse[3];
  baum_i_principal_axes(inertia, moments, axes);
  for (int i = 0; i < 3; i++) {
    inverse[i] = 1.0 / moments[i];
  }
  int first = inverse[0] - inverse[1] > inverse[1] - inverse[2] ? 0 : 2;
  memcpy(out.axis_0, axes + (ptrdiff_t)3 * first, sizeof out.axis_0);
  memcpy(out.axis_2, axes + (ptrdiff_t)3 * (2 - first), sizeof out.axis_2);
  out.inverse_1 = inverse[1];
  out.excess_0 = inverse[first] - inverse[1];
  out.excess_2 = inverse[2 - first] - inverse[1];
  out.largest = inverse[0];
  return out;
}

/* Rotate the orientation given by the quaternion p with the constant angular velocity w for the
 * time h. */
static void turn(double h, const double w[3], double p[4])
{
  const double rotation[3] = {h * w[0], h * w[1], h * w[2]};
  double before[4];
  double by[4];
  memcpy(before, p, sizeof before);
  baum_i_quaternion_exp(rotation, by);
  baum_i_quaternion_product(before, by, p);
}

/* Rotate the body about an axis by an angle that is proportional to the momentum along this axis.
 * In slender bodies the momentum along the long axis is small. If the axis is a coordinate axis of
 * the body, rounding errors do not change this component of the momentum. */
static void turn_about(const double axis[3], double h, double p[4], double momentum[3])
{
  double angle = h * baum_i_dot3(axis, momentum);
  double across[3];
  double back[3];
  turn(angle, axis, p);
  baum_i_cross(axis, momentum, across);
  baum_i_cross(axis, across, back);
  baum_i_add_scaled3(-sin(angle), across, momentum);
  baum_i_add_scaled3(1.0 - cos(angle), back, momentum);
}

void baum_i_rotate_freely(const baum_i_free_rotation *body, double h, double momentum[3],
                          double w[3])
{
  double p[4] = {1.0, 0.0, 0.0, 0.0};
  turn_about(body->axis_2, 0.5 * h * body->excess_2, p, momentum);
  turn(h * body->inverse_1, momentum, p);
  turn_about(body->axis_0, h * body->excess_0, p, momentum);
  turn_about(body->axis_2, 0.5 * h * body->excess_2, p, momentum);
  baum_i_quaternion_log(p, w);
  for (int i = 0; i < 3; i++) {
    w[i] /= h;
  }
}
