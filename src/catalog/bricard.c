/* SPDX-License-Identifier: BSD-3-Clause */
/* Bricard's mechanism has five rods along the edges of a cube and six revolute joints. The axes of
 * consecutive joints are perpendicular. The first five joints have the angles a, b, a, b, a. The
 * angle b follows from a by the equation
 *
 *   sin a + sin b + sin a sin b = 0
 *
 * One of the 30 constraint rows is redundant in every configuration.
 */
#include <math.h>

#include "catalog/catalog.h"
#include "catalog/data/bricard.h"
#include "catalog/spatial_parts.h"

enum { LENGTH, MASS, AXIAL, GRAVITY, ANGLE, SPEED, COUNT };
enum { RODS = 5 };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [LENGTH] = {"length", "m", "of each rod", BAUM_I_POSITIVE},
  [MASS] = {"mass", "kg", "of each rod", BAUM_I_POSITIVE},
  [AXIAL] = {"axial", "-", "axial inertia of a rod divided by its transverse inertia", BAUM_I_ANY},
  [GRAVITY] = {"gravity", "m/s^2", "along -y", BAUM_I_ANY},
  [ANGLE] = {"angle", "rad", "of the first rod at start, about y; 0 to pi", BAUM_I_ANY},
  [SPEED] = {"speed", "rad/s", "of the first rod at start", BAUM_I_ANY},
};

/* EDGE is the direction of each rod, and AXIS the number of the axis of each joint (0: x, 1: y, 2:
 * z). Both refer to the axes of the rods, which are parallel to the ground axes when all angles are
 * 0. */
static const double EDGE[RODS][3] = {
  {1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
static const int AXIS[RODS + 1] = {1, 2, 0, 1, 2, 0};

/* Computes axes that are fixed in a rod. Their origin is at the first joint of the rod. */
static baum_i_axes axes_of(const double *p, const double *q, const double *v, int rod)
{
  double b = asin(-sin(q[0]) / (1.0 + sin(q[0])));
  double rate = -cos(q[0]) * (1.0 + sin(b)) / (cos(b) * (1.0 + sin(q[0]))) * v[0];
  baum_i_axes at = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  for (int k = 0; k <= rod; k++) {
    if (k > 0) {
      const double *e = EDGE[k - 1];
      baum_i_axes_go(&at, p[LENGTH] * e[0], p[LENGTH] * e[1], p[LENGTH] * e[2]);
    }
    baum_i_axes_turn(&at, AXIS[k], k % 2 ? b : q[0], k % 2 ? rate : v[0]);
  }
  return at;
}

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  double half = p[LENGTH] / 2;
  baum_i_axes at = axes_of(p, q, v, body);
  baum_i_axes_go(&at, half * EDGE[body][0], half * EDGE[body][1], half * EDGE[body][2]);
  return baum_i_axes_state(&at);
}

static void build(baum_i_parts *parts, const double *p)
{
  double across = p[MASS] * p[LENGTH] * p[LENGTH] / 12;
  baum_body_id last = BAUM_GROUND;
  baum_i_parts_gravity(parts, p[GRAVITY]);
  for (int k = 0; k <= RODS; k++) {
    baum_i_axes at = axes_of(p, &p[ANGLE], &p[SPEED], k < RODS ? k : RODS - 1);
    baum_body_id next = BAUM_GROUND;
    baum_i_axes pin = at;
    if (k < RODS) {
      double inertia[3];
      for (int i = 0; i < 3; i++) {
        inertia[i] = across * (EDGE[k][i] == 0.0 ? 1.0 : p[AXIAL]);
      }
      next =
        baum_i_parts_spatial_body(parts, NULL, p[MASS], inertia, state(p, &p[ANGLE], &p[SPEED], k));
    } else {
      baum_i_axes_go(&pin, p[LENGTH] * EDGE[k - 1][0], p[LENGTH] * EDGE[k - 1][1],
                     p[LENGTH] * EDGE[k - 1][2]);
    }
    double axis[3];
    baum_i_axes_direction(&pin, AXIS[k], axis);
    baum_i_parts_spatial_revolute(parts, NULL, (baum_i_place){last, next, pin.r, axis});
    last = next;
  }
}

const baum_i_catalog_mechanism baum_i_bricard = {
  .name = "bricard",
  .title = "Bricard's mechanism of slender rods, released from rest",
  .source = "IFToMM and A Coruna library of benchmarks, A04",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 17.1 digits; "
    "a second, independent model in double precision agrees to 9 digits; the library raises the "
    "axial inertia of the rods from 0 to 1e-10 of the transverse inertia, which changes positions "
    "by 7e-11 m",
  .note = "one redundant constraint row",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", RODS),
  .defaults = (const double[COUNT]){1.0, 1.0, 0.0, 9.81, 0.0, 0.0},
  .end = 5.0,
  BAUM_I_CATALOG_SERIES(BRICARD, 10, 10),
};
