/* SPDX-License-Identifier: BSD-3-Clause */
/* Prepares other right-hand sides for the factors of the last solution. From zero motion and the
 * residual (0, r), correct() of block_hot.c computes
 *
 *   S lambda = -r,   a = -W J^T lambda,   hence J a = r */
#include "linear/block_pull.h"

#include <string.h>

static void clear(baum_i_block *block)
{
  baum_i_block_use_force(block, false);
  memset(block->right, 0, 2 * (size_t)block->node_count * sizeof *block->right);
  memset(block->motion, 0, (size_t)block->motion_size * sizeof *block->motion);
  memset(block->pull, 0, (size_t)block->motion_size * sizeof *block->pull);
  for (int k = 0; k < block->node_count; k++) {
    memset(block->nodes[k].lambda, 0, sizeof block->nodes[k].lambda);
  }
}

/* Computes y = L^T x for a dense body. */
static void pull_dense(baum_i_block *block, const baum_i_dense_body *dense, const double *x)
{
  const baum_i_mass_block *body = &block->structure->mass_blocks[dense->mass_block];
  const double *l = block->factor + dense->factor;
  double *y = block->pull + dense->place;
  int n = body->size;
  for (int i = 0; i < n; i++) {
    y[i] = 0.0;
    for (int k = i; k < n; k++) {
      y[i] += l[k * n + i] * x[body->first + k];
    }
  }
}

void baum_i_block_pull(baum_i_block *block, const double *x)
{
  clear(block);
  memset(block->rest, 0, 2 * (size_t)block->node_count * sizeof *block->rest);
  for (int i = 0; i < block->structure->mass_block_count; i++) {
    const baum_i_mass_block *body = &block->structure->mass_blocks[i];
    if (!block->fixed[i]) {
      memcpy(block->pull + body->first, x + body->first, (size_t)body->size * sizeof *x);
    }
  }
  for (int i = 0; i < block->dense_count; i++) {
    pull_dense(block, &block->dense[i], x);
  }
  for (int i = 0; i < block->motion_size; i++) {
    block->motion[i] = -block->pull[i];
  }
}

void baum_i_block_set_rest(baum_i_block *block, const double *r)
{
  clear(block);
  for (int i = 0; i < block->pin_count; i++) {
    const baum_i_pin_node *pin = &block->pins[i];
    memcpy(block->right + 2 * (size_t)pin->node, r + pin->row, 2 * sizeof *r);
  }
  for (int i = 0; i < block->full_count; i++) {
    const baum_i_full_node *full = &block->fulls[i];
    for (int k = 0; k < 2; k++) {
      block->right[2 * (size_t)full->node + (size_t)k] = full->row[k] < 0 ? 0.0 : r[full->row[k]];
    }
  }
  memcpy(block->rest, block->right, 2 * (size_t)block->node_count * sizeof *block->rest);
}

void baum_i_block_move_rest(baum_i_block *block)
{
  memcpy(block->right, block->rest, 2 * (size_t)block->node_count * sizeof *block->right);
  memset(block->motion, 0, (size_t)block->motion_size * sizeof *block->motion);
  memset(block->pull, 0, (size_t)block->motion_size * sizeof *block->pull);
}
