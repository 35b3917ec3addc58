/* SPDX-License-Identifier: BSD-3-Clause */
/* The schedule of the inputs of a run. It is one list of the jumps of all inputs, in the order of
 * time. Each jump stores the value before and the value after it, so that a run can pass the jump
 * forward and backward in time. At a time t, an input has the value after the last of its jumps up
 * to and including t. */

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "simulate/run.h"

/* Return the number of jumps up to and including the time t. */
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
  BAUM_I_TRY(baum_i_check_memory(jumps));
  schedule->jumps = jumps;
  schedule->room = count;
  return BAUM_OK;
}

bool baum_i_schedule_is_sound(const void *bytes, int64_t count, int64_t input_count)
{
  const char *at = bytes;
  double last = -(double)INFINITY;
  bool sound = true;
  for (int64_t k = 0; k < count && sound; k++) {
    baum_i_jump jump;
    memcpy(&jump, at + (size_t)k * sizeof jump, sizeof jump);
    sound = jump.input >= 0 && jump.input < input_count && isfinite(jump.t) && jump.t >= last &&
            isfinite(jump.before) && isfinite(jump.after);
    last = jump.t;
  }
  return sound;
}
