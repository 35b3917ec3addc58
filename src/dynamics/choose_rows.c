/* SPDX-License-Identifier: BSD-3-Clause */
/* Which of the redundant rows to leave out, chosen anew where the others come close to dependent.
 *
 * Three parallel cranks out of line turn freely, but whichever row is left out, what stays is a parallelogram of two with
 * a third crank that hangs on one row, and has singular poses of its own. So before these are reached other rows are left
 * out, as coordinates are partitioned anew (Wehage and Haug 1982). Accelerations do not depend on the choice, multipliers
 * do.
 */
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "dynamics/block_path.h"

/* Distances of rows from those before, of their length, that are tried: with the first at which there are as many as the rank
 * they are well apart, and better than those kept if these are not so far apart by FACTOR. */
static const double MOST = 0.7;
static const double LEAST = 0.04;
static const double STEP = 0.5;
static const double FACTOR = 1.25;

/* Below it others are looked for, each time when it has changed by RETRY since. */
static const double POOR = 0.2;
static const double RETRY = 3.0;

/* ---- rows that are well apart ---- */

typedef struct look {
  double *column_scale;       /* (nv) */
  unsigned char *independent; /* (nc) */
} look;

static void finish(look *at)
{
  baum_i_free(at->column_scale);
  baum_i_free(at->independent);
}

static baum_status begin(const baum_mechanism *m, look *at)
{
  at->column_scale = baum_i_alloc((size_t)m->nv, sizeof *at->column_scale);
  at->independent = baum_i_alloc((size_t)m->nc, 1);
  if (at->column_scale && at->independent) {
    return BAUM_OK;
  }
  finish(at);
  return baum_i_fail_memory();
}

static void invert(const unsigned char *flags, int count, unsigned char *out)
{
  for (int i = 0; i < count; i++) {
    out[i] = flags[i] ? 0 : 1;
  }
}

/* As many independent rows as there are at this distance; those that are kept now come first. */
static baum_status find_independent(const baum_workspace *w, double distance, look *at, bool *found)
{
  int rank = 0;
  invert(w->redundancy.omitted, w->mechanism->nc, at->independent);
  baum_status status =
    baum_i_find_independent_rows(w, at->column_scale, distance, &rank, at->independent);
  *found = status == BAUM_OK && rank == w->redundancy.rank;
  return status;
}

/* Those that are kept now, unless others are better. */
static baum_status find_apart(baum_workspace *w, double t, const double *q, look *at, bool *found)
{
  *found = false;
  baum_status status = baum_i_position_stage(w, t, q);
  if (status == BAUM_OK) {
    baum_i_column_scales(w, at->column_scale);
  }
  double distance = MOST;
  while (status == BAUM_OK && !*found && distance > LEAST) {
    status = find_independent(w, distance, at, found);
    distance *= STEP;
  }
  return *found ? find_independent(w, distance / (STEP * FACTOR), at, found) : status;
}

baum_status baum_i_keep_rows_apart(baum_workspace *workspace, double t, const double *q)
{
  look at;
  bool found = false;
  baum_status status = begin(workspace->mechanism, &at);
  if (status != BAUM_OK) {
    return status;
  }
  status = find_apart(workspace, t, q, &at, &found);
  if (found) {
    invert(at.independent, workspace->mechanism->nc, workspace->redundancy.omitted);
  }
  finish(&at);
  return status;
}

/* In the scales, where no mass is light. */
static void find_apart_by_lengths(baum_workspace *w, double t, const double *q, look *at,
                                  bool *found)
{
  const baum_mechanism *m = w->mechanism;
  *found = false;
  if (baum_i_position_stage(w, t, q) == BAUM_OK) {
    memcpy(at->column_scale, m->scale, (size_t)m->nv * sizeof *m->scale);
    baum_i_rest_fixed_bodies(m, at->column_scale);
    (void)find_independent(w, LEAST, at, found);
  }
}

bool baum_i_rows_are_apart(baum_workspace *workspace, double t, const double *q)
{
  look at;
  bool found = false;
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  if (begin(workspace->mechanism, &at) == BAUM_OK) {
    find_apart_by_lengths(workspace, t, q, &at, &found);
    if (!found && workspace->redundancy.count > 0) {
      (void)find_apart(workspace, t, q, &at, &found);
    }
    finish(&at);
  }
  (void)baum_i_message_settle(BAUM_OK, &kept);
  return found;
}

/* ---- left out ---- */

static void go_on_counting(const baum_i_block_path *before, baum_i_block_path *path)
{
  if (before) {
    path->factorizations = before->factorizations;
    path->refinements = before->refinements;
  }
}

/* For the rows of the workspace, where there were such before. */
static baum_status replace_paths(baum_workspace *w)
{
  baum_i_block_verdict verdict;
  baum_i_paths made = {0};
  const baum_i_paths before = {w->path, w->motion};
  BAUM_I_TRY(w->motion ? baum_i_paths_create(w, &verdict, &made) : BAUM_OK);
  if ((w->path && !made.all) || (w->motion && !made.motion)) {
    baum_i_paths_destroy(&made);
    return baum_i_fail(BAUM_ERR_UNSUPPORTED, "other rows cannot be solved for by blocks");
  }
  go_on_counting(before.all, made.all);
  go_on_counting(before.motion, made.motion);
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

baum_status baum_i_omit_rows(baum_workspace *workspace, const unsigned char *omitted)
{
  size_t nc = (size_t)workspace->mechanism->nc;
  if (memcmp(workspace->redundancy.omitted, omitted, nc) == 0) {
    return BAUM_OK;
  }
  unsigned char *before = baum_i_copy(workspace->redundancy.omitted, nc, 1);
  if (!before) {
    return baum_i_fail_memory();
  }
  memcpy(workspace->redundancy.omitted, omitted, nc);
  baum_status status = replace_paths(workspace);
  if (status != BAUM_OK) {
    memcpy(workspace->redundancy.omitted, before, nc);
  }
  baum_i_free(before);
  return status;
}

/* ---- chosen anew ---- */

static baum_status look_for_others(baum_workspace *w, double t, const double *q, bool *changed)
{
  look at;
  bool found = false;
  int nc = w->mechanism->nc;
  baum_status status = begin(w->mechanism, &at);
  if (status != BAUM_OK) {
    return status;
  }
  status = find_apart(w, t, q, &at, &found);
  if (found) {
    invert(at.independent, nc, at.independent);
    *changed = memcmp(at.independent, w->redundancy.omitted, (size_t)nc) != 0;
  }
  if (*changed) {
    status = baum_i_omit_rows(w, at.independent);
    *changed = status == BAUM_OK;
  }
  finish(&at);
  return status;
}

/* What fails here leaves the rows as they are, which are no worse than before. */
bool baum_i_choose_rows(baum_workspace *workspace, double t, const double *q, double pivot)
{
  baum_i_redundancy *r = &workspace->redundancy;
  if (r->count == 0 || pivot >= POOR) {
    r->tried = 0.0;
    return false;
  }
  if (pivot > r->tried / RETRY && pivot < r->tried * RETRY) {
    return false;
  }
  bool changed = false;
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  (void)look_for_others(workspace, t, q, &changed);
  r->tried = changed ? 0.0 : pivot;
  (void)baum_i_message_settle(BAUM_OK, &kept);
  return changed;
}
