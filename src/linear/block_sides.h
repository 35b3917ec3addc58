/* SPDX-License-Identifier: BSD-3-Clause */
/* Functions for sides, used by block_sides_hot.c and block_hot.c. The two numbers of a column, one
 * for each row, are processed as a pair. */
#ifndef BAUM_I_LINEAR_BLOCK_SIDES_H
#define BAUM_I_LINEAR_BLOCK_SIDES_H

#include "base/pair.h"
#include "linear/block.h"

/* The three columns of a side. */
typedef struct baum_i_columns {
  baum_i_pair c[3];
} baum_i_columns;

static inline baum_i_columns baum_i_load_full(const double *side)
{
  return (baum_i_columns){{baum_i_load(side), baum_i_load(side + 2), baum_i_load(side + 4)}};
}

/* Loads a side by its number, which may denote an arm (see baum_i_full_pair). The columns of I are
 * read from memory, because the instructions that construct them (vmovq between registers, encoded
 * as 66 0F D6) may be unknown to valgrind 3.19. */
static inline baum_i_columns baum_i_load_side(const baum_i_block *b, int32_t number)
{
  static const double AXES[2][4] = {{1.0, 0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0, -1.0}};
  if (number >= 0) {
    return baum_i_load_full(b->side + 6 * (size_t)number);
  }
  int32_t arm = ~number;
  const double *axes = AXES[arm % 2];
  return (baum_i_columns){
    {baum_i_load(axes), baum_i_load(axes + 2), baum_i_load(b->arm + 2 * (size_t)arm)}};
}

/* Returns w_0 (n_0 k_0^T + n_1 k_1^T) + w_1 n_2 k_2^T, where n_i and k_i are columns of two
 * sides. */
static inline baum_i_square baum_i_couple_sides(const baum_i_columns *n, const double *w,
                                                const baum_i_columns *k)
{
  baum_i_square s = {{{0.0, 0.0}, {0.0, 0.0}}};
  for (int c = 0; c < 3; c++) {
    baum_i_square product = baum_i_outer_product(n->c[c], w[c < 2 ? 0 : 1] * k->c[c]);
    s.column[0] += product.column[0];
    s.column[1] += product.column[1];
  }
  return s;
}

#endif
