/* SPDX-License-Identifier: BSD-3-Clause */
/* Restarts a run after an abrupt change. The change may concern an input, the law of a driver, the
 * set of omitted rows, or a function that jumps at a break.
 *
 * A fixed-step method without a history computes every step from the present state alone, so it
 * needs no restart. All other methods have a history, and must restart from the present state. With
 * variable steps, the present state may be before the end of the method's last step. */
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/events.h"

static baum_status restart_method(baum_simulation *run)
{
  if (!baum_i_integrator_remembers(run->integrator, &run->problem)) {
    return BAUM_OK;
  }
  baum_i_run_copy(run, &run->state, &run->ahead);
  if (run->account) {
    baum_i_account_go_on(run);
  }
  baum_status status = run->integrator->restart(run->self, &run->problem, &run->state);
  run->counters.restarts += status == BAUM_OK;
  return status;
}

/* Restart everything except the search for events. The values of the events are evaluated first,
 * because their evaluation may fail and a restart cannot be undone. */
static baum_status restart_motion(baum_simulation *run)
{
  BAUM_I_TRY(run->events ? baum_i_events_evaluate_again(run) : BAUM_OK);
  BAUM_I_TRY(restart_method(run));
  run->origin = run->state.t;
  baum_i_companion_restart(run);
  return BAUM_OK;
}

baum_status baum_i_run_restart(baum_simulation *run)
{
  BAUM_I_TRY(restart_motion(run));
  if (run->events) {
    baum_i_events_go_on(run);
  }
  return BAUM_OK;
}

void baum_i_run_end_before_change(baum_simulation *run)
{
  if (run->account) {
    baum_i_account_read(run, &run->state);
  }
  baum_i_companion_settle(run);
}

baum_status baum_i_run_pass(baum_simulation *run, baum_i_break next)
{
  double before = run->state.t;
  baum_i_run_end_before_change(run);
  run->state.t = next.far;
  baum_i_schedule_move(run, next.near, next.far);
  baum_status status = restart_motion(run);
  if (status != BAUM_OK) {
    run->state.t = before;
    baum_i_schedule_move(run, next.far, next.near);
    return status;
  }
  run->grid = (baum_i_grid){.origin = next.far};
  /* Kinematics has already computed the configuration on the far side of the break. Its velocities
   * may differ from those on the near side. */
  if (run->integrator->without_freedom) {
    BAUM_I_TRY(
      run->integrator->interpolate(run->self, &run->problem, next.far, run->state.q, run->state.v));
  }
  return run->events ? baum_i_events_pass_break(run) : BAUM_OK;
}
