/* SPDX-License-Identifier: BSD-3-Clause */
/* Arithmetic of the Schur complement in blocks: see block.h for the equations and the storage.
 *
 *   S_nk = sum over shared triples of G_n W G_k^T;   for two pins  +- w_0 I + w_2 c_n c_k^T
 *
 * Right-looking L D L^T. With U = S_ik adj(D), all that a pivot gives to others is a product with
 * U times 1 / det D, so that the division runs beside the products; the right side goes along.
 *
 * Refinement is of both equations with a as an unknown of its own (J. Demmel, 1997, 2.5: what was lost
 * in squaring comes back). With t = W (f - M a - J^T lambda) and S d = J t - (r - J a):
 *
 *   a += t - W J^T d,   lambda += d
 */
#include <math.h>
#include <string.h>

#include "base/hot.h"
#include "linear/block_sides.h"

/* det D against the product of the diagonal that S had. The multipliers lose about the unit rounding
 * over this, and several small pivots multiply: below the first the result is refined, below the second
 * this solver has nothing to say. In long ladders healthy pivots fall with the number of nodes, and all
 * of them share what one of few would cost. */
static const double weak_pivot = 1e-3;
static const double many_nodes = 128.0;
static const double bad_pivot = 1e-10;

/* A residual of this many units of its own size is rounding. */
static const double rounding = 0x1p-47;

/* ---- what multipliers do to the motion ---- */

/* motion -= W G^T lambda for the sides of one pin, of which arm and weight are (4). */
static inline void scatter_pin(const baum_i_pin_node *pin, const double *arm, const double *weight,
                               baum_i_pair lambda, double *motion)
{
  double *x = motion + pin->place[0];
  double *y = motion + pin->place[1];
  baum_i_store(x, baum_i_load(x) - weight[0] * lambda);
  x[2] -= weight[1] * baum_i_dot(baum_i_load(arm), lambda);
  baum_i_store(y, baum_i_load(y) + weight[2] * lambda);
  y[2] -= weight[3] * baum_i_dot(baum_i_load(arm + 2), lambda);
}

static void scatter_full(const baum_i_block *b, const baum_i_full_node *full)
{
  baum_i_pair lambda = baum_i_load(b->nodes[full->node].lambda);
  for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
    baum_i_columns g = baum_i_load_full(b->side + 6 * (size_t)s);
    double *x = b->motion + b->place[b->side_triple[s]];
    const double *w = b->weight + 2 * (size_t)b->side_triple[s];
    x[0] -= w[0] * baum_i_dot(g.c[0], lambda);
    x[1] -= w[0] * baum_i_dot(g.c[1], lambda);
    x[2] -= w[1] * baum_i_dot(g.c[2], lambda);
  }
}

/* ---- off the diagonal ---- */

/* w_2 n k^T, with + or - w_0 on the diagonal. */
static inline void set_pairs(const baum_i_block *b, const baum_i_pin_pair *pairs, int count,
                             double sign)
{
  const double *arm = b->arm;
  const double *weight = b->weight;
  double *off = b->off;
  for (int i = 0; i < count; i++) {
    const baum_i_pin_pair *pair = &pairs[i];
    const double *w = weight + 2 * (size_t)pair->triple;
    baum_i_pair n = baum_i_load(arm + 2 * (size_t)pair->arm[0]);
    baum_i_pair k = baum_i_load(arm + 2 * (size_t)pair->arm[1]);
    baum_i_square s = baum_i_add_diagonal(baum_i_outer(n, w[1] * k), sign * w[0]);
    baum_i_store_square(off + 4 * (size_t)pair->off, s);
  }
}

static inline baum_i_square couple_sides(const baum_i_block *b, const baum_i_full_pair *pair,
                                         baum_i_square s)
{
  baum_i_columns n = baum_i_load_side(b, pair->side[0]);
  baum_i_columns k = baum_i_load_side(b, pair->side[1]);
  return baum_i_add_sides(s, &n, b->weight + 2 * (size_t)pair->triple, &k);
}

