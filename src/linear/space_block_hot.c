/* SPDX-License-Identifier: BSD-3-Clause */
/* Substitution for mechanisms in space, with the factors of space_factor_hot.c:
 *
 *   lambda2 = Z b2' - U2^T lambda_i,  lambda1 = P b1 - U1^T lambda_i - Y lambda2.
 *
 * The terms with lambda_i are summed over later nodes i. */
#include "linear/space_columns.h"

enum { MOST = BAUM_I_SPACE_ROWS, MOTION = BAUM_I_SPACE_MOTION };

typedef baum_i_four four;
typedef baum_i_space_column column;

/* ---- substitute ---- */

/* Subtracts W J^T lambda of one node from the motion. */
BAUM_I_INLINE void scatter(const baum_i_space *b, const baum_i_space_node *node, column lambda,
                           bool tall)
{
  const baum_i_space_side *side = b->side_list + node->first_side;
  for (int s = 0; s < node->side_count; s++, side++) {
    double *x = b->motion + (ptrdiff_t)MOTION * side->body;
    baum_i_four weight = baum_i_four_load(b->bodies[side->body].weight);
    baum_i_four push = lambda.low;
    if (side->sign == 0) {
      push = baum_i_column_transposed_times(b->sides + side->move, lambda, tall);
    } else {
      weight = baum_i_four_times(weight, baum_i_four_all(side->sign));
    }
    baum_i_four turn = baum_i_column_transposed_times(b->sides + side->turn, lambda, tall);
    baum_i_four_store(x, baum_i_four_minus(baum_i_four_load(x), baum_i_four_times(weight, push)));
    baum_i_four_store(x + 4, baum_i_four_minus(baum_i_four_load(x + 4), turn));
  }
}

/* Multiplies each column c of U, entry by entry, by lambda of a later node, and adds the products
 * to sum[c]. The entries of sum[c] add up to entry c of U^T lambda. */
BAUM_I_INLINE void add_products(int n, const double *u, const double *later, bool tall,
                                baum_i_four sum[8])
{
  column lambda = baum_i_column_load(later, 1, 0, tall);
  BAUM_I_UNROLL(8)
  for (int c = 0; c < n; c++) {
    column x = baum_i_column_load(u, n, c, tall);
    sum[c] = baum_i_four_plus(sum[c], baum_i_four_times(x.low, lambda.low));
    if (tall) {
      sum[c] = baum_i_four_plus(sum[c], baum_i_four_of(x.high * lambda.high));
    }
  }
}

/* Substitutes backward at node k, which has n rows. Also writes its multipliers to `out` unless
 * that is NULL. */
BAUM_I_INLINE void backward_node(int n, const baum_i_space *b, int k, double *out)
{
  bool tall = n > 4;
  const baum_i_space_node *node = &b->list[k];
  double *numbers = b->nodes + node->at;
  const double *d = numbers + baum_i_space_pivot(n);
  baum_i_four sum[8];
  BAUM_I_UNROLL(8)
  for (int c = 0; c < 8; c++) {
    sum[c] = baum_i_four_zero();
  }
  for (int e = b->order.start[k]; e < b->order.start[k + 1]; e++) {
    const baum_i_space_node *later = &b->list[b->couplings[e].later];
    if (later->rows > 4) {
      add_products(n, b->off + b->couplings[e].at, b->nodes + later->at, true, sum);
    } else {
      add_products(n, b->off + b->couplings[e].at, b->nodes + later->at, false, sum);
    }
  }
  column lambda = baum_i_column_load(numbers, 1, 0, tall);
  lambda.low = baum_i_four_minus(lambda.low, baum_i_four_sums(sum));
  if (tall) {
    lambda.high -= baum_i_four_low(baum_i_four_sums(sum + 4));
  }
  if (n > 3) { /* row 3 of Y is 0 */
    baum_i_four first = lambda.low;
    first = baum_i_four_subtract(first, baum_i_four_load(d + 12), baum_i_four_high(lambda.low)[1]);
    BAUM_I_UNROLL(8)
    for (int c = 4; c < n; c++) {
      first = baum_i_four_subtract(first, baum_i_four_load(d + 4 * c), lambda.high[c - 4]);
    }
    lambda.low = first;
  }
  baum_i_column_store(numbers, 1, 0, tall, lambda);
  if (out) {
    BAUM_I_UNROLL(6)
    for (int i = 0; i < n - 1; i++) {
      out[node->row[i]] = numbers[i];
    }
    if (node->spin == 0) {
      out[node->row[n - 1]] = numbers[n - 1];
    }
  }
  scatter(b, node, lambda, tall);
}

static void substitute(baum_i_space *b, double *lambda)
{
  for (int k = b->node_count - 1; k >= 0; k--) {
    switch (b->list[k].rows) {
    case 1: backward_node(1, b, k, lambda); break;
    case 2: backward_node(2, b, k, lambda); break;
    case 3: backward_node(3, b, k, lambda); break;
    case 4: backward_node(4, b, k, lambda); break;
    case 5: backward_node(5, b, k, lambda); break;
    default: backward_node(6, b, k, lambda); break;
    }
  }
}

static void read_lambda(const baum_i_space *b, double *lambda)
{
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    for (int i = 0; i < baum_i_space_own_rows(node); i++) {
      lambda[node->row[i]] = b->nodes[node->at + i];
    }
  }
}

/* ---- results ---- */

static bool read_motion(const baum_i_space *b, double *a)
{
  four sum = baum_i_four_zero(); /* a sum of 0 x: 0, or NaN if an x is not finite */
  for (int t = 1; t < b->body_count; t++) {
    const baum_i_space_body *body = &b->bodies[t];
    const double *from = b->motion + (ptrdiff_t)MOTION * t;
    double *to = a + body->first;
    four x = baum_i_four_load(from);
    four w = baum_i_space_unwhitened(body, from + 4);
    sum = baum_i_four_add(baum_i_four_add(sum, x, 0.0), w, 0.0);
    baum_i_store(to, baum_i_four_low(x));
    if (body->size == 6) {
      to[2] = baum_i_four_high(x)[0];
      baum_i_store(to + 3, baum_i_four_low(w));
      to[5] = baum_i_four_high(w)[0];
    } else if (body->size == 3) {
      to[2] = baum_i_four_high(body->slots[2] == 5 ? w : x)[0];
    }
  }
  return baum_i_four_sum(sum) == 0.0;
}
const baum_i_space_kernel BAUM_I_HOT(baum_i_space_kernel) = {
  .substitute = substitute, .read_motion = read_motion, .read_lambda = read_lambda};
