/* SPDX-License-Identifier: BSD-3-Clause */
/* Point mass in space: q = (x, y, z), v = q', M = m I, g = m gravity. */
#include <string.h>

#include <baum/spatial.h>

#include "mechanism/definition.h"
#include "mechanism/general/gravity.h"

enum { MASS = BAUM_I_GRAVITY_MASS, PARAMETER_COUNT };

static const baum_i_def_field fields[] = {
  BAUM_I_NUMBERS(baum_spatial_particle_def, mass, POSITIVE, "kg", 1.0),
  BAUM_I_NUMBERS(baum_spatial_particle_def, position, FINITE, "m", 0.0),
  BAUM_I_OPTIONAL(baum_spatial_particle_def, velocity, FREE, "m/s"),
  BAUM_I_FIELD(baum_spatial_particle_def, held, START_FLAG),
  {0},
};

static void lower(const baum_i_body *body, double *parameters)
{
  const baum_spatial_particle_def *def = body->element.def;
  parameters[MASS] = def->mass;
}

static void design(const void *given, double *q, double *v, bool *held)
{
  const baum_spatial_particle_def *def = given;
  memcpy(q, def->position, sizeof def->position);
  memcpy(v, def->velocity, sizeof def->velocity);
  *held = def->held;
}

static void scale(const void *def, double length, double *out)
{
  (void)def;
  for (int i = 0; i < 3; i++) {
    out[i] = length;
  }
}

static baum_status mass(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    double *block = out + body->mass;
    memset(block, 0, 9 * sizeof *block);
    for (int k = 0; k < 9; k += 4) {
      block[k] = point->parameters[body->element.parameter + MASS];
    }
  }
  return BAUM_OK;
}

static const baum_i_body_type type = {
  .definition = {.kind = "spatial particle",
                 .size = sizeof(baum_spatial_particle_def),
                 .fields = fields,
                 .parameter_count = PARAMETER_COUNT},
  .frame = BAUM_I_FRAME_SPATIAL_PARTICLE,
  .scleronomic = true,
  .constant_force = true,
  .nq = 3,
  .nv = 3,
  .lower = lower,
  .design = design,
  .scale = scale,
  .mass = mass,
  .force = baum_i_gravity_force,
  .potential = baum_i_gravity_potential,
};

BAUM_I_DEFINE(body, spatial_particle, type)
