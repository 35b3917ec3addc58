/* SPDX-License-Identifier: BSD-3-Clause */
/* The user's law of a spring: the call, and the check of its derivatives. */
#include "mechanism/general/spring_law.h"

#include "mechanism/general/check.h"
#include "mechanism/general/difference.h"
#include "mechanism/general/user_function.h"

/* Entries of out[]. */
enum { VALUE, BY_LENGTH, BY_RATE, ENTRIES };

static baum_i_user_function function(const baum_i_spring_law *spring)
{
  return (baum_i_user_function){spring->element, "law", ENTRIES, 0, spring->user};
}

/* One coordinate, the length, and one velocity, its rate. */
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

/* ---- check ---- */

/* The tension, at the place of the entry that is to be its derivative; zeros elsewhere. */
typedef struct entry {
  const baum_i_spring_law *spring;
  int which;
} entry;

static baum_status tension_field(const void *context, const baum_i_local *at, double *out)
{
  const entry *e = context;
  double entries[ENTRIES];
  BAUM_I_TRY(call(e->spring, at, entries));
  for (int i = 0; i < ENTRIES; i++) {
    out[i] = i == e->which ? entries[VALUE] : 0.0;
  }
  return BAUM_OK;
}

static baum_status check_entry(const entry *e, const baum_i_local *at, double value)
{
  baum_i_user_function f = function(e->spring);
  double given[ENTRIES] = {0.0};
  given[e->which] = value;
  double direction[1];
  baum_i_variable variable = e->which == BY_RATE ? BAUM_I_VARIABLE_V : BAUM_I_VARIABLE_Q;
  baum_i_ray ray = baum_i_column_ray(at, variable, 0, direction);
  baum_i_field field = {.evaluate = tension_field, .context = e, .size = ENTRIES};
  baum_i_claim claim = {&f, "law()[0]", given};
  return baum_i_compare_ray(&claim, &baum_i_stencil_first, &field, &ray, at);
}

baum_status baum_i_check_spring_law(const baum_i_spring_law *spring, baum_i_point *point,
                                    double length, double rate, double scale)
{
  if (!spring->law) {
    return BAUM_OK;
  }
  const baum_i_local at = {.point = point,
                           .ql = 1,
                           .nl = 1,
                           .t = point->t,
                           .q = &length,
                           .v = &rate,
                           .scale = &scale,
                           .free = point->scratch};
  double given[ENTRIES];
  BAUM_I_TRY(call(spring, &at, given));
  for (int which = BY_LENGTH; which <= BY_RATE; which++) {
    BAUM_I_TRY(check_entry(&(entry){spring, which}, &at, given[which]));
  }
  if (!spring->depends_on_rate) {
    baum_i_user_function f = function(spring);
    entry value = {spring, VALUE};
    baum_i_field field = {.evaluate = tension_field, .context = &value, .size = 1};
    return baum_i_compare_with_rest(&f, &field, &at);
  }
  return BAUM_OK;
}
