/* SPDX-License-Identifier: BSD-3-Clause */
/* A crank-rocker four-bar of uniform rods. Crank, coupler and rocker have the lengths a, b, c and
 * the angles th1, th2, th3 from the x axis. The pins of the frame are at (0, 0) and (d, 0), so that
 *
 *   a (cos th1, sin th1) + b (cos th2, sin th2) - c (cos th3, sin th3) - (d, 0) = 0
 */
#include "catalog/catalog.h"

#include <math.h>

#include "catalog/data/four_bar.h"

enum {
  CRANK,
  COUPLER,
  ROCKER,
  FRAME,
  CRANK_MASS,
  COUPLER_MASS,
  ROCKER_MASS,
  GRAVITY,
  ANGLE,
  SPEED,
  COUNT
};

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [CRANK] = {"crank", "m", "length of the crank", BAUM_I_POSITIVE},
  [COUPLER] = {"coupler", "m", "length of the coupler", BAUM_I_POSITIVE},
  [ROCKER] = {"rocker", "m", "length of the rocker", BAUM_I_POSITIVE},
  [FRAME] = {"frame", "m", "distance of the two pins on the ground", BAUM_I_POSITIVE},
  [CRANK_MASS] = {"crank_mass", "kg", "of the crank", BAUM_I_POSITIVE},
  [COUPLER_MASS] = {"coupler_mass", "kg", "of the coupler", BAUM_I_POSITIVE},
  [ROCKER_MASS] = {"rocker_mass", "kg", "of the rocker", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "downwards", BAUM_I_ANY},
  [ANGLE] = {"angle", "rad", "of the crank at start", BAUM_I_ANY},
  [SPEED] = {"speed", "rad/s", "of the crank at start", BAUM_I_ANY},
};

/* Computes positions and velocities of a body from the angles q of crank, coupler and rocker. */
static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  baum_i_mover at = {{body == 2 ? p[FRAME] : 0.0, 0.0}, {0.0, 0.0}};
  if (body == 1) {
    baum_i_mover_go(&at, q[0], v[0], p[CRANK], 0.0);
  }
  baum_i_mover_go(&at, q[body], v[body], p[CRANK + body] / 2, 0.0);
  return baum_i_mover_state(&at, q[body], v[body]);
}

static void build(baum_i_parts *parts, const double *p)
{
  static const char *const names[3] = {"crank", "coupler", "rocker"};
  const double origin[2] = {0.0, 0.0};
  const double far[2] = {p[FRAME], 0.0};
  const double tip[2] = {p[CRANK] * cos(p[ANGLE]), p[CRANK] * sin(p[ANGLE])};
  double joint[2];
  baum_i_meet(tip, p[COUPLER], far, p[ROCKER], 1.0, joint);
  const double *const ends[3][2] = {{origin, tip}, {tip, joint}, {far, joint}};
  baum_body_id id[3];
  baum_i_parts_gravity(parts, p[GRAVITY]);
  for (int k = 0; k < 3; k++) {
    const double *from = ends[k][0];
    const double *to = ends[k][1];
    double length = p[CRANK + k];
    double angle = k == 0 ? p[ANGLE] : atan2(to[1] - from[1], to[0] - from[0]);
    const baum_i_body_state at = {{(from[0] + to[0]) / 2, (from[1] + to[1]) / 2, angle},
                                  {[2] = p[SPEED]}};
    id[k] = baum_i_parts_body_at(parts, names[k], p[CRANK_MASS + k],
                                 p[CRANK_MASS + k] * length * length / 12, at,
                                 k == 0 ? BAUM_I_GIVE_ROTATION : BAUM_I_GIVE_NONE);
  }
  baum_i_parts_hinge(parts, "A", BAUM_GROUND, 0.0, id[0], -p[CRANK] / 2);
  baum_i_parts_hinge(parts, "B", id[0], p[CRANK] / 2, id[1], -p[COUPLER] / 2);
  baum_i_parts_hinge(parts, "C", id[1], p[COUPLER] / 2, id[2], p[ROCKER] / 2);
  baum_i_parts_hinge(parts, "D", BAUM_GROUND, p[FRAME], id[2], -p[ROCKER] / 2);
}

const baum_i_catalog_mechanism baum_i_four_bar = {
  .name = "four_bar",
  .title = "four-bar, a crank-rocker of uniform rods under gravity (Grashof)",
  .source = "chosen for this catalogue",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 17 digits; "
    "a second, independent model in double precision agrees to 12.4 digits",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmr", 3),
  .defaults = (const double[COUNT]){1.0, 3.0, 2.5, 2.8, 1.0, 2.0, 1.5, 9.81, 1.0, 2.0},
  .end = 5.0,
  BAUM_I_CATALOG_STORED(FOUR_BAR, 15),
};
