/* SPDX-License-Identifier: BSD-3-Clause */
/* Couplings and factorization of the Schur complement of mechanisms in space; space_block.h
 * describes the equations and the storage.
 *
 * The factorization S = L D L^T is right-looking, node by node. The pivot of a node is divided into
 * a first block of up to three rows and a second block with the other rows,
 *
 *   D = [ D1  C ; C^T  D2 ],  P = D1^-1,  Y = P C,  Z = (D2 - C^T Y)^-1,
 *
 * and both inverses are computed as adjugates divided by determinants. Let X = [ X1 X2 ] be the
 * coupling of the node with a later node i, b the right-hand side, and S_fe the coupling of two
 * later nodes f and e. The elimination of the node computes
 *
 *   b2' = b2 - Y^T b1,  z1 = P b1,  z2 = Z b2',  U1 = X1 P,  X2' = X2 - X1 Y,  U2 = X2' Z,
 *   D_i -= U1 X1^T + U2 X2'^T,  b_i -= X1 z1 + X2' z2,  S_fe -= [ X1  X2' ]_f [ U1  U2 ]_e^T
 *
 * The factors are stored before they are used. In registers they would need more registers than
 * there are.
 *
 * The time of a pivot is the sum of the latencies of its instructions, which wait for each other.
 * Two successive nodes with the same number of rows that are not coupled with each other, for
 * example at both ends of a chain, are therefore factored together: each instruction computes a
 * number of one node and the same number of the other one.
 */
#include <math.h>
#include <string.h>

#include "linear/space_columns.h"

enum { MOST = BAUM_I_SPACE_ROWS, MOTION = BAUM_I_SPACE_MOTION };

typedef baum_i_space_column column;

/* Pivots are bad if a determinant of a node is below this fraction of the product of the diagonal
 * entries of S. */
static const double bad_pivot = 1e-12;

/* ---- off-diagonal blocks ---- */

/* Computes E_i E_k^T / m + R_i R_k^T. Node k is eliminated before node i and has n rows. */
BAUM_I_INLINE void couple_pair(const baum_i_space *b, const baum_i_space_pair *pair, int n,
                               bool tall, bool lean)
{
  static const double UNITS[3][4] = {{1.0}, {0.0, 1.0}, {0.0, 0.0, 1.0}};
  const double *other = b->sides + pair->turn[1];
  const double *other_move = b->sides + pair->move[1];
  const double *weight = b->bodies[pair->body].weight;
  const baum_i_four lean_weight =
    baum_i_four_times(baum_i_four_load(weight), baum_i_four_all(pair->sign));
  double *to = b->off + pair->to;
  /* The columns are loaded before the loop. The compiler would otherwise load them again in each
   * iteration, because it cannot exclude that the stores to `to` change them. */
  column turn[3];
  column move[3];
  BAUM_I_UNROLL(3)
  for (int c = 0; c < 3; c++) {
    turn[c] = baum_i_column_load(b->sides + pair->turn[0], 3, c, tall);
    move[c] = baum_i_column_load(b->sides + pair->move[0], 3, c, tall);
    move[c] = baum_i_column_times(move[c], weight[c], tall);
  }
  BAUM_I_UNROLL(6)
  for (int j = 0; j < n; j++) {
    column sum = {.low = baum_i_four_zero()};
    if (pair->adds) {
      sum = baum_i_column_load(to, n, j, tall);
    }
    BAUM_I_UNROLL(3)
    for (int c = 0; c < 3; c++) {
      ptrdiff_t at = baum_i_column_entry(3, j, c);
      sum = baum_i_column_add(sum, turn[c], other[at], tall);
      if (!lean) {
        sum = baum_i_column_add(sum, move[c], other_move[at], tall);
      }
    }
    if (lean && j < 3) {
      sum.low =
        baum_i_four_plus(sum.low, baum_i_four_times(baum_i_four_load(UNITS[j]), lean_weight));
    }
    baum_i_column_store(to, n, j, tall, sum);
  }
}

static void couple_any(const baum_i_space *b, const baum_i_space_pair *pair)
{
  if (pair->rows[0] > 4) {
    couple_pair(b, pair, pair->rows[1], true, false);
  } else {
    couple_pair(b, pair, pair->rows[1], false, false);
  }
}

