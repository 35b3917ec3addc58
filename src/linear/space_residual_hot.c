/* SPDX-License-Identifier: BSD-3-Clause */
/* Residual of the whole system of a mechanism in space, in twice the working precision.
 * block_residual.c does the same for planar mechanisms. In the version for wide vectors
 * (base/hot.h), fma() is a single instruction. */
#include <string.h>

#include "base/hot.h"
#include "linear/space_block.h"
#include "linear/twofold.h"

enum { MOTION = BAUM_I_SPACE_MOTION };

BAUM_I_INLINE void subtract(double *high, double *low, double x, double y)
{
  baum_i_twofold sum = {*high, *low};
  baum_i_twofold_subtract_product(&sum, x, y);
  *high = sum.high;
  *low = sum.low;
}

static void begin(baum_i_space *b)
{
  memcpy(b->pull, b->load, (size_t)(MOTION * b->body_count) * sizeof *b->pull);
  memset(b->pull_low, 0, (size_t)(MOTION * b->body_count) * sizeof *b->pull_low);
  for (int t = 1; t < b->body_count; t++) {
    for (int c = 0; c < 3; c++) {
      ptrdiff_t at = (ptrdiff_t)MOTION * t + c;
      subtract(&b->pull[at], &b->pull_low[at], b->bodies[t].mass, b->motion[at]);
      subtract(&b->pull[at + 4], &b->pull_low[at + 4], 1.0, b->motion[at + 4]);
    }
  }
}

/* Subtracts J^T lambda and J a of one node. */
static void subtract_node(baum_i_space *b, const baum_i_space_node *node)
{
  int n = node->rows;
  const double *lambda = b->nodes + node->at;
  const double *right = lambda + baum_i_space_vector(n);
  double *rest = b->rest + node->place;
  double *low = b->rest_low + node->place;
  memcpy(rest, right, (size_t)n * sizeof *rest);
  memset(low, 0, (size_t)n * sizeof *low);
  for (int s = node->first_side; s < node->first_side + node->side_count; s++) {
    const baum_i_space_side *side = &b->side_list[s];
    for (int c = 0; c < 6; c++) {
      const double *part = b->sides + (c < 3 ? side->move : side->turn);
      ptrdiff_t at = (ptrdiff_t)MOTION * side->body + (c < 3 ? c : c + 1);
      for (int i = 0; i < n; i++) {
        int column = c % 3;
        double g = part[i < 4 ? 4 * column + i : 12 + 2 * column + i - 4];
        subtract(&b->pull[at], &b->pull_low[at], g, lambda[i]);
        subtract(&rest[i], &low[i], g, b->motion[at]);
      }
    }
  }
  for (int i = 0; i < n; i++) {
    rest[i] += low[i];
  }
}

static void find_residual(baum_i_space *b)
{
  begin(b);
  for (int k = 0; k < b->node_count; k++) {
    subtract_node(b, &b->list[k]);
  }
  for (int t = 0; t < b->body_count; t++) {
    for (int c = 0; c < 3; c++) {
      ptrdiff_t at = (ptrdiff_t)MOTION * t + c;
      b->pull[at] = b->bodies[t].weight[c] * (b->pull[at] + b->pull_low[at]);
      b->pull[at + 4] += b->pull_low[at + 4];
    }
  }
}

const baum_i_space_residual_kernel BAUM_I_HOT(baum_i_space_residual_kernel) = {
  .find = find_residual};
