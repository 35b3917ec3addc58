/* SPDX-License-Identifier: BSD-3-Clause */
/* How close to singular the last solution was.
 *
 * Blocks: the smallest det D of a node over what it was before the elimination: of a pin det S,
 * which does not depend on how its axes lie, of other pairs of rows, which may depend on each
 * other, the product of the diagonal of S = J M^-1 J^T. Of other solvers the reciprocal condition
 * of the scaled matrix. Either is free of units and falls with the square of the distance from a
 * singular configuration, for its multipliers' part is S. Sizes of the two differ: compare each
 * with what it usually is. A body that turns easily makes blocks hand over in some directions of
 * its arms only, where it is no nearer to singular than in others.
 */
#include <math.h>

#include "dynamics/block_path.h"

/* A light rotation lets the diagonal of S alone come and go with the direction of the arm. */
static double size_of_pin(const baum_i_block *block, int k)
{
  const baum_i_node *node = &block->nodes[block->pins[k].node];
  const double *arm = block->arm + 4 * (ptrdiff_t)k;
  const double *weight = block->pin_weight + 4 * (ptrdiff_t)k;
  double off = weight[1] * arm[0] * arm[1] + weight[3] * arm[2] * arm[3];
  return node->size - off * off;
}

/* The pivot of a node, whose share of the matrix was of this size before the elimination; keeps the
 * smallest and its row. What is no number comes from a zero before. */
static void compare_pivot(const baum_i_node *node, double size, int first_row, double *smallest,
                          int *row)
{
  double pivot = 1.0 / fabs(node->inverse * size);
  pivot = isnan(pivot) ? 0.0 : pivot;
  if (pivot < *smallest) {
    *smallest = pivot;
    *row = first_row;
  }
}

/* And its first row, -1: none below 1. */
static double smallest_of_blocks(const baum_i_block *block, int *row)
{
  double smallest = 1.0;
  *row = -1;
  for (int k = 0; k < block->pin_count; k++) {
    const baum_i_node *node = &block->nodes[block->pins[k].node];
    compare_pivot(node, size_of_pin(block, k), block->pins[k].row, &smallest, row);
  }
  for (int k = 0; k < block->full_count; k++) {
    const baum_i_node *node = &block->nodes[block->fulls[k].node];
    compare_pivot(node, node->size, block->fulls[k].row[0], &smallest, row);
  }
  return smallest;
}

/* Blocks that have handed over are asked all the same, but where masses are so uneven that small
 * pivots are the rule, only as long as rounding leaves something of them. */
static bool find_pivot_of_blocks(const baum_workspace *w, double *pivot, int *row)
{
  static const double NOISE = 1e-10;
  if (!w->eliminated_by) {
    return false;
  }
  *pivot = smallest_of_blocks(w->eliminated_by->block, row);
  return w->solved_by || !w->eliminated_by->uneven || *pivot > NOISE;
}

bool baum_i_blocks_tell(const baum_workspace *w)
{
  int row = -1;
  double pivot = 1.0;
  return find_pivot_of_blocks(w, &pivot, &row);
}

/* With other solvers the largest multiplier is all there is to name a joint by. */
double baum_i_smallest_pivot(const baum_workspace *w, int *joint)
{
  int row = -1;
  double pivot = 1.0;
  if (w->mechanism->nc > 0 && !find_pivot_of_blocks(w, &pivot, &row)) {
    pivot = baum_i_kkt_rcond(w->kkt);
    row = joint ? baum_i_largest(w->lambda, w->mechanism->nc, NULL) : -1;
  }
  if (joint) {
    *joint = row < 0 ? -1 : baum_i_row_joint(w->mechanism, row);
  }
  return pivot;
}
