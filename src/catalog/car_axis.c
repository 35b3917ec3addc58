/* SPDX-License-Identifier: BSD-3-Clause */
/* The car axis of the Bari test set (S. Schneider; H. Mazzia, F. Magherini). Its coordinates are
 * the positions of the two ends of the axis, q = (xl, yl, xr, yr). The ends stand on springs. The
 * left spring stands on the ground at (0, 0), and the right one on a moving bump at (xb, yb), with
 * yb = r sin(w t) and xb = sqrt(L^2 - yb^2). L is the length of the axis, and L0 the free length of
 * both springs. With k = eps^2 M / 2 (eps = 0.01, M = 10), the equations are
 *
 *   k xl'' = (L0 - Ll) xl / Ll              + multipliers          Ll = |(xl, yl)|
 *   k yl'' = (L0 - Ll) yl / Ll - k g        + multipliers
 *   k xr'' = (L0 - Lr) (xr - xb) / Lr       + multipliers          Lr = |(xr - xb, yr - yb)|
 *   k yr'' = (L0 - Lr) (yr - yb) / Lr - k g + multipliers
 *   0 = xl xb + yl yb,  0 = (xl - xr)^2 + (yl - yr)^2 - L^2
 */
#include "catalog/catalog.h"

#include <math.h>

#include "catalog/data/car_axis.h"

static const double LENGTH = 1.0;
static const double FREE_LENGTH = 0.5;
static const double MASS = 1e-2 * 1e-2 * 10.0 / 2;
static const double BUMP = 0.1;
static const double FREQUENCY = 10.0;
static const double GRAVITY = 1.0;

static int mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  for (int i = 0; i < 4; i++) {
    out[5 * i] = MASS;
  }
  return 0;
}

static void bump(double t, double b[2])
{
  b[1] = BUMP * sin(FREQUENCY * t);
  b[0] = sqrt(LENGTH * LENGTH - b[1] * b[1]);
}

static void spring(double x, double y, double out[2])
{
  double length = hypot(x, y);
  out[0] = (FREE_LENGTH - length) * x / length;
  out[1] = (FREE_LENGTH - length) * y / length - MASS * GRAVITY;
}

static int force(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  (void)v;
  (void)inputs;
  (void)user;
  double b[2];
  bump(t, b);
  spring(q[0], q[1], out);
  spring(q[2] - b[0], q[3] - b[1], out + 2);
  return 0;
}

static int phi(double t, const double *q, double *out, void *user)
{
  (void)user;
  double b[2];
  bump(t, b);
  double x = q[0] - q[2];
  double y = q[1] - q[3];
  out[0] = q[0] * b[0] + q[1] * b[1];
  out[1] = x * x + y * y - LENGTH * LENGTH;
  return 0;
}

static int jacobian(double t, const double *q, double *out, void *user)
{
  (void)user;
  double b[2];
  bump(t, b);
  out[0] = b[0];
  out[1] = b[1];
  out[4] = 2 * (q[0] - q[2]);
  out[5] = 2 * (q[1] - q[3]);
  out[6] = -out[4];
  out[7] = -out[5];
  return 0;
}

static int nu(double t, const double *q, double *out, void *user)
{
  (void)user;
  double b[2];
  bump(t, b);
  double rate = BUMP * FREQUENCY * cos(FREQUENCY * t);
  out[0] = q[0] * b[1] * rate / b[0] - q[1] * rate;
  return 0;
}

static void build(baum_i_parts *parts, const double *p)
{
  static const double start[4] = {0.0, 0.5, 1.0, 0.5};
  static const double rate[4] = {-0.5, 0.0, -0.5, 0.0};
  (void)p;
  baum_coordinates_def axis = baum_coordinates_def_default();
  axis.name = "axis";
  axis.size = 4;
  axis.q = start;
  axis.v = rate;
  axis.mass = mass;
  axis.constant_mass = true;
  axis.force = force;
  baum_body_id body = {0};
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_coordinates(parts->mechanism, &axis, &body));
  baum_user_constraint_def rows = baum_user_constraint_def_default();
  rows.name = "axis and bump";
  rows.row_count = 2;
  rows.phi = phi;
  rows.jacobian = jacobian;
  rows.nu = nu;
  baum_i_parts_constraint(parts, body, rows);
}

const baum_i_catalog_mechanism baum_i_car_axis = {
  .name = "car_axis",
  .title = "car axis on a moving bump, given by user functions that depend on time",
  .source = "S. Schneider; Bari test set, caraxis (copy in the GitHub repository cran/deTestSet)",
  .provenance =
    "extrapolation in 160-bit arithmetic; results with two tolerances agree to 19 digits; "
    "the published values at 3 s agree to 12 to 14 digits",
  .note = "coordinates xl, yl, xr, yr; multipliers have the opposite sign of those of the source",
  .end = 3.0,
  .build = build,
  .units = "uuuu",
  .bodies = 1,
  BAUM_I_CATALOG_STORED(CAR_AXIS, 15),
};
