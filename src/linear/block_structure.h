/* SPDX-License-Identifier: BSD-3-Clause */
/* Finding the structure of block.h: everything there but the numbers. */
#ifndef BAUM_I_LINEAR_BLOCK_STRUCTURE_H
#define BAUM_I_LINEAR_BLOCK_STRUCTURE_H

#include "linear/block.h"

/* Fills an empty block. As baum_i_block_create(); on failure what was made so far is left to
 * baum_i_block_destroy(). */
baum_status baum_i_block_find_structure(const baum_i_block_layout *layout, baum_i_block *block);

#endif
