/* SPDX-License-Identifier: BSD-3-Clause */
/* Arithmetic of the block Schur complement; block.h describes the equations and the storage.
 *
 *   S_nk = sum over shared body blocks of G_n W G_k^T;   for two pins  +- w_0 I + w_1 c_n c_k^T
 *
 * where G_n is the side of node n on the body block, and W = diag(w_0, w_0, w_1). The factorization
 * S = L D L^T is right-looking. Let U = S_ik adj(D), where D is the pivot of node k, and node i is
 * eliminated later. Every update by this pivot is a product with U, times 1 / det D. The processor
 * can therefore divide and multiply at the same time. The right-hand side is eliminated together
 * with the matrix.
 *
 * Refinement corrects both equations, with a as an independent unknown (J. Demmel, 1997, 2.5). This
 * restores the digits that are lost when J W J^T is computed. With t = W (f - M a - J^T lambda) and
 * d from S d = J t - (r - J a):
 *
 *   a += t - W J^T d,   lambda += d */
#include <math.h>
#include <string.h>

#include "base/four.h"
#include "base/hot.h"
#include "linear/block_sides.h"

/* Pivots are bad if the smallest ratio of det D to `size` (baum_i_node) is below this. */
static const double bad_pivot = 1e-10;

/* Largest residual at rounding level, relative to the sum of the magnitudes of its terms. */
static const double rounding = 0x1p-47;

/* ---- effect of the multipliers on the motion ---- */

/* Subtracts W G^T lambda of both sides G of one pin from the motion. arm and weight have 4 numbers
 * each. */
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

/* Subtracts W G^T lambda of all sides G of general nodes from the motion. Also stores lambda of
 * these nodes in `rows`, unless `rows` is NULL. */
BAUM_I_INLINE void scatter_fulls(const baum_i_block *b, double *rows)
{
  const int32_t *body_blocks = b->side_body_block;
  const int32_t *place = b->place;
  const double *weight = b->weight;
  double *motion = b->motion;
  const baum_i_full_node *end = b->fulls + b->full_count;
  for (const baum_i_full_node *full = b->fulls; full < end; full++) {
    baum_i_pair lambda = baum_i_load(b->nodes[full->node].lambda);
    const double *side = b->side + 6 * (ptrdiff_t)full->first_side;
    for (ptrdiff_t s = full->first_side; s < full->first_side + full->side_count; s++, side += 6) {
      baum_i_columns g = baum_i_load_full(side);
      double *x = motion + place[body_blocks[s]];
      const double *w = weight + 2 * (ptrdiff_t)body_blocks[s];
      baum_i_square moving = {{g.c[0], g.c[1]}};
      baum_i_store(x, baum_i_load(x) - w[0] * baum_i_transposed_times(moving, lambda));
      x[2] -= w[1] * baum_i_dot(g.c[2], lambda);
    }
    for (int k = 0; rows && k < 2; k++) {
      if (full->row[k] >= 0) {
        rows[full->row[k]] = lambda[k];
      }
    }
  }
}

/* ---- off-diagonal blocks ---- */

/* Sets the blocks of pairs of pins to w_1 n k^T + sign w_0 I, where n and k are the two arms. */
static inline void set_pairs(const baum_i_block *b, const baum_i_pin_pair *pairs, int count,
                             double sign)
{
  const double *arm = b->arm;
  const double *weight = b->weight;
  double *off = b->off;
  for (int i = 0; i < count; i++) {
    const baum_i_pin_pair *pair = &pairs[i];
    const double *w = weight + 2 * (size_t)pair->body_block;
    baum_i_pair n = baum_i_load(arm + 2 * (size_t)pair->arm[0]);
    baum_i_pair k = baum_i_load(arm + 2 * (size_t)pair->arm[1]);
    baum_i_square s = baum_i_add_diagonal(baum_i_outer_product(n, w[1] * k), sign * w[0]);
    baum_i_store_square(off + 4 * (size_t)pair->off, s);
  }
}

/* Couples a general side and the side +- [ I c ] of a pin. The rows of the result belong to the
 * general side. */
