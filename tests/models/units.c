/* SPDX-License-Identifier: BSD-3-Clause */
/* Converts a mechanism to other units, element by element. */
#include "models.h"

const model_units MODEL_MILLI = {.length = 1e3, .mass = 1e3, .time = 1e3};

static void scale(double *x, int count, double factor)
{
  for (int k = 0; k < count; k++) {
    x[k] *= factor;
  }
}

/* Each of these functions tries one kind of element. If the element is of another kind, the library
 * returns BAUM_ERR_ARGUMENT. */

static baum_status change_particle(baum_mechanism *m, baum_body_id id, const model_units *u)
{
  baum_planar_particle_def def = baum_planar_particle_def_default();
  baum_status status = baum_mechanism_get_planar_particle(m, id, &def, sizeof def);
  def.mass *= u->mass;
  scale(def.position, 2, u->length);
  scale(def.velocity, 2, u->length / u->time);
  return status == BAUM_OK ? baum_mechanism_set_planar_particle(m, id, &def) : status;
}

static baum_status change_body(baum_mechanism *m, baum_body_id id, const model_units *u)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  if (baum_mechanism_get_planar_body(m, id, &def, sizeof def) != BAUM_OK) {
    return change_particle(m, id, u);
  }
  def.mass *= u->mass;
  def.inertia *= u->mass * u->length * u->length;
  scale(def.position, 2, u->length);
  scale(def.velocity, 2, u->length / u->time);
  def.angular_velocity /= u->time;
  return baum_mechanism_set_planar_body(m, id, &def);
}

static baum_status change_driver(baum_mechanism *m, baum_joint_id id, const model_units *u)
{
  baum_driver_def def = baum_driver_def_default();
  baum_status status = baum_mechanism_get_driver(m, id, &def, sizeof def);
  def.rate /= u->time;
  def.acceleration /= u->time * u->time;
  return status == BAUM_OK ? baum_mechanism_set_driver(m, id, &def) : status;
}

static baum_status change_rod(baum_mechanism *m, baum_joint_id id, const model_units *u)
{
  baum_planar_distance_def def = baum_planar_distance_def_default();
  if (baum_mechanism_get_planar_distance(m, id, &def, sizeof def) != BAUM_OK) {
    return change_driver(m, id, u);
  }
  scale(def.point_a, 2, u->length);
  scale(def.point_b, 2, u->length);
  def.length *= u->length;
  return baum_mechanism_set_planar_distance(m, id, &def);
}

static baum_status change_guide(baum_mechanism *m, baum_joint_id id, const model_units *u)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  if (baum_mechanism_get_planar_translational(m, id, &def, sizeof def) != BAUM_OK) {
    return change_rod(m, id, u);
  }
  scale(def.point_a, 2, u->length);
  scale(def.point_b, 2, u->length);
  return baum_mechanism_set_planar_translational(m, id, &def);
}

static baum_status change_joint(baum_mechanism *m, baum_joint_id id, const model_units *u)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  if (baum_mechanism_get_planar_revolute(m, id, &def, sizeof def) != BAUM_OK) {
    return change_guide(m, id, u);
  }
  scale(def.point_a, 2, u->length);
  scale(def.point_b, 2, u->length);
  return baum_mechanism_set_planar_revolute(m, id, &def);
}

static baum_status change_load(baum_mechanism *m, baum_force_id id, const model_units *u)
{
  baum_planar_load_def def = baum_planar_load_def_default();
  baum_status status = baum_mechanism_get_planar_load(m, id, &def, sizeof def);
  double force = u->mass * u->length / (u->time * u->time);
  scale(def.point, 2, u->length);
  scale(def.force, 2, force);
  def.torque *= force * u->length;
  return status == BAUM_OK ? baum_mechanism_set_planar_load(m, id, &def) : status;
}

static baum_status change_force(baum_mechanism *m, baum_force_id id, const model_units *u)
{
  baum_planar_spring_def def = baum_planar_spring_def_default();
  if (baum_mechanism_get_planar_spring(m, id, &def, sizeof def) != BAUM_OK) {
    return change_load(m, id, u);
  }
  scale(def.point_a, 2, u->length);
  scale(def.point_b, 2, u->length);
  def.stiffness *= u->mass / (u->time * u->time);
  def.damping *= u->mass / u->time;
  def.free_length *= u->length;
  return baum_mechanism_set_planar_spring(m, id, &def);
}

static baum_status change_gravity(baum_mechanism *m, const model_units *u)
{
  double g[3];
  baum_status status = baum_mechanism_get_gravity(m, g);
  if (status == BAUM_OK) {
    scale(g, 3, u->length / (u->time * u->time));
    status = baum_mechanism_set_gravity(m, g[0], g[1], g[2]);
  }
  return status;
}

static baum_status change_all(baum_mechanism *m, const model_units *u)
{
  baum_status status = change_gravity(m, u);
  for (int k = 0; k < baum_mechanism_body_count(m) && status == BAUM_OK; k++) {
    status = change_body(m, baum_mechanism_body_at(m, k), u);
  }
  for (int k = 0; k < baum_mechanism_joint_count(m) && status == BAUM_OK; k++) {
    status = change_joint(m, baum_mechanism_joint_at(m, k), u);
  }
  for (int k = 0; k < baum_mechanism_force_count(m) && status == BAUM_OK; k++) {
    status = change_force(m, baum_mechanism_force_at(m, k), u);
  }
  return status == BAUM_OK ? baum_mechanism_freeze(m) : status;
}

baum_status model_change_units(baum_mechanism **mechanism, const model_units *units)
{
  baum_mechanism *changed = NULL;
  baum_status status = baum_mechanism_copy(*mechanism, &changed);
  if (status == BAUM_OK) {
    status = change_all(changed, units);
  }
  baum_mechanism_destroy(*mechanism);
  if (status != BAUM_OK) {
    baum_mechanism_destroy(changed);
    changed = NULL;
  }
  *mechanism = changed;
  return status;
}
