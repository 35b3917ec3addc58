/* SPDX-License-Identifier: BSD-3-Clause */
/* Data that block_structure.c and block_couplings.c share while they build the structure of a
 * solver. */
#ifndef BAUM_I_LINEAR_BLOCK_BUILDER_H
#define BAUM_I_LINEAR_BLOCK_BUILDER_H

#include "linear/block.h"
#include "linear/vector.h"

/* A node before its place in the order of elimination is known. */
typedef struct baum_i_raw_node {
  int32_t row[2]; /* -1: none */
  int32_t first_side;
  int32_t side_count;
  bool is_pin;
} baum_i_raw_node;

/* A side before the place of its node is known. `number` means the same as side[i] in
 * baum_i_full_pair, but the arms are counted in the order of rows instead of places. */
typedef struct baum_i_raw_side {
  int32_t node;
  int32_t body_block;
  int32_t number;
} baum_i_raw_side;

typedef struct baum_i_block_builder {
  const baum_i_block_layout *layout;
  baum_i_block *block;
  int32_t *column_body;      /* (nv) mass block of each column */
  int32_t *body_block_of;    /* (mass_block_count) first body block */
  int32_t *dense_of;         /* (mass_block_count) index in dense[]; -1: none */
  baum_i_vector nodes;       /* baum_i_raw_node */
  baum_i_vector sides;       /* baum_i_raw_side */
  baum_i_vector full_sides;  /* int32_t body block */
  baum_i_vector entries;     /* baum_i_side_entry */
  baum_i_vector dense_sides; /* baum_i_dense_side */
  int raw_pins;
  int32_t *sorted_start;    /* (body_block_count + 1) start of the sides in sorted[] */
  int32_t *sorted;          /* (sides.count) */
  int32_t *graph_start;     /* (nodes.count + 1) */
  baum_i_vector neighbours; /* int32_t */
  int32_t *arm_of;          /* (nodes.count) number of a pin's first arm, in the order of places */
  unsigned char *is_set;    /* (off_count) 1: a pair sets this block */
  baum_i_vector alike, opposite, first_pairs, full_pairs, zeros, targets;
} baum_i_block_builder;

/* Tells whether W of a body block is 0. Such a body block couples no nodes. */
static inline bool baum_i_block_is_fixed(const baum_i_block_builder *u, int body_block)
{
  const unsigned char *fixed = u->block->fixed;
  return body_block == 0 ||
         (body_block <= u->layout->structure->mass_block_count && fixed[body_block - 1]);
}

/* Lists the pairs of nodes that share a body block, and the blocks of off[] that no pair sets,
 * which must be cleared. Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_block_make_pairs(baum_i_block_builder *u);

/* Lists the blocks that receive the products of a node's couplings. The f-th coupling is multiplied
 * with all couplings before it. Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_block_make_targets(baum_i_block_builder *u);

/* Sets all members of an empty solver except the arrays of numbers. Returns the same statuses as
 * baum_i_block_create(). After a failure the caller destroys the solver. */
baum_status baum_i_block_find_structure(const baum_i_block_layout *layout, baum_i_block *block);

#endif
