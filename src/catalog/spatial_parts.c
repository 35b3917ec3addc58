/* SPDX-License-Identifier: BSD-3-Clause */
#include "catalog/spatial_parts.h"

#include <math.h>
#include <string.h>

/* ---- moving axes ---- */

const double baum_i_zeros[3] = {0.0, 0.0, 0.0};

/* Computes the product of two quaternions, in Hamilton's convention. */
static void multiply(const double a[4], const double b[4], double out[4])
{
  out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3;
    int k = (i + 2) % 3;
    out[i + 1] = a[0] * b[i + 1] + a[i + 1] * b[0] + a[j + 1] * b[k + 1] - a[k + 1] * b[j + 1];
  }
}

/* Rotates the vector s by the quaternion p. The result is p s p^-1. */
static void turn_vector(const double p[4], const double s[3], double out[3])
{
  const double pure[4] = {0.0, s[0], s[1], s[2]};
  const double back[4] = {p[0], -p[1], -p[2], -p[3]};
  double half[4];
  double whole[4];
  multiply(p, pure, half);
  multiply(half, back, whole);
  memcpy(out, whole + 1, 3 * sizeof *out);
}

baum_i_axes baum_i_axes_at(const double r[3], const double v[3])
{
  return (baum_i_axes){.r = {r[0], r[1], r[2]}, .v = {v[0], v[1], v[2]}, .p = {1.0, 0.0, 0.0, 0.0}};
}

void baum_i_axes_turn(baum_i_axes *axes, int axis, double angle, double rate)
{
  double turn[4] = {cos(0.5 * angle), 0.0, 0.0, 0.0};
  double back[4] = {turn[0], 0.0, 0.0, 0.0};
  double before[4];
  double w[3];
  turn[axis + 1] = sin(0.5 * angle);
  back[axis + 1] = -turn[axis + 1];
  memcpy(before, axes->p, sizeof before);
  multiply(before, turn, axes->p);
  turn_vector(back, axes->w, w);
  memcpy(axes->w, w, sizeof w);
  axes->w[axis] += rate;
}

void baum_i_axes_go(baum_i_axes *axes, double x, double y, double z)
{
  const double s[3] = {x, y, z};
  const double *w = axes->w;
  const double swept[3] = {w[1] * z - w[2] * y, w[2] * x - w[0] * z, w[0] * y - w[1] * x};
  double to[3];
  double rate[3];
  turn_vector(axes->p, s, to);
  turn_vector(axes->p, swept, rate);
  for (int i = 0; i < 3; i++) {
    axes->r[i] += to[i];
    axes->v[i] += rate[i];
  }
}

/* Finds axes whose x axis points from `origin` to `end`. If the vector from `origin` to `end` is
 * (x, y, z), these axes are rotated about x by psi = atan2(z, y), and then about z by gamma =
 * atan2(hypot(y, z), x). */
baum_i_axes baum_i_axes_between(const baum_i_axes *origin, const baum_i_axes *end)
{
  double d[3];
  double rate[3];
  for (int i = 0; i < 3; i++) {
    d[i] = end->r[i] - origin->r[i];
    rate[i] = end->v[i] - origin->v[i];
  }
  double aside = hypot(d[1], d[2]);
  double aside_rate = (d[1] * rate[1] + d[2] * rate[2]) / aside;
  double square = d[0] * d[0] + aside * aside;
  baum_i_axes axes = baum_i_axes_at(origin->r, origin->v);
  baum_i_axes_turn(&axes, 0, atan2(d[2], d[1]),
                   (d[1] * rate[2] - d[2] * rate[1]) / (aside * aside));
  baum_i_axes_turn(&axes, 2, atan2(aside, d[0]), (d[0] * aside_rate - aside * rate[0]) / square);
  return axes;
}

void baum_i_axes_direction(const baum_i_axes *axes, int axis, double out[3])
{
  const double unit[3] = {axis == 0, axis == 1, axis == 2};
  turn_vector(axes->p, unit, out);
}

baum_i_body_state baum_i_axes_state(const baum_i_axes *axes)
{
  baum_i_body_state out = {{0.0}, {0.0}};
  memcpy(out.q, axes->r, sizeof axes->r);
  memcpy(out.q + 3, axes->p, sizeof axes->p);
  memcpy(out.v, axes->v, sizeof axes->v);
  memcpy(out.v + 3, axes->w, sizeof axes->w);
  return out;
}

/* ---- parts ---- */

void baum_i_parts_gravity_z(baum_i_parts *parts, double downwards)
{
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_set_gravity(parts->mechanism, 0.0, 0.0, -downwards));
}

baum_body_id baum_i_parts_spatial_body(baum_i_parts *parts, const char *name, double mass,
                                       const double inertia[3], baum_i_body_state at)
{
  baum_body_id id = {0};
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.name = name;
  def.mass = mass;
  memcpy(def.inertia, inertia, 3 * sizeof *inertia);
  memcpy(def.position, at.q, sizeof def.position);
  memcpy(def.orientation, at.q + 3, sizeof def.orientation);
  memcpy(def.velocity, at.v, sizeof def.velocity);
  memcpy(def.angular_velocity, at.v + 3, sizeof def.angular_velocity);
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_spatial_body(parts->mechanism, &def, &id));
  return id;
}

/* Sets the fields with which the definitions of all joints begin. */
#define PLACE(def, name_, place)                           \
  do {                                                     \
    (def).name = (name_);                                  \
    (def).body_a = (place).a;                              \
    (def).body_b = (place).b;                              \
    memcpy((def).point, (place).point, sizeof(def).point); \
  } while (0)

baum_joint_id baum_i_parts_spatial_revolute(baum_i_parts *parts, const char *name,
                                            baum_i_place place)
{
  baum_joint_id id = {0};
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  PLACE(def, name, place);
  memcpy(def.axis, place.axis, sizeof def.axis);
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_spatial_revolute(parts->mechanism, &def, &id));
  return id;
}

void baum_i_parts_spherical(baum_i_parts *parts, const char *name, baum_i_place place)
{
  baum_spatial_spherical_def def = baum_spatial_spherical_def_default();
  PLACE(def, name, place);
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_spatial_spherical(parts->mechanism, &def, NULL));
}

baum_joint_id baum_i_parts_prismatic(baum_i_parts *parts, const char *name, baum_i_place place)
{
  baum_joint_id id = {0};
  baum_spatial_prismatic_def def = baum_spatial_prismatic_def_default();
  PLACE(def, name, place);
  memcpy(def.axis, place.axis, sizeof def.axis);
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_spatial_prismatic(parts->mechanism, &def, &id));
  return id;
}

void baum_i_parts_universal(baum_i_parts *parts, const char *name, baum_i_place place,
                            const double axis_b[3])
{
  baum_spatial_universal_def def = baum_spatial_universal_def_default();
  PLACE(def, name, place);
  memcpy(def.axis, place.axis, sizeof def.axis);
  memcpy(def.axis_b, axis_b, sizeof def.axis_b);
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_spatial_universal(parts->mechanism, &def, NULL));
}
