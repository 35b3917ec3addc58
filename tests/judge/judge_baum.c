/* SPDX-License-Identifier: BSD-3-Clause */
#include "judge_baum.h"

#include <string.h>

typedef struct builder {
  const judge_scene *s;
  baum_mechanism *m;
  baum_body_id bodies[JUDGE_BODIES];
  baum_joint_id joints[JUDGE_JOINTS];
} builder;

static baum_body_id body_of(const builder *b, int body)
{
  return body == JUDGE_GROUND ? BAUM_GROUND : b->bodies[body];
}

static baum_status add_body(builder *b, int k)
{
  const judge_body *from = &b->s->bodies[k];
  const double *v = b->s->v + from->first;
  if (from->particle) {
    baum_planar_particle_def def = baum_planar_particle_def_default();
    def.mass = from->mass;
    memcpy(def.position, from->pose, sizeof def.position);
    memcpy(def.velocity, v, sizeof def.velocity);
    return baum_mechanism_add_planar_particle(b->m, &def, &b->bodies[k]);
  }
  baum_planar_body_def def = baum_planar_body_def_default();
  def.mass = from->mass;
  def.inertia = from->inertia;
  memcpy(def.position, from->pose, sizeof def.position);
  def.angle = from->pose[2];
  memcpy(def.velocity, v, sizeof def.velocity);
  def.angular_velocity = v[2];
  return baum_mechanism_add_planar_body(b->m, &def, &b->bodies[k]);
}

static int follow_law(double t, double s[3], void *user)
{
  judge_law(user, t, s);
  return 0;
}

static baum_status add_driver(builder *b, int k, const judge_joint *j)
{
  baum_driver_def def = baum_driver_def_default();
  def.joint = b->joints[j->of];
  if (j->law[2] > 0.0) {
    def.law = follow_law;
    def.user = (void *)(uintptr_t)j;
  } else {
    def.value = j->law[0];
    def.rate = j->law[1];
  }
  return baum_mechanism_add_driver(b->m, &def, &b->joints[k]);
}

/* Sets the fields that the definitions of all joints share. */
#define PLACE(def)                                      \
  (def).body_a = body_of(b, j->a);                      \
  (def).body_b = body_of(b, j->b);                      \
  memcpy((def).point_a, j->point_a, sizeof j->point_a); \
  memcpy((def).point_b, j->point_b, sizeof j->point_b)

static baum_status add_slider(builder *b, int k, const judge_joint *j)
{
  if (j->kind == JUDGE_SLOT) {
    baum_planar_pin_in_slot_def def = baum_planar_pin_in_slot_def_default();
    PLACE(def);
    memcpy(def.axis, j->axis, sizeof j->axis);
    return baum_mechanism_add_planar_pin_in_slot(b->m, &def, &b->joints[k]);
  }
  baum_planar_translational_def def = baum_planar_translational_def_default();
  PLACE(def);
  memcpy(def.axis, j->axis, sizeof j->axis);
  def.angle = j->kept;
  return baum_mechanism_add_planar_translational(b->m, &def, &b->joints[k]);
}

static baum_status add_joint(builder *b, int k)
{
  const judge_joint *j = &b->s->joints[k];
  if (j->kind == JUDGE_REVOLUTE) {
    baum_planar_revolute_def def = baum_planar_revolute_def_default();
    PLACE(def);
    return baum_mechanism_add_planar_revolute(b->m, &def, &b->joints[k]);
  }
  if (j->kind == JUDGE_DISTANCE) {
    baum_planar_distance_def def = baum_planar_distance_def_default();
    PLACE(def);
    def.length = j->kept;
    return baum_mechanism_add_planar_distance(b->m, &def, &b->joints[k]);
  }
  if (j->of >= 0) {
    return add_driver(b, k, j);
  }
  return add_slider(b, k, j);
}

static baum_status add_spring(builder *b, int k)
{
  const judge_spring *j = &b->s->springs[k];
  if (j->torsion) {
    baum_planar_torsion_spring_def def = baum_planar_torsion_spring_def_default();
    def.body_a = body_of(b, j->a);
    def.body_b = body_of(b, j->b);
    def.stiffness = j->stiffness;
    def.damping = j->damping;
    def.free_angle = j->free;
    return baum_mechanism_add_planar_torsion_spring(b->m, &def, NULL);
  }
  baum_planar_spring_def def = baum_planar_spring_def_default();
  PLACE(def);
  def.stiffness = j->stiffness;
  def.damping = j->damping;
  def.free_length = j->free;
  return baum_mechanism_add_planar_spring(b->m, &def, NULL);
}

static baum_status add_load(builder *b)
{
  if (b->s->load_body == JUDGE_GROUND) {
    return BAUM_OK;
  }
  baum_planar_load_def def = baum_planar_load_def_default();
  def.body = b->bodies[b->s->load_body];
  memcpy(def.force, b->s->load, sizeof def.force);
  def.torque = b->s->load[2];
  return baum_mechanism_add_planar_load(b->m, &def, NULL);
}

baum_mechanism *judge_build(const judge_scene *s)
{
  builder b = {.s = s};
  baum_status status = baum_mechanism_create(&b.m);
  if (status == BAUM_OK) {
    status = baum_mechanism_set_gravity(b.m, 0.0, -s->gravity, 0.0);
  }
  for (int k = 0; status == BAUM_OK && k < s->body_count; k++) {
    status = add_body(&b, k);
  }
  for (int k = 0; status == BAUM_OK && k < s->joint_count; k++) {
    status = add_joint(&b, k);
  }
  for (int k = 0; status == BAUM_OK && k < s->spring_count; k++) {
    status = add_spring(&b, k);
  }
  if (status == BAUM_OK) {
    status = add_load(&b);
  }
  if (status == BAUM_OK) {
    status = baum_mechanism_freeze(b.m);
  }
  if (status != BAUM_OK) {
    baum_mechanism_destroy(b.m);
    b.m = NULL;
  }
  return b.m;
}
