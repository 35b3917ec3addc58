/* SPDX-License-Identifier: BSD-3-Clause */
/* The spatial part of the mechanism that has every element. */
#include <math.h>

#include "every_element_good.h"

/* ---- bodies ---- */

static baum_spatial_body_def body_at(const char *name, double x, double y, double z)
{
  static const double inertia[6] = {2e-3, 3e-3, 2.5e-3, 1e-4, -2e-4, 3e-4};
  static const double orientation[4] = {0.5, -0.5, 0.1, 0.7};
  const double position[3] = {x, y, z};
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.name = name;
  def.mass = 0.4;
  memcpy(def.inertia, inertia, sizeof inertia);
  memcpy(def.position, position, sizeof position);
  memcpy(def.orientation, orientation, sizeof orientation);
  return def;
}

GOOD(spatial_body)
{
  (void)parts;
  return body_at("shaft", 0.2, 0.3, 0.1);
}

baum_status every_element_add_spatial_bodies(every_element *parts)
{
  const struct {
    baum_body_id *id;
    baum_spatial_body_def def;
  } bodies[] = {
    {&parts->yoke, body_at("yoke", 0.21, 0.1, 0.1)},
    {&parts->ram, body_at("ram", 0.4, 0.35, 0.15)},
    {&parts->top, body_at("top", 0.21, 0.25, 0.19)},
    {&parts->tube, body_at("tube", -0.2, 0.35, 0.05)},
    {&parts->cap, body_at("cap", -0.18, 0.3, 0.05)},
  };
  baum_status status = BAUM_OK;
  for (size_t k = 0; k < sizeof bodies / sizeof *bodies && status == BAUM_OK; k++) {
    status = baum_mechanism_add_spatial_body(parts->mechanism, &bodies[k].def, bodies[k].id);
  }
  return status;
}

GOOD(spatial_particle)
{
  static const double position[3] = {0.2, 0.05, 0.15};
  (void)parts;
  baum_spatial_particle_def def = baum_spatial_particle_def_default();
  def.name = "ball";
  def.mass = 0.05;
  memcpy(def.position, position, sizeof position);
  return def;
}

/* ---- joints ---- */

#define BETWEEN(DEF, NAME, BODY_A, BODY_B) \
  do {                                     \
    (DEF).name = (NAME);                   \
    (DEF).body_a = (BODY_A);               \
    (DEF).body_b = (BODY_B);               \
  } while (0)

