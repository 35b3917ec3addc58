/* SPDX-License-Identifier: BSD-3-Clause */
/* The residual b - K x of the saddle-point system, and tests whether it is at rounding level. The
 * tests do not depend on units. */
#ifndef BAUM_I_LINEAR_RESIDUAL_H
#define BAUM_I_LINEAR_RESIDUAL_H

#include "linear/kkt.h"

/* Computes residual = b - K x and size = |b| + |K| |x|. All vectors have the length nv + nc. In
 * omitted rows the results are 0. */
void baum_i_residual_form(const baum_i_kkt_structure *structure, const baum_i_kkt_values *values,
                          const double *b, const double *x, double *residual, double *size);

/* Islands are parts of the system that no block of M or J couples with each other. Rows are
 * compared only with rows of the same island, because the numbers of other islands may be larger by
 * many orders of magnitude. */
typedef struct baum_i_residual_islands {
  int count;
  int *of;         /* (n) island of each row */
  double *largest; /* (count) used by the functions below */
} baum_i_residual_islands;

/* Returns BAUM_OK or BAUM_ERR_MEMORY, without a message. */
baum_status baum_i_residual_islands_find(const baum_i_kkt_structure *structure,
                                         baum_i_residual_islands *out);
void baum_i_residual_islands_clear(const baum_i_residual_islands *islands);

/* Tells whether each |residual_i| is at rounding level relative to size_i. Tiny rows are compared
 * with the largest row of their island (see residual.c). Returns false if a residual is NaN. */
bool baum_i_residual_is_rounding(int n, const baum_i_residual_islands *islands, const double *scale,
                                 const double *residual, const double *size);

/* The same test, but "tiny" includes all rows whose scaled size is at rounding level relative to
 * the largest row of their island. rcond: reciprocal condition number of the scaled matrix. */
bool baum_i_residual_is_noise(int n, const baum_i_residual_islands *islands, const double *scale,
                              const double *residual, const double *size, double rcond);

/* Sets islands->largest[] to the largest scaled |size_i| of each island. */
void baum_i_residual_largest(int n, const baum_i_residual_islands *islands, const double *scale,
                             const double *size);

/* Tells whether each scaled |residual_i| is at most `tolerance` times the largest scaled |b_i| of
 * its island. */
bool baum_i_residual_is_below(int n, const baum_i_residual_islands *islands, const double *scale,
                              const double *residual, const double *b, double tolerance);

#endif