static inline baum_i_square couple_to_pin(const baum_i_block *b, int32_t side, int32_t arm,
                                          const double *w)
{
  baum_i_columns g = baum_i_load_full(b->side + 6 * (ptrdiff_t)side);
  const double *c = b->arm + 2 * (ptrdiff_t)arm;
  double moving = arm % 2 == 0 ? w[0] : -w[0];
  baum_i_pair turning = w[1] * g.c[2];
  return (baum_i_square){{moving * g.c[0] + c[0] * turning, moving * g.c[1] + c[1] * turning}};
}

static inline baum_i_square couple_sides(const baum_i_block *b, const baum_i_full_pair *pair)
{
  const double *w = b->weight + 2 * (ptrdiff_t)pair->body_block;
  int32_t later = pair->side[0];
  int32_t earlier = pair->side[1];
  if (later >= 0 && earlier < 0) {
    return couple_to_pin(b, later, ~earlier, w);
  }
  if (later < 0 && earlier >= 0) {
    return baum_i_transposed(couple_to_pin(b, earlier, ~later, w));
  }
  baum_i_columns n = baum_i_load_side(b, later);
  baum_i_columns k = baum_i_load_side(b, earlier);
  return baum_i_couple_sides(&n, w, &k);
}

static void couple(baum_i_block *b)
{
  for (int i = 0; i < b->zero_count; i++) {
    memset(b->off + 4 * (size_t)b->zeros[i], 0, 4 * sizeof *b->off);
  }
  set_pairs(b, b->alike, b->alike_count, 1.0);
  set_pairs(b, b->opposite, b->opposite_count, -1.0);
  for (int i = 0; i < b->first_count; i++) {
    const baum_i_full_pair *pair = &b->first_pairs[i];
    baum_i_store_square(b->off + 4 * (ptrdiff_t)pair->off, couple_sides(b, pair));
  }
  for (int i = 0; i < b->full_pair_count; i++) {
    const baum_i_full_pair *pair = &b->full_pairs[i];
    double *to = b->off + 4 * (ptrdiff_t)pair->off;
    baum_i_square s = couple_sides(b, pair);
    baum_i_store(to, baum_i_load(to) + s.column[0]);
    baum_i_store(to + 2, baum_i_load(to + 2) + s.column[1]);
  }
}

/* ---- factor and solve ---- */

/* The node that a pivot step eliminates, in registers. Each number of D and of the right-hand side
 * is stored twice. */
typedef struct pivot_step {
  baum_i_pair d[3];    /* D_00, D_01, D_11 */
  baum_i_pair inverse; /* 1 / det D */
  baum_i_pair right[2];
} pivot_step;

/* Returns x adj(D). */
static inline baum_i_square times_adjugate(baum_i_square x, const pivot_step *t)
{
  return (baum_i_square){
    {x.column[0] * t->d[2] - x.column[1] * t->d[1], x.column[1] * t->d[0] - x.column[0] * t->d[1]}};
}

/* Returns D^-1 times the right-hand side. */
static inline baum_i_pair solve_pivot(const pivot_step *t)
{
  baum_i_pair corners = {t->d[2][0], t->d[0][0]};
  baum_i_pair right = {t->right[0][0], t->right[1][0]};
  baum_i_pair other = {t->right[1][0], t->right[0][0]};
  return t->inverse * (corners * right - t->d[1] * other);
}

/* Subtracts the contribution of the coupling at x from `to`, the later of the two coupled nodes.
 * Then replaces the coupling by L^T. Returns the coupling as it was before. */
static inline baum_i_square eliminate_one(const pivot_step *t, double *x, baum_i_node *to)
{
  baum_i_square s = baum_i_load_square(x);
  baum_i_square u = times_adjugate(s, t);
  baum_i_square product = baum_i_times_transposed(u, s);
  baum_i_pair pushed = u.column[0] * t->right[0] + u.column[1] * t->right[1];
  baum_i_square l = baum_i_transposed(u);
  baum_i_store(x, t->inverse * l.column[0]);
  baum_i_store(x + 2, t->inverse * l.column[1]);
  baum_i_store(to->pivot, baum_i_load(to->pivot) - t->inverse * product.column[0]);
  baum_i_store(to->pivot + 2, baum_i_load(to->pivot + 2) - t->inverse * product.column[1]);
  baum_i_store(to->lambda, baum_i_load(to->lambda) - t->inverse * pushed);
  return s;
}

/* Eliminates the `count` couplings of a node, starting at x. For each coupling, `target` lists the
 * blocks that receive its products with the couplings before it. */
