/* SPDX-License-Identifier: BSD-3-Clause */
/* Declared breaks of the mechanism and of scheduled inputs. A break divides time into an earlier
 * and a later side. At the time b of the break functions already have the values of the later side.
 * A step forward in time therefore ends a few roundings before b, where all functions have the
 * values of the earlier side, and the next step begins at b. Backward in time a step ends at b, and
 * the next step begins a few roundings before b. The state does not change in between. Methods with
 * a history restart there (restart.c). */
#include <float.h>
#include <math.h>

#include "base/hot.h"
#include "simulate/run.h"

/* Distance of the earlier side from b, relative to the largest time with which the method computes.
 * It must be so large that times of stages are not rounded to b. */
static const double ROUNDINGS = 16.0;

/* Return the distance of the earlier side of a break from b. */
static double gap(const baum_simulation *run, double b)
{
  double largest = fmax(fmax(fabs(b), fabs(run->origin)), 1.0 / run->problem.rate);
  return ROUNDINGS * DBL_EPSILON * largest;
}

/* Tell whether t is on the later side of b, which includes times equal to b up to rounding. */
static bool is_later(const baum_simulation *run, double t, double b)
{
  return b <= (run->problem.direction > 0.0 ? t : t + 0.5 * gap(run, b));
}

/* Return the next of `count` ascending times after t in the direction of the run, or an infinite
 * time if there is none. The times are `stride` bytes apart. */
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

baum_i_break baum_i_run_next_break(const baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  const baum_i_schedule *jumps = &run->schedule;
  if (m->break_count == 0 && jumps->count == 0) { /* as in most runs */
    double never = run->problem.direction * (double)INFINITY;
    return (baum_i_break){never, never};
  }
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
