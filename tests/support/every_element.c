/* SPDX-License-Identifier: BSD-3-Clause */
#include "every_element.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "every_element_good.h"

/* ---- user functions ---- */

static const double CIRCLE_RADIUS = 0.3;
static const double CRANK_ANGLE = 0.5;
static const double BLOCK_ANGLE = 0.1; /* angle of all blocks, so that none is horizontal */

int every_element_answer(void *user, double t, double *out)
{
  every_fault *fault = user;
  if (!fault) {
    return 0;
  }
  fault->calls++;
  bool late = fault->from > 0 ? fault->calls >= fault->from : t > fault->after;
  if (!fault->fails || !late) {
    return 0;
  }
  if (fault->answer == 0) {
    out[0] = (double)NAN;
  }
  return fault->answer;
}

/* Keeps the bob on a circle about the slider. q is (x, y, angle) of the slider, then (x, y) of the
 * bob. */
static int circle_phi(double t, const double *q, double *out, void *user)
{
  double x = q[3] - q[0];
  double y = q[4] - q[1];
  out[0] = 0.5 * (x * x + y * y - CIRCLE_RADIUS * CIRCLE_RADIUS);
  return every_element_answer(user, t, out);
}

static int circle_jacobian(double t, const double *q, double *out, void *user)
{
  out[0] = q[0] - q[3];
  out[1] = q[1] - q[4];
  out[3] = q[3] - q[0];
  out[4] = q[4] - q[1];
  return every_element_answer(user, t, out);
}

static int circle_nu(double t, const double *q, double *out, void *user)
{
  (void)q;
  return every_element_answer(user, t, out);
}

static int circle_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)q;
  double x = v[3] - v[0];
  double y = v[4] - v[1];
  out[0] = -(x * x + y * y);
  return every_element_answer(user, t, out);
}

static int masses_mass(double t, const double *q, double *out, void *user)
{
  (void)q;
  out[0] = 2.0;
  out[3] = 1.0;
  return every_element_answer(user, t, out);
}

static int masses_force(double t, const double *q, const double *v, const double *inputs,
                        double *out, void *user)
{
  (void)v;
  (void)inputs;
  out[0] = -8.0 * q[0] + 4.0 * (q[1] - q[0]);
  out[1] = -4.0 * (q[1] - q[0]);
  return every_element_answer(user, t, out);
}

static int masses_potential(double t, const double *q, double *out, void *user)
{
  out[0] = 4.0 * q[0] * q[0] + 2.0 * (q[1] - q[0]) * (q[1] - q[0]);
  return every_element_answer(user, t, out);
}

static int drag_force(double t, const double *q, const double *v, const double *inputs, double *out,
                      void *user)
{
  (void)q;
  (void)inputs;
  out[0] = -0.1 * v[0];
  out[1] = -0.1 * v[1];
  return every_element_answer(user, t, out);
}

static int drag_force_q(double t, const double *q, const double *v, const double *inputs,
                        double *out, void *user)
{
  (void)q;
  (void)v;
  (void)inputs;
  return every_element_answer(user, t, out);
}

static int drag_force_v(double t, const double *q, const double *v, const double *inputs,
                        double *out, void *user)
{
  (void)q;
  (void)v;
  (void)inputs;
  out[0] = -0.1;
  out[3] = -0.1;
  return every_element_answer(user, t, out);
}

/* The position of the bead in the slot of the disc, as a function of the crank's angle. The law has
 * no time argument, so fault->after has no effect on it. */
static int lead_law(double x, double f[3], void *user)
{
  f[0] = 0.05 + 0.02 * sin(x - CRANK_ANGLE);
  f[1] = 0.02 * cos(x - CRANK_ANGLE);
  f[2] = -0.02 * sin(x - CRANK_ANGLE);
  return every_element_answer(user, -(double)INFINITY, f);
}

/* The curve y = 2 x^2 - 0.1. The function has no time argument, so fault->after has no effect on
 * it. */
static int track_curve(const double xy[2], double out[6], void *user)
{
  out[0] = xy[1] + 0.1 - 2.0 * xy[0] * xy[0];
  out[1] = -4.0 * xy[0];
  out[2] = 1.0;
  out[3] = -4.0;
  return every_element_answer(user, -(double)INFINITY, out);
}

/* ---- definitions ---- */

GOOD(planar_body)
{
  (void)parts;
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = "crank";
  def.mass = 0.5;
  def.inertia = 1e-3;
  def.position[0] = 0.05 * cos(CRANK_ANGLE);
  def.position[1] = 0.05 * sin(CRANK_ANGLE);
  def.angle = CRANK_ANGLE;
  return def;
}