static inline void eliminate_many(const pivot_step *t, double *x, const int32_t *later,
                                  ptrdiff_t count, const int32_t *target, baum_i_node *nodes,
                                  double *off)
{
  for (ptrdiff_t f = 0; f < count; f++) {
    baum_i_square s = eliminate_one(t, x + 4 * f, &nodes[later[f]]);
    for (ptrdiff_t e = 0; e < f; e++) {
      /* S_fe -= X_f D^-1 X_e^T = X_f L_e^T */
      baum_i_square product = baum_i_product(s, baum_i_load_square(x + 4 * e));
      double *to = off + 4 * (ptrdiff_t)*target++;
      baum_i_store(to, baum_i_load(to) - product.column[0]);
      baum_i_store(to + 2, baum_i_load(to + 2) - product.column[1]);
    }
  }
}

/* Returns the smallest ratio of det D to the product of the diagonal entries of S at the same node,
 * or NaN if a ratio is NaN. */
static double weakest(const baum_i_block *b)
{
  double least = (double)INFINITY;
  for (int k = 0; k < b->node_count; k++) {
    double ratio = 1.0 / (b->nodes[k].inverse * b->nodes[k].size);
    least = ratio >= least || isnan(least) ? least : ratio;
  }
  return least;
}

static baum_i_pivots eliminate(baum_i_block *b)
{
  /* Copied early, so that the motion is in the cache when substitution needs it. */
  memcpy(b->motion, b->from, (size_t)b->motion_size * sizeof *b->motion);
  const int32_t *start = b->order.start;
  const int32_t *later = b->order.later;
  const int32_t *target = b->target;
  baum_i_node *nodes = b->nodes;
  double *off = b->off;
  double *x = off;
  double weak = b->weak_pivot;
  double margin = (double)INFINITY;
  for (ptrdiff_t k = 0; k < b->node_count; k++) {
    baum_i_node *node = &nodes[k];
    pivot_step t = {
      .d = {baum_i_both(node->pivot[0]), baum_i_both(node->pivot[1]), baum_i_both(node->pivot[3])},
      .right = {baum_i_both(node->lambda[0]), baum_i_both(node->lambda[1])}};
    baum_i_pair det = t.d[0] * t.d[2] - t.d[1] * t.d[1];
    t.inverse = baum_i_both(1.0) / det;
    double over = det[0] - weak * node->size;
    margin = over < margin ? over : margin;
    node->inverse = t.inverse[0];
    baum_i_store(node->lambda, solve_pivot(&t));
    ptrdiff_t count = start[k + 1] - start[k];
    if (count == 1) {
      (void)eliminate_one(&t, x, &nodes[*later]);
      x += 4;
      later++;
    } else if (count > 1) {
      eliminate_many(&t, x, later, count, target, nodes, off);
      x += 4 * count;
      later += count;
      target += count * (count - 1) / 2;
    }
  }
  if (margin > 0.0) {
    return BAUM_I_PIVOTS_GOOD;
  }
  return weakest(b) > bad_pivot ? BAUM_I_PIVOTS_WEAK : BAUM_I_PIVOTS_BAD;
}

/* State of the backward substitution, which uses the couplings from the last to the first. */
typedef struct couplings {
  const int32_t *start; /* index in later[] and off[] of each node's first coupling */
  const int32_t *later;
  const double *off;
  baum_i_node *nodes;
  ptrdiff_t end; /* end of the couplings of the node to be processed next */
} couplings;

/* Subtracts L^T lambda of all later nodes from lambda of node k, and returns the result. */
static inline baum_i_pair backward_one(couplings *c, ptrdiff_t k)
{
  baum_i_pair lambda = baum_i_load(c->nodes[k].lambda);
  ptrdiff_t first = c->start[k];
  for (ptrdiff_t e = first; e < c->end; e++) {
    const double *x = c->off + 4 * e;
    const double *l = c->nodes[c->later[e]].lambda;
    lambda -= l[0] * baum_i_load(x) + l[1] * baum_i_load(x + 2);
  }
  c->end = first;
  baum_i_store(c->nodes[k].lambda, lambda);
  return lambda;
}

/* Substitutes from the last node to the first. Each lambda is applied to the motion immediately,
 * while the processor already computes the next lambda. If `rows` (nc) is not NULL, it receives
 * lambda. */
