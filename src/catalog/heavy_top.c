/* SPDX-License-Identifier: BSD-3-Clause */
/* A heavy top: a disc on an axis through a fixed point. The axis is the y axis of the body. Three
 * angles give the orientation of the top: the precession a about z, the elevation b of the axis
 * above the horizontal, and the spin c about the axis. A and C are the moments of inertia about the
 * fixed point: A across the axis, and C along it. The component of the angular velocity along the
 * axis is n. The mass is m, and the distance of the centre of mass from the fixed point is l. Then
 *
 *   A a' cos(b)^2 + C n sin b = const,  C n = C (c' + a' sin b) = const
 *   A b'' = -A a'^2 sin b cos b + C n a' cos b - m g l cos b
 */
#include "catalog/data/heavy_top.h"
#include "catalog/catalog.h"
#include "catalog/spatial_parts.h"

enum { MASS, DISTANCE, RADIUS, GRAVITY, SPIN, PRECESSION, COUNT };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [MASS] = {"mass", "kg", "of the top", BAUM_I_POSITIVE},
  [DISTANCE] = {"distance", "m", "of the centre of mass from the fixed point", BAUM_I_POSITIVE},
  [RADIUS] = {"radius", "m", "of the disc", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
  [SPIN] = {"spin", "rad/s", "about the axis at start", BAUM_I_ANY},
  [PRECESSION] = {"precession", "rad/s", "about z at start", BAUM_I_ANY},
};

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  (void)body;
  baum_i_axes at = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  baum_i_axes_turn(&at, 2, q[0], v[0]);
  baum_i_axes_turn(&at, 0, q[1], v[1]);
  baum_i_axes_turn(&at, 1, q[2], v[2]);
  baum_i_axes_go(&at, 0.0, p[DISTANCE], 0.0);
  return baum_i_axes_state(&at);
}

static void build(baum_i_parts *parts, const double *p)
{
  const double rates[3] = {p[PRECESSION], 0.0, p[SPIN]};
  double across = p[MASS] * p[RADIUS] * p[RADIUS] / 4; /* moment of a thin disc about a diameter */
  const double inertia[3] = {across, 2 * across, across};
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  baum_body_id top =
    baum_i_parts_spatial_body(parts, "top", p[MASS], inertia, state(p, baum_i_zeros, rates, 0));
  baum_i_parts_spherical(parts, "tip", (baum_i_place){BAUM_GROUND, top, baum_i_zeros, NULL});
}

const baum_i_catalog_mechanism baum_i_heavy_top = {
  .name = "heavy_top",
  .title = "heavy top, released with its axis level",
  .source = "O. Bruels, A. Cardona, M. Arnold, Mechanism and Machine Theory 48 (2012) 121",
  .provenance =
    "Taylor series, in 30-digit arithmetic, of the equations for the three angles; results "
    "with two tolerances agree to 18.8 digits",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", 1),
  .defaults = (const double[COUNT]){15.0, 1.0, 0.25, 9.81, 150.0, -4.61538},
  .end = 1.0,
  BAUM_I_CATALOG_STORED(HEAVY_TOP, 13),
};
