/* SPDX-License-Identifier: BSD-3-Clause */
/* What may stop a run before its next step: the user, progress, too many steps. */
#include "simulate/run.h"

void baum_simulation_cancel(baum_simulation *simulation)
{
  if (simulation) {
    atomic_store(&simulation->cancelled, 1);
  }
}

double baum_i_seconds_since(const struct timespec *then)
{
  struct timespec now;
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)(now.tv_sec - then->tv_sec) + 1e-9 * (double)(now.tv_nsec - then->tv_nsec);
}

static bool progress_cancels(baum_simulation *run)
{
  const baum_simulation_options *o = &run->options;
  if (!o->progress || baum_i_seconds_since(&run->last_progress) < o->progress_interval) {
    return false;
  }
  (void)clock_gettime(CLOCK_MONOTONIC, &run->last_progress);
  return o->progress(run, run->state.t, o->user) != 0;
}

baum_status baum_i_run_may_go_on(baum_simulation *run, int64_t taken)
{
  double t = baum_i_problem_has_fixed_step(&run->problem) ? run->state.t : run->ahead.t;
  if (atomic_exchange(&run->cancelled, 0) != 0 || progress_cancels(run)) {
    return baum_i_fail(BAUM_STOP_CANCELLED, "t = %.9g s: cancelled", t);
  }
  if (taken >= run->options.max_steps) {
    return baum_i_fail(BAUM_ERR_STEP, "t = %.9g s: max_steps = %lld steps taken in one call", t,
                       (long long)run->options.max_steps);
  }
  return BAUM_OK;
}
