/* SPDX-License-Identifier: BSD-3-Clause */
/* Substitution and refinement for mechanisms in space, with the factors of space_factor_hot.c:
 *
 *   lambda2 = Z b2' - U2^T lambda_i,  lambda1 = P b1 - U1^T lambda_i - Y lambda2.
 *
 * Refinement is that of block_hot.c. */
#include <math.h>
#include <string.h>

#include "linear/space_columns.h"

enum { MOST = BAUM_I_SPACE_ROWS, MOTION = BAUM_I_SPACE_MOTION };

typedef baum_i_space_column column;

/* A residual of up to this fraction of its terms is at rounding level. */
static const double rounding = 0x1p-46;

/* ---- substitute ---- */

/* G^T lambda for a matrix with three columns. */
BAUM_I_INLINE baum_i_four transposed_times(const double *m, column lambda, bool tall)
{
  baum_i_four products[4];
  for (int c = 0; c < 3; c++) {
    column g = baum_i_column_load(m, 3, c, tall);
    products[c] = baum_i_four_times(g.low, lambda.low);
    if (tall) {
      products[c] = baum_i_four_plus(products[c], baum_i_four_of(g.high * lambda.high));
    }
  }
  products[3] = baum_i_four_zero();
  return baum_i_four_sums(products);
}

/* motion -= W J^T lambda for one node. */
BAUM_I_INLINE void scatter(const baum_i_space *b, const baum_i_space_node *node, column lambda,
                           bool tall)
{
  const baum_i_space_side *side = b->side_list + node->first_side;
  for (int s = 0; s < node->side_count; s++, side++) {
    double *x = b->motion + (ptrdiff_t)MOTION * side->body;
    baum_i_four weight = baum_i_four_load(b->bodies[side->body].weight);
    baum_i_four push = lambda.low;
    if (side->sign == 0) {
      push = transposed_times(b->sides + side->move, lambda, tall);
    } else {
      weight = baum_i_four_times(weight, baum_i_four_all(side->sign));
    }
    baum_i_four turn = transposed_times(b->sides + side->turn, lambda, tall);
    baum_i_four_store(x, baum_i_four_minus(baum_i_four_load(x), baum_i_four_times(weight, push)));
    baum_i_four_store(x + 4, baum_i_four_minus(baum_i_four_load(x + 4), turn));
  }
}

/* Multiplies each of the n columns of U, entry by entry, by lambda of a later node, and adds the
 * products to sum[c] for column c. The entries of sum[c] add up to entry c of U^T lambda. */
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

/* Substitutes backward at node k of n rows; returns its lambda. */
BAUM_I_INLINE column backward_node(int n, const baum_i_space *b, int k)
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
  scatter(b, node, lambda, tall);
  return lambda;
}

static void put_rows(const baum_i_space *b, const baum_i_space_node *node, double *lambda)
{
  const double *from = b->nodes + node->at;
  for (int i = 0; i < node->rows; i++) {
    lambda[node->row[i]] = from[i];
  }
}

static void backward(const baum_i_space *b)
{
  for (int k = b->node_count - 1; k >= 0; k--) {
    switch (b->list[k].rows) {
    case 1: (void)backward_node(1, b, k); break;
    case 2: (void)backward_node(2, b, k); break;
    case 3: (void)backward_node(3, b, k); break;
    case 4: (void)backward_node(4, b, k); break;
    case 5: (void)backward_node(5, b, k); break;
    default: (void)backward_node(6, b, k); break;
    }
  }
}

static void read_lambda(const baum_i_space *b, double *lambda)
{
  for (int k = 0; k < b->node_count; k++) {
    put_rows(b, &b->list[k], lambda);
  }
}

static void substitute(baum_i_space *b, double *lambda)
{
  backward(b);
  read_lambda(b, lambda);
}

/* lambda = D^-1 L^-1 lambda with the present factors. */
static void forward_node(const baum_i_space *b, int k)
{
  const baum_i_space_node *node = &b->list[k];
  int n = node->rows;
  int n1 = n < 3 ? n : 3;
  double *numbers = b->nodes + node->at;
  const double *d = numbers + baum_i_space_pivot(n);
  double right[MOST];
  double out[MOST] = {0.0};
  memcpy(right, numbers, (size_t)n * sizeof *right);
  for (int c = 3; c < n; c++) {
    for (int i = 0; i < 3; i++) {
      right[c] -= d[4 * c + i] * right[i];
    }
  }
  for (int e = b->order.start[k]; e < b->order.start[k + 1]; e++) {
    const baum_i_space_node *later = &b->list[b->couplings[e].later];
    const double *u = b->off + b->couplings[e].at;
    double *to = b->nodes + later->at;
    for (int i = 0; i < later->rows; i++) {
      for (int c = 0; c < n; c++) {
        to[i] -= u[baum_i_column_entry(n, i, c)] * right[c];
      }
    }
  }
  for (int i = 0; i < n1; i++) {
    for (int c = 0; c < n1; c++) {
      out[i] += d[4 * c + i] * right[c];
    }
  }
  for (int i = 0; i < n - n1; i++) {
    for (int c = 0; c < n - n1; c++) {
      out[3 + i] += d[4 * n + 4 * c + i] * right[3 + c];
    }
  }
  memcpy(numbers, out, (size_t)n * sizeof *out);
}

