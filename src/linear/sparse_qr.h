/* SPDX-License-Identifier: BSD-3-Clause */
/* Rank-revealing QR factors of a general sparse matrix with a fixed pattern. */
#ifndef BAUM_I_LINEAR_SPARSE_QR_H
#define BAUM_I_LINEAR_SPARSE_QR_H

#include <stdint.h>

#include <baum/status.h>

/* The pattern of a matrix in compressed columns: each entry once, rows in any order. */
typedef struct baum_i_sparse_columns {
  int32_t rows;
  int32_t columns;
  const int32_t *start; /* (columns + 1) */
  const int32_t *row;   /* (start[columns]) */
} baum_i_sparse_columns;

typedef struct baum_i_sparse_qr baum_i_sparse_qr;

/* Finds the structure of the factors. order (columns) lists the columns in their order of
 * elimination; NULL: ascending. Both arguments may be freed afterwards. Returns BAUM_OK, or
 * BAUM_ERR_MEMORY without a message and with *out = NULL. */
baum_status baum_i_sparse_qr_create(const baum_i_sparse_columns *pattern, const int32_t *order,
                                    baum_i_sparse_qr **out);
void baum_i_sparse_qr_destroy(baum_i_sparse_qr *qr); /* NULL is allowed */

/* Factors the matrix with the given values, which must be finite and in the order of pattern->row.
 * Returns the rank. A column is dependent if its norm is at most `tolerance` after
 * orthogonalization against the independent columns before it. If `independent` (columns) is not
 * NULL, it receives 1 for independent columns and 0 for the others. This function and the two
 * functions below allocate nothing. */
int32_t baum_i_sparse_qr_factor(baum_i_sparse_qr *qr, const double *values, double tolerance,
                                unsigned char *independent);

/* On entry, x contains the right-hand side b. On return, it contains the vector y that minimizes |A
 * y - b| and is zero in dependent columns. The length of x is the larger of the numbers of rows and
 * columns. */
void baum_i_sparse_qr_solve(baum_i_sparse_qr *qr, double *x);

/* Projects x (rows) orthogonally onto the span of the independent columns. */
void baum_i_sparse_qr_project(baum_i_sparse_qr *qr, double *x);

#endif
