/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies in the plane with q = (x, y, angle), and particles in the plane with q = (x, y). (x,
 * y) is the centre of mass, and v = q'.
 *
 *   M = diag(m, m, I)   or diag(m, m)
 *   g = (m g_x, m g_y, 0) or (m g_x, m g_y), gravity; V = -m (g_x x + g_y y)
 *
 * M and g do not depend on q or v, so the types have no function linearize().
 */
#include <string.h>

#include <baum/planar.h>

#include "mechanism/definition.h"

/* Parameters. Only rigid bodies have the parameter INERTIA. */
enum { MASS, INERTIA, PARAMETER_COUNT };

/* ---- common to rigid bodies and particles ---- */

static void scale(const void *def, double length, double *out)
{
  (void)def;
  out[0] = length;
  out[1] = length;
}

static double mass_of(const baum_i_body *body, const baum_i_point *point)
{
  return point->parameters[body->element.parameter + MASS];
}

static baum_status mass(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    const int n = body->nv;
    double *block = out + body->mass;
    memset(block, 0, (size_t)(n * n) * sizeof *block);
    block[0] = mass_of(body, point);
    block[n + 1] = block[0];
    if (n == 3) {
      block[8] = point->parameters[body->element.parameter + INERTIA];
    }
  }
  return BAUM_OK;
}

static baum_status force(const baum_i_body_group *group, baum_i_point *point, double *out)
{
  const double *gravity = point->mechanism->gravity;
  for (int i = 0; i < group->count; i++) {
    const baum_i_body *body = group->bodies[i];
    double m = mass_of(body, point);
    out[body->v] += m * gravity[0];
    out[body->v + 1] += m * gravity[1];
  }
  return BAUM_OK;
}

static baum_status potential(const baum_i_body *body, baum_i_point *point, double *sum)
{
  const double *gravity = point->mechanism->gravity;
  const double *r = point->q + body->q;
  *sum -= mass_of(body, point) * (gravity[0] * r[0] + gravity[1] * r[1]);
  return BAUM_OK;
}

#define BODY_MEMBERS \
  .scleronomic = true, .constant_force = true, .mass = mass, .force = force, .potential = potential

/* ---- rigid bodies ---- */

static const baum_i_def_field body_fields[] = {
  BAUM_I_NUMBERS(baum_planar_body_def, mass, POSITIVE, "kg", 1.0),
  BAUM_I_NUMBERS(baum_planar_body_def, inertia, POSITIVE, "kg m^2", 1.0),
  BAUM_I_NUMBERS(baum_planar_body_def, position, FINITE, "m", 0.0),
  BAUM_I_NUMBERS(baum_planar_body_def, angle, FINITE, "rad", 0.0),
  BAUM_I_OPTIONAL(baum_planar_body_def, velocity, FREE, "m/s"),
  BAUM_I_OPTIONAL(baum_planar_body_def, angular_velocity, FREE, "rad/s"),
  BAUM_I_FIELD(baum_planar_body_def, held, START_FLAG),
  {0},
};

static void lower_body(const baum_i_body *body, double *parameters)
{
  const baum_planar_body_def *def = body->element.def;
  parameters[MASS] = def->mass;
  parameters[INERTIA] = def->inertia;
}

static void design_body(const void *given, double *q, double *v, bool *held)
{
  const baum_planar_body_def *def = given;
  memcpy(q, def->position, sizeof def->position);
  q[2] = def->angle;
  memcpy(v, def->velocity, sizeof def->velocity);
  v[2] = def->angular_velocity;
  *held = def->held;
}

static void scale_body(const void *def, double length, double *out)
{
  scale(def, length, out);
  out[2] = 1.0;
}

static const baum_i_body_type body_type = {
  .definition = {BAUM_I_DEFINITION(planar_body, "planar body", body_fields),
                 .parameter_count = PARAMETER_COUNT},
  BODY_MEMBERS,
  .frame = BAUM_I_FRAME_BODY,
  .nq = 3,
  .nv = 3,
  .lower = lower_body,
  .design = design_body,
  .scale = scale_body,
};

BAUM_I_DEFINE(body, planar_body, body_type)

/* ---- particles ---- */

static const baum_i_def_field particle_fields[] = {
  BAUM_I_NUMBERS(baum_planar_particle_def, mass, POSITIVE, "kg", 1.0),
  BAUM_I_NUMBERS(baum_planar_particle_def, position, FINITE, "m", 0.0),
  BAUM_I_OPTIONAL(baum_planar_particle_def, velocity, FREE, "m/s"),
  BAUM_I_FIELD(baum_planar_particle_def, held, START_FLAG),
  {0},
};

static void lower_particle(const baum_i_body *body, double *parameters)
{
  const baum_planar_particle_def *def = body->element.def;
  parameters[MASS] = def->mass;
}

static void design_particle(const void *given, double *q, double *v, bool *held)
{
  const baum_planar_particle_def *def = given;
  memcpy(q, def->position, sizeof def->position);
  memcpy(v, def->velocity, sizeof def->velocity);
  *held = def->held;
}

static const baum_i_body_type particle_type = {
  .definition = {BAUM_I_DEFINITION(planar_particle, "planar particle", particle_fields),
                 .parameter_count = 1},
  BODY_MEMBERS,
  .frame = BAUM_I_FRAME_PARTICLE,
  .nq = 2,
  .nv = 2,
  .lower = lower_particle,
  .design = design_particle,
  .scale = scale,
};

BAUM_I_DEFINE(body, planar_particle, particle_type)
