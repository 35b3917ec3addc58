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
#include "linear/block.h"

/* det D against the product of the diagonal that S had: below the first the residual is looked at,
 * below the second this solver has nothing to say. */
static const double weak_pivot = 1e-3;
static const double bad_pivot = 1e-10;

/* A residual of this many units of its own size is rounding. */
static const double rounding = 0x1p-47;

/* ---- sides ---- */

/* A side in full, of a node's side number as in baum_i_full_pair. */
typedef struct full_side {
  double x[6];
} full_side;

static inline full_side load_side(const baum_i_block *b, int32_t number)
{
  full_side g;
  if (number >= 0) {
    memcpy(g.x, b->side + 6 * (size_t)number, sizeof g.x);
    return g;
  }
  int32_t arm = ~number;
  double sign = arm % 2 == 0 ? 1.0 : -1.0;
  const double *c = b->arm + 2 * (size_t)arm;
  g = (full_side){{sign, 0.0, c[0], 0.0, sign, c[1]}};
  return g;
}

/* out -= W G^T l for all sides. */
static void scatter(const baum_i_block *b, const double *l, double *out)
{
  for (int i = 0; i < b->pin_count; i++) {
    const baum_i_pin_node *pin = &b->pins[i];
    const double *c = b->arm + 4 * (size_t)i;
    double l0 = l[2 * (size_t)pin->node];
    double l1 = l[2 * (size_t)pin->node + 1];
    double *xa = out + 4 * (size_t)pin->triple[0];
    double *xb = out + 4 * (size_t)pin->triple[1];
    const double *wa = b->weight + 4 * (size_t)pin->triple[0];
    const double *wb = b->weight + 4 * (size_t)pin->triple[1];
    xa[0] -= wa[0] * l0;
    xa[1] -= wa[0] * l1;
    xa[2] -= wa[2] * (c[0] * l0 + c[1] * l1);
    xb[0] += wb[0] * l0;
    xb[1] += wb[0] * l1;
    xb[2] -= wb[2] * (c[2] * l0 + c[3] * l1);
  }
  for (int i = 0; i < b->full_count; i++) {
    const baum_i_full_node *full = &b->fulls[i];
    double l0 = l[2 * (size_t)full->node];
    double l1 = l[2 * (size_t)full->node + 1];
    for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
      const double *g = b->side + 6 * (size_t)s;
      const double *w = b->weight + 4 * (size_t)b->side_triple[s];
      double *x = out + 4 * (size_t)b->side_triple[s];
      for (int c = 0; c < 3; c++) {
        x[c] -= w[c] * (g[c] * l0 + g[3 + c] * l1);
      }
    }
  }
}

/* G x of one full node added to sum. */
static inline void gather_full(const baum_i_block *b, const baum_i_full_node *full, const double *x,
                               double sum[2])
{
  for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
    const double *g = b->side + 6 * (size_t)s;
    const double *y = x + 4 * (size_t)b->side_triple[s];
    sum[0] += g[0] * y[0] + g[1] * y[1] + g[2] * y[2];
    sum[1] += g[3] * y[0] + g[4] * y[1] + g[5] * y[2];
  }
}

/* out = G x - out for all nodes. */
static void gather(const baum_i_block *b, const double *x, double *out)
{
  for (int i = 0; i < b->pin_count; i++) {
    const baum_i_pin_node *pin = &b->pins[i];
    const double *c = b->arm + 4 * (size_t)i;
    const double *xa = x + 4 * (size_t)pin->triple[0];
    const double *xb = x + 4 * (size_t)pin->triple[1];
    double *to = out + 2 * (size_t)pin->node;
    to[0] = xa[0] - xb[0] + c[0] * xa[2] + c[2] * xb[2] - to[0];
    to[1] = xa[1] - xb[1] + c[1] * xa[2] + c[3] * xb[2] - to[1];
  }
  for (int i = 0; i < b->full_count; i++) {
    const baum_i_full_node *full = &b->fulls[i];
    double *to = out + 2 * (size_t)full->node;
    double sum[2] = {-to[0], -to[1]};
    gather_full(b, full, x, sum);
    to[0] = sum[0];
    to[1] = sum[1];
  }
}

/* ---- full nodes ---- */

