/* SPDX-License-Identifier: BSD-3-Clause */
/* Options of a run: defaults, and what is refused. */
#include "simulate/options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/message.h"
#include "base/sized.h"
#include "integrate/integrator.h"

void baum_simulation_options_init(baum_simulation_options *options, size_t caller_size)
{
  const baum_simulation_options defaults = {
    .start_time = 0.0,
    .step = NAN,
    .rtol = NAN,
    .atol = NAN,
    .max_step = NAN,
    .check_derivatives = true,
    .max_steps = 1000000000,
    .progress_interval = 0.05,
    .tolerance_q = 1.0,
    .tolerance_v = 1.0,
    .tolerance_lambda = INFINITY,
  };
  if (baum_i_takes_sized(options, caller_size)) {
    baum_i_give_sized(options, caller_size, &defaults, sizeof defaults);
  }
}

static baum_status refuse(const char *field, const char *unit, double value, const char *must)
{
  return baum_i_fail(BAUM_ERR_ARGUMENT, "simulation options: %s is %g%s%s, %s", field, value,
                     unit[0] ? " " : "", unit, must);
}

/* Factors on tolerances where there is no tolerance. */
static baum_status check_no_factors(const baum_simulation_options *o)
{
  const char *const fields[2] = {"tolerance_q", "tolerance_v"};
  const double values[2] = {o->tolerance_q, o->tolerance_v};
  for (int k = 0; k < 2; k++) {
    if (values[k] != 1.0) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "simulation options: %s is %g, but %s takes no tolerance here; leave it 1",
                         fields[k], values[k], o->integrator->name);
    }
  }
  return BAUM_OK;
}

static baum_status check_step(const baum_simulation_options *o)
{
  const char *name = o->integrator->name;
  if (isnan(o->step)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "simulation options: step is not given, and %s has a fixed step", name);
  }
  if (!isfinite(o->step) || o->step <= 0.0) {
    return refuse("step", "s", o->step, "must be finite and > 0");
  }
  const char *const fields[3] = {"rtol", "atol", "max_step"};
  const double values[3] = {o->rtol, o->atol, o->max_step};
  for (int k = 0; k < 3; k++) {
    if (!isnan(values[k])) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "simulation options: %s is %g, but %s has a fixed step; give step alone",
                         fields[k], values[k], name);
    }
  }
  return check_no_factors(o);
}

static baum_status check_factors(const baum_simulation_options *o)
{
  const char *const fields[3] = {"tolerance_q", "tolerance_v", "tolerance_lambda"};
  const double values[3] = {o->tolerance_q, o->tolerance_v, o->tolerance_lambda};
  for (int k = 0; k < 3; k++) {
    bool may_be_infinite = k == 2; /* without any test of q and v there is no step to choose */
    if (!(values[k] > 0.0 && (may_be_infinite || isfinite(values[k])))) {
      return refuse(fields[k], "", values[k],
                    may_be_infinite ? "must be > 0" : "must be > 0 and finite");
    }
  }
  return BAUM_OK;
}

static baum_status check_max_step(const baum_simulation_options *o)
{
  bool is_fine = isnan(o->max_step) || o->max_step > 0.0;
  return is_fine ? BAUM_OK : refuse("max_step", "s", o->max_step, "must be > 0");
}

/* Kinematics takes neither step nor tolerance. */
static baum_status check_neither(const baum_simulation_options *o)
{
  const char *const fields[3] = {"step", "rtol", "atol"};
  const double values[3] = {o->step, o->rtol, o->atol};
  for (int k = 0; k < 3; k++) {
    if (!isnan(values[k])) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "simulation options: %s is %g, but %s solves Phi(q, t) = 0 to rounding at "
                         "the times asked for; give neither step nor tolerance",
                         fields[k], values[k], o->integrator->name);
    }
  }
  BAUM_I_TRY(check_no_factors(o));
  return check_max_step(o);
}

static baum_status check_tolerance(const baum_simulation_options *o)
{
  const char *name = o->integrator->name;
  if (!isnan(o->step)) {
    return baum_i_fail(
      BAUM_ERR_ARGUMENT,
      "simulation options: step is %g s, but %s chooses its own steps; give rtol alone", o->step,
      name);
  }
  if (isnan(o->rtol)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "simulation options: rtol is not given, and %s needs it",
                       name);
  }
  if (!(o->rtol > 0.0 && o->rtol < 1.0)) {
    return refuse("rtol", "", o->rtol, "must be > 0 and < 1");
  }
  if (!isnan(o->atol) && !(isfinite(o->atol) && o->atol >= 0.0)) {
    return refuse("atol", "", o->atol, "must be finite and >= 0");
  }
  BAUM_I_TRY(check_factors(o));
  return check_max_step(o);
}

/* Methods of either kind go by what is given. */
static baum_status check_either(const baum_simulation_options *o)
{
  if (isnan(o->step) == isnan(o->rtol)) {
    return baum_i_fail(
      BAUM_ERR_ARGUMENT,
      "simulation options: %s takes step for steps of one length or rtol for steps "
      "of its own choice, %s",
      o->integrator->name, isnan(o->step) ? "and neither is given" : "not both of them");
  }
  return isnan(o->step) ? check_tolerance(o) : check_step(o);
}

