/* SPDX-License-Identifier: BSD-3-Clause */
/* Rank-revealing QR factors of a general sparse matrix with a pattern that stays. */
#ifndef BAUM_I_LINEAR_SPARSE_QR_H
#define BAUM_I_LINEAR_SPARSE_QR_H

#include <stdint.h>

#include <baum/status.h>

/* Compressed columns; no place twice, rows in any order. */
typedef struct baum_i_sparse_columns {
  int32_t rows;
  int32_t columns;
  const int32_t *start; /* (columns + 1) */
  const int32_t *row;   /* (start[columns]) */
} baum_i_sparse_columns;

typedef struct baum_i_sparse_qr baum_i_sparse_qr;

/* order (columns) lists the columns as they are eliminated, NULL: as they stand. Neither of the two
 * is needed afterwards. BAUM_OK or BAUM_ERR_MEMORY, without a message; then *out is NULL. */
baum_status baum_i_sparse_qr_create(const baum_i_sparse_columns *pattern, const int32_t *order,
                                    baum_i_sparse_qr **out);
void baum_i_sparse_qr_destroy(baum_i_sparse_qr *qr); /* NULL is fine */

/* Factor finite values, listed as the rows of the pattern, and return the rank. A column is
 * dependent when what the independent ones before it leave of it is at most `tolerance` long;
 * independent (columns), which may be NULL, receives 1 or 0. Allocates nothing, nor do the two
 * functions below. */
int32_t baum_i_sparse_qr_factor(baum_i_sparse_qr *qr, const double *values, double tolerance,
                                unsigned char *independent);

/* x, with room for the larger of rows and columns: the right side b, then an x that minimizes
 * |A x - b| and is zero where columns are dependent. */
void baum_i_sparse_qr_solve(baum_i_sparse_qr *qr, double *x);

/* Project x (rows) orthogonally onto the span of the independent columns. */
void baum_i_sparse_qr_project(baum_i_sparse_qr *qr, double *x);

#endif