/* Row by row, L y = G^T for a body with M = L L^T, over its triples. */
static void whiten(baum_i_block *b)
{
  for (int i = 0; i < b->dense_side_count; i++) {
    const baum_i_dense_side *d = &b->dense_sides[i];
    const baum_i_dense_body *body = &b->dense[d->body];
    int n = b->structure->mass_blocks[body->mass_block].size;
    const double *l = b->factor + body->factor;
    for (int r = 0; r < 2; r++) {
      double *g = b->side + 6 * (size_t)d->side + 3 * r;
      for (int j = 0; j < n; j++) {
        double sum = g[6 * (j / 3) + j % 3];
        for (int k = 0; k < j; k++) {
          sum -= l[j * n + k] * g[6 * (k / 3) + k % 3];
        }
        g[6 * (j / 3) + j % 3] = sum / l[j * n + j];
      }
    }
  }
}

static void set_full(baum_i_block *b, const double *jacobian)
{
  for (int i = 0; i < b->entry_count; i++) {
    b->side[b->entries[i].to] = jacobian[b->entries[i].from];
  }
  whiten(b);
  for (int i = 0; i < b->full_count; i++) {
    const baum_i_full_node *full = &b->fulls[i];
    double d0 = full->row[0] < 0 ? 1.0 : 0.0;
    double d1 = 0.0;
    double d2 = full->row[1] < 0 ? 1.0 : 0.0;
    for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
      const double *g = b->side + 6 * (size_t)s;
      const double *w = b->weight + 4 * (size_t)b->side_triple[s];
      for (int c = 0; c < 3; c++) {
        d0 += w[c] * g[c] * g[c];
        d1 += w[c] * g[c] * g[3 + c];
        d2 += w[c] * g[3 + c] * g[3 + c];
      }
    }
    double *pivot = b->pivot + 3 * (size_t)full->node;
    pivot[0] = d0;
    pivot[1] = d1;
    pivot[2] = d2;
    b->size[full->node] = d0 * d2;
    double sum[2] = {-b->right[2 * (size_t)full->node], -b->right[2 * (size_t)full->node + 1]};
    gather_full(b, full, b->free, sum);
    b->lambda[2 * (size_t)full->node] = sum[0];
    b->lambda[2 * (size_t)full->node + 1] = sum[1];
  }
}

/* ---- off the diagonal ---- */

static inline void set_pairs(const baum_i_block *b, const baum_i_pin_pair *pairs, int count,
                             double sign)
{
  for (int i = 0; i < count; i++) {
    const double *n = b->arm + 2 * (size_t)pairs[i].arm[0];
    const double *k = b->arm + 2 * (size_t)pairs[i].arm[1];
    const double *w = b->weight + 4 * (size_t)pairs[i].triple;
    double *s = b->off + 4 * (size_t)pairs[i].off;
    double k0 = w[2] * k[0];
    double k1 = w[2] * k[1];
    s[0] = sign * w[0] + n[0] * k0;
    s[1] = n[0] * k1;
    s[2] = n[1] * k0;
    s[3] = sign * w[0] + n[1] * k1;
  }
}

static void couple(baum_i_block *b)
{
  for (int i = 0; i < b->zero_count; i++) {
    memset(b->off + 4 * (size_t)b->zeros[i], 0, 4 * sizeof *b->off);
  }
  set_pairs(b, b->alike, b->alike_count, 1.0);
  set_pairs(b, b->opposite, b->opposite_count, -1.0);
  for (int i = 0; i < b->full_pair_count; i++) {
    const baum_i_full_pair *pair = &b->full_pairs[i];
    full_side n = load_side(b, pair->side[0]);
    full_side k = load_side(b, pair->side[1]);
    const double *w = b->weight + 4 * (size_t)pair->triple;
    double *s = b->off + 4 * (size_t)pair->off;
    for (int c = 0; c < 3; c++) {
      double k0 = w[c] * k.x[c];
      double k1 = w[c] * k.x[3 + c];
      s[0] += n.x[c] * k0;
      s[1] += n.x[c] * k1;
      s[2] += n.x[3 + c] * k0;
      s[3] += n.x[3 + c] * k1;
    }
  }
}

/* ---- factor and solve ---- */

/* A pivot's inverse before the division. */
typedef struct adjugate {
  double x[3]; /* of the symmetric 2 x 2 */
  double inverse;
} adjugate;