static baum_status check_steps(const baum_simulation_options *o)
{
  if (o->integrator->without_freedom) {
    return check_neither(o);
  }
  if (o->integrator->step && o->integrator->advance) {
    return check_either(o);
  }
  return o->integrator->step ? check_step(o) : check_tolerance(o);
}

static baum_status check_choices(const baum_simulation_options *o)
{
  if (o->start < BAUM_START_ASSEMBLE || o->start > BAUM_START_AS_GIVEN) {
    return refuse("start", "", (double)o->start, "is no baum_start");
  }
  if (o->solver < BAUM_SOLVER_AUTO || o->solver > BAUM_SOLVER_BLOCK) {
    return refuse("solver", "", (double)o->solver, "is no baum_solver");
  }
  if (!isfinite(o->start_time)) {
    return refuse("start_time", "s", o->start_time, "must be finite");
  }
  if (o->max_steps <= 0) {
    return refuse("max_steps", "", (double)o->max_steps, "must be > 0");
  }
  if (!(isfinite(o->progress_interval) && o->progress_interval >= 0.0)) {
    return refuse("progress_interval", "s", o->progress_interval, "must be finite and >= 0");
  }
  return BAUM_OK;
}

/* The pair of integrator and formulation. */
static baum_status check_pair(baum_simulation_options *o)
{
  const baum_formulation *offered = o->integrator->formulations;
  if (o->formulation == BAUM_FORMULATION_DEFAULT) {
    o->formulation = offered[0];
  }
  if (baum_i_integrator_offers(o->integrator, o->formulation)) {
    return BAUM_OK;
  }
  char list[160] = "";
  for (int k = 0; offered[k] != BAUM_FORMULATION_DEFAULT; k++) {
    size_t used = strlen(list);
    (void)snprintf(list + used, sizeof list - used, "%s%s", k > 0 ? ", " : "",
                   baum_formulation_name(offered[k]));
  }
  const char *name = baum_formulation_name(o->formulation);
  bool projection = o->formulation == BAUM_FORMULATION_PROJECTION;
  const char *why = projection ? o->integrator->why_no_projection : NULL;
  return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                     "simulation options: %s does not offer the formulation %s; it offers %s%s%s",
                     o->integrator->name, name ? name : "of that number",
                     list[0] ? list : "none, for no freedom is left", why ? "; " : "",
                     why ? why : "");
}

static baum_status check_gains(const baum_simulation_options *o)
{
  if (o->gains.rule != BAUM_GAINS_DEFAULT && o->formulation != BAUM_FORMULATION_BAUMGARTE) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "simulation options: gains are given, but %s %s has none",
                       o->integrator->without_freedom ? "the integrator" : "the formulation",
                       o->integrator->without_freedom ? o->integrator->name
                                                      : baum_formulation_name(o->formulation));
  }
  return BAUM_OK;
}

static baum_status check_row_gains(const baum_simulation_options *o)
{
  if (!o->row_gains && o->row_gain_count != 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "simulation options: row_gain_count is %d, but row_gains is NULL",
                       (int)o->row_gain_count);
  }
  if (o->row_gains && o->formulation != BAUM_FORMULATION_BAUMGARTE) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "simulation options: row_gains are given, but only baumgarte has gains");
  }
  return BAUM_OK;
}

/* At index 1 multipliers are as smooth as accelerations. In other forms what an implicit method
 * takes for their error does not fall with the step as it should. */
static baum_status check_multipliers(const baum_simulation_options *o)
{
  if (isinf(o->tolerance_lambda)) {
    return BAUM_OK;
  }
  const char *name = o->integrator->name;
  if (!o->integrator->tests_multipliers) {
    return baum_i_fail(
      BAUM_ERR_ARGUMENT,
      "simulation options: tolerance_lambda is %g, but %s has no multipliers among "
      "its unknowns; leave it infinite",
      o->tolerance_lambda, name);
  }
  if (o->formulation == BAUM_FORMULATION_BAUMGARTE ||
      o->formulation == BAUM_FORMULATION_UNSTABILIZED) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "simulation options: tolerance_lambda is %g, but with the formulation %s the "
                     "error of multipliers cannot be tested, for its estimate grows as steps "
                     "shrink; leave it infinite, or choose baumgarte or unstabilized",
                     o->tolerance_lambda, baum_formulation_name(o->formulation));
}

static baum_status check_built_in(const baum_integrator *integrator)
{
  return integrator->step || integrator->advance
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_UNSUPPORTED, "%s needs SUNDIALS, which this build does not have",
                         integrator->name);
}

baum_status baum_i_options_check(baum_simulation_options *options)
{
  if (!options->integrator) {
    return baum_i_fail(
      BAUM_ERR_ARGUMENT,
      "simulation options: integrator is NULL; there is no default, choose one of "
      "baum_euler, baum_semi_implicit_euler, baum_rk2, baum_rk3, baum_rk4, baum_dp5, baum_rk8, "
      "baum_ab2, baum_ab3, baum_ab4, baum_rattle, baum_generalized_alpha, baum_cvode_adams, "
      "baum_cvode_bdf, baum_ida, "
      "baum_kinematics");
  }
  BAUM_I_TRY(check_steps(options));
  BAUM_I_TRY(check_choices(options));
  BAUM_I_TRY(check_pair(options));
  BAUM_I_TRY(check_multipliers(options));
  BAUM_I_TRY(check_gains(options));
  BAUM_I_TRY(check_row_gains(options));
  return check_built_in(options->integrator);
}
