/* SPDX-License-Identifier: BSD-3-Clause */
/* Choice of another set of independent rows when the kept rows become nearly dependent.
 *
 * Three parallel cranks out of line turn freely. But whichever row is omitted, the rest is a
 * parallelogram of two cranks with a third crank on one row, which has singular configurations of
 * its own. Before the motion reaches these, other rows are omitted, like a repartition of
 * coordinates (Wehage and Haug 1982). Accelerations do not depend on the choice, but multipliers
 * do.
 */
#include "dynamics/row_set.h"

#include <string.h>

#include "base/message.h"
#include "dynamics/block_path.h"

/* Limits on the distance of a row from the span of the rows before, relative to its length: from
 * MOST to LEAST by factors STEP. The largest limit that enough rows for the rank reach gives a
 * well-separated set. This set replaces the kept rows if they do not reach the limit divided by
 * FACTOR. */
static const double MOST = 0.7;
static const double LEAST = 0.04;
static const double STEP = 0.5;
static const double FACTOR = 1.25;

/* Below this pivot the run searches for other rows, and again each time the pivot has changed by a
 * factor of RETRY. */
static const double POOR = 0.2;
static const double RETRY = 3.0;

/* ---- well-separated rows ---- */

static void invert(const unsigned char *flags, int count, unsigned char *out)
{
  for (int i = 0; i < count; i++) {
    out[i] = flags[i] ? 0 : 1;
  }
}

baum_status baum_i_select_rows(baum_workspace *w, double distance, int *rank)
{
  const baum_mechanism *m = w->mechanism;
  unsigned char *selected = w->rows.selected;
  baum_status status =
    baum_i_jacobian_rank(&w->structure, w->jacobian, w->work_v, distance, rank, selected);
  if (status != BAUM_OK) {
    return status == BAUM_ERR_NOT_FINITE ? baum_i_fail_not_finite(w) : status;
  }
  *rank += m->fixed_nv;
  for (int k = 0; k < m->joint_count && m->fixed_count > 0; k++) {
    if (m->joints[k]->fixes) {
      memset(selected + m->joints[k]->row, 1, (size_t)m->joints[k]->rows);
    }
  }
  return BAUM_OK;
}

/* Select independent rows at this distance, the kept ones first; *found: there are enough. */
static baum_status select_at(baum_workspace *w, double distance, bool *found)
{
  int rank = 0;
  invert(w->rows.omitted, w->mechanism->nc, w->rows.selected);
  baum_status status = baum_i_select_rows(w, distance, &rank);
  *found = status == BAUM_OK && rank == w->rows.rank;
  return status;
}

/* Select well-separated rows, preferably those that are kept now. */
static baum_status select_apart(baum_workspace *w, double t, const double *q, bool *found)
{
  *found = false;
  BAUM_I_TRY(baum_i_position_stage(w, t, q));
  baum_i_column_scales(w, w->work_v);
  double distance = MOST;
  while (!*found && distance > LEAST) {
    BAUM_I_TRY(select_at(w, distance, found));
    distance *= STEP;
  }
  return *found ? select_at(w, distance / (STEP * FACTOR), found) : BAUM_OK;
}

/* The same with scales in place of masses. */
static baum_status select_apart_by_lengths(baum_workspace *w, double t, const double *q,
                                           bool *found)
{
  const baum_mechanism *m = w->mechanism;
  *found = false;
  BAUM_I_TRY(baum_i_position_stage(w, t, q));
  memcpy(w->work_v, m->scale, (size_t)m->nv * sizeof *m->scale);
  baum_i_rest_fixed_bodies(m, w->work_v);
  return select_at(w, LEAST, found);
}

baum_status baum_i_keep_rows_apart(baum_workspace *w, double t, const double *q)
{
  bool found = false;
  baum_status status = select_apart(w, t, q, &found);
  if (found) {
    invert(w->rows.selected, w->mechanism->nc, w->rows.omitted);
  }
  return status;
}

bool baum_i_rows_are_apart(baum_workspace *w, double t, const double *q)
{
  bool found = false;
  baum_i_kept_message kept;
  baum_i_message_keep(&kept);
  (void)select_apart_by_lengths(w, t, q, &found);
  if (!found && w->rows.count > 0) {
    (void)select_apart(w, t, q, &found);
  }
  (void)baum_i_message_settle(BAUM_OK, &kept);
  return found;
}

