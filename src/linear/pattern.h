/* SPDX-License-Identifier: BSD-3-Clause */
/* The saddle-point matrix K in compressed columns. The pattern is found once; filling allocates
 * nothing.
 *
 * The pattern contains all entries that can be non-zero, and the whole diagonal. Rows ascend within
 * a column. The pattern is symmetric. */
#ifndef BAUM_I_LINEAR_PATTERN_H
#define BAUM_I_LINEAR_PATTERN_H

#include "linear/compress.h"
#include "linear/kkt.h"

typedef struct baum_i_pattern {
  const baum_i_kkt_structure *structure;
  int32_t n;                 /* nv + nc */
  baum_i_compressed columns; /* (n) */

  /* Indices in `matrix` of the values of all blocks, in the order of the blocks. */
  const int32_t *mass;       /* M */
  const int32_t *jacobian;   /* J */
  const int32_t *transposed; /* J^T, in the order of J */
  const int32_t *diagonal;   /* (n) */

  double *scale;  /* (n) D of the last baum_i_pattern_fill() */
  double *matrix; /* (columns.start[n]) D K D */
} baum_i_pattern;

/* Returns BAUM_OK, or BAUM_ERR_MEMORY with an empty pattern. */
baum_status baum_i_pattern_create(const baum_i_kkt_structure *structure, baum_i_pattern *pattern);
void baum_i_pattern_clear(baum_i_pattern *pattern); /* a zeroed pattern is allowed */

/* Fills the matrix D K D for D = diag(scale), weighted by `root` as in baum_i_scale_weigh(). A row
 * with scale 0 is omitted. */
void baum_i_pattern_fill(baum_i_pattern *pattern, const baum_i_kkt_values *values,
                         const double *scale, double root);

/* x <- D x */
void baum_i_pattern_scale(const baum_i_pattern *pattern, double *x);

#endif
