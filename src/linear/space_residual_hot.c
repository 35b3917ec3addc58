/* SPDX-License-Identifier: BSD-3-Clause */
/* Residual of the whole system in space, in twice the working precision. block_residual.c computes
 * the same residual for the plane. The wide version uses fused multiply-add instructions. */
#include <math.h>
#include <string.h>

#include "linear/space_columns.h"

enum { MOTION = BAUM_I_SPACE_MOTION };

typedef baum_i_four four;

/* Four sums, each with its rounding error as in twofold.h. */
typedef struct sums {
  four high;
  four low;
} sums;

/* Returns x y - product without a rounding error. */
BAUM_I_INLINE four product_error(four x, four y, four product)
{
#ifdef BAUM_I_WIDE
  return _mm256_fmsub_pd(x, y, product);
#else
  return baum_i_four_set(
    fma(x.low[0], y.low[0], -product.low[0]), fma(x.low[1], y.low[1], -product.low[1]),
    fma(x.high[0], y.high[0], -product.high[0]), fma(x.high[1], y.high[1], -product.high[1]));
#endif
}

BAUM_I_INLINE void subtract(sums *s, four x, four y)
{
  four product = baum_i_four_rounded(baum_i_four_times(x, y));
  four high = baum_i_four_minus(s->high, product);
  four moved = baum_i_four_minus(high, s->high);
  four own = baum_i_four_minus(s->high, baum_i_four_minus(high, moved));
  four error = baum_i_four_minus(own, baum_i_four_plus(product, moved));
  s->low = baum_i_four_plus(s->low, error);
  s->low = baum_i_four_minus(s->low, product_error(x, y, product));
  s->high = high;
}

/* Transposes three columns of four numbers to four rows of three numbers. The fourth number of a
 * row can have any value. */
BAUM_I_INLINE void transpose(const four x[3], four rows[4])
{
#ifdef BAUM_I_WIDE
  four even = _mm256_unpacklo_pd(x[0], x[1]);
  four odd = _mm256_unpackhi_pd(x[0], x[1]);
  four other = _mm256_permute_pd(x[2], 0xf);
  rows[0] = _mm256_permute2f128_pd(even, x[2], 0x20);
  rows[1] = _mm256_permute2f128_pd(odd, other, 0x20);
  rows[2] = _mm256_permute2f128_pd(even, x[2], 0x31);
  rows[3] = _mm256_permute2f128_pd(odd, other, 0x31);
#else
  for (int i = 0; i < 4; i++) {
    rows[i] = baum_i_four_set(baum_i_four_get(x[0], i), baum_i_four_get(x[1], i),
                              baum_i_four_get(x[2], i), 0.0);
  }
#endif
}

static void begin_motion(baum_i_space *b)
{
  for (int t = 0; t < b->body_count; t++) {
    for (int half = 0; half < 2; half++) {
      ptrdiff_t at = (ptrdiff_t)MOTION * t + (ptrdiff_t)4 * half;
      sums pull = {baum_i_four_load(b->load + at), baum_i_four_zero()};
      four mass = baum_i_four_all(half == 1 ? 1.0 : b->bodies[t].mass);
      subtract(&pull, mass, baum_i_four_load(b->motion + at));
      baum_i_four_store(b->pull + at, pull.high);
      baum_i_four_store(b->pull_low + at, pull.low);
    }
  }
}

/* Subtracts the products with three columns of a side from pull[], from `rest` (rows 0 to 3) and
 * from `high` (rows 4 and 5). `part` is E or R. */
BAUM_I_INLINE void subtract_part(baum_i_space *b, const double *part, int n, const double *lambda,
                                 ptrdiff_t at, sums *rest, sums *high)
{
  bool tall = n > 4;
  four low_columns[3];
  four high_columns[3];
  four rows[8];
  for (int c = 0; c < 3; c++) {
    baum_i_space_column g = baum_i_column_load(part, 3, c, tall);
    four x = baum_i_four_all(b->motion[at + c]);
    low_columns[c] = g.low;
    high_columns[c] = baum_i_four_of(g.high);
    subtract(rest, g.low, x);
    if (tall) {
      subtract(high, high_columns[c], x);
    }
  }
  transpose(low_columns, rows);
  if (tall) {
    transpose(high_columns, rows + 4);
  }
  sums pull = {baum_i_four_load(b->pull + at), baum_i_four_load(b->pull_low + at)};
  for (int i = 0; i < n; i++) {
    subtract(&pull, rows[i], baum_i_four_all(lambda[i]));
  }
  baum_i_four_store(b->pull + at, pull.high);
  baum_i_four_store(b->pull_low + at, pull.low);
}

/* Subtracts J^T lambda of one node from pull[], and sets rest[] of this node to r - J a. */
BAUM_I_INLINE void subtract_node(baum_i_space *b, const baum_i_space_node *node, bool tall)
{
  int n = tall ? BAUM_I_SPACE_ROWS : 4; /* unused rows are 0 */
  const double *lambda = b->nodes + node->at;
  const double *right = lambda + (tall ? 8 : 4);
  sums rest = {baum_i_four_load(right), baum_i_four_zero()};
  sums high = {tall ? baum_i_four_of(baum_i_load(right + 4)) : baum_i_four_zero(),
               baum_i_four_zero()};
  for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
    const baum_i_space_side *side = &b->side_list[s];
    ptrdiff_t at = (ptrdiff_t)MOTION * side->body;
    subtract_part(b, b->sides + side->move, n, lambda, at, &rest, &high);
    subtract_part(b, b->sides + side->turn, n, lambda, at + 4, &rest, &high);
  }
  if (node->spin != 0) {
    baum_i_space_column last = baum_i_column_last(node->rows, tall);
    four mu = baum_i_four_all(lambda[node->rows - 1]);
    for (int i = 0; i < 2; i++) {
      four factor = baum_i_four_all(b->bodies[node->spin].factor[i]);
      subtract(&rest, baum_i_four_times(last.low, factor), mu);
      subtract(&high, baum_i_four_times(baum_i_four_of(last.high), factor), mu);
    }
  }
  baum_i_space_column out = {.low = baum_i_four_plus(rest.high, rest.low)};
  out.high = baum_i_four_low(baum_i_four_plus(high.high, high.low));
  baum_i_column_store(b->rest + node->place, 1, 0, tall, out);
}

static void find_residual(baum_i_space *b)
{
  begin_motion(b);
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    if (node->rows > 4) {
      subtract_node(b, node, true);
    } else {
      subtract_node(b, node, false);
    }
  }
  for (int t = 0; t < b->body_count; t++) {
    for (int half = 0; half < 2; half++) {
      ptrdiff_t at = (ptrdiff_t)MOTION * t + (ptrdiff_t)4 * half;
      four sum =
        baum_i_four_plus(baum_i_four_load(b->pull + at), baum_i_four_load(b->pull_low + at));
      four weight =
        half == 1 ? baum_i_four_set(1.0, 1.0, 1.0, 0.0) : baum_i_four_load(b->bodies[t].weight);
      baum_i_four_store(b->pull + at, baum_i_four_times(weight, sum));
    }
  }
}

const baum_i_space_residual_kernel BAUM_I_HOT(baum_i_space_residual_kernel) = {
  .find = find_residual};
