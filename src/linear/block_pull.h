/* SPDX-License-Identifier: BSD-3-Clause */
/* Prepares another solution with the factors of the last one. */
#ifndef BAUM_I_LINEAR_BLOCK_PULL_H
#define BAUM_I_LINEAR_BLOCK_PULL_H

#include "linear/block.h"

/* Prepares a correction with the factors of the last solution: sets pull to x (nv), the motion to
 * -x, and both rest and multipliers to 0. The correction then gives the motion -W J^T S^-1 J x. For
 * fixed bodies 0 is used in place of x. */
void baum_i_block_pull(baum_i_block *block, const double *x);

/* Sets r to rest, and the motion to 0. After baum_i_block_pull() and baum_i_block_find_residual(),
 * rest is J x. The next correct() then gives a motion with J a = J x, which can be corrected again.
 * A correction of the motion -x could not be: if the sum of both should be 0, rounding errors are
 * left, and further corrections do not become smaller than the sum. */
void baum_i_block_move_rest(baum_i_block *block);

#endif
