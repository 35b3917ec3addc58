/* SPDX-License-Identifier: BSD-3-Clause */
/* Handles the breaks that elements of the mechanism declare, and the breaks of scheduled inputs. A
 * break is a time b that has an earlier and a later side. At the time b itself, the functions
 * already have their values of the later side. A step forward in time therefore ends a few rounding
 * errors before b, where all functions still have their values of the earlier side. The next step
 * begins at b. Backward in time, a step ends at b, and the next step begins a few rounding errors
 * before b. The state does not change between the two times. Methods that use a history restart at
 * a break (restart.c). */
#include <float.h>
#include <math.h>

#include "base/hot.h"
#include "simulate/run.h"

/* Distance of the earlier side from b, as a multiple of the rounding error of the largest time with
 * which the method computes. It must be so large that the times of a method's stages are not
 * rounded to b. */
static const double ROUNDINGS = 16.0;

/* Return the distance from the earlier side of a break to b. */
static double gap(const baum_simulation *run, double b)
{
  double largest = fmax(fmax(fabs(b), fabs(run->origin)), 1.0 / run->problem.rate);
  return ROUNDINGS * DBL_EPSILON * largest;
}

/* Tell whether t is on the later side of b. A time that equals b up to rounding is on the later
 * side. */
static bool is_later(const baum_simulation *run, double t, double b)
{
  return b <= (run->problem.direction > 0.0 ? t : t + 0.5 * gap(run, b));
}

/* Return the next time after t, in the direction of the run, from a list of `count` ascending
 * times. If there is none, return an infinite time. In memory, successive times are `stride` bytes
 * apart. */
BAUM_I_INLINE double find_next(const baum_simulation *run, const void *times, size_t stride,
                               int count, double t)
{
  const char *at = times;
  double found = -(double)INFINITY; /* the last time <= t */
  int first = 0;
  int end = count;
  while (first < end) {
    int middle = first + (end - first) / 2;
    double b = *(const double *)(const void *)(at + (size_t)middle * stride);
    if (is_later(run, t, b)) {
      first = middle + 1;
      found = b;
    } else {
      end = middle;
    }
  }
  if (run->problem.direction < 0.0) {
    return found;
  }
  return first < count ? *(const double *)(const void *)(at + (size_t)first * stride)
                       : (double)INFINITY;
}

baum_i_break baum_i_run_find_break(const baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  const baum_i_schedule *jumps = &run->schedule;
  double from = baum_i_run_last_end(run);
  double a = find_next(run, m->breaks, sizeof *m->breaks, m->break_count, from);
  double b = find_next(run, jumps->jumps, sizeof *jumps->jumps, jumps->count, from);
  double found = run->problem.direction > 0.0 ? fmin(a, b) : fmax(a, b);
  double before = isfinite(found) ? found - gap(run, found) : found;
  return run->problem.direction > 0.0 ? (baum_i_break){before, found}
                                      : (baum_i_break){found, before};
}

bool baum_i_run_is_at(const baum_simulation *run, baum_i_break next)
{
  double left = run->problem.direction * (next.near - baum_i_run_last_end(run));
  return isfinite(next.near) && left <= gap(run, next.near);
}
