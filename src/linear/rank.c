/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the rank of J by sparse QR of J^T with columns scaled to unit length. The QR omits a column
 * that depends on earlier columns. Columns are therefore ordered by preference. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/kkt.h"
#include "linear/peel.h"
#include "linear/sparse_qr.h"

/* J^T in compressed columns. */
typedef struct transposed {
  unsigned char *peeled; /* (nc) 1: row of J that peel.c removed; it has no entries here */
  int32_t *order;        /* (nc) rows of J, preferred ones first */
  int32_t *start;        /* (nc + 1) */
  int32_t *velocity;     /* (start[nc]) */
  double *value;         /* (start[nc]) */
} transposed;

static void count_entries(const baum_i_kkt_structure *structure, const transposed *columns)
{
  int32_t *start = columns->start;
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    for (int i = 0; i < block->rows; i++) {
      start[block->row + i + 1] = columns->peeled[block->row + i] ? 0 : block->cols;
    }
  }
  for (int i = 0; i < structure->nc; i++) {
    start[i + 1] += start[i];
  }
}

/* Scales x to unit length. x is first divided by its largest number, so that squares neither
 * overflow nor vanish.
 */
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

/* Lists the scaled entries of all rows that are not peeled. Returns false if one is not finite;
 * rows with such entries are never peeled. */
static bool list_entries(const baum_i_kkt_structure *structure, const double *jacobian,
                         const double *column_scale, const transposed *columns)
{
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    const double *number = jacobian + block->value;
    for (int i = 0; i < block->rows && !columns->peeled[block->row + i]; i++) {
      int32_t *velocity = columns->velocity + columns->start[block->row + i];
      double *value = columns->value + columns->start[block->row + i];
      for (int k = 0; k < block->cols; k++) {
        velocity[k] = block->col[k];
        value[k] = *number++ * column_scale[block->col[k]];
        if (!isfinite(value[k])) {
          return false;
        }
      }
      make_unit(value, block->cols);
    }
  }
  return true;
}

/* Lists the structure's last_rows after all other rows. Within each of the two groups, marked rows
 * come first. */
static void order_rows(const baum_i_kkt_structure *structure, const unsigned char *marked,
                       int32_t *order)
{
  for (int pass = 0; pass < 4; pass++) {
    for (int32_t i = 0; i < structure->nc; i++) {
      bool last = structure->last_rows && structure->last_rows[i];
      if ((last ? 2 : 0) + (marked[i] == 0 ? 1 : 0) == pass) {
        *order++ = i;
      }
    }
  }
}

static baum_status find_rank(const baum_i_kkt_structure *structure, const transposed *columns,
                             double tolerance, int *rank, unsigned char *independent)
{
  const baum_i_sparse_columns pattern = {structure->nv, structure->nc, columns->start,
                                         columns->velocity};
  baum_i_sparse_qr *qr = NULL;
  order_rows(structure, independent, columns->order);
  BAUM_I_TRY(baum_i_sparse_qr_create(&pattern, columns->order, &qr));
  *rank = baum_i_sparse_qr_factor(qr, columns->value, tolerance, independent);
  baum_i_sparse_qr_destroy(qr);
  for (int i = 0; i < structure->nc; i++) {
    independent[i] |= columns->peeled[i];
    *rank += columns->peeled[i];
  }
  return BAUM_OK;
}

/* Allocates memory for the entries that remain after peeling. */
static baum_status make_room(const baum_i_kkt_structure *structure, const double *jacobian,
                             const double *column_scale, transposed *columns)
{
  size_t nc = (size_t)structure->nc;
  columns->peeled = baum_i_alloc(nc, 1);
  columns->order = baum_i_alloc(nc, sizeof *columns->order);
  columns->start = baum_i_alloc(nc + 1, sizeof *columns->start);
  if (!columns->peeled || !columns->order || !columns->start) {
    return BAUM_ERR_MEMORY;
  }
  BAUM_I_TRY(baum_i_peel(structure, jacobian, column_scale, columns->peeled));
  count_entries(structure, columns);
  size_t entries = (size_t)columns->start[nc];
  columns->velocity = baum_i_alloc(entries, sizeof *columns->velocity);
  columns->value = baum_i_alloc(entries, sizeof *columns->value);
  return columns->velocity && columns->value ? BAUM_OK : BAUM_ERR_MEMORY;
}

baum_status baum_i_jacobian_rank(const baum_i_kkt_structure *structure, const double *jacobian,
                                 const double *column_scale, double tolerance, int *rank,
                                 unsigned char *independent)
{
  transposed columns = {0};
  baum_status status = make_room(structure, jacobian, column_scale, &columns);
  if (status == BAUM_OK) {
    status = list_entries(structure, jacobian, column_scale, &columns)
               ? find_rank(structure, &columns, tolerance, rank, independent)
               : BAUM_ERR_NOT_FINITE;
  }
  baum_i_free(columns.peeled);
  baum_i_free(columns.order);
  baum_i_free(columns.start);
  baum_i_free(columns.velocity);
  baum_i_free(columns.value);
  return status == BAUM_ERR_MEMORY ? baum_i_fail_memory() : status;
}
