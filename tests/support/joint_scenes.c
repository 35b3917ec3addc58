/* SPDX-License-Identifier: BSD-3-Clause */
#include "joint_scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"

/* ---- parts ---- */

/* The pose of a body in the design configuration, and its initial angular velocity. This velocity
 * is NaN if it is not given. */
typedef struct placed {
  double x, y, angle, w;
} placed;

static const double FREE = (double)NAN;

static baum_body_id body(baum_mechanism *m, const char *name, placed at)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.name = name;
  def.mass = 1.5;
  def.inertia = 0.02;
  def.position[0] = at.x;
  def.position[1] = at.y;
  def.angle = at.angle;
  def.angular_velocity = at.w;
  check(baum_mechanism_add_planar_body(m, &def, &id));
  return id;
}

static baum_body_id particle(baum_mechanism *m, const char *name, double x, double y)
{
  baum_planar_particle_def def = baum_planar_particle_def_default();
  baum_body_id id;
  def.name = name;
  def.mass = 0.8;
  def.position[0] = x;
  def.position[1] = y;
  check(baum_mechanism_add_planar_particle(m, &def, &id));
  return id;
}

/* Lets body b slide in body a along an axis, which is given in the design configuration. */
static baum_joint_id guide(baum_mechanism *m, baum_body_id a, baum_body_id b, const double at[2],
                           const double axis[2])
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  baum_joint_id id;
  def.body_a = a;
  def.body_b = b;
  for (int i = 0; i < 2; i++) {
    def.point[i] = at[i];
    def.axis[i] = axis[i];
  }
  check(baum_mechanism_add_planar_translational(m, &def, &id));
  return id;
}

static baum_joint_id slot(baum_mechanism *m, baum_body_id a, baum_body_id b, const double at[2],
                          const double axis[2])
{
  baum_planar_pin_in_slot_def def = baum_planar_pin_in_slot_def_default();
  baum_joint_id id;
  def.body_a = a;
  def.body_b = b;
  for (int i = 0; i < 2; i++) {
    def.point[i] = at[i];
    def.axis[i] = axis[i];
  }
  check(baum_mechanism_add_planar_pin_in_slot(m, &def, &id));
  return id;
}

/* ---- scenes ---- */

/* Makes a double pendulum. */
static void revolute(baum_mechanism *m)
{
  baum_body_id upper = body(m, "upper", (placed){0.2, 0.0, 0.0, 1.0});
  baum_body_id lower = body(m, "lower", (placed){0.4, -0.15, -1.5, -2.0});
  (void)add_planar_pin(m, NULL, BAUM_GROUND, upper, 0.0, 0.0);
  (void)add_planar_pin(m, NULL, upper, lower, 0.4, 0.0);
}

/* Makes a block that slides on a swinging beam. */
static void translational(baum_mechanism *m)
{
  const double axis[2] = {cos(0.3), sin(0.3)};
  const double at[2] = {0.3 * axis[0], 0.3 * axis[1]};
  baum_body_id beam = body(m, "beam", (placed){0.1 * axis[0], 0.1 * axis[1], 0.3, 2.0});
  baum_body_id block = body(m, "block", (placed){at[0], at[1], 0.3, FREE});
  (void)add_planar_pin(m, NULL, BAUM_GROUND, beam, 0.0, 0.0);
  (void)guide(m, beam, block, at, axis);
}

/* Makes a plate on a massless rod. */
static void distance(baum_mechanism *m)
{
  baum_body_id plate = body(m, "plate", (placed){0.5, -0.1, 0.0, 1.5});
  baum_planar_distance_def def = baum_planar_distance_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = plate;
  def.point_a[0] = 0.0;
  def.point_a[1] = 0.0;
  def.point_b[0] = -0.1;
  def.point_b[1] = 0.1;
  check(baum_mechanism_add_planar_distance(m, &def, NULL));
}

/* Makes a pendulum of two links that are welded together. */
static void fixed(baum_mechanism *m)
{
  baum_body_id link = body(m, "link", (placed){0.2, 0.0, 0.0, 1.0});
  baum_body_id plate = body(m, "plate", (placed){0.4, 0.1, 0.7, FREE});
  (void)add_planar_pin(m, NULL, BAUM_GROUND, link, 0.0, 0.0);
  baum_planar_fixed_def def = baum_planar_fixed_def_default();
  def.body_a = link;
  def.body_b = plate;
  def.point[0] = 0.35;
  def.point[1] = 0.05;
  check(baum_mechanism_add_planar_fixed(m, &def, NULL));
}