GOOD(planar_particle)
{
  (void)parts;
  baum_planar_particle_def def = baum_planar_particle_def_default();
  def.name = "bob";
  def.mass = 0.2;
  def.position[0] = 0.4;
  def.position[1] = -CIRCLE_RADIUS;
  return def;
}

GOOD(coordinates)
{
  static const double q[2] = {0.1, -0.05};
  static const double v[2] = {0.0, (double)NAN};
  static const double scale[2] = {0.2, 0.2};
  baum_coordinates_def def = baum_coordinates_def_default();
  def.name = "masses";
  def.size = 2;
  def.q = q;
  def.v = v;
  def.scale = scale;
  def.mass = masses_mass;
  def.force = masses_force;
  def.potential = masses_potential;
  def.constant_mass = true;
  def.user = parts->fault;
  return def;
}

GOOD(planar_revolute)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  def.name = "pin";
  def.body_a = BAUM_GROUND;
  def.body_b = parts->crank;
  def.point[0] = 0.0;
  def.point[1] = 0.0;
  return def;
}

GOOD(planar_distance)
{
  baum_planar_distance_def def = baum_planar_distance_def_default();
  def.name = "rod";
  def.body_a = parts->crank;
  def.body_b = parts->slider;
  def.point_a[0] = 0.05;
  def.point_a[1] = 0.0;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  return def;
}

GOOD(planar_translational)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.name = "guide";
  def.body_a = BAUM_GROUND;
  def.body_b = parts->slider;
  def.point[0] = 0.4;
  def.point[1] = 0.0;
  return def;
}

GOOD(planar_fixed)
{
  baum_planar_fixed_def def = baum_planar_fixed_def_default();
  def.name = "weld";
  def.body_a = parts->slider;
  def.body_b = parts->tool;
  def.point[0] = 0.45;
  def.point[1] = 0.0;
  return def;
}

GOOD(driver)
{
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = parts->pin;
  def.value = CRANK_ANGLE;
  def.rate = 2.0;
  def.acceleration = 0.3;
  return def;
}

GOOD(user_constraint)
{
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = "circle";
  def.bodies = parts->circle_bodies;
  def.body_count = 2;
  def.row_count = 1;
  def.phi = circle_phi;
  def.jacobian = circle_jacobian;
  def.nu = circle_nu;
  def.gamma = circle_gamma;
  def.user = parts->fault;
  return def;
}

GOOD(planar_spring)
{
  baum_planar_spring_def def = baum_planar_spring_def_default();
  def.name = "spring";
  def.body_a = BAUM_GROUND;
  def.body_b = parts->bob;
  def.point_a[0] = 0.8;
  def.point_a[1] = 0.0;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  def.stiffness = 3.0;
  def.damping = 0.02;
  def.free_length = 0.3;
  return def;
}

GOOD(planar_load)
{
  baum_planar_load_def def = baum_planar_load_def_default();
  def.name = "load";
  def.body = parts->tool;
  def.point[0] = 0.01;
  def.force[0] = -0.5;
  def.torque = 0.1;
  def.input = parts->throttle;
  return def;
}

GOOD(user_force)
{
  baum_user_force_def def = baum_user_force_def_default();
  def.name = "drag";
  def.bodies = parts->drag_bodies;
  def.body_count = 1;
  def.force = drag_force;
  def.force_q = drag_force_q;
  def.force_v = drag_force_v;
  def.user = parts->fault;
  return def;
}

GOOD(planar_torsion_spring)
{
  baum_planar_torsion_spring_def def = baum_planar_torsion_spring_def_default();
  def.name = "twist";
  def.body_a = parts->slider;
  def.body_b = parts->crank;
  def.stiffness = 0.2;
  def.damping = 0.01;
  def.free_angle = 0.3;
  return def;
}

GOOD(planar_pin_in_slot)
{
  baum_planar_pin_in_slot_def def = baum_planar_pin_in_slot_def_default();
  def.name = "slot";
  def.body_a = parts->disc;
  def.body_b = parts->bead;
  def.point_a[0] = 0.1;
  def.point_a[1] = 0.0;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  def.axis[0] = 0.0;
  def.axis[1] = 1.0;
  return def;
}

GOOD(planar_rack_and_pinion)
{
  baum_planar_rack_and_pinion_def def = baum_planar_rack_and_pinion_def_default();
  def.name = "rack";
  def.body_a = parts->bar;
  def.body_b = parts->disc;
  def.point_a[0] = 0.0;
  def.point_a[1] = 0.25;
  def.point_b[0] = 0.0;
  def.point_b[1] = -0.05;
  def.axis[0] = 0.8;
  def.axis[1] = 0.6;
  def.radius = -0.2;
  return def;
}

