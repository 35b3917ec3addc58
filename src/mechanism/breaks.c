/* SPDX-License-Identifier: BSD-3-Clause */
/* The list of break times of a mechanism, at which its loads may jump. The list is in ascending
 * order. */
#include <math.h>
#include <string.h>

#include <baum/breaks.h>

#include "base/alloc.h"
#include "base/message.h"
#include "mechanism/identify.h"

/* Find the index of the first break time >= t. */
static int place_of(const baum_mechanism *mechanism, double t)
{
  int low = 0;
  int high = mechanism->break_count;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (mechanism->breaks[middle] < t) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

static void insert(baum_mechanism *mechanism, double t)
{
  int k = place_of(mechanism, t);
  double *at = mechanism->breaks + k;
  if (k < mechanism->break_count && *at == t) {
    return;
  }
  memmove(at + 1, at, (size_t)(mechanism->break_count - k) * sizeof *at);
  *at = t;
  mechanism->break_count++;
}

static baum_status check_times(const double *times, int32_t count)
{
  const char *call = "baum_mechanism_add_break_times";
  if (count < 0 || (count > 0 && !times)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s", call,
                       count < 0 ? "count is negative" : "times are NULL");
  }
  for (int32_t k = 0; k < count; k++) {
    if (!isfinite(times[k])) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: times[%d] is %g s, must be finite", call, (int)k,
                         times[k]);
    }
  }
  return BAUM_OK;
}

baum_status baum_mechanism_add_break_times(baum_mechanism *mechanism, const double *times,
                                           int32_t count)
{
  BAUM_I_TRY(baum_i_check_open(mechanism, "baum_mechanism_add_break_times"));
  BAUM_I_TRY(check_times(times, count));
  size_t room = (size_t)mechanism->break_count + (size_t)count;
  double *breaks = baum_i_grow(mechanism->breaks, room, sizeof *breaks);
  BAUM_I_TRY(baum_i_check_memory(breaks));
  mechanism->breaks = breaks;
  for (int32_t k = 0; k < count; k++) {
    insert(mechanism, times[k]);
  }
  return BAUM_OK;
}

const double *baum_mechanism_break_times(const baum_mechanism *mechanism, int32_t *count)
{
  if (count) {
    *count = mechanism ? mechanism->break_count : 0;
  }
  return mechanism ? mechanism->breaks : NULL;
}