/* Makes a pendulum on a driven crank. */
static void driver(baum_mechanism *m)
{
  baum_body_id crank = body(m, "crank", (placed){0.1, 0.0, 0.0, FREE});
  baum_body_id link = body(m, "link", (placed){0.35, 0.0, 0.0, 1.0});
  baum_driver_def def = baum_driver_def_default();
  def.joint = add_planar_pin(m, NULL, BAUM_GROUND, crank, 0.0, 0.0);
  (void)add_planar_pin(m, NULL, crank, link, 0.2, 0.0);
  def.rate = 3.0;
  def.acceleration = 2.0;
  check(baum_mechanism_add_driver(m, &def, NULL));
}

/* Makes a pendulum on a crank. A spline driver swings this crank back and forth. */
static void spline_driver(baum_mechanism *m)
{
  static const double times[5] = {0.0, 0.3, 0.7, 1.2, 1.5};
  static const double angles[5] = {0.0, 0.6, -0.5, 0.2, 0.0};
  baum_body_id crank = body(m, "crank", (placed){0.1, 0.0, 0.0, FREE});
  baum_body_id link = body(m, "link", (placed){0.35, 0.0, 0.0, 1.0});
  baum_spline_driver_def def = baum_spline_driver_def_default();
  def.joint = add_planar_pin(m, NULL, BAUM_GROUND, crank, 0.0, 0.0);
  (void)add_planar_pin(m, NULL, crank, link, 0.2, 0.0);
  def.times = times;
  def.values = angles;
  def.count = 5;
  def.periodic = true;
  check(baum_mechanism_add_spline_driver(m, &def, NULL));
}

/* The wire y = 2 x^2. */
static int parabola(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[1] - 2.0 * q[0] * q[0];
  return 0;
}

static int parabola_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = -4.0 * q[0];
  out[1] = 1.0;
  return 0;
}

/* Makes a bead on the wire y = 2 x^2. */
static void user_constraint(baum_mechanism *m)
{
  baum_body_id bead = particle(m, "bead", -0.3, 0.18);
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.bodies = &bead;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = parabola;
  def.jacobian = parabola_jacobian;
  check(baum_mechanism_add_user_constraint(m, &def, NULL));
}

static int across_the_blade(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = -sin(q[2]);
  out[1] = cos(q[2]);
  out[2] = -0.15;
  return 0;
}

/* A sleigh whose blade is behind its centre of mass slides down a slope and draws a pinned arm. */
static void velocity_level(baum_mechanism *m)
{
  baum_body_id sleigh = body(m, "sleigh", (placed){0.0, 0.0, 0.3, 2.0});
  baum_body_id arm = body(m, "arm", (placed){-0.5, 0.2, 0.0, FREE});
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.bodies = &sleigh;
  def.body_count = 1;
  def.row_count = 1;
  def.velocity_level = true;
  def.jacobian = across_the_blade;
  check(baum_mechanism_add_user_constraint(m, &def, NULL));
  add_planar_pin(m, NULL, sleigh, arm, -0.2, 0.0);
}

/* Makes a quick-return mechanism, in which the pin of a crank slides in the slot of a swinging
 * arm. */
static void pin_in_slot(baum_mechanism *m)
{
  const double at[2] = {0.1, 0.0};
  const double axis[2] = {0.1, 0.3};
  baum_body_id crank = body(m, "crank", (placed){0.05, 0.0, 0.0, 4.0});
  baum_body_id arm = body(m, "arm", (placed){0.07, -0.09, 1.2, FREE});
  (void)add_planar_pin(m, NULL, BAUM_GROUND, crank, 0.0, 0.0);
  (void)add_planar_pin(m, NULL, BAUM_GROUND, arm, 0.0, -0.3);
  (void)slot(m, arm, crank, at, axis);
}

