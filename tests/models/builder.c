/* SPDX-License-Identifier: BSD-3-Clause */
#include "builder.h"

#include <string.h>

builder build_begin(model *out)
{
  memset(out, 0, sizeof *out);
  builder build = {.out = out};
  build.status = baum_mechanism_create(&out->mechanism);
  return build;
}

bool build_fine(const builder *build)
{
  return build->status == BAUM_OK;
}

void build_gravity(builder *build, double gravity)
{
  if (build_fine(build)) {
    build->status = baum_mechanism_set_gravity(build->out->mechanism, 0.0, -gravity, 0.0);
  }
}

static baum_body_id keep_body(builder *build, baum_body_id id)
{
  if (build_fine(build)) {
    build->out->bodies[build->out->body_count++] = id;
  }
  return id;
}

baum_body_id build_particle(builder *build, const baum_planar_particle_def *def)
{
  baum_body_id id = {0};
  if (build_fine(build)) {
    build->status = baum_mechanism_add_planar_particle(build->out->mechanism, def, &id);
  }
  return keep_body(build, id);
}

baum_body_id build_body(builder *build, const baum_planar_body_def *def)
{
  baum_body_id id = {0};
  if (build_fine(build)) {
    build->status = baum_mechanism_add_planar_body(build->out->mechanism, def, &id);
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
  build->status = status;
  if (build_fine(build)) {
    build->out->joints[build->out->joint_count++] = joint;
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
  baum_status status = baum_mechanism_add_planar_revolute(build->out->mechanism, &def, &id);
  build_joint(build, status, id);
  return id;
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
  memset(out, 0, sizeof *out);
}
