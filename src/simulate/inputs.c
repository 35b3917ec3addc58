/* SPDX-License-Identifier: BSD-3-Clause */
/* Handles changes from outside during a run: new values of inputs, schedules of inputs, and new
 * driver laws. Each of them changes the right-hand side of the equations abruptly (restart.c). */
#include <assert.h>
#include <math.h>
#include <string.h>

#include <baum/breaks.h>

#include "base/alloc.h"
#include "mechanism/definition.h"
#include "simulate/run.h"

/* ---- inputs ---- */

baum_status baum_simulation_set_input(baum_simulation *simulation, baum_input_id input,
                                      double value)
{
  const char *call = "baum_simulation_set_input";
  BAUM_I_TRY(baum_i_run_may_be_changed(simulation, call));
  baum_workspace *w = simulation->workspace;
  BAUM_I_TRY(baum_i_check_input_value(w->mechanism, input, call, value));
  double *present = &w->inputs[input.index1 - 1];
  double before = *present;
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = BAUM_OK;
  if (value != before) {
    baum_i_run_end_before_change(simulation);
    *present = value;
    status = baum_i_run_restart(simulation);
  }
  if (status == BAUM_OK) {
    baum_i_schedule_end(simulation, input.index1 - 1);
  } else {
    *present = before;
  }
  return baum_i_run_end_call(simulation, status, &kept);
}

double baum_simulation_input(const baum_simulation *simulation, baum_input_id input)
{
  return simulation ? baum_workspace_input(simulation->workspace, input) : (double)NAN;
}

/* ---- a schedule of an input ---- */

/* The values that an input has from given times on, and the value before the first of these
 * times. */
typedef struct given {
  int64_t input;
  const double *times;  /* (count) */
  const double *values; /* (count) */
  int count;
  double before;
} given;

/* Append the jumps of all inputs except `input`, up to and including time t. Begin with jump k of
 * the old list. Returns the index of the next jump in the old list. */
static int append_others(const baum_i_schedule *old, int k, double t, int64_t input,
                         baum_i_schedule *out)
{
  assert(out->jumps);
  for (; k < old->count && old->jumps[k].t <= t; k++) {
    if (old->jumps[k].input != input) {
      out->jumps[out->count++] = old->jumps[k];
    }
  }
  return k;
}

/* Merge the new jumps of one input with the jumps of the other inputs, in the order of time. If a
 * new value equals the value before it, it is not a jump and is not listed. */
static void merge_jumps(const baum_i_schedule *old, const given *g, baum_i_schedule *out)
{
  assert(out->jumps && g->times && g->values);
  double before = g->before;
  int next = 0;
  for (int k = 0; k < g->count; k++) {
    next = append_others(old, next, g->times[k], g->input, out);
    if (g->values[k] != before) {
      out->jumps[out->count++] =
        (baum_i_jump){.t = g->times[k], .before = before, .after = g->values[k], .input = g->input};
      before = g->values[k];
    }
  }
  (void)append_others(old, next, (double)INFINITY, g->input, out);
}

/* Let the run use a new list of jumps. The run is restarted, because its last step may end after a
 * jump of the new list. */
static baum_status use_schedule(baum_simulation *run, const baum_i_schedule *made, int64_t input)
{
  double *present = &run->workspace->inputs[input];
  double before = *present;
  baum_i_schedule old = run->schedule;
  baum_i_run_end_before_change(run);
  run->schedule = *made;
  baum_i_schedule_move(run, -(double)INFINITY, run->state.t);
  baum_status status = baum_i_run_restart(run);
  baum_i_free(status == BAUM_OK ? old.jumps : made->jumps);
  if (status != BAUM_OK) {
    run->schedule = old;
    *present = before;
  }
  return status;
}

static const char *const CALL = "baum_simulation_schedule_input";

static baum_status check_schedule_entry(const baum_mechanism *m, const given *g, int k)
{
  assert(g->times && g->values);
  const char *name = m->input_names[g->input];
  int number = (int)g->input + 1;
  double t = g->times[k];
  if (!isfinite(t) || !isfinite(g->values[k])) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: input %d \"%.80s\": %s[%d] is %g%s, must be finite",
                       CALL, number, name, isfinite(t) ? "values" : "times", k,
                       isfinite(t) ? g->values[k] : t, isfinite(t) ? "" : " s");
  }
  if (k > 0 && t <= g->times[k - 1]) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: input %d \"%.80s\": times[%d] is %.9g s, must be above times[%d], "
                       "which is %.9g s",
                       CALL, number, name, k, t, k - 1, g->times[k - 1]);
  }
  return BAUM_OK;
}

