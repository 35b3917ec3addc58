/* SPDX-License-Identifier: BSD-3-Clause */
/* A Stewart platform: six legs between the ground and a platform. Each leg consists of a lower body
 * on a universal joint and an upper body on a spherical joint, with a prismatic joint between them.
 * The platform has a given motion: the position r(t) of its centre, and the rotations a(t) about z,
 * b(t) about x and c(t) about y. A driver gives each leg the length that this motion requires:
 *
 *   l = |r + Rz(a) Rx(b) Ry(c) B - F|
 *
 * where F is the foot of the leg in ground axes, and B is the centre of the leg's spherical joint
 * in the axes of the platform. */
#include "catalog/stewart.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "catalog/spatial_parts.h"

enum { PLATFORM, LOWER, UPPER, GRAVITY, COUNT };
enum { LEGS = 6, COLUMNS = 6, BODIES = 1 + 2 * LEGS };

static const baum_i_catalog_parameter PARAMETERS[COUNT] = {
  [PLATFORM] = {"platform", "kg", "mass of the platform", BAUM_I_POSITIVE},
  [LOWER] = {"lower", "kg", "mass of the lower body of a leg", BAUM_I_POSITIVE},
  [UPPER] = {"upper", "kg", "mass of the upper body of a leg", BAUM_I_POSITIVE},
  [GRAVITY] = {"gravity", "m/s^2", "along -z", BAUM_I_ANY},
};

/* Directions [rad] of the feet on the ground and of the balls on the platform, leg by leg. */
static const double FOOT[LEGS] = {-0.3, 0.3, 1.7944, 2.3944, 3.8888, 4.4888};
static const double BALL[LEGS] = {-0.7972, 0.7972, 1.2972, 2.8916, 3.3916, 4.986};
static const double FOOT_RADIUS = 1.0; /* [m] */
static const double BALL_RADIUS = 0.6; /* [m] */
static const double MIDDLE = 0.35;     /* [m] from the ends of a leg to the centres of its bodies */

/* The motion of the platform: x, y, z [m] and the angles about z, x, y [rad]. Each is mean +
 * amplitude sin(rate t + phase). */
static const double MOTION[COLUMNS][4] = {
  {0.05, 0.1, 3.0, 0.0}, {-0.1, 0.1, 2.0, 0.0},  {1.0, -0.1, 4.0, 0.0},
  {0.1, 0.2, 2.5, 0.0},  {0.15, -0.2, 3.5, 0.0}, {0.1, 0.1, 3.0, -1.5707963267948966}};
static const int AXIS[3] = {2, 0, 1};

/* Computes a column of the motion and its two derivatives. */
static void move(int column, double t, double s[3])
{
  const double *m = MOTION[column];
  double wave = m[1] * sin(m[2] * t + m[3]);
  s[0] = m[0] + wave;
  s[1] = m[1] * m[2] * cos(m[2] * t + m[3]);
  s[2] = -m[2] * m[2] * wave;
}

/* ---- lengths of the legs ---- */

/* Rotates a moving vector by an angle. The rows of x are the vector and its two derivatives, and s
 * contains the angle and its two derivatives. The rotation is in the plane of the axes i and j. If
 * vectors in this plane are written as complex numbers, the rotation multiplies x by exp(I s),
 * where I^2 = -1. */
static void rotate(const double s[3], int i, int j, double x[3][3])
{
  const double turning[3][2] = {
    {x[0][i], x[0][j]},
    {x[1][i] - s[1] * x[0][j], x[1][j] + s[1] * x[0][i]},
    {x[2][i] - 2 * s[1] * x[1][j] - s[2] * x[0][j] - s[1] * s[1] * x[0][i],
     x[2][j] + 2 * s[1] * x[1][i] + s[2] * x[0][i] - s[1] * s[1] * x[0][j]}};
  for (int k = 0; k < 3; k++) {
    x[k][i] = cos(s[0]) * turning[k][0] - sin(s[0]) * turning[k][1];
    x[k][j] = sin(s[0]) * turning[k][0] + cos(s[0]) * turning[k][1];
  }
}

