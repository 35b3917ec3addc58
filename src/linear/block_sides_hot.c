/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes general nodes from the blocks of J: their sides, Phi', right-hand side and pivots. G is
 * a side.
 *
 *   D = sum over sides of G W G^T,   J a0 - r = sum over sides of G a0 - r */
#include <string.h>

#include "base/hot.h"
#include "linear/block_sides.h"

/* Solves L y = f for a dense body. */
static void set_dense_force(baum_i_block *block, const baum_i_dense_body *dense,
                            const double *force)
{
  const baum_i_mass_block *body = &block->structure->mass_blocks[dense->mass_block];
  const double *l = block->factor + dense->factor;
  double *y = block->free + dense->place;
  int n = body->size;
  for (int i = 0; i < n; i++) {
    double sum = force[body->first + i];
    for (int k = 0; k < i; k++) {
      sum -= l[i * n + k] * y[k];
    }
    y[i] = sum / l[i * n + i];
    block->force[dense->place + i] = y[i];
  }
}

static void set_force(baum_i_block *block, const double *force)
{
  int nv = block->structure->nv;
  const double *response = block->response;
  double *free = block->free;
  memcpy(block->force, force, (size_t)nv * sizeof *force);
  for (int i = 0; i < nv; i++) {
    free[i] = response[i] * force[i];
  }
  for (int k = 0; k < block->dense_count; k++) {
    set_dense_force(block, &block->dense[k], force);
  }
}

/* Replaces the sides G of dense bodies by (L^-1 G^T)^T, as y = L^T a requires. */
static void whiten(baum_i_block *b)
{
  for (int i = 0; i < b->dense_side_count; i++) {
    const baum_i_dense_side *d = &b->dense_sides[i];
    const baum_i_dense_body *body = &b->dense[d->body];
    int n = b->structure->mass_blocks[body->mass_block].size;
    const double *l = b->factor + body->factor;
    double *g = b->side + 6 * (size_t)d->side; /* g[2 j], g[2 j + 1]: column j */
    for (int j = 0; j < n; j++) {
      baum_i_pair sum = baum_i_load(g + 2 * j);
      for (int k = 0; k < j; k++) {
        sum -= l[j * n + k] * baum_i_load(g + 2 * k);
      }
      baum_i_store(g + 2 * j, sum / l[j * n + j]);
    }
  }
}

/* Returns the velocities of all body blocks. The result is zeros if v is NULL, and v itself if no
 * body block has numbers outside v. Otherwise it is a copy in pull[], with L^T v for each dense
 * body. */
static const double *gather_velocities(const baum_i_block *b, const double *v)
{
  if (!v) {
    return b->nothing;
  }
  if (!b->leaves_v) {
    return v;
  }
  memcpy(b->pull, v, (size_t)b->structure->nv * sizeof *v);
  memset(b->pull + b->structure->nv, 0, 3 * sizeof *v);
  for (int i = 0; i < b->dense_count; i++) {
    const baum_i_mass_block *body = &b->structure->mass_blocks[b->dense[i].mass_block];
    const double *l = b->factor + b->dense[i].factor;
    int n = body->size;
    for (int j = 0; j < n; j++) {
      double sum = 0.0;
      for (int k = j; k < n; k++) {
        sum += l[k * n + j] * v[body->first + k];
      }
      b->pull[b->dense[i].place + j] = sum;
    }
  }
  return b->pull;
}

/* Sets Phi' = rate - nu of row r, where rate = J v. Returns the right-hand side of this row, or 0
 * if r is negative. */
static inline double set_row(const baum_i_block_rows *rows, int32_t r, double rate)
{
  if (r < 0) {
    return 0.0;
  }
  rate -= rows->nu[r];
  rows->phi_rate[r] = rate;
  return rows->bending * rows->gamma[r] - rows->damping * rate - rows->stiffness * rows->phi[r];
}

/* The sums of a node over its sides. */
typedef struct sums {
  baum_i_pair on;   /* diagonal entries of D */
  baum_i_pair off;  /* off-diagonal entry of D, stored twice */
  baum_i_pair rate; /* J v */
  baum_i_pair free; /* J a0 */
} sums;