static void couple(baum_i_block *b)
{
  for (int i = 0; i < b->zero_count; i++) {
    memset(b->off + 4 * (size_t)b->zeros[i], 0, 4 * sizeof *b->off);
  }
  set_pairs(b, b->alike, b->alike_count, 1.0);
  set_pairs(b, b->opposite, b->opposite_count, -1.0);
  const baum_i_square none = {{{0.0, 0.0}, {0.0, 0.0}}};
  for (int i = 0; i < b->first_count; i++) {
    const baum_i_full_pair *pair = &b->first_pairs[i];
    baum_i_store_square(b->off + 4 * (size_t)pair->off, couple_sides(b, pair, none));
  }
  for (int i = 0; i < b->full_pair_count; i++) {
    double *s = b->off + 4 * (size_t)b->full_pairs[i].off;
    baum_i_store_square(s, couple_sides(b, &b->full_pairs[i], baum_i_load_square(s)));
  }
}

/* ---- factor and solve ---- */

/* X adj(D) of the symmetric D. */
static inline baum_i_square times_adjugate(baum_i_square x, const double d[4])
{
  return (baum_i_square){
    {x.column[0] * d[3] - x.column[1] * d[1], x.column[1] * d[0] - x.column[0] * d[1]}};
}

/* adj(D) r / det D */
static inline baum_i_pair solve_pivot(const baum_i_node *node, baum_i_pair r)
{
  const double *d = node->pivot;
  return node->inverse * (baum_i_pair){d[3] * r[0] - d[1] * r[1], d[0] * r[1] - d[1] * r[0]};
}

/* What coupling x of `from` (rows of the later node `to`) gives to that node. Returns L. */
static inline baum_i_square eliminate_one(const baum_i_node *from, baum_i_square x, double inverse,
                                          baum_i_pair right, baum_i_node *to)
{
  baum_i_square u = times_adjugate(x, from->pivot);
  baum_i_square product = baum_i_times_transposed(u, x);
  baum_i_pair pushed = baum_i_times(u, right);
  baum_i_store(to->pivot, baum_i_load(to->pivot) - inverse * product.column[0]);
  baum_i_store(to->pivot + 2, baum_i_load(to->pivot + 2) - inverse * product.column[1]);
  baum_i_store(to->lambda, baum_i_load(to->lambda) - inverse * pushed);
  return (baum_i_square){{inverse * u.column[0], inverse * u.column[1]}};
}

/* The blocks that couplings of one node give to: what the f-th gives with those before it. */
typedef struct couplings {
  double *x; /* the first of the node's own blocks */
  const int32_t *later;
  int32_t count;
  const int32_t *target;
} couplings;

/* All couplings of a node that has several. */
static inline void eliminate_many(const couplings *c, const baum_i_node *from, double inverse,
                                  baum_i_pair right, baum_i_node *nodes, double *off)
{
  const int32_t *target = c->target;
  for (int32_t f = 0; f < c->count; f++) {
    baum_i_square x = baum_i_load_square(c->x + 4 * (ptrdiff_t)f);
    baum_i_square l = eliminate_one(from, x, inverse, right, &nodes[c->later[f]]);
    baum_i_store_square(c->x + 4 * (ptrdiff_t)f, l);
    for (int32_t e = 0; e < f; e++) {
      /* S_fe -= X_f D^-1 X_e^T = X_f L_e^T */
      baum_i_square product =
        baum_i_times_transposed(x, baum_i_load_square(c->x + 4 * (ptrdiff_t)e));
      double *s = off + 4 * (ptrdiff_t)*target++;
      baum_i_store(s, baum_i_load(s) - product.column[0]);
      baum_i_store(s + 2, baum_i_load(s + 2) - product.column[1]);
    }
  }
}

