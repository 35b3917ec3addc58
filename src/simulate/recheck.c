/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks the derivatives of user functions again during a run, because the check at the start sees
 * only configurations near the design configuration, and times up to 1.3 s.
 *
 * A check costs about as much as 7 evaluations of a user constraint with all derivatives. The
 * number of steps between two checks doubles, so a run of n steps makes about log2(n / 32) checks.
 * A call that advances the run checks its last state, unless this is too soon after the last
 * check. */
#include <math.h>

#include "mechanism/general/check.h"
#include "simulate/run.h"

enum { FIRST = 32, LEAST = 16 }; /* [steps] */

bool baum_i_run_find_wrong_derivative(baum_simulation *run, const baum_i_state *at, int *joint)
{
  baum_workspace *w = run->workspace;
  double rate = fmax(baum_i_scaled_size(w->mechanism, at->v), 1.0);
  const baum_i_run_state state = {
    .t = at->t, .q = at->q, .v = at->v, .unit = 1.0 / rate, .beside = run->spare.q};
  return run->has_functions && baum_i_check_at(&w->point, &state, joint) != BAUM_OK;
}

void baum_i_run_recheck(baum_simulation *run, const baum_i_state *at, bool ends_call)
{
  int64_t last = run->rechecked;
  int64_t next = ends_call ? last + last / 2 + (last > 0 ? LEAST : 1) : 2 * last + FIRST;
  if (!run->has_functions || !run->options.check_derivatives || run->counters.steps < next ||
      baum_i_run_has_warned(run, BAUM_WARNING_WRONG_DERIVATIVE)) {
    return;
  }
  run->rechecked = run->counters.steps;
  int joint = BAUM_I_NO_JOINT;
  const baum_i_kept_message message = baum_i_message_keep();
  if (baum_i_run_find_wrong_derivative(run, at, &joint)) {
    baum_i_run_warn(run, BAUM_WARNING_WRONG_DERIVATIVE, at->t, joint,
                    "t = %.9g s: %.300s; correct this function", at->t, baum_message());
  }
  (void)baum_i_message_settle(BAUM_OK, &message);
}