static baum_status check_schedule(const baum_simulation *run, baum_input_id input,
                                  const double *times, const double *values, int32_t count)
{
  BAUM_I_TRY(baum_i_run_may_be_changed(run, CALL));
  BAUM_I_TRY(baum_i_check_input(run->workspace->mechanism, input, CALL, "input"));
  if ((count < 0 || (count > 0 && (!times || !values)))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s", CALL,
                       count < 0 ? "count is negative" : "times or values are NULL");
  }
  return BAUM_OK;
}

baum_status baum_simulation_schedule_input(baum_simulation *simulation, baum_input_id input,
                                           const double *times, const double *values, int32_t count)
{
  BAUM_I_TRY(check_schedule(simulation, input, times, values, count));
  int index = baum_i_input_index(simulation->workspace->mechanism, input);
  given g = {.input = index,
             .times = times,
             .values = values,
             .count = count,
             .before = simulation->workspace->inputs[index]};
  for (int k = 0; k < count; k++) {
    BAUM_I_TRY(check_schedule_entry(simulation->workspace->mechanism, &g, k));
  }
  if (count == 0) {
    baum_i_schedule_end(simulation, index);
    return BAUM_OK;
  }
  baum_i_kept_message kept = baum_i_message_keep();
  baum_i_schedule made = {.jumps = NULL};
  baum_status status = baum_i_schedule_reserve(&made, simulation->schedule.count + count);
  if (status == BAUM_OK) {
    merge_jumps(&simulation->schedule, &g, &made);
    status = use_schedule(simulation, &made, index);
  }
  return baum_i_run_end_call(simulation, status, &kept);
}

/* ---- drivers ---- */

static baum_status check_driver(const baum_simulation *run, const char *call, baum_joint_id driver,
                                const double law[3])
{
  BAUM_I_TRY(baum_i_run_may_be_changed(run, call));
  const baum_mechanism *m = run->workspace->mechanism;
  BAUM_I_TRY(baum_i_check_joint(m, driver, call, "driver"));
  const baum_i_joint *joint = m->joints[baum_i_joint_index(m, driver)];
  const baum_i_text label = baum_i_label(&joint->element);
  if (!joint->type->replace_law) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s is a %s, not a driver", call, label.text,
                       joint->type->definition.kind);
  }
  static const char *const names[3] = {"s", "ds", "dds"};
  static const char *const units[3] = {"rad or m", "rad/s or m/s", "rad/s^2 or m/s^2"};
  for (int k = 0; k < 3; k++) {
    BAUM_I_TRY(baum_i_check_finite(label.text, names[k], units[k], law[k]));
  }
  return BAUM_OK;
}

baum_status baum_i_run_own_parameters(baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  if (run->parameters) {
    return BAUM_OK;
  }
  run->parameters = baum_i_copy(m->parameters, (size_t)m->parameter_count, sizeof *run->parameters);
  BAUM_I_TRY(baum_i_check_memory(run->parameters));
  run->workspace->point.parameters = run->parameters;
  return BAUM_OK;
}

enum { MOST_NUMBERS = 8 }; /* largest number of parameters of a driver */

static baum_status set_driver(baum_simulation *run, const baum_i_joint *joint, const double law[3])
{
  double before[MOST_NUMBERS];
  double *numbers = run->parameters + joint->element.parameter;
  size_t size = (size_t)joint->element.definition->parameter_count * sizeof *numbers;
  assert(size <= sizeof before);
  memcpy(before, numbers, size);
  baum_i_run_end_before_change(run);
  joint->type->replace_law(numbers, run->state.t, law);
  baum_status status = baum_i_run_restart(run);
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
  BAUM_I_TRY(check_driver(simulation, "baum_simulation_set_driver", driver, law));
  baum_i_kept_message kept = baum_i_message_keep();
  const baum_mechanism *m = simulation->workspace->mechanism;
  baum_status status = baum_i_run_own_parameters(simulation);
  if (status == BAUM_OK) {
    status = set_driver(simulation, m->joints[baum_i_joint_index(m, driver)], law);
  }
  return baum_i_run_end_call(simulation, status, &kept);
}
