/* SPDX-License-Identifier: BSD-3-Clause */
/* Declared breaks. At its time b a function has the value of after. So steps forward end a few roundings before b, where
 * everything is of before, and the next begins at b; backward in time they end at b and begin before it. In between
 * nothing moves. Methods that carry their past along begin anew there.
 */
#include "simulate/breaks.h"

#include <float.h>
#include <math.h>

#include "simulate/account.h"

/* Of the largest time that the method reckons with: stages must not round to b. */
static const double ROUNDINGS = 16.0;

static double end_of_last_step(const baum_simulation *run)
{
  return baum_i_problem_has_fixed_step(&run->problem) ? run->state.t : run->ahead.t;
}

/* How far before a break at b its earlier side is. */
static double gap(const baum_simulation *run, double b)
{
  double largest = fmax(fmax(fabs(b), fabs(run->origin)), 1.0 / run->problem.rate);
  return ROUNDINGS * DBL_EPSILON * largest;
}

baum_i_break baum_i_run_next_break(const baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  double direction = run->problem.direction;
  double from = end_of_last_step(run);
  double found = direction * (double)INFINITY;
  for (int k = 0; k < m->break_count; k++) {
    double b = m->breaks[k];
    /* What stands at b, to rounding, is on its later side. */
    bool ahead = direction > 0.0 ? b > from : b <= from + 0.5 * gap(run, b);
    if (ahead && direction * (found - b) > 0.0) {
      found = b;
    }
  }
  double before = isfinite(found) ? found - gap(run, found) : found;
  return direction > 0.0 ? (baum_i_break){before, found} : (baum_i_break){found, before};
}

bool baum_i_run_is_at(const baum_simulation *run, baum_i_break next)
{
  double left = run->problem.direction * (next.near - end_of_last_step(run));
  return isfinite(next.near) && left <= gap(run, next.near);
}

baum_status baum_i_run_pass(baum_simulation *run, baum_i_break next)
{
  double before = run->state.t;
  if (run->account) {
    baum_i_account_read(run, &run->state);
  }
  run->state.t = next.far;
  baum_status status = baum_i_run_begin_anew(run);
  if (status != BAUM_OK) {
    run->state.t = before;
    return status;
  }
  run->grid = (baum_i_grid){.origin = next.far};
  return BAUM_OK;
}
