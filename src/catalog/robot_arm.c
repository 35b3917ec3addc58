/* SPDX-License-Identifier: BSD-3-Clause */
/* A robot arm with six revolute joints, about z, y, y, x, y and x. When all angles are 0, the first
 * link points up, and the others are stretched along x. A driver sets the angle of joint k to A_k
 * sin(w_k t), with the amplitude A_k and the angular frequency w_k. */
#include <float.h>
#include <math.h>

#include "catalog/catalog.h"
#include "catalog/spatial_parts.h"

enum { REACH, PAYLOAD, GRAVITY, COUNT };
enum { JOINTS = 6 };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [REACH] = {"reach", "m", "from the second joint to the end of the arm", BAUM_I_POSITIVE},
  [PAYLOAD] = {"payload", "kg", "mass of the last link with its load", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
};

static const int AXIS[JOINTS] = {2, 1, 1, 0, 1, 0};
static const double AMPLITUDE[JOINTS] = {1.5, 0.8, 1.2, 2.0, 1.0, 3.0}; /* [rad] */
static const double RATE[JOINTS] = {2.0, 3.0, 2.5, 4.0, 3.5, 5.0};      /* [rad/s] */
/* Length of each link, divided by the reach. */
static const double SHARE[JOINTS] = {0.4, 0.45, 0.2, 0.2, 0.1, 0.05};
static const double MASS[JOINTS - 1] = {20.0, 12.0, 5.0, 3.0, 1.5}; /* [kg] */

static int drive(int k, double t, double s[3])
{
  s[0] = AMPLITUDE[k] * sin(RATE[k] * t);
  s[1] = AMPLITUDE[k] * RATE[k] * cos(RATE[k] * t);
  s[2] = -RATE[k] * RATE[k] * s[0];
  return 0;
}

BAUM_I_SIX_LAWS(drive)

static double solution(const double *p, double t, double *q, double *v)
{
  (void)p;
  for (int k = 0; k < JOINTS; k++) {
    double s[3];
    (void)drive(k, t, s);
    q[k] = s[0];
    v[k] = s[1];
  }
  return DBL_EPSILON * (1.0 + RATE[JOINTS - 1] * fabs(t)) * AMPLITUDE[JOINTS - 1];
}

/* Moves the axes by the fraction `part` of a link's length along this link. When all angles are 0,
 * the first link points up, and the others point along x. */
static void go(const double *p, baum_i_axes *axes, int link, double part)
{
  double length = part * SHARE[link] * p[REACH];
  baum_i_axes_go(axes, link == 0 ? 0.0 : length, 0.0, link == 0 ? length : 0.0);
}

static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  baum_i_axes at = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  for (int k = 0; k <= body; k++) {
    baum_i_axes_turn(&at, AXIS[k], q[k], v[k]);
    go(p, &at, k, k < body ? 1.0 : 0.5);
  }
  return baum_i_axes_state(&at);
}

static void build(baum_i_parts *parts, const double *p)
{
  baum_i_axes at = baum_i_axes_at(baum_i_zeros, baum_i_zeros);
  baum_body_id last = BAUM_GROUND;
  double q[JOINTS];
  double v[JOINTS];
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  (void)solution(p, 0.0, q, v);
  for (int k = 0; k < JOINTS; k++) {
    double mass = k < JOINTS - 1 ? MASS[k] : p[PAYLOAD];
    double length = SHARE[k] * p[REACH];
    /* Each link is a cylinder whose length is five times its radius. */
    double axial = mass * length * length / 50;
    double across = axial / 2 + mass * length * length / 12;
    const double inertia[3] = {k == 0 ? across : axial, across, k == 0 ? axial : across};
    const double axis[3] = {AXIS[k] == 0, AXIS[k] == 1, AXIS[k] == 2};
    baum_body_id next = baum_i_parts_spatial_body(parts, NULL, mass, inertia, state(p, q, v, k));
    baum_joint_id hinge =
      baum_i_parts_spatial_revolute(parts, NULL, (baum_i_place){last, next, at.r, axis});
    baum_i_parts_law(parts, NULL, hinge, six_laws[k]);
    go(p, &at, k, 1.0);
    last = next;
  }
}

const baum_i_catalog_mechanism baum_i_robot_arm = {
  .name = "robot_arm",
  .title = "robot arm of six revolute joints, all driven",
  .source = "chosen for this catalogue",
  .provenance = "closed form",
  .note = "no degrees of freedom; baum_kinematics() can simulate this mechanism, too",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", JOINTS),
  .defaults = (const double[COUNT]){1.0, 2.5, 9.81},
  .end = 2.0,
  BAUM_I_CATALOG_COMPUTED(solution, 21, JOINTS, 13),
};
