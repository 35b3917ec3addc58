/* SPDX-License-Identifier: BSD-3-Clause */
#include "spatial_scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/rotation.h"
#include "check.h"
#include "construct.h"
#include "tilt.h"

/* ---- a four-bar ---- */

static const double PINS[4][2] = {{0.0, 0.0}, {0.3, 0.4}, {1.1, 0.9}, {1.4, 0.0}};

static void link_place(int k, double place[3])
{
  const double *a = PINS[k];
  const double *b = PINS[k + 1];
  place[0] = 0.5 * (a[0] + b[0]);
  place[1] = 0.5 * (a[1] + b[1]);
  place[2] = atan2(b[1] - a[1], b[0] - a[0]);
}

void spatial_build_planar_four_bar(baum_mechanism *m)
{
  baum_body_id last = BAUM_GROUND;
  for (int k = 0; k < 4; k++) {
    baum_body_id next = BAUM_GROUND;
    if (k < 3) {
      baum_planar_body_def def = baum_planar_body_def_default();
      double place[3];
      link_place(k, place);
      def.mass = 1.0 + k;
      def.inertia = 0.1 * (k + 1);
      memcpy(def.position, place, sizeof def.position);
      def.angle = place[2];
      def.angular_velocity = k == 0 ? 4.0 : (double)NAN;
      check(baum_mechanism_add_planar_body(m, &def, &next));
    }
    baum_planar_revolute_def pin = baum_planar_revolute_def_default();
    pin.body_a = last;
    pin.body_b = next;
    memcpy(pin.point, PINS[k], sizeof pin.point);
    check(baum_mechanism_add_planar_revolute(m, &pin, NULL));
    last = next;
  }
}

/* Builds a four-bar in a tilted plane. Its joints are spatial revolute joints. */
void spatial_build_four_bar(baum_mechanism *m)
{
  baum_mechanism *planar = create_mechanism();
  spatial_build_planar_four_bar(planar);
  check(model_tilt_into(planar, m));
  baum_mechanism_destroy(planar);
}

void spatial_translate_four_bar(const double *twin_q, double *q)
{
  for (int k = 0; k < 3; k++) {
    model_tilt_body(twin_q + (ptrdiff_t)3 * k, q + (ptrdiff_t)7 * k);
  }
}

/* ---- a four-bar in space ---- */

/* Adds a rod between two points. Its axial moment of inertia is a hundredth of the transverse
 * one. */
static baum_body_id add_rod(baum_mechanism *m, double mass, const double a[3], const double b[3],
                            double spin)
{
  static const int rows[6] = {0, 1, 2, 0, 0, 1};
  static const int columns[6] = {0, 1, 2, 1, 2, 2};
  baum_body_id id;
  baum_spatial_body_def def = baum_spatial_body_def_default();
  double along[3];
  for (int i = 0; i < 3; i++) {
    along[i] = b[i] - a[i];
    def.position[i] = 0.5 * (a[i] + b[i]);
  }
  double square = baum_i_dot3(along, along);
  def.mass = mass;
  def.angular_velocity[2] = spin;
  for (int i = 0; i < 6; i++) {
    double across = rows[i] == columns[i] ? square : 0.0;
    def.inertia[i] = mass / 12.0 * (across - 0.99 * along[rows[i]] * along[columns[i]]);
  }
  check(baum_mechanism_add_spatial_body(m, &def, &id));
  return id;
}

static void add_hinge(baum_mechanism *m, baum_body_id body, const double point[3], int axis)
{
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = body;
  memcpy(def.point, point, sizeof def.point);
  for (int i = 0; i < 3; i++) {
    def.axis[i] = i == axis;
  }
  check(baum_mechanism_add_spatial_revolute(m, &def, NULL));
}

static void add_ball_joint(baum_mechanism *m, baum_body_id a, baum_body_id b, const double point[3])
{
  baum_spatial_spherical_def def = baum_spatial_spherical_def_default();
  def.body_a = a;
  def.body_b = b;
  memcpy(def.point, point, sizeof def.point);
  check(baum_mechanism_add_spatial_spherical(m, &def, NULL));
}

void spatial_build_rssr(baum_mechanism *m)
{
  static const double shaft[3] = {0.0, 0.0, 0.0};
  static const double pivot[3] = {0.2, 0.3, 0.05};
  static const double a[3] = {0.1, 0.0, 0.0};
  static const double b[3] = {0.2, 0.333, -0.198};
  baum_body_id crank = add_rod(m, 0.3, shaft, a, 12.0);
  baum_body_id coupler = add_rod(m, 0.5, a, b, (double)NAN);
  baum_body_id rocker = add_rod(m, 0.6, pivot, b, (double)NAN);
  add_hinge(m, crank, shaft, 2);
  add_ball_joint(m, crank, coupler, a);
  add_ball_joint(m, coupler, rocker, b);
  add_hinge(m, rocker, pivot, 0);
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -9.81));
}

