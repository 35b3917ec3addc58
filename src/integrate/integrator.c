/* SPDX-License-Identifier: BSD-3-Clause */
/* What all integrators share: facts about one, the accelerations and tolerances it works with, and the public
 * questions about stability. Names no integrator, so that a program links only those it calls.
 *
 * Tolerances of coordinate i with scale s_i (a length or an angle), rate w = 1/T and present size |v|:
 *   position  f_q (rtol s_i + atol)
 *   velocity  f_v (rtol s_i max(w, max_k |v_k| / s_k) + atol)
 * so that neither the number of turns of a crank nor the choice of units makes a difference.
 */
#include "integrate/integrator.h"

#include <math.h>
#include <string.h>

#include "base/message.h"

/* ---- facts ---- */

const char *baum_integrator_name(const baum_integrator *integrator)
{
  return integrator ? integrator->name : NULL;
}

int32_t baum_integrator_order(const baum_integrator *integrator)
{
  return integrator ? integrator->order : 0;
}

bool baum_integrator_has_fixed_step(const baum_integrator *integrator)
{
  return integrator && integrator->step;
}

bool baum_integrator_has_variable_step(const baum_integrator *integrator)
{
  return integrator && integrator->advance && !integrator->without_freedom;
}

bool baum_integrator_offers(const baum_integrator *integrator, baum_formulation formulation)
{
  return integrator && baum_i_integrator_offers(integrator, formulation);
}

/* The default is always offered. */
bool baum_i_integrator_offers(const baum_integrator *integrator, baum_formulation formulation)
{
  const baum_formulation *offered = integrator->formulations;
  while (*offered != BAUM_FORMULATION_DEFAULT && *offered != formulation) {
    offered++;
  }
  return *offered == formulation;
}

const char *baum_formulation_name(baum_formulation formulation)
{
  switch (formulation) {
  case BAUM_FORMULATION_DEFAULT: return "default";
  case BAUM_FORMULATION_UNSTABILIZED: return "unstabilized";
  case BAUM_FORMULATION_BAUMGARTE: return "baumgarte";
  case BAUM_FORMULATION_PROJECTION: return "projection";
  case BAUM_FORMULATION_INDEX2: return "index2";
  case BAUM_FORMULATION_GGL: return "ggl";
  case BAUM_FORMULATION_INDEX3: return "index3";
  default: return NULL;
  }
}

/* ---- what integrators work with ---- */

baum_status baum_i_problem_acceleration(const baum_i_problem *problem, double t, const double *q,
                                        const double *v)
{
  bool stabilized = problem->formulation == BAUM_FORMULATION_BAUMGARTE;
  double alpha = stabilized ? problem->direction * problem->alpha : 0.0;
  return baum_i_acceleration(problem->workspace, t, q, v, alpha, stabilized ? problem->beta : 0.0);
}

baum_status baum_i_problem_motion(const baum_i_problem *problem, double t, const double *q,
                                  const double *v)
{
  bool stabilized = problem->formulation == BAUM_FORMULATION_BAUMGARTE;
  double alpha = stabilized ? problem->direction * problem->alpha : 0.0;
  return baum_i_motion(problem->workspace, t, q, v, alpha, stabilized ? problem->beta : 0.0);
}

bool baum_i_problem_has_fixed_step(const baum_i_problem *problem)
{
  return !isnan(problem->step);
}

/* With fixed steps only who accepts them keeps something of them. */
bool baum_i_integrator_remembers(const baum_integrator *integrator, const baum_i_problem *problem)
{
  return integrator->restart && (integrator->accept || !baum_i_problem_has_fixed_step(problem));
}

void baum_i_problem_tolerances(const baum_i_problem *problem, const double *v, double *tolerance_q,
                               double *tolerance_v)
{
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  double rate = problem->rate;
  for (int i = 0; i < mechanism->nv; i++) {
    rate = fmax(rate, fabs(v[i]) / mechanism->scale[i]);
  }
  for (int i = 0; i < mechanism->nv; i++) {
    double tolerance = problem->rtol * mechanism->scale[i];
    tolerance_q[i] = problem->tolerance_q * (tolerance + problem->atol);
    tolerance_v[i] = problem->tolerance_v * (tolerance * rate + problem->atol);
  }
}

