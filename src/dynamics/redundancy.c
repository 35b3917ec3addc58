/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds permanent redundancy: rows that depend on other rows at the initial configuration and
 * around it.
 *
 * The rank of J D^-1/2 with rows of unit length, where D is the diagonal of M, is determined at the
 * assembled initial configuration and at neighbours on the constraint manifold. The largest of
 * these ranks counts as the rank of the mechanism. The rows outside one largest independent set are
 * redundant, and every solver omits them. The choice of rows may change during a run (row_set.c).
 * An initial configuration of lower rank is singular.
 *
 * At a distance d from a singular configuration, a nearly dependent row amplifies the rounding
 * errors of rows selected after it to 1e-16 / d, so redundant rows may look independent. The rank
 * of such a configuration is ambiguous beyond the first nearly dependent row. In this case the rank
 * of a neighbour is used if it is clear (not ambiguous), and not smaller than the part of the
 * initial rank that is not ambiguous. The initial configuration then counts as singular. If no
 * neighbour has a clear rank, rows are nearly dependent everywhere, like the rows of two pins close
 * to each other, and the ambiguous rank is accepted. If the initial configuration is exactly
 * singular, ambiguous ranks of its neighbours are also accepted. Such ranks occur because the
 * directions of long members change only little from neighbour to neighbour.
 *
 * Rows of velocity level come last in every choice, so the chosen rows of position level are a
 * largest independent set of all rows of position level. The number of chosen rows of position
 * level gives the degrees of freedom of position.
 *
 * To find a neighbour, the configuration is moved along x, a solution of J x = nu in which all
 * degrees of freedom take part, and is then assembled.
 */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/golden.h"
#include "base/message.h"
#include "dynamics/dynamics.h"

enum { NEIGHBOURS = 4 };
/* At an assembled configuration, rounding and assembly leave dependent rows at most 1e-12 away from
 * the span of other rows. Rows farther away than RANK_TOLERANCE are independent. */
static const double RANK_TOLERANCE = 1e-10;
/* Rows farther away than CLEAR are clearly independent. The rounding errors that they amplify stay
 * below RANK_TOLERANCE. */
static const double CLEAR = 1e-5;
/* Rows farther away than FIRST are selected first. After assembly, dependent rows contradict the
 * selected rows by 1e-14, and the motion contains this error divided by the distance of a selected
 * row from the span of the others. */
static const double FIRST = 1e-3;
/* Scaled distances of the neighbours from the initial configuration. */
static const double DISTANCE[NEIGHBOURS] = {0.02, -0.03, 0.05, -0.07};

/* The rank at a configuration. If both numbers are equal, the rank is certain (clear). */
typedef struct rank_found {
  int all;
  int clear; /* rank without nearly dependent rows */
} rank_found;

typedef struct search {
  baum_workspace *w;
  double *start; /* (nq) assembled configuration */
  double *q;     /* (nq) configuration of a neighbour */
  double *x;     /* (nv) direction */
  rank_found kept;
} search;

/* Find the rank at a configuration. J, M and nu of this configuration stay in the workspace. */
static baum_status find_rank(const search *s, double t, const double *q, rank_found *rank)
{
  static const double tolerances[] = {FIRST, CLEAR, RANK_TOLERANCE};
  baum_workspace *w = s->w;
  BAUM_I_TRY(baum_i_position_stage(w, t, q));
  baum_i_column_scales(w, w->work_v);
  memset(w->rows.selected, 0, (size_t)w->mechanism->nc);
  rank->all = 0;
  for (int k = 0; k < 3 && rank->all < w->mechanism->nc; k++) {
    BAUM_I_TRY(baum_i_select_rows(w, tolerances[k], &rank->all));
    rank->clear = tolerances[k] >= CLEAR ? rank->all : rank->clear;
  }
  return BAUM_OK;
}

/* Return the part of the rank that is certain. It counts the clearly independent rows and the first
 * nearly dependent row, which rounding does not yet affect. */
static int least_rank(const rank_found *rank)
{
  return rank->clear + (rank->all > rank->clear ? 1 : 0);
}

/* Tell whether `rank` replaces `other`. The comparison uses the results of least_rank(). If they
 * are equal, it uses the numbers of clearly independent rows. If these are equal, too, it uses the
 * numbers of independent rows. */
static bool is_better(const rank_found *rank, const rank_found *other)
{
  int more = least_rank(rank) - least_rank(other);
  more = more == 0 ? rank->clear - other->clear : more;
  more = more == 0 ? rank->all - other->all : more;
  return more > 0;
}

static void set_omitted(search *s, const rank_found *rank)
{
  baum_i_row_set *r = &s->w->rows;
  int nc = s->w->mechanism->nc;
  s->kept = *rank;
  r->rank = rank->all;
  r->position_rank = rank->all;
  r->count = nc - rank->all;
  for (int i = 0; i < nc; i++) {
    bool of_velocity = baum_i_is_velocity_row(s->w->mechanism, i);
    r->omitted[i] = r->selected[i] ? 0 : 1;
    r->position_rank -= r->selected[i] && of_velocity ? 1 : 0;
  }
}

/* ---- neighbours ---- */

/* Solve [M J^T; J -S] [x; .] = [M p; r]. The small S makes the matrix regular if rows are
 * dependent. */