GOOD(planar_gear)
{
  baum_planar_gear_def def = baum_planar_gear_def_default();
  def.name = "teeth";
  def.body_a = parts->crank;
  def.body_b = parts->disc;
  def.radius_a = 0.05;
  def.radius_b = 0.1;
  return def;
}

GOOD(coupling)
{
  baum_coupling_def def = baum_coupling_def_default();
  def.name = "lead";
  def.joint_a = parts->pin;
  def.joint_b = parts->slot;
  def.law = lead_law;
  def.user = parts->fault;
  return def;
}

GOOD(planar_curve)
{
  baum_planar_curve_def def = baum_planar_curve_def_default();
  def.name = "track";
  def.body_a = parts->bar;
  def.body_b = parts->pea;
  def.point_a[0] = 0.0;
  def.point_a[1] = 0.0;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  def.curve = track_curve;
  def.user = parts->fault;
  return def;
}

GOOD(spline_driver)
{
  static const double times[4] = {0.0, 0.2, 0.5, 1.0};
  static const double values[4] = {0.0, 0.1, -0.2, 0.3};
  baum_spline_driver_def def = baum_spline_driver_def_default();
  def.name = "cam";
  def.joint = parts->hinge;
  def.times = times;
  def.values = values;
  def.count = 4;
  return def;
}

GOOD(planar_knife_edge)
{
  baum_planar_knife_edge_def def = baum_planar_knife_edge_def_default();
  def.name = "blade";
  def.body_a = parts->sled;
  def.point_a[0] = -0.05;
  def.point_a[1] = 0.01;
  def.axis[1] = 0.2;
  return def;
}

/* ---- building ---- */

static baum_status add_block(every_element *parts, const char *name, double x, double y,
                             baum_body_id *id)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = name;
  def.mass = 0.7;
  def.inertia = 2e-3;
  def.position[0] = x;
  def.position[1] = y;
  def.angle = BLOCK_ANGLE;
  return baum_mechanism_add_planar_body(parts->mechanism, &def, id);
}

/* Adds a particle at a point that is given in the axes of a block. */
static baum_status add_bead(every_element *parts, const char *name, const double block[2],
                            const double at[2], baum_body_id *id)
{
  baum_planar_particle_def def = baum_planar_particle_def_default();
  def.name = name;
  def.mass = 0.1;
  def.position[0] = block[0] + cos(BLOCK_ANGLE) * at[0] - sin(BLOCK_ANGLE) * at[1];
  def.position[1] = block[1] + sin(BLOCK_ANGLE) * at[0] + cos(BLOCK_ANGLE) * at[1];
  return baum_mechanism_add_planar_particle(parts->mechanism, &def, id);
}

/* Adds disc, bar, bead and pea, and the joints axle and rail. */
static baum_status add_train(every_element *parts)
{
  baum_planar_revolute_def axle = baum_planar_revolute_def_default();
  baum_planar_translational_def rail = baum_planar_translational_def_default();
  static const double disc[2] = {-0.3, 0.5};
  static const double bar[2] = {-0.6, 0.2};
  baum_status status = add_block(parts, "disc", disc[0], disc[1], &parts->disc);
  if (status == BAUM_OK) {
    status = add_block(parts, "bar", bar[0], bar[1], &parts->bar);
  }
  if (status == BAUM_OK) {
    status = add_bead(parts, "bead", disc, (const double[2]){0.1, 0.05}, &parts->bead);
  }
  if (status == BAUM_OK) {
    status = add_bead(parts, "pea", bar, (const double[2]){0.05, -0.095}, &parts->pea);
  }
  axle.name = "axle";
  axle.body_a = BAUM_GROUND;
  axle.body_b = parts->disc;
  axle.point[0] = -0.3;
  axle.point[1] = 0.45;
  if (status == BAUM_OK) {
    status = baum_mechanism_add_planar_revolute(parts->mechanism, &axle, &parts->axle);
  }
  rail.name = "rail";
  rail.body_a = BAUM_GROUND;
  rail.body_b = parts->bar;
  rail.point[0] = bar[0];
  rail.point[1] = bar[1];
  rail.axis[0] = 0.8;
  rail.axis[1] = 0.6;
  return status == BAUM_OK
           ? baum_mechanism_add_planar_translational(parts->mechanism, &rail, &parts->rail)
           : status;
}