/* The smallest det D against the product of the diagonal that S had. */
static double weakest(const baum_i_block *b)
{
  double least = INFINITY;
  for (int k = 0; k < b->node_count; k++) {
    double ratio = 1.0 / (b->nodes[k].inverse * b->nodes[k].size);
    least = ratio < least ? ratio : least;
  }
  return least;
}

static baum_i_pivots eliminate(baum_i_block *b)
{
  const int32_t *start = b->order.start;
  const int32_t *later = b->order.later;
  baum_i_node *nodes = b->nodes;
  double *off = b->off;
  double margin = INFINITY;
  double few = fmin(1.0, many_nodes / b->node_count);
  double weak = weak_pivot * few * sqrt(few);
  for (ptrdiff_t k = 0; k < b->node_count; k++) {
    baum_i_node *node = &nodes[k];
    const double *d = node->pivot;
    double det = d[0] * d[3] - d[1] * d[1];
    double inverse = 1.0 / det;
    double over = det - weak * node->size;
    margin = over < margin ? over : margin;
    baum_i_pair right = baum_i_load(node->lambda);
    ptrdiff_t first = start[k];
    couplings c = {.x = off + 4 * first, .later = later + first, .count = start[k + 1] - start[k]};
    if (c.count == 1) {
      baum_i_store_square(
        c.x, eliminate_one(node, baum_i_load_square(c.x), inverse, right, &nodes[c.later[0]]));
    } else if (c.count > 1) {
      c.target = b->target + b->target_start[k];
      eliminate_many(&c, node, inverse, right, nodes, off);
    }
    node->inverse = inverse;
    baum_i_store(node->lambda, solve_pivot(node, right));
  }
  if (margin > 0.0) {
    return BAUM_I_PIVOTS_GOOD;
  }
  return weakest(b) > bad_pivot ? BAUM_I_PIVOTS_WEAK : BAUM_I_PIVOTS_BAD;
}

/* From the last node to the first: lambda_k -= sum of L^T lambda_later, and what it does to the motion,
 * which fills the time that the next lambda waits for this one. rows (nc), where lambda of pins is wanted,
 * or NULL. */
static inline void backward(const baum_i_block *b, double *rows)
{
  const int32_t *start = b->order.start;
  const int32_t *later = b->order.later;
  const double *off = b->off;
  const double *arms = b->arm;
  const double *weights = b->pin_weight;
  const baum_i_pin_node *pins = b->pins;
  double *motion = b->motion;
  baum_i_node *nodes = b->nodes;
  int32_t end = start[b->node_count];
  ptrdiff_t pin = b->pin_count - 1;
  for (ptrdiff_t k = b->node_count - 1; k >= 0; k--) {
    baum_i_pair lambda = baum_i_load(nodes[k].lambda);
    int32_t first = start[k];
    const double *x = off + 4 * (size_t)first;
    for (int32_t e = first; e < end; e++, x += 4) {
      baum_i_pair l = baum_i_load(nodes[later[e]].lambda);
      baum_i_pair p = baum_i_load(x) * l;
      baum_i_pair q = baum_i_load(x + 2) * l;
      lambda -= (baum_i_pair){p[0], q[0]} + (baum_i_pair){p[1], q[1]};
    }
    baum_i_store(nodes[k].lambda, lambda);
    end = first;
    /* Pins stand in the order of nodes. */
    if (pin >= 0 && pins[pin].node == k) {
      if (rows) {
        baum_i_store(rows + pins[pin].row, lambda);
      }
      scatter_pin(&pins[pin], arms + 4 * pin, weights + 4 * pin, lambda, motion);
      pin--;
    }
  }
  for (int i = 0; i < b->full_count; i++) {
    scatter_full(b, &b->fulls[i]);
  }
}

