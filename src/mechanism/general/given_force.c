/* SPDX-License-Identifier: BSD-3-Clause */
#include "mechanism/general/given_force.h"

#include "mechanism/general/check.h"

static const char *const names[2] = {
  [BAUM_I_VARIABLE_Q] = "force_q", [BAUM_I_VARIABLE_V] = "force_v"};

static baum_i_user_function function(const baum_i_given_force *given, const char *name, int rows,
                                     int cols)
{
  return (baum_i_user_function){given->element, name, rows, cols, given->user};
}

baum_status baum_i_given_force_at(const baum_i_given_force *given, const baum_i_local *at,
                                  double *out)
{
  baum_i_user_function f = function(given, "force", at->nl, 0);
  return baum_i_call_force(&f, given->force, at, out);
}

static baum_status force_field(const void *given, const baum_i_local *at, double *out)
{
  return baum_i_given_force_at(given, at, out);
}

baum_status baum_i_given_force_block(const baum_i_given_force *given, const baum_i_local *at,
                                     baum_i_variable variable, double *out)
{
  if (!out) {
    return BAUM_OK;
  }
  if (given->by[variable]) {
    baum_i_user_function f = function(given, names[variable], at->nl, at->nl);
    return baum_i_call_force(&f, given->by[variable], at, out);
  }
  baum_i_field field = {.evaluate = force_field, .context = given, .size = at->nl};
  return baum_i_difference_columns(&field, variable, at, out);
}

baum_status baum_i_given_force_potential(const baum_i_given_force *given, const baum_i_local *at,
                                         double *sum)
{
  if (given->potential) {
    baum_i_user_function f = function(given, "potential", 1, 0);
    double value;
    BAUM_I_TRY(baum_i_call_q(&f, given->potential, at, &value));
    *sum += value;
  }
  return BAUM_OK;
}

baum_status baum_i_given_force_power(const baum_i_given_force *given, const baum_i_local *at,
                                     double *sum)
{
  baum_i_local here = *at;
  double *value = baum_i_take(&here, at->nl);
  BAUM_I_TRY(baum_i_given_force_at(given, &here, value));
  for (int j = 0; j < at->nl; j++) {
    *sum += value[j] * at->v[j];
  }
  return BAUM_OK;
}

static baum_status check_block(const baum_i_given_force *given, const baum_i_local *at,
                               baum_i_variable variable)
{
  if (!given->by[variable]) {
    return BAUM_OK;
  }
  baum_i_local here = *at;
  double *block = baum_i_take(&here, at->nl * at->nl);
  BAUM_I_TRY(baum_i_given_force_block(given, &here, variable, block));
  baum_i_user_function f = function(given, names[variable], at->nl, at->nl);
  baum_i_field field = {.evaluate = force_field, .context = given, .size = at->nl};
  baum_i_claim claim = {&f, "force", block};
  return baum_i_compare_columns(&claim, &field, variable, &here);
}

baum_status baum_i_given_force_check(const baum_i_given_force *given, const baum_i_local *at)
{
  baum_i_local here = *at;
  BAUM_I_TRY(baum_i_given_force_at(given, &here, baum_i_take(&here, at->nl)));
  if (!given->depends_on_velocity) {
    baum_i_user_function f = function(given, "force", at->nl, 0);
    baum_i_field field = {.evaluate = force_field, .context = given, .size = at->nl};
    BAUM_I_TRY(baum_i_compare_with_rest(&f, &field, at));
  }
  BAUM_I_TRY(check_block(given, at, BAUM_I_VARIABLE_Q));
  return check_block(given, at, BAUM_I_VARIABLE_V);
}
