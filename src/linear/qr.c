/* SPDX-License-Identifier: BSD-3-Clause */
/* Backend "qr": rank-revealing sparse QR by SPQR of SuiteSparse, and the rank of J.
 *
 * The scaled saddle-point matrix is weighted once more,
 *
 *   K_w = [ w M   J^T ]
 *         [ J    -S/w ]
 *
 * with a small w, because the smallest singular value of K_w is about sigma if that of the scaled J
 * is sigma > w, where that of K_1 is sigma^2. Columns whose remaining norm is at most 1e-13 are
 * taken as dependent. The solution is the one of least norm among those that minimize the scaled
 * residual: K_w is symmetric, its range therefore also its row space, and it is enough to project
 * the basic solution onto it. Accelerations are unique where M is positive definite on ker J;
 * multipliers are of least norm in scaled rows.
 *
 * SPQR allocates in factor and solve. It calls the BLAS, whose threads are the program's business.
 */
#include <SuiteSparseQR_C.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/backend.h"
#include "linear/pattern.h"
#include "linear/peel.h"
#include "linear/scale.h"

static const double weight_root = 0x1p-13; /* of w */
static const double dependent = 1e-13;

enum { RANK_STATISTIC = 4 }; /* of cholmod_common.SPQR_istat */

/* ---- shared by both uses ---- */

static void start(cholmod_common *common)
{
  (void)cholmod_l_start(common); /* fails for NULL only */
  common->print = 0;
  common->try_catch = 1;
  common->error_handler = NULL;
  common->useGPU = 0;
}

static void clear_sparse(cholmod_sparse *sparse)
{
  baum_i_free(sparse->p);
  baum_i_free(sparse->i);
  baum_i_free(sparse->x);
  *sparse = (cholmod_sparse){0};
}

/* Room for a real matrix in compressed columns. */
static bool make_sparse(size_t rows, size_t columns, size_t entries, cholmod_sparse *sparse)
{
  *sparse = (cholmod_sparse){
    .nrow = rows,
    .ncol = columns,
    .nzmax = entries,
    .p = baum_i_alloc(columns + 1, sizeof(SuiteSparse_long)),
    .i = baum_i_alloc(entries, sizeof(SuiteSparse_long)),
    .x = baum_i_alloc(entries, sizeof(double)),
    .itype = CHOLMOD_LONG,
    .xtype = CHOLMOD_REAL,
    .dtype = CHOLMOD_DOUBLE,
    .sorted = 1,
    .packed = 1,
  };
  if (sparse->p && sparse->i && sparse->x) {
    return true;
  }
  clear_sparse(sparse);
  return false;
}

static void widen(const int32_t *from, size_t count, SuiteSparse_long *to)
{
  for (size_t k = 0; k < count; k++) {
    to[k] = from[k];
  }
}

static double largest_of(const double *x, size_t count)
{
  double largest = 0.0;
  for (size_t i = 0; i < count; i++) {
    largest = fmax(largest, fabs(x[i]));
  }
  return largest;
}

/* ---- backend ---- */

typedef struct qr_backend {
  baum_i_pattern pattern;
  cholmod_common common;
  cholmod_sparse matrix;
  SuiteSparseQR_C_factorization *factors;
  double *scale; /* (n) */
  size_t rank;
  double rcond;
  double *work; /* (n) */
} qr_backend;

static void destroy(void *self)
{
  qr_backend *qr = self;
  if (!qr) {
    return;
  }
  (void)SuiteSparseQR_C_free(&qr->factors, &qr->common);
  (void)cholmod_l_finish(&qr->common);
  clear_sparse(&qr->matrix);
  baum_i_free(qr->work);
  baum_i_free(qr->scale);
  baum_i_pattern_clear(&qr->pattern);
  baum_i_free(qr);
}

static bool set_up(qr_backend *qr, const baum_i_kkt_structure *structure)
{
  start(&qr->common);
  if (baum_i_pattern_create(structure, &qr->pattern) != BAUM_OK) {
    return false;
  }
  const baum_i_pattern *pattern = &qr->pattern;
  size_t n = (size_t)pattern->n;
  size_t entries = (size_t)pattern->column_start[n];
  qr->work = baum_i_alloc(n, sizeof *qr->work);
  qr->scale = baum_i_alloc(n, sizeof *qr->scale);
  if (!qr->work || !qr->scale || !make_sparse(n, n, entries, &qr->matrix)) {
    return false;
  }
  widen(pattern->column_start, n + 1, qr->matrix.p);
  widen(pattern->row, entries, qr->matrix.i);
  qr->factors = SuiteSparseQR_C_symbolic(SPQR_ORDERING_COLAMD, 1, &qr->matrix, &qr->common);
  return qr->factors != NULL;
}

