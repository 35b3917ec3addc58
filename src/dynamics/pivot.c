/* SPDX-License-Identifier: BSD-3-Clause */
/* How close to singular the last solution was.
 *
 * Blocks: the smallest det D of a node over the product of the diagonal that S = J M^-1 J^T had there; of other
 * solvers the reciprocal condition of the scaled matrix. Either is free of units and falls with the square of the
 * distance from a singular pose, for its multipliers' part is S. Sizes of the two differ: compare each with what it
 * usually is.
 */
#include <math.h>

#include "dynamics/block_path.h"

static double pivot_of(const baum_i_block *block, int node)
{
  return 1.0 / fabs(block->nodes[node].inverse * block->nodes[node].size);
}

static double smallest_of_blocks(const baum_i_block *block, int *where)
{
  double smallest = 1.0;
  *where = -1;
  for (int k = 0; k < block->node_count; k++) {
    double pivot = pivot_of(block, k);
    if (!(pivot >= smallest)) {
      smallest = pivot;
      *where = k;
    }
  }
  return isfinite(smallest) ? smallest : 0.0;
}

static int row_of_node(const baum_i_block *block, int node)
{
  for (int k = 0; k < block->pin_count; k++) {
    if (block->pins[k].node == node) {
      return block->pins[k].row;
    }
  }
  for (int k = 0; k < block->full_count; k++) {
    if (block->fulls[k].node == node) {
      return block->fulls[k].row[0];
    }
  }
  return -1;
}

double baum_i_smallest_pivot(const baum_workspace *w)
{
  int where = -1;
  if (w->mechanism->nc == 0) {
    return 1.0;
  }
  return w->solved_by ? smallest_of_blocks(w->solved_by->block, &where) : baum_i_kkt_rcond(w->kkt);
}

/* With other solvers the largest multiplier is all there is to name a joint by. */
int baum_i_smallest_pivot_joint(const baum_workspace *w)
{
  int row = -1;
  if (w->solved_by) {
    int where = -1;
    (void)smallest_of_blocks(w->solved_by->block, &where);
    row = where < 0 ? -1 : row_of_node(w->solved_by->block, where);
  } else {
    row = baum_i_largest(w->lambda, w->mechanism->nc, NULL);
  }
  return row < 0 ? -1 : baum_i_row_joint(w->mechanism, row);
}