BAUM_I_INLINE void backward(const baum_i_block *b, double *rows)
{
  couplings c = {.start = b->order.start,
                 .later = b->order.later,
                 .off = b->off,
                 .nodes = b->nodes,
                 .end = b->off_count};
  const double *arm = b->arm + 4 * (ptrdiff_t)b->pin_count;
  const double *weight = b->pin_weight + 4 * (ptrdiff_t)b->pin_count;
  double *motion = b->motion;
  ptrdiff_t k = b->node_count - 1;
  /* Pins are stored in the order of nodes. */
  for (const baum_i_pin_node *pin = b->pins + b->pin_count; pin-- > b->pins;) {
    for (ptrdiff_t next = pin->node; k > next; k--) {
      (void)backward_one(&c, k);
    }
    baum_i_pair lambda = backward_one(&c, k--);
    if (rows) {
      baum_i_store(rows + pin->row, lambda);
    }
    arm -= 4;
    weight -= 4;
    scatter_pin(pin, arm, weight, lambda, motion);
  }
  for (; k >= 0; k--) {
    (void)backward_one(&c, k);
  }
  scatter_fulls(b, rows);
}

/* Replaces lambda by D^-1 L^-1 lambda, with the present factors. */
static void forward(const baum_i_block *b)
{
  baum_i_node *nodes = b->nodes;
  for (size_t k = 0; k < (size_t)b->node_count; k++) {
    const double *d = nodes[k].pivot;
    const double *r = nodes[k].lambda;
    baum_i_pair right = baum_i_load(r);
    for (int32_t e = b->order.start[k]; e < b->order.start[k + 1]; e++) {
      double *l = nodes[b->order.later[e]].lambda;
      baum_i_square x = baum_i_transposed(baum_i_load_square(b->off + 4 * (size_t)e));
      baum_i_store(l, baum_i_load(l) - baum_i_times(x, right));
    }
    const pivot_step t = {.d = {baum_i_both(d[0]), baum_i_both(d[1]), baum_i_both(d[3])},
                          .inverse = baum_i_both(nodes[k].inverse),
                          .right = {baum_i_both(r[0]), baum_i_both(r[1])}};
    baum_i_store(nodes[k].lambda, solve_pivot(&t));
  }
}

static void substitute(baum_i_block *b, double *lambda)
{
  backward(b, lambda);
}

/* ---- residual and refinement ---- */

/* The terms of J x at two pins for a motion x. In the functions below, `second` is the index of the
 * second pin relative to the first, or 0 if there is only one pin. */
typedef struct terms {
  baum_i_four term[4];
} terms;

BAUM_I_INLINE terms terms_of(const double *motion, const baum_i_pin_node *pin, const double *arm,
                             ptrdiff_t second)
{
  const double *x = motion + pin[0].place[0];
  const double *y = motion + pin[0].place[1];
  const double *z = motion + pin[second].place[0];
  const double *u = motion + pin[second].place[1];
  const double *other = arm + 4 * second;
  return (terms){
    {baum_i_four_gathered(x, z),
     baum_i_four_minus(baum_i_four_all(0.0), baum_i_four_gathered(y, u)),
     baum_i_four_times(baum_i_four_spread(x + 2, z + 2), baum_i_four_gathered(arm, other)),
     baum_i_four_times(baum_i_four_spread(y + 2, u + 2),
                       baum_i_four_gathered(arm + 2, other + 2))}};
}

/* Returns by how much the residuals of two pins exceed rounding level. */
BAUM_I_INLINE baum_i_four excess_of(const baum_i_block *b, const double *beside,
                                    const baum_i_pin_node *pin, const double *arm, ptrdiff_t second)
{
  baum_i_four right = baum_i_four_gathered(b->right + 2 * (ptrdiff_t)pin[0].node,
                                           b->right + 2 * (ptrdiff_t)pin[second].node);
  baum_i_four rest = right;
  baum_i_four size = baum_i_four_magnitude(right);
  terms own = terms_of(b->motion, pin, arm, second);
  terms more = beside ? terms_of(beside, pin, arm, second) : own;
  for (int k = 0; k < 4; k++) {
    rest = baum_i_four_minus(rest, own.term[k]);
    size = baum_i_four_plus(size, baum_i_four_magnitude(own.term[k]));
    size = beside ? baum_i_four_plus(size, baum_i_four_magnitude(more.term[k])) : size;
  }
  return baum_i_four_minus(baum_i_four_magnitude(rest),
                           baum_i_four_times(baum_i_four_all(rounding), size));
}

