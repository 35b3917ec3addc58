/* SPDX-License-Identifier: BSD-3-Clause */

#include <float.h>
#include <math.h>
#include <string.h>

#include "integrate/limit.h"
#include "simulate/crossing.h"

/* Tell whether the configuration of the last solution may be singular. If the block solver has
 * refused this configuration, the pivot comes from another solver. Pivots of that solver are
 * larger, so their limit is larger, too. Small moments of inertia cause small pivots in any
 * configuration, so baum_i_rows_are_apart() decides whether the configuration is singular. */
static bool may_be_in_pose(const baum_simulation *run, double pivot)
{
  const baum_workspace *w = run->workspace;
  bool refused = w->path && !w->solved_by;
  return pivot < (refused ? BAUM_I_NEAR_PIVOT : BAUM_I_PIVOT_IN_POSE);
}

/* Return the smallest pivot of the last solution, relative to the usual one. */
static double find_pivot(const baum_simulation *run)
{
  return baum_i_smallest_pivot(run->workspace, NULL) / run->crossings->usual;
}

/* Tell whether rounding errors of a projection are larger than the error of a step by h. With the
 * rounding error e, the relative pivot p and the rate w, projection causes errors of e / p in the
 * direction of the velocity. A step of order k causes errors of about (h w)^(k+1) / 100. */
static bool is_below_rounding(const baum_simulation *run, double h)
{
  double pivot = find_pivot(run);
  if (!(pivot < 1e-4)) {
    return false;
  }
  double rate = baum_i_scaled_size(run->workspace->mechanism, run->spare.v);
  double error = 0.01 * pow(rate * fabs(h), run->integrator->order + 1);
  return pivot * error < DBL_EPSILON;
}

baum_status baum_i_run_project(baum_simulation *run, double t)
{
  baum_i_state *trial = &run->trial;
  baum_i_run_copy(run, trial, &run->spare);
  baum_status status = baum_i_project(run->workspace, t, trial->q, trial->v);
  bool skips = false;
  if (run->crossings && status == BAUM_ERR_CONVERGENCE) {
    skips = may_be_in_pose(run, find_pivot(run)); /* projection need not converge there */
  } else if (run->crossings && status == BAUM_OK) {
    skips = is_below_rounding(run, t - run->state.t);
  }
  skips = skips && !baum_i_rows_are_apart(run->workspace, t, run->spare.q);
  if (skips) {
    baum_i_run_copy(run, &run->spare, trial);
  }
  return skips ? BAUM_OK : status;
}

/* Return the pivot of the present state. If the last knot is the present state, its pivot is
 * returned, otherwise the pivot of the last solution. */
static double find_present_pivot(const baum_simulation *run)
{
  const baum_i_crossings *p = run->crossings;
  const baum_i_knot *last = p->recent_count > 0 ? baum_i_last_knot(p) : NULL;
  return last && last->t == run->state.t ? last->pivot : find_pivot(run);
}

/* The workspace is evaluated again at the present state afterwards, because methods may read it at
 * the start of a step. */
baum_status baum_i_run_limit_acceleration(baum_simulation *run)
{
  baum_workspace *w = run->workspace;
  const baum_i_state *state = &run->state;
  if (!run->crossings || !may_be_in_pose(run, find_present_pivot(run))) {
    return BAUM_OK;
  }
  baum_i_probe probe;
  baum_i_probe_begin(&probe, w);
  if (!baum_i_rows_are_apart(w, state->t, state->q) &&
      baum_i_limit_acceleration(&run->problem, state, run->trial.q, run->spare.v)) {
    memcpy(run->acceleration, run->spare.v, (size_t)w->mechanism->nv * sizeof *run->spare.v);
  }
  baum_status status = baum_i_problem_motion(&run->problem, state->t, state->q, state->v);
  return baum_i_probe_end(&probe, status);
}
