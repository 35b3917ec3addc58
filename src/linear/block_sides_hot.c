/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes that are not pins, from the blocks of J that their joints give: sides, in pairs of rows and
 * triples of columns; Phi' and the right side; pivots.
 *
 *   D = sum over sides of G W G^T,   J a0 - r = sum over sides of G a0 - r
 */
#include <string.h>

#include "base/hot.h"
#include "linear/block_sides.h"

/* L y = f */
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
  for (int i = 0; i < block->dense_count; i++) {
    set_dense_force(block, &block->dense[i], force);
  }
}

/* Row by row, L y = G^T for a body with M = L L^T, over its triples. */
static void whiten(baum_i_block *b)
{
  for (int i = 0; i < b->dense_side_count; i++) {
    const baum_i_dense_side *d = &b->dense_sides[i];
    const baum_i_dense_body *body = &b->dense[d->body];
    int n = b->structure->mass_blocks[body->mass_block].size;
    const double *l = b->factor + body->factor;
    double *g = b->side + 6 * (size_t)d->side; /* column j is the j-th pair */
    for (int j = 0; j < n; j++) {
      baum_i_pair sum = baum_i_load(g + 2 * j);
      for (int k = 0; k < j; k++) {
        sum -= l[j * n + k] * baum_i_load(g + 2 * k);
      }
      baum_i_store(g + 2 * j, sum / l[j * n + j]);
    }
  }
}

/* The velocities of all triples: v itself, or a copy in pull[], which only refinement needs, where
 * places lie outside of v. */
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
    memcpy(b->pull + b->dense[i].place, v + body->first, (size_t)body->size * sizeof *v);
  }
  return b->pull;
}

/* One of both rows of a node. */
static inline double set_row(const baum_i_block_rows *rows, int32_t r, double rate)
{
  if (r < 0) {
    return 0.0;
  }
  rate -= rows->nu[r];
  rows->phi_rate[r] = rate;
  return rows->bending * rows->gamma[r] - rows->damping * rate - rows->stiffness * rows->phi[r];
}

/* With the sides of J itself. */
static void set_right(const baum_i_block *b, const baum_i_full_node *full,
                      const baum_i_block_rows *rows, const double *velocity)
{
  baum_i_pair rate = {0.0, 0.0};
  for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
    baum_i_columns g = baum_i_load_full(b->side + 6 * (size_t)s);
    const double *v = velocity + b->place[b->side_triple[s]];
    rate += v[0] * g.c[0] + v[1] * g.c[1] + v[2] * g.c[2];
  }
  double *right = b->right + 2 * (size_t)full->node;
  right[0] = set_row(rows, full->row[0], rate[0]);
  right[1] = set_row(rows, full->row[1], rate[1]);
}

static void set_full_node(const baum_i_block *b, const baum_i_full_node *full)
{
  baum_i_node *node = &b->nodes[full->node];
  baum_i_square pivot = {
    {{full->row[0] < 0 ? 1.0 : 0.0, 0.0}, {0.0, full->row[1] < 0 ? 1.0 : 0.0}}};
  baum_i_pair miss = -baum_i_load(b->right + 2 * (size_t)full->node);
  for (int s = full->first_side; s < full->first_side + full->side_count; s++) {
    baum_i_columns g = baum_i_load_full(b->side + 6 * (size_t)s);
    const double *x = b->from + b->place[b->side_triple[s]];
    pivot = baum_i_add_sides(pivot, &g, b->weight + 2 * (size_t)b->side_triple[s], &g);
    miss += x[0] * g.c[0] + x[1] * g.c[1] + x[2] * g.c[2];
  }
  baum_i_store_square(node->pivot, pivot);
  baum_i_store(node->lambda, miss);
  node->size = pivot.column[0][0] * pivot.column[1][1];
}

static void set_all(baum_i_block *b, const baum_i_block_rows *rows)
{
  if (b->full_count == 0) {
    return;
  }
  for (int i = 0; i < b->entry_count; i++) {
    b->side[b->entries[i].to] = rows->jacobian[b->entries[i].from];
  }
  const double *velocity = gather_velocities(b, rows->v);
  for (int i = 0; i < b->full_count; i++) {
    set_right(b, &b->fulls[i], rows, velocity);
  }
  whiten(b);
  for (int i = 0; i < b->full_count; i++) {
    set_full_node(b, &b->fulls[i]);
  }
}

const baum_i_block_sides_kernel BAUM_I_HOT(baum_i_block_sides_kernel) = {.set_force = set_force,
                                                                         .set = set_all};
