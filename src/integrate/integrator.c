/* SPDX-License-Identifier: BSD-3-Clause */
/* Common functions of all integrators: properties, memory, accelerations and tolerances. This file
 * refers to no integrator, so a program links only the integrators that it calls.
 *
 * Let s_i be the scale of coordinate i (q and v have separate scales), w = 1/T the rate of the
 * problem, and f_q and f_v its factors tolerance_q and tolerance_v. The tolerances are
 *
 *   position  f_q (rtol s_i + atol)
 *   velocity  f_v (rtol s_i max(w, max_k |v_k| / s_k) + atol)
 *
 * They depend neither on the number of revolutions of a crank nor on the units.
 *
 * The error tests of BDF methods use a fraction of rtol and atol, so that runs at the same rtol
 * have about the same error with every method:
 *
 * - If the past steps are exact, a step of order q has the error h^(q+1) y^(q+1) / ((q+1) alpha_0)
 *   with alpha_0 = 1 + 1/2 + ... + 1/q. The past steps have errors, too, so the step adds alpha_0
 *   times this error to the error of the motion (E. Hairer, S. Norsett, G. Wanner, Solving Ordinary
 *   Differential Equations I, 1993, III.2: the error constant). CVODE tests the first of these
 *   errors. IDA tests alpha_0 times this error. At order 5, which both nearly always use, alpha_0
 *   is 137/60.
 * - The order is at most 5, and BDF takes up to three times as many steps as Adams methods, so more
 *   errors add up. With a third of the tolerance, IDA and CVODE's BDF have at most about the error
 *   of Adams methods at the same rtol, in energies, times of events and positions. With the full
 *   tolerance, they have up to six times that error. The smaller tolerance multiplies the number of
 *   steps by 1.2 for IDA and by 1.33 for CVODE (docs/theory/energy.md).
 *
 * Below LEAST_RTOL, where rounding matters, a smaller tolerance would only increase the number of
 * steps. */
#include "integrate/integrator.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/text.h"

/* Steps that differ by less than this fraction are treated as equal. Such a difference changes the
 * error of a step by a fraction of about 1e-6. The fraction is far above the rounding of times. */
static const double SAME_STEP = 1e-6;

static const double BDF_PORTION = 1.0 / 3.0;
static const double LEAST_RTOL = 1e-13;

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

/* BAUM_FORMULATION_DEFAULT is always offered. */
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
  static const char *const NAMES[] = {
    [BAUM_FORMULATION_DEFAULT] = "default",     [BAUM_FORMULATION_UNSTABILIZED] = "unstabilized",
    [BAUM_FORMULATION_BAUMGARTE] = "baumgarte", [BAUM_FORMULATION_PROJECTION] = "projection",
    [BAUM_FORMULATION_INDEX2] = "index2",       [BAUM_FORMULATION_GGL] = "ggl",
    [BAUM_FORMULATION_INDEX3] = "index3",
  };
  size_t k = (size_t)formulation;
  return k < sizeof NAMES / sizeof *NAMES ? NAMES[k] : NULL;
}

/* ---- memory of a run ---- */

baum_status baum_i_integrator_create(const baum_integrator *integrator,
                                     const baum_i_problem *problem, const baum_i_state *start,
                                     void **out)
{
  *out = NULL;
  if (!integrator->open) {
    return BAUM_OK;
  }
  void *self = baum_i_alloc(1, integrator->memory);
  BAUM_I_TRY(baum_i_check_memory(self));
  baum_status status = integrator->open(self, integrator->table, problem, start);
  if (status != BAUM_OK) {
    baum_i_integrator_destroy(integrator, self);
    return status;
  }
  *out = self;
  return BAUM_OK;
}

void baum_i_integrator_destroy(const baum_integrator *integrator, void *self)
{
  if (self) {
    integrator->close(self);
    baum_i_free(self);
  }
}

/* ---- accelerations and tolerances ---- */

void baum_i_problem_gains(const baum_i_problem *problem, double *alpha, double *beta)
{
  bool stabilized = problem->formulation == BAUM_FORMULATION_BAUMGARTE;
  *alpha = stabilized ? problem->direction * problem->alpha : 0.0;
  *beta = stabilized ? problem->beta : 0.0;
}

baum_status baum_i_problem_acceleration(const baum_i_problem *problem, double t, const double *q,
                                        const double *v)
{
  double alpha;
  double beta;
  baum_i_problem_gains(problem, &alpha, &beta);
  return baum_i_acceleration(problem->workspace, t, q, v, alpha, beta);
}

baum_status baum_i_problem_motion(const baum_i_problem *problem, double t, const double *q,
                                  const double *v)
{
  double alpha;
  double beta;
  baum_i_problem_gains(problem, &alpha, &beta);
  return baum_i_motion(problem->workspace, t, q, v, alpha, beta);
}

bool baum_i_problem_has_fixed_step(const baum_i_problem *problem)
{
  return !isnan(problem->step);
}

bool baum_i_problem_is_grid_step(const baum_i_problem *problem, double t, double h)
{
  double off = fabs(h - problem->direction * problem->step);
  return off <= SAME_STEP * problem->step + 4.0 * DBL_EPSILON * fabs(t);
}

/* With a fixed step, only methods that have the operation `accept` use past steps. */
bool baum_i_integrator_remembers(const baum_integrator *integrator, const baum_i_problem *problem)
{
  return integrator->restart && (integrator->accept || !baum_i_problem_has_fixed_step(problem));
}

baum_status baum_i_fail_in_step(baum_status status, const char *message, const char *integrator,
                                double t, double h)
{
  const baum_i_text length =
    h != 0.0 ? baum_i_text_of(", %.3g s long", fabs(h)) : (baum_i_text){""};
  return baum_i_fail(status, "%.800s (in a step of %s from t = %.9g s%s)", message, integrator, t,
                     length.text);
}

baum_status baum_i_fail_iteration(const char *integrator, const char *what, double t, double size)
{
  return baum_i_fail(
    BAUM_ERR_CONVERGENCE,
    "t = %.9g s: %s: %s of the next step do not converge (last change %.3g times "
    "the scale): the step is too large or the configuration is near a singular one",
    t, integrator, what, size);
}

double baum_i_integrator_portion(const baum_integrator *integrator, double rtol)
{
  double portion = integrator->seen > 0.0 ? BDF_PORTION * integrator->seen : 1.0;
  return fmax(portion, fmin(LEAST_RTOL / rtol, 1.0));
}

void baum_i_problem_tolerances(const baum_i_problem *problem, const double *v, double *tolerance_q,
                               double *tolerance_v)
{
  const baum_mechanism *mechanism = problem->workspace->mechanism;
  double rate = fmax(problem->rate, baum_i_scaled_size(mechanism, v));
  for (int i = 0; i < mechanism->nq; i++) {
    double tolerance = problem->rtol * mechanism->position_scale[i];
    tolerance_q[i] = problem->tolerance_q * (tolerance + problem->atol);
  }
  for (int i = 0; i < mechanism->nv; i++) {
    double tolerance = problem->rtol * mechanism->scale[i];
    tolerance_v[i] = problem->tolerance_v * (tolerance * rate + problem->atol);
  }
}

double baum_i_row_sizes(baum_workspace *workspace, const double *rows, int *row)
{
  int nc = workspace->mechanism->nc;
  double *size = workspace->work_c;
  double largest = 0.0;
  baum_i_row_displacements(workspace, size);
  for (int i = 0; i < nc; i++) {
    size[i] = fabs(rows[i]) / size[i];
  }
  *row = baum_i_largest(size, nc, &largest);
  return largest;
}