/* What coupling `x` (rows of a later node) gives to that node; x becomes L, u is U / det. */
static inline void eliminate_one(double *x, const adjugate *p, const double right[2], double *pivot,
                                 double *lambda, double u[4])
{
  double u00 = x[0] * p->x[0] + x[1] * p->x[1];
  double u01 = x[0] * p->x[1] + x[1] * p->x[2];
  double u10 = x[2] * p->x[0] + x[3] * p->x[1];
  double u11 = x[2] * p->x[1] + x[3] * p->x[2];
  double inverse = p->inverse;
  pivot[0] -= inverse * (u00 * x[0] + u01 * x[1]);
  pivot[1] -= inverse * (u00 * x[2] + u01 * x[3]);
  pivot[2] -= inverse * (u10 * x[2] + u11 * x[3]);
  lambda[0] -= inverse * (u00 * right[0] + u01 * right[1]);
  lambda[1] -= inverse * (u10 * right[0] + u11 * right[1]);
  u[0] = u00 * inverse;
  u[1] = u01 * inverse;
  u[2] = u10 * inverse;
  u[3] = u11 * inverse;
}

/* S_fe -= L_f X_e^T */
static inline void update(double *s, const double *l, const double *x)
{
  s[0] -= l[0] * x[0] + l[1] * x[1];
  s[1] -= l[0] * x[2] + l[1] * x[3];
  s[2] -= l[2] * x[0] + l[3] * x[1];
  s[3] -= l[2] * x[2] + l[3] * x[3];
}

/* All couplings of the node at place k, of which there are more than one. */
static void eliminate_many(baum_i_block *b, int32_t k, const adjugate *p, const double right[2])
{
  int32_t first = b->order.start[k];
  int32_t count = b->order.start[k + 1] - first;
  const int32_t *later = b->order.later + first;
  const int32_t *target = b->target + b->target_start[k];
  double *x = b->off + 4 * (size_t)first;
  double *before = b->work;
  for (int32_t f = 0; f < count; f++, x += 4) {
    memcpy(before + 4 * (size_t)f, x, 4 * sizeof *x);
    double l[4];
    eliminate_one(x, p, right, b->pivot + 3 * (size_t)later[f], b->lambda + 2 * (size_t)later[f],
                  l);
    for (int32_t e = 0; e < f; e++) {
      update(b->off + 4 * (size_t)*target++, l, before + 4 * (size_t)e);
    }
    memcpy(x, l, sizeof l);
  }
}

static baum_i_pivots eliminate(baum_i_block *b)
{
  double least_weak = INFINITY;
  double least_bad = INFINITY;
  for (int32_t k = 0; k < b->node_count; k++) {
    double *d = b->pivot + 3 * (size_t)k;
    double *l = b->lambda + 2 * (size_t)k;
    double det = d[0] * d[2] - d[1] * d[1];
    adjugate p = {{d[2], -d[1], d[0]}, 1.0 / det};
    double size = b->size[k];
    /* NaN fails both comparisons, and then both minima hold it or something negative. */
    least_weak = det - weak_pivot * size < least_weak ? det - weak_pivot * size : least_weak;
    least_bad = det - bad_pivot * size > 0.0 ? least_bad : -1.0;
    double right[2] = {l[0], l[1]};
    int32_t first = b->order.start[k];
    int32_t count = b->order.start[k + 1] - first;
    if (count == 1) {
      int32_t later = b->order.later[first];
      double *x = b->off + 4 * (size_t)first;
      double u[4];
      eliminate_one(x, &p, right, b->pivot + 3 * (size_t)later, b->lambda + 2 * (size_t)later, u);
      memcpy(x, u, sizeof u);
    } else if (count > 1) {
      eliminate_many(b, k, &p, right);
    }
    d[0] = p.x[0] * p.inverse;
    d[1] = p.x[1] * p.inverse;
    d[2] = p.x[2] * p.inverse;
    l[0] = d[0] * right[0] + d[1] * right[1];
    l[1] = d[1] * right[0] + d[2] * right[1];
  }
  if (!(least_bad > 0.0)) {
    return BAUM_I_PIVOTS_BAD;
  }
  return least_weak > 0.0 ? BAUM_I_PIVOTS_GOOD : BAUM_I_PIVOTS_WEAK;
}

/* l_k -= sum of L^T l_later, from the last node to the first. */
static void backward(const baum_i_block *b, double *l)
{
  for (int32_t k = (int32_t)b->node_count - 1; k >= 0; k--) {
    double l0 = l[2 * (size_t)k];
    double l1 = l[2 * (size_t)k + 1];
    for (int32_t e = b->order.start[k]; e < b->order.start[k + 1]; e++) {
      const double *x = b->off + 4 * (size_t)e;
      const double *later = l + 2 * (size_t)b->order.later[e];
      l0 -= x[0] * later[0] + x[2] * later[1];
      l1 -= x[1] * later[0] + x[3] * later[1];
    }
    l[2 * (size_t)k] = l0;
    l[2 * (size_t)k + 1] = l1;
  }
}

