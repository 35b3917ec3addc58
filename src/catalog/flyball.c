/* SPDX-License-Identifier: BSD-3-Clause */
/* Flyball governor. A shaft rotates about z and carries a slider at the height s. Two arms are
 * attached to pins beside the top of the shaft. Each arm is a rod with a ball at its end, and
 * points downwards at the angle b from the horizontal. A spring and a damper connect the slider
 * with the centre of each rod. The rods and the shaft measure 1 m x 0.01 m x 0.01 m, and the slider
 * is a cube with edges of 0.1 m. The density of rods, shaft and slider is 3000 kg/m^3.
 */
#include <math.h>

#include "catalog/catalog.h"
#include "catalog/data/flyball.h"
#include "catalog/data/flyball_stiff.h"
#include "catalog/spatial_parts.h"

enum { BALL, STIFFNESS, DAMPING, GRAVITY, BELOW, SPEED, COUNT };
enum { SHAFT, SLIDER, RIGHT, LEFT, BODIES };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [BALL] = {"ball", "kg", "mass of each ball", BAUM_I_POSITIVE},
  [STIFFNESS] = {"stiffness", "N/m", "of each spring", BAUM_I_POSITIVE},
  [DAMPING] = {"damping", "N s/m", "of each damper", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
  [BELOW] = {"below", "rad", "angle of the arms below the horizontal at start", BAUM_I_ANY},
  [SPEED] = {"speed", "rad/s", "angular velocity of all bodies about z at start", BAUM_I_ANY},
};

static const double PIN = 0.05; /* [m] distance from the axis of the shaft */
static const double TOP = 1.0;  /* [m] height of the pins above the foot of the shaft */
static const double ROD = 0.3;  /* [kg] mass of a rod */
static const double AXIAL = 0.3 * 2e-4 / 12;
static const double ACROSS = 0.3 * (1 + 1e-4) / 12;

/* Returns the distance [m] from the pin to the centre of mass of a rod and its ball together. */
static double reach(const double *p)
{
  return (ROD * 0.5 + p[BALL]) / (ROD + p[BALL]);
}

/* Computes the state of a body from the columns q. These are the angle of the shaft, the height of
 * the slider, and the angle of the arms below the horizontal. */
static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  baum_i_axes at = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  baum_i_axes_turn(&at, 2, q[0], v[0]);
  if (body == SHAFT) {
    baum_i_axes_go(&at, 0.0, 0.0, 0.5);
  } else if (body == SLIDER) {
    baum_i_axes_go(&at, 0.0, 0.0, q[1]);
    at.v[2] += v[1];
  } else {
    double side = body == RIGHT ? 1.0 : -1.0;
    baum_i_axes_go(&at, side * PIN, 0.0, TOP);
    baum_i_axes_turn(&at, 1, body == RIGHT ? q[2] : acos(-1.0) - q[2], side * v[2]);
    baum_i_axes_go(&at, reach(p), 0.0, 0.0);
  }
  return baum_i_axes_state(&at);
}

static void add_arm(baum_i_parts *parts, const double *p, const baum_body_id *id, int side)
{
  static const double y[3] = {0.0, 1.0, 0.0};
  const double pin[3] = {side * PIN, 0.0, TOP};
  baum_body_id arm = id[side > 0 ? RIGHT : LEFT];
  baum_i_parts_spatial_revolute(parts, side > 0 ? "right pin" : "left pin",
                                (baum_i_place){id[SHAFT], arm, pin, y});
  baum_spatial_spring_def spring = baum_spatial_spring_def_default();
  spring.name = side > 0 ? "right spring" : "left spring";
  spring.body_a = id[SLIDER];
  spring.body_b = arm;
  for (int i = 0; i < 3; i++) {
    spring.point_a[i] = i == 0 ? side * PIN : 0.0;
    spring.point_b[i] = i == 0 ? 0.5 - reach(p) : 0.0;
  }
  spring.stiffness = p[STIFFNESS];
  spring.damping = p[DAMPING];
  spring.free_length = 0.5;
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_spatial_spring(parts->mechanism, &spring, NULL));
}

static void build(baum_i_parts *parts, const double *p)
{
  static const char *const names[BODIES] = {"shaft", "slider", "right arm", "left arm"};
  static const double up[3] = {0.0, 0.0, 1.0};
  const double columns[3] = {0.0, 0.5, p[BELOW]};
  const double rates[3] = {p[SPEED], 0.0, 0.0};
  /* The centres of rod and ball are 0.5 m apart. */
  double arm = ACROSS + ROD * p[BALL] / (ROD + p[BALL]) * 0.25;
  const double mass[BODIES] = {ROD, 3.0, ROD + p[BALL], ROD + p[BALL]};
  const double inertia[BODIES][3] = {
    {ACROSS, ACROSS, AXIAL}, {0.005, 0.005, 0.005}, {AXIAL, arm, arm}, {AXIAL, arm, arm}};
  baum_body_id id[BODIES];
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  for (int k = 0; k < BODIES; k++) {
    id[k] =
      baum_i_parts_spatial_body(parts, names[k], mass[k], inertia[k], state(p, columns, rates, k));
  }
  baum_i_parts_spatial_revolute(parts, "foot",
                                (baum_i_place){BAUM_GROUND, id[SHAFT], baum_i_zeros, up});
  baum_i_parts_prismatic(parts, "guide", (baum_i_place){id[SHAFT], id[SLIDER], baum_i_zeros, up});
  add_arm(parts, p, id, 1);
  add_arm(parts, p, id, -1);
}

#define FLYBALL_ENTRY BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", BODIES), .end = 5.0

const baum_i_catalog_mechanism baum_i_flyball = {
  FLYBALL_ENTRY,
  .name = "flyball",
  .title = "flyball governor with soft springs",
  .source = "IFToMM and A Coruna library of benchmarks, A05, with the stiffness, damping and speed "
            "of the flyball example of the program EXUDYN",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 16.2 digits; "
    "a second, independent model in double precision agrees to 12.5 digits",
  .defaults =
    (const double[COUNT]){5.0, 4000.0, 200.0, 9.81, 0.5235987755982989, 1.0053096491487339},
  BAUM_I_CATALOG_STORED(FLYBALL, 14),
};

const baum_i_catalog_mechanism baum_i_flyball_stiff = {
  FLYBALL_ENTRY,
  .name = "flyball_stiff",
  .title = "flyball governor with stiff springs and dampers",
  .source = "IFToMM and A Coruna library of benchmarks, A05",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 14.5 digits",
  .note = "the dampers cause a decay rate of 8100 1/s: explicit methods need short steps",
  .defaults = (const double[COUNT]){5.0, 8e5, 4e4, 9.81, 0.5235987755982989, 6.283185307179586},
  BAUM_I_CATALOG_STORED(FLYBALL_STIFF, 12),
};
