/* SPDX-License-Identifier: BSD-3-Clause */
/* Scheduled inputs: one list of the jumps of all, rising in time. A jump has the values on both of its sides, so that a
 * run passes it either way, and the value of an input is that behind the last of its jumps up to the present time.
 */
#include "simulate/schedule.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include <baum/breaks.h>

#include "base/alloc.h"
#include "mechanism/definition.h"
#include "simulate/account.h"

/* ---- the list ---- */

/* How many jumps are not after t. */
static int count_until(const baum_i_schedule *schedule, double t)
{
  int first = 0;
  int end = schedule->count;
  while (first < end) {
    int middle = first + (end - first) / 2;
    if (schedule->jumps[middle].t <= t) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return first;
}

void baum_i_schedule_move(baum_simulation *run, double from, double to)
{
  double *inputs = run->workspace->inputs;
  const baum_i_jump *jumps = run->schedule.jumps;
  int k = count_until(&run->schedule, from);
  int end = count_until(&run->schedule, to);
  for (; k < end; k++) {
    inputs[jumps[k].input] = jumps[k].after;
  }
  for (; k > end; k--) {
    inputs[jumps[k - 1].input] = jumps[k - 1].before;
  }
}

void baum_i_schedule_end(baum_simulation *run, int64_t input)
{
  baum_i_schedule *schedule = &run->schedule;
  int kept = 0;
  for (int k = 0; k < schedule->count; k++) {
    if (schedule->jumps[k].input != input) {
      schedule->jumps[kept++] = schedule->jumps[k];
    }
  }
  schedule->count = kept;
}

baum_status baum_i_schedule_reserve(baum_i_schedule *schedule, int count)
{
  if (count <= schedule->room) {
    return BAUM_OK;
  }
  baum_i_jump *jumps = baum_i_grow(schedule->jumps, (size_t)count, sizeof *jumps);
  if (!jumps) {
    return baum_i_fail_memory();
  }
  schedule->jumps = jumps;
  schedule->room = count;
  return BAUM_OK;
}

baum_status baum_i_schedule_copy(const baum_i_schedule *from, baum_i_schedule *to)
{
  baum_status status = baum_i_schedule_reserve(to, from->count);
  if (status == BAUM_OK && from->count > 0) {
    memcpy(to->jumps, from->jumps, (size_t)from->count * sizeof *to->jumps);
    to->count = from->count;
  }
  return status;
}

bool baum_i_schedule_is_sound(const void *bytes, size_t size, int64_t input_count)
{
  const char *at = bytes;
  double last = -(double)INFINITY;
  bool sound = size % sizeof(baum_i_jump) == 0;
  for (size_t k = 0; k < size / sizeof(baum_i_jump) && sound; k++) {
    baum_i_jump jump;
    memcpy(&jump, at + k * sizeof jump, sizeof jump);
    sound = jump.input >= 0 && jump.input < input_count && isfinite(jump.t) && jump.t >= last &&
            isfinite(jump.before) && isfinite(jump.after);
    last = jump.t;
  }
  return sound;
}

/* ---- a new schedule ---- */

/* What an input is given: values from times on, and `before` the first. */
typedef struct given {
  int64_t input;
  const double *times;  /* (count) */
  const double *values; /* (count) */
  int count;
  double before;
} given;

/* Jumps of other inputs that are not after t, from the k-th on. Returns the next. */
static int take_others(const baum_i_schedule *old, int k, double t, int64_t input,
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

/* Both in order of time. A value that is the one before is no jump. */
static void merge(const baum_i_schedule *old, const given *g, baum_i_schedule *out)
{
  assert(out->jumps && g->times && g->values);
  double before = g->before;
  int next = 0;
  for (int k = 0; k < g->count; k++) {
    next = take_others(old, next, g->times[k], g->input, out);
    if (g->values[k] != before) {
      out->jumps[out->count++] =
        (baum_i_jump){.t = g->times[k], .before = before, .after = g->values[k], .input = g->input};
      before = g->values[k];
    }
  }
  (void)take_others(old, next, (double)INFINITY, g->input, out);
}

/* The run takes a list that is made, and begins anew: the end of its last step may be behind a jump. */
static baum_status begin_with(baum_simulation *run, const baum_i_schedule *made, int64_t input)
{
  double *present = &run->workspace->inputs[input];
  double before = *present;
  baum_i_schedule old = run->schedule;
  baum_i_run_end_before_change(run);
  run->schedule = *made;
  baum_i_schedule_move(run, -(double)INFINITY, run->state.t);
  baum_status status = baum_i_run_begin_anew(run);
  baum_i_free(status == BAUM_OK ? old.jumps : made->jumps);
  if (status != BAUM_OK) {
    run->schedule = old;
    *present = before;
  }
  return status;
}

static baum_status replace(baum_simulation *run, const given *g)
{
  baum_i_schedule made = {.jumps = NULL};
  baum_status status = baum_i_schedule_reserve(&made, run->schedule.count + g->count);
  if (status != BAUM_OK) {
    return status;
  }
  merge(&run->schedule, g, &made);
  return begin_with(run, &made, g->input);
}

/* ---- public ---- */

static const char *const CALL = "baum_simulation_schedule_input";

static baum_status check_entry(const baum_mechanism *m, const given *g, int k)
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

static baum_status check(const baum_simulation *run, baum_input_id input, const double *times,
                         const double *values, int32_t count)
{
  if (!run) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the simulation is NULL", CALL);
  }
  baum_status status = baum_i_check_input(run->workspace->mechanism, input, CALL, "input");
  if (status == BAUM_OK && (count < 0 || (count > 0 && (!times || !values)))) {
    status = baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s", CALL,
                         count < 0 ? "count is negative" : "times or values are NULL");
  }
  return status == BAUM_OK ? baum_i_run_may_be_changed(run, CALL) : status;
}

baum_status baum_simulation_schedule_input(baum_simulation *simulation, baum_input_id input,
                                           const double *times, const double *values, int32_t count)
{
  baum_status status = check(simulation, input, times, values, count);
  if (status != BAUM_OK) {
    return status;
  }
  int index = baum_i_input_index(simulation->workspace->mechanism, input);
  given g = {.input = index,
             .times = times,
             .values = values,
             .count = count,
             .before = simulation->workspace->inputs[index]};
  for (int k = 0; k < count && status == BAUM_OK; k++) {
    status = check_entry(simulation->workspace->mechanism, &g, k);
  }
  if (status != BAUM_OK) {
    return status;
  }
  if (count == 0) {
    baum_i_schedule_end(simulation, index);
    return BAUM_OK;
  }
  status = replace(simulation, &g);
  return status == BAUM_OK ? BAUM_OK : baum_i_run_fail(simulation, status);
}
