/* SPDX-License-Identifier: BSD-3-Clause */
/* Another solution with factors at hand. */
#ifndef BAUM_I_LINEAR_BLOCK_PULL_H
#define BAUM_I_LINEAR_BLOCK_PULL_H

#include "linear/block.h"

/* Before a correction with the factors of the last solution: pull is x (nv), the motion -x, rest
 * and multipliers are 0, so that the motion becomes -W J^T S^-1 J x. Of fixed bodies x is taken for
 * 0. */
void baum_i_block_pull(baum_i_block *block, const double *x);

#endif