/* ---- stability ---- */

static baum_status check_integrator(const baum_integrator *integrator)
{
  if (integrator) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "integrator is NULL, must be one such as baum_euler()");
}

static baum_status check_fixed_step(const baum_integrator *integrator)
{
  baum_status status = check_integrator(integrator);
  if (status != BAUM_OK || integrator->method.kind != BAUM_I_METHOD_VARIABLE_STEP) {
    return status;
  }
  return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                     "%s chooses its step, so it has no fixed region of stability",
                     integrator->name);
}

static baum_status check_point(double alpha_h, double beta2_h2)
{
  if (!isfinite(alpha_h)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "alpha_h is %g, must be finite", alpha_h);
  }
  if (!isfinite(beta2_h2)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "beta2_h2 is %g, must be finite", beta2_h2);
  }
  return BAUM_OK;
}

static baum_status check_out(const void *out, const char *name)
{
  if (out) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s is NULL", name);
}

static baum_status check_pair(const void *first, const char *first_name, const void *second,
                              const char *second_name)
{
  baum_status status = check_out(first, first_name);
  return status == BAUM_OK ? check_out(second, second_name) : status;
}

baum_status baum_stability_at(const baum_integrator *integrator, double alpha_h, double beta2_h2,
                              baum_amplification *out, size_t caller_size)
{
  baum_status status = check_integrator(integrator);
  if (status == BAUM_OK) {
    status = check_point(alpha_h, beta2_h2);
  }
  if (status == BAUM_OK) {
    status = check_out(out, "out");
  }
  if (status != BAUM_OK) {
    return status;
  }
  if (caller_size < sizeof(size_t)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "caller_size is %zu, must be sizeof *out", caller_size);
  }
  baum_amplification amplification;
  memset(&amplification, 0, sizeof amplification);
  baum_i_amplification(&integrator->method, alpha_h, beta2_h2, &amplification);
  size_t size = caller_size < sizeof amplification ? caller_size : sizeof amplification;
  amplification.struct_size = size;
  memcpy(out, &amplification, size);
  return BAUM_OK;
}

baum_status baum_stability_limit(const baum_integrator *integrator, double damping_ratio,
                                 double *alpha_h)
{
  baum_status status = check_fixed_step(integrator);
  if (status == BAUM_OK) {
    status = check_out(alpha_h, "alpha_h");
  }
  if (status != BAUM_OK) {
    return status;
  }
  if (!(damping_ratio > 0) || !isfinite(damping_ratio)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "damping_ratio is %g, must be > 0 and finite",
                       damping_ratio);
  }
  *alpha_h = baum_i_stability_limit(&integrator->method, damping_ratio);
  return BAUM_OK;
}

baum_status baum_stability_deadbeat(const baum_integrator *integrator, double *alpha_h,
                                    double *beta2_h2)
{
  baum_status status = check_fixed_step(integrator);
  if (status == BAUM_OK) {
    status = check_pair(alpha_h, "alpha_h", beta2_h2, "beta2_h2");
  }
  if (status == BAUM_OK) {
    baum_i_stability_deadbeat(&integrator->method, alpha_h, beta2_h2);
  }
  return status;
}

baum_status baum_stability_nearest(const baum_integrator *integrator, double alpha_h,
                                   double beta2_h2, double *good_alpha_h, double *good_beta2_h2)
{
  baum_status status = check_fixed_step(integrator);
  if (status == BAUM_OK) {
    status = check_point(alpha_h, beta2_h2);
  }
  if (status == BAUM_OK) {
    status = check_pair(good_alpha_h, "good_alpha_h", good_beta2_h2, "good_beta2_h2");
  }
  if (status == BAUM_OK) {
    baum_i_stability_nearest(&integrator->method, alpha_h, beta2_h2, good_alpha_h, good_beta2_h2);
  }
  return status;
}
