/* SPDX-License-Identifier: BSD-3-Clause */
#include "driven.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"

static const double HALF_PI = 1.5707963267948966;
static const double ROD_MASS = 0.2; /* [kg] */

/* ---- parts ---- */

static baum_mechanism *begin(void)
{
  baum_mechanism *mechanism = create_mechanism();
  return mechanism;
}

/* Adds a rod that begins at the point `from` and has the given length and angle. Its centre of mass
 * is in the middle. */
static baum_body_id add_rod_of(baum_mechanism *mechanism, const char *name, const double from[2],
                               double length, double angle, double inertia)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.name = name;
  def.mass = ROD_MASS;
  def.inertia = inertia;
  def.position[0] = from[0] + 0.5 * length * cos(angle);
  def.position[1] = from[1] + 0.5 * length * sin(angle);
  def.angle = angle;
  check(baum_mechanism_add_planar_body(mechanism, &def, &id));
  return id;
}

static double slender_inertia(double length)
{
  return ROD_MASS * length * length / 12.0;
}

static baum_body_id add_rod(baum_mechanism *mechanism, const char *name, const double from[2],
                            double length, double angle)
{
  return add_rod_of(mechanism, name, from, length, angle, slender_inertia(length));
}

static void add_motor(baum_mechanism *mechanism, baum_joint_id pin, const drive *motor)
{
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = pin;
  if (!motor->law) {
    def.value = motor->angle;
    def.rate = motor->rate;
  }
  def.law = motor->law;
  def.user = motor->user;
  check(baum_mechanism_add_driver(mechanism, &def, NULL));
}

static baum_mechanism *freeze(baum_mechanism *mechanism)
{
  check(baum_mechanism_freeze(mechanism));
  return mechanism;
}

/* ---- slider-crank ---- */

static void add_slider(baum_mechanism *mechanism, baum_body_id rod, const double at[2])
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id slider;
  def.name = "slider";
  def.mass = 0.1;
  def.inertia = 1e-4;
  def.position[0] = at[0];
  def.position[1] = at[1];
  check(baum_mechanism_add_planar_body(mechanism, &def, &slider));
  (void)add_planar_pin(mechanism, "C", rod, slider, at[0], at[1]);
  baum_planar_translational_def guide = baum_planar_translational_def_default();
  guide.name = "guide";
  guide.body_a = BAUM_GROUND;
  guide.body_b = slider;
  guide.point_a[0] = 0.0;
  guide.point_a[1] = at[1];
  guide.point_b[0] = guide.point_b[1] = 0.0;
  check(baum_mechanism_add_planar_translational(mechanism, &guide, NULL));
}

void slider_crank_add(baum_mechanism *mechanism, const slider_crank *data)
{
  const double origin[2] = {0.0, 0.0};
  double angle = data->drive.angle;
  double x[3];
  slider_crank_motion(data, angle, x);
  const double tip[2] = {data->crank * cos(angle), data->crank * sin(angle)};
  const double end[2] = {x[0], data->offset};
  baum_body_id crank = add_rod(mechanism, "crank", origin, data->crank, angle);
  baum_body_id rod =
    add_rod(mechanism, "rod", tip, data->rod, atan2(end[1] - tip[1], end[0] - tip[0]));
  baum_joint_id pin = add_planar_pin(mechanism, "A", BAUM_GROUND, crank, origin[0], origin[1]);
  (void)add_planar_pin(mechanism, "B", crank, rod, tip[0], tip[1]);
  add_slider(mechanism, rod, end);
  add_motor(mechanism, pin, &data->drive);
}

baum_mechanism *slider_crank_make(const slider_crank *data)
{
  baum_mechanism *mechanism = begin();
  slider_crank_add(mechanism, data);
  return freeze(mechanism);
}

/* The position of the slider is x = r cos(angle) + branch D. Here r is the length of the crank, l
 * is the length of the rod, e is the offset, u = r sin(angle) - e, and D = sqrt(l^2 - u^2). */
void slider_crank_motion(const slider_crank *data, double angle, double x[3])
{
  double rate = data->drive.rate;
  double c = data->crank * cos(angle);
  double s = data->crank * sin(angle);
  double u = s - data->offset;
  double u1 = c * rate;
  double u2 = -s * rate * rate;
  double d = sqrt((data->rod - u) * (data->rod + u));
  double d1 = -u * u1 / d;
  double d2 = -(u1 * u1 + u * u2 + d1 * d1) / d;
  x[0] = c + data->branch * d;
  x[1] = -s * rate + data->branch * d1;
  x[2] = -c * rate * rate + data->branch * d2;
}

