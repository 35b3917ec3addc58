/* SPDX-License-Identifier: BSD-3-Clause */
/* The matrix of a step, from that of the residual (dae_matrix.c) with y = (q, v, lambda) and c =
 * by_a / by_v. The columns of v, which hold c M - g_v, are multiplied by by_v and added to those of
 * q. The rows of q' - v are not needed. The destination of every number is found once.
 */
#include "dynamics/step_matrix.h"

#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/compress.h"

/* Factors of the numbers of the full matrix. */
enum { BY_NOTHING, BY_SCALE, BY_SCALE_V, BY_ONE, FACTORS };

/* Destination of a number of the full matrix. */
typedef struct route {
  int32_t to;     /* in values[]; unused where the factor is 0 */
  int32_t factor; /* one of the above */
} route;

struct baum_i_step_matrix {
  baum_i_residual_matrix *form;
  double *full; /* values of the form */
  route *routes;
  int32_t n; /* nv + nc */
  int32_t nonzeros;
  double *values; /* (nonzeros) */
  baum_i_sparse_lu *lu;
};

static int32_t factor_of(int nv, int row, int column)
{
  if (row < nv) {
    return BY_NOTHING;
  }
  if (row >= 2 * nv || column >= 2 * nv) {
    return BY_ONE;
  }
  return column < nv ? BY_SCALE : BY_SCALE_V;
}

/* Set the factors of all routes, and list their destinations. */
static void list_places(const baum_i_step_matrix *matrix, int nv, baum_i_places *places)
{
  const int32_t *columns = baum_i_residual_matrix_columns(matrix->form);
  const int32_t *rows = baum_i_residual_matrix_rows(matrix->form);
  for (int32_t j = 0; j < nv + matrix->n; j++) {
    for (int32_t k = columns[j]; k < columns[j + 1]; k++) {
      matrix->routes[k].factor = factor_of(nv, rows[k], j);
      if (matrix->routes[k].factor != BY_NOTHING) {
        baum_i_places_add(places, rows[k] - nv, j < nv ? j : j - nv);
      }
    }
  }
}

static void set_routes(const baum_i_step_matrix *matrix, const int32_t *slot)
{
  int32_t full = baum_i_residual_matrix_nonzeros(matrix->form);
  for (int32_t k = 0; k < full; k++) {
    if (matrix->routes[k].factor != BY_NOTHING) {
      matrix->routes[k].to = *slot++;
    }
  }
}

static baum_status compress(baum_i_step_matrix *matrix, const baum_i_places *places)
{
  int32_t *columns = baum_i_alloc((size_t)matrix->n + 1, sizeof *columns);
  int32_t *rows = baum_i_alloc(places->count, sizeof *rows);
  int32_t *slot = baum_i_alloc(places->count, sizeof *slot);
  baum_status status = BAUM_ERR_MEMORY;
  if (columns && rows && slot) {
    status = baum_i_compress(places, matrix->n, columns, rows, slot);
  }
  if (status == BAUM_OK) {
    set_routes(matrix, slot);
    matrix->nonzeros = columns[matrix->n];
    matrix->values = baum_i_alloc((size_t)matrix->nonzeros, sizeof *matrix->values);
    status = matrix->values ? BAUM_OK : BAUM_ERR_MEMORY;
  }
  if (status == BAUM_OK) {
    status = baum_i_sparse_lu_create(matrix->n, columns, rows, &matrix->lu);
  }
  baum_i_free(columns);
  baum_i_free(rows);
  baum_i_free(slot);
  return status;
}

static baum_status fill(const baum_workspace *w, baum_i_step_matrix *matrix)
{
  BAUM_I_TRY(baum_i_residual_matrix_create(w, BAUM_RESIDUAL_INDEX3, &matrix->form));
  size_t full = (size_t)baum_i_residual_matrix_nonzeros(matrix->form);
  matrix->n = w->mechanism->nv + w->mechanism->nc;
  matrix->full = baum_i_alloc(full, sizeof *matrix->full);
  matrix->routes = baum_i_alloc(full, sizeof *matrix->routes);
  baum_i_places places;
  baum_status status = baum_i_places_create(full, &places);
  if (status == BAUM_OK && matrix->full && matrix->routes) {
    list_places(matrix, w->mechanism->nv, &places);
    status = compress(matrix, &places);
  } else {
    status = BAUM_ERR_MEMORY;
  }
  baum_i_places_clear(&places);
  return status == BAUM_OK ? BAUM_OK : baum_i_fail_memory();
}

baum_status baum_i_step_matrix_create(const baum_workspace *workspace, baum_i_step_matrix **out)
{
  *out = NULL;
  baum_i_step_matrix *matrix = baum_i_alloc(1, sizeof *matrix);
  baum_status status = matrix ? fill(workspace, matrix) : baum_i_fail_memory();
  if (status != BAUM_OK) {
    baum_i_step_matrix_destroy(matrix);
    return status;
  }
  *out = matrix;
  return BAUM_OK;
}

void baum_i_step_matrix_destroy(baum_i_step_matrix *matrix)
{
  if (matrix) {
    baum_i_residual_matrix_destroy(matrix->form);
    baum_i_sparse_lu_destroy(matrix->lu);
    baum_i_free(matrix->full);
    baum_i_free(matrix->routes);
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
  const double factors[FACTORS] = {
    [BY_SCALE] = ratios->scale, [BY_SCALE_V] = ratios->scale * ratios->by_v, [BY_ONE] = 1.0};
  int32_t full = baum_i_residual_matrix_nonzeros(matrix->form);
  memset(matrix->values, 0, (size_t)matrix->nonzeros * sizeof *matrix->values);
  for (int32_t k = 0; k < full; k++) {
    const route *r = &matrix->routes[k];
    if (r->factor != BY_NOTHING) {
      matrix->values[r->to] += factors[r->factor] * matrix->full[k];
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
