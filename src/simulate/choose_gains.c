/* SPDX-License-Identifier: BSD-3-Clause */
/* Gains of a run, and the rate of the motion that the rule `auto` goes by. */
#include <math.h>

#include "simulate/run.h"

/* [1/s] sqrt(|a| / scale) of accelerations that are rounding: below it nothing is known to move. */
static const double ROUNDING_RATE = 1e-7;
static const double AT_REST = 1e-3; /* of the rate at which gravity swings it */

/* What gravity makes of a mechanism of this size that is free. */
static double swing_rate(const baum_mechanism *m)
{
  return sqrt(hypot(m->gravity[0], m->gravity[1]) / m->length);
}

/* At rest in an equilibrium the accelerations are rounding only: then gravity tells how fast the
 * mechanism would swing, and without it nothing does. */
double baum_i_run_start_rate(const baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double rate = baum_i_state_rate(m, run->trial.v, run->workspace->a);
  double swing = swing_rate(m);
  if (rate < AT_REST * swing) {
    return swing;
  }
  return rate > ROUNDING_RATE ? rate : 0.0;
}

static bool is_driven(const baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  return m->nc > 0 && run->workspace->redundancy.rank == m->nv;
}

/* The motion itself tells its rate, but for one that stands still or barely moves. */
static void measure_rate(baum_simulation *run, baum_i_gain_context *context)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double swing = swing_rate(m);
  double now = baum_i_state_rate(m, run->trial.v, run->workspace->a);
  context->driven = is_driven(run);
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

static bool is_auto(const baum_simulation *run)
{
  int32_t rule = run->options.gains.rule;
  return rule == BAUM_GAINS_AUTO ||
         (rule == BAUM_GAINS_DEFAULT && run->integrator->gains == BAUM_GAINS_AUTO);
}

baum_status baum_i_run_choose_gains(baum_simulation *run)
{
  const baum_simulation_options *o = &run->options;
  baum_i_problem *problem = &run->problem;
  if (o->formulation != BAUM_FORMULATION_BAUMGARTE) {
    return BAUM_OK;
  }
  baum_i_gain_context context = {
    .method = &run->integrator->method,
    .integrator = run->integrator->name,
    .step = o->step,
    .rule_default = run->integrator->gains,
    .allow_unstable = o->allow_unstable,
  };
  if (is_auto(run)) {
    measure_rate(run, &context);
  }
  baum_status status = baum_i_gains_choose(&o->gains, &context, &run->gains);
  if (status != BAUM_OK) {
    return status;
  }
  problem->alpha = run->gains.alpha;
  problem->beta = run->gains.beta;
  problem->max_step = fmin(problem->max_step, run->gains.max_step);
  if (run->gains.doubtful) {
    baum_i_run_warn(run, "%s", run->gains.why);
  }
  return BAUM_OK;
}
