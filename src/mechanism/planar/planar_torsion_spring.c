/* SPDX-License-Identifier: BSD-3-Clause */
/* Torsion spring and damper in parallel between two bodies, planar. The relative angle phi =
 * angle_b - angle_a is continuous over revolutions. With stiffness k, damping c and free angle
 * phi_0, over the six columns x_a y_a angle_a x_b y_b angle_b:
 *
 *   T   = k (phi - phi_0) + c phi'                 restoring torque
 *   h   = phi_q = (0 0 -1 0 0 1)                   (6 columns)
 *   g   = -T h                                     (6 entries)
 *   V   = k (phi - phi_0)^2 / 2
 *   g_q = -k h h^T,   g_v = -c h h^T               (6 x 6)
 *
 * For a user's law T(phi, phi') there is no V, and k and c in g_q and g_v are T_phi and T_phi'.
 */
#include <math.h>

#include "mechanism/definition.h"
#include "mechanism/general/spring_law.h"
#include "mechanism/planar/planar.h"

static const baum_i_def_field fields[] = {
  BAUM_I_PLANAR_BODIES(baum_planar_torsion_spring_def),
  BAUM_I_NUMBERS(baum_planar_torsion_spring_def, stiffness, NOT_NEGATIVE, "N m/rad", 0.0),
  BAUM_I_NUMBERS(baum_planar_torsion_spring_def, damping, NOT_NEGATIVE, "N m s/rad", 0.0),
  BAUM_I_OPTIONAL(baum_planar_torsion_spring_def, free_angle, OPTIONAL, "rad"),
  BAUM_I_FIELD(baum_planar_torsion_spring_def, law, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_planar_torsion_spring_def, user, USER),
  BAUM_I_FIELD(baum_planar_torsion_spring_def, depends_on_velocity, CLAIM),
  {0},
};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  BAUM_I_TRY(baum_i_planar_check_bodies(mechanism, def, label));
  return baum_i_planar_check_angles(mechanism, def, label);
}

static bool depends_on_velocity(const void *given)
{
  const baum_planar_torsion_spring_def *def = given;
  return def->law ? def->depends_on_velocity : def->damping != 0.0;
}

static baum_status lower(const baum_mechanism *mechanism, const baum_i_force *force,
                         double *parameters)
{
  const baum_planar_torsion_spring_def *def = force->element.def;
  parameters[BAUM_I_STIFFNESS] = def->stiffness;
  parameters[BAUM_I_DAMPING] = def->damping;
  parameters[BAUM_I_FREE_LENGTH] = def->free_angle;
  if (isnan(def->free_angle)) {
    parameters[BAUM_I_FREE_LENGTH] = baum_i_design_frame(mechanism, force->span.bodies[1]).angle -
                                     baum_i_design_frame(mechanism, force->span.bodies[0]).angle;
  }
  return BAUM_OK;
}

/* ---- one spring ---- */

/* phi and its rate. */
typedef struct twist {
  double angle;
  double rate;
} twist;

static twist twist_at(const baum_i_force *force, const baum_i_point *point)
{
  const baum_i_frame *a = &point->frames[force->span.bodies[0]];
  const baum_i_frame *b = &point->frames[force->span.bodies[1]];
  return (twist){b->angle - a->angle, b->w - a->w};
}

static baum_i_spring_law law_of(const baum_i_force *force, const baum_i_point *point)
{
  const baum_planar_torsion_spring_def *def = force->element.def;
  return (baum_i_spring_law){.element = &force->element,
                             .numbers = point->parameters + force->element.parameter,
                             .law = def->law,
                             .user = def->user,
                             .depends_on_rate = def->depends_on_velocity};
}

static baum_status torque_at(const baum_i_force *force, baum_i_point *point, baum_i_tension *out)
{
  twist now = twist_at(force, point);
  baum_i_spring_law law = law_of(force, point);
  return baum_i_tension_at(&law, point, now.angle, now.rate, out);
}

/* -factor h h^T */
static void put_square(const baum_i_force *force, const baum_mechanism *mechanism, double factor,
                       double *squares)
{
  const double six[36] = {
    [6 * 2 + 2] = -factor, [6 * 2 + 5] = factor, [6 * 5 + 2] = factor, [6 * 5 + 5] = -factor};
  baum_i_columns_pack_force(mechanism, force, BAUM_I_PLANE, six, squares);
}

/* ---- type ---- */

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_force *element = group->forces[i];
    baum_i_tension t;
    BAUM_I_TRY(torque_at(element, point, &t));
    const double six[6] = {0.0, 0.0, t.value, 0.0, 0.0, -t.value};
    baum_i_columns_scatter(point->mechanism, &element->span, six, out);
  }
  return BAUM_OK;
}

static baum_status potential(const baum_i_force *element, baum_i_point *point, double *sum)
{
  baum_i_spring_law law = law_of(element, point);
  *sum += baum_i_spring_potential(&law, twist_at(element, point).angle);
  return BAUM_OK;
}

static baum_status power(const baum_i_force *element, baum_i_point *point,
                         double sum[BAUM_I_POWERS])
{
  twist now = twist_at(element, point);
  baum_i_spring_law law = law_of(element, point);
  return baum_i_spring_power(&law, point, now.angle, now.rate, sum);
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  baum_i_tension t;
  BAUM_I_TRY(torque_at(element, point, &t));
  put_square(element, point->mechanism, t.by_length, blocks->force_q);
  put_square(element, point->mechanism, t.by_rate, blocks->force_v);
  return BAUM_OK;
}

static baum_status check_derivatives(const void *given, baum_i_point *point)
{
  const baum_i_force *element = given;
  twist now = twist_at(element, point);
  baum_i_spring_law law = law_of(element, point);
  return baum_i_check_spring_law(&law, point, now.angle, now.rate, 1.0);
}

static const baum_i_force_type type = {
  .definition = {.kind = "planar torsion spring",
                 .size = sizeof(baum_planar_torsion_spring_def),
                 .fields = fields,
                 .check = check,
                 .parameter_count = BAUM_I_SPRING_NUMBERS,
                 .check_derivatives = check_derivatives},
  .lower = lower,
  .force = force,
  .depends_on_velocity = depends_on_velocity,
  .potential = potential,
  .linearize = linearize,
  .power = power,
};

BAUM_I_DEFINE(force, planar_torsion_spring, type)
