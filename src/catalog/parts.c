/* SPDX-License-Identifier: BSD-3-Clause */
#include "catalog/parts.h"

#include <math.h>
#include <string.h>

void baum_i_mover_go(baum_i_mover *mover, double angle, double rate, double x, double y)
{
  double along = x * cos(angle) - y * sin(angle);
  double up = x * sin(angle) + y * cos(angle);
  mover->r[0] += along;
  mover->r[1] += up;
  mover->v[0] -= rate * up;
  mover->v[1] += rate * along;
}

baum_i_body_state baum_i_mover_state(const baum_i_mover *centre, double angle, double rate)
{
  return (baum_i_body_state){{centre->r[0], centre->r[1], angle},
                             {centre->v[0], centre->v[1], rate}};
}

void baum_i_meet(const double a[2], double ra, const double b[2], double rb, double side,
                 double out[2])
{
  double between = hypot(b[0] - a[0], b[1] - a[1]);
  double c = (b[0] - a[0]) / between;
  double s = (b[1] - a[1]) / between;
  double along = (between * between + ra * ra - rb * rb) / (2 * between);
  double left = side * sqrt(ra * ra - along * along);
  out[0] = a[0] + c * along - s * left;
  out[1] = a[1] + s * along + c * left;
}

baum_i_parts baum_i_parts_begin(void)
{
  baum_i_parts parts = {0};
  parts.status = baum_mechanism_create(&parts.mechanism);
  return parts;
}

void baum_i_parts_gravity(baum_i_parts *parts, double downwards)
{
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_set_gravity(parts->mechanism, 0.0, -downwards, 0.0));
}

baum_body_id baum_i_parts_particle(baum_i_parts *parts, const baum_planar_particle_def *def)
{
  baum_body_id id = {0};
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_particle(parts->mechanism, def, &id));
  return id;
}

baum_body_id baum_i_parts_body(baum_i_parts *parts, const baum_planar_body_def *def)
{
  baum_body_id id = {0};
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_body(parts->mechanism, def, &id));
  return id;
}

baum_body_id baum_i_parts_body_at(baum_i_parts *parts, const char *name, double mass,
                                  double inertia, baum_i_body_state at, baum_i_given given)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = name;
  def.mass = mass;
  def.inertia = inertia;
  memcpy(def.position, at.q, sizeof def.position);
  def.angle = at.q[2];
  if (given == BAUM_I_GIVE_ALL) {
    memcpy(def.velocity, at.v, sizeof def.velocity);
  }
  if (given != BAUM_I_GIVE_NONE) {
    def.angular_velocity = at.v[2];
  }
  def.held = given == BAUM_I_GIVE_ROTATION;
  return baum_i_parts_body(parts, &def);
}

baum_joint_id baum_i_parts_pin(baum_i_parts *parts, const char *name, baum_i_spot a, baum_i_spot b)
{
  baum_joint_id id = {0};
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  def.name = name;
  def.body_a = a.body;
  def.body_b = b.body;
  memcpy(def.point_a, a.point, sizeof def.point_a);
  memcpy(def.point_b, b.point, sizeof def.point_b);
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_revolute(parts->mechanism, &def, &id));
  return id;
}

baum_joint_id baum_i_parts_hinge(baum_i_parts *parts, const char *name, baum_body_id a, double xa,
                                 baum_body_id b, double xb)
{
  return baum_i_parts_pin(parts, name, (baum_i_spot){a, {xa, 0.0}}, (baum_i_spot){b, {xb, 0.0}});
}

void baum_i_parts_guide(baum_i_parts *parts, const char *name, baum_body_id slider, double height,
                        double along)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.name = name;
  def.body_a = BAUM_GROUND;
  def.body_b = slider;
  def.point_a[0] = def.point_b[0] = along;
  def.point_a[1] = height;
  def.point_b[1] = 0.0;
  BAUM_I_UNLESS_FAILED(parts,
                       baum_mechanism_add_planar_translational(parts->mechanism, &def, NULL));
}

void baum_i_parts_rod(baum_i_parts *parts, const char *name, baum_i_spot a, baum_i_spot b,
                      double length)
{
  baum_planar_distance_def def = baum_planar_distance_def_default();
  def.name = name;
  def.body_a = a.body;
  def.body_b = b.body;
  memcpy(def.point_a, a.point, sizeof def.point_a);
  memcpy(def.point_b, b.point, sizeof def.point_b);
  def.length = length;
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_planar_distance(parts->mechanism, &def, NULL));
}

void baum_i_parts_motor(baum_i_parts *parts, baum_joint_id joint, double value, double rate)
{
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = joint;
  def.value = value;
  def.rate = rate;
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_driver(parts->mechanism, &def, NULL));
}

void baum_i_parts_law(baum_i_parts *parts, const char *name, baum_joint_id joint, baum_law_fn *law)
{
  baum_driver_def def = baum_driver_def_default();
  def.name = name;
  def.joint = joint;
  def.law = law;
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_driver(parts->mechanism, &def, NULL));
}

void baum_i_parts_constraint(baum_i_parts *parts, baum_body_id body, baum_user_constraint_def def)
{
  def.bodies = &body;
  def.body_count = 1;
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_add_user_constraint(parts->mechanism, &def, NULL));
}

baum_status baum_i_parts_finish(baum_i_parts *parts, baum_mechanism **out)
{
  BAUM_I_UNLESS_FAILED(parts, baum_mechanism_freeze(parts->mechanism));
  if (parts->status != BAUM_OK) {
    baum_mechanism_destroy(parts->mechanism);
    parts->mechanism = NULL;
  }
  *out = parts->mechanism;
  return parts->status;
}
