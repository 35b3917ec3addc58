/* SPDX-License-Identifier: BSD-3-Clause */
/* Declared breaks, of the mechanism and of scheduled inputs. At its time b a function has the value
 * that it has afterwards. So steps forward end a few roundings before b, where everything has its
 * value from before, and the next begins at b; backward in time they end at b and begin before it.
 * In between nothing moves. Methods that carry their past along restart there (restart.c).
 */
#include "simulate/breaks.h"

#include <float.h>
#include <math.h>

/* Of the largest time that the method reckons with: stages must not round to b. */
static const double ROUNDINGS = 16.0;

/* How far before a break at b its earlier side is. */
static double gap(const baum_simulation *run, double b)
{
  double largest = fmax(fmax(fabs(b), fabs(run->origin)), 1.0 / run->problem.rate);
  return ROUNDINGS * DBL_EPSILON * largest;
}

/* A rising list of breaks. */
typedef struct breaks {
  double (*time)(const baum_simulation *run, int k);
  int count;
} breaks;

static double time_of_mechanism(const baum_simulation *run, int k)
{
  return run->workspace->mechanism->breaks[k];
}

static double time_of_jump(const baum_simulation *run, int k)
{
  return run->schedule.jumps[k].t;
}

/* What stands at b, to rounding, is on its later side. */
static bool is_later(const baum_simulation *run, double t, double b)
{
  return b <= (run->problem.direction > 0.0 ? t : t + 0.5 * gap(run, b));
}

/* The next of a list on the way from t; infinite when there is none. */
static double next_of(const baum_simulation *run, breaks list, double t)
{
  int first = 0; /* not earlier than t */
  int end = list.count;
  while (first < end) {
    int middle = first + (end - first) / 2;
    if (is_later(run, t, list.time(run, middle))) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  if (run->problem.direction > 0.0) {
    return first < list.count ? list.time(run, first) : (double)INFINITY;
  }
  return first > 0 ? list.time(run, first - 1) : -(double)INFINITY;
}

baum_i_break baum_i_run_next_break(const baum_simulation *run)
{
  const breaks of_mechanism = {time_of_mechanism, run->workspace->mechanism->break_count};
  const breaks of_inputs = {time_of_jump, run->schedule.count};
  double from = baum_i_run_last_end(run);
  double a = next_of(run, of_mechanism, from);
  double b = next_of(run, of_inputs, from);
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
