/* SPDX-License-Identifier: BSD-3-Clause */
/* Chooses the gains of a run. The gain rule `auto` requires the rate of the motion, which is found
 * first. */
#include <math.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/definition.h"
#include "simulate/run.h"

/* [1/s] In a mechanism without gravity, accelerations count as rounding errors if sqrt(|a| / scale)
 * is below this. With gravity, AT_REST gives the limit. */
static const double ROUNDING_RATE = 1e-7;
/* The same limit for mechanisms with gravity, relative to the rate at which gravity makes the
 * mechanism swing. */
static const double AT_REST = 1e-3;

double baum_i_rest_rate(const baum_mechanism *m)
{
  static const double OF_SWING = 1e-10;
  double swing = baum_i_swing_rate(m);
  return swing > 0.0 ? OF_SWING * swing : ROUNDING_RATE;
}

/* When a mechanism is at rest in an equilibrium, its accelerations are only rounding errors and
 * give no rate. The function then returns the rate at which gravity makes the mechanism swing, or 0
 * without gravity. */
double baum_i_run_start_rate(const baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double rate = baum_i_state_rate(m, run->trial.v, run->workspace->a);
  double swing = baum_i_swing_rate(m);
  if (rate < AT_REST * swing) {
    return swing;
  }
  return swing > 0.0 || rate > ROUNDING_RATE ? rate : 0.0;
}

/* Find the rate of the motion. For a mechanism that hardly moves, it is the rate at which gravity
 * makes the mechanism swing. */
static void measure_rate(baum_simulation *run, baum_i_gain_context *context)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double swing = baum_i_swing_rate(m);
  double now = baum_i_state_rate(m, run->trial.v, run->workspace->a);
  context->driven = m->nc > 0 && run->workspace->rows.rank == m->nv;
  context->rate = baum_i_run_start_rate(run);
  context->rate_is = "the rate at which gravity swings it";
  if (now < AT_REST * swing || context->rate == 0.0) {
    return;
  }
  context->rate = baum_i_run_pilot(run, swing);
  if (context->driven || context->rate >= swing) {
    context->rate_is = "the mean rate over a pilot run";
  } else {
    context->rate = swing;
  }
}

/* ---- factors of rows ---- */

static baum_status check_factor(const baum_simulation *run, int row)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double f = run->options.row_gains[row];
  if (f > 0.0 && isfinite(f)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "simulation options: row_gains[%d], of %s, is %g, must be finite and > 0", row,
                     baum_i_row_label(m, row).text, f);
}

static baum_status copy_row_gains(baum_simulation *run)
{
  baum_simulation_options *o = &run->options;
  int nc = run->workspace->mechanism->nc;
  if (o->row_gain_count != nc) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "simulation options: row_gain_count is %d, must be nc = %d, the number of "
                       "constraint rows",
                       (int)o->row_gain_count, nc);
  }
  for (int i = 0; i < nc; i++) {
    BAUM_I_TRY(check_factor(run, i));
  }
  run->row_gains = baum_i_alloc(2 * (size_t)nc, sizeof *run->row_gains);
  if (!run->row_gains) {
    return baum_i_fail_memory();
  }
  const double *own = run->workspace->mechanism->row_gains;
  for (int i = 0; i < nc; i++) {
    run->row_gains[i] = o->row_gains[i];
    run->row_gains[nc + i] = o->row_gains[i] * (own ? own[i] : 1.0);
  }
  o->row_gains = run->row_gains;
  run->workspace->row_gains = run->row_gains + nc;
  return BAUM_OK;
}

/* Update run->gains with the choice for one row, such that it contains the worst amplification and
 * the smallest step limit of all rows. */
static void keep_worse(baum_simulation *run, const baum_i_gain_choice *own)
{
  baum_i_gain_choice *all = &run->gains;
  if (own->amplification.spectral_radius > all->amplification.spectral_radius) {
    all->amplification = own->amplification;
  }
  all->max_step = fmin(all->max_step, own->max_step);
}

/* The gains that result from a factor of row_gains were refused. Add the name of the row to the
 * message. */
static baum_status name_row(const baum_simulation *run, int row, baum_status status)
{
  return baum_i_fail(status, "row_gains[%d] = %g, of %s: %s", row, run->row_gains[row],
                     baum_i_row_label(run->workspace->mechanism, row).text, baum_message());
}

/* Check the gains of all rows. Successive rows that have the same factor and are all of position
 * level, or all of velocity level, are checked only once. */
static baum_status judge_row_gains(baum_simulation *run, const baum_i_gain_context *context)
{
  const baum_mechanism *m = run->workspace->mechanism;
  baum_i_gain_context of_row = *context;
  double last = 1.0;
  for (int i = 0; i < m->nc; i++) {
    double f = run->row_gains[i];
    bool velocity = baum_i_is_velocity_row(m, i);
    if (f == last && velocity == of_row.no_position_rows) {
      continue;
    }
    last = f;
    of_row.velocity_rows = of_row.no_position_rows = velocity;
    const baum_gains gains = baum_gains_fixed(f * run->gains.alpha, f * run->gains.beta);
    baum_i_gain_choice own;
    baum_status status = baum_i_gains_choose(&gains, &of_row, &own);
    if (status != BAUM_OK) {
      return name_row(run, i, status);
    }
    keep_worse(run, &own);
    if (own.doubtful) {
      int joint = baum_i_row_joint(m, i);
      baum_i_run_warn(run, BAUM_WARNING_GAINS, run->trial.t, joint,
                      "with the factor %g of row_gains: %s", f, own.why);
    }
  }
  return BAUM_OK;
}

/* ---- the choice ---- */

baum_status baum_i_run_choose_gains(baum_simulation *run)
{
  const baum_simulation_options *o = &run->options;
  const baum_mechanism *m = run->workspace->mechanism;
  baum_i_problem *problem = &run->problem;
  if (o->formulation != BAUM_FORMULATION_BAUMGARTE) {
    return BAUM_OK;
  }
  baum_i_gain_context context = {
    .method = &run->integrator->method,
    .family = run->integrator->family,
    .integrator = run->integrator->name,
    .step = o->step,
    .rule_default = run->integrator->gains,
    .allow_unstable = o->allow_unstable,
    .velocity_rows = m->velocity_row_count > 0,
    .no_position_rows = m->velocity_row_count > 0 && m->velocity_row_count == m->nc,
  };
  int32_t rule =
    o->gains.rule == BAUM_GAINS_DEFAULT ? (int32_t)run->integrator->gains : o->gains.rule;
  if (rule == BAUM_GAINS_AUTO) {
    measure_rate(run, &context);
  }
  BAUM_I_TRY(o->row_gains ? copy_row_gains(run) : BAUM_OK);
  BAUM_I_TRY(baum_i_gains_choose(&o->gains, &context, &run->gains));
  if (run->row_gains) {
    BAUM_I_TRY(judge_row_gains(run, &context));
  }
  problem->alpha = run->gains.alpha;
  problem->beta = run->gains.beta;
  problem->max_step = fmin(problem->max_step, run->gains.max_step);
  if (run->gains.doubtful) {
    baum_i_run_warn(run, BAUM_WARNING_GAINS, run->trial.t, BAUM_I_NO_JOINT, "%s", run->gains.why);
  }
  return BAUM_OK;
}
