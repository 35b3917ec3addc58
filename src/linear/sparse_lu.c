/* SPDX-License-Identifier: BSD-3-Clause */
/* Sparse LU by KLU of SuiteSparse, 32-bit indices.
 *
 * klu_refactor keeps the pivots and allocates nothing. It may return KLU_OK with a useless result
 * if pivots have become small since they were chosen. In this case klu_rcond, the ratio of the
 * smallest to the largest pivot, is smaller than it was when the pivots were chosen. Newly chosen
 * pivots are accepted whatever their ratio is.
 */
#include "linear/sparse_lu.h"

#include <stdbool.h>

#include <klu.h>

#include "base/alloc.h"
#include "base/message.h"

/* New pivots are chosen if klu_rcond has fallen below this fraction of its value when the present
 * pivots were chosen. */
static const double FALLEN = 1e-4;

struct baum_i_sparse_lu {
  int32_t n;
  int32_t *columns; /* KLU takes non-const pointers, but never changes these arrays */
  int32_t *rows;
  klu_common common;
  klu_symbolic *symbolic;
  klu_numeric *numeric;
  bool forgotten; /* the next factorization chooses new pivots */
  double chosen;  /* rcond when the pivots were chosen */
  baum_i_sparse_lu_work work;
};

void baum_i_sparse_lu_destroy(baum_i_sparse_lu *lu)
{
  if (!lu) {
    return;
  }
  if (lu->numeric) {
    (void)klu_free_numeric(&lu->numeric, &lu->common);
  }
  if (lu->symbolic) {
    (void)klu_free_symbolic(&lu->symbolic, &lu->common);
  }
  baum_i_free(lu->columns);
  baum_i_free(lu->rows);
  baum_i_free(lu);
}

static bool set_up(baum_i_sparse_lu *lu, const int32_t *columns, const int32_t *rows)
{
  (void)klu_defaults(&lu->common); /* fails for NULL only */
  lu->common.scale = 2;            /* scale rows by their largest entry */
  lu->common.halt_if_singular = 1;
  lu->columns = baum_i_copy(columns, (size_t)lu->n + 1, sizeof *columns);
  lu->rows = baum_i_copy(rows, (size_t)columns[lu->n], sizeof *rows);
  if (!lu->columns || !lu->rows) {
    return false;
  }
  lu->symbolic = klu_analyze(lu->n, lu->columns, lu->rows, &lu->common);
  return lu->symbolic != NULL;
}

baum_status baum_i_sparse_lu_create(int32_t n, const int32_t *columns, const int32_t *rows,
                                    baum_i_sparse_lu **out)
{
  *out = NULL;
  baum_i_sparse_lu *lu = baum_i_alloc(1, sizeof *lu);
  if (!lu) {
    return BAUM_ERR_MEMORY;
  }
  lu->n = n;
  if (!set_up(lu, columns, rows)) {
    baum_i_sparse_lu_destroy(lu);
    return BAUM_ERR_MEMORY;
  }
  *out = lu;
  return BAUM_OK;
}

static baum_status judge(baum_i_sparse_lu *lu, bool done)
{
  if (!done) {
    return lu->common.status == KLU_SINGULAR ? BAUM_ERR_SINGULAR : BAUM_ERR_MEMORY;
  }
  (void)klu_rcond(lu->symbolic, lu->numeric, &lu->common);
  return BAUM_OK;
}

baum_status baum_i_sparse_lu_choose(baum_i_sparse_lu *lu, double *values, double threshold)
{
  lu->common.rcond = 0.0;
  lu->common.tol = threshold;
  if (lu->numeric) {
    (void)klu_free_numeric(&lu->numeric, &lu->common);
  }
  lu->numeric = klu_factor(lu->columns, lu->rows, values, lu->symbolic, &lu->common);
  return judge(lu, lu->numeric != NULL);
}

baum_status baum_i_sparse_lu_keep(baum_i_sparse_lu *lu, double *values)
{
  lu->common.rcond = 0.0;
  bool done = klu_refactor(lu->columns, lu->rows, values, lu->symbolic, lu->numeric, &lu->common) &&
              lu->common.status == KLU_OK;
  return done ? judge(lu, true) : BAUM_ERR_SINGULAR;
}

double baum_i_sparse_lu_rcond(const baum_i_sparse_lu *lu)
{
  return lu->common.rcond;
}

baum_status baum_i_sparse_lu_factor(baum_i_sparse_lu *lu, double *values)
{
  lu->work.factorizations++;
  if (lu->numeric && !lu->forgotten && baum_i_sparse_lu_keep(lu, values) == BAUM_OK &&
      lu->common.rcond >= FALLEN * lu->chosen) {
    return BAUM_OK;
  }
  lu->work.full_factorizations++;
  lu->forgotten = false;
  BAUM_I_TRY(baum_i_sparse_lu_choose(lu, values, BAUM_I_USUAL_THRESHOLD));
  lu->chosen = lu->common.rcond;
  return BAUM_OK;
}

void baum_i_sparse_lu_take_scaled(baum_i_sparse_lu *lu)
{
  lu->common.scale = -1;
}

void baum_i_sparse_lu_forget(baum_i_sparse_lu *lu)
{
  lu->forgotten = true;
}

void baum_i_sparse_lu_solve(baum_i_sparse_lu *lu, double *x)
{
  (void)klu_solve(lu->symbolic, lu->numeric, lu->n, 1, x, &lu->common);
}

baum_i_sparse_lu_work baum_i_sparse_lu_get_work(const baum_i_sparse_lu *lu)
{
  return lu->work;
}
