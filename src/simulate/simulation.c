/* SPDX-License-Identifier: BSD-3-Clause */
/* Creates and destroys a run, and returns its present state. */
#include <math.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "mechanism/definition.h"
#include "mechanism/general/check.h"
#include "mechanism/general/driven.h"
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/crossing.h"
#include "simulate/events.h"
#include "simulate/options.h"

/* ---- memory ---- */

static baum_status make_states(baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  size_t nq = (size_t)m->nq;
  size_t nv = (size_t)m->nv;
  run->memory = baum_i_alloc(4 * (nq + nv) + nv, sizeof(double));
  BAUM_I_TRY(baum_i_check_memory(run->memory));
  double *next = run->memory;
  baum_i_state *states[4] = {&run->state, &run->ahead, &run->trial, &run->spare};
  for (int k = 0; k < 4; k++) {
    states[k]->q = next;
    states[k]->v = next + nq;
    next += nq + nv;
  }
  run->acceleration = next;
  return BAUM_OK;
}

/* ---- equations ---- */

/* Choose the problem at the start: find the fastest rate, then the gains. Refuse a start at which
 * accelerations cannot be found. */
static baum_status choose_problem(baum_simulation *run)
{
  const baum_simulation_options *o = &run->options;
  const baum_i_state *start = &run->trial;
  double portion = baum_i_integrator_portion(o->integrator, o->rtol);
  baum_i_problem *p = &run->problem;
  *p = (baum_i_problem){
    .workspace = run->workspace,
    .formulation = o->formulation,
    .direction = 1.0,
    .step = o->step,
    .rtol = o->rtol,
    .atol = isnan(o->atol) ? 0.0 : o->atol,
    .max_step = isnan(o->max_step) ? (double)INFINITY : o->max_step,
    .tolerance_q = portion * o->tolerance_q,
    .tolerance_v = portion * o->tolerance_v,
    .tolerance_lambda = portion * o->tolerance_lambda,
  };
  BAUM_I_TRY(baum_i_acceleration(run->workspace, start->t, start->q, start->v, 0.0, 0.0));
  BAUM_I_TRY(baum_i_check_sizes(run->workspace, "acceleration", run->workspace->a));
  double rate = baum_i_run_start_rate(run);
  if (!isfinite(rate)) {
    return baum_i_fail(
      BAUM_ERR_NOT_FINITE,
      "t = %.9g s: gravity is too large for double precision relative to the size of the mechanism",
      start->t);
  }
  p->rate = rate > 0.0 ? rate : 1.0;
  return baum_i_run_choose_gains(run);
}

/* ---- warnings that are known at the start ---- */

static baum_status warn_redundancy(baum_simulation *run)
{
  baum_workspace *w = run->workspace;
  const baum_i_row_set *r = &w->rows;
  const baum_i_state *start = &run->trial;
  if (r->count > 0) {
    char names[160];
    BAUM_I_TRY(baum_i_reported_acceleration(w, start->t, start->q, start->v));
    BAUM_I_TRY(baum_i_redundancy_text(w, names, sizeof names));
    baum_i_run_warn(
      run, BAUM_WARNING_REDUNDANT_ROWS, start->t, BAUM_I_NO_JOINT,
      "%d redundant constraint %s among %s: accelerations are correct, but multipliers and "
      "reactions of these joints are not unique; the run reports those of least norm",
      r->count, r->count == 1 ? "row" : "rows", names);
  }
  if (w->mechanism->nc > 0 && r->rank_at_start < r->rank) {
    baum_i_run_warn(
      run, BAUM_WARNING_SINGULAR_START, start->t, BAUM_I_NO_JOINT,
      "the start configuration is singular, or nearly so: it has %d independent constraint rows, "
      "and configurations near it have %d",
      r->rank_at_start, r->rank);
  }
  return BAUM_OK;
}

double baum_i_difference_noise(const baum_mechanism *m)
{
  double noise = 0.0;
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_joint *joint = m->joints[k];
    if (joint->type->noise) {
      noise = fmax(noise, joint->type->noise(joint->element.def));
    }
  }
  return noise;
}

static void warn_settings(baum_simulation *run)
{
  double noise = baum_i_difference_noise(run->workspace->mechanism);
  if (run->options.rtol < noise) {
    baum_i_run_warn(run, BAUM_WARNING_NOISY_DERIVATIVES, run->trial.t, BAUM_I_NO_JOINT,
                    "rtol %.1g is below %.1g, which is approximately the error of the finite "
                    "differences of user constraints; provide jacobian() and gamma(), or take a "
                    "larger rtol",
                    run->options.rtol, noise);
  }
  bool variable = !baum_i_run_has_fixed_step(run);
  if (run->options.formulation == BAUM_FORMULATION_INDEX3 && variable) {
    baum_i_run_warn(
      run, BAUM_WARNING_INDEX3, run->trial.t, BAUM_I_NO_JOINT,
      "index 3 is meant for comparison: its velocities are not in the error test, and "
      "the error of the motion is far above rtol; take ggl");
  }
}

/* ---- create ---- */

/* Choose the omitted rows at the initial configuration, and use the block solver if it suits the
 * mechanism with the active rows. */
static baum_status choose_solver(baum_simulation *run)
{
  baum_workspace *w = run->workspace;
  const baum_i_state *start = &run->trial;
  w->blocks_only = run->options.solver == BAUM_SOLVER_BLOCK;
  BAUM_I_TRY(baum_i_find_rows(w, start->t, start->q));
  return baum_i_use_blocks(w);
}