/* lambda = D^-1 L^-1 lambda with a factorization that is there. */
static void forward(const baum_i_block *b)
{
  baum_i_node *nodes = b->nodes;
  for (size_t k = 0; k < (size_t)b->node_count; k++) {
    baum_i_pair right = baum_i_load(nodes[k].lambda);
    for (int32_t e = b->order.start[k]; e < b->order.start[k + 1]; e++) {
      double *l = nodes[b->order.later[e]].lambda;
      baum_i_square x = baum_i_load_square(b->off + 4 * (size_t)e);
      baum_i_store(l, baum_i_load(l) - baum_i_times(x, right));
    }
    baum_i_store(nodes[k].lambda, solve_pivot(&nodes[k], right));
  }
}

static void substitute(baum_i_block *b, double *lambda)
{
  memcpy(b->motion, b->from, (size_t)b->motion_size * sizeof *b->motion);
  backward(b, lambda);
}

/* ---- residual and refinement ---- */

static inline baum_i_pair magnitude(baum_i_pair x)
{
  return (baum_i_pair){fabs(x[0]), fabs(x[1])};
}

static bool check_pins(const baum_i_block *b)
{
  double worst = 0.0;
  const double *arm = b->arm;
  const double *motion = b->motion;
  const double *rights = b->right;
  for (int i = 0; i < b->pin_count; i++, arm += 4) {
    const baum_i_pin_node *pin = &b->pins[i];
    const double *x = motion + pin->place[0];
    const double *y = motion + pin->place[1];
    baum_i_pair right = baum_i_load(rights + 2 * (size_t)pin->node);
    baum_i_pair move_x = baum_i_load(x);
    baum_i_pair move_y = baum_i_load(y);
    baum_i_pair turn_x = x[2] * baum_i_load(arm);
    baum_i_pair turn_y = y[2] * baum_i_load(arm + 2);
    baum_i_pair rest = magnitude(right - (move_x - move_y + turn_x + turn_y));
    baum_i_pair size = magnitude(right) + magnitude(move_x) + magnitude(move_y) +
                       magnitude(turn_x) + magnitude(turn_y);
    baum_i_pair excess = rest - rounding * size;
    worst = excess[0] > worst ? excess[0] : worst;
    worst = excess[1] > worst ? excess[1] : worst;
  }
  return worst <= 0.0;
}

static bool check_full(const baum_i_block *b, const baum_i_full_node *full)
{
  baum_i_pair rest = baum_i_load(b->right + 2 * (size_t)full->node);
  baum_i_pair size = magnitude(rest);
  for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
    baum_i_columns g = baum_i_load_full(b->side + 6 * (size_t)s);
    const double *x = b->motion + b->place[b->side_triple[s]];
    for (int c = 0; c < 3; c++) {
      rest -= x[c] * g.c[c];
      size += magnitude(x[c] * g.c[c]);
    }
  }
  return fabs(rest[0]) <= rounding * size[0] && fabs(rest[1]) <= rounding * size[1];
}

static bool check(const baum_i_block *b)
{
  bool fine = check_pins(b);
  for (int i = 0; i < b->full_count && fine; i++) {
    fine = check_full(b, &b->fulls[i]);
  }
  return fine;
}

/* lambda = J pull - rest of all nodes. */
static void gather(const baum_i_block *b)
{
  for (int i = 0; i < b->pin_count; i++) {
    const baum_i_pin_node *pin = &b->pins[i];
    const double *c = b->arm + 4 * (size_t)i;
    const double *x = b->pull + pin->place[0];
    const double *y = b->pull + pin->place[1];
    baum_i_pair sum = baum_i_load(x) - baum_i_load(y) + x[2] * baum_i_load(c) +
                      y[2] * baum_i_load(c + 2) - baum_i_load(b->rest + 2 * (size_t)pin->node);
    baum_i_store(b->nodes[pin->node].lambda, sum);
  }
  for (int i = 0; i < b->full_count; i++) {
    const baum_i_full_node *full = &b->fulls[i];
    baum_i_pair sum = -baum_i_load(b->rest + 2 * (size_t)full->node);
    for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
      baum_i_columns g = baum_i_load_full(b->side + 6 * (size_t)s);
      const double *x = b->pull + b->place[b->side_triple[s]];
      sum += x[0] * g.c[0] + x[1] * g.c[1] + x[2] * g.c[2];
    }
    baum_i_store(b->nodes[full->node].lambda, sum);
  }
}

