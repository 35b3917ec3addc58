/* SPDX-License-Identifier: BSD-3-Clause */
/* LU factors of a general sparse square matrix with a fixed pattern. Rows are divided by their
 * largest entry. */
#ifndef BAUM_I_LINEAR_SPARSE_LU_H
#define BAUM_I_LINEAR_SPARSE_LU_H

#include <stdint.h>

#include <baum/status.h>

typedef struct baum_i_sparse_lu baum_i_sparse_lu;

/* Work done so far. */
typedef struct baum_i_sparse_lu_work {
  int64_t factorizations;
  int64_t full_factorizations; /* those that chose new pivots and may allocate */
} baum_i_sparse_lu_work;

/* Creates factors of an n x n matrix in compressed columns with ascending rows. The pattern is
 * copied. Returns BAUM_OK, or BAUM_ERR_MEMORY with *out = NULL. */
baum_status baum_i_sparse_lu_create(int32_t n, const int32_t *columns, const int32_t *rows,
                                    baum_i_sparse_lu **out);
void baum_i_sparse_lu_destroy(baum_i_sparse_lu *lu); /* NULL is allowed */

/* Factors the matrix. Keeps the last pivots as long as they are good, and then allocates nothing.
 * Returns BAUM_OK, BAUM_ERR_SINGULAR or BAUM_ERR_MEMORY. None of these functions sets a message. */
baum_status baum_i_sparse_lu_factor(baum_i_sparse_lu *lu, double *values);

/* A diagonal entry is chosen as the pivot if it is at least this fraction of the largest entry of
 * its column. */
#define BAUM_I_USUAL_THRESHOLD 0.001

/* The two parts of factoring, for a caller that decides when pivots are chosen. _keep() requires
 * pivots chosen earlier. _keep() returns BAUM_OK or BAUM_ERR_SINGULAR. Even if it returns BAUM_OK,
 * the pivots may have become useless. _choose() returns BAUM_OK, BAUM_ERR_SINGULAR or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_sparse_lu_keep(baum_i_sparse_lu *lu, double *values);
baum_status baum_i_sparse_lu_choose(baum_i_sparse_lu *lu, double *values, double threshold);

/* Returns the ratio of the smallest to the largest pivot, or 0 after a failure. */
double baum_i_sparse_lu_rcond(const baum_i_sparse_lu *lu);

/* Declares that all values are already scaled. Rows are then not divided by their largest entry. */
void baum_i_sparse_lu_take_scaled(baum_i_sparse_lu *lu);

/* Makes the next factorization choose new pivots, so that results do not depend on earlier
 * factorizations. */
void baum_i_sparse_lu_forget(baum_i_sparse_lu *lu);

/* Replaces the right-hand side x (n) by the solution. Requires a factorization. */
void baum_i_sparse_lu_solve(baum_i_sparse_lu *lu, double *x);

baum_i_sparse_lu_work baum_i_sparse_lu_get_work(const baum_i_sparse_lu *lu);

#endif