/* ---- residual and refinement ---- */

static column magnitude(column x)
{
  double low[4];
  double high[2];
  baum_i_four_store(low, x.low);
  baum_i_store(high, x.high);
  for (int i = 0; i < 4; i++) {
    low[i] = fabs(low[i]);
  }
  return (column){baum_i_four_load(low), {fabs(high[0]), fabs(high[1])}};
}

static bool check_node(const baum_i_space *b, const baum_i_space_node *node)
{
  bool tall = node->rows > 4;
  column rest = baum_i_column_load(b->nodes + node->at + (tall ? 8 : 4), 1, 0, tall);
  column size = magnitude(rest);
  for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
    const baum_i_space_side *side = &b->side_list[s];
    const double *x = b->motion + (ptrdiff_t)MOTION * side->body;
    for (int c = 0; c < 6; c++) {
      column g = c < 3 ? baum_i_column_load(b->sides + side->move, 3, c, tall)
                       : baum_i_column_load(b->sides + side->turn, 3, c - 3, tall);
      double y = c < 3 ? x[c] : x[c + 1];
      rest = baum_i_column_subtract(rest, g, y, tall);
      size = baum_i_column_add(size, magnitude(g), fabs(y), tall);
    }
  }
  double over[8] = {0.0};
  double limit[8] = {0.0};
  baum_i_column_store(over, 1, 0, true, rest);
  baum_i_column_store(limit, 1, 0, true, size);
  bool fine = true;
  for (int i = 0; i < node->rows; i++) {
    fine = fine && fabs(over[i]) <= rounding * limit[i];
  }
  return fine;
}

static bool check(const baum_i_space *b)
{
  bool fine = true;
  for (int k = 0; k < b->node_count && fine; k++) {
    fine = check_node(b, &b->list[k]);
  }
  return fine;
}

/* lambda = J pull - rest at all nodes. */
static void gather(const baum_i_space *b)
{
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    bool tall = node->rows > 4;
    column sum = {.low = baum_i_four_zero()};
    for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
      const baum_i_space_side *side = &b->side_list[s];
      const double *x = b->pull + (ptrdiff_t)MOTION * side->body;
      for (int c = 0; c < 3; c++) {
        sum =
          baum_i_column_add(sum, baum_i_column_load(b->sides + side->move, 3, c, tall), x[c], tall);
        sum = baum_i_column_add(sum, baum_i_column_load(b->sides + side->turn, 3, c, tall),
                                x[4 + c], tall);
      }
    }
    sum =
      baum_i_column_subtract(sum, baum_i_column_load(b->rest + node->place, 1, 0, tall), 1.0, tall);
    baum_i_column_store(b->nodes + node->at, 1, 0, tall, sum);
  }
}

static double correct(baum_i_space *b)
{
  double *before = b->rest_low;
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    memcpy(before + node->place, b->nodes + node->at, (size_t)node->rows * sizeof *before);
  }
  gather(b);
  for (int k = 0; k < b->node_count; k++) {
    forward_node(b, k);
  }
  for (int i = 0; i < MOTION * b->body_count; i++) {
    b->motion[i] += b->pull[i];
  }
  backward(b);
  double change = 0.0;
  double size = 0.0;
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_node *node = &b->list[k];
    double *l = b->nodes + node->at;
    for (int i = 0; i < node->rows; i++) {
      change = fmax(change, fabs(l[i]));
      l[i] += before[node->place + i];
      size = fmax(size, fabs(l[i]));
    }
  }
  return size > 0.0 ? change / size : 0.0;
}

/* ---- results ---- */

static bool read_motion(const baum_i_space *b, double *a)
{
  double sum = 0.0; /* sum of 0 x_i, which is 0, or NaN if a number is not finite */
  for (int t = 1; t < b->body_count; t++) {
    const baum_i_space_body *body = &b->bodies[t];
    const double *x = b->motion + (ptrdiff_t)MOTION * t;
    double six[6] = {x[0], x[1], x[2]};
    for (int i = 0; i < 3; i++) {
      const double *w = body->whiten + 4 * (ptrdiff_t)i;
      six[3 + i] = w[0] * x[4] + w[1] * x[5] + w[2] * x[6];
    }
    for (int c = 0; c < body->size; c++) {
      a[body->first + c] = six[body->slots[c]];
      sum += 0.0 * a[body->first + c];
    }
  }
  return sum == 0.0;
}

const baum_i_space_kernel BAUM_I_HOT(baum_i_space_kernel) = {
  .substitute = substitute,
  .check = check,
  .correct = correct,
  .read_motion = read_motion,
  .read_lambda = read_lambda,
};