static baum_status create(const baum_i_kkt_structure *structure, void **out)
{
  *out = NULL;
  qr_backend *qr = baum_i_alloc(1, sizeof *qr);
  if (!qr) {
    return BAUM_ERR_MEMORY;
  }
  if (!set_up(qr, structure)) {
    destroy(qr);
    return BAUM_ERR_MEMORY;
  }
  *out = qr;
  return BAUM_OK;
}

static void apply_scale(const qr_backend *qr, double *x)
{
  for (int i = 0; i < qr->pattern.n; i++) {
    x[i] *= qr->scale[i];
  }
}

/* x <- the result of SPQR, which is released. */
static baum_status take(qr_backend *qr, cholmod_dense *result, double *x)
{
  if (!result) {
    return BAUM_ERR_MEMORY;
  }
  memcpy(x, result->x, (size_t)qr->pattern.n * sizeof *x);
  (void)cholmod_l_free_dense(&result, &qr->common);
  return BAUM_OK;
}

static cholmod_dense as_column(const qr_backend *qr, double *x)
{
  size_t n = (size_t)qr->pattern.n;
  return (cholmod_dense){
    .nrow = n,
    .ncol = 1,
    .nzmax = n,
    .d = n,
    .x = x,
    .xtype = CHOLMOD_REAL,
    .dtype = CHOLMOD_DOUBLE,
  };
}

/* x <- Q x or Q^T x */
static baum_status multiply(qr_backend *qr, int method, double *x)
{
  cholmod_dense column = as_column(qr, x);
  return take(qr, SuiteSparseQR_C_qmult(method, qr->factors, &column, &qr->common), x);
}

/* x <- E R^-1 x, zero where columns are dependent */
static baum_status solve_triangle(qr_backend *qr, double *x)
{
  cholmod_dense column = as_column(qr, x);
  return take(qr, SuiteSparseQR_C_solve(SPQR_RETX_EQUALS_B, qr->factors, &column, &qr->common), x);
}

/* Project x[from..to), as a vector that is zero elsewhere, onto the range of K_w. */
static baum_status project_part(qr_backend *qr, int from, int to, double *x)
{
  size_t count = (size_t)(to - from);
  memset(qr->work, 0, (size_t)qr->pattern.n * sizeof *qr->work);
  memcpy(qr->work + from, x + from, count * sizeof *x);
  baum_status status = multiply(qr, SPQR_QTX, qr->work);
  for (size_t i = qr->rank; i < (size_t)qr->pattern.n; i++) {
    qr->work[i] = 0.0;
  }
  if (status == BAUM_OK) {
    status = multiply(qr, SPQR_QX, qr->work);
  }
  memcpy(x + from, qr->work + from, count * sizeof *x);
  return status;
}

/* As M and S are positive semidefinite, the null space is spanned by vectors of velocities alone
 * and of multipliers alone. Projecting each for itself keeps the rounding of the one, which w makes
 * large, out of the other. */
static baum_status project(qr_backend *qr, double *x)
{
  int nv = qr->pattern.structure->nv;
  baum_status status = project_part(qr, 0, nv, x);
  return status == BAUM_OK ? project_part(qr, nv, qr->pattern.n, x) : status;
}

/* x <- K_w^+ x */
static baum_status solve_scaled(qr_backend *qr, double *x)
{
  baum_status status = multiply(qr, SPQR_QTX, x);
  if (status == BAUM_OK) {
    status = solve_triangle(qr, x);
  }
  if (status == BAUM_OK && qr->rank < (size_t)qr->pattern.n) {
    status = project(qr, x);
  }
  return status;
}

/* 1 / (|K_w| |K_w^-1|) by inverse iteration, for full rank.
 * Two steps, because a singular vector may hide from one. */
static baum_status estimate_rcond(qr_backend *qr)
{
  size_t n = (size_t)qr->pattern.n;
  double growth = 1.0;
  for (size_t i = 0; i < n; i++) {
    qr->work[i] = i % 3 == 0 ? 1.0 : -0.5;
  }
  for (int step = 0; step < 2; step++) {
    double before = largest_of(qr->work, n);
    for (size_t i = 0; i < n; i++) {
      qr->work[i] /= before;
    }
    if (solve_scaled(qr, qr->work) != BAUM_OK) {
      return BAUM_ERR_MEMORY;
    }
    growth = fmax(growth, largest_of(qr->work, n));
  }
  qr->rcond = 1.0 / (growth * fmax(largest_of(qr->matrix.x, qr->matrix.nzmax), 1.0));
  return BAUM_OK;
}

