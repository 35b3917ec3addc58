/* SPDX-License-Identifier: BSD-3-Clause */
/* A solver by blocks: its memory, masses and forces. Structure is block_structure.c, arithmetic
 * block_hot.c. */
#include "linear/block.h"

#include <math.h>

#include "base/alloc.h"
#include "linear/block_structure.h"

/* ---- memory ---- */

/* An array and how many numbers it has. */
typedef struct array {
  double **place;
  size_t count;
} array;

enum { ARRAY_COUNT = 18, LINE = 8 /* numbers in a cache line */ };

static void list_arrays(baum_i_block *b, array list[ARRAY_COUNT])
{
  size_t triples = (size_t)b->triple_count;
  size_t nodes = (size_t)b->node_count;
  const array all[ARRAY_COUNT] = {
    {&b->weight, 4 * triples},
    {&b->mass, 4 * triples},
    {&b->force, 4 * triples},
    {&b->free, 4 * triples},
    {&b->motion, 4 * triples},
    {&b->pull, 4 * triples},
    {&b->pull_low, 4 * triples},
    {&b->arm, 4 * (size_t)b->pin_count},
    {&b->side, 6 * (size_t)b->side_count},
    {&b->right, 2 * nodes},
    {&b->size, nodes},
    {&b->pivot, 3 * nodes},
    {&b->off, 4 * (size_t)b->off_count},
    {&b->lambda, 2 * nodes},
    {&b->rest, 2 * nodes},
    {&b->rest_low, 2 * nodes},
    {&b->factor, (size_t)b->factor_size},
    {&b->work, 4 * (size_t)b->most_later},
  };
  for (int i = 0; i < ARRAY_COUNT; i++) {
    list[i] = all[i];
  }
}

/* One arena. Every array begins on a cache line, and each a line further into its page than the one
 * before, lest all of them fall on the same sets of the cache. */
static size_t padded(size_t count)
{
  enum { PAGE = 512 };
  size_t lines = (count + LINE - 1) / LINE * LINE;
  return lines % PAGE == 0 ? lines + LINE : lines;
}

static baum_status make_arrays(baum_i_block *b)
{
  array list[ARRAY_COUNT];
  list_arrays(b, list);
  size_t sum = LINE;
  for (int i = 0; i < ARRAY_COUNT; i++) {
    sum += padded(list[i].count);
  }
  b->numbers = baum_i_alloc(sum, sizeof *b->numbers);
  if (!b->numbers) {
    return BAUM_ERR_MEMORY;
  }
  size_t over = (uintptr_t)b->numbers / sizeof(double) % LINE;
  double *next = b->numbers + (over > 0 ? LINE - over : 0);
  for (int i = 0; i < ARRAY_COUNT; i++) {
    *list[i].place = next;
    next += padded(list[i].count);
  }
  return BAUM_OK;
}

/* Over y = L^T a masses and weights are one. */
static void set_dense_weights(baum_i_block *b)
{
  for (int i = 0; i < b->dense_count; i++) {
    int size = b->structure->mass_blocks[b->dense[i].mass_block].size;
    for (int c = 0; c < size; c++) {
      int at = 4 * (b->dense[i].triple + c / 3) + c % 3;
      b->weight[at] = 1.0;
      b->mass[at] = 1.0;
    }
  }
}

baum_status baum_i_block_create(const baum_i_block_layout *layout, baum_i_block **out)
{
  *out = NULL;
  baum_i_block *b = baum_i_alloc(1, sizeof *b);
  if (!b) {
    return BAUM_ERR_MEMORY;
  }
  b->structure = layout->structure;
  baum_status status = baum_i_block_find_structure(layout, b);
  if (status == BAUM_OK) {
    status = make_arrays(b);
  }
  if (status != BAUM_OK) {
    baum_i_block_destroy(b);
    return status;
  }
  set_dense_weights(b);
  *out = b;
  return BAUM_OK;
}

void baum_i_block_destroy(baum_i_block *block)
{
  if (!block) {
    return;
  }
  const void *arrays[] = {block->pins,         block->fulls,    block->side_triple, block->entries,
                          block->alike,        block->opposite, block->full_pairs,  block->zeros,
                          block->target_start, block->target,   block->column,      block->dense,
                          block->dense_sides,  block->numbers};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
    baum_i_free(arrays[i]);
  }
  baum_i_elimination_clear(&block->order);
  baum_i_free(block);
}

/* ---- masses ---- */

bool baum_i_block_set_mass(baum_i_block *block, const double *mass)
{
  bool positive = true;
  for (int i = 0; i < block->structure->mass_block_count; i++) {
    const baum_i_mass_block *body = &block->structure->mass_blocks[i];
    for (int c = 0; c < block->width[1 + i]; c++) {
      double m = mass[body->value + c * body->size + c];
      positive = positive && m > 0.0;
      block->mass[4 * (1 + i) + c] = m;
      block->weight[4 * (1 + i) + c] = 1.0 / m;
    }
  }
  return positive;
}

/* L of M = L L^T (A.-L. Cholesky), row by row. */
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
        /* What is left of the diagonal after much cancellation is noise. */
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

/* ---- forces and motion ---- */

/* Component i of a dense body in an array of triples. */
static double *component(const baum_i_dense_body *dense, double *x, int i)
{
  return &x[4 * (dense->triple + i / 3) + i % 3];
}

/* L y = f */
static void set_dense_force(baum_i_block *block, const baum_i_dense_body *dense,
                            const double *force)
{
  const baum_i_mass_block *body = &block->structure->mass_blocks[dense->mass_block];
  const double *l = block->factor + dense->factor;
  int n = body->size;
  for (int i = 0; i < n; i++) {
    double sum = force[body->first + i];
    for (int k = 0; k < i; k++) {
      sum -= l[i * n + k] * *component(dense, block->free, k);
    }
    double y = sum / l[i * n + i];
    *component(dense, block->free, i) = y;
    *component(dense, block->force, i) = y;
  }
}

void baum_i_block_set_force(baum_i_block *block, const double *force)
{
  int diagonal = block->structure->mass_block_count;
  for (int t = 1; t <= diagonal; t++) {
    for (int c = 0; c < block->width[t]; c++) {
      double f = force[block->column[t] + c];
      block->force[4 * t + c] = f;
      block->free[4 * t + c] = block->weight[4 * t + c] * f;
    }
  }
  for (int i = 0; i < block->dense_count; i++) {
    set_dense_force(block, &block->dense[i], force);
  }
}

/* L^T a = y */
static void get_dense_motion(const baum_i_block *block, const baum_i_dense_body *dense, double *a)
{
  const baum_i_mass_block *body = &block->structure->mass_blocks[dense->mass_block];
  const double *l = block->factor + dense->factor;
  int n = body->size;
  for (int i = n - 1; i >= 0; i--) {
    double sum = *component(dense, block->motion, i);
    for (int k = i + 1; k < n; k++) {
      sum -= l[k * n + i] * a[body->first + k];
    }
    a[body->first + i] = sum / l[i * n + i];
  }
}

void baum_i_block_get_motion(const baum_i_block *block, double *a)
{
  int diagonal = block->structure->mass_block_count;
  for (int t = 1; t <= diagonal; t++) {
    for (int c = 0; c < block->width[t]; c++) {
      a[block->column[t] + c] = block->motion[4 * t + c];
    }
  }
  for (int i = 0; i < block->dense_count; i++) {
    get_dense_motion(block, &block->dense[i], a);
  }
}
