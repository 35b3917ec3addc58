/* SPDX-License-Identifier: BSD-3-Clause */
/* Another right side for the factors at hand: a correction (block_hot.c) of no motion by the
 * residual (0, r) is the solution of
 *
 *   S lambda = -r,   a = -W J^T lambda,   so that J a = r
 */
#include <string.h>

#include "linear/block.h"

void baum_i_block_set_rest(baum_i_block *block, const double *r)
{
  size_t motion = (size_t)block->motion_size * sizeof *block->motion;
  memset(block->motion, 0, motion);
  memset(block->pull, 0, motion);
  for (int i = 0; i < block->node_count; i++) {
    block->nodes[i].lambda[0] = 0.0;
    block->nodes[i].lambda[1] = 0.0;
  }
  for (int i = 0; i < block->pin_count; i++) {
    const baum_i_pin_node *pin = &block->pins[i];
    memcpy(block->rest + 2 * (size_t)pin->node, r + pin->row, 2 * sizeof *r);
  }
  for (int i = 0; i < block->full_count; i++) {
    const baum_i_full_node *full = &block->fulls[i];
    for (int k = 0; k < 2; k++) {
      block->rest[2 * (size_t)full->node + (size_t)k] = full->row[k] < 0 ? 0.0 : r[full->row[k]];
    }
  }
}
