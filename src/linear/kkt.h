/* SPDX-License-Identifier: BSD-3-Clause */
/* The saddle-point system of constrained dynamics
 *
 *   [ M   J^T ] [ a      ]   [ f ]
 *   [ J   -S  ] [ lambda ] = [ r ],      M (nv x nv), J (nc x nv), S diagonal, mostly zero
 *
 * M is block diagonal, and J is a list of dense blocks. Both are stored as row-major blocks, whose
 * structure is fixed. An omitted row i is replaced by lambda_i = 0. */
#ifndef BAUM_I_LINEAR_KKT_H
#define BAUM_I_LINEAR_KKT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* A dense block of M on the diagonal. */
typedef struct baum_i_mass_block {
  int first; /* first row and column */
  int size;
  int value; /* start of its size x size values */
} baum_i_mass_block;

/* A dense block of J. */
typedef struct baum_i_row_block {
  int row; /* first row */
  int rows;
  int cols;
  const int *col; /* (cols) columns, each once, in any order; the mechanism owns them */
  int value;      /* start of its rows x cols values */
} baum_i_row_block;

typedef struct baum_i_kkt_structure {
  int nv;
  int nc;
  int mass_block_count;
  const baum_i_mass_block *mass_blocks;
  int row_block_count;
  const baum_i_row_block *row_blocks;
  /* (nc) 1: if rows are dependent, omit this row rather than a row marked 0; NULL: no preference */
  const unsigned char *last_rows;
} baum_i_kkt_structure;

typedef struct baum_i_kkt_values {
  const double *mass;           /* values of the mass blocks */
  const double *jacobian;       /* values of the row blocks */
  const double *shift;          /* (nc) diagonal of S, or NULL for zeros */
  const unsigned char *omitted; /* (nc) non-zero where a row is omitted, or NULL for none */
} baum_i_kkt_values;

/* How far the present factorization can be trusted. */
typedef enum baum_i_kkt_quality {
  BAUM_I_KKT_GOOD,
  /* the matrix is close to singular, or the solution is a least-squares solution */
  BAUM_I_KKT_NEAR_SINGULAR,
  BAUM_I_KKT_SINGULAR /* no factorization */
} baum_i_kkt_quality;

typedef struct baum_i_kkt_counters {
  int64_t factorizations;      /* all, whether pivots are kept or new */
  int64_t full_factorizations; /* those that chose new pivots and may allocate */
  int64_t refinements;
  int64_t fallbacks; /* number of times that QR replaced an inaccurate LU */
} baum_i_kkt_counters;

/* Forced choice of backend. */
typedef enum baum_i_kkt_choice { BAUM_I_KKT_AUTO, BAUM_I_KKT_KLU, BAUM_I_KKT_QR } baum_i_kkt_choice;

typedef struct baum_i_kkt baum_i_kkt;

/* `structure` and its arrays must outlive the solver. baum_i_kkt_prepare() or the first
 * factorization analyses the structure. This analysis costs more than a factorization. */
baum_status baum_i_kkt_create(const baum_i_kkt_structure *structure, baum_i_kkt_choice choice,
                              baum_i_kkt **out);
/* Analyses the structure, unless this has already been done. After this call, memory is allocated
 * only when new pivots are chosen. Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_kkt_prepare(baum_i_kkt *kkt);
void baum_i_kkt_destroy(baum_i_kkt *kkt); /* NULL is allowed */

/* Factors the matrix of new values. The values must not change until the last solve, because
 * residuals are computed from them. Keeps the present pivots as long as they are good enough, and
 * then allocates nothing. Returns BAUM_OK (baum_i_kkt_get_quality() then tells how good
 * the factorization is), BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY or BAUM_ERR_NOT_FINITE. Sets a message
 * only if out of memory, because only the caller knows the time and the names for other
 * messages. */
baum_status baum_i_kkt_factor(baum_i_kkt *kkt, const baum_i_kkt_values *values);

/* Solves, and refines a and lambda until the residuals of both equations are at rounding level. (a,
 * lambda) may not alias f or r. To reach this level, the function may choose new pivots or use QR.
 * Returns BAUM_OK, BAUM_ERR_SINGULAR (no factorization, a residual that stays large, or
 * contradictory rows), BAUM_ERR_MEMORY or BAUM_ERR_NOT_FINITE.
 */
baum_status baum_i_kkt_solve(baum_i_kkt *kkt, const double *f, const double *r, double *a,
                             double *lambda);

/* Factors and solves. Use this function if there is only one right-hand side for these values. */
baum_status baum_i_kkt_factor_and_solve(baum_i_kkt *kkt, const baum_i_kkt_values *values,
                                        const double *f, const double *r, double *a,
                                        double *lambda);

/* Makes the next factorization choose new pivots, so that results do not depend on earlier
 * factorizations. */
void baum_i_kkt_forget(baum_i_kkt *kkt);

baum_i_kkt_quality baum_i_kkt_get_quality(const baum_i_kkt *kkt);
/* Returns a cheap estimate of the reciprocal condition number of the present scaled matrix. The
 * estimate is dimensionless. It is continuous while pivots are kept and jumps when new pivots are
 * chosen. It is 0 without a factorization, or if the rank is not full. */
double baum_i_kkt_rcond(const baum_i_kkt *kkt);
const char *baum_i_kkt_backend(const baum_i_kkt *kkt); /* "klu" or "qr": the backend used last */
baum_i_kkt_counters baum_i_kkt_get_counters(const baum_i_kkt *kkt);

/* ---- plain products with the blocks, also used by dynamics ---- */

/* y += M x */
void baum_i_mass_times(const baum_i_kkt_structure *structure, const double *mass, const double *x,
                       double *y);
/* y += J x */
void baum_i_jacobian_times(const baum_i_kkt_structure *structure, const double *jacobian,
                           const double *x, double *y);
/* y += J^T x */
void baum_i_jacobian_transposed_times(const baum_i_kkt_structure *structure, const double *jacobian,
                                      const double *x, double *y);

/* ---- rank ---- */

/* Finds the rank of J by rank-revealing sparse QR of its transpose. Column j is first multiplied by
 * column_scale[j]; then every non-zero row is scaled to unit length. A row counts as dependent if
 * its length is at most `tolerance` after orthogonalization against the independent rows before it.
 * independent (nc) receives 1 for the rows of a largest set of independent rows, and 0 for all
 * other rows. Rows with independent[i] != 0 on entry are preferred, then rows with a lower number,
 * but any other row is preferred to the structure's last_rows. Allocates memory. Returns BAUM_OK,
 * BAUM_ERR_MEMORY or BAUM_ERR_NOT_FINITE. */
baum_status baum_i_jacobian_rank(const baum_i_kkt_structure *structure, const double *jacobian,
                                 const double *column_scale, double tolerance, int *rank,
                                 unsigned char *independent);

#endif
