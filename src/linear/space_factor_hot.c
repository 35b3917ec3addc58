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

static void couple(baum_i_space *b)
{
  for (int i = 0; i < b->zero_count; i++) {
    memset(b->off + b->zeros[2 * i], 0, (size_t)b->zeros[2 * i + 1] * sizeof *b->off);
  }
  for (int i = 0; i < b->pair_count; i++) {
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

/* ---- factor ---- */

/* The pivot of the node being eliminated. A symmetric matrix is stored as its lower triangle, row
 * by row. */
typedef struct pivot {
  double p[6];
  double c[3][3]; /* C, column by column */
  double y[3][3]; /* Y, column by column */
  double z[6];
  double b[MOST]; /* b1, b2' */
} pivot;

/* Replaces a symmetric matrix by its inverse. Returns its determinant. */
BAUM_I_INLINE double invert(int n, double s[6])
{
  if (n == 1) {
    double det = s[0];
    s[0] = 1.0 / det;
    return det;
  }
  if (n == 2) {
    double det = s[0] * s[2] - s[1] * s[1];
    double inverse = 1.0 / det;
    double first = s[0];
    s[0] = inverse * s[2];
    s[1] = -inverse * s[1];
    s[2] = inverse * first;
    return det;
  }
  double a[6] = {s[2] * s[5] - s[4] * s[4], s[4] * s[3] - s[1] * s[5], s[0] * s[5] - s[3] * s[3],
                 s[1] * s[4] - s[2] * s[3], s[1] * s[3] - s[0] * s[4], s[0] * s[2] - s[1] * s[1]};
  double det = s[0] * a[0] + s[1] * a[1] + s[3] * a[3];
  double inverse = 1.0 / det;
  for (int i = 0; i < 6; i++) {
    s[i] = inverse * a[i];
  }
  return det;
}

/* Returns entry (i, j) of a lower triangle. */
BAUM_I_INLINE double of_triangle(const double s[6], int i, int j)
{
  return i >= j ? s[i * (i + 1) / 2 + j] : s[j * (j + 1) / 2 + i];
}

BAUM_I_INLINE double pivot_entry(const double *d, int n, int row, int col)
{
  return row < 4 ? d[4 * col + row] : d[4 * n + 2 * (col - 4) + row - 4];
}

/* Factors D of a node with n rows. */
BAUM_I_INLINE void factor_pivot(int n, const double *d, const double *b, pivot *t, double det[2])
{
  int n1 = n < 3 ? n : 3;
  int n2 = n - n1;
  BAUM_I_UNROLL(6)
  for (int i = 0; i < n1; i++) {
    BAUM_I_UNROLL(3)
    for (int j = 0; j <= i; j++) {
      t->p[i * (i + 1) / 2 + j] = pivot_entry(d, n, j, i);
    }
  }
  BAUM_I_UNROLL(6)
  for (int i = 0; i < n; i++) {
    t->b[i] = b[i];
  }
  det[0] = invert(n1, t->p);
  BAUM_I_UNROLL(6)
  for (int k = 0; k < n2; k++) {
    BAUM_I_UNROLL(6)
    for (int i = 0; i < 3; i++) {
      t->c[k][i] = d[4 * (3 + k) + i];
    }
    BAUM_I_UNROLL(6)
    for (int i = 0; i < 3; i++) {
      t->y[k][i] = of_triangle(t->p, i, 0) * t->c[k][0] + of_triangle(t->p, i, 1) * t->c[k][1] +
                   of_triangle(t->p, i, 2) * t->c[k][2];
    }
    t->b[3 + k] -= t->y[k][0] * b[0] + t->y[k][1] * b[1] + t->y[k][2] * b[2];
    BAUM_I_UNROLL(3)
    for (int j = 0; j <= k; j++) {
      t->z[k * (k + 1) / 2 + j] =
        pivot_entry(d, n, 3 + j, 3 + k) -
        (t->c[k][0] * t->y[j][0] + t->c[k][1] * t->y[j][1] + t->c[k][2] * t->y[j][2]);
    }
  }
  det[1] = n2 > 0 ? invert(n2, t->z) : 1.0;
}

/* Stores the factors in place of D, and (P b1, Z b2') in place of b. */
BAUM_I_INLINE void store_factors(int n, const pivot *t, double *d, double *b)
{
  int n1 = n < 3 ? n : 3;
  int n2 = n - n1;
  double p[6] = {0.0};
  double z[6] = {0.0};
  double x[6] = {0.0};
  BAUM_I_UNROLL(3)
  for (int c = 0; c < n1; c++) {
    BAUM_I_UNROLL(3)
    for (int i = 0; i < n1; i++) {
      p[i] = of_triangle(t->p, i, c);
      x[i] += p[i] * t->b[c];
    }
    baum_i_four_store(d + 4 * c, baum_i_four_set(p[0], p[1], p[2], 0.0));
  }
  BAUM_I_UNROLL(3)
  for (int k = 0; k < n2; k++) {
    BAUM_I_UNROLL(3)
    for (int i = 0; i < n2; i++) {
      z[i] = of_triangle(t->z, i, k);
      x[3 + i] += z[i] * t->b[3 + k];
    }
    baum_i_four_store(d + 12 + 4 * k, baum_i_four_set(t->y[k][0], t->y[k][1], t->y[k][2], 0.0));
    baum_i_four_store(d + 12 + 4 * n2 + 4 * k, baum_i_four_set(z[0], z[1], z[2], 0.0));
  }
  baum_i_four_store(b, baum_i_four_set(x[0], x[1], x[2], x[3]));
  if (n > 4) {
    baum_i_store(b + 4, (baum_i_pair){x[4], x[5]});
  }
}

/* Subtracts X' U^T from a block of off[] or, if `is_pivot`, from D of the later node. Here x is X'
 * = [ X1 X2' ] of one coupling, and u is U = [ U1 U2 ] of an earlier coupling or, for D, of the
 * same coupling. D is symmetric, so rows 4 and 5 of D are stored only for columns 4 and 5. n:
 * number of rows of the eliminated node. */
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

/* Subtracts the contribution of the coupling at `off` from the later node, and replaces the
 * coupling by U. x receives X'. `numbers` are those of the eliminated node, rows: number of rows of
 * the later node. */
BAUM_I_INLINE void eliminate_one(int n, const double *numbers, double *off, int rows, bool tall,
                                 double *node, column x[MOST])
{
  const double *p = numbers + baum_i_space_pivot(n);
  const double *y = p + 12;
  const double *z = p + 4 * n;
  int n1 = n < 3 ? n : 3;
  column u[MOST];
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
    baum_i_column_store(off, n, j, tall, u[j]);
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
  column b = baum_i_column_load(node, 1, 0, tall);
  BAUM_I_UNROLL(6)
  for (int k = 0; k < n; k++) {
    b = baum_i_column_subtract(b, x[k], numbers[k], tall);
  }
  baum_i_column_store(node, 1, 0, tall, b);
  subtract_product(n, x, tall, off, rows, true, node + (tall ? 16 : 8));
}

/* Eliminates coupling f of a node, and multiplies it with the couplings e before it. Returns the
 * next target. */
BAUM_I_INLINE const int32_t *eliminate_coupling(int n, const baum_i_space *b, const double *numbers,
                                                const baum_i_space_coupling *first,
                                                const baum_i_space_coupling *f, int rows, bool tall,
                                                const int32_t *target)
{
  column x[MOST];
  const baum_i_space_node *later = &b->list[f->later];
  eliminate_one(n, numbers, b->off + f->at, rows, tall, b->nodes + later->at, x);
  for (const baum_i_space_coupling *e = first; e < f; e++) {
    subtract_product(n, x, tall, b->off + e->at, b->list[e->later].rows, false, b->off + *target++);
  }
  return target;
}

/* Eliminates node k, which has n rows. Returns the next target. */
BAUM_I_INLINE const int32_t *eliminate_node(int n, const baum_i_space *b, int k,
                                            const int32_t *target)
{
  double *numbers = b->nodes + b->list[k].at;
  double *d = numbers + baum_i_space_pivot(n);
  const baum_i_space_coupling *first = b->couplings + b->order.start[k];
  const baum_i_space_coupling *end = b->couplings + b->order.start[k + 1];
  pivot t;
  baum_i_space_measure *measure = &b->measures[k];
  factor_pivot(n, d, numbers, &t, measure->det);
  measure->det[1] *= b->list[k].spin != 0 ? -1.0 : 1.0; /* D is not positive definite */
  store_factors(n, &t, d, numbers);
  for (const baum_i_space_coupling *f = first; f < end; f++) {
    int rows = b->list[f->later].rows;
    if (rows == n) {
      target = eliminate_coupling(n, b, numbers, first, f, n, n > 4, target);
    } else if (rows > 4) {
      target = eliminate_coupling(n, b, numbers, first, f, rows, true, target);
    } else {
      target = eliminate_coupling(n, b, numbers, first, f, rows, false, target);
    }
  }
  return target;
}

/* Returns the smallest ratio of a determinant to the product of the diagonal entries of S, or NaN
 * if a ratio is NaN. */
static double weakest(const baum_i_space *b)
{
  double least = 1.0;
  for (int k = 0; k < b->node_count; k++) {
    const baum_i_space_measure *m = &b->measures[k];
    for (int i = 0; i < 2; i++) {
      double ratio = m->det[i] / m->size[i];
      least = ratio >= least || isnan(least) ? least : ratio;
    }
  }
  return least;
}

static baum_i_pivots eliminate(baum_i_space *b)
{
  memcpy(b->motion, b->from, (size_t)(MOTION * b->body_count) * sizeof *b->motion);
  const int32_t *target = b->targets;
  double weak = b->weak_pivot;
  bool fine = true;
  for (int k = 0; k < b->node_count; k++) {
    switch (b->list[k].rows) {
    case 1: target = eliminate_node(1, b, k, target); break;
    case 2: target = eliminate_node(2, b, k, target); break;
    case 3: target = eliminate_node(3, b, k, target); break;
    case 4: target = eliminate_node(4, b, k, target); break;
    case 5: target = eliminate_node(5, b, k, target); break;
    default: target = eliminate_node(6, b, k, target); break;
    }
    const baum_i_space_measure *m = &b->measures[k];
    fine = fine && m->det[0] > weak * m->size[0] && m->det[1] > weak * m->size[1];
  }
  b->weakest = weak;
  if (fine) {
    return BAUM_I_PIVOTS_GOOD;
  }
  b->weakest = weakest(b);
  return b->weakest > bad_pivot ? BAUM_I_PIVOTS_WEAK : BAUM_I_PIVOTS_BAD;
}

const baum_i_space_factor_kernel BAUM_I_HOT(baum_i_space_factor_kernel) = {.couple = couple,
                                                                           .eliminate = eliminate};