/* Makes a particle that a driver moves along a swinging slot. */
static void driver_in_slot(baum_mechanism *m)
{
  const double at[2] = {0.3, 0.0};
  const double axis[2] = {1.0, 0.0};
  baum_body_id arm = body(m, "arm", (placed){0.1, 0.0, 0.0, 1.0});
  baum_body_id ball = particle(m, "ball", at[0], at[1]);
  (void)add_planar_pin(m, NULL, BAUM_GROUND, arm, 0.0, 0.0);
  baum_driver_def def = baum_driver_def_default();
  def.joint = slot(m, arm, ball, at, axis);
  def.rate = 0.4;
  def.acceleration = -1.0;
  check(baum_mechanism_add_driver(m, &def, NULL));
}

/* Makes a pinion above a sliding rack. The centre of mass of the pinion is off its axis. */
static void rack_and_pinion(baum_mechanism *m)
{
  const double at[2] = {0.0, 0.0};
  const double axis[2] = {1.0, 0.0};
  baum_body_id rack = body(m, "rack", (placed){0.0, 0.0, 0.0, FREE});
  baum_body_id pinion = body(m, "pinion", (placed){0.05, 0.1, 0.0, 3.0});
  (void)guide(m, BAUM_GROUND, rack, at, axis);
  (void)add_planar_pin(m, NULL, BAUM_GROUND, pinion, 0.0, 0.1);
  baum_planar_rack_and_pinion_def def = baum_planar_rack_and_pinion_def_default();
  def.body_a = rack;
  def.body_b = pinion;
  def.point[0] = 0.0;
  def.point[1] = 0.1;
  def.radius = -0.1;
  check(baum_mechanism_add_planar_rack_and_pinion(m, &def, NULL));
}

/* Makes a pinion that rolls down a sloping rack. Its centre moves in a slot parallel to the
 * rack. */
static void rolling(baum_mechanism *m)
{
  const double at[2] = {0.1, 0.2};
  const double axis[2] = {0.8, -0.6};
  baum_body_id wheel = body(m, "wheel", (placed){at[0], at[1], 0.0, FREE});
  (void)slot(m, BAUM_GROUND, wheel, at, axis);
  baum_planar_rack_and_pinion_def def = baum_planar_rack_and_pinion_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = wheel;
  for (int i = 0; i < 2; i++) {
    def.point[i] = at[i];
    def.axis[i] = axis[i];
  }
  def.radius = -0.15;
  check(baum_mechanism_add_planar_rack_and_pinion(m, &def, NULL));
}

/* Makes a sun gear and a planet gear on an arm. The centres of mass of all three bodies are off
 * their axes. */
static void gear(baum_mechanism *m)
{
  baum_body_id sun = body(m, "sun", (placed){0.05, 0.0, 0.0, 4.0});
  baum_body_id arm = body(m, "arm", (placed){0.1, 0.0, 0.0, 1.0});
  baum_body_id planet = body(m, "planet", (placed){0.25, 0.04, 0.0, FREE});
  (void)add_planar_pin(m, NULL, BAUM_GROUND, sun, 0.0, 0.0);
  (void)add_planar_pin(m, NULL, BAUM_GROUND, arm, 0.0, 0.0);
  (void)add_planar_pin(m, NULL, arm, planet, 0.25, 0.0);
  baum_planar_gear_def def = baum_planar_gear_def_default();
  def.body_a = sun;
  def.body_b = planet;
  def.carrier = arm;
  def.radius_a = 0.1;
  def.radius_b = 0.15;
  check(baum_mechanism_add_planar_gear(m, &def, NULL));
}

/* Adds a crank and a weight that slides vertically. Returns a definition that couples them. */
static baum_coupling_def crank_and_weight(baum_mechanism *m)
{
  const double at[2] = {0.3, 0.0};
  const double axis[2] = {0.0, 1.0};
  baum_body_id crank = body(m, "crank", (placed){0.1, 0.0, 0.0, 3.0});
  baum_body_id weight = body(m, "weight", (placed){0.3, 0.0, 0.0, FREE});
  baum_coupling_def def = baum_coupling_def_default();
  def.joint_a = add_planar_pin(m, NULL, BAUM_GROUND, crank, 0.0, 0.0);
  def.joint_b = guide(m, BAUM_GROUND, weight, at, axis);
  return def;
}

