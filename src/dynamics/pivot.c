/* SPDX-License-Identifier: BSD-3-Clause */
/* How close to singular the last solution was.
 *
 * Blocks: the smallest det D of a node over what it was before the elimination: of a pin det S, which does not depend on
 * how its axes lie, of other pairs of rows, which may depend on each other, the product of the diagonal of
 * S = J M^-1 J^T. Of other solvers the reciprocal condition of the scaled matrix. Either is free of units and falls with
 * the square of the distance from a singular pose, for its multipliers' part is S. Sizes of the two differ: compare each
 * with what it usually is.
 */
#include <math.h>

#include "dynamics/block_path.h"
#include "dynamics/immobile.h"

/* A light rotation lets the diagonal of S alone come and go with the direction of the arm. */
static double pivot_of_pin(const baum_i_block *block, int k)
{
  const baum_i_node *node = &block->nodes[block->pins[k].node];
  const double *arm = block->arm + 4 * (ptrdiff_t)k;
  const double *weight = block->pin_weight + 4 * (ptrdiff_t)k;
  double off = weight[1] * arm[0] * arm[1] + weight[3] * arm[2] * arm[3];
  return 1.0 / fabs(node->inverse * (node->size - off * off));
}

static double pivot_of_full(const baum_i_block *block, int k)
{
  const baum_i_node *node = &block->nodes[block->fulls[k].node];
  return 1.0 / fabs(node->inverse * node->size);
}

/* And its first row, -1: none below 1. */
static double smallest_of_blocks(const baum_i_block *block, int *row)
{
  double smallest = 1.0;
  *row = -1;
  for (int k = 0; k < block->pin_count; k++) {
    double pivot = pivot_of_pin(block, k);
    if (!(pivot >= smallest)) {
      smallest = pivot;
      *row = block->pins[k].row;
    }
  }
  for (int k = 0; k < block->full_count; k++) {
    double pivot = pivot_of_full(block, k);
    if (!(pivot >= smallest)) {
      smallest = pivot;
      *row = block->fulls[k].row[0];
    }
  }
  return isfinite(smallest) ? smallest : 0.0;
}

double baum_i_smallest_pivot(const baum_workspace *w)
{
  int row = -1;
  if (w->mechanism->nc == 0) {
    return 1.0;
  }
  return w->solved_by ? smallest_of_blocks(w->solved_by->block, &row) : baum_i_kkt_rcond(w->kkt);
}

/* With other solvers the largest multiplier is all there is to name a joint by. */
int baum_i_smallest_pivot_joint(const baum_workspace *w)
{
  int row = -1;
  if (w->solved_by) {
    (void)smallest_of_blocks(w->solved_by->block, &row);
  } else {
    row = baum_i_largest(w->lambda, w->mechanism->nc, NULL);
  }
  return row < 0 ? -1 : baum_i_row_joint(w->mechanism, row);
}

/* Without blocks a solution costs little more than its factors. */
baum_status baum_i_find_pivot(baum_workspace *w, double t, const double *q, const double *v)
{
  if (!baum_i_motion_path(w)) {
    return baum_i_motion(w, t, q, v, 0.0, 0.0);
  }
  baum_i_block_path *whole = baum_i_enter_motion(w);
  baum_status status = baum_i_block_path_factor(w, t, q);
  w->solved_by = w->path;
  baum_i_leave_motion(w, whole);
  return status;
}
