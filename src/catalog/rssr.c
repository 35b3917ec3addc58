/* SPDX-License-Identifier: BSD-3-Clause */
/* A spatial four-bar. A driver rotates the crank about z, and the rocker rotates about an axis
 * parallel to x. Let L be the length of the coupler, R the length of the rocker, and d the vector
 * from the end of the crank to the pivot of the rocker. Then the angle b of the rocker, measured
 * from y, satisfies
 *
 *   2 R d_y cos b + 2 R d_z sin b = L^2 - R^2 - d.d
 *
 * One of the two ball joints of the coupler is replaced by a universal joint, which prevents the
 * coupler from spinning about its own axis.
 */
#include <float.h>
#include <math.h>

#include "catalog/catalog.h"
#include "catalog/spatial_parts.h"

enum {
  CRANK,
  COUPLER,
  ROCKER,
  PIVOT_X,
  PIVOT_Y,
  PIVOT_Z,
  CRANK_MASS,
  COUPLER_MASS,
  ROCKER_MASS,
  RADIUS,
  GRAVITY,
  SPEED,
  COUNT
};

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [CRANK] = {"crank", "m", "length of the crank", BAUM_I_POSITIVE},
  [COUPLER] = {"coupler", "m", "length of the coupler", BAUM_I_POSITIVE},
  [ROCKER] = {"rocker", "m", "length of the rocker", BAUM_I_POSITIVE},
  [PIVOT_X] = {"pivot_x", "m", "x of the rocker's pivot", BAUM_I_ANY},
  [PIVOT_Y] = {"pivot_y", "m", "y of the rocker's pivot", BAUM_I_ANY},
  [PIVOT_Z] = {"pivot_z", "m", "z of the rocker's pivot", BAUM_I_ANY},
  [CRANK_MASS] = {"crank_mass", "kg", "of the crank", BAUM_I_POSITIVE},
  [COUPLER_MASS] = {"coupler_mass", "kg", "of the coupler", BAUM_I_POSITIVE},
  [ROCKER_MASS] = {"rocker_mass", "kg", "of the rocker", BAUM_I_POSITIVE},
  [RADIUS] = {"radius", "m", "of the links, which are cylinders", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
  [SPEED] = {"speed", "rad/s", "of the crank", BAUM_I_ANY},
};

/* Finds axes that rotate with the crank, and axes that rotate with the rocker. Their origins are at
 * the ends of crank and rocker. */
static void find_ends(const double *p, const double *q, const double *v, baum_i_axes *crank,
                      baum_i_axes *rocker)
{
  *crank = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  *rocker = baum_i_axes_at(&p[PIVOT_X], baum_i_zeros);
  baum_i_axes_turn(crank, 2, q[0], v[0]);
  baum_i_axes_go(crank, p[CRANK], 0.0, 0.0);
  double square = 0.0;
  double d[3];
  for (int i = 0; i < 3; i++) {
    d[i] = rocker->r[i] - crank->r[i];
    square += d[i] * d[i];
  }
  double c = (p[COUPLER] * p[COUPLER] - square) / (2 * p[ROCKER]) - p[ROCKER] / 2;
  double angle = atan2(d[2], d[1]) - acos(c / hypot(d[1], d[2]));
  const double end[3] = {d[0], d[1] + p[ROCKER] * cos(angle), d[2] + p[ROCKER] * sin(angle)};
  double along = end[0] * crank->v[0] + end[1] * crank->v[1] + end[2] * crank->v[2];
  double across = end[2] * cos(angle) - end[1] * sin(angle);
  baum_i_axes_turn(rocker, 0, angle, along / (p[ROCKER] * across));
  baum_i_axes_go(rocker, 0.0, p[ROCKER], 0.0);
}

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  baum_i_axes crank;
  baum_i_axes rocker;
  find_ends(p, q, v, &crank, &rocker);
  baum_i_axes coupler = baum_i_axes_between(&crank, &rocker);
  baum_i_axes_go(&crank, -p[CRANK] / 2, 0.0, 0.0);
  baum_i_axes_go(&coupler, p[COUPLER] / 2, 0.0, 0.0);
  baum_i_axes_go(&rocker, 0.0, -p[ROCKER] / 2, 0.0);
  const baum_i_axes *const all[3] = {&crank, &coupler, &rocker};
  return baum_i_axes_state(all[body]);
}

static double solution(const double *p, double t, double *q, double *v)
{
  q[0] = p[SPEED] * t;
  v[0] = p[SPEED];
  return DBL_EPSILON * fabs(q[0]);
}

static void build(baum_i_parts *parts, const double *p)
{
  static const char *const names[3] = {"crank", "coupler", "rocker"};
  static const double x[3] = {1.0, 0.0, 0.0};
  static const double z[3] = {0.0, 0.0, 1.0};
  baum_i_axes ends[2];
  baum_body_id id[3];
  find_ends(p, baum_i_zeros, &p[SPEED], &ends[0], &ends[1]);
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  for (int k = 0; k < 3; k++) {
    double mass = p[CRANK_MASS + k];
    double axial = mass * p[RADIUS] * p[RADIUS] / 2;
    double across = axial / 2 + mass * p[CRANK + k] * p[CRANK + k] / 12;
    const double inertia[3] = {k < 2 ? axial : across, k < 2 ? across : axial, across};
    id[k] = baum_i_parts_spatial_body(parts, names[k], mass, inertia,
                                      state(p, baum_i_zeros, &p[SPEED], k));
  }
  const double *b = ends[1].r;
  /* This direction is perpendicular to the coupler and the x axis. */
  const double across[3] = {0.0, ends[0].r[2] - b[2], b[1] - ends[0].r[1]};
  baum_joint_id shaft = baum_i_parts_spatial_revolute(
    parts, "shaft", (baum_i_place){BAUM_GROUND, id[0], baum_i_zeros, z});
  baum_i_parts_spatial_revolute(parts, "pivot", (baum_i_place){BAUM_GROUND, id[2], &p[PIVOT_X], x});
  baum_i_parts_spherical(parts, "A", (baum_i_place){id[0], id[1], ends[0].r, NULL});
  baum_i_parts_universal(parts, "B", (baum_i_place){id[2], id[1], b, x}, across);
  baum_i_parts_motor(parts, shaft, 0.0, p[SPEED]);
}

const baum_i_catalog_mechanism baum_i_rssr = {
  .name = "rssr",
  .title = "spatial four-bar (RSSR), the crank driven",
  .source = "chosen for this catalogue",
  .provenance = "closed form",
  .note = "no degrees of freedom; baum_kinematics() can simulate this mechanism, too",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", 3),
  .defaults = (const double[COUNT]){0.1, 0.4, 0.25, 0.2, 0.3, 0.05, 0.3, 0.5, 0.6, 0.01, 9.81,
                                    12.566370614359172},
  .end = 1.0,
  BAUM_I_CATALOG_COMPUTED(solution, 21, 1, 13),
};
