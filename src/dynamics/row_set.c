/* SPDX-License-Identifier: BSD-3-Clause */
/* Chooses another set of independent rows when the kept rows become nearly dependent.
 *
 * Example: A coupler is carried by three parallel cranks whose ground joints are not in line. The
 * mechanism itself has no singular configurations. Three cranks have one redundant row. Whichever
 * row is omitted, the kept rows describe a parallelogram of two cranks together with a third crank
 * that is held by one row only, and these rows do become dependent in some configurations. Before
 * the motion reaches such a configuration, other rows are omitted, as in coordinate partitioning
 * (Wehage and Haug 1982). Accelerations do not depend on the choice of rows, but multipliers do.
 */
#include "dynamics/row_set.h"

#include <math.h>
#include <string.h>

#include "base/message.h"
#include "dynamics/block_path.h"
#include "dynamics/islands.h"

/* Rows are selected one after another. A row is selected if its distance from the span of the rows
 * selected before it, relative to its length, reaches a limit. Limits are tried from MOST down to
 * WORST, and each is STEP times the one before. The best set is the one at the first limit for
 * which the number of selected rows equals the rank. The set counts as well separated if this limit
 * is above LEAST. To change as few rows as possible, the selection is then repeated with this limit
 * divided by FACTOR, beginning with the rows that are kept now. */
static const double MOST = 0.7;
static const double LEAST = 0.04;
static const double WORST = 1e-3;
static const double STEP = 0.5;
static const double FACTOR = 1.25;

/* A run searches for other rows when the pivot, divided by the largest pivot of the run so far,
 * falls below POOR. The run searches again each time this quotient has changed by a factor of
 * RETRY. */
static const double POOR = 0.2;
static const double RETRY = 3.0;

/* Without suitable pivots, a run searches for other rows when the distance of a kept row by lengths
 * falls below CLOSE. Between two checks it must not fall to zero. */
static const double CLOSE = 0.1;

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

/* Select rows one after another, beginning with the kept rows, if their distance from the span of
 * the rows before them is at least `distance`. *found tells whether the number of selected rows
 * equals the rank. */
static baum_status select_at(baum_workspace *w, double distance, bool *found)
{
  int rank = 0;
  invert(w->rows.omitted, w->mechanism->nc, w->rows.selected);
  baum_status status = baum_i_select_rows(w, distance, &rank);
  *found = status == BAUM_OK && rank == w->rows.rank;
  return status;
}

/* Evaluate J, and set the factors of its columns: the scales of the coordinates if `by_lengths` is
 * true, otherwise 1 / sqrt(M_ii). */
static baum_status prepare_selection(baum_workspace *w, double t, const double *q, bool by_lengths)
{
  BAUM_I_TRY(baum_i_position_stage(w, t, q));
  if (by_lengths) {
    memcpy(w->work_v, w->mechanism->scale, (size_t)w->mechanism->nv * sizeof *w->work_v);
    baum_i_rest_fixed_bodies(w->mechanism, w->work_v);
  } else {
    baum_i_column_scales(w, w->work_v);
  }
  return BAUM_OK;
}

/* Select the best set of rows whose limit is above `least`. Rows that are kept now are preferred.
 * *found tells whether there is such a set. */
static baum_status select_apart(baum_workspace *w, double t, const double *q, bool by_lengths,
                                double least, bool *found)
{
  *found = false;
  BAUM_I_TRY(prepare_selection(w, t, q, by_lengths));
  double distance = MOST;
  while (!*found && distance > least) {
    BAUM_I_TRY(select_at(w, distance, found));
    distance *= STEP;
  }
  return *found ? select_at(w, distance / (STEP * FACTOR), found) : BAUM_OK;
}

/* Select rows by lengths, with as many kept rows as possible. */
static baum_status select_near(baum_workspace *w, double t, const double *q, double distance,
                               bool *found)
{
  *found = false;
  BAUM_I_TRY(prepare_selection(w, t, q, true));
  return select_at(w, distance, found);
}

baum_status baum_i_keep_rows_apart(baum_workspace *w, double t, const double *q)
{
  bool found = false;
  baum_status status = select_apart(w, t, q, false, WORST, &found);
  if (found) {
    invert(w->rows.selected, w->mechanism->nc, w->rows.omitted);
  }
  return status;
}

bool baum_i_rows_are_apart(baum_workspace *w, double t, const double *q)
{
  bool found = false;
  baum_i_kept_message kept = baum_i_message_keep();
  (void)select_near(w, t, q, LEAST, &found);
  if (!found && w->rows.count > 0) {
    (void)select_apart(w, t, q, false, LEAST, &found);
  }
  (void)baum_i_message_settle(BAUM_OK, &kept);
  return found;
}