/* Returns G times the three numbers at x. */
static inline baum_i_pair times_side(const baum_i_columns *g, const double *x)
{
  return x[0] * g->c[0] + x[1] * g->c[1] + x[2] * g->c[2];
}

/* Loads a side. A side that is copied from J as a whole is also stored in side[]. */
static inline baum_i_columns load_general_side(const baum_i_block *b, ptrdiff_t side,
                                               const double *jacobian)
{
  double *to = b->side + 6 * side;
  const int32_t *from = b->side_from + 2 * side;
  if (from[0] < 0) {
    return baum_i_load_full(to);
  }
  const double *x = jacobian + from[0];
  const double *y = jacobian + from[1];
  baum_i_columns g;
  for (int c = 0; c < 3; c++) {
    g.c[c] = from[1] < 0 ? (baum_i_pair){x[c], 0.0} : (baum_i_pair){x[c], y[c]};
    baum_i_store(to + 2 * c, g.c[c]);
  }
  return g;
}

static inline void add_side(const baum_i_block *b, ptrdiff_t side, const double *jacobian,
                            const double *velocity, sums *sum)
{
  baum_i_columns g = load_general_side(b, side, jacobian);
  int32_t body_block = b->side_body_block[side];
  int32_t place = b->place[body_block];
  const double *w = b->weight + 2 * (ptrdiff_t)body_block;
  baum_i_pair turning = w[1] * g.c[2];
  sum->on += w[0] * (g.c[0] * g.c[0] + g.c[1] * g.c[1]) + turning * g.c[2];
  sum->off += w[0] * (g.c[0] * baum_i_exchanged(g.c[0]) + g.c[1] * baum_i_exchanged(g.c[1])) +
              turning * baum_i_exchanged(g.c[2]);
  sum->rate += times_side(&g, velocity + place);
  sum->free += times_side(&g, b->from + place);
}

static void set_node(const baum_i_block *b, const baum_i_full_node *full,
                     const baum_i_block_rows *rows, const double *velocity)
{
  sums sum = {.on = {full->row[0] < 0 ? 1.0 : 0.0, full->row[1] < 0 ? 1.0 : 0.0}};
  for (ptrdiff_t s = full->first_side; s < full->first_side + full->side_count; s++) {
    add_side(b, s, rows->jacobian, velocity, &sum);
  }
  baum_i_pair right = {set_row(rows, full->row[0], sum.rate[0]),
                       set_row(rows, full->row[1], sum.rate[1])};
  baum_i_node *node = &b->nodes[full->node];
  baum_i_store(b->right + 2 * (ptrdiff_t)full->node, right);
  baum_i_store(node->pivot, (baum_i_pair){sum.on[0], sum.off[0]});
  baum_i_store(node->pivot + 2, (baum_i_pair){sum.off[0], sum.on[1]});
  baum_i_store(node->lambda, sum.free - right);
  node->size = sum.on[0] * sum.on[1];
}

static void set_all(baum_i_block *b, const baum_i_block_rows *rows)
{
  const double *jacobian = rows->jacobian;
  double *side = b->side;
  for (ptrdiff_t k = 0; k < b->entry_count; k++) {
    const baum_i_side_entry *entry = &b->entries[k];
    double second = entry->from[1] < 0 ? 0.0 : jacobian[entry->from[1]];
    baum_i_store(side + entry->to, (baum_i_pair){jacobian[entry->from[0]], second});
  }
  whiten(b);
  if (b->full_count > 0) {
    const baum_i_block_rows at = *rows; /* a local copy can stay in registers */
    const double *velocity = gather_velocities(b, rows->v);
    const baum_i_full_node *last = b->fulls + b->full_count;
    for (const baum_i_full_node *full = b->fulls; full < last; full++) {
      set_node(b, full, &at, velocity);
    }
  }
}

const baum_i_block_sides_kernel BAUM_I_HOT(baum_i_block_sides_kernel) = {.set_force = set_force,
                                                                         .set = set_all};