/* Makes a weight on a rope, which winds on a drum. */
static void coupling(baum_mechanism *m)
{
  baum_coupling_def def = crank_and_weight(m);
  def.ratio = 0.08;
  check(baum_mechanism_add_coupling(m, &def, NULL));
}

static int lift(double x, double f[3], void *user)
{
  const double *height = user;
  f[0] = *height * (1.0 - cos(2.0 * x));
  f[1] = *height * 2.0 * sin(2.0 * x);
  f[2] = *height * 4.0 * cos(2.0 * x);
  return 0;
}

/* Makes a weight that is lifted by a cam with two lobes. */
static void cam(baum_mechanism *m)
{
  static double height = 0.03;
  baum_coupling_def def = crank_and_weight(m);
  def.law = lift;
  def.user = &height;
  check(baum_mechanism_add_coupling(m, &def, NULL));
}

/* The ellipse ((x / 0.2)^2 + (y / 0.1)^2 - 1) / 20 = 0. The gradient at points of the ellipse has a
 * length between 0.5 and 1. */
static int ellipse(const double xy[2], double out[6], void *user)
{
  (void)user;
  out[0] = 1.25 * xy[0] * xy[0] + 5.0 * xy[1] * xy[1] - 0.05;
  out[1] = 2.5 * xy[0];
  out[2] = 10.0 * xy[1];
  out[3] = 2.5;
  out[5] = 10.0;
  return 0;
}

/* Makes a particle on an elliptic track, which is part of a swinging body. */
static void curve(baum_mechanism *m)
{
  baum_body_id track = body(m, "track", (placed){0.0, -0.2, 0.0, 1.0});
  baum_body_id ball = particle(m, "ball", 0.2, -0.2);
  (void)add_planar_pin(m, NULL, BAUM_GROUND, track, 0.0, 0.0);
  baum_planar_curve_def def = baum_planar_curve_def_default();
  def.body_a = track;
  def.body_b = ball;
  for (int i = 0; i < 2; i++) {
    def.point_a[i] = 0.0;
    def.point_b[i] = 0.0;
  }
  def.curve = ellipse;
  check(baum_mechanism_add_planar_curve(m, &def, NULL));
}

static void load_joint(baum_mechanism *m, baum_joint_id joint, double effort, baum_input_id input)
{
  baum_joint_load_def def = baum_joint_load_def_default();
  def.joint = joint;
  def.effort = effort;
  def.input = input;
  check(baum_mechanism_add_joint_load(m, &def, NULL));
}

/* Makes a block that slides on a swinging beam. Loads act on the angle of the beam and on the
 * displacement of the block. */
static void joint_load(baum_mechanism *m)
{
  const baum_input_id none = {0, 0};
  baum_input_id throttle;
  translational(m);
  check(baum_mechanism_add_input(m, "throttle", -1.5, &throttle));
  load_joint(m, baum_mechanism_joint_at(m, 0), 2.0, throttle);
  load_joint(m, baum_mechanism_joint_at(m, 1), 3.0, none);
}

const joint_scene joint_scenes[JOINT_SCENES] = {
  {"revolute", revolute, 2, true, false},
  {"translational", translational, 2, true, false},
  {"distance", distance, 2, true, false},
  {"fixed", fixed, 1, true, false},
  {"driver", driver, 1, false, false},
  {"user constraint", user_constraint, 1, true, false},
  {"pin in a slot", pin_in_slot, 1, true, false},
  {"driver in a slot", driver_in_slot, 1, false, false},
  {"rack and pinion", rack_and_pinion, 1, true, false},
  {"rolling", rolling, 1, true, false},
  {"gear", gear, 2, true, false},
  {"coupling", coupling, 1, true, false},
  {"coupling by a law", cam, 1, true, false},
  {"point on a curve", curve, 2, true, false},
  {"spline driver", spline_driver, 1, false, false},
  {"user constraint of velocity level", velocity_level, 3, true, true},
  {"joint load", joint_load, 2, false, false},
};

baum_mechanism *joint_scene_make(const joint_scene *scene)
{
  baum_mechanism *mechanism = create_mechanism();
  scene->build(mechanism);
  check(baum_mechanism_freeze(mechanism));
  return mechanism;
}
