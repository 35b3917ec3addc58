/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets the defaults of the options of a run, and checks options. */
#include "simulate/options.h"

#include <math.h>
#include <string.h>

#include "base/sized.h"
#include "base/text.h"
#include "integrate/integrator.h"

void baum_simulation_options_init(baum_simulation_options *options, size_t caller_size)
{
  const baum_simulation_options defaults = {
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
  baum_i_give_sized(options, caller_size, &defaults, sizeof defaults);
}

static baum_status refuse(const char *field, const char *unit, double value, const char *must)
{
  return baum_i_fail(BAUM_ERR_ARGUMENT, "simulation options: %s is %g%s%s, %s", field, value,
                     unit[0] ? " " : "", unit, must);
}

/* ---- numbers ---- */

/* The kind of steps that a method takes when it has the given options. */
typedef enum stepping { FIXED_STEP, VARIABLE_STEP, NO_STEP } stepping;

/* The reason why a method refuses a number. It depends on the kind of steps that the method
 * takes. */
static const char *const WHY_NOT[] = {
  [FIXED_STEP] = "has a fixed step; give step alone",
  [VARIABLE_STEP] = "chooses its own steps; give rtol alone",
  [NO_STEP] = ("solves Phi(q, t) = 0 to rounding at the requested times; give neither step nor "
               "tolerance"),
};

/* A number among the options, with its limits. */
typedef struct number {
  const char *name;
  const char *unit;
  size_t offset;
  bool takes[3]; /* for each kind of stepping: whether the number may be given */
  bool required; /* whether the number must be given if it may be given */
  double unset;  /* value that means "not given" */
  double least;
  double most;
  bool may_be_zero;
  bool may_be_infinite;
  const char *must;
} number;

#define NUMBER(FIELD, UNIT) #FIELD, UNIT, offsetof(baum_simulation_options, FIELD)
#define ALWAYS       \
  {                  \
    true, true, true \
  }
#define WITH_TOLERANCE     \
  {                        \
    [VARIABLE_STEP] = true \
  }
#define WITHOUT_STEP                         \
  {                                          \
    [VARIABLE_STEP] = true, [NO_STEP] = true \
  }

/* The table of all numbers among the options. The factors on tolerances are at the end of the
 * table. Methods without a tolerance refuse them. If tolerance_lambda is not allowed,
 * check_multipliers() refuses it. */
/* clang-format off */
static const number NUMBERS[] = {
  {NUMBER(step, "s"), {[FIXED_STEP] = true}, .required = true, .unset = NAN, .most = INFINITY,
   .must = "must be finite and > 0"},
  {NUMBER(rtol, ""), WITH_TOLERANCE, .required = true, .unset = NAN, .most = 1.0,
   .must = "must be > 0 and < 1"},
  {NUMBER(atol, ""), WITH_TOLERANCE, .unset = NAN, .most = INFINITY, .may_be_zero = true,
   .must = "must be finite and >= 0"},
  {NUMBER(max_step, "s"), WITHOUT_STEP, .unset = NAN, .most = INFINITY, .may_be_infinite = true,
   .must = "must be > 0"},
  {NUMBER(start_time, "s"), ALWAYS, .least = -INFINITY, .most = INFINITY, .must = "must be finite"},
  {NUMBER(progress_interval, "s"), ALWAYS, .most = INFINITY, .may_be_zero = true,
   .must = "must be finite and >= 0"},
  {NUMBER(tolerance_q, ""), WITH_TOLERANCE, .unset = 1.0, .most = INFINITY,
   .must = "must be > 0 and finite"},
  {NUMBER(tolerance_v, ""), WITH_TOLERANCE, .unset = 1.0, .most = INFINITY,
   .must = "must be > 0 and finite"},
  {NUMBER(tolerance_lambda, ""), ALWAYS, .unset = INFINITY, .most = INFINITY,
   .may_be_infinite = true, .must = "must be > 0"},
};
/* clang-format on */

static baum_status check_range(const number *n, double x)
{
  bool above = x > n->least || (n->may_be_zero && x == 0.0);
  bool below = x < n->most || (n->may_be_infinite && isinf(x));
  return above && below ? BAUM_OK : refuse(n->name, n->unit, x, n->must);
}

static baum_status check_number(const number *n, stepping how, const baum_simulation_options *o)
{
  double x;
  memcpy(&x, (const char *)o + n->offset, sizeof x);
  const char *name = o->integrator->name;
  if (x == n->unset || (isnan(x) && isnan(n->unset))) {
    const bool takes_rtol_for_step =
      n->offset == offsetof(baum_simulation_options, step) && !isnan(o->rtol);
    return !n->required || !n->takes[how]
             ? BAUM_OK
             : baum_i_fail(BAUM_ERR_ARGUMENT,
                           "simulation options: %s is not given, but %s needs it%s", n->name, name,
                           takes_rtol_for_step
                             ? "; rtol is only for integrators with variable steps, such as rk8"
                             : "");
  }
  if (!n->takes[how]) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "simulation options: %s is %g%s%s, but %s %s", n->name, x,
                       n->unit[0] ? " " : "", n->unit, name,
                       isnan(n->unset) ? WHY_NOT[how]
                                       : "has no tolerances here; keep the default 1");
  }
  return check_range(n, x);
}