baum_mechanism *spatial_make_rssr(void)
{
  baum_mechanism *m = create_mechanism();
  spatial_build_rssr(m);
  check(baum_mechanism_freeze(m));
  return m;
}

/* ---- a screw, geared with a wheel on a spring ---- */

static const double MASS = 2.0;        /* [kg] of the nut */
static const double MOMENT = 0.5;      /* [kg m^2] */
static const double WHEEL = 0.3;       /* [kg m^2] */
static const double PITCH = 0.2;       /* [m/rad] */
static const double RATIO = -1.5;      /* angle of the wheel divided by the angle of the nut */
static const double STIFFNESS = 4.0;   /* [N m/rad] of the spring on the wheel */
static const double FREE_ANGLE = 0.7;  /* [rad] */
static const double COMPRESSION = 9.0; /* [N/m] of the spring along the axis of the screw */
static const double WEIGHT = 6.0;      /* [N] along the axis */
static const double SPEED = 7.0;       /* [rad/s] of the nut at the start */

/* Adds a ball that rotates about the z axis. Its centre is at (x, 0, 0). */
static baum_body_id add_ball(baum_mechanism *m, double mass, double moment, double x, double speed)
{
  baum_body_id id;
  baum_spatial_body_def def = baum_spatial_body_def_default();
  const double inertia[6] = {moment, moment, moment};
  const double spin[3] = {0.0, 0.0, speed};
  def.mass = mass;
  memcpy(def.inertia, inertia, sizeof inertia);
  memcpy(def.angular_velocity, spin, sizeof spin);
  def.position[0] = x;
  check(baum_mechanism_add_spatial_body(m, &def, &id));
  return id;
}

void spatial_build_screw(baum_mechanism *m)
{
  baum_joint_id sleeve;
  baum_joint_id bearing;
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -WEIGHT / MASS));
  baum_spatial_cylindrical_def axle = baum_spatial_cylindrical_def_default();
  axle.body_a = BAUM_GROUND;
  axle.body_b = add_ball(m, MASS, MOMENT, 0.0, SPEED);
  memset(axle.point, 0, sizeof axle.point);
  check(baum_mechanism_add_spatial_cylindrical(m, &axle, &sleeve));
  baum_spatial_revolute_def hinge = baum_spatial_revolute_def_default();
  hinge.body_a = BAUM_GROUND;
  hinge.body_b = add_ball(m, 1.0, WHEEL, 1.0, RATIO * SPEED);
  memset(hinge.point, 0, sizeof hinge.point);
  hinge.point[0] = 1.0;
  check(baum_mechanism_add_spatial_revolute(m, &hinge, &bearing));

  baum_coupling_def screw = baum_coupling_def_default();
  screw.joint_a = sleeve;
  screw.coordinate_a = BAUM_COORDINATE_ANGLE;
  screw.joint_b = sleeve;
  screw.ratio = PITCH;
  check(baum_mechanism_add_coupling(m, &screw, NULL));
  baum_coupling_def gear = screw;
  gear.joint_b = bearing;
  gear.ratio = RATIO;
  check(baum_mechanism_add_coupling(m, &gear, NULL));

  baum_joint_spring_def spring = baum_joint_spring_def_default();
  spring.joint = bearing;
  spring.stiffness = STIFFNESS;
  spring.free_value = FREE_ANGLE;
  check(baum_mechanism_add_joint_spring(m, &spring, NULL));
  spring.joint = sleeve;
  spring.stiffness = COMPRESSION;
  spring.free_value = (double)NAN;
  check(baum_mechanism_add_joint_spring(m, &spring, NULL));
}

/* The angle a of the nut satisfies moment a'' = -torque - stiffness a. Computes q from the solution
 * of this equation. */
void spatial_solve_screw(double t, double *q)
{
  double moment = MOMENT + MASS * PITCH * PITCH + WHEEL * RATIO * RATIO;
  double stiffness = COMPRESSION * PITCH * PITCH + STIFFNESS * RATIO * RATIO;
  double torque = WEIGHT * PITCH - STIFFNESS * RATIO * FREE_ANGLE;
  double frequency = sqrt(stiffness / moment);
  double middle = -torque / stiffness;
  double angle = middle - middle * cos(frequency * t) + SPEED / frequency * sin(frequency * t);
  const double all[14] = {
    [2] = PITCH * angle, [3] = cos(0.5 * angle),          [6] = sin(0.5 * angle),
    [7] = 1.0,           [10] = cos(0.5 * RATIO * angle), [13] = sin(0.5 * RATIO * angle)};
  memcpy(q, all, sizeof all);
}