/* ---- omitted rows ---- */

static void copy_counters(const baum_i_block_path *before, baum_i_block_path *path)
{
  if (before) {
    path->factorizations = before->factorizations;
    path->refinements = before->refinements;
  }
}

/* If the workspace has block paths, create them again for its present rows. */
static baum_status replace_paths(baum_workspace *w)
{
  baum_i_block_verdict verdict;
  baum_i_paths made = {0};
  const baum_i_paths before = {w->path, w->motion};
  BAUM_I_TRY(w->motion ? baum_i_paths_create(w, &verdict, &made) : BAUM_OK);
  if ((w->path && !made.all) || (w->motion && !made.motion)) {
    baum_i_paths_destroy(&made);
    return baum_i_fail(
      BAUM_ERR_UNSUPPORTED,
      "the block solver is not suitable if other redundant rows are omitted than before");
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

/* Omit the rows that are marked in `selected`. */
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
  to->rows.position_rank = from->rows.position_rank;
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

/* Tell whether other rows are selected than those that are kept now. */
static bool has_other_rows(const baum_workspace *w)
{
  bool other = false;
  for (int i = 0; i < w->mechanism->nc; i++) {
    other = other || w->rows.selected[i] == w->rows.omitted[i];
  }
  return other;
}

static bool are_kept_rows_apart(baum_workspace *w, double t, const double *q)
{
  bool found = false;
  (void)select_near(w, t, q, CLOSE, &found);
  return found && !has_other_rows(w);
}

/* Search for a better set of rows and use it. Return true if the rows have changed. */
static bool exchange_rows(baum_workspace *w, double t, const double *q, baum_i_choice choice)
{
  double least = choice.well_separated ? LEAST : WORST;
  bool found = false;
  if (choice.by_lengths) {
    if (are_kept_rows_apart(w, t, q)) {
      return false;
    }
    (void)select_apart(w, t, q, true, least, &found);
  }
  /* In a large mechanism, lengths make the rows of two points close together look dependent. */
  if (!found) {
    (void)select_apart(w, t, q, false, least, &found);
  }
  if (!found || !has_other_rows(w)) {
    return false;
  }
  invert(w->rows.selected, w->mechanism->nc, w->rows.selected);
  return omit_selected(w) == BAUM_OK;
}

/* A failure leaves the rows unchanged. */
bool baum_i_choose_rows(baum_workspace *w, double t, const double *q, double pivot,
                        baum_i_choice choice)
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
  baum_i_kept_message kept = baum_i_message_keep();
  bool changed = exchange_rows(w, t, q, choice);
  rows->pivot_at_last_selection = changed ? 0.0 : pivot;
  (void)baum_i_message_settle(BAUM_OK, &kept);
  return changed;
}

/* ---- contradictions ---- */

/* The error of an omitted row is J a - r, see find_missed(). In 50 000 random mechanisms, rounding
 * caused errors of up to 4e-12 times the accelerations. If the constraints are violated, the error
 * may be larger, as simulate/monitor.c explains. Next to a configuration where the kept rows alone
 * are singular, it may be as large as the square root of the violation. */
static const double CONTRADICTION = 1e-9;
static const double TIMES = 10.0;
/* Rows shorter than this fraction of the longest row contain nothing but rounding errors. */
static const double EMPTY = 1e-6;

/* Find a size [1/s^2] for each island (body_count + 1), with which errors of accelerations are
 * compared. The size is the larger one of two numbers: the squared rate of the motion plus the
 * squared gains, and the largest scaled acceleration that the forces would cause without
 * constraints. The size of the ground is the largest size of all islands. It is used for joints
 * between fixed bodies. */
static void find_acceleration_sizes(const baum_workspace *w, const double *v, double alpha,
                                    double beta, double *size)
{
  const baum_mechanism *m = w->mechanism;
  const double *force = baum_i_solved_force(w);
  double gains = alpha * alpha + beta * beta;
  baum_i_inverse_masses(w, w->work_v);
  for (int k = 0; k <= m->body_count; k++) {
    size[k] = gains;
  }
  for (int k = 1; k <= m->body_count; k++) {
    double *of = &size[w->island[k]];
    for (int i = m->bodies[k]->v; i < m->bodies[k]->v + m->bodies[k]->nv; i++) {
      double rate = fabs(v[i]) / m->scale[i];
      double motion = gains + fmax(rate * rate, fabs(w->a[i]) / m->scale[i]);
      *of = fmax(*of, fmax(motion, fabs(force[i]) * w->work_v[i] / m->scale[i]));
      size[0] = fmax(size[0], *of);
    }
  }
}

static int island_of_row(const baum_workspace *w, int row)
{
  const baum_mechanism *m = w->mechanism;
  return baum_i_island_of_joint(m, w->island, m->joints[baum_i_row_joint(m, row)]);
}

/* Find the largest violation (body_count + 1) of positions or velocities in each island, expressed
 * as a displacement relative to the scales. */
static void find_violations(const baum_workspace *w, const double *length, const double *size,
                            double *violation)
{
  memset(violation, 0, ((size_t)w->mechanism->body_count + 1) * sizeof *violation);
  for (int i = 0; i < w->mechanism->nc; i++) {
    int k = island_of_row(w, i);
    violation[k] = fmax(violation[k], fabs(w->phi[i]) / length[i]);
    violation[k] = fmax(violation[k], fabs(w->phi_rate[i]) / (sqrt(size[k]) * length[i]));
  }
}

static baum_status fail_contradiction(const baum_workspace *w, int row, double part)
{
  return baum_i_fail(
    BAUM_ERR_INCONSISTENT,
    "t = %.9g s: no acceleration satisfies all constraints: if the other rows are "
    "satisfied, a redundant row of %s is violated by %.3g times the accelerations; "
    "constraints contradict each other, or the configuration is singular and the "
    "velocities follow no branch",
    w->point.t, baum_i_row_label(w->mechanism, row).text, part);
}

/* Return the error |J a - r| of an omitted row, where r is the right-hand side of the row. Set
 * *size to the sum of the magnitudes of all terms of this difference. The row of J must be up to
 * date. */
static double find_missed(const baum_workspace *w, int row, double alpha, double beta, double *size)
{
  const baum_i_joint *joint = w->mechanism->joints[baum_i_row_joint(w->mechanism, row)];
  int nl = joint->span.nl;
  const double *entry = w->jacobian + joint->jacobian + (ptrdiff_t)(row - joint->row) * nl;
  double f = baum_i_row_gain(w, row);
  double missed =
    2.0 * f * alpha * w->phi_rate[row] + f * f * beta * beta * w->phi[row] - w->gamma[row];
  *size = fabs(missed);
  for (int k = 0; k < nl; k++) {
    double term = entry[k] * w->a[joint->span.columns[k]];
    missed += term;
    *size += fabs(term);
  }
  return fabs(missed);
}

/* Compare the errors of the omitted rows with the accelerations of their island, and fail if an
 * error is too large. */
static baum_status compare_omitted_rows(baum_workspace *w, const double *v, double alpha,
                                        double beta)
{
  int nc = w->mechanism->nc;
  double *length = w->work_c;
  double *size = w->work_q;
  double *violation = size + w->mechanism->body_count + 1;
  double longest = 0.0;
  double terms = 0.0;
  BAUM_I_TRY(baum_i_need_jacobian(w));
  BAUM_I_TRY(baum_i_evaluate_mass(w));
  baum_i_row_displacements(w, length);
  (void)baum_i_largest(length, nc, &longest);
  for (int i = 0; i < nc; i++) {
    length[i] = fmax(length[i], EMPTY * longest);
  }
  find_acceleration_sizes(w, v, alpha, beta, size);
  find_violations(w, length, size, violation);
  double pivot = baum_i_smallest_pivot(w, NULL);
  for (int i = 0; i < nc; i++) {
    int k = island_of_row(w, i);
    double missed = w->rows.omitted[i] ? find_missed(w, i, alpha, beta, &terms) / length[i] : 0.0;
    double amplified = violation[k] * fmin(1.0, violation[k] / pivot);
    double most = missed > 0.0 ? size[k] * (CONTRADICTION + TIMES * sqrt(amplified)) : 0.0;
    BAUM_I_TRY(missed <= most ? BAUM_OK : fail_contradiction(w, i, missed / size[k]));
  }
  return BAUM_OK;
}

/* First compare the error of each row only with the terms of the same row. This is cheap, and
 * usually the errors are already small enough. */
baum_status baum_i_check_omitted_rows(baum_workspace *w, const double *v, double alpha, double beta)
{
  bool met = true;
  double size = 0.0;
  for (int i = 0; i < w->mechanism->nc; i++) {
    met =
      met && (!w->rows.omitted[i] || find_missed(w, i, alpha, beta, &size) <= CONTRADICTION * size);
  }
  return met ? BAUM_OK : compare_omitted_rows(w, v, alpha, beta);
}
