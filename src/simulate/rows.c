/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows that are left out as redundant, chosen anew on the way.
 *
 * How many rows can be spared is the mechanism's; which ones may depend on the pose. Two pins between the same two bodies
 * hold with three rows of four, but whichever three these are, twice in every turn they do no longer: the arm between
 * the pins then lies along the axis of the single row. So when pivots have become small beside those that the rows had, the
 * rows that are farthest apart in the present pose are found, and taken if they are so decisively. In a pose that is
 * singular by itself they are not.
 */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "simulate/account.h"
#include "simulate/passage.h"

/* Pivots, of the largest since the last choice. Where there was nothing better, the next choice is when they have become so
 * small beside those of then: it costs memory and time, and what makes them small may come again and again. */
static const double POOR = 0.35;
static const double WHILE = 0.3; /* [rad] */

/* [-] At the end of the last step, as it was noted. */
static double find_pivot(const baum_i_passages *p)
{
  return p->recent[p->recent_count - 1].pivot * p->usual;
}

/* Other solvers tell pivots too roughly: there it is time after a while, and what is looked at costs little beside their
 * own work. */
static bool is_while_ago(baum_simulation *run)
{
  double rate = baum_i_scaled_size(run->workspace->mechanism, run->state.v);
  bool ago = fabs(run->state.t - run->rows_looked_at) * rate > WHILE;
  run->rows_looked_at = ago ? run->state.t : run->rows_looked_at;
  return ago;
}

/* Whether it is time for a choice. */
static bool are_poor(baum_simulation *run)
{
  const baum_workspace *w = run->workspace;
  const baum_i_passages *p = run->passages;
  if (w->redundancy.count == 0 || w->immobile || !p || p->recent_count == 0) {
    return false;
  }
  if (!w->path) {
    return is_while_ago(run);
  }
  double pivot = find_pivot(p);
  bool poor = pivot < POOR * run->row_pivot;
  if (poor || (!run->rows_are_best && pivot > run->row_pivot)) {
    run->row_pivot = pivot;
  }
  return poor;
}

baum_status baum_i_run_take_rows(baum_simulation *run, const unsigned char *dropped)
{
  baum_i_run_count(run);
  baum_status status = baum_i_leave_out_rows(run->workspace, dropped);
  baum_i_run_count_from_here(run); /* without what solvers have counted that were given up */
  return status == BAUM_OK && run->beside ? baum_i_leave_out_rows(run->beside, dropped) : status;
}

/* By what rows are off that were left out so far, next to a pose by much more than those that were kept, would go on as a
 * motion of its own. A violation that was given stays. */
static void settle(baum_simulation *run)
{
  baum_i_state *trial = &run->trial;
  if (run->options.start == BAUM_START_AS_GIVEN) {
    return;
  }
  baum_i_run_copy(run, &run->state, trial);
  if (baum_i_project(run->workspace, trial->t, trial->q, trial->v) == BAUM_OK) {
    baum_i_run_copy(run, trial, &run->state);
  }
}

/* Others, where these are better. */
static baum_status choose(baum_simulation *run, bool *changed)
{
  baum_workspace *w = run->workspace;
  const baum_i_state *state = &run->state;
  unsigned char *dropped = baum_i_alloc((size_t)w->mechanism->nc, 1);
  if (!dropped) {
    return baum_i_fail_memory();
  }
  baum_status status = baum_i_find_better_rows(w, state->t, state->q, dropped, changed);
  if (status == BAUM_OK && *changed) {
    status = baum_i_run_take_rows(run, dropped);
    *changed = status == BAUM_OK;
  }
  baum_i_free(dropped);
  if (*changed) {
    settle(run);
  }
  return status;
}

/* What a function of the user answers here says nothing of the motion. */
baum_status baum_i_run_choose_rows(baum_simulation *run)
{
  if (!are_poor(run)) {
    return BAUM_OK;
  }
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  if (run->account) {
    baum_i_account_read(run, &run->state);
  }
  bool changed = false;
  baum_status status = choose(run, &changed);
  if (status == BAUM_ERR_MEMORY) {
    return status;
  }
  (void)baum_i_message_settle(BAUM_OK, &kept);
  run->rows_are_best = !changed;
  if (!changed) {
    return BAUM_OK;
  }
  run->row_pivot = 0.0;
  baum_i_passages_forget(run->passages); /* the pose near was one of the other rows */
  run->passages->usual = 0.0;
  return baum_i_run_begin_anew(run);
}
