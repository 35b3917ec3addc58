/* SPDX-License-Identifier: BSD-3-Clause */
/* Chaplygin's sleigh: a body with a blade moves on a plane. The blade is parallel to the x axis of
 * the body, at the distance D behind the centre of mass. The mass of the body is m, and its moment
 * of inertia about the centre of mass is I. The velocity of the blade in its own direction is u,
 * and the angular velocity of the body is w. The equations of motion are
 *
 *   m u' = m D w^2,   (I + m D^2) w' = -m D u w
 *
 * The kinetic energy, and thus m u^2 + (I + m D^2) w^2, is constant. With constants U, W, k and e,
 * and with s = k t + e, the motion is therefore
 *
 *   u = U tanh s,  w = W / cosh s,  k = m D U / (I + m D^2),  U k = D W^2,  angle' = w
 *
 * The angle is (2 W / k) atan(tanh(s / 2)), plus a constant. The path of the blade is the
 * integral of u (cos angle, sin angle). To compute this integral, the time is divided into equal
 * intervals, and Gauss's quadrature uses five points in each of them. The integrand has its
 * singularities at the distance pi / 2 from the real s axis, and each interval has at most the
 * length 0.1 in s. The truncation error of the quadrature is therefore below 1e-17.
 */
#include <float.h>
#include <math.h>

#include "catalog/catalog.h"

enum { MASS, INERTIA, DISTANCE, SPEED, RATE, COUNT };
enum { MOST_INTERVALS = 100000 };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [MASS] = {"mass", "kg", "of the sleigh", BAUM_I_POSITIVE},
  [INERTIA] = {"inertia", "kg m^2", "about the centre of mass", BAUM_I_POSITIVE},
  [DISTANCE] = {"distance", "m", "by which the blade is behind the centre of mass",
                BAUM_I_POSITIVE},
  [SPEED] = {"speed", "m/s", "of the blade at start", BAUM_I_ANY},
  [RATE] = {"rate", "rad/s", "angular velocity at start, not 0", BAUM_I_NONZERO},
};

/* Numbers that do not change during the motion. */
typedef struct motion {
  double U, W, k, e;
} motion;

static motion motion_of(const double *p)
{
  double about_blade = p[INERTIA] + p[MASS] * p[DISTANCE] * p[DISTANCE];
  motion m = {.U = sqrt(p[SPEED] * p[SPEED] + about_blade / p[MASS] * p[RATE] * p[RATE])};
  m.k = p[MASS] * p[DISTANCE] * m.U / about_blade;
  m.W = copysign(sqrt(m.U * m.k / p[DISTANCE]), p[RATE]);
  m.e = asinh(p[SPEED] * m.W / (m.U * p[RATE]));
  return m;
}

static double gudermann(double s)
{
  return 2.0 * atan(tanh(0.5 * s));
}

static double angle_at(const motion *m, double t)
{
  return m->W / m->k * (gudermann(m->k * t + m->e) - gudermann(m->e));
}

/* Adds the path of the blade from `from` to `to` [s]. */
static void add_path(const motion *m, double from, double to, double path[2])
{
  static const double outer[2] = {0.9061798459386640, 0.2369268850561891};
  static const double inner[2] = {0.5384693101056831, 0.4786286704993665};
  const double node[5] = {-outer[0], -inner[0], 0.0, inner[0], outer[0]};
  const double weight[5] = {outer[1], inner[1], 128.0 / 225.0, inner[1], outer[1]};
  double half = 0.5 * (to - from);
  for (int i = 0; i < 5; i++) {
    double t = from + half * (1.0 + node[i]);
    double along = half * weight[i] * m->U * tanh(m->k * t + m->e);
    path[0] += along * cos(angle_at(m, t));
    path[1] += along * sin(angle_at(m, t));
  }
}

static double solution(const double *p, double t, double *q, double *v)
{
  const motion m = motion_of(p);
  double revolving = 1.0 + fabs(m.W / m.k);
  double count = ceil(10.0 * fabs(m.k * t) * revolving) + 1.0;
  if (!(count <= MOST_INTERVALS)) {
    q[0] = q[1] = q[2] = v[0] = v[1] = v[2] = (double)NAN;
    return isnan(count) ? 0.0 : (double)INFINITY;
  }
  double blade[2] = {0.0, 0.0};
  for (int i = 0; i < (int)count; i++) {
    add_path(&m, t * i / count, t * (i + 1) / count, blade);
  }
  double s = m.k * t + m.e;
  double u = m.U * tanh(s);
  q[2] = angle_at(&m, t);
  v[2] = m.W / cosh(s);
  double along[2] = {cos(q[2]), sin(q[2])};
  for (int i = 0; i < 2; i++) {
    double left = i == 0 ? -along[1] : along[0];
    q[i] = blade[i] + p[DISTANCE] * along[i];
    v[i] = u * along[i] + v[2] * p[DISTANCE] * left;
  }
  return DBL_EPSILON * revolving * (1.0 + fabs(m.U * t)) * (1.0 + fabs(s));
}

static void build(baum_i_parts *parts, const double *p)
{
  const baum_i_body_state start = {{p[DISTANCE], 0.0, 0.0},
                                   {p[SPEED], p[RATE] * p[DISTANCE], p[RATE]}};
  baum_planar_knife_edge_def blade = baum_planar_knife_edge_def_default();
  baum_i_parts_gravity(parts, 0.0);
  blade.name = "blade";
  blade.body_a = baum_i_parts_body_at(parts, "sleigh", p[MASS], p[INERTIA], start, BAUM_I_GIVE_ALL);
  blade.point_a[0] = -p[DISTANCE];
  blade.point_a[1] = 0.0;
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_knife_edge(parts->mechanism, &blade, NULL));
}

const baum_i_catalog_mechanism baum_i_chaplygin_sleigh = {
  .name = "chaplygin_sleigh",
  .title = "Chaplygin's sleigh, whose blade does not slip sideways",
  .source = "S. A. Chaplygin (1911)",
  .provenance = "closed form of angle and velocities; quadrature for the path of the blade",
  .note = "one constraint row of velocity level (non-holonomic)",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, NULL, "mmr", 1),
  .defaults = (const double[COUNT]){2.0, 0.15, 0.3, 0.5, 1.3},
  .end = 5.0,
  BAUM_I_CATALOG_COMPUTED(solution, 21, 3, 13),
};
