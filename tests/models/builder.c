/* SPDX-License-Identifier: BSD-3-Clause */
#include "builder.h"

#include <stdlib.h>
#include <string.h>

const model_units MODEL_MILLI = {.length = 1e3, .mass = 1e3, .time = 1e3};

builder build_begin_in(const model_units *units, model *out)
{
  static const model_units si = {.length = 1.0, .mass = 1.0, .time = 1.0};
  memset(out, 0, sizeof *out);
  builder build = {.out = out, .units = units ? *units : si};
  build.status = baum_mechanism_create(&out->mechanism);
  return build;
}

builder build_begin(model *out)
{
  return build_begin_in(NULL, out);
}

static double power(double x, int exponent)
{
  double out = 1.0;
  for (int k = 0; k < abs(exponent); k++) {
    out *= x;
  }
  return exponent < 0 ? 1.0 / out : out;
}

double build_unit(const builder *build, int l, int m, int t)
{
  const model_units *units = &build->units;
  return power(units->length, l) * power(units->mass, m) * power(units->time, t);
}

static void scale(double *x, int count, double factor)
{
  for (int k = 0; k < count; k++) {
    x[k] *= factor;
  }
}

bool build_fine(const builder *build)
{
  return build->status == BAUM_OK;
}

void build_gravity(builder *build, double gravity)
{
  if (build_fine(build)) {
    double down = -gravity * build_unit(build, 1, 0, -2);
    build->status = baum_mechanism_set_gravity(build->out->mechanism, 0.0, down, 0.0);
  }
}

/* Room for one more of `size` bytes in a list that may move; false when there is no memory. */
static bool grow(void **list, int count, int *room, size_t size)
{
  if (count < *room) {
    return true;
  }
  int wanted = 2 * count + 8;
  void *moved = realloc(*list, (size_t)wanted * size);
  if (moved) {
    *list = moved;
    *room = wanted;
  }
  return moved != NULL;
}

static baum_body_id keep_body(builder *build, baum_body_id id)
{
  model *out = build->out;
  if (!build_fine(build)) {
    return id;
  }
  void *list = out->bodies;
  if (grow(&list, out->body_count, &build->body_room, sizeof id)) {
    out->bodies = list;
    out->bodies[out->body_count++] = id;
  } else {
    build->status = BAUM_ERR_MEMORY;
  }
  return id;
}

baum_body_id build_particle(builder *build, const baum_planar_particle_def *def)
{
  baum_body_id id = {0};
  baum_planar_particle_def scaled = *def;
  scaled.mass *= build_unit(build, 0, 1, 0);
  scale(scaled.position, 2, build_unit(build, 1, 0, 0));
  scale(scaled.velocity, 2, build_unit(build, 1, 0, -1));
  if (build_fine(build)) {
    build->status = baum_mechanism_add_planar_particle(build->out->mechanism, &scaled, &id);
  }
  return keep_body(build, id);
}

baum_body_id build_body(builder *build, const baum_planar_body_def *def)
{
  baum_body_id id = {0};
  baum_planar_body_def scaled = *def;
  scaled.mass *= build_unit(build, 0, 1, 0);
  scaled.inertia *= build_unit(build, 2, 1, 0);
  scale(scaled.position, 2, build_unit(build, 1, 0, 0));
  scale(scaled.velocity, 2, build_unit(build, 1, 0, -1));
  scaled.angular_velocity *= build_unit(build, 0, 0, -1);
  if (build_fine(build)) {
    build->status = baum_mechanism_add_planar_body(build->out->mechanism, &scaled, &id);
  }
  return keep_body(build, id);
}

baum_body_id build_coordinates(builder *build, const baum_coordinates_def *def)
{
  baum_body_id id = {0};
  if (build_fine(build)) {
    build->status = baum_mechanism_add_coordinates(build->out->mechanism, def, &id);
  }
  return keep_body(build, id);
}

void build_joint(builder *build, baum_status status, baum_joint_id joint)
{
  model *out = build->out;
  build->status = status;
  if (!build_fine(build)) {
    return;
  }
  void *list = out->joints;
  if (grow(&list, out->joint_count, &build->joint_room, sizeof joint)) {
    out->joints = list;
    out->joints[out->joint_count++] = joint;
  } else {
    build->status = BAUM_ERR_MEMORY;
  }
}

void build_force(builder *build, baum_status status)
{
  build->status = status;
}

baum_joint_id build_pin(builder *build, const char *name, place a, place b)
{
  baum_joint_id id = {0};
  if (!build_fine(build)) {
    return id;
  }
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  def.name = name;
  def.body_a = a.body;
  def.body_b = b.body;
  memcpy(def.point_a, a.point, sizeof def.point_a);
  memcpy(def.point_b, b.point, sizeof def.point_b);
  scale(def.point_a, 2, build_unit(build, 1, 0, 0));
  scale(def.point_b, 2, build_unit(build, 1, 0, 0));
  baum_status status = baum_mechanism_add_planar_revolute(build->out->mechanism, &def, &id);
  build_joint(build, status, id);
  return id;
}

void build_guide(builder *build, const char *name, baum_body_id slider, double height, double along)
{
  if (!build_fine(build)) {
    return;
  }
  baum_planar_translational_def def = baum_planar_translational_def_default();
  double length = build_unit(build, 1, 0, 0);
  def.name = name;
  def.body_a = BAUM_GROUND;
  def.body_b = slider;
  def.point_a[0] = along * length;
  def.point_a[1] = height * length;
  def.point_b[0] = along * length;
  def.point_b[1] = 0.0;
  baum_joint_id id = {0};
  baum_status status = baum_mechanism_add_planar_translational(build->out->mechanism, &def, &id);
  build_joint(build, status, id);
}

void build_constraint(builder *build, const baum_user_constraint_def *def)
{
  if (!build_fine(build)) {
    return;
  }
  baum_joint_id id = {0};
  baum_status status = baum_mechanism_add_user_constraint(build->out->mechanism, def, &id);
  build_joint(build, status, id);
}

baum_status build_finish(builder *build)
{
  if (build_fine(build)) {
    build->status = baum_mechanism_freeze(build->out->mechanism);
  }
  if (!build_fine(build)) {
    model_destroy(build->out);
  }
  return build->status;
}

void model_destroy(model *out)
{
  baum_mechanism_destroy(out->mechanism);
  free(out->bodies);
  free(out->joints);
  memset(out, 0, sizeof *out);
}