/* ---- omitted ---- */

static void copy_counters(const baum_i_block_path *before, baum_i_block_path *path)
{
  if (before) {
    path->factorizations = before->factorizations;
    path->refinements = before->refinements;
  }
}

/* Create the paths again for the rows of the workspace, if it has paths. */
static baum_status replace_paths(baum_workspace *w)
{
  baum_i_block_verdict verdict;
  baum_i_paths made = {0};
  const baum_i_paths before = {w->path, w->motion};
  BAUM_I_TRY(w->motion ? baum_i_paths_create(w, &verdict, &made) : BAUM_OK);
  if ((w->path && !made.all) || (w->motion && !made.motion)) {
    baum_i_paths_destroy(&made);
    return baum_i_fail(BAUM_ERR_UNSUPPORTED, "blocks cannot solve for the other rows");
  }
  copy_counters(before.all, made.all);
  copy_counters(before.motion, made.motion);
  w->path = made.all;
  w->motion = made.motion;
  w->solved_by = NULL;
  w->eliminated_by = NULL;
  w->mass_ready = false;
  w->jacobian_ready = false;
  baum_i_workspace_forget(w);
  baum_i_paths_destroy(&before);
  return BAUM_OK;
}

static void swap_sets(baum_i_row_set *rows)
{
  unsigned char *omitted = rows->omitted;
  rows->omitted = rows->selected;
  rows->selected = omitted;
}

/* Omit the rows marked in `selected`. */
static baum_status omit_selected(baum_workspace *w)
{
  swap_sets(&w->rows);
  baum_status status = replace_paths(w);
  if (status != BAUM_OK) {
    swap_sets(&w->rows);
  }
  return status;
}

baum_status baum_i_omit_rows(baum_workspace *w, const unsigned char *omitted)
{
  size_t nc = (size_t)w->mechanism->nc;
  if (memcmp(w->rows.omitted, omitted, nc) == 0) {
    return BAUM_OK;
  }
  memcpy(w->rows.selected, omitted, nc);
  return omit_selected(w);
}

void baum_i_copy_rows(baum_workspace *to, const baum_workspace *from)
{
  to->rows.rank = from->rows.rank;
  to->rows.rank_at_start = from->rows.rank_at_start;
  to->rows.count = from->rows.count;
  memcpy(to->rows.omitted, from->rows.omitted, (size_t)from->mechanism->nc);
}

void baum_i_clear_omitted_rows(const baum_workspace *w, double *jacobian)
{
  for (int i = 0; w->rows.count > 0 && i < w->mechanism->nc; i++) {
    if (w->rows.omitted[i]) {
      const baum_i_joint *joint = w->mechanism->joints[baum_i_row_joint(w->mechanism, i)];
      size_t width = (size_t)joint->span.nl;
      memset(jacobian + joint->jacobian + (size_t)(i - joint->row) * width, 0,
             width * sizeof *jacobian);
    }
  }
}

/* ---- choice during a run ---- */

/* Choose other rows; true if they have changed. */
static bool exchange_rows(baum_workspace *w, double t, const double *q)
{
  int nc = w->mechanism->nc;
  unsigned char *selected = w->rows.selected;
  bool found = false;
  if (select_apart(w, t, q, &found) != BAUM_OK || !found) {
    return false;
  }
  invert(selected, nc, selected);
  return memcmp(selected, w->rows.omitted, (size_t)nc) != 0 && omit_selected(w) == BAUM_OK;
}

/* A failure leaves the rows unchanged. */
bool baum_i_choose_rows(baum_workspace *w, double t, const double *q, double pivot)
{
  baum_i_row_set *rows = &w->rows;
  double last = rows->pivot_at_last_selection;
  if (rows->count == 0 || pivot >= POOR) {
    rows->pivot_at_last_selection = 0.0;
    return false;
  }
  if (pivot > last / RETRY && pivot < last * RETRY) {
    return false;
  }
  baum_i_kept_message kept;
  baum_i_message_keep(&kept);
  bool changed = exchange_rows(w, t, q);
  rows->pivot_at_last_selection = changed ? 0.0 : pivot;
  (void)baum_i_message_settle(BAUM_OK, &kept);
  return changed;
}
