/* SPDX-License-Identifier: BSD-3-Clause */
/* What acts on a run from outside: inputs, and drivers with a law given by the run.
 *
 * Both change the right side of the equations abruptly. A fixed-step method begins every step from
 * the state alone and takes the change as it is; a variable-step method carries its past along and
 * begins anew from the present state, which may be behind the end of its last step.
 */
#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "mechanism/definition.h"
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/events.h"
#include "simulate/schedule.h"

static baum_status restart(baum_simulation *run)
{
  if (!baum_i_integrator_remembers(run->integrator, &run->problem)) {
    return BAUM_OK;
  }
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  baum_i_run_copy(run, &run->state, &run->ahead);
  if (run->account) {
    baum_i_account_go_on(run);
  }
  baum_status status = run->integrator->restart(run->self, &run->problem, &run->state);
  run->counters.restarts += status == BAUM_OK;
  return baum_i_message_settle(status, &kept);
}

baum_status baum_i_run_begin_anew(baum_simulation *run)
{
  baum_status status = run->events ? baum_i_events_evaluate(run, &run->state) : BAUM_OK;
  if (status == BAUM_OK) {
    status = restart(run);
  }
  if (status == BAUM_OK) {
    run->origin = run->state.t;
    baum_i_companion_restart(run);
  }
  if (status == BAUM_OK && run->events) {
    baum_i_events_go_on(run);
  }
  return status;
}

void baum_i_run_end_before_change(baum_simulation *run)
{
  if (run->account) {
    baum_i_account_read(run, &run->state);
  }
  baum_i_companion_settle(run);
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
  if (status == BAUM_OK) {
    status = baum_i_run_may_be_changed(simulation, call);
  }
  if (status != BAUM_OK) {
    return status;
  }
  double *present = &w->inputs[input.index1 - 1];
  double before = *present;
  if (value != before) {
    baum_i_run_end_before_change(simulation);
    *present = value;
    status = baum_i_run_begin_anew(simulation);
  }
  if (status != BAUM_OK) {
    *present = before;
    return baum_i_run_fail(simulation, status);
  }
  baum_i_schedule_end(simulation, input.index1 - 1);
  return BAUM_OK;
}

double baum_simulation_input(const baum_simulation *simulation, baum_input_id input)
{
  return simulation ? baum_workspace_input(simulation->workspace, input) : (double)NAN;
}

/* ---- drivers ---- */

static baum_status check_driver(const baum_simulation *run, const char *call, baum_joint_id driver,
                                const double law[3])
{
  if (!run) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the simulation is NULL", call);
  }
  const baum_mechanism *m = run->workspace->mechanism;
  baum_status status = baum_i_check_joint(m, driver, call, "driver");
  if (status != BAUM_OK) {
    return status;
  }
  char label[BAUM_I_LABEL_SIZE];
  const baum_i_joint *joint = m->joints[baum_i_joint_index(m, driver)];
  (void)baum_i_label(&joint->element, "joint", label);
  if (!joint->type->replace_law) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is a %s, not a driver", call, label,
                       joint->type->definition.kind);
  }
  static const char *const names[3] = {"s", "ds", "dds"};
  static const char *const units[3] = {"rad or m", "rad/s or m/s", "rad/s^2 or m/s^2"};
  for (int k = 0; k < 3 && status == BAUM_OK; k++) {
    status = baum_i_check_finite(label, names[k], units[k], law[k]);
  }
  return status == BAUM_OK ? baum_i_run_may_be_changed(run, call) : status;
}

baum_status baum_i_run_own_parameters(baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  if (run->parameters) {
    return BAUM_OK;
  }
  run->parameters = baum_i_copy(m->parameters, (size_t)m->parameter_count, sizeof *run->parameters);
  if (!run->parameters) {
    return baum_i_fail_memory();
  }
  run->workspace->point.parameters = run->parameters;
  return BAUM_OK;
}

enum { MOST_NUMBERS = 8 }; /* of a driver, among the parameters */

static baum_status set_driver(baum_simulation *run, const baum_i_joint *joint, const double law[3])
{
  double before[MOST_NUMBERS];
  double *numbers = run->parameters + joint->element.parameter;
  size_t size = (size_t)joint->type->parameter_count * sizeof *numbers;
  assert(size <= sizeof before);
  memcpy(before, numbers, size);
  baum_i_run_end_before_change(run);
  joint->type->replace_law(numbers, run->state.t, law);
  baum_status status = baum_i_run_begin_anew(run);
  if (status != BAUM_OK) {
    memcpy(numbers, before, size);
    return status;
  }
  baum_i_run_excuse_violation(run);
  return BAUM_OK;
}

baum_status baum_simulation_set_driver(baum_simulation *simulation, baum_joint_id driver, double s,
                                       double ds, double dds)
{
  const double law[3] = {s, ds, dds};
  baum_status status = check_driver(simulation, "baum_simulation_set_driver", driver, law);
  if (status != BAUM_OK) {
    return status;
  }
  const baum_mechanism *m = simulation->workspace->mechanism;
  status = baum_i_run_own_parameters(simulation);
  if (status == BAUM_OK) {
    status = set_driver(simulation, m->joints[baum_i_joint_index(m, driver)], law);
  }
  return status == BAUM_OK ? BAUM_OK : baum_i_run_fail(simulation, status);
}