static baum_status accept_start(baum_simulation *run)
{
  double energy = 0.0;
  BAUM_I_TRY(baum_i_run_measure(run, &energy));
  baum_i_run_accept(run, energy);
  run->fingerprint = baum_i_mechanism_fingerprint(run->workspace->mechanism);
  return BAUM_OK;
}

/* Prepare all parts of a run. Each call uses the results of the calls before it. */
static baum_status prepare(baum_simulation *run, const baum_mechanism *m)
{
  const baum_simulation_options *o = &run->options;
  const baum_i_kkt_choice choice = o->solver == BAUM_SOLVER_KLU  ? BAUM_I_KKT_KLU
                                   : o->solver == BAUM_SOLVER_QR ? BAUM_I_KKT_QR
                                                                 : BAUM_I_KKT_AUTO;
  run->counters.error_estimate = (double)NAN;
  run->has_functions = baum_i_has_checked_functions(m);
  BAUM_I_TRY(o->check_derivatives ? baum_mechanism_check_derivatives(m) : BAUM_OK);
  BAUM_I_TRY(baum_i_workspace_create(m, choice, &run->workspace));
  BAUM_I_TRY(make_states(run));
  baum_i_hold_angles(&run->workspace->point, o->start_time);
  BAUM_I_TRY(baum_i_expect_driven_angles(&run->workspace->point, o->start_time));
  BAUM_I_TRY(baum_i_run_start(run, o->start_time, m->design_q, m->design_v));
  BAUM_I_TRY(choose_solver(run));
  BAUM_I_TRY(baum_i_run_check_velocities(run));
  BAUM_I_TRY(choose_problem(run));
  BAUM_I_TRY(o->energy_account ? baum_i_account_create(run) : BAUM_OK);
  BAUM_I_TRY(run->integrator->without_freedom ? BAUM_OK : baum_i_crossings_create(run));
  BAUM_I_TRY(baum_i_integrator_create(run->integrator, &run->problem, &run->trial, &run->self));
  BAUM_I_TRY(baum_i_companion_is_wanted(run) ? baum_i_companion_create(run) : BAUM_OK);
  BAUM_I_TRY(warn_redundancy(run));
  warn_settings(run);
  return accept_start(run);
}

baum_status baum_simulation_create(const baum_mechanism *mechanism,
                                   const baum_simulation_options *options, baum_simulation **out)
{
  const char *call = "baum_simulation_create";
  BAUM_I_TRY(baum_i_check_given(call, "out", out != NULL));
  *out = NULL;
  BAUM_I_TRY(baum_i_check_frozen(mechanism, call));
  BAUM_I_TRY(baum_i_check_given(call, "options", options != NULL));
  baum_simulation_options checked = baum_simulation_options_default();
  BAUM_I_TRY(baum_i_take_sized(&checked, sizeof checked, options, call, " of the options",
                               "baum_simulation_options_default()"));
  BAUM_I_TRY(baum_i_options_check(&checked));
  baum_simulation *run = baum_i_alloc(1, sizeof *run);
  BAUM_I_TRY(baum_i_check_memory(run));
  run->options = checked;
  run->integrator = checked.integrator;
  run->time_limit = (double)INFINITY;
  run->deadline = (double)INFINITY;
  atomic_init(&run->cancelled, 0);
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = baum_i_message_settle(prepare(run, mechanism), &kept);
  if (status != BAUM_OK) {
    baum_simulation_destroy(run);
    return status;
  }
  baum_i_run_explain(run);
  *out = run;
  return BAUM_OK;
}

/* Tell whether the run is calling a user function. The run may still be incomplete. */
static bool is_in_use(const baum_simulation *run)
{
  bool asks = run->workspace && run->workspace->point.asking;
  for (int k = 0; k < 2; k++) {
    asks = asks || (run->beside[k] && run->beside[k]->point.asking);
  }
  return run->reporting || asks;
}

void baum_simulation_destroy(baum_simulation *simulation)
{
  if (!simulation || is_in_use(simulation)) {
    return;
  }
  baum_i_integrator_destroy(simulation->integrator, simulation->self);
  baum_i_companion_destroy(simulation->companion);
  baum_i_account_destroy(simulation->integrator, simulation->account);
  baum_i_events_destroy(simulation->events);
  baum_i_crossings_destroy(simulation->crossings);
  baum_workspace_destroy(simulation->workspace);
  baum_i_free(simulation->memory);
  baum_i_free(simulation->parameters);
  baum_i_free(simulation->schedule.jumps);
  baum_i_free(simulation->row_gains);
  baum_i_free(simulation);
}

/* ---- present state ---- */

double baum_simulation_time(const baum_simulation *simulation)
{
  return simulation ? simulation->state.t : (double)NAN;
}

const double *baum_simulation_q(const baum_simulation *simulation)
{
  return simulation ? simulation->state.q : NULL;
}

const double *baum_simulation_v(const baum_simulation *simulation)
{
  return simulation ? simulation->state.v : NULL;
}

const char *baum_simulation_explain(const baum_simulation *simulation)
{
  return simulation ? simulation->explain : NULL;
}

const char *baum_simulation_message(const baum_simulation *simulation)
{
  return simulation ? simulation->message : NULL;
}
