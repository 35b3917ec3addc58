/* SPDX-License-Identifier: BSD-3-Clause */
/* A gyroscope in two gimbals, in steady precession. The rotation angles are a, b and c: the outer
 * ring rotates by the angle a about z, the inner ring by the angle b about the x axis of the outer
 * ring, and the rotor by the angle c about the y axis of the inner ring. A weight of mass m on the
 * inner ring is at the distance l from the centre, on the axis of the rotor. A and C are the
 * moments of inertia of the rotor across and along its axis. J is the moment of inertia of the
 * inner ring about its z axis, which is normal to the plane of the ring. About x and y, the moment
 * of inertia of the inner ring is J / 2. The component n = c' + a' sin b of the angular velocity of
 * the rotor along its axis is constant. Lagrange's equation for b shows that b is constant if
 *
 *   C n a' = m g l + (A + J / 2 + m l^2) a'^2 sin b
 */
#include <float.h>
#include <math.h>

#include "catalog/catalog.h"
#include "catalog/spatial_parts.h"

enum { ROTOR, AXIAL, ACROSS, OUTER, INNER, WEIGHT, ARM, GRAVITY, TILT, PRECESSION, COUNT };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [ROTOR] = {"rotor", "kg", "mass of the rotor", BAUM_I_POSITIVE},
  [AXIAL] = {"axial", "kg m^2", "moment of inertia of the rotor about its axis", BAUM_I_POSITIVE},
  [ACROSS] = {"across", "kg m^2", "moment of inertia of the rotor about transverse axes",
              BAUM_I_POSITIVE},
  [OUTER] = {"outer", "kg m^2", "moment of inertia of the outer ring about its normal",
             BAUM_I_POSITIVE},
  [INNER] = {"inner", "kg m^2", "moment of inertia of the inner ring about its normal",
             BAUM_I_POSITIVE},
  [WEIGHT] = {"weight", "kg", "on the inner ring", BAUM_I_POSITIVE},
  [ARM] = {"arm", "m", "distance of the weight from the centre", BAUM_I_ANY},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
  [TILT] = {"tilt", "rad", "angle of the rotor's axis above the horizontal", BAUM_I_ANY},
  [PRECESSION] = {"precession", "rad/s", "angular velocity of the outer ring, not 0",
                  BAUM_I_NONZERO},
};

static double solution(const double *p, double t, double *q, double *v)
{
  double across = p[ACROSS] + p[INNER] / 2 + p[WEIGHT] * p[ARM] * p[ARM];
  double weight = p[WEIGHT] * p[GRAVITY] * p[ARM];
  double gyration = across * p[PRECESSION] * p[PRECESSION] * sin(p[TILT]);
  double scale = p[AXIAL] * p[PRECESSION];
  v[0] = p[PRECESSION];
  v[1] = (weight + gyration) / scale - p[PRECESSION] * sin(p[TILT]);
  q[0] = v[0] * t;
  q[1] = v[1] * t;
  /* Rounding errors are proportional to the magnitudes of the terms. */
  double sum = (fabs(weight) + fabs(gyration)) / fabs(scale);
  return DBL_EPSILON * (fabs(v[0]) + sum) * (1.0 + fabs(t));
}

/* Computes axes of the outer ring (0), the inner ring (1) or the rotor (2). Their origin is the
 * centre. */
static baum_i_axes axes_of(const double *p, const double *q, const double *v, int body)
{
  baum_i_axes at = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  baum_i_axes_turn(&at, 2, q[0], v[0]);
  if (body > 0) {
    baum_i_axes_turn(&at, 0, p[TILT], 0.0);
  }
  if (body > 1) {
    baum_i_axes_turn(&at, 1, q[1], v[1]);
  }
  return at;
}

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  baum_i_axes at = axes_of(p, q, v, body);
  baum_i_axes_go(&at, 0.0, body == 1 ? p[ARM] : 0.0, 0.0);
  return baum_i_axes_state(&at);
}

static void build(baum_i_parts *parts, const double *p)
{
  static const char *const names[3] = {"outer ring", "inner ring", "rotor"};
  static const char *const joints[3] = {"post", "trunnion", "axle"};
  static const int axis_of[3] = {2, 0, 1};
  /* the mass of the outer ring does not affect the motion */
  const double mass[3] = {1.0, p[WEIGHT], p[ROTOR]};
  const double inertia[3][3] = {{p[OUTER] / 2, p[OUTER], p[OUTER] / 2},
                                {p[INNER] / 2, p[INNER] / 2, p[INNER]},
                                {p[ACROSS], p[AXIAL], p[ACROSS]}};
  baum_body_id last = BAUM_GROUND;
  double q[2];
  double v[2];
  (void)solution(p, 0.0, q, v);
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  for (int k = 0; k < 3; k++) {
    const baum_i_axes at = axes_of(p, q, v, k);
    double axis[3];
    baum_i_axes_direction(&at, axis_of[k], axis);
    baum_body_id next =
      baum_i_parts_spatial_body(parts, names[k], mass[k], inertia[k], state(p, q, v, k));
    baum_i_parts_spatial_revolute(parts, joints[k], (baum_i_place){last, next, baum_i_zeros, axis});
    last = next;
  }
}

const baum_i_catalog_mechanism baum_i_gimbals = {
  .name = "gimbals",
  .title = "gyroscope in two gimbals, in steady precession",
  .source = "chosen for this catalogue",
  .provenance = "closed form",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", 3),
  .defaults = (const double[COUNT]){1.5, 2e-3, 1.2e-3, 3e-3, 8e-4, 0.3, 0.05, 9.81, 0.4, 2.0},
  .end = 5.0,
  BAUM_I_CATALOG_COMPUTED(solution, 21, 2, 13),
};
