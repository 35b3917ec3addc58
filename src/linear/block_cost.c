/* SPDX-License-Identifier: BSD-3-Clause */
/* Cost of a solution by blocks: counts of what block_hot.c and block_sides_hot.c do for one node, side,
 * pair or coupling, times how many there are.
 */
#include "linear/block_cost.h"

static const double NUMBER = sizeof(double);
static const double INDEX = sizeof(int32_t);

/* Flops, function by function. */
enum {
  SET_ROW = 6,       /* Phi' and r */
  SET_SIDE = 54,     /* 12 of J v, 30 of the pivot, 12 of J a0 */
  SCATTER_SIDE = 15, /* motion -= W G^T lambda */
  SCATTER_PIN = 18,
  PIN_PAIR = 9,
  FULL_PAIR = 30,
  MIXED_PAIR = 16, /* of a full side with a pin's */
  PIVOT = 14,      /* 6 of det D and its judgement, 8 of D^-1 r */
  COUPLING = 46,   /* U 12, U X^T 12, U r 6, three updates 12, L 4 */
  BACKWARD = 8,    /* of a coupling */
  TARGET = 16,
};

double baum_i_block_target_count(const baum_i_block *block)
{
  double count = 0.0;
  for (int k = 0; k < block->node_count; k++) {
    double later = block->order.start[k + 1] - block->order.start[k];
    count += later * (later - 1.0) / 2.0;
  }
  return count;
}

static double full_rows(const baum_i_block *block)
{
  double count = 0.0;
  for (int i = 0; i < block->full_count; i++) {
    count += (block->fulls[i].row[0] >= 0 ? 1 : 0) + (block->fulls[i].row[1] >= 0 ? 1 : 0);
  }
  return count;
}

/* L y = f, L^T a = y, and G^T on both sides of each node. */
static baum_i_cost cost_of_dense(const baum_i_block *block)
{
  baum_i_cost cost = {0};
  for (int i = 0; i < block->dense_count; i++) {
    double n = block->structure->mass_blocks[block->dense[i].mass_block].size;
    cost.flops += 2.0 * n * n;
    cost.bytes += (double)sizeof *block->dense + NUMBER * n * n;
  }
  for (int i = 0; i < block->dense_side_count; i++) {
    const baum_i_dense_body *body = &block->dense[block->dense_sides[i].body];
    double n = block->structure->mass_blocks[body->mass_block].size;
    cost.flops += 2.0 * n * n;
    cost.bytes += (double)sizeof *block->dense_sides;
  }
  return cost;
}

/* Of full sides, with each other or with a pin's. */
static double flops_of_pairs(const baum_i_full_pair *pairs, int count)
{
  double flops = 0.0;
  for (int i = 0; i < count; i++) {
    bool mixed = (pairs[i].side[0] < 0) != (pairs[i].side[1] < 0);
    flops += mixed ? MIXED_PAIR : FULL_PAIR;
  }
  return flops;
}

static double count_flops(const baum_i_block *b)
{
  double couplings = b->off_count;
  double pin_pairs = (double)b->alike_count + b->opposite_count;
  double full_pairs = flops_of_pairs(b->first_pairs, b->first_count) +
                      flops_of_pairs(b->full_pairs, b->full_pair_count);
  return SET_ROW * full_rows(b) + (SET_SIDE + SCATTER_SIDE) * (double)b->side_count +
         b->full_count + SCATTER_PIN * (double)b->pin_count + PIN_PAIR * pin_pairs + full_pairs +
         PIVOT * (double)b->node_count + (COUPLING + BACKWARD) * couplings +
         TARGET * baum_i_block_target_count(b);
}

static double count_bytes(const baum_i_block *b)
{
  double pins = (double)sizeof *b->pins + NUMBER * 8.0; /* arms and weights */
  double nodes = (double)sizeof *b->nodes + NUMBER * 2.0 + INDEX * 2.0;
  double sides = NUMBER * 6.0 + INDEX * 3.0;
  double entries = (double)sizeof *b->entries + NUMBER;
  double rows = NUMBER * 5.0; /* Phi, Phi', nu, gamma, lambda */
  double couplings = NUMBER * 4.0 + INDEX;
  double motion = NUMBER * 2.0 * b->motion_size + (NUMBER * 2.0 + INDEX) * b->body_block_count;
  return pins * b->pin_count + nodes * b->node_count + sides * b->side_count +
         entries * b->entry_count + rows * full_rows(b) + couplings * b->off_count +
         INDEX * (baum_i_block_target_count(b) + b->zero_count) + motion +
         (double)sizeof *b->fulls * b->full_count +
         (double)sizeof *b->alike * ((double)b->alike_count + b->opposite_count) +
         (double)sizeof *b->full_pairs * ((double)b->first_count + b->full_pair_count);
}

baum_i_cost baum_i_block_cost(const baum_i_block *block)
{
  baum_i_cost cost = cost_of_dense(block);
  cost.flops += count_flops(block);
  cost.bytes += count_bytes(block);
  return cost;
}
