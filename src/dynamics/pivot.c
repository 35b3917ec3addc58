/* SPDX-License-Identifier: BSD-3-Clause */
/* Measures how close the last solution was to a singular configuration.
 *
 * For the block solver, det D of each node is divided by det D of the same node before the
 * elimination. The measure is the smallest of these ratios. Before the elimination, D of a node is
 * its block of S = J M^-1 J^T. For a pin (a planar revolute joint) this block is 2 x 2, and its
 * determinant does not depend on the direction of axes. For other pairs of rows, which may depend
 * on each other, the product of the diagonal entries of D replaces the determinant before the
 * elimination. In space, a node is a whole joint. For other solvers, the measure is the reciprocal
 * condition number of the scaled matrix. Both measures are free of units and fall with the square
 * of the distance from a singular configuration. Their sizes differ, so each must be compared with
 * its own usual value. If a body has a small inertia, the block solver gives up for some directions
 * of the arms of the body's joints although the configuration is not close to a singular one.
 */
#include <math.h>

#include "base/hot.h"
#include "dynamics/block_path.h"

/* Return the determinant of a pin's block of S. The product of the diagonal entries would depend on
 * the direction of the arm if an inertia is small. */
static double size_of_pin(const baum_i_block *block, int k)
{
  const baum_i_node *node = &block->nodes[block->pins[k].node];
  const double *arm = block->arm + 4 * (ptrdiff_t)k;
  const double *weight = block->pin_weight + 4 * (ptrdiff_t)k;
  double off = weight[1] * arm[0] * arm[1] + weight[3] * arm[2] * arm[3];
  return node->size - off * off;
}

/* The reciprocal of the smallest pivot and the first row of its node. The row is -1 if no pivot is
 * below 1. */
typedef struct weakest {
  double inverse;
  int row;
} weakest;

/* Update the weakest pivot if the reciprocal pivot of a node is larger. NaN counts as infinity,
 * because it results from an earlier pivot of 0. */
BAUM_I_INLINE void compare_pivot(double inverse, int first_row, weakest *of)
{
  inverse = fabs(inverse);
  if (!(inverse <= of->inverse)) {
    of->inverse = isnan(inverse) ? (double)INFINITY : inverse;
    of->row = first_row;
  }
}

static weakest smallest_of_blocks(const baum_i_block *block)
{
  weakest found = {1.0, -1};
  for (int k = 0; k < block->pin_count; k++) {
    double inverse = block->nodes[block->pins[k].node].inverse;
    compare_pivot(inverse * size_of_pin(block, k), block->pins[k].row, &found);
  }
  for (int k = 0; k < block->full_count; k++) {
    const baum_i_node *node = &block->nodes[block->fulls[k].node];
    compare_pivot(node->inverse * node->size, block->fulls[k].row[0], &found);
  }
  return found;
}

/* Return an upper bound of the reciprocal pivot of a node. A determinant is at most the product of
 * the diagonal entries (J. Hadamard, 1893). */
static double bound_in_space(const baum_i_space *space, int k)
{
  const baum_i_space_measure *of = &space->measures[k];
  return fabs(of->size[0] / of->det[0] * (of->size[1] / of->det[1]));
}

static void compare_in_space(const baum_i_space *space, int k, weakest *of)
{
  const double *det = space->measures[k].det;
  double whole[2];
  baum_i_space_undivided(space, k, whole);
  compare_pivot(whole[0] / det[0] * (whole[1] / det[1]), space->list[k].row[0], of);
}

/* Find the weakest pivot. The determinants before the elimination are computed only for nodes whose
 * pivot may be the smallest. */
static weakest smallest_in_space(const baum_i_space *space)
{
  weakest found = {1.0, -1};
  int first = 0;
  for (int k = 1; k < space->node_count; k++) {
    first = bound_in_space(space, k) > bound_in_space(space, first) ? k : first;
  }
  for (int i = 0; i < space->node_count; i++) {
    int k = i == 0 ? first : i == first ? 0 : i;
    if (!(bound_in_space(space, k) <= found.inverse)) {
      compare_in_space(space, k, &found);
    }
  }
  return found;
}

/* Find the pivot of the last elimination by blocks, even if the block solver then gave up. Returns
 * false if there is no such elimination. Also returns false if the pivot is at rounding level,
 * although larger ones have occurred, masses are uneven, and another solver gave the solution:
 * uneven masses often cause such pivots. Also updates the largest pivot of the path. */
static bool find_pivot_of_blocks(const baum_workspace *w, double *pivot, int *row)
{
  static const double NOISE = 1e-10;
  if (!w->eliminated_by) {
    return false;
  }
  baum_i_block_path *path = w->eliminated_by;
  const weakest found =
    path->space ? smallest_in_space(path->space) : smallest_of_blocks(path->block);
  *pivot = 1.0 / found.inverse;
  *row = found.row;
  path->largest_pivot = fmax(path->largest_pivot, *pivot);
  return w->solved_by || !path->uneven || *pivot > NOISE || path->largest_pivot <= NOISE;
}

bool baum_i_blocks_tell(const baum_workspace *w)
{
  int row = -1;
  double pivot = 1.0;
  return find_pivot_of_blocks(w, &pivot, &row);
}

/* For other solvers *joint is the joint with the largest multiplier, for lack of a better
 * indication. If blocks have been eliminated, too, the measure must not exceed those of blocks,
 * which would otherwise seem to be singular in comparison. */
double baum_i_smallest_pivot(const baum_workspace *w, int *joint)
{
  int row = -1;
  double pivot = 1.0;
  if (w->mechanism->nc > 0 && !find_pivot_of_blocks(w, &pivot, &row)) {
    pivot = baum_i_kkt_rcond(w->kkt);
    pivot = w->eliminated_by ? fmin(pivot, w->eliminated_by->largest_pivot) : pivot;
    row = joint ? baum_i_largest(w->lambda, w->mechanism->nc, NULL) : -1;
  }
  if (joint) {
    *joint = row < 0 ? -1 : baum_i_row_joint(w->mechanism, row);
  }
  return pivot;
}