static baum_status factor(void *self, const baum_i_kkt_values *values, const double *scale,
                          baum_i_kkt_effort effort)
{
  (void)effort; /* there is one way only */
  qr_backend *qr = self;
  qr->rcond = 0.0;
  baum_i_scale_weigh(qr->pattern.structure, values, scale, weight_root, qr->scale);
  baum_i_pattern_fill(&qr->pattern, values, qr->scale, qr->matrix.x);
  (void)SuiteSparseQR_C_numeric(dependent, &qr->matrix, qr->factors, &qr->common);
  if (qr->common.status < CHOLMOD_OK) {
    return BAUM_ERR_MEMORY;
  }
  qr->rank = (size_t)qr->common.SPQR_istat[RANK_STATISTIC];
  return qr->rank == (size_t)qr->pattern.n ? estimate_rcond(qr) : BAUM_OK;
}

static baum_status solve(void *self, double *x)
{
  qr_backend *qr = self;
  apply_scale(qr, x);
  baum_status status = solve_scaled(qr, x);
  apply_scale(qr, x);
  return status;
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

/* ---- rank of J ---- */

static size_t count_entries(const baum_i_kkt_structure *structure)
{
  size_t count = 0;
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    count += (size_t)block->rows * (size_t)block->cols;
  }
  return count;
}

/* J, scaled by columns, and which of its rows are left to be looked at. */
typedef struct scaled_rows {
  const baum_i_kkt_structure *structure;
  const double *jacobian;
  const double *column_scale;
  int *place; /* (nc) among those left, or -1 */
  int left;
} scaled_rows;

/* Those that are left, transposed, as a list of entries. */
static void list_scaled(const scaled_rows *rows, cholmod_triplet *list)
{
  SuiteSparse_long *velocity = list->i;
  SuiteSparse_long *constraint = list->j;
  double *x = list->x;
  for (int b = 0; b < rows->structure->row_block_count; b++) {
    const baum_i_row_block *block = &rows->structure->row_blocks[b];
    const double *value = rows->jacobian + block->value;
    for (int i = 0; i < block->rows && rows->place[block->row + i] >= 0; i++) {
      for (int k = 0; k < block->cols; k++) {
        velocity[list->nnz] = block->col[k];
        constraint[list->nnz] = rows->place[block->row + i];
        x[list->nnz++] = *value++ * rows->column_scale[block->col[k]];
      }
    }
  }
}

static bool entries_are_finite(const scaled_rows *rows)
{
  for (int b = 0; b < rows->structure->row_block_count; b++) {
    const baum_i_row_block *block = &rows->structure->row_blocks[b];
    const double *value = rows->jacobian + block->value;
    for (int k = 0; k < block->rows * block->cols; k++) {
      if (!isfinite(value[k] * rows->column_scale[block->col[k % block->cols]])) {
        return false;
      }
    }
  }
  return true;
}

/* To unit length; by the largest number first, so that squares neither overflow nor vanish. */
static void make_unit(double *x, size_t count)
{
  double largest = largest_of(x, count);
  if (largest == 0.0) {
    return;
  }
  double sum = 0.0;
  for (size_t k = 0; k < count; k++) {
    x[k] /= largest;
    sum += x[k] * x[k];
  }
  for (size_t k = 0; k < count; k++) {
    x[k] /= sqrt(sum);
  }
}

static void make_unit_columns(cholmod_sparse *sparse)
{
  const SuiteSparse_long *start_of = sparse->p;
  double *x = sparse->x;
  for (size_t j = 0; j < sparse->ncol; j++) {
    make_unit(x + start_of[j], (size_t)(start_of[j + 1] - start_of[j]));
  }
}

/* Mark the columns in which a row of the squeezed triangle R begins. */
static void mark_independent(const cholmod_sparse *r, const SuiteSparse_long *order,
                             unsigned char *independent)
{
  const SuiteSparse_long *start_of = r->p;
  const SuiteSparse_long *row = r->i;
  SuiteSparse_long found = 0;
  for (size_t j = 0; j < r->ncol; j++) {
    bool begins = false;
    for (SuiteSparse_long k = start_of[j]; k < start_of[j + 1]; k++) {
      begins = begins || row[k] >= found;
    }
    if (begins) {
      found++;
      independent[order ? order[j] : (SuiteSparse_long)j] = 1;
    }
  }
}

