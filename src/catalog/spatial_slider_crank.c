/* SPDX-License-Identifier: BSD-3-Clause */
/* A spatial slider-crank. The slider moves on the x axis. The crank rotates about a line parallel
 * to the x axis; the y and z of this line are the parameters `beside` and `above`. Let a be the
 * angle of the crank, (0, y, z) the position of its tip, and (x, 0, 0) the position of the slider.
 * With the lengths l1 of the crank and l2 of the rod, the constraints give
 *
 *   y = beside - l1 sin a,  z = above + l1 cos a,  x = sqrt(l2^2 - y^2 - z^2)
 *
 * One axis of the universal joint between slider and rod is fixed in the slider and parallel to its
 * line of motion. The other axis, which is fixed in the rod, thus stays perpendicular to this line.
 */
#include <math.h>

#include "catalog/catalog.h"
#include "catalog/data/spatial_slider_crank.h"
#include "catalog/spatial_parts.h"

enum {
  CRANK,
  ROD,
  BESIDE,
  ABOVE,
  CRANK_MASS,
  ROD_MASS,
  SLIDER_MASS,
  CRANK_INERTIA,
  ROD_AXIAL,
  ROD_ACROSS,
  SLIDER_INERTIA,
  GRAVITY,
  ANGLE,
  SPEED,
  COUNT
};

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [CRANK] = {"crank", "m", "length of the crank", BAUM_I_POSITIVE},
  [ROD] = {"rod", "m", "length of the rod", BAUM_I_POSITIVE},
  [BESIDE] = {"beside", "m", "y of the crank's axis", BAUM_I_ANY},
  [ABOVE] = {"above", "m", "z of the crank's axis", BAUM_I_ANY},
  [CRANK_MASS] = {"crank_mass", "kg", "of the crank", BAUM_I_POSITIVE},
  [ROD_MASS] = {"rod_mass", "kg", "of the rod", BAUM_I_POSITIVE},
  [SLIDER_MASS] = {"slider_mass", "kg", "of the slider", BAUM_I_POSITIVE},
  [CRANK_INERTIA] = {"crank_inertia", "kg m^2", "of the crank about each axis through its centre",
                     BAUM_I_POSITIVE},
  [ROD_AXIAL] = {"rod_axial", "kg m^2", "axial inertia of the rod", BAUM_I_POSITIVE},
  [ROD_ACROSS] = {"rod_across", "kg m^2", "transverse inertia of the rod", BAUM_I_POSITIVE},
  [SLIDER_INERTIA] = {"slider_inertia", "kg m^2", "of the slider, which does not rotate",
                      BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
  [ANGLE] = {"angle", "rad", "of the crank at start, about x, measured from z", BAUM_I_ANY},
  [SPEED] = {"speed", "rad/s", "of the crank at start", BAUM_I_ANY},
};

static baum_i_axes crank_axes(const double *p, const double *q, const double *v)
{
  const double axis[3] = {0.0, p[BESIDE], p[ABOVE]};
  baum_i_axes crank = baum_i_axes_at(axis, baum_i_zeros);
  baum_i_axes_turn(&crank, 0, q[0], v[0]);
  return crank;
}

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  baum_i_axes at = crank_axes(p, q, v);
  if (body == 0) {
    baum_i_axes_go(&at, 0.0, 0.0, p[CRANK] / 2);
  } else {
    baum_i_axes tip = at;
    baum_i_axes_go(&tip, 0.0, 0.0, p[CRANK]);
    double x = sqrt(p[ROD] * p[ROD] - tip.r[1] * tip.r[1] - tip.r[2] * tip.r[2]);
    const double r[3] = {x, 0.0, 0.0};
    const double rate[3] = {-(tip.r[1] * tip.v[1] + tip.r[2] * tip.v[2]) / x, 0.0, 0.0};
    at = baum_i_axes_at(r, rate);
    if (body == 1) {
      at = baum_i_axes_between(&tip, &at);
      baum_i_axes_go(&at, p[ROD] / 2, 0.0, 0.0);
    }
  }
  return baum_i_axes_state(&at);
}

static void build(baum_i_parts *parts, const double *p)
{
  static const char *const names[3] = {"crank", "rod", "slider"};
  static const double along[3] = {1.0, 0.0, 0.0};
  const double inertia[3][3] = {{p[CRANK_INERTIA], p[CRANK_INERTIA], p[CRANK_INERTIA]},
                                {p[ROD_AXIAL], p[ROD_ACROSS], p[ROD_ACROSS]},
                                {p[SLIDER_INERTIA], p[SLIDER_INERTIA], p[SLIDER_INERTIA]}};
  const baum_i_body_state slider = state(p, &p[ANGLE], &p[SPEED], 2);
  baum_body_id id[3];
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  for (int k = 0; k < 3; k++) {
    id[k] = baum_i_parts_spatial_body(parts, names[k], p[CRANK_MASS + k], inertia[k],
                                      state(p, &p[ANGLE], &p[SPEED], k));
  }
  baum_i_axes pin = crank_axes(p, &p[ANGLE], &p[SPEED]);
  baum_i_axes tip = pin;
  baum_i_axes_go(&tip, 0.0, 0.0, p[CRANK]);
  const double across[3] = {0.0, tip.r[2], -tip.r[1]}; /* perpendicular to the rod and the x axis */
  baum_i_parts_spatial_revolute(parts, "A", (baum_i_place){BAUM_GROUND, id[0], pin.r, along});
  baum_i_parts_spherical(parts, "B", (baum_i_place){id[0], id[1], tip.r, NULL});
  baum_i_parts_universal(parts, "C", (baum_i_place){id[2], id[1], slider.q, along}, across);
  baum_i_parts_prismatic(parts, "guide", (baum_i_place){BAUM_GROUND, id[2], slider.q, along});
}

const baum_i_catalog_mechanism baum_i_spatial_slider_crank = {
  .name = "spatial_slider_crank",
  .title = "spatial slider-crank, the crank released at 6 rad/s",
  .source = "E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems (1989), "
            "section 12.2; IFToMM library of benchmarks; the inertia of the slider, which does not "
            "rotate, was chosen for this catalogue",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 16.3 digits; "
    "a second, independent model in double precision agrees to 13.3 digits",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", 3),
  .defaults = (const double[COUNT]){0.08, 0.3, 0.1, 0.12, 0.12, 0.5, 2.0, 1e-4, 4e-4, 4e-3, 1e-3,
                                    9.81, 0.0, 6.0},
  .end = 5.0,
  BAUM_I_CATALOG_SERIES(SPATIAL_SLIDER_CRANK, 13, 13),
};
