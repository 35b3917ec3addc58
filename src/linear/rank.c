/* SPDX-License-Identifier: BSD-3-Clause */
/* The rank of J: that of the columns of J^T, scaled to unit length, by sparse QR. Of dependent
 * columns the later ones are given up, so the order is that of preference. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/kkt.h"
#include "linear/peel.h"
#include "linear/sparse_qr.h"

/* J, scaled by columns, and those of its rows that are left to be looked at, as columns. */
typedef struct scaled_rows {
  const baum_i_kkt_structure *structure;
  const double *jacobian;
  const double *column_scale;
  int32_t *place; /* (nc) among those left, or -1 */
  int32_t left;
  int32_t *start; /* (left + 1) of the entries of each */
  int32_t *velocity;
  double *value;
} scaled_rows;

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
static void make_unit(double *x, int count)
{
  double largest = 0.0;
  double sum = 0.0;
  for (int k = 0; k < count; k++) {
    largest = fmax(largest, fabs(x[k]));
  }
  for (int k = 0; k < count && largest > 0.0; k++) {
    x[k] /= largest;
    sum += x[k] * x[k];
  }
  for (int k = 0; k < count && largest > 0.0; k++) {
    x[k] /= sqrt(sum);
  }
}

/* Marked ones first. */
static void order_rows(const scaled_rows *rows, const unsigned char *marked)
{
  int32_t next = 0;
  for (int pass = 0; pass < 2; pass++) {
    for (int i = 0; i < rows->structure->nc; i++) {
      if (rows->place[i] >= 0 && (marked[i] == 0) == (pass == 1)) {
        rows->place[i] = next++;
      }
    }
  }
}

static void count_entries(const scaled_rows *rows)
{
  for (int b = 0; b < rows->structure->row_block_count; b++) {
    const baum_i_row_block *block = &rows->structure->row_blocks[b];
    for (int i = 0; i < block->rows && rows->place[block->row + i] >= 0; i++) {
      rows->start[rows->place[block->row + i] + 1] = block->cols;
    }
  }
  for (int32_t j = 0; j < rows->left; j++) {
    rows->start[j + 1] += rows->start[j];
  }
}

static void list_entries(const scaled_rows *rows)
{
  for (int b = 0; b < rows->structure->row_block_count; b++) {
    const baum_i_row_block *block = &rows->structure->row_blocks[b];
    const double *value = rows->jacobian + block->value;
    for (int i = 0; i < block->rows && rows->place[block->row + i] >= 0; i++) {
      int32_t first = rows->start[rows->place[block->row + i]];
      for (int k = 0; k < block->cols; k++) {
        rows->velocity[first + k] = block->col[k];
        rows->value[first + k] = *value++ * rows->column_scale[block->col[k]];
      }
      make_unit(rows->value + first, block->cols);
    }
  }
}

/* found (left) receives 1 for independent ones. */
static baum_status factor_rows(const scaled_rows *rows, double tolerance, int *rank,
                               unsigned char *found)
{
  const baum_i_sparse_columns columns = {rows->structure->nv, rows->left, rows->start,
                                         rows->velocity};
  baum_i_sparse_qr *qr = NULL;
  BAUM_I_TRY(baum_i_sparse_qr_create(&columns, NULL, &qr));
  *rank = baum_i_sparse_qr_factor(qr, rows->value, tolerance, found);
  baum_i_sparse_qr_destroy(qr);
  return BAUM_OK;
}

static baum_status rank_by_qr(scaled_rows *rows, double tolerance, int *rank, unsigned char *found)
{
  baum_status status = BAUM_ERR_MEMORY;
  rows->start = baum_i_alloc((size_t)rows->left + 1, sizeof *rows->start);
  if (rows->start) {
    count_entries(rows);
    size_t entries = (size_t)rows->start[rows->left];
    rows->velocity = baum_i_alloc(entries, sizeof *rows->velocity);
    rows->value = baum_i_alloc(entries, sizeof *rows->value);
  }
  if (rows->velocity && rows->value) {
    list_entries(rows);
    status = factor_rows(rows, tolerance, rank, found);
  }
  baum_i_free(rows->start);
  baum_i_free(rows->velocity);
  baum_i_free(rows->value);
  return status;
}

/* found (nc) is scratch. */
static baum_status find_rank(scaled_rows *rows, double tolerance, unsigned char *found, int *rank,
                             unsigned char *independent)
{
  int nc = rows->structure->nc;
  int rank_left = 0;
  BAUM_I_TRY(
    baum_i_peel(rows->structure, rows->jacobian, rows->column_scale, rows->place, &rows->left));
  if (rows->left > 0) {
    order_rows(rows, independent);
    BAUM_I_TRY(rank_by_qr(rows, tolerance, &rank_left, found));
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
  scaled_rows rows = {.structure = structure, .jacobian = jacobian, .column_scale = column_scale};
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