BAUM_I_INLINE bool check_pins(const baum_i_block *b, const double *beside)
{
  baum_i_four worst = baum_i_four_all(0.0);
  const baum_i_pin_node *pin = b->pins;
  const double *arm = b->arm;
  for (int left = b->pin_count; left > 1; left -= 2, pin += 2, arm += 8) {
    worst = baum_i_four_larger(excess_of(b, beside, pin, arm, 1), worst);
  }
  if (b->pin_count % 2 != 0) {
    worst = baum_i_four_larger(excess_of(b, beside, pin, arm, 0), worst);
  }
  baum_i_pair most = baum_i_larger(baum_i_four_low(worst), baum_i_four_high(worst));
  return most[0] <= 0.0 && most[1] <= 0.0;
}

static bool check_full(const baum_i_block *b, const double *beside, const baum_i_full_node *full)
{
  baum_i_pair rest = baum_i_load(b->right + 2 * (size_t)full->node);
  baum_i_pair size = baum_i_magnitude(rest);
  for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
    baum_i_columns g = baum_i_load_full(b->side + 6 * (size_t)s);
    int32_t place = b->place[b->side_body_block[s]];
    const double *x = b->motion + place;
    for (int c = 0; c < 3; c++) {
      rest -= x[c] * g.c[c];
      size += baum_i_magnitude(x[c] * g.c[c]);
      size += beside ? baum_i_magnitude(beside[place + c] * g.c[c]) : baum_i_both(0.0);
    }
  }
  return fabs(rest[0]) <= rounding * size[0] && fabs(rest[1]) <= rounding * size[1];
}

static bool check(const baum_i_block *b, const double *beside)
{
  bool fine = beside ? check_pins(b, beside) : check_pins(b, NULL);
  for (int i = 0; i < b->full_count && fine; i++) {
    fine = check_full(b, beside, &b->fulls[i]);
  }
  return fine;
}

/* Sets lambda to J pull - rest at all nodes. */
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
      const double *x = b->pull + b->place[b->side_body_block[s]];
      sum += x[0] * g.c[0] + x[1] * g.c[1] + x[2] * g.c[2];
    }
    baum_i_store(b->nodes[full->node].lambda, sum);
  }
}

/* The nodes contain the computed change of lambda. Adds the previous lambda, `before`, to it.
 * Returns the largest change divided by the largest multiplier. */
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

/* Solves L^T a = y for a dense body. */
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

static void read_lambda(const baum_i_block *b, double *lambda)
{
  const baum_i_node *nodes = b->nodes;
  for (int i = 0; i < b->pin_count; i++) {
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

/* Copies numbers and tells whether all are finite: the sum of 0 x_i is 0, or NaN if a number is not
 * finite. Two partial sums hide the latency of addition. */
static bool copy_finite(const double *x, ptrdiff_t count, double *to)
{
  baum_i_pair sum[2] = {{0.0, 0.0}, {0.0, 0.0}};
  ptrdiff_t i = 0;
  for (; i + 4 <= count; i += 4) {
    baum_i_pair first = baum_i_load(x + i);
    baum_i_pair second = baum_i_load(x + i + 2);
    baum_i_store(to + i, first);
    baum_i_store(to + i + 2, second);
    sum[0] += 0.0 * first;
    sum[1] += 0.0 * second;
  }
  for (; i < count; i++) {
    to[i] = x[i];
    sum[0][0] += 0.0 * x[i];
  }
  sum[0] += sum[1];
  return sum[0][0] + sum[0][1] == 0.0;
}

static bool read_motion(const baum_i_block *b, double *a)
{
  bool finite = copy_finite(b->motion, b->structure->nv, a);
  for (int i = 0; i < b->dense_count; i++) {
    const baum_i_mass_block *body = &b->structure->mass_blocks[b->dense[i].mass_block];
    read_dense(b, &b->dense[i], a);
    finite = finite && copy_finite(a + body->first, body->size, a + body->first);
  }
  return finite;
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