static baum_status solve_direction(const search *s, const double *p, const double *r)
{
  baum_workspace *w = s->w;
  const baum_i_kkt_values values = {.mass = w->mass, .jacobian = w->jacobian, .shift = w->shift};
  memset(w->force, 0, (size_t)w->mechanism->nv * sizeof *w->force);
  baum_i_mass_times(&w->structure, w->mass, p, w->force);
  return baum_i_kkt_factor_and_solve(w->kkt, &values, w->force, r, s->x, w->lambda);
}

static void small_shift(baum_workspace *w)
{
  baum_i_row_mobilities(w, w->shift);
  for (int i = 0; i < w->mechanism->nc; i++) {
    w->shift[i] = w->shift[i] > 0.0 ? 1e-10 * w->shift[i] : 1.0;
  }
}

/* Set s->x to a direction of motion at the configuration in the workspace, and *size to its scaled
 * size, or to 0 if nothing moves. */
static baum_status find_direction(const search *s, double *size)
{
  baum_workspace *w = s->w;
  const baum_mechanism *m = w->mechanism;
  double *p = w->work_v;
  small_shift(w);
  memset(p, 0, (size_t)m->nv * sizeof *p);
  memcpy(w->rhs, w->nu, (size_t)m->nc * sizeof *w->rhs);
  BAUM_I_TRY(solve_direction(s, p, w->rhs));
  double driven = baum_i_scaled_size(m, s->x);
  double push = driven > 0.0 ? driven : 1.0;
  for (int i = 0; i < m->nv; i++) {
    p[i] = push * baum_i_golden(i + 1) * m->scale[i];
  }
  BAUM_I_TRY(solve_direction(s, p, w->rhs));
  *size = baum_i_scaled_size(m, s->x);
  *size = *size > 1e-6 * push ? *size : 0.0;
  return BAUM_OK;
}

/* Try one neighbour; skip it if it cannot be assembled. */
static baum_status try_neighbour(search *s, double t, const double *q, double step)
{
  baum_workspace *w = s->w;
  baum_i_move_from(w->mechanism, q, step, s->x, s->q);
  baum_status status = baum_i_assemble(w, t + step, s->q, NULL, NULL);
  rank_found rank = {0, 0};
  if (status == BAUM_OK) {
    status = find_rank(s, t + step, s->q, &rank);
  }
  if (status == BAUM_OK && is_better(&rank, &s->kept)) {
    set_omitted(s, &rank);
  }
  return status == BAUM_ERR_MEMORY || (status == BAUM_ERR_CALLBACK && !w->point.retry) ? status
                                                                                       : BAUM_OK;
}

static baum_status try_neighbours(search *s, double t, const double *q)
{
  double size = 0.0;
  baum_status status = find_direction(s, &size);
  if (status == BAUM_ERR_MEMORY) {
    return status;
  }
  if (status != BAUM_OK || size == 0.0) {
    return BAUM_OK;
  }
  for (int k = 0; k < NEIGHBOURS; k++) {
    BAUM_I_TRY(try_neighbour(s, t, q, DISTANCE[k] / size));
  }
  return BAUM_OK;
}

/* Omit no row. Contradicting constraints have no redundant rows: omitting a row would hide the
 * contradiction. */
static void keep_all(baum_i_row_set *r, int nc)
{
  r->count = 0;
  memset(r->omitted, 0, (size_t)nc);
}

/* Assemble the configuration first, because rows depend exactly on others only where the
 * constraints are satisfied. */
static baum_status find_rows(search *s, double t, const double *q)
{
  baum_i_row_set *r = &s->w->rows;
  int nc = s->w->mechanism->nc;
  rank_found rank = {0, 0};
  memcpy(s->start, q, (size_t)s->w->mechanism->nq * sizeof *q);
  baum_status status = baum_i_assemble(s->w, t, s->start, NULL, NULL);
  bool fits = status == BAUM_OK;
  BAUM_I_TRY(status == BAUM_ERR_MEMORY ? status : find_rank(s, t, s->start, &rank));
  set_omitted(s, &rank);
  r->rank_at_start = rank.all;
  if (rank.clear == nc) {
    return BAUM_OK; /* rows that are independent here are independent nearby */
  }
  if (!fits) {
    keep_all(r, nc);
    return BAUM_OK;
  }
  status = try_neighbours(s, t, s->start);
  r->rank_at_start = is_better(&s->kept, &rank) ? rank.clear : rank.all;
  if (status != BAUM_OK || r->count == 0) {
    return status;
  }
  BAUM_I_TRY(baum_i_keep_rows_apart(s->w, t, s->start));
  baum_i_kkt **kkt = &s->w->sharing.kkt;
  BAUM_I_TRY(*kkt ? BAUM_OK : baum_i_kkt_create(&s->w->structure, s->w->choice, kkt));
  return baum_i_kkt_prepare(*kkt);
}

baum_status baum_i_find_rows(baum_workspace *workspace, double t, const double *q)
{
  size_t nq = (size_t)workspace->mechanism->nq;
  size_t nv = (size_t)workspace->mechanism->nv;
  keep_all(&workspace->rows, workspace->mechanism->nc);
  workspace->rows.pivot_at_last_selection = 0.0;
  if (workspace->mechanism->nc == 0) {
    return BAUM_OK;
  }
  double *memory = baum_i_alloc(2 * nq + nv, sizeof *memory);
  BAUM_I_TRY(baum_i_check_memory(memory));
  search s = {.w = workspace, .x = memory, .start = memory + nv, .q = memory + nv + nq};
  baum_status status = find_rows(&s, t, q);
  if (status != BAUM_OK) {
    keep_all(&workspace->rows, workspace->mechanism->nc);
  }
  baum_i_free(memory);
  return status;
}