static double dot(const double *a, const double *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Computes the length of a leg and its two derivatives. */
static void find_length(int leg, double t, double s[3])
{
  double x[3][3] = {{BALL_RADIUS * cos(BALL[leg]), BALL_RADIUS * sin(BALL[leg]), 0.0}};
  const double foot[3] = {FOOT_RADIUS * cos(FOOT[leg]), FOOT_RADIUS * sin(FOOT[leg]), 0.0};
  for (int k = 2; k >= 0; k--) {
    move(3 + k, t, s);
    rotate(s, (AXIS[k] + 1) % 3, (AXIS[k] + 2) % 3, x);
  }
  for (int i = 0; i < 3; i++) {
    move(i, t, s);
    for (int k = 0; k < 3; k++) {
      x[k][i] += s[k] - (k == 0 ? foot[i] : 0.0);
    }
  }
  s[0] = sqrt(dot(x[0], x[0]));
  s[1] = dot(x[0], x[1]) / s[0];
  s[2] = (dot(x[1], x[1]) + dot(x[0], x[2]) - s[1] * s[1]) / s[0];
}

/* The coordinate of a leg is its elongation since the start. */
static int drive(int leg, double t, double s[3])
{
  double start[3];
  find_length(leg, 0.0, start);
  find_length(leg, t, s);
  s[0] -= start[0];
  return 0;
}

BAUM_I_SIX_LAWS(drive)

/* ---- bodies ---- */

static double solution(const double *p, double t, double *q, double *v)
{
  (void)p;
  for (int k = 0; k < COLUMNS; k++) {
    double s[3];
    move(k, t, s);
    q[k] = s[0];
    v[k] = s[1];
  }
  return 4 * DBL_EPSILON * (1.0 + 4.0 * fabs(t));
}

static baum_i_axes platform_axes(const double *q, const double *v)
{
  baum_i_axes at = baum_i_axes_at(q, v);
  for (int k = 0; k < 3; k++) {
    baum_i_axes_turn(&at, AXIS[k], q[3 + k], v[3 + k]);
  }
  return at;
}

/* Finds two sets of axes along a leg. The origins are the foot and the ball of the leg. */
static void find_leg(const double *q, const double *v, int leg, baum_i_axes *foot,
                     baum_i_axes *ball)
{
  const double at[3] = {FOOT_RADIUS * cos(FOOT[leg]), FOOT_RADIUS * sin(FOOT[leg]), 0.0};
  *ball = platform_axes(q, v);
  baum_i_axes_go(ball, BALL_RADIUS * cos(BALL[leg]), BALL_RADIUS * sin(BALL[leg]), 0.0);
  *foot = baum_i_axes_at(at, baum_i_zeros);
  *foot = baum_i_axes_between(foot, ball);
  memcpy(ball->p, foot->p, sizeof ball->p);
  memcpy(ball->w, foot->w, sizeof ball->w);
}

/* The platform is body 0. It is followed by the lower and the upper body of each leg. */
static baum_i_body_state state(const double *p, const double *q, const double *v, int body)
{
  (void)p;
  baum_i_axes foot = platform_axes(q, v);
  if (body > 0) {
    baum_i_axes ball;
    find_leg(q, v, (body - 1) / 2, &foot, &ball);
    foot = body % 2 ? foot : ball;
    baum_i_axes_go(&foot, body % 2 ? MIDDLE : -MIDDLE, 0.0, 0.0);
  }
  return baum_i_axes_state(&foot);
}

/* Adds a leg. Returns its prismatic joint. */
static baum_joint_id add_leg(baum_i_parts *parts, const double *p, baum_body_id platform, int leg)
{
  static const char *const names[LEGS] = {"leg 1", "leg 2", "leg 3", "leg 4", "leg 5", "leg 6"};
  static const double lower_inertia[3] = {0.002, 0.03, 0.03};
  static const double upper_inertia[3] = {0.001, 0.025, 0.025};
  static const double x[3] = {1.0, 0.0, 0.0};
  double q[COLUMNS];
  double v[COLUMNS];
  double along[3];
  double across[3];
  baum_i_axes foot;
  baum_i_axes ball;
  (void)solution(p, 0.0, q, v);
  find_leg(q, v, leg, &foot, &ball);
  baum_i_axes_direction(&foot, 0, along);
  baum_i_axes_direction(&foot, 2, across);
  baum_body_id lower =
    baum_i_parts_spatial_body(parts, NULL, p[LOWER], lower_inertia, state(p, q, v, 1 + 2 * leg));
  baum_body_id upper =
    baum_i_parts_spatial_body(parts, NULL, p[UPPER], upper_inertia, state(p, q, v, 2 + 2 * leg));
  baum_i_parts_universal(parts, NULL, (baum_i_place){BAUM_GROUND, lower, foot.r, x}, across);
  baum_joint_id slide =
    baum_i_parts_prismatic(parts, names[leg], (baum_i_place){lower, upper, foot.r, along});
  baum_i_parts_spherical(parts, NULL, (baum_i_place){upper, platform, ball.r, NULL});
  return slide;
}

void baum_i_stewart_parts(baum_i_parts *parts, const double *p, bool driven)
{
  static const double inertia[3] = {0.2, 0.2, 0.4};
  double q[COLUMNS];
  double v[COLUMNS];
  baum_i_parts_gravity_z(parts, p[GRAVITY]);
  (void)solution(p, 0.0, q, v);
  baum_body_id platform =
    baum_i_parts_spatial_body(parts, "platform", p[PLATFORM], inertia, state(p, q, v, 0));
  for (int leg = 0; leg < LEGS; leg++) {
    baum_joint_id slide = add_leg(parts, p, platform, leg);
    if (driven) {
      baum_i_parts_law(parts, NULL, slide, six_laws[leg]);
    }
  }
}

static void build(baum_i_parts *parts, const double *p)
{
  baum_i_stewart_parts(parts, p, true);
}

const baum_i_catalog_mechanism baum_i_stewart = {
  .name = "stewart",
  .title = "Stewart platform, its six legs driven",
  .source = "chosen for this catalogue",
  .provenance = "closed form",
  .note = "no degrees of freedom; baum_kinematics() can simulate this mechanism, too",
  BAUM_I_CATALOG_MODEL(PARAMETERS, build, state, "mmmqqqq", BODIES),
  .defaults = (const double[COUNT]){5.0, 1.0, 0.8, 9.81},
  .end = 2.0,
  BAUM_I_CATALOG_COMPUTED(solution, 21, COLUMNS, 13),
};
