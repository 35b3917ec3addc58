/* SPDX-License-Identifier: BSD-3-Clause */
/* A generalized force g(q, v, t) on the bodies that the definition names. User functions compute
 * this force.
 *
 * Derivatives for which there is no user function are computed by differences (difference.c).
 */
#include "mechanism/definition.h"
#include "mechanism/general/given_force.h"

static const baum_i_def_field fields[] = {
  BAUM_I_ARRAY(baum_user_force_def, bodies, BODIES, FINITE, body_count, body_count),
  BAUM_I_FIELD(baum_user_force_def, body_count, OWN_COUNT),
  BAUM_I_FIELD(baum_user_force_def, force, FUNCTION),
  BAUM_I_FIELD(baum_user_force_def, force_q, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_user_force_def, force_v, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_user_force_def, potential, OPTIONAL_FUNCTION),
  BAUM_I_FIELD(baum_user_force_def, user, USER),
  BAUM_I_FIELD(baum_user_force_def, depends_on_velocity, CLAIM),
  {0},
};

static bool depends_on_velocity(const baum_i_force *force)
{
  return ((const baum_user_force_def *)force->element.def)->depends_on_velocity;
}

static baum_i_given_force given(const baum_i_force *element)
{
  const baum_user_force_def *def = element->element.def;
  return BAUM_I_GIVEN_FORCE(&element->element, def);
}

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  for (int i = 0; i < group->count; i++) {
    const baum_i_span *span = &group->forces[i]->span;
    baum_i_given_force f = given(group->forces[i]);
    baum_i_local at = baum_i_gather(point, span);
    double *value = baum_i_take(&at, at.nl);
    BAUM_I_TRY(baum_i_given_force_at(&f, &at, value));
    for (int j = 0; j < at.nl; j++) {
      out[span->columns[j]] += value[j];
    }
  }
  return BAUM_OK;
}

static baum_status potential(const baum_i_force *element, baum_i_point *point, double *sum)
{
  baum_i_given_force f = given(element);
  baum_i_local at = baum_i_gather(point, &element->span);
  return baum_i_given_force_potential(&f, &at, sum);
}

static bool power_is_whole(const baum_i_force *force)
{
  (void)force;
  return true;
}

static baum_status power(const baum_i_force *element, baum_i_point *point,
                         double sum[BAUM_I_POWERS])
{
  baum_i_given_force f = given(element);
  baum_i_local at = baum_i_gather(point, &element->span);
  return baum_i_given_force_power(&f, &at, &sum[BAUM_I_POWER_USER_FORCES]);
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  baum_i_given_force f = given(element);
  baum_i_local at = baum_i_gather(point, &element->span);
  double *force_q = baum_i_block_at(blocks->force_q, element->square);
  double *force_v = baum_i_block_at(blocks->force_v, element->square);
  BAUM_I_TRY(baum_i_given_force_block(&f, &at, BAUM_I_VARIABLE_Q, force_q));
  return baum_i_given_force_block(&f, &at, BAUM_I_VARIABLE_V, force_v);
}

static baum_status check_derivatives(const void *force, baum_i_point *point)
{
  const baum_i_force *element = force;
  baum_i_given_force f = given(element);
  baum_i_local at = baum_i_gather(point, &element->span);
  return baum_i_given_force_check(&f, &at);
}

static const baum_i_force_type type = {
  .definition = {BAUM_I_DEFINITION(user_force, "user force", fields),
                 .check_derivatives = check_derivatives},
  .force = force,
  .depends_on_velocity = depends_on_velocity,
  .potential = potential,
  .linearize = linearize,
  .power = power,
  .power_is_whole = power_is_whole,
  .whole_class = BAUM_I_POWER_USER_FORCES,
};

BAUM_I_DEFINE(force, user_force, type)
