/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid body in the plane: q = (x, y, angle) with the centre of mass at (x, y), v = q'.
 *
 *   M = diag(m, m, I)      g = (m g_x, m g_y, 0) by gravity (gravity.c)
 *
 * Nothing of M and g depends on q or v, so there is nothing to linearize.
 */
#include <string.h>

#include <baum/planar.h>

#include "mechanism/definition.h"
#include "mechanism/general/gravity.h"

/* Parameters; the mass is where gravity.c looks for it. */
enum { MASS = BAUM_I_GRAVITY_MASS, INERTIA, PARAMETER_COUNT };

static const baum_i_def_field fields[] = {
  BAUM_I_NUMBERS(baum_planar_body_def, mass, POSITIVE, "kg", 1.0),
  BAUM_I_NUMBERS(baum_planar_body_def, inertia, POSITIVE, "kg m^2", 1.0),
  BAUM_I_NUMBERS(baum_planar_body_def, position, FINITE, "m", 0.0),
  BAUM_I_NUMBERS(baum_planar_body_def, angle, FINITE, "rad", 0.0),
  BAUM_I_OPTIONAL(baum_planar_body_def, velocity, FREE, "m/s"),
  BAUM_I_OPTIONAL(baum_planar_body_def, angular_velocity, FREE, "rad/s"),
  BAUM_I_FIELD(baum_planar_body_def, held, START_FLAG),
  {0},
};

/* ---- definition ---- */

static void lower(const baum_i_body *body, double *parameters)
{
  const baum_planar_body_def *def = body->element.def;
  parameters[MASS] = def->mass;
  parameters[INERTIA] = def->inertia;
}

static void design(const void *given, double *q, double *v, bool *held)
{
  const baum_planar_body_def *def = given;
  memcpy(q, def->position, sizeof def->position);
  q[2] = def->angle;
  memcpy(v, def->velocity, sizeof def->velocity);
  v[2] = def->angular_velocity;
  *held = def->held;
}

static void scale(const void *def, double length, double *out)
{
  (void)def;
  out[0] = length;
  out[1] = length;
  out[2] = 1.0;
}

/* ---- evaluation ---- */

static baum_status mass(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    const double *numbers = point->parameters + body->element.parameter;
    double *block = out + body->mass;
    memset(block, 0, 9 * sizeof *block);
    block[0] = numbers[MASS];
    block[4] = numbers[MASS];
    block[8] = numbers[INERTIA];
  }
  return BAUM_OK;
}

static const baum_i_body_type type = {
  .definition = {.kind = "planar body",
                 .size = sizeof(baum_planar_body_def),
                 .fields = fields,
                 .parameter_count = PARAMETER_COUNT},
  .frame = BAUM_I_FRAME_BODY,
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

BAUM_I_DEFINE(body, planar_body, type)
