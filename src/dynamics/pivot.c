/* SPDX-License-Identifier: BSD-3-Clause */
/* Measures how close the last solution was to a singular configuration.
 *
 * For blocks the measure is the smallest ratio, over all nodes, of det D to the same determinant
 * before the elimination. For a pin the determinant before the elimination is det S, which does not
 * depend on the direction of axes. For other pairs of rows, which may depend on each other, the
 * product of the diagonal entries of S = J M^-1 J^T replaces this determinant. In space the node is
 * a whole joint, and the determinant before is that of its block of S. For other solvers
 * the measure is the reciprocal condition number of the scaled matrix. Both measures are free of
 * units and fall with the square of the distance from a singular configuration. Their sizes differ,
 * so each must be compared with its own usual value. If a body has a small inertia, the block
 * solver gives up for some directions of its arms although the configuration is not close to a
 * singular one.
 */
#include <math.h>

#include "dynamics/block_path.h"

/* Return det S of a pin. If an inertia is small, the product of the diagonal entries of S would
 * depend on the direction of the arm. */
static double size_of_pin(const baum_i_block *block, int k)
{
  const baum_i_node *node = &block->nodes[block->pins[k].node];
  const double *arm = block->arm + 4 * (ptrdiff_t)k;
  const double *weight = block->pin_weight + 4 * (ptrdiff_t)k;
  double off = weight[1] * arm[0] * arm[1] + weight[3] * arm[2] * arm[3];
  return node->size - off * off;
}

/* Update *smallest and *row if the pivot of a node is smaller. NaN, which results from an earlier
 * zero pivot, counts as zero. */
static void compare_pivot(double pivot, int first_row, double *smallest, int *row)
{
  pivot = isnan(pivot) ? 0.0 : pivot;
  if (pivot < *smallest) {
    *smallest = pivot;
    *row = first_row;
  }
}

/* Return the smallest pivot. *row is the first row of its node, or -1 if no pivot is below 1. */
static double smallest_of_blocks(const baum_i_block *block, int *row)
{
  double smallest = 1.0;
  *row = -1;
  for (int k = 0; k < block->pin_count; k++) {
    const baum_i_node *node = &block->nodes[block->pins[k].node];
    compare_pivot(1.0 / fabs(node->inverse * size_of_pin(block, k)), block->pins[k].row, &smallest,
                  row);
  }
  for (int k = 0; k < block->full_count; k++) {
    const baum_i_node *node = &block->nodes[block->fulls[k].node];
    compare_pivot(1.0 / fabs(node->inverse * node->size), block->fulls[k].row[0], &smallest, row);
  }
  return smallest;
}

static double pivot_in_space(const baum_i_space *space, int k)
{
  const double *det = space->measures[k].det;
  double whole[2];
  baum_i_space_undivided(space, k, whole);
  return fabs(det[0] / whole[0] * (det[1] / whole[1]));
}

/* Return a number below the pivot of a node. A determinant is at most the product of the diagonal
 * entries (J. Hadamard, 1893). */
static double least_in_space(const baum_i_space *space, int k)
{
  const baum_i_space_measure *of = &space->measures[k];
  return fabs(of->det[0] / of->size[0] * (of->det[1] / of->size[1]));
}

/* Determinants are computed only at nodes whose pivot may be the smallest. */
static double smallest_in_space(const baum_i_space *space, int *row)
{
  double smallest = 1.0;
  double least = (double)INFINITY;
  int first = 0;
  *row = -1;
  for (int k = 0; k < space->node_count; k++) {
    double at = least_in_space(space, k);
    first = at < least ? k : first;
    least = at < least ? at : least;
  }
  if (space->node_count > 0) {
    compare_pivot(pivot_in_space(space, first), space->list[first].row[0], &smallest, row);
  }
  for (int k = 0; k < space->node_count; k++) {
    if (k != first && !(least_in_space(space, k) >= smallest)) {
      compare_pivot(pivot_in_space(space, k), space->list[k].row[0], &smallest, row);
    }
  }
  return smallest;
}

/* Find the pivot of the last elimination by blocks, even if the block solver then gave up. Returns
 * false if there is none, or if masses are so uneven that small pivots are common and the pivot is
 * at rounding level. */
static bool find_pivot_of_blocks(const baum_workspace *w, double *pivot, int *row)
{
  static const double NOISE = 1e-10;
  if (!w->eliminated_by) {
    return false;
  }
  const baum_i_block_path *path = w->eliminated_by;
  *pivot = path->space ? smallest_in_space(path->space, row) : smallest_of_blocks(path->block, row);
  return w->solved_by || !w->eliminated_by->uneven || *pivot > NOISE;
}

bool baum_i_blocks_tell(const baum_workspace *w)
{
  int row = -1;
  double pivot = 1.0;
  return find_pivot_of_blocks(w, &pivot, &row);
}

/* For other solvers *joint is the joint with the largest multiplier, for lack of a better
 * indication. */
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
