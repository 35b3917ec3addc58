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
#include "mechanism/planar/gravity.h"

/* Parameters; the mass is where gravity.c looks for it. */
enum { MASS = BAUM_I_GRAVITY_MASS, INERTIA, PARAMETER_COUNT };

static const baum_planar_body_def defaults = {
  .struct_size = sizeof(baum_planar_body_def),
  .mass = 1.0,
  .inertia = 1.0,
  .velocity = {BAUM_I_NOT_GIVEN, BAUM_I_NOT_GIVEN},
  .angular_velocity = BAUM_I_NOT_GIVEN,
};

/* ---- definition ---- */

static baum_status check_start(const baum_planar_body_def *def, const char *label)
{
  baum_status status = baum_i_check_optional(label, "velocity[0]", "m/s", def->velocity[0]);
  if (status == BAUM_OK) {
    status = baum_i_check_optional(label, "velocity[1]", "m/s", def->velocity[1]);
  }
  if (status == BAUM_OK) {
    status = baum_i_check_optional(label, "angular_velocity", "rad/s", def->angular_velocity);
  }
  return status;
}

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  (void)mechanism;
  const baum_planar_body_def *def = given;
  baum_status status = baum_i_check_positive(label, "mass", "kg", def->mass);
  if (status == BAUM_OK) {
    status = baum_i_check_positive(label, "inertia", "kg m^2", def->inertia);
  }
  if (status == BAUM_OK) {
    status = baum_i_check_finite(label, "position[0]", "m", def->position[0]);
  }
  if (status == BAUM_OK) {
    status = baum_i_check_finite(label, "position[1]", "m", def->position[1]);
  }
  if (status == BAUM_OK) {
    status = baum_i_check_finite(label, "angle", "rad", def->angle);
  }
  return status == BAUM_OK ? check_start(def, label) : status;
}

static bool constant_mass(const void *def)
{
  (void)def;
  return true;
}

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
                 .defaults = &defaults,
                 .check = check},
  .frame = BAUM_I_FRAME_BODY,
  .parameter_count = PARAMETER_COUNT,
  .scleronomic = true,
  .constant_force = true,
  .nq = 3,
  .nv = 3,
  .constant_mass = constant_mass,
  .lower = lower,
  .design = design,
  .scale = scale,
  .mass = mass,
  .force = baum_i_gravity_force,
  .potential = baum_i_gravity_potential,
};

BAUM_I_DEFINE(body, planar_body, type)