/* Check all numbers. If a method has both kinds of steps, the kind depends on which number is
 * given. */
static baum_status check_numbers(const baum_simulation_options *o)
{
  const baum_integrator *method = o->integrator;
  stepping how = method->step ? FIXED_STEP : VARIABLE_STEP;
  if (method->without_freedom) {
    how = NO_STEP;
  } else if (method->step && method->advance) {
    if (isnan(o->step) == isnan(o->rtol)) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "simulation options: %s takes either step, for fixed steps, or rtol, for "
                         "variable steps; %s",
                         method->name, isnan(o->step) ? "neither is given" : "both are given");
    }
    how = isnan(o->step) ? VARIABLE_STEP : FIXED_STEP;
  }
  for (size_t k = 0; k < sizeof NUMBERS / sizeof *NUMBERS; k++) {
    BAUM_I_TRY(check_number(&NUMBERS[k], how, o));
  }
  return BAUM_OK;
}

/* ---- choices ---- */

static baum_status check_choices(const baum_simulation_options *o)
{
  if (o->start < BAUM_START_ASSEMBLE || o->start > BAUM_START_AS_GIVEN) {
    return refuse("start", "", (double)o->start, "must be one of baum_start");
  }
  if (o->solver < BAUM_SOLVER_AUTO || o->solver > BAUM_SOLVER_BLOCK) {
    return refuse("solver", "", (double)o->solver, "must be one of baum_solver");
  }
  return o->max_steps > 0 ? BAUM_OK : refuse("max_steps", "", (double)o->max_steps, "must be > 0");
}

/* Check that the integrator offers the formulation. If the formulation is the default, replace it
 * by the integrator's first one. */
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
    baum_i_append(list, sizeof list, "%s%s", k > 0 ? ", " : "", baum_formulation_name(offered[k]));
  }
  const char *name = baum_formulation_name(o->formulation);
  bool projection = o->formulation == BAUM_FORMULATION_PROJECTION;
  const char *why = projection ? o->integrator->why_no_projection : NULL;
  return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                     "simulation options: %s does not offer the formulation %s; it offers %s%s%s",
                     o->integrator->name, name ? name : "with that number",
                     list[0] ? list : "none, because no degree of freedom is left", why ? "; " : "",
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

/* Check tolerance_lambda. It is allowed only at index 1, where multipliers are as smooth as
 * accelerations. In the other formulations, an implicit method's estimate of the error of
 * multipliers does not decrease with the step as fast as it should. */
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
      "its unknowns; keep the default, infinity",
      o->tolerance_lambda, name);
  }
  if (o->formulation == BAUM_FORMULATION_BAUMGARTE ||
      o->formulation == BAUM_FORMULATION_UNSTABILIZED) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "simulation options: tolerance_lambda is %g, but with the formulation %s the "
                     "error of multipliers cannot be tested, because its estimate grows as steps "
                     "shrink; keep the default, infinity, or choose baumgarte or unstabilized",
                     o->tolerance_lambda, baum_formulation_name(o->formulation));
}

/* The second integration of error_check needs a smaller tolerance than the run, but at least 1e-14,
 * below which rounding errors dominate. */
static const double LEAST_RTOL_WITH_CHECK = 2e-14;

static baum_status check_error_check(const baum_simulation_options *o)
{
  if (!o->error_check) {
    return BAUM_OK;
  }
  if (o->integrator->without_freedom) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "simulation options: error_check is set, but %s does not integrate",
                       o->integrator->name);
  }
  return o->rtol < LEAST_RTOL_WITH_CHECK
           ? refuse("rtol", "", o->rtol, "must be at least 2e-14 with error_check")
           : BAUM_OK;
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
  BAUM_I_TRY(check_numbers(options));
  BAUM_I_TRY(check_choices(options));
  BAUM_I_TRY(check_pair(options));
  BAUM_I_TRY(check_multipliers(options));
  BAUM_I_TRY(check_gains(options));
  BAUM_I_TRY(check_row_gains(options));
  BAUM_I_TRY(check_error_check(options));
  return check_built_in(options->integrator);
}
