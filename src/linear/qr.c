/* SPDX-License-Identifier: BSD-3-Clause */
/* Backend "qr": rank-revealing sparse QR, columns ordered by COLAMD.
 *
 * M and S of the scaled saddle-point matrix are weighted with a small w:
 *
 *   K_w = [ w M   J^T ]
 *         [ J    -S/w ]
 *
 * If the smallest singular value of the scaled J is sigma > w, the smallest singular value of K_w
 * is about sigma as well. The smallest singular value of K_1 would be about sigma^2. Columns whose
 * remaining norm is at most 1e-13 count as dependent. Of all vectors that minimize the scaled
 * residual, solve() returns the vector of least norm. K_w is symmetric, so its range is its row
 * space, and the projection of the basic solution onto the range has the least norm. Accelerations
 * are unique if M is positive definite on ker J; the scaled multipliers have the least norm. */
#include <colamd.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/backend.h"
#include "linear/pattern.h"
#include "linear/sparse_qr.h"

static const double weight_root = 0x1p-13; /* square root of w */
static const double dependent = 1e-13;

typedef struct qr_backend {
  baum_i_pattern pattern;
  baum_i_sparse_qr *factors;
  double *work; /* (n) */
  int32_t rank;
  double rcond;
} qr_backend;

static void destroy(void *self)
{
  qr_backend *qr = self;
  if (qr) {
    baum_i_sparse_qr_destroy(qr->factors);
    baum_i_free(qr->work);
    baum_i_pattern_clear(&qr->pattern);
    baum_i_free(qr);
  }
}

/* Returns NULL when out of memory. */
static int32_t *order_columns(const baum_i_pattern *pattern)
{
  int statistics[COLAMD_STATS];
  int32_t entries = pattern->columns.start[pattern->n];
  size_t room = colamd_recommended(entries, pattern->n, pattern->n); /* 0: too many entries */
  int32_t *row = room > 0 ? baum_i_alloc(room, sizeof *row) : NULL;
  int32_t *order = baum_i_copy(pattern->columns.start, (size_t)pattern->n + 1, sizeof *order);
  if (row && order) {
    memcpy(row, pattern->columns.row, (size_t)entries * sizeof *row);
    (void)colamd(pattern->n, pattern->n, (int32_t)room, row, order, NULL, statistics);
  }
  baum_i_free(row);
  if (!row) {
    baum_i_free(order);
    return NULL;
  }
  return order;
}

static baum_status set_up(qr_backend *qr, const baum_i_kkt_structure *structure)
{
  baum_i_pattern *pattern = &qr->pattern;
  BAUM_I_TRY(baum_i_pattern_create(structure, pattern));
  qr->work = baum_i_alloc((size_t)pattern->n, sizeof *qr->work);
  int32_t *order = order_columns(pattern);
  baum_status status = BAUM_ERR_MEMORY;
  if (qr->work && order) {
    const baum_i_sparse_columns columns = {pattern->n, pattern->n, pattern->columns.start,
                                           pattern->columns.row};
    status = baum_i_sparse_qr_create(&columns, order, &qr->factors);
  }
  baum_i_free(order);
  return status;
}

static baum_status create(const baum_i_kkt_structure *structure, void **out)
{
  qr_backend *qr = *out = baum_i_alloc(1, sizeof *qr);
  if (!qr || set_up(qr, structure) != BAUM_OK) {
    destroy(qr);
    *out = NULL;
    return BAUM_ERR_MEMORY;
  }
  return BAUM_OK;
}

/* Projects x[from..to), as a vector that is zero elsewhere, onto the range of K_w. */
static void project_part(qr_backend *qr, int from, int to, double *x)
{
  size_t count = (size_t)(to - from);
  memset(qr->work, 0, (size_t)qr->pattern.n * sizeof *qr->work);
  memcpy(qr->work + from, x + from, count * sizeof *x);
  baum_i_sparse_qr_project(qr->factors, qr->work);
  memcpy(x + from, qr->work + from, count * sizeof *x);
}

/* x <- K_w^+ x. Because M and S are positive semidefinite, the null space is spanned by vectors
 * that contain only velocities and vectors that contain only multipliers. The velocities and the
 * multipliers in x are therefore projected separately. The rounding errors of one part, which w
 * enlarges, then do not enter the other part. */
static void solve_scaled(qr_backend *qr, double *x)
{
  baum_i_sparse_qr_solve(qr->factors, x);
  if (qr->rank < qr->pattern.n) {
    int nv = qr->pattern.structure->nv;
    project_part(qr, 0, nv, x);
    project_part(qr, nv, qr->pattern.n, x);
  }
}

static double largest_of(const double *x, int count)
{
  double largest = 0.0;
  for (int i = 0; i < count; i++) {
    largest = fmax(largest, fabs(x[i]));
  }
  return largest;
}

/* Estimates 1 / (|K_w| |K_w^-1|) by inverse iteration, if the rank is full. Takes two steps,
 * because a single step may miss a singular vector. */
static double estimate_rcond(qr_backend *qr)
{
  int n = qr->pattern.n;
  double growth = 1.0;
  for (int i = 0; i < n; i++) {
    qr->work[i] = i % 3 == 0 ? 1.0 : -0.5;
  }
  for (int step = 0; step < 2; step++) {
    double before = largest_of(qr->work, n);
    for (int i = 0; i < n; i++) {
      qr->work[i] /= before;
    }
    solve_scaled(qr, qr->work);
    growth = fmax(growth, largest_of(qr->work, n));
  }
  return 1.0 / (growth * fmax(largest_of(qr->pattern.matrix, qr->pattern.columns.start[n]), 1.0));
}

static baum_status factor(void *self, const baum_i_kkt_values *values, const double *scale,
                          baum_i_kkt_effort effort)
{
  (void)effort; /* QR has only one way to choose pivots */
  qr_backend *qr = self;
  baum_i_pattern_fill(&qr->pattern, values, scale, weight_root);
  qr->rank = baum_i_sparse_qr_factor(qr->factors, qr->pattern.matrix, dependent, NULL);
  qr->rcond = qr->rank == qr->pattern.n ? estimate_rcond(qr) : 0.0;
  return BAUM_OK;
}

static baum_status solve(void *self, double *x)
{
  qr_backend *qr = self;
  baum_i_pattern_scale(&qr->pattern, x);
  solve_scaled(qr, x);
  baum_i_pattern_scale(&qr->pattern, x);
  return BAUM_OK;
}

static double rcond(const void *self)
{
  const qr_backend *qr = self;
  return qr->rcond;
}

const baum_i_kkt_ops baum_i_qr_ops = {
  .name = "qr",
  .keeps_pivots = false,
  .create = create,
  .factor = factor,
  .solve = solve,
  .rcond = rcond,
  .destroy = destroy,
};
