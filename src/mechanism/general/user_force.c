/* SPDX-License-Identifier: BSD-3-Clause */
/* Generalized force g(q, v, t) on the named bodies, by functions of the user.
 *
 * Derivatives that are not given come from differences (difference.c).
 */
#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/general/difference.h"
#include "mechanism/general/user_function.h"

static const baum_user_force_def defaults = {.struct_size = sizeof(baum_user_force_def),
                                             .depends_on_velocity = true};

/* ---- definition ---- */

static baum_status check(const baum_mechanism *mechanism, const void *given, const char *label)
{
  const baum_user_force_def *def = given;
  baum_status status = baum_i_check_user_bodies(mechanism, def->bodies, def->body_count, label);
  if (status == BAUM_OK) {
    status = baum_i_check_given(label, "force()", def->force != NULL);
  }
  return status;
}

static baum_status own(void *copy)
{
  baum_user_force_def *def = copy;
  def->bodies = baum_i_copy(def->bodies, (size_t)def->body_count, sizeof *def->bodies);
  return def->bodies ? BAUM_OK : BAUM_ERR_MEMORY;
}

static void release(void *copy)
{
  baum_user_force_def *def = copy;
  baum_i_free(def->bodies);
  def->bodies = NULL;
}

static void bodies(const baum_mechanism *mechanism, const void *given, baum_i_span *span)
{
  const baum_user_force_def *def = given;
  baum_i_user_bodies(mechanism, def->bodies, def->body_count, span);
}

static bool depends_on_velocity(const void *given)
{
  const baum_user_force_def *def = given;
  return def->depends_on_velocity;
}

/* ---- calls ---- */

static const baum_user_force_def *def_of(const baum_i_force *element)
{
  return element->element.def;
}

static baum_i_user_function function(const baum_i_force *element, const char *name, int rows,
                                     int cols)
{
  return (baum_i_user_function){.element = &element->element,
                                .family = "force",
                                .name = name,
                                .rows = rows,
                                .cols = cols,
                                .user = def_of(element)->user};
}

static baum_status force_at(const baum_i_force *element, const baum_i_local *at, double *out)
{
  baum_i_user_function f = function(element, "force", at->nl, 0);
  return baum_i_call_force(&f, def_of(element)->force, at, out);
}

/* ---- evaluation ---- */

static baum_status force(const baum_i_force_group *group, baum_i_point *point, double *out)
{
  baum_status status = BAUM_OK;
  for (int i = 0; i < group->count && status == BAUM_OK; i++) {
    const baum_i_force *element = group->forces[i];
    baum_i_local at = baum_i_gather(point, &element->span);
    double *value = baum_i_take(&at, at.nl);
    status = force_at(element, &at, value);
    for (int j = 0; j < at.nl && status == BAUM_OK; j++) {
      out[element->span.columns[j]] += value[j];
    }
  }
  return status;
}

static baum_status potential(const baum_i_force_group *group, baum_i_point *point, double *sum)
{
  baum_status status = BAUM_OK;
  for (int i = 0; i < group->count && status == BAUM_OK; i++) {
    const baum_i_force *element = group->forces[i];
    if (def_of(element)->potential) {
      baum_i_local at = baum_i_gather(point, &element->span);
      baum_i_user_function f = function(element, "potential", 1, 0);
      double value;
      status = baum_i_call_q(&f, def_of(element)->potential, &at, &value);
      *sum += status == BAUM_OK ? value : 0.0;
    }
  }
  return status;
}

static baum_status power(const baum_i_force_group *group, baum_i_point *point,
                         double sum[BAUM_I_POWERS])
{
  baum_status status = BAUM_OK;
  for (int i = 0; i < group->count && status == BAUM_OK; i++) {
    const baum_i_force *element = group->forces[i];
    baum_i_local at = baum_i_gather(point, &element->span);
    double *value = baum_i_take(&at, at.nl);
    status = force_at(element, &at, value);
    for (int j = 0; j < at.nl && status == BAUM_OK; j++) {
      sum[BAUM_I_POWER_USER_FORCES] += value[j] * at.v[j];
    }
  }
  return status;
}

/* ---- derivatives ---- */

static baum_status force_field(const void *context, const baum_i_local *at, double *out)
{
  return force_at(context, at, out);
}

static baum_status force_block(const baum_i_force *element, const baum_i_local *at,
                               baum_i_variable variable, double *out)
{
  bool by_q = variable == BAUM_I_VARIABLE_Q;
  baum_force_fn *given = by_q ? def_of(element)->force_q : def_of(element)->force_v;
  if (given) {
    baum_i_user_function f = function(element, by_q ? "force_q" : "force_v", at->nl, at->nl);
    return baum_i_call_force(&f, given, at, out);
  }
  baum_i_field field = {.evaluate = force_field, .context = element, .size = at->nl};
  return baum_i_difference_columns(&field, variable, at, out);
}

static baum_status linearize(const baum_i_force *element, baum_i_point *point,
                             const baum_i_force_blocks *blocks)
{
  baum_status status = BAUM_OK;
  baum_i_local at = baum_i_gather(point, &element->span);
  if (blocks->force_q) {
    status = force_block(element, &at, BAUM_I_VARIABLE_Q, blocks->force_q + element->square);
  }
  if (blocks->force_v && status == BAUM_OK) {
    status = force_block(element, &at, BAUM_I_VARIABLE_V, blocks->force_v + element->square);
  }
  return status;
}

/* ---- checking what is given ---- */

static baum_status check_block(const baum_i_force *element, const baum_i_local *at,
                               baum_i_variable variable)
{
  bool by_q = variable == BAUM_I_VARIABLE_Q;
  if (!(by_q ? def_of(element)->force_q : def_of(element)->force_v)) {
    return BAUM_OK;
  }
  baum_i_local here = *at;
  double *given = baum_i_take(&here, at->nl * at->nl);
  baum_status status = force_block(element, &here, variable, given);
  baum_i_user_function f = function(element, by_q ? "force_q" : "force_v", at->nl, at->nl);
  baum_i_field field = {.evaluate = force_field, .context = element, .size = at->nl};
  baum_i_claim claim = {&f, "force", given};
  return status == BAUM_OK ? baum_i_compare_columns(&claim, &field, variable, &here) : status;
}

static baum_status check_derivatives(const baum_i_force *element, baum_i_point *point)
{
  baum_i_local at = baum_i_gather(point, &element->span);
  baum_i_local here = at;
  double *value = baum_i_take(&here, at.nl);
  baum_status status = force_at(element, &here, value);
  if (status == BAUM_OK && !def_of(element)->depends_on_velocity) {
    baum_i_user_function f = function(element, "force", at.nl, 0);
    baum_i_field field = {.evaluate = force_field, .context = element, .size = at.nl};
    status = baum_i_compare_with_rest(&f, &field, &at);
  }
  if (status == BAUM_OK) {
    status = check_block(element, &at, BAUM_I_VARIABLE_Q);
  }
  if (status == BAUM_OK) {
    status = check_block(element, &at, BAUM_I_VARIABLE_V);
  }
  return status;
}

static const baum_i_force_type type = {
  .definition = {.kind = "user force",
                 .size = sizeof(baum_user_force_def),
                 .defaults = &defaults,
                 .check = check,
                 .own = own,
                 .release = release},
  .bodies = bodies,
  .force = force,
  .depends_on_velocity = depends_on_velocity,
  .potential = potential,
  .linearize = linearize,
  .power = power,
  .power_is_whole = true,
  .check = check_derivatives,
};

BAUM_I_DEFINE(force, user_force, type)
