/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls and checks the user's law of a spring, and contains the functions that are the same for all
 * types of springs. */
#include "mechanism/general/spring_law.h"

#include <math.h>

#include "mechanism/general/check.h"
#include "mechanism/general/difference.h"
#include "mechanism/general/user_function.h"

/* Entries of the array out[] that a law returns. */
enum { VALUE, BY_LENGTH, BY_RATE, ENTRIES };

static baum_i_user_function function(const baum_i_spring_law *spring)
{
  return (baum_i_user_function){spring->element, "law", ENTRIES, 0, spring->user};
}

/* Call the law of a spring. In `at`, q is the length of the spring and v is the rate of this
 * length. */
static baum_status call(const baum_i_spring_law *spring, const baum_i_local *at,
                        double out[ENTRIES])
{
  baum_i_user_function f = function(spring);
  baum_i_begin_call(&f, at, out);
  return baum_i_judge(&f, at, spring->law(at->q[0], at->v[0], out, spring->user), out);
}

baum_status baum_i_call_spring_law(const baum_i_spring_law *spring, baum_i_point *point,
                                   double length, double rate, baum_i_tension *out)
{
  const baum_i_local at = {.point = point, .nl = 1, .t = point->t, .q = &length, .v = &rate};
  double entries[ENTRIES];
  BAUM_I_TRY(call(spring, &at, entries));
  *out = (baum_i_tension){entries[VALUE], entries[BY_LENGTH], entries[BY_RATE]};
  return BAUM_OK;
}

/* ---- members of types ---- */

void baum_i_spring_lower(const baum_i_force *force, double design, double *numbers)
{
  const baum_i_spring_def *def = baum_i_spring_def_of(force);
  numbers[BAUM_I_STIFFNESS] = def->stiffness;
  numbers[BAUM_I_DAMPING] = def->damping;
  numbers[BAUM_I_FREE_LENGTH] = isnan(def->free_length) ? design : def->free_length;
}

bool baum_i_spring_depends(const baum_i_force *force)
{
  const baum_i_spring_def *def = baum_i_spring_def_of(force);
  return def->law ? def->depends_on_velocity : def->damping != 0.0;
}

baum_status baum_i_spring_potential(const baum_i_force *force, baum_i_point *point, double *sum)
{
  const baum_i_spring_law s = baum_i_spring_law_of(force, point);
  double stretch = force->type->stretch(force, point).length - s.numbers[BAUM_I_FREE_LENGTH];
  *sum += s.law ? 0.0 : 0.5 * s.numbers[BAUM_I_STIFFNESS] * stretch * stretch;
  return BAUM_OK;
}

baum_status baum_i_spring_power(const baum_i_force *force, baum_i_point *point,
                                double sum[BAUM_I_POWERS])
{
  const baum_i_spring_law s = baum_i_spring_law_of(force, point);
  const baum_i_stretch now = force->type->stretch(force, point);
  if (now.no_direction) {
    return BAUM_OK;
  }
  if (!s.law) {
    sum[BAUM_I_POWER_DAMPERS] -= s.numbers[BAUM_I_DAMPING] * now.rate * now.rate;
    return BAUM_OK;
  }
  baum_i_tension t;
  BAUM_I_TRY(baum_i_call_spring_law(&s, point, now.length, now.rate, &t));
  sum[BAUM_I_POWER_SPRINGS] -= t.value * now.rate;
  return BAUM_OK;
}

/* ---- check ---- */

static baum_status law_field(const void *spring, const baum_i_local *at, double *out)
{
  return call(spring, at, out);
}

static baum_status tension_field(const void *spring, const baum_i_local *at, double *out)
{
  double entries[ENTRIES];
  BAUM_I_TRY(call(spring, at, entries));
  out[0] = entries[VALUE];
  return BAUM_OK;
}

baum_status baum_i_spring_check(const void *force, baum_i_point *point)
{
  const baum_i_force *element = force;
  const baum_i_spring_law spring = baum_i_spring_law_of(element, point);
  const baum_i_stretch now = element->type->stretch(element, point);
  if (!spring.law || now.no_direction) {
    return BAUM_OK;
  }
  const baum_i_local at = {.point = point,
                           .ql = 1,
                           .nl = 1,
                           .t = point->t,
                           .q = &now.length,
                           .v = &now.rate,
                           .scale = &now.scale,
                           .free = point->scratch};
  static const baum_i_derived pairs[2] = {
    [BAUM_I_VARIABLE_Q] = {BY_LENGTH, VALUE}, [BAUM_I_VARIABLE_V] = {BY_RATE, VALUE}};
  baum_i_user_function f = function(&spring);
  baum_i_field whole = {.evaluate = law_field, .context = &spring, .size = ENTRIES};
  for (baum_i_variable by = BAUM_I_VARIABLE_Q; by <= BAUM_I_VARIABLE_V; by++) {
    double direction[1];
    baum_i_ray ray = baum_i_column_ray(&at, by, 0, direction);
    BAUM_I_TRY(baum_i_compare_entries(&f, "law()[0]", &whole, &pairs[by], 1, &ray, &at));
  }
  baum_i_field tension = {.evaluate = tension_field, .context = &spring, .size = 1};
  return spring.depends_on_rate ? BAUM_OK : baum_i_compare_with_rest(&f, &tension, &at);
}
