/* SPDX-License-Identifier: BSD-3-Clause */
/* Tries one step, or finds a state inside the last step. The result is the trial state, which is
 * checked, and projected if the formulation includes projection. */
#include <math.h>
#include <string.h>

#include "base/hot.h"
#include "base/measure.h"
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/crossing.h"
#include "simulate/events.h"

static baum_status fail_not_finite(const baum_simulation *run, const baum_i_state *state)
{
  return baum_i_fail(BAUM_ERR_NOT_FINITE,
                     "t = %.9g s: the step to %.9g s gives values that are not finite: the "
                     "motion grows without bound; take a smaller step, or stable gains",
                     run->state.t, state->t);
}

static baum_status check_finite(const baum_simulation *run, const baum_i_state *state)
{
  const baum_mechanism *m = run->workspace->mechanism;
  const baum_i_measure_kernel *kernel = BAUM_I_HOT_TABLE(m->wide, baum_i_measure_kernel);
  return kernel->is_finite(m->nq + m->nv, state->q) ? BAUM_OK : fail_not_finite(run, state);
}

/* Add the time to the message of a failed callback, because this message does not contain the
 * time. */
static baum_status explain(baum_simulation *run, baum_status status)
{
  if (status == BAUM_OK) {
    return BAUM_OK;
  }
  if (status == BAUM_ERR_CALLBACK) {
    bool retry = run->workspace->point.retry;
    (void)baum_i_fail(status, "t = %.9g s: %.600s%s%s%s", run->state.t, baum_message(),
                      retry ? "; " : "", retry ? run->integrator->name : "",
                      retry ? " cannot take a smaller step" : "");
  }
  return baum_i_run_explain_failure(run, status, &run->state);
}

/* Take a step from the present state, whose acceleration is known, to t_next. */
static baum_status step_to(baum_simulation *run, double t_next)
{
  const baum_i_state *state = &run->state;
  baum_i_state *trial = &run->trial;
  BAUM_I_TRY(baum_i_run_limit_acceleration(run));
  baum_i_run_copy(run, state, trial);
  BAUM_I_TRY(
    run->integrator->step(run->self, &run->problem, trial, t_next - state->t, run->acceleration));
  trial->t = t_next;
  BAUM_I_TRY(check_finite(run, trial));
  if (run->problem.formulation == BAUM_FORMULATION_PROJECTION) {
    BAUM_I_TRY(baum_i_run_project(run, t_next));
  }
  if (run->account) {
    baum_i_account_step(run);
  }
  return BAUM_OK;
}

baum_status baum_i_run_try_step(baum_simulation *run, double t_next, bool observe)
{
  const baum_i_state *state = &run->state;
  baum_status status = baum_i_problem_motion(&run->problem, state->t, state->q, state->v);
  if (status != BAUM_OK) {
    return explain(run, status);
  }
  if (observe) {
    baum_i_crossings_note(run, state);
    baum_i_run_observe(run, state->t, true);
    baum_i_companion_follow(run, state);
  }
  memcpy(run->acceleration, run->workspace->a,
         (size_t)run->workspace->mechanism->nv * sizeof *run->acceleration);
  return explain(run, step_to(run, t_next));
}

baum_status baum_i_run_try_own_step(baum_simulation *run)
{
  baum_i_run_copy(run, &run->ahead, &run->trial);
  if (run->events) {
    run->events->from = run->ahead.t;
  }
  run->problem.stop = baum_i_run_next_break(run).near;
  run->problem.stops = isfinite(run->problem.stop);
  baum_status status = run->integrator->advance(run->self, &run->problem, &run->trial);
  BAUM_I_TRY(baum_i_run_explain_failure(run, status, &run->ahead));
  return check_finite(run, &run->trial);
}

baum_status baum_i_run_inside(baum_simulation *run, double t)
{
  BAUM_I_TRY(run->integrator->interpolate(run->self, &run->problem, t, run->trial.q, run->trial.v));
  run->trial.t = t;
  BAUM_I_TRY(check_finite(run, &run->trial));
  return run->problem.formulation == BAUM_FORMULATION_PROJECTION
           ? baum_i_project(run->workspace, t, run->trial.q, run->trial.v)
           : BAUM_OK;
}