/* Adds the wheel and its hinge. The spline driver moves this hinge. */
static baum_status add_wheel(every_element *parts)
{
  baum_planar_revolute_def hinge = baum_planar_revolute_def_default();
  baum_status status = add_block(parts, "wheel", -0.5, 0.3, &parts->wheel);
  hinge.name = "hinge";
  hinge.body_a = BAUM_GROUND;
  hinge.body_b = parts->wheel;
  hinge.point[0] = -0.55;
  hinge.point[1] = 0.3;
  return status == BAUM_OK
           ? baum_mechanism_add_planar_revolute(parts->mechanism, &hinge, &parts->hinge)
           : status;
}

static baum_status add_kind(every_element *parts, const element_kind *kind)
{
  any_def def;
  any_id id = {0, 0};
  parts->circle_bodies[0] = parts->slider;
  parts->circle_bodies[1] = parts->bob;
  parts->drag_bodies[0] = parts->bob;
  parts->rope_bodies[0] = parts->skate;
  parts->rope_bodies[1] = BAUM_GROUND;
  parts->rope_bodies[2] = parts->drop;
  kind->good(parts, &def);
  baum_status status = kind->add(parts->mechanism, &def, &id);
  if (status == BAUM_OK) {
    memcpy((char *)parts + kind->id, &id, sizeof id);
  }
  return status;
}

/* Indices of kinds that need additional bodies: the first joint of the train (see add_train()), the
 * spline driver, the first kind in space, the knife edge, the rolling disc, the screw, and the
 * curve in space. */
enum {
  EVERY_WITHOUT_TRAIN = 13,
  EVERY_WITHOUT_WHEEL = 18,
  EVERY_WITHOUT_SPACE = 19,
  EVERY_WITHOUT_SLED = 34,
  EVERY_WITHOUT_COIN = 35,
  EVERY_WITHOUT_NUT = 38,
  EVERY_WITHOUT_SKATE = 40
};

/* Adds the bodies that an element of this kind needs, unless they exist. */
static baum_status add_needed_bodies(every_element *parts, int kind)
{
  switch (kind) {
  case EVERY_WITHOUT_TRAIN: return add_train(parts);
  case EVERY_WITHOUT_WHEEL: return add_wheel(parts);
  case EVERY_WITHOUT_SPACE: return every_element_add_spatial_bodies(parts);
  case EVERY_WITHOUT_SLED: return add_block(parts, "sled", 0.9, 0.5, &parts->sled);
  case EVERY_WITHOUT_COIN: return every_element_add_coin(parts);
  case EVERY_WITHOUT_NUT: return every_element_add_nut(parts);
  case EVERY_WITHOUT_SKATE: return every_element_add_skate(parts);
  default: return BAUM_OK;
  }
}

/* Adds an element of each of the first `count` kinds, and the bodies that these elements need. */
static baum_status add_kinds(every_element *parts, int count)
{
  baum_status status = baum_mechanism_set_gravity(parts->mechanism, 0.0, -9.81, 0.0);
  if (status == BAUM_OK) {
    status = baum_mechanism_add_input(parts->mechanism, "throttle", 1.0, &parts->throttle);
  }
  for (int k = 0; k < count && status == BAUM_OK; k++) {
    status = add_needed_bodies(parts, k);
    if (status == BAUM_OK) {
      status = add_kind(parts, &element_kinds[k]);
    }
    if (k == 0 && status == BAUM_OK) {
      status = add_block(parts, "slider", 0.4, 0.0, &parts->slider);
    }
    if (k == 0 && status == BAUM_OK) {
      status = add_block(parts, "tool", 0.45, 0.05, &parts->tool);
    }
  }
  return status;
}

static baum_status build(every_element *parts, int kinds)
{
  every_fault *fault = parts->fault;
  memset(parts, 0, sizeof *parts);
  parts->fault = fault;
  baum_status status = baum_mechanism_create(&parts->mechanism);
  if (status == BAUM_OK) {
    status = add_kinds(parts, kinds);
  }
  if (status != BAUM_OK) {
    baum_mechanism_destroy(parts->mechanism);
    parts->mechanism = NULL;
  }
  return status;
}

baum_status every_element_build(every_element *parts)
{
  return build(parts, ELEMENT_KINDS);
}

static every_element make(every_fault *fault, int kinds)
{
  every_element parts = {.fault = fault};
  assert_int_equal(build(&parts, kinds), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(parts.mechanism), BAUM_OK);
  return parts;
}

every_element every_element_make(every_fault *fault)
{
  return make(fault, ELEMENT_KINDS);
}

every_element every_element_make_planar(void)
{
  return make(NULL, EVERY_WITHOUT_SPACE);
}