/* lambda of all nodes plus what was put aside; the largest change against the largest multiplier. */
static double add_change(const baum_i_block *b, const double *before)
{
  double change = 0.0;
  double size = 0.0;
  for (size_t i = 0; i < 2 * (size_t)b->node_count; i++) {
    double *l = &b->nodes[i / 2].lambda[i % 2];
    change = fmax(change, fabs(*l));
    *l += before[i];
    size = fmax(size, fabs(*l));
  }
  return size > 0.0 ? change / size : 0.0;
}

static double correct(baum_i_block *b)
{
  double *before = b->rest_low;
  for (size_t i = 0; i < 2 * (size_t)b->node_count; i++) {
    before[i] = b->nodes[i / 2].lambda[i % 2];
  }
  gather(b);
  forward(b);
  for (int i = 0; i < b->motion_size; i++) {
    b->motion[i] += b->pull[i];
  }
  backward(b, NULL);
  return add_change(b, before);
}

/* ---- results ---- */

/* L^T a = y */
static void read_dense(const baum_i_block *b, const baum_i_dense_body *dense, double *a)
{
  const baum_i_mass_block *body = &b->structure->mass_blocks[dense->mass_block];
  const double *l = b->factor + dense->factor;
  int n = body->size;
  for (int i = n - 1; i >= 0; i--) {
    double sum = b->motion[dense->place + i];
    for (int k = i + 1; k < n; k++) {
      sum -= l[k * n + i] * a[body->first + k];
    }
    a[body->first + i] = sum / l[i * n + i];
  }
}

static void read_lambda(const baum_i_block *b, bool pins, double *lambda)
{
  const baum_i_node *nodes = b->nodes;
  for (int i = 0; pins && i < b->pin_count; i++) {
    baum_i_store(lambda + b->pins[i].row, baum_i_load(nodes[b->pins[i].node].lambda));
  }
  for (int i = 0; i < b->full_count; i++) {
    const baum_i_full_node *full = &b->fulls[i];
    for (int k = 0; k < 2; k++) {
      if (full->row[k] >= 0) {
        lambda[full->row[k]] = nodes[full->node].lambda[k];
      }
    }
  }
}

/* A sum of zeros is zero, or NaN where a number is not finite; so many sums that none waits for itself. */
static bool is_finite(const double *x, int count)
{
  enum { LANES = 8 };
  double sum[LANES] = {0.0};
  int i = 0;
  for (; i + LANES <= count; i += LANES) {
    for (int k = 0; k < LANES; k++) {
      sum[k] += 0.0 * x[i + k];
    }
  }
  for (int k = 0; i + k < count; k++) {
    sum[k] += 0.0 * x[i + k];
  }
  double all = 0.0;
  for (int k = 0; k < LANES; k++) {
    all += sum[k];
  }
  return all == 0.0;
}

static bool read_motion(const baum_i_block *b, double *a)
{
  memcpy(a, b->motion, (size_t)b->structure->nv * sizeof *a);
  for (int i = 0; i < b->dense_count; i++) {
    read_dense(b, &b->dense[i], a);
  }
  return is_finite(a, b->structure->nv);
}

const baum_i_block_kernel BAUM_I_HOT(baum_i_block_kernel) = {
  .couple = couple,
  .eliminate = eliminate,
  .substitute = substitute,
  .check = check,
  .correct = correct,
  .read_motion = read_motion,
  .read_lambda = read_lambda,
};