/* Rank of the columns, taken in their order, so that of dependent ones the later are given up. */
static baum_status reveal(cholmod_sparse *transposed, double tolerance, int *rank,
                          unsigned char *independent, cholmod_common *common)
{
  cholmod_sparse *r = NULL;
  SuiteSparse_long *order = NULL;
  SuiteSparse_long found = SuiteSparseQR_C(SPQR_ORDERING_FIXED, tolerance, 0, 0, transposed, NULL,
                                           NULL, NULL, NULL, &r, &order, NULL, NULL, NULL, common);
  baum_status status = found < 0 || !r ? BAUM_ERR_MEMORY : BAUM_OK;
  if (status == BAUM_OK) {
    mark_independent(r, order, independent);
    *rank = (int)found;
  }
  (void)cholmod_l_free_sparse(&r, common);
  (void)cholmod_l_free(transposed->ncol, sizeof *order, order, common);
  return status;
}

static baum_status rank_of_list(cholmod_triplet *list, double tolerance, int *rank,
                                unsigned char *independent, cholmod_common *common)
{
  cholmod_sparse *transposed = cholmod_l_triplet_to_sparse(list, 0, common);
  if (!transposed) {
    return BAUM_ERR_MEMORY;
  }
  make_unit_columns(transposed);
  baum_status status = reveal(transposed, tolerance, rank, independent, common);
  (void)cholmod_l_free_sparse(&transposed, common);
  return status;
}

/* Of the rows that are left; independent (left) arrives zeroed. */
static baum_status rank_by_qr(const scaled_rows *rows, double tolerance, int *rank,
                              unsigned char *independent)
{
  cholmod_common common;
  start(&common);
  baum_status status = BAUM_ERR_MEMORY;
  cholmod_triplet *list =
    cholmod_l_allocate_triplet((size_t)rows->structure->nv, (size_t)rows->left,
                               count_entries(rows->structure), 0, CHOLMOD_REAL, &common);
  if (list) {
    list_scaled(rows, list);
    status = rank_of_list(list, tolerance, rank, independent, &common);
  }
  (void)cholmod_l_free_triplet(&list, &common);
  (void)cholmod_l_finish(&common);
  return status;
}

/* Marked ones first. */
static void order_rows(const scaled_rows *rows, const unsigned char *marked)
{
  int next = 0;
  for (int turn = 0; turn < 2; turn++) {
    for (int i = 0; i < rows->structure->nc; i++) {
      if (rows->place[i] >= 0 && (marked[i] == 0) == (turn == 1)) {
        rows->place[i] = next++;
      }
    }
  }
}

/* found (nc), zeroed, is scratch. */
static baum_status find_rank(scaled_rows *rows, double tolerance, unsigned char *found, int *rank,
                             unsigned char *independent)
{
  int nc = rows->structure->nc;
  int rank_left = 0;
  baum_status status =
    baum_i_peel(rows->structure, rows->jacobian, rows->column_scale, rows->place, &rows->left);
  if (status == BAUM_OK && rows->left > 0) {
    order_rows(rows, independent);
    status = rank_by_qr(rows, tolerance, &rank_left, found);
  }
  if (status != BAUM_OK) {
    return status;
  }
  *rank = nc - rows->left + rank_left;
  for (int i = 0; i < nc; i++) {
    independent[i] = rows->place[i] < 0 ? 1 : found[rows->place[i]];
  }
  return BAUM_OK;
}

baum_status baum_i_jacobian_rank(const baum_i_kkt_structure *structure, const double *jacobian,
                                 const double *column_scale, double tolerance, int *rank,
                                 unsigned char *independent)
{
  size_t nc = (size_t)structure->nc;
  scaled_rows rows = {structure, jacobian, column_scale, NULL, 0};
  if (structure->nv == 0 || nc == 0) {
    *rank = 0;
    memset(independent, 0, nc);
    return BAUM_OK;
  }
  if (!entries_are_finite(&rows)) {
    return BAUM_ERR_NOT_FINITE;
  }
  rows.place = baum_i_alloc(nc, sizeof *rows.place);
  unsigned char *found = baum_i_alloc(nc, 1);
  baum_status status =
    rows.place && found ? find_rank(&rows, tolerance, found, rank, independent) : BAUM_ERR_MEMORY;
  baum_i_free(rows.place);
  baum_i_free(found);
  return status == BAUM_ERR_MEMORY ? baum_i_fail_memory() : status;
}
