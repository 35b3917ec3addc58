/* SPDX-License-Identifier: BSD-3-Clause */
/* What acts on a run from outside: inputs.
 *
 * Both change the right side of the equations abruptly. A fixed-step method begins every step from
 * the state alone and takes the change as it is; a variable-step method carries its past along and
 * begins anew from the present state, which may be behind the end of its last step.
 */
#include <math.h>

#include "simulate/run.h"

/* A method that fails here begins anew at its next step, and from the same state. */
static baum_status begin_anew(baum_simulation *run)
{
  if (!run->integrator->restart) {
    return BAUM_OK;
  }
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  baum_i_run_copy(run, &run->state, &run->ahead);
  baum_status status = run->integrator->restart(run->self, &run->problem, &run->state);
  run->counters.restarts += status == BAUM_OK;
  return baum_i_message_settle(status, &kept);
}

/* ---- inputs ---- */

baum_status baum_simulation_set_input(baum_simulation *simulation, baum_input_id input,
                                      double value)
{
  const char *call = "baum_simulation_set_input";
  if (!simulation) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the simulation is NULL", call);
  }
  baum_workspace *w = simulation->workspace;
  baum_status status = baum_i_check_input_value(w->mechanism, input, call, value);
  if (status != BAUM_OK) {
    return status;
  }
  double *present = &w->inputs[input.index1 - 1];
  double before = *present;
  if (value == before) {
    return BAUM_OK;
  }
  *present = value;
  status = begin_anew(simulation);
  if (status != BAUM_OK) {
    *present = before;
    return baum_i_run_fail(simulation, status);
  }
  return BAUM_OK;
}

double baum_simulation_input(const baum_simulation *simulation, baum_input_id input)
{
  return simulation ? baum_workspace_input(simulation->workspace, input) : (double)NAN;
}
