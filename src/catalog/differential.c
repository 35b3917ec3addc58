/* SPDX-License-Identifier: BSD-3-Clause */
/* A gear differential. The carrier and two wheels rotate about x. A bevel gear, the spider, rotates
 * on the carrier about an axis that is perpendicular to x, and engages with both wheels. Let s be
 * the angle of the carrier, and d half the difference of the angles of the wheels. The wheels then
 * have the angles s + d and s - d. The spider rotates relative to the carrier by the angle r d,
 * where r is the number of teeth of a wheel divided by that of the spider. A torque T acts on the
 * carrier, the loads L1 and L2 act on the wheels, and each wheel has a damper with the coefficient
 * c. The kinetic energy is (A s'^2 + B d'^2) / 2, so
 *
 *   A s'' = T + L1 + L2 - 2 c s',   B d'' = L1 - L2 - 2 c d'
 *   A = I_carrier + m e^2 + I_spider / 2 + 2 I_wheel,   B = 2 I_wheel + r^2 I_spider
 *
 * In these formulas, m is the mass of the spider, and e is its distance from the x axis. The spider
 * is a thin disc.
 */
#include <float.h>
#include <math.h>

#include "catalog/catalog.h"
#include "catalog/spatial_parts.h"

enum {
  CARRIER_INERTIA,
  WHEEL_INERTIA,
  SPIDER_INERTIA,
  SPIDER_MASS,
  SPIDER_AWAY,
  WHEEL_TEETH,
  SPIDER_TEETH,
  TORQUE,
  LEFT_LOAD,
  RIGHT_LOAD,
  DAMPING,
  SPEED,
  COUNT
};
enum { CARRIER, LEFT, RIGHT, SPIDER, BODIES };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [CARRIER_INERTIA] = {"carrier", "kg m^2", "moment of inertia of the carrier", BAUM_I_POSITIVE},
  [WHEEL_INERTIA] = {"wheel", "kg m^2", "moment of inertia of a wheel", BAUM_I_POSITIVE},
  [SPIDER_INERTIA] = {"spider", "kg m^2", "moment of inertia of the spider", BAUM_I_POSITIVE},
  [SPIDER_MASS] = {"spider_mass", "kg", "of the spider", BAUM_I_POSITIVE},
  [SPIDER_AWAY] = {"spider_away", "m", "distance of the spider from the x axis", BAUM_I_ANY},
  [WHEEL_TEETH] = {"wheel_teeth", "-", "number of teeth of the gear of a wheel", BAUM_I_WHOLE},
  [SPIDER_TEETH] = {"spider_teeth", "-", "number of teeth of the spider", BAUM_I_WHOLE},
  [TORQUE] = {"torque", "N m", "on the carrier", BAUM_I_ANY},
  [LEFT_LOAD] = {"left_load", "N m", "torque on the left wheel", BAUM_I_ANY},
  [RIGHT_LOAD] = {"right_load", "N m", "torque on the right wheel", BAUM_I_ANY},
  [DAMPING] = {"damping", "N m s/rad", "of each wheel", BAUM_I_POSITIVE},
  [SPEED] = {"speed", "rad/s", "of carrier and wheels at start", BAUM_I_ANY},
};

/* Solves inertia x'' = torque - 2 damping x', x(0) = 0, x'(0) = start. Adds the magnitudes of all
 * terms to `sum`, because rounding errors are proportional to this sum. */
static double spin_up(double inertia, double torque, double damping, double start, double t,
                      double *rate, double *sum)
{
  double decay = 2 * damping / inertia;
  double last = torque / (2 * damping);
  double lag = (start - last) * expm1(-decay * t) / decay;
  *rate = last + (start - last) * exp(-decay * t);
  *sum += fabs(last) + fabs(last * t) + fabs(lag);
  return last * t - lag;
}

static double ratio_of(const double *p)
{
  return p[WHEEL_TEETH] / p[SPIDER_TEETH];
}