static void set3(double out[3], double x, double y, double z)
{
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

GOOD(spatial_revolute)
{
  baum_spatial_revolute_def def = baum_spatial_revolute_def_default();
  BETWEEN(def, "bearing", BAUM_GROUND, parts->shaft);
  set3(def.point, 0.2, 0.3, 0.1);
  set3(def.axis, 0.1, 1.0, 0.0);
  return def;
}

GOOD(spatial_universal)
{
  baum_spatial_universal_def def = baum_spatial_universal_def_default();
  BETWEEN(def, "cross", parts->shaft, parts->yoke);
  set3(def.point, 0.2, 0.25, 0.1);
  set3(def.axis, 1.0, 0.0, 0.0);
  set3(def.axis_b, 0.0, 0.0, 1.0);
  return def;
}

GOOD(spatial_point_on_plane)
{
  baum_spatial_point_on_plane_def def = baum_spatial_point_on_plane_def_default();
  BETWEEN(def, "shoe", BAUM_GROUND, parts->yoke);
  set3(def.point, 0.2, 0.0, 0.1);
  set3(def.axis, 1.0, 0.0, 0.2);
  return def;
}

GOOD(spatial_prismatic)
{
  baum_spatial_prismatic_def def = baum_spatial_prismatic_def_default();
  BETWEEN(def, "slide", BAUM_GROUND, parts->ram);
  set3(def.point, 0.4, 0.35, 0.15);
  set3(def.axis, 1.0, 0.1, 0.0);
  set3(def.axis_b, 2.0, 0.2, 0.0);
  return def;
}

GOOD(spatial_spherical)
{
  baum_spatial_spherical_def def = baum_spatial_spherical_def_default();
  BETWEEN(def, "socket", parts->shaft, parts->top);
  set3(def.point, 0.2, 0.3, 0.2);
  return def;
}

GOOD(spatial_planar)
{
  baum_spatial_planar_def def = baum_spatial_planar_def_default();
  BETWEEN(def, "table", parts->ram, parts->top);
  set3(def.point, 0.3, 0.35, 0.15);
  set3(def.axis, 0.9, 0.1, 0.3);
  return def;
}

GOOD(spatial_cylindrical)
{
  baum_spatial_cylindrical_def def = baum_spatial_cylindrical_def_default();
  BETWEEN(def, "sleeve", BAUM_GROUND, parts->tube);
  set3(def.point, -0.2, 0.4, 0.05);
  set3(def.axis, 0.1, 0.1, 1.0);
  return def;
}

GOOD(spatial_fixed)
{
  baum_spatial_fixed_def def = baum_spatial_fixed_def_default();
  BETWEEN(def, "clamp", parts->tube, parts->cap);
  set3(def.point, -0.2, 0.35, 0.05);
  return def;
}

GOOD(spatial_point_on_line)
{
  baum_spatial_point_on_line_def def = baum_spatial_point_on_line_def_default();
  BETWEEN(def, "wire", parts->yoke, parts->ball);
  set3(def.point, 0.2, 0.05, 0.15);
  set3(def.axis, 0.1, 1.0, 0.0);
  return def;
}

GOOD(spatial_distance)
{
  baum_spatial_distance_def def = baum_spatial_distance_def_default();
  BETWEEN(def, "strut", parts->cap, parts->ball);
  set3(def.point_a, 0.02, 0.0, 0.01);
  set3(def.point_b, 0.0, 0.0, 0.0);
  return def;
}

/* ---- forces ---- */

GOOD(spatial_spring)
{
  baum_spatial_spring_def def = baum_spatial_spring_def_default();
  BETWEEN(def, "coil", BAUM_GROUND, parts->ball);
  set3(def.point_a, 0.25, 0.45, 0.1);
  set3(def.point_b, 0.0, 0.0, 0.0);
  def.stiffness = 2.0;
  def.damping = 0.01;
  def.free_length = 0.3;
  return def;
}

GOOD(spatial_load)
{
  baum_spatial_load_def def = baum_spatial_load_def_default();
  def.name = "push";
  def.body = parts->cap;
  set3(def.point, 0.01, 0.0, 0.02);
  set3(def.force, 0.0, 0.2, 0.1);
  set3(def.moment, 0.01, 0.0, 0.02);
  def.follows_body = true;
  def.input = parts->throttle;
  return def;
}

GOOD(spatial_torsion_spring)
{
  baum_spatial_torsion_spring_def def = baum_spatial_torsion_spring_def_default();
  BETWEEN(def, "twirl", BAUM_GROUND, parts->top);
  set3(def.point, 0.2, 0.3, 0.2);
  set3(def.axis, 0.2, 0.1, 1.0);
  def.stiffness = 0.02;
  def.damping = 0.001;
  def.free_angle = 0.3;
  return def;
}

GOOD(spatial_bushing)
{
  baum_spatial_bushing_def def = baum_spatial_bushing_def_default();
  BETWEEN(def, "rubber", BAUM_GROUND, parts->cap);
  set3(def.point, -0.18, 0.31, 0.05);
  set3(def.axis, 0.2, 0.1, 1.0);
  for (int i = 0; i < 6; i++) {
    def.stiffness[7 * i] = i < 3 ? 3.0 : 0.02;
    def.damping[7 * i] = i < 3 ? 0.02 : 1e-3;
  }
  def.stiffness[4] = def.stiffness[24] = 0.05;
  return def;
}

GOOD(joint_spring)
{
  baum_joint_spring_def def = baum_joint_spring_def_default();
  def.name = "winding";
  def.joint = parts->sleeve;
  def.coordinate = BAUM_COORDINATE_ANGLE;
  def.stiffness = 0.03;
  def.damping = 0.002;
  def.free_value = 0.4;
  return def;
}

GOOD(joint_load)
{
  baum_joint_load_def def = baum_joint_load_def_default();
  def.name = "thrust";
  def.joint = parts->sleeve;
  def.coordinate = BAUM_COORDINATE_DISPLACEMENT;
  def.effort = 0.1;
  def.input = parts->throttle;
  return def;
}

baum_status every_element_add_coin(every_element *parts)
{
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.name = "coin";
  def.mass = 0.3;
  set3(def.inertia, 1e-3, 1e-3, 2e-3);
  set3(def.position, 1.2, -0.4, 0.3);
  set3(def.angular_velocity, 0.5, 2.0, 3.0);
  return baum_mechanism_add_spatial_body(parts->mechanism, &def, &parts->coin);
}

baum_status every_element_add_nut(every_element *parts)
{
  const baum_spatial_body_def nut = body_at("nut", -0.6, -0.5, 0.2);
  const baum_spatial_body_def spindle = body_at("spindle", -0.6, -0.35, 0.4);
  baum_status status = baum_mechanism_add_spatial_body(parts->mechanism, &nut, &parts->nut);
  return status == BAUM_OK
           ? baum_mechanism_add_spatial_body(parts->mechanism, &spindle, &parts->spindle)
           : status;
}

GOOD(spatial_screw)
{
  baum_spatial_screw_def def = baum_spatial_screw_def_default();
  BETWEEN(def, "thread", BAUM_GROUND, parts->nut);
  set3(def.point, -0.6, -0.52, 0.15);
  set3(def.axis, 0.1, 0.2, 1.0);
  def.pitch = 0.3;
  return def;
}

GOOD(spatial_constant_velocity)
{
  baum_spatial_constant_velocity_def def = baum_spatial_constant_velocity_def_default();
  BETWEEN(def, "ball cage", parts->nut, parts->spindle);
  set3(def.point, -0.6, -0.4, 0.3);
  set3(def.axis, 0.1, 0.2, 1.0);
  set3(def.axis_b, 0.0, 0.6, 1.0);
  return def;
}

GOOD(spatial_rolling_disc)
{
  baum_spatial_rolling_disc_def def = baum_spatial_rolling_disc_def_default();
  def.name = "rolling";
  def.body_b = parts->coin;
  set3(def.point_a, 0.0, -0.5, 0.0);
  def.radius = 0.1;
  def.rim_radius = 0.02;
  return def;
}

/* ---- a drop on a spiral, and a skate ---- */

static const double SPIRAL_RADIUS = 0.2;
static const double SPIRAL_RISE = 0.1; /* [m/rad] */

/* The helix x = r cos(z / c), y = r sin(z / c). */
static int spiral(const double xyz[3], double out[20], void *user)
{
  const double r = SPIRAL_RADIUS, c = SPIRAL_RISE;
  const double x = r * cos(xyz[2] / c), y = r * sin(xyz[2] / c);
  out[0] = xyz[0] - x;
  out[1] = 1.0;
  out[3] = y / c;
  out[9] = x / (c * c);
  out[10] = xyz[1] - y;
  out[12] = 1.0;
  out[13] = -x / c;
  out[19] = y / (c * c);
  return every_element_answer(user, -(double)INFINITY, out);
}

baum_status every_element_add_skate(every_element *parts)
{
  baum_spatial_particle_def drop = baum_spatial_particle_def_default();
  drop.name = "drop";
  drop.mass = 0.1;
  set3(drop.position, 1.5 + SPIRAL_RADIUS, 0.2, 0.0);
  const baum_spatial_body_def skate = body_at("skate", 1.6, -0.3, 0.2);
  baum_status status = baum_mechanism_add_spatial_particle(parts->mechanism, &drop, &parts->drop);
  return status == BAUM_OK
           ? baum_mechanism_add_spatial_body(parts->mechanism, &skate, &parts->skate)
           : status;
}

GOOD(spatial_curve)
{
  baum_spatial_curve_def def = baum_spatial_curve_def_default();
  BETWEEN(def, "spiral", BAUM_GROUND, parts->drop);
  set3(def.point_a, 1.5, 0.2, 0.0);
  set3(def.point_b, 0.0, 0.0, 0.0);
  def.curve = spiral;
  def.user = parts->fault;
  return def;
}

GOOD(spatial_knife_edge)
{
  baum_spatial_knife_edge_def def = baum_spatial_knife_edge_def_default();
  def.name = "runner";
  def.body_a = parts->skate;
  set3(def.point_a, 0.02, -0.05, 0.01);
  set3(def.axis, 0.1, 0.2, 1.0);
  return def;
}

GOOD(spatial_cable)
{
  static const double points[9] = {0.02, 0.05, 0.01, 1.5, 0.4, 0.1, 0.0, 0.0, 0.0};
  baum_spatial_cable_def def = baum_spatial_cable_def_default();
  def.name = "rope";
  def.bodies = parts->rope_bodies;
  def.points = points;
  def.point_count = 3;
  def.stiffness = 2.0;
  def.damping = 0.02;
  def.free_length = 0.5;
  return def;
}
