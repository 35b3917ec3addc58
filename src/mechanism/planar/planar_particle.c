/* SPDX-License-Identifier: BSD-3-Clause */
/* Particle in the plane: q = (x, y), v = q'.
 *
 *   M = diag(m, m)      g = (m g_x, m g_y) by gravity (gravity.c)
 */
#include <string.h>

#include <baum/planar.h>

#include "mechanism/definition.h"
#include "mechanism/general/gravity.h"

/* Parameters; the mass is where gravity.c looks for it. */
enum { MASS = BAUM_I_GRAVITY_MASS, PARAMETER_COUNT };

static const baum_i_def_field fields[] = {
  BAUM_I_NUMBERS(baum_planar_particle_def, mass, POSITIVE, "kg", 1.0),
  BAUM_I_NUMBERS(baum_planar_particle_def, position, FINITE, "m", 0.0),
  BAUM_I_OPTIONAL(baum_planar_particle_def, velocity, FREE, "m/s"),
  BAUM_I_FIELD(baum_planar_particle_def, held, START_FLAG),
  {0},
};

/* ---- definition ---- */

static void lower(const baum_i_body *body, double *parameters)
{
  const baum_planar_particle_def *def = body->element.def;
  parameters[MASS] = def->mass;
}

static void design(const void *given, double *q, double *v, bool *held)
{
  const baum_planar_particle_def *def = given;
  memcpy(q, def->position, sizeof def->position);
  memcpy(v, def->velocity, sizeof def->velocity);
  *held = def->held;
}

static void scale(const void *def, double length, double *out)
{
  (void)def;
  out[0] = length;
  out[1] = length;
}

/* ---- evaluation ---- */

static baum_status mass(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    double m = point->parameters[body->element.parameter + MASS];
    double *block = out + body->mass;
    block[0] = m;
    block[1] = 0.0;
    block[2] = 0.0;
    block[3] = m;
  }
  return BAUM_OK;
}

static const baum_i_body_type type = {
  .definition = {.kind = "planar particle",
                 .size = sizeof(baum_planar_particle_def),
                 .fields = fields,
                 .parameter_count = PARAMETER_COUNT},
  .frame = BAUM_I_FRAME_PARTICLE,
  .scleronomic = true,
  .constant_force = true,
  .nq = 2,
  .nv = 2,
  .lower = lower,
  .design = design,
  .scale = scale,
  .mass = mass,
  .force = baum_i_gravity_force,
  .potential = baum_i_gravity_potential,
};

BAUM_I_DEFINE(body, planar_particle, type)
