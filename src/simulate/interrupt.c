/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks before each step whether the run must stop: because of baum_simulation_cancel(), the
 * result of progress(), the time limit of a call, too many steps, or steps that are too short.
 *
 * A variable-step method may get stuck, for example BDF near a singular configuration, or an
 * explicit method with a stiff force. After every 1e4 steps of a call, the mean length of these
 * steps is compared with the time 1/rate, in which the motion changes. If this time would take
 * more than 1e9 steps of the mean length (the default of max_steps), the run stops. A motion with
 * high gains or stiff forces, in which the method does not get stuck, needs far fewer steps for
 * this time, for example 1e6. */
#include <math.h>

#include "base/platform.h"
#include "simulate/run.h"

enum { PACE_STEPS = 10000 };
static const double SLOWEST = 1e-9; /* smallest allowed mean length of a step, times rate */

void baum_simulation_cancel(baum_simulation *simulation)
{
  if (simulation) {
    atomic_store(&simulation->cancelled, 1);
  }
}

baum_status baum_simulation_set_progress_interval(baum_simulation *simulation, double interval)
{
  const char *call = "baum_simulation_set_progress_interval";
  BAUM_I_TRY(baum_i_run_may_be_read(simulation, call));
  if (!(interval >= 0.0 && isfinite(interval))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: interval is %g s, must be finite and >= 0", call,
                       interval);
  }
  simulation->options.progress_interval = interval;
  return BAUM_OK;
}

baum_status baum_simulation_set_time_limit(baum_simulation *simulation, double limit)
{
  const char *call = "baum_simulation_set_time_limit";
  BAUM_I_TRY(baum_i_run_may_be_read(simulation, call));
  if (!(limit > 0.0)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: limit is %g s, must be > 0", call, limit);
  }
  simulation->time_limit = limit;
  return BAUM_OK;
}

baum_status baum_i_run_may_be_read(const baum_simulation *run, const char *call)
{
  if (!run) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the simulation is NULL", call);
  }
  baum_status status = baum_i_check_idle(run->workspace, call, "the simulation");
  for (int k = 0; k < 2 && status == BAUM_OK; k++) {
    status = run->beside[k] ? baum_i_check_idle(run->beside[k], call, "the simulation") : BAUM_OK;
  }
  return status;
}

baum_status baum_i_run_may_be_changed(const baum_simulation *run, const char *call)
{
  return run && run->reporting
           ? baum_i_fail(BAUM_ERR_STATE,
                         "%s: the simulation is calling progress(), which may only "
                         "read it",
                         call)
           : baum_i_run_may_be_read(run, call);
}

static bool progress_cancels(baum_simulation *run)
{
  const baum_simulation_options *o = &run->options;
  if (!o->progress || baum_i_wall_seconds() - run->last_progress < o->progress_interval) {
    return false;
  }
  run->last_progress = baum_i_wall_seconds();
  run->reporting = true;
  int answer = o->progress(run, run->state.t, o->user);
  run->reporting = false;
  return answer != 0;
}

/* Tell whether the last PACE_STEPS steps of this call were too short. This is checked once every
 * PACE_STEPS steps. Fixed steps are not checked, because the user chose them. */
static bool creeps(baum_simulation *run, int64_t taken)
{
  if (baum_i_run_has_fixed_step(run) || taken % PACE_STEPS != 0) {
    return false;
  }
  const baum_i_state *now = &run->ahead;
  double rate = fmax(run->problem.rate, baum_i_scaled_size(run->workspace->mechanism, now->v));
  double passed = fabs(now->t - run->paced_at) * rate;
  run->paced_at = now->t;
  return taken > 0 && passed < PACE_STEPS * SLOWEST;
}

static baum_status fail_creeping(baum_simulation *run)
{
  const baum_i_state *now = &run->ahead;
  baum_status status =
    baum_i_fail(BAUM_ERR_STEP,
                "t = %.9g s: %s hardly advances: the last %d steps were on average shorter than "
                "1e-9 of the time scale of the motion; the forces may be stiff, which requires "
                "cvode_bdf or ida, or the configuration may be singular, which rk8 can pass",
                now->t, run->integrator->name, (int)PACE_STEPS);
  return baum_i_run_explain_failure(run, status, now);
}

static baum_status stop_if(const baum_simulation *run, bool is_cancelled)
{
  return is_cancelled
           ? baum_i_fail(BAUM_STOP_CANCELLED, "t = %.9g s: cancelled", baum_i_run_last_end(run))
           : BAUM_OK;
}

static bool was_asked(baum_simulation *run)
{
  return atomic_load(&run->cancelled) != 0 && atomic_exchange(&run->cancelled, 0) != 0;
}

baum_status baum_i_run_may_begin(baum_simulation *run)
{
  return stop_if(run, was_asked(run));
}

baum_status baum_i_run_is_wanted(baum_simulation *run)
{
  return stop_if(run, was_asked(run) || progress_cancels(run));
}

baum_status baum_i_run_has_time(const baum_simulation *run)
{
  if (run->deadline == (double)INFINITY || baum_i_wall_seconds() < run->deadline) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_STOP_TIME, "t = %.9g s: the time limit of the call, %g s, has passed",
                     baum_i_run_last_end(run), run->time_limit);
}

baum_status baum_i_run_may_go_on(baum_simulation *run, int64_t taken)
{
  double t = baum_i_run_last_end(run);
  BAUM_I_TRY(baum_i_run_is_wanted(run));
  BAUM_I_TRY(taken > 0 ? baum_i_run_has_time(run) : BAUM_OK);
  if (taken >= run->options.max_steps) {
    return baum_i_fail(BAUM_ERR_STEP,
                       "t = %.9g s: max_steps = %lld steps taken in one call; "
                       "call again to continue, or raise max_steps",
                       t, (long long)run->options.max_steps);
  }
  return creeps(run, taken) ? fail_creeping(run) : BAUM_OK;
}