static void couple(baum_i_space *b, int first, int end)
{
  for (int i = 0; first == 0 && i < b->zero_count; i++) {
    memset(b->off + b->zeros[2 * i], 0, (size_t)b->zeros[2 * i + 1] * sizeof *b->off);
  }
  for (int i = b->stages[first].pair; i < b->stages[end].pair; i++) {
    const baum_i_space_pair *pair = &b->pairs[i];
    if (pair->sign == 0) {
      couple_any(b, pair);
    } else if (pair->rows[0] == 3 && pair->rows[1] == 3) {
      couple_pair(b, pair, 3, false, true);
    } else if (pair->rows[0] == 5 && pair->rows[1] == 5) {
      couple_pair(b, pair, 5, true, true);
    } else if (pair->rows[0] > 4) {
      couple_pair(b, pair, pair->rows[1], true, true);
    } else {
      couple_pair(b, pair, pair->rows[1], false, true);
    }
  }
}

/* ---- pivots ---- */

/* Numbers of the nodes whose pivots are factored together: number i belongs to node i. The constant
 * `count` is the number of these nodes, 1 or 2. If it is 1, the second number is 0. */
typedef baum_i_pair lanes;

/* The result of a comparison of two vectors. */
typedef long long mask __attribute__((vector_size(16)));

BAUM_I_INLINE lanes gather(int count, double *const from[2], int at)
{
  return (lanes){from[0][at], count > 1 ? from[1][at] : 0.0};
}

/* Returns 1 / x, or (1 / x_0, 0) for one node, because 1 / 0 would raise a floating-point
 * exception. */
BAUM_I_INLINE lanes reciprocal(int count, lanes x)
{
  return count > 1 ? baum_i_both(1.0) / x : (lanes){1.0 / x[0], 0.0};
}

/* Computes the adjugate of a symmetric matrix. Returns the determinant. */
BAUM_I_INLINE lanes adjugate(int n, const lanes s[6], lanes a[6])
{
  if (n == 1) {
    a[0] = baum_i_both(1.0);
    return s[0];
  }
  if (n == 2) {
    a[0] = s[2];
    a[1] = -s[1];
    a[2] = s[0];
    return s[0] * s[2] - s[1] * s[1];
  }
  a[0] = s[2] * s[5] - s[4] * s[4];
  a[1] = s[4] * s[3] - s[1] * s[5];
  a[2] = s[0] * s[5] - s[3] * s[3];
  a[3] = s[1] * s[4] - s[2] * s[3];
  a[4] = s[1] * s[3] - s[0] * s[4];
  a[5] = s[0] * s[2] - s[1] * s[1];
  return s[0] * a[0] + s[1] * a[1] + s[3] * a[3];
}

/* Returns entry (i, j) of a lower triangle. */
BAUM_I_INLINE lanes of_triangle(const lanes s[6], int i, int j)
{
  return i >= j ? s[i * (i + 1) / 2 + j] : s[j * (j + 1) / 2 + i];
}