static double angle_between(double a, double b)
{
  return fabs(remainder(a - b, 4.0 * HALF_PI));
}

double slider_crank_to_lock(const slider_crank *data, double angle)
{
  double nearest = (double)INFINITY;
  for (int side = -1; side <= 1; side += 2) {
    double sine = (data->offset + side * data->rod) / data->crank;
    if (fabs(sine) <= 1.0) {
      double lock = asin(sine);
      nearest = fmin(nearest, angle_between(angle, lock));
      nearest = fmin(nearest, angle_between(angle, 2.0 * HALF_PI - lock));
    }
  }
  return nearest;
}

/* ---- four-bar ---- */

static const double CRANK = 1.0;
static const double COUPLER = 3.0;
static const double ROCKER = 2.5;
static const double FRAME = 2.8;

/* Finds the tip of the crank, and the knee, which is the joint between coupler and rocker. Of the
 * two possible knees, it finds the one above the line from the tip to the rocker's foot. */
static void find_knee(double angle, double tip[2], double knee[2])
{
  tip[0] = CRANK * cos(angle);
  tip[1] = CRANK * sin(angle);
  double dx = FRAME - tip[0];
  double dy = -tip[1];
  double d = hypot(dx, dy);
  double along = (COUPLER * COUPLER + d * d - ROCKER * ROCKER) / (2.0 * d);
  double aside = sqrt(COUPLER * COUPLER - along * along);
  knee[0] = tip[0] + (along * dx - aside * dy) / d;
  knee[1] = tip[1] + (along * dy + aside * dx) / d;
}

double four_bar_rocker(double angle)
{
  double tip[2];
  double knee[2];
  find_knee(angle, tip, knee);
  return atan2(knee[1], knee[0] - FRAME);
}

baum_mechanism *four_bar_make(const drive *motor)
{
  const double origin[2] = {0.0, 0.0};
  const double foot[2] = {FRAME, 0.0};
  double tip[2];
  double knee[2];
  find_knee(motor->angle, tip, knee);
  baum_mechanism *mechanism = begin();
  baum_body_id crank = add_rod(mechanism, "crank", origin, CRANK, motor->angle);
  baum_body_id coupler =
    add_rod(mechanism, "coupler", tip, COUPLER, atan2(knee[1] - tip[1], knee[0] - tip[0]));
  baum_body_id rocker = add_rod(mechanism, "rocker", foot, ROCKER, four_bar_rocker(motor->angle));
  baum_joint_id pin = add_planar_pin(mechanism, "A", BAUM_GROUND, crank, origin[0], origin[1]);
  (void)add_planar_pin(mechanism, "B", crank, coupler, tip[0], tip[1]);
  (void)add_planar_pin(mechanism, "C", coupler, rocker, knee[0], knee[1]);
  (void)add_planar_pin(mechanism, "D", BAUM_GROUND, rocker, foot[0], foot[1]);
  add_motor(mechanism, pin, motor);
  return freeze(mechanism);
}

/* ---- parallelogram ---- */

baum_mechanism *parallelogram_make_of(const drive *motor, double above, double inertia)
{
  static const char *const CRANKS[3] = {"first", "second", "third"};
  static const char *const FEET[3] = {"foot 1", "foot 2", "foot 3"};
  static const char *const HEADS[3] = {"head 1", "head 2", "head 3"};
  baum_mechanism *mechanism = begin();
  const double tip[2] = {cos(motor->angle), sin(motor->angle)};
  baum_body_id coupler = add_rod(mechanism, "coupler", tip, 2.0, 0.0);
  for (int k = 0; k < 3; k++) {
    const double foot[2] = {k, k == 2 ? above : 0.0};
    const double head[2] = {foot[0] + tip[0], foot[1] + tip[1]};
    baum_body_id crank = add_rod_of(mechanism, CRANKS[k], foot, 1.0, motor->angle, inertia);
    baum_joint_id pin = add_planar_pin(mechanism, FEET[k], BAUM_GROUND, crank, foot[0], foot[1]);
    (void)add_planar_pin(mechanism, HEADS[k], crank, coupler, head[0], head[1]);
    if (k == 0) {
      add_motor(mechanism, pin, motor);
    }
  }
  return freeze(mechanism);
}

baum_mechanism *parallelogram_make(const drive *motor)
{
  return parallelogram_make_of(motor, 0.0, slender_inertia(1.0));
}
