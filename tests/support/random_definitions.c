/* SPDX-License-Identifier: BSD-3-Clause */
#include "random_definitions.h"

#include <string.h>

void random_vector(chance *c, double size, double out[3])
{
  for (int i = 0; i < 3; i++) {
    out[i] = chance_number(c, -size, size);
  }
}

void wide_to_double(const wide x[3], double out[3])
{
  for (int i = 0; i < 3; i++) {
    out[i] = (double)x[i];
  }
}

void wide_from_double(const double x[3], wide out[3])
{
  for (int i = 0; i < 3; i++) {
    out[i] = x[i];
  }
}

bool random_turns(const oracle_body *b)
{
  return b->kind != 'p' && b->kind != 'o';
}

bool random_is_planar(const oracle_body *b)
{
  return b->kind == 'b' || b->kind == 'o';
}

static void scaled(chance *c, const wide x[3], double out[3])
{
  double size = chance_below(c, 2) == 0 ? 1.0 : chance_decade(c, 0.1, 10.0);
  for (int i = 0; i < 3; i++) {
    out[i] = size * (double)x[i];
  }
}

/* If the joint is a constant-velocity joint, inclines its axes on body_b in half of all cases. The
 * angle of inclination is below pi / 2. Returns false if the axes stay parallel. */
static bool incline(random_spatial *r, oracle_joint *joint, bool in_ground,
                    baum_spatial_revolute_def *def)
{
  chance *c = &r->chance;
  const oracle_body *b = &r->oracle.bodies[joint->b];
  wide z[3];
  double by[3];
  if (joint->kind != ORACLE_CONSTANT_VELOCITY || chance_below(c, 2) == 0) {
    return false;
  }
  random_vector(c, 0.5, by);
  oracle_axis_to_ground(b, joint->axes[1] + 6, z);
  for (int i = 0; i < 3; i++) {
    z[i] += by[i];
  }
  if (in_ground) {
    scaled(c, z, def->axis_b);
    wide_from_double(def->axis_b, z);
  } else {
    wide s[3];
    oracle_axis_to_body(b, z, s);
    scaled(c, s, def->axis_b);
    wide_from_double(def->axis_b, s);
    oracle_axis_to_ground(b, s, z);
  }
  oracle_incline(&r->oracle, joint, z);
  return true;
}

void random_define_at_point(random_spatial *r, const double point[3], const double axis[3],
                            oracle_joint *joint, baum_spatial_revolute_def *def)
{
  chance *c = &r->chance;
  const oracle_body *b = &r->oracle.bodies[joint->b];
  wide p[3];
  wide z[3];
  wide_from_double(point, p);
  wide_from_double(axis, z);
  oracle_place(&r->oracle, joint, p, p, z);
  memcpy(def->point, point, sizeof def->point);
  scaled(c, z, def->axis);
  if (joint->kind == ORACLE_UNIVERSAL) {
    wide x[3];
    oracle_axis_to_ground(b, joint->axes[1], x);
    scaled(c, x, def->axis_b);
  } else if (!incline(r, joint, true, def) && chance_below(c, 2) == 0) {
    scaled(c, z, def->axis_b);
  }
}

/* Moves a point, which is given in ground axes, so that its coordinates in body axes can be
 * represented exactly in double precision. Library and oracle then use the same point. For a
 * particle, the point becomes the position of the particle. */
static void round_on_body(const oracle_body *body, wide point[3], double out[3])
{
  wide s[3];
  oracle_to_body(body, point, s);
  for (int k = 0; k < 3; k++) {
    out[k] = random_turns(body) ? (double)s[k] : 0.0;
  }
  wide_from_double(out, s);
  oracle_to_ground(body, s, point);
}

void random_define_on_bodies(random_spatial *r, const double point[3], const double axis[3],
                             const double apart[3], oracle_joint *joint,
                             baum_spatial_revolute_def *def)
{
  chance *c = &r->chance;
  const oracle_body *a = &r->oracle.bodies[joint->a];
  const oracle_body *b = &r->oracle.bodies[joint->b];
  wide p[2][3];
  wide z[3];
  wide s[3];
  wide_from_double(point, p[1]);
  round_on_body(b, p[1], def->point_b);
  for (int i = 0; i < 3; i++) {
    p[0][i] = p[1][i] - apart[i];
  }
  round_on_body(a, p[0], def->point_a);
  wide_from_double(axis, z);
  oracle_axis_to_body(a, z, s);
  scaled(c, s, def->axis);
  wide_from_double(def->axis, s);
  oracle_axis_to_ground(a, s, z);
  oracle_place(&r->oracle, joint, p[0], p[1], z);
  if (joint->kind == ORACLE_UNIVERSAL) {
    scaled(c, joint->axes[1], def->axis_b);
  } else if (!incline(r, joint, false, def) && chance_below(c, 2) == 0) {
    scaled(c, joint->axes[1] + 6, def->axis_b);
  }
}