BAUM_I_INLINE lanes dot(const lanes x[3], const lanes y[3])
{
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* Returns the index of an entry of D, row <= col. */
BAUM_I_INLINE int pivot_entry(int n, int row, int col)
{
  return row < 4 ? 4 * col + row : 4 * n + 2 * (col - 4) + row - 4;
}

/* Stores a vector of four numbers for each node. */
BAUM_I_INLINE void scatter(int count, double *const to[2], int at, const lanes x[4])
{
  baum_i_four even = baum_i_four_joined(x[0], x[2]);
  baum_i_four odd = baum_i_four_joined(x[1], x[3]);
  baum_i_four_store(to[0] + at, baum_i_four_first(even, odd));
  if (count > 1) {
    baum_i_four_store(to[1] + at, baum_i_four_second(even, odd));
  }
}

/* Multiplies a symmetric matrix by `factor`, and stores its columns. */
BAUM_I_INLINE void scale_and_scatter(int n, int count, double *const to[2], int at, lanes factor,
                                     lanes s[6])
{
  BAUM_I_UNROLL(6)
  for (int i = 0; i < n * (n + 1) / 2; i++) {
    s[i] *= factor;
  }
  BAUM_I_UNROLL(3)
  for (int c = 0; c < n; c++) {
    lanes x[4] = {{0.0}};
    BAUM_I_UNROLL(3)
    for (int i = 0; i < n; i++) {
      x[i] = of_triangle(s, i, c);
    }
    scatter(count, to, at + 4 * c, x);
  }
}

/* Sets y = s x, with a symmetric matrix s. */
BAUM_I_INLINE void multiply(int n, const lanes s[6], const lanes x[3], lanes y[3])
{
  BAUM_I_UNROLL(3)
  for (int i = 0; i < n; i++) {
    y[i] = of_triangle(s, i, 0) * x[0];
    BAUM_I_UNROLL(3)
    for (int j = 1; j < n; j++) {
      y[i] += of_triangle(s, i, j) * x[j];
    }
  }
}

/* Factors the pivots of nodes with n rows. The factors are stored in place of D, and (P b1, Z b2')
 * in place of b. With the adjugate A of D1, the product C^T A C is computed at the same time as the
 * reciprocal of det D1, so that D2 - C^T Y is known soon after the reciprocal. */
BAUM_I_INLINE void factor_pivots(int n, int count, double *const b[2], lanes det[2])
{
  double *const d[2] = {b[0] + baum_i_space_pivot(n), b[1] + baum_i_space_pivot(n)};
  int n1 = n < 3 ? n : 3;
  int n2 = n - n1;
  lanes s[6]; /* D1, then D2 - C^T Y */
  lanes a[6]; /* A, then Z */
  lanes p[6];
  lanes c[3][3]; /* C, column by column */
  lanes ac[3][3];
  lanes right[MOST]; /* b1, b2' */
  lanes solved[8] = {{0.0}};
  BAUM_I_UNROLL(6)
  for (int i = 0; i < n; i++) {
    right[i] = gather(count, b, i);
    BAUM_I_UNROLL(3)
    for (int j = 0; i < n1 && j <= i; j++) {
      s[i * (i + 1) / 2 + j] = gather(count, d, pivot_entry(n, j, i));
    }
  }
  det[0] = adjugate(n1, s, a);
  det[1] = baum_i_both(1.0);
  memcpy(p, a, sizeof p);
  lanes reciprocal_det = reciprocal(count, det[0]);
  scale_and_scatter(n1, count, d, 0, reciprocal_det, p);
  multiply(n1, p, right, solved);
  BAUM_I_UNROLL(3)
  for (int k = 0; k < n2; k++) {
    BAUM_I_UNROLL(3)
    for (int i = 0; i < 3; i++) {
      c[k][i] = gather(count, d, pivot_entry(n, i, 3 + k));
    }
    multiply(3, a, c[k], ac[k]);
    BAUM_I_UNROLL(3)
    for (int j = 0; j <= k; j++) {
      s[k * (k + 1) / 2 + j] =
        gather(count, d, pivot_entry(n, 3 + j, 3 + k)) - reciprocal_det * dot(c[k], ac[j]);
    }
    right[3 + k] -= dot(c[k], solved);
    lanes y[4] = {reciprocal_det * ac[k][0], reciprocal_det * ac[k][1], reciprocal_det * ac[k][2]};
    scatter(count, d, 12 + 4 * k, y);
  }
  if (n2 > 0) {
    det[1] = adjugate(n2, s, a);
    scale_and_scatter(n2, count, d, 4 * n, reciprocal(count, det[1]), a);
    multiply(n2, a, right + 3, solved + 3);
  }
  scatter(count, b, 0, solved);
  BAUM_I_UNROLL(2)
  for (int i = 0; i < count && n > 4; i++) {
    baum_i_store(b[i] + 4, (baum_i_pair){solved[4][i], solved[5][i]});
  }
}

/* ---- couplings ---- */

/* Subtracts X' U^T from a block of off[] or, if `is_pivot`, from D of the later node. Here x is X'
 * = [ X1 X2' ] of one coupling, and u is U = [ U1 U2 ] of an earlier coupling or, for D, of the
 * same coupling. D is symmetric, so x and u may also be exchanged, and rows 4 and 5 of D are stored
 * only for columns 4 and 5. n: number of rows of the eliminated node. */
BAUM_I_INLINE void subtract_product(int n, const column x[MOST], bool tall, const double *u,
                                    int columns, bool is_pivot, double *to)
{
  for (int j = 0; j < columns; j++) {
    bool high = tall && (!is_pivot || j >= 4);
    double *low_at = to + 4 * j;
    double *high_at = to + 4 * columns + 2 * (is_pivot ? j - 4 : j);
    column sum = {.low = baum_i_four_load(low_at)};
    if (high) {
      sum.high = baum_i_load(high_at);
    }
    BAUM_I_UNROLL(6)
    for (int k = 0; k < n; k++) {
      sum = baum_i_column_subtract(sum, x[k], u[baum_i_column_entry(n, j, k)], high);
    }
    baum_i_four_store(low_at, sum.low);
    if (high) {
      baum_i_store(high_at, sum.high);
    }
  }
}

/* Computes X' and U of the coupling at `off`. Stores U at once if n > 3, so that its columns do not
 * occupy registers. `numbers` are those of the eliminated node. */
BAUM_I_INLINE void find_columns(int n, const double *numbers, double *off, bool tall,
                                column x[MOST], column u[MOST])
{
  const double *p = numbers + baum_i_space_pivot(n);
  const double *y = p + 12;
  const double *z = p + 4 * n;
  int n1 = n < 3 ? n : 3;
  BAUM_I_UNROLL(6)
  for (int k = 0; k < n; k++) {
    x[k] = baum_i_column_load(off, n, k, tall);
  }
  BAUM_I_UNROLL(6)
  for (int j = 0; j < n1; j++) {
    u[j] = baum_i_column_times(x[0], p[4 * j], tall);
    BAUM_I_UNROLL(6)
    for (int k = 1; k < n1; k++) {
      u[j] = baum_i_column_add(u[j], x[k], p[4 * j + k], tall);
    }
    if (n > 3) {
      baum_i_column_store(off, n, j, tall, u[j]);
    }
  }
  BAUM_I_UNROLL(6)
  for (int j = 3; j < n; j++) {
    BAUM_I_UNROLL(6)
    for (int k = 0; k < 3; k++) {
      x[j] = baum_i_column_subtract(x[j], x[k], y[4 * (j - 3) + k], tall);
    }
  }
  BAUM_I_UNROLL(6)
  for (int j = 3; j < n; j++) {
    u[j] = baum_i_column_times(x[3], z[4 * (j - 3)], tall);
    BAUM_I_UNROLL(6)
    for (int k = 4; k < n; k++) {
      u[j] = baum_i_column_add(u[j], x[k], z[4 * (j - 3) + k - 3], tall);
    }
    baum_i_column_store(off, n, j, tall, u[j]);
  }
}

/* Subtracts the contribution of a coupling from the later node, and replaces the coupling by U. x
 * receives X'. If n <= 3, D is updated with columns of U that are still in registers and with
 * entries of X in memory, because U would have to be stored before its entries can be loaded. */
BAUM_I_INLINE void eliminate_one(int n, const double *numbers, double *off, int rows, bool tall,
                                 double *later, column x[MOST])
{
  column u[MOST];
  find_columns(n, numbers, off, tall, x, u);
  column right = baum_i_column_load(later, 1, 0, tall);
  BAUM_I_UNROLL(6)
  for (int k = 0; k < n; k++) {
    right = baum_i_column_subtract(right, x[k], numbers[k], tall);
  }
  baum_i_column_store(later, 1, 0, tall, right);
  subtract_product(n, n > 3 ? x : u, tall, off, rows, true, later + (tall ? 16 : 8));
  BAUM_I_UNROLL(3)
  for (int k = 0; k < n && n <= 3; k++) {
    baum_i_column_store(off, n, k, tall, u[k]);
  }
}

/* Returns p. The compiler does not know that, so it cannot move work that variants of the same code
 * share to a place before the branch that selects one of them. There, this work would need more
 * registers than there are. */
BAUM_I_INLINE double *hidden(double *p)
{
  __asm__("" : "+r"(p));
  return p;
}

/* Eliminates coupling f of a node, and multiplies it with the couplings before it, which begin with
 * `first`. */
BAUM_I_INLINE void eliminate_coupling(int n, const baum_i_space *b, double *numbers,
                                      const baum_i_space_coupling *first,
                                      const baum_i_space_coupling *f, int rows, bool tall,
                                      const int32_t *target)
{
  column x[MOST];
  eliminate_one(n, hidden(numbers), hidden(b->off + f->at), rows, tall, b->nodes + f->numbers, x);
  for (const baum_i_space_coupling *e = first; e < f; e++) {
    subtract_product(n, x, tall, b->off + e->at, e->rows, false, b->off + *target++);
  }
}

/* ---- nodes ---- */

/* Tells whether node k + 1 is before node `end`, has n rows, like node k, and is not coupled with
 * node k. Couplings are in ascending order of `later`. */
BAUM_I_INLINE bool has_twin(int n, const baum_i_space *b, int k, int end)
{
  const int32_t *start = b->order.start + k;
  return k + 1 < end && b->list[k + 1].rows == n &&
         (start[0] == start[1] || b->couplings[start[0]].later > k + 1);
}

/* Factors the pivots of `count` nodes, from node k on, and stores their determinants. */
BAUM_I_INLINE void factor_nodes(int n, int count, const baum_i_space *b, int k,
                                double *const numbers[2])
{
  lanes det[2];
  factor_pivots(n, count, numbers, det);
  BAUM_I_UNROLL(2)
  for (int i = 0; i < count; i++) {
    double sign = b->list[k + i].spin != 0 ? -1.0 : 1.0; /* a spin row makes det D negative */
    baum_i_store(b->measures[k + i].det, (baum_i_pair){det[0][i], sign * det[1][i]});
  }
}

/* Eliminates node k, which has n rows, and its twin if it has one before node `last`. Moves the
 * pointer to the next target. Returns the next node. */
BAUM_I_INLINE int eliminate_nodes(int n, const baum_i_space *b, int k, int last,
                                  const int32_t **target)
{
  const baum_i_space_coupling *first = b->couplings + b->order.start[k];
  const baum_i_space_coupling *second = b->couplings + b->order.start[k + 1];
  const baum_i_space_coupling *end = second;
  double *numbers[2] = {b->nodes + b->list[k].at, b->nodes + b->list[k].at};
  if (has_twin(n, b, k, last)) {
    numbers[1] = b->nodes + b->list[k + 1].at;
    factor_nodes(n, 2, b, k, numbers);
    end = b->couplings + b->order.start[k + 2];
    k += 2;
  } else {
    factor_nodes(n, 1, b, k, numbers);
    k++;
  }
  for (const baum_i_space_coupling *f = first; f < end; f++) {
    if (f == second) {
      first = second;
      numbers[0] = numbers[1];
    }
    int rows = f->rows;
    if (rows == n) {
      eliminate_coupling(n, b, numbers[0], first, f, n, n > 4, *target);
    } else if (rows > 4) {
      eliminate_coupling(n, b, numbers[0], first, f, rows, true, *target);
    } else {
      eliminate_coupling(n, b, numbers[0], first, f, rows, false, *target);
    }
    *target += f - first;
  }
  return k;
}

/* Eliminates nodes before node `end`, from node k on, while they have n rows. Returns the next
 * node. */
BAUM_I_INLINE int eliminate_run(int n, const baum_i_space *b, int k, int end,
                                const int32_t **target)
{
  while (k < end && b->list[k].rows == n) {
    k = eliminate_nodes(n, b, k, end, target);
  }
  return k;
}

/* Tells whether no pivot is weak. */
static bool is_fine(const baum_i_space *b)
{
  const baum_i_pair weak = baum_i_both(b->weak_pivot);
  mask fine = {-1, -1};
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_measure *m = &b->measures[k];
    fine &= baum_i_load(m->det) > weak * baum_i_load(m->size);
  }
  return fine[0] && fine[1];
}

