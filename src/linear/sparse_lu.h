/* SPDX-License-Identifier: BSD-3-Clause */
/* LU factors of a general sparse square matrix with a pattern that stays. */
#ifndef BAUM_I_LINEAR_SPARSE_LU_H
#define BAUM_I_LINEAR_SPARSE_LU_H

#include <stdint.h>

#include <baum/status.h>

typedef struct baum_i_sparse_lu baum_i_sparse_lu;

/* What has been done. */
typedef struct baum_i_sparse_lu_work {
  int64_t factorizations;
  int64_t full_factorizations; /* those of them that chose pivots again, which may allocate */
} baum_i_sparse_lu_work;

/* For an n x n matrix in compressed columns with ascending rows; the pattern must outlive the
 * factors. BAUM_OK or BAUM_ERR_MEMORY; then *out is NULL. */
baum_status baum_i_sparse_lu_create(int32_t n, const int32_t *columns, const int32_t *rows,
                                    baum_i_sparse_lu **out);
void baum_i_sparse_lu_destroy(baum_i_sparse_lu *lu); /* NULL is fine */

/* Factor: with the pivots of last time, and without allocation, as long as these are good. BAUM_OK,
 * BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY. Neither sets a message. */
baum_status baum_i_sparse_lu_factor(baum_i_sparse_lu *lu, double *values);

/* How small a diagonal entry may be against the largest of its column to be the pivot. */
#define BAUM_I_USUAL_THRESHOLD 0.001

/* The two parts of it, for a caller that decides by itself. Keep pivots, which there must be:
 * BAUM_OK also when they have become worthless, or BAUM_ERR_SINGULAR. Choose them: BAUM_OK,
 * BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY. */
baum_status baum_i_sparse_lu_keep(baum_i_sparse_lu *lu, double *values);
baum_status baum_i_sparse_lu_choose(baum_i_sparse_lu *lu, double *values, double threshold);

/* The ratio of the smallest to the largest pivot; 0 after a failure. */
double baum_i_sparse_lu_rcond(const baum_i_sparse_lu *lu);

/* Values come scaled: rows are no longer scaled by their largest entry. */
void baum_i_sparse_lu_take_scaled(baum_i_sparse_lu *lu);

/* Choose pivots again at the next factorization, so that nothing depends on the ones before. */
void baum_i_sparse_lu_forget(baum_i_sparse_lu *lu);

/* The right side x (n) becomes the solution. After a factorization. */
void baum_i_sparse_lu_solve(baum_i_sparse_lu *lu, double *x);

baum_i_sparse_lu_work baum_i_sparse_lu_get_work(const baum_i_sparse_lu *lu);

#endif
