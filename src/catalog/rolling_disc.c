/* SPDX-License-Identifier: BSD-3-Clause */
/* A thin disc that rolls on a plane in steady motion. Its centre moves on a circle. The axis of the
 * disc is the y axis of the body. Three angles give the orientation of the disc: the heading a
 * about z, the constant elevation b of the axis above the plane, and the spin c about the axis. The
 * mass is m and the radius is R; the moments of inertia are A across the axis and C along it. The
 * component of the angular velocity along the axis is n = c' + a' sin b. The centre has the
 * velocity R n, so the circle has the radius R n / a'. The balance of moments about the centre
 * gives
 *
 *   n a' cos b (C + m R^2) = A a'^2 sin b cos b - m g R sin b
 */
#include <float.h>
#include <math.h>

#include "catalog/catalog.h"
#include "catalog/spatial_parts.h"

enum { MASS, RADIUS, ACROSS, AXIAL, GRAVITY, TILT, TURNING, COUNT };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [MASS] = {"mass", "kg", "of the disc", BAUM_I_POSITIVE},
  [RADIUS] = {"radius", "m", "of the disc", BAUM_I_POSITIVE},
  [ACROSS] = {"across", "kg m^2", "moment of inertia about a diameter", BAUM_I_POSITIVE},
  [AXIAL] = {"axial", "kg m^2", "moment of inertia about the axis", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
  [TILT] = {"tilt", "rad", "angle of the axis above the plane, between -pi/2 and pi/2",
            BAUM_I_ACUTE},
  [TURNING] = {"turning", "rad/s", "angular velocity of the heading, not 0", BAUM_I_NONZERO},
};

/* Returns n. Sets `sum` to the sum of the magnitudes of the terms of n, because rounding errors are
 * proportional to this sum. */
static double axial_rate(const double *p, double *sum)
{
  double turning = p[TURNING];
  double gyration = p[ACROSS] * turning * turning * sin(p[TILT]);
  double weight = p[MASS] * p[GRAVITY] * p[RADIUS] * tan(p[TILT]);
  double scale = turning * (p[AXIAL] + p[MASS] * p[RADIUS] * p[RADIUS]);
  *sum = (fabs(gyration) + fabs(weight)) / fabs(scale);
  return (gyration - weight) / scale;
}

static double solution(const double *p, double t, double *q, double *v)
{
  double sum = 0.0;
  v[0] = p[TURNING];
  v[1] = axial_rate(p, &sum) - p[TURNING] * sin(p[TILT]);
  q[0] = v[0] * t;
  q[1] = v[1] * t;
  double angles = (fabs(v[0]) + sum) * (1.0 + fabs(t));
  double centre = p[RADIUS] * sum * (1.0 + 1.0 / fabs(v[0])) * (1.0 + fabs(q[0]));
  return DBL_EPSILON * (angles + centre);
}

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  (void)body;
  double sum = 0.0;
  double circle = p[RADIUS] * axial_rate(p, &sum) / p[TURNING];
  const double centre[3] = {circle * sin(q[0]), -circle * cos(q[0]), p[RADIUS] * cos(p[TILT])};
  const double rate[3] = {circle * cos(q[0]) * v[0], circle * sin(q[0]) * v[0], 0.0};
  baum_i_axes at = baum_i_axes_at(centre, rate);
  baum_i_axes_turn(&at, 2, q[0], v[0]);
  baum_i_axes_turn(&at, 0, p[TILT], 0.0);
  baum_i_axes_turn(&at, 1, q[1], v[1]);
  return baum_i_axes_state(&at);
}

static void build(baum_i_parts *parts, const double *p)
{
  const double inertia[3] = {p[ACROSS], p[AXIAL], p[ACROSS]};
  double q[2];
  double v[2];
  (void)solution(p, 0.0, q, v);
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  baum_spatial_rolling_disc_def contact = baum_spatial_rolling_disc_def_default();
  contact.name = "contact";
  contact.body_b = baum_i_parts_spatial_body(parts, "disc", p[MASS], inertia, state(p, q, v, 0));
  for (int i = 0; i < 3; i++) {
    contact.normal[i] = i == 2;
    contact.axis_b[i] = i == 1;
  }
  contact.radius = p[RADIUS];
  BAUM_I_UNLESS_FAILED(parts,
                       baum_mechanism_add_spatial_rolling_disc(parts->mechanism, &contact, NULL));
}

const baum_i_catalog_mechanism baum_i_rolling_disc = {
  .name = "rolling_disc",
  .title = "thin disc that rolls steadily on a circle",
  .source = "chosen for this catalogue",
  .provenance = "closed form",
  .note = "two constraint rows of velocity level (non-holonomic)",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", 1),
  .defaults = (const double[COUNT]){1.2, 0.5, 0.08, 0.15, 9.81, 0.3, 1.3},
  .end = 10.0,
  BAUM_I_CATALOG_COMPUTED(solution, 21, 2, 13),
};