/* Returns the smallest ratio of a determinant to the product of the diagonal entries of S, or NaN
 * if a ratio is NaN. */
static double weakest(const baum_i_space *b)
{
  double least[2] = {1.0, 1.0};
  bool known = true;
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_measure *m = &b->measures[k];
    baum_i_pair ratio = baum_i_load(m->det) / baum_i_load(m->size);
    least[0] = ratio[0] < least[0] ? ratio[0] : least[0];
    least[1] = ratio[1] < least[1] ? ratio[1] : least[1];
    known = known && !isnan(ratio[0] + ratio[1]);
  }
  double smaller = least[0] < least[1] ? least[0] : least[1];
  return known ? smaller : (double)NAN;
}

static baum_i_pivots eliminate(baum_i_space *b, int first, int end)
{
  const int32_t *target = b->targets ? b->targets + b->stages[first].target : NULL;
  const int last = b->stages[end].node;
  for (int k = b->stages[first].node; k < last;) {
    switch (b->list[k].rows) {
    case 1: k = eliminate_run(1, b, k, last, &target); break;
    case 2: k = eliminate_run(2, b, k, last, &target); break;
    case 3: k = eliminate_run(3, b, k, last, &target); break;
    case 4: k = eliminate_run(4, b, k, last, &target); break;
    case 5: k = eliminate_run(5, b, k, last, &target); break;
    default: k = eliminate_run(6, b, k, last, &target); break;
    }
  }
  if (end < b->stage_count) {
    return BAUM_I_PIVOTS_GOOD;
  }
  memcpy(b->motion, b->from, (size_t)(MOTION * b->body_count) * sizeof *b->motion);
  b->weakest = b->weak_pivot;
  if (is_fine(b)) {
    return BAUM_I_PIVOTS_GOOD;
  }
  b->weakest = weakest(b);
  return b->weakest > bad_pivot ? BAUM_I_PIVOTS_WEAK : BAUM_I_PIVOTS_BAD;
}

const baum_i_space_factor_kernel BAUM_I_HOT(baum_i_space_factor_kernel) = {.couple = couple,
                                                                           .eliminate = eliminate};