/* l = D^-1 L^-1 l with a factorization that is there. */
static void forward(const baum_i_block *b, double *l)
{
  for (int32_t k = 0; k < b->node_count; k++) {
    double l0 = l[2 * (size_t)k];
    double l1 = l[2 * (size_t)k + 1];
    for (int32_t e = b->order.start[k]; e < b->order.start[k + 1]; e++) {
      const double *x = b->off + 4 * (size_t)e;
      double *later = l + 2 * (size_t)b->order.later[e];
      later[0] -= x[0] * l0 + x[1] * l1;
      later[1] -= x[2] * l0 + x[3] * l1;
    }
    const double *d = b->pivot + 3 * (size_t)k;
    l[2 * (size_t)k] = d[0] * l0 + d[1] * l1;
    l[2 * (size_t)k + 1] = d[1] * l0 + d[2] * l1;
  }
}

static void substitute(baum_i_block *b)
{
  backward(b, b->lambda);
  memcpy(b->motion, b->free, 4 * (size_t)b->triple_count * sizeof *b->motion);
  scatter(b, b->lambda, b->motion);
}

/* ---- residual and refinement ---- */

static bool check_pins(const baum_i_block *b)
{
  double worst = 0.0;
  for (int i = 0; i < b->pin_count; i++) {
    const baum_i_pin_node *pin = &b->pins[i];
    const double *c = b->arm + 4 * (size_t)i;
    const double *xa = b->motion + 4 * (size_t)pin->triple[0];
    const double *xb = b->motion + 4 * (size_t)pin->triple[1];
    const double *right = b->right + 2 * (size_t)pin->node;
    for (int r = 0; r < 2; r++) {
      double turn_a = c[r] * xa[2];
      double turn_b = c[2 + r] * xb[2];
      double rest = right[r] - (xa[r] - xb[r] + turn_a + turn_b);
      double size = fabs(right[r]) + fabs(xa[r]) + fabs(xb[r]) + fabs(turn_a) + fabs(turn_b);
      double excess = fabs(rest) - rounding * size;
      worst = excess > worst ? excess : worst;
    }
  }
  return worst <= 0.0;
}

static bool check_fulls(const baum_i_block *b)
{
  double worst = 0.0;
  for (int i = 0; i < b->full_count; i++) {
    const baum_i_full_node *full = &b->fulls[i];
    const double *right = b->right + 2 * (size_t)full->node;
    for (int r = 0; r < 2; r++) {
      double sum = right[r];
      double size = fabs(right[r]);
      for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
        const double *g = b->side + 6 * (size_t)s + 3 * r;
        const double *x = b->motion + 4 * (size_t)b->side_triple[s];
        for (int c = 0; c < 3; c++) {
          sum -= g[c] * x[c];
          size += fabs(g[c] * x[c]);
        }
      }
      double excess = fabs(sum) - rounding * size;
      worst = excess > worst ? excess : worst;
    }
  }
  return worst <= 0.0;
}

static bool check(const baum_i_block *b)
{
  bool pins = check_pins(b);
  return check_fulls(b) && pins;
}

static double largest(const double *x, size_t count)
{
  double most = 0.0;
  for (size_t i = 0; i < count; i++) {
    most = fabs(x[i]) > most ? fabs(x[i]) : most;
  }
  return most;
}

static double correct(baum_i_block *b)
{
  size_t triples = 4 * (size_t)b->triple_count;
  size_t nodes = 2 * (size_t)b->node_count;
  gather(b, b->pull, b->rest);
  forward(b, b->rest);
  backward(b, b->rest);
  for (size_t i = 0; i < triples; i++) {
    b->motion[i] += b->pull[i];
  }
  scatter(b, b->rest, b->motion);
  for (size_t i = 0; i < nodes; i++) {
    b->lambda[i] += b->rest[i];
  }
  double size = largest(b->lambda, nodes);
  return size > 0.0 ? largest(b->rest, nodes) / size : 0.0;
}

const baum_i_block_kernel BAUM_I_HOT(baum_i_block_kernel) = {
  .set_full = set_full,
  .couple = couple,
  .eliminate = eliminate,
  .substitute = substitute,
  .check = check,
  .correct = correct,
};
