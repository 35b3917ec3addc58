/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes Newton's matrix of a step from the matrix of the residual (dae_matrix.c) with y = (q, v,
 * lambda) and c = by_a / by_v. In that matrix, the columns of v contain c M - g_v. They are
 * multiplied by by_v and added to the columns of q. Newton's matrix has no rows for q' - N v. The
 * place to which each entry is added is found only once, when the matrix is created.
 */
#include "dynamics/step_matrix.h"

#include <string.h>

#include "base/alloc.h"
#include "base/message.h"

/* The factors by which entries of the full matrix (dae_matrix.c) are multiplied. */
enum { BY_NOTHING, BY_SCALE, BY_SCALE_V, BY_ONE, BY_V, FACTORS };

struct baum_i_step_matrix {
  baum_i_residual_matrix *form;
  double *full;          /* values of the full matrix, whose pattern is in `form` */
  unsigned char *factor; /* the factor of each value: BY_NOTHING and so on */
  /* Pattern of Newton's matrix, which has nv + nc columns. There is one slot for each value in
   * `full` whose factor is not BY_NOTHING. Slots and values have the same order. */
  baum_i_compressed pattern;
  double *values;
  baum_i_sparse_lu *lu;
};

static int32_t count_full(const baum_i_step_matrix *matrix)
{
  const baum_i_compressed *full = baum_i_residual_matrix_pattern(matrix->form);
  return full->start[full->n];
}

static unsigned char factor_of(int nv, int row, int column)
{
  if (row < nv) {
    return BY_NOTHING;
  }
  if (row >= 2 * nv && column >= nv && column < 2 * nv) {
    return BY_V; /* J of rows of velocity level */
  }
  if (row >= 2 * nv || column >= 2 * nv) {
    return BY_ONE;
  }
  return column < nv ? BY_SCALE : BY_SCALE_V;
}

/* Set the factors of all values, and find the places in Newton's matrix to which the values are
 * added. */
static baum_status find_pattern(baum_i_step_matrix *matrix, int nv)
{
  const baum_i_compressed *full = baum_i_residual_matrix_pattern(matrix->form);
  baum_i_places places = {0};
  for (int32_t j = 0; j < full->n; j++) {
    for (int32_t k = full->start[j]; k < full->start[j + 1]; k++) {
      matrix->factor[k] = factor_of(nv, full->row[k], j);
      if (matrix->factor[k] != BY_NOTHING) {
        baum_i_places_add(&places, full->row[k] - nv, j < nv ? j : j - nv);
      }
    }
  }
  return baum_i_compress(&places, full->n - nv, &matrix->pattern);
}

static baum_status fill(const baum_workspace *w, baum_i_step_matrix *matrix)
{
  BAUM_I_TRY(baum_i_residual_matrix_create(w, BAUM_RESIDUAL_INDEX3, &matrix->form));
  size_t full = (size_t)count_full(matrix);
  matrix->full = baum_i_alloc(full, sizeof *matrix->full);
  matrix->factor = baum_i_alloc(full, 1);
  const baum_i_compressed *p = &matrix->pattern;
  bool complete = matrix->full && matrix->factor &&
                  find_pattern(matrix, w->mechanism->nv) == BAUM_OK &&
                  baum_i_sparse_lu_create(p->n, p->start, p->row, &matrix->lu) == BAUM_OK;
  matrix->values = complete ? baum_i_alloc((size_t)p->start[p->n], sizeof *matrix->values) : NULL;
  return matrix->values ? BAUM_OK : baum_i_fail_memory();
}

baum_status baum_i_step_matrix_create(const baum_workspace *workspace, baum_i_step_matrix **out)
{
  *out = baum_i_alloc(1, sizeof **out);
  baum_status status = *out ? fill(workspace, *out) : baum_i_fail_memory();
  if (status != BAUM_OK) {
    baum_i_step_matrix_destroy(*out);
    *out = NULL;
  }
  return status;
}

void baum_i_step_matrix_destroy(baum_i_step_matrix *matrix)
{
  if (matrix) {
    baum_i_residual_matrix_destroy(matrix->form);
    baum_i_sparse_lu_destroy(matrix->lu);
    baum_i_free(matrix->full);
    baum_i_free(matrix->factor);
    baum_i_compressed_clear(&matrix->pattern);
    baum_i_free(matrix->values);
    baum_i_free(matrix);
  }
}

baum_status baum_i_step_matrix_factor(baum_i_step_matrix *matrix, baum_workspace *w,
                                      const baum_i_step_ratios *ratios, double t, const double *y,
                                      const double *dy)
{
  static const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX3};
  double c = ratios->by_a / ratios->by_v;
  BAUM_I_TRY(baum_i_residual_matrix_fill(matrix->form, w, &dae, c, t, y, dy, matrix->full));
  const double factors[FACTORS] = {[BY_SCALE] = ratios->scale,
                                   [BY_SCALE_V] = ratios->scale * ratios->by_v,
                                   [BY_ONE] = 1.0,
                                   [BY_V] = ratios->by_v};
  const baum_i_compressed *p = &matrix->pattern;
  const int32_t *slot = p->slot;
  int32_t full = count_full(matrix);
  memset(matrix->values, 0, (size_t)p->start[p->n] * sizeof *matrix->values);
  for (int32_t k = 0; k < full; k++) {
    if (matrix->factor[k] != BY_NOTHING) {
      matrix->values[*slot++] += factors[matrix->factor[k]] * matrix->full[k];
    }
  }
  baum_status status = baum_i_sparse_lu_factor(matrix->lu, matrix->values);
  return status == BAUM_ERR_MEMORY ? baum_i_fail_memory() : status;
}

void baum_i_step_matrix_forget(baum_i_step_matrix *matrix)
{
  baum_i_sparse_lu_forget(matrix->lu);
}

void baum_i_step_matrix_solve(baum_i_step_matrix *matrix, double *x)
{
  baum_i_sparse_lu_solve(matrix->lu, x);
}

baum_i_sparse_lu_work baum_i_step_matrix_work(const baum_i_step_matrix *matrix)
{
  return baum_i_sparse_lu_get_work(matrix->lu);
}
