/* SPDX-License-Identifier: BSD-3-Clause */
/* What a solution costs by count, from the structure alone. */
#ifndef BAUM_I_LINEAR_BLOCK_COST_H
#define BAUM_I_LINEAR_BLOCK_COST_H

#include "linear/block.h"

/* Operations on floating-point numbers, a fused one counted as two; and every number and index that is
 * touched, once: the traffic is about twice that. */
typedef struct baum_i_cost {
  double flops;
  double bytes;
} baum_i_cost;

/* One solution by a block solver, without refinement: what block_hot.c and block_sides_hot.c do, and of
 * pins the motion that they make. */
baum_i_cost baum_i_block_cost(const baum_i_block *block);

/* Pairs of couplings of one node, over all nodes. */
double baum_i_block_target_count(const baum_i_block *block);

#endif