static double solution(const double *p, double t, double *q, double *v)
{
  double whole = p[CARRIER_INERTIA] + p[SPIDER_MASS] * p[SPIDER_AWAY] * p[SPIDER_AWAY] +
                 p[SPIDER_INERTIA] / 2 + 2 * p[WHEEL_INERTIA];
  double apart = 2 * p[WHEEL_INERTIA] + ratio_of(p) * ratio_of(p) * p[SPIDER_INERTIA];
  double both = p[LEFT_LOAD] + p[RIGHT_LOAD];
  double sums[2] = {0.0, 0.0};
  q[0] = spin_up(whole, p[TORQUE] + both, p[DAMPING], p[SPEED], t, &v[0], &sums[0]);
  q[1] = spin_up(apart, p[LEFT_LOAD] - p[RIGHT_LOAD], p[DAMPING], 0.0, t, &v[1], &sums[1]);
  return 2 * DBL_EPSILON * (sums[0] + (1.0 + ratio_of(p)) * sums[1]);
}

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  double side = body == LEFT ? 1.0 : body == RIGHT ? -1.0 : 0.0;
  baum_i_axes at = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  baum_i_axes_turn(&at, 0, q[0] + side * q[1], v[0] + side * v[1]);
  baum_i_axes_go(&at, -side * 0.7, 0.0, body == SPIDER ? p[SPIDER_AWAY] : 0.0);
  if (body == SPIDER) {
    baum_i_axes_turn(&at, 2, ratio_of(p) * q[1], ratio_of(p) * v[1]);
  }
  return baum_i_axes_state(&at);
}

static void add_gears(baum_i_parts *parts, baum_joint_id wheel, baum_joint_id spider, double ratio)
{
  baum_coupling_def gears = baum_coupling_def_default();
  gears.joint_a = wheel;
  gears.joint_b = spider;
  gears.ratio = ratio;
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_coupling(parts->mechanism, &gears, NULL));
}

static void add_torque(baum_i_parts *parts, baum_body_id body, double torque, double damping)
{
  baum_spatial_load_def load = baum_spatial_load_def_default();
  load.body = body;
  load.moment[0] = torque;
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_spatial_load(parts->mechanism, &load, NULL));
  baum_spatial_torsion_spring_def damper = baum_spatial_torsion_spring_def_default();
  damper.body_a = BAUM_GROUND;
  damper.body_b = body;
  for (int i = 0; i < 3; i++) {
    damper.point[i] = 0.0;
    damper.axis[i] = i == 0;
  }
  damper.damping = damping;
  if (damping > 0.0) {
    BAUM_I_UNLESS_FAILED(
      parts, baum_mechanism_add_spatial_torsion_spring(parts->mechanism, &damper, NULL));
  }
}

static void build(baum_i_parts *parts, const double *p)
{
  static const char *const names[BODIES] = {"carrier", "left wheel", "right wheel", "spider"};
  static const char *const joints[BODIES] = {"bearing", "left shaft", "right shaft", "pin"};
  static const double x[3] = {1.0, 0.0, 0.0};
  static const double z[3] = {0.0, 0.0, 1.0};
  const double mass[BODIES] = {5.0, 10.0, 10.0, p[SPIDER_MASS]};
  const double axial[BODIES] = {p[CARRIER_INERTIA], p[WHEEL_INERTIA], p[WHEEL_INERTIA],
                                p[SPIDER_INERTIA] / 2};
  const double torque[BODIES] = {p[TORQUE], p[LEFT_LOAD], p[RIGHT_LOAD], 0.0};
  const double rates[2] = {p[SPEED], 0.0};
  baum_body_id id[BODIES];
  baum_joint_id joint[BODIES];
  baum_i_parts_gravity_z(parts, 0.0);
  for (int k = 0; k < BODIES; k++) {
    /* The moments of inertia of the wheels and the carrier about y and z do not affect the
     * motion. */
    const double inertia[3] = {axial[k], axial[k], k == SPIDER ? p[SPIDER_INERTIA] : axial[k]};
    id[k] = baum_i_parts_spatial_body(parts, names[k], mass[k], inertia,
                                      state(p, baum_i_zeros, rates, k));
    const baum_i_place place = {k == CARRIER ? BAUM_GROUND : id[CARRIER], id[k], baum_i_zeros,
                                k == SPIDER ? z : x};
    joint[k] = baum_i_parts_spatial_revolute(parts, joints[k], place);
    if (k != SPIDER) {
      add_torque(parts, id[k], torque[k], k == CARRIER ? 0.0 : p[DAMPING]);
    }
  }
  add_gears(parts, joint[LEFT], joint[SPIDER], ratio_of(p));
  add_gears(parts, joint[RIGHT], joint[SPIDER], -ratio_of(p));
}

const baum_i_catalog_mechanism baum_i_differential = {
  .name = "differential",
  .title = "gear differential that drives two wheels with different loads",
  .source = "chosen for this catalogue",
  .provenance = "closed form",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", BODIES),
  .defaults =
    (const double[COUNT]){0.2, 0.6, 0.01, 1.0, 0.08, 24.0, 16.0, 30.0, -8.0, -2.0, 1.5, 4.0},
  .end = 4.0,
  BAUM_I_CATALOG_COMPUTED(solution, 21, 2, 13),
};
