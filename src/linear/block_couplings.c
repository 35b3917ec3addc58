/* SPDX-License-Identifier: BSD-3-Clause */
/* Couplings of the block Schur complement. Given the order of the nodes, this file lists the pairs
 * of sides that contribute to each block below the diagonal. The first pair that contributes to a
 * block sets it; further pairs add to it.
 */
#include <stdlib.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/block_builder.h"

/* Returns the number of a side, with arms counted in the order of places. */
static int32_t number_of(const baum_i_block_builder *u, const baum_i_raw_side *side)
{
  return side->number >= 0 ? side->number : ~(u->arm_of[side->node] + (~side->number) % 2);
}

static baum_status add_pair(baum_i_block_builder *u, const baum_i_raw_side *x,
                            const baum_i_raw_side *y)
{
  const baum_i_elimination *order = &u->block->order;
  bool in_order = order->place[x->node] < order->place[y->node];
  const baum_i_raw_side *earlier = in_order ? x : y;
  const baum_i_raw_side *later = in_order ? y : x;
  int32_t off =
    baum_i_elimination_find(order, order->place[earlier->node], order->place[later->node]);
  int32_t k = number_of(u, earlier);
  int32_t n = number_of(u, later);
  if (k < 0 && n < 0 && !u->is_set[off]) {
    u->is_set[off] = 1;
    bool alike = (~k) % 2 == (~n) % 2;
    baum_i_pin_pair *pair = baum_i_vector_append(alike ? &u->alike : &u->opposite);
    if (pair) {
      *pair = (baum_i_pin_pair){.off = off, .arm = {~n, ~k}, .body_block = x->body_block};
    }
    return pair ? BAUM_OK : BAUM_ERR_MEMORY;
  }
  baum_i_full_pair *pair = baum_i_vector_append(u->is_set[off] ? &u->full_pairs : &u->first_pairs);
  u->is_set[off] = 1;
  if (pair) {
    *pair = (baum_i_full_pair){.off = off, .side = {n, k}, .body_block = x->body_block};
  }
  return pair ? BAUM_OK : BAUM_ERR_MEMORY;
}

static int by_off(const void *a, const void *b)
{
  /* `off` is the first member of both kinds of pair. */
  int32_t x = *(const int32_t *)a;
  int32_t y = *(const int32_t *)b;
  return (x > y) - (x < y);
}

static void sort_pairs(baum_i_vector *pairs)
{
  if (pairs->count > 1) {
    qsort(pairs->items, (size_t)pairs->count, pairs->size, by_off);
  }
}

baum_status baum_i_block_make_pairs(baum_i_block_builder *u)
{
  const baum_i_raw_side *sides = u->sides.items;
  u->is_set = baum_i_alloc((size_t)u->block->off_count, 1);
  if (!u->is_set) {
    return BAUM_ERR_MEMORY;
  }
  for (int t = 1; t < u->block->body_block_count; t++) {
    bool couples = !baum_i_block_is_fixed(u, t);
    for (int32_t i = u->sorted_start[t]; couples && i < u->sorted_start[t + 1]; i++) {
      for (int32_t k = u->sorted_start[t]; k < i; k++) {
        BAUM_I_TRY(add_pair(u, &sides[u->sorted[i]], &sides[u->sorted[k]]));
      }
    }
  }
  for (int32_t i = 0; i < u->block->off_count; i++) {
    BAUM_I_TRY(u->is_set[i] ? BAUM_OK : baum_i_vector_append_number(&u->zeros, i));
  }
  sort_pairs(&u->alike);
  sort_pairs(&u->opposite);
  sort_pairs(&u->first_pairs);
  sort_pairs(&u->full_pairs);
  return BAUM_OK;
}

baum_status baum_i_block_make_targets(baum_i_block_builder *u)
{
  baum_i_block *b = u->block;
  const baum_i_elimination *order = &b->order;
  for (int k = 0; k < b->node_count; k++) {
    const int32_t *later = order->later;
    for (int f = order->start[k] + 1; f < order->start[k + 1]; f++) {
      for (int e = order->start[k]; e < f; e++) {
        BAUM_I_TRY(baum_i_vector_append_number(&u->targets,
                                               baum_i_elimination_find(order, later[e], later[f])));
      }
    }
  }
  return BAUM_OK;
}
