/* SPDX-License-Identifier: BSD-3-Clause */
/* Measures how close the last solution was to a singular configuration.
 *
 * For blocks it is the smallest ratio of det D of a node to its value before the elimination. That
 * value is det S for a pin, which does not depend on the direction of axes. For other pairs of
 * rows, which may depend on each other, it is the product of the diagonal of S = J M^-1 J^T. For
 * other solvers the measure is the reciprocal condition number of the scaled matrix. Both are free
 * of units and fall with the square of the distance from a singular configuration, because the
 * matrix contains S. Their sizes differ, so each must be compared with its own usual value. If a
 * body has a small inertia, blocks give up for some directions of its arms, although the
 * configuration is no closer to singular than for others.
 */
#include <math.h>

#include "dynamics/block_path.h"

/* det S: with a small inertia the diagonal of S alone would depend on the direction of the arm. */
static double size_of_pin(const baum_i_block *block, int k)
{
  const baum_i_node *node = &block->nodes[block->pins[k].node];
  const double *arm = block->arm + 4 * (ptrdiff_t)k;
  const double *weight = block->pin_weight + 4 * (ptrdiff_t)k;
  double off = weight[1] * arm[0] * arm[1] + weight[3] * arm[2] * arm[3];
  return node->size - off * off;
}

/* Compare the pivot of a node, whose determinant had this size before the elimination, with the
 * smallest so far, and keep the smaller one and its row. NaN stems from a zero before and counts as
 * zero. */
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

/* The smallest pivot and its first row; -1 if none is below 1. */
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

/* Use the blocks even if they gave up. Where masses are so uneven that small pivots are common, use
 * them only if the pivot is above rounding. */
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

/* For other solvers only the largest multiplier can point to a joint. */
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
