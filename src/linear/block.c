/* SPDX-License-Identifier: BSD-3-Clause */
/* Block solver: memory and masses. block_structure.c finds the structure, and block_hot.c factors
 * and solves. */
#include "linear/block.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "linear/arrays.h"
#include "linear/block_builder.h"

/* For the pivot D (S = L D L^T) of a node, the solver computes the ratio of det D to the product of
 * the diagonal entries of S at this node. The result is refined if the ratio of any node is below
 * weak_pivot. The relative error of the multipliers is about the unit rounding divided by this
 * ratio, and the errors of several small pivots multiply. In long ladder-like mechanisms, pivots
 * decrease with the number of nodes although the system is well-conditioned. With more than
 * many_nodes nodes the limit is therefore lower. */
static const double weak_pivot = 1e-3;
static const double many_nodes = 128.0;

/* ---- memory ---- */

static baum_status make_arrays(baum_i_block *b)
{
  size_t motion = (size_t)b->motion_size;
  size_t nodes = (size_t)b->node_count;
  size_t pins = baum_i_even((size_t)b->pin_count);
  const baum_i_array arrays[] = {
    {&b->nodes, sizeof(baum_i_node) / sizeof(double) * nodes},
    {&b->weight, 2 * (size_t)b->body_block_count},
    {&b->free, motion},
    {&b->motion, motion},
    {&b->response, motion},
    {&b->arm, 4 * pins},
    {&b->pin_weight, 4 * pins},
    {&b->side, 6 * (size_t)b->side_count},
    {&b->right, 2 * nodes},
    {&b->off, 4 * (size_t)b->off_count},
    {&b->factor, (size_t)b->factor_size},
    {&b->mass, motion},
    {&b->force, motion},
    {&b->pull, motion},
    {&b->pull_low, motion},
    {&b->rest, 2 * nodes},
    {&b->rest_low, 2 * nodes},
    {&b->nothing, motion},
  };
  b->numbers = baum_i_arrays_create(arrays, sizeof arrays / sizeof *arrays);
  return b->numbers ? BAUM_OK : BAUM_ERR_MEMORY;
}

/* Dense bodies use y = L^T a in place of a, so their M and W are identities. */
static void set_dense_weights(baum_i_block *b)
{
  for (int t = 1 + b->structure->mass_block_count; t < b->body_block_count; t++) {
    b->weight[2 * t] = 1.0;
    b->weight[2 * t + 1] = 1.0;
    for (int c = 0; c < 3; c++) {
      b->mass[b->place[t] + c] = 1.0;
      b->response[b->place[t] + c] = 1.0;
    }
  }
}

static baum_status mark_fixed(const baum_i_block_layout *layout, baum_i_block *b)
{
  size_t bodies = (size_t)layout->structure->mass_block_count;
  b->fixed = layout->fixed ? baum_i_copy(layout->fixed, bodies, 1) : baum_i_alloc(bodies, 1);
  return b->fixed ? BAUM_OK : BAUM_ERR_MEMORY;
}

baum_status baum_i_block_create(const baum_i_block_layout *layout, int *hub, baum_i_block **out)
{
  *out = NULL;
  baum_i_block *b = baum_i_alloc(1, sizeof *b);
  if (!b) {
    return BAUM_ERR_MEMORY;
  }
  b->structure = layout->structure;
  b->hub = -1;
  baum_status status = mark_fixed(layout, b);
  if (status == BAUM_OK) {
    status = baum_i_block_find_structure(layout, b);
  }
  if (hub) {
    *hub = b->hub;
  }
  if (status == BAUM_OK) {
    status = make_arrays(b);
  }
  if (status != BAUM_OK) {
    baum_i_block_destroy(b);
    return status;
  }
  double few = fmin(1.0, many_nodes / fmax(1.0, b->node_count));
  b->weak_pivot = weak_pivot * few * sqrt(few);
  set_dense_weights(b);
  baum_i_block_use_force(b, true);
  *out = b;
  return BAUM_OK;
}

void baum_i_block_destroy(baum_i_block *block)
{
  if (!block) {
    return;
  }
  const void *arrays[] = {
    block->pins,  block->fulls,       block->side_body_block, block->entries,
    block->alike, block->opposite,    block->first_pairs,     block->full_pairs,
    block->zeros, block->target,      block->place,           block->side_from,
    block->dense, block->dense_sides, block->fixed,           block->numbers};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
    baum_i_free(arrays[i]);
  }
  baum_i_elimination_clear(&block->order);
  baum_i_free(block);
}

/* ---- masses ---- */

/* Sets W and M of all bodies. The values written for dense bodies are not used. */
bool baum_i_block_set_mass(baum_i_block *block, const double *mass)
{
  bool positive = true;
  for (int i = 0; i < block->structure->mass_block_count; i++) {
    const baum_i_mass_block *body = &block->structure->mass_blocks[i];
    for (int c = 0; c < body->size; c++) {
      double m = mass[body->value + c * body->size + c];
      double weight = block->fixed[i] ? 0.0 : 1.0 / m;
      positive = positive && m > 0.0;
      block->mass[body->first + c] = block->fixed[i] ? 0.0 : m;
      block->response[body->first + c] = weight;
      block->weight[2 * (1 + i) + (c < 2 ? 0 : 1)] = weight;
    }
  }
  for (size_t i = 0; i < baum_i_even((size_t)block->pin_count); i++) {
    double *to = block->pin_weight + 4 * i;
    memcpy(to, block->weight + 2 * (size_t)block->pins[i].body_block[0], 2 * sizeof *to);
    memcpy(to + 2, block->weight + 2 * (size_t)block->pins[i].body_block[1], 2 * sizeof *to);
  }
  return positive;
}

/* Computes the Cholesky factor L of M = L L^T, row by row. */
static bool factor_one(const double *m, int n, double *l)
{
  bool positive = true;
  for (int i = 0; i < n; i++) {
    for (int j = 0; j <= i; j++) {
      double sum = m[i * n + j];
      for (int k = 0; k < j; k++) {
        sum -= l[i * n + k] * l[j * n + k];
      }
      if (i == j) {
        /* A sum below this limit is only a rounding error left by cancellation. */
        positive = positive && sum > 1e-14 * m[i * n + i];
        l[i * n + i] = sqrt(sum);
      } else {
        l[i * n + j] = sum / l[j * n + j];
      }
    }
  }
  return positive;
}

bool baum_i_block_factor_dense(baum_i_block *block, const double *mass)
{
  bool positive = true;
  for (int i = 0; i < block->dense_count; i++) {
    const baum_i_dense_body *dense = &block->dense[i];
    const baum_i_mass_block *body = &block->structure->mass_blocks[dense->mass_block];
    positive =
      factor_one(mass + body->value, body->size, block->factor + dense->factor) && positive;
  }
  return positive;
}
