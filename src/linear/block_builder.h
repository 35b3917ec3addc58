/* SPDX-License-Identifier: BSD-3-Clause */
/* State that block_structure.c and block_couplings.c share while they build a structure. */
#ifndef BAUM_I_LINEAR_BLOCK_BUILDER_H
#define BAUM_I_LINEAR_BLOCK_BUILDER_H

#include "linear/block.h"
#include "linear/vector.h"

/* A node before it is placed. */
typedef struct baum_i_raw_node {
  int32_t row[2]; /* -1: none */
  int32_t first_side;
  int32_t side_count;
  bool is_pin;
} baum_i_raw_node;

/* A side before its node is placed. `number` is as in baum_i_full_pair, but arms are counted in the
 * order of the rows. */
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
  int32_t *dense_of;         /* (mass_block_count) in dense[], -1: diagonal */
  baum_i_vector nodes;       /* baum_i_raw_node */
  baum_i_vector sides;       /* baum_i_raw_side */
  baum_i_vector full_sides;  /* int32_t body block */
  baum_i_vector entries;     /* baum_i_side_entry */
  baum_i_vector dense_sides; /* baum_i_dense_side */
  int raw_pins;
  int32_t *sorted_start;    /* (body_block_count + 1) sides of a body block */
  int32_t *sorted;          /* (sides.count) */
  int32_t *graph_start;     /* (nodes.count + 1) */
  baum_i_vector neighbours; /* int32_t */
  int32_t *arm_of;          /* (nodes.count) pin's number in the order of places */
  unsigned char *is_set;    /* (off_count) a pair sets it */
  baum_i_vector alike, opposite, first_pairs, full_pairs, zeros, targets;
} baum_i_block_builder;

/* Tells whether W = 0 there, so that the body block couples nothing. */
static inline bool baum_i_block_is_fixed(const baum_i_block_builder *u, int body_block)
{
  const unsigned char *fixed = u->block->fixed;
  return body_block == 0 ||
         (body_block <= u->layout->structure->mass_block_count && fixed[body_block - 1]);
}

/* Lists the couplings of nodes that share a body block, and the blocks to clear first. BAUM_OK or
 * BAUM_ERR_MEMORY. */
baum_status baum_i_block_make_pairs(baum_i_block_builder *u);

/* Lists the blocks that receive the products of a node's couplings: of the f-th with those before
 * it. BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_block_make_targets(baum_i_block_builder *u);

/* Fills an empty block: everything of block.h but the numbers. Returns what baum_i_block_create()
 * returns; after a failure the caller destroys the block. */
baum_status baum_i_block_find_structure(const baum_i_block_layout *layout, baum_i_block *block);

#endif
