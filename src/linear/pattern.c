/* SPDX-License-Identifier: BSD-3-Clause */
/* Pattern of the saddle-point matrix in compressed columns.
 *
 * All entries are first listed as (row, column) pairs. They are then thrown into buckets by column,
 * and the buckets, read in order, into lists by row, which thereby ascend. As the pattern is
 * symmetric, the list of a row is the list of the column, and repeated pairs stand side by side.
 */
#include "linear/pattern.h"

#include <string.h>

#include "base/alloc.h"

typedef struct pair_list {
  size_t count;
  int32_t *row;
  int32_t *column;
} pair_list;

static size_t count_mass_values(const baum_i_kkt_structure *structure)
{
  size_t count = 0;
  for (int b = 0; b < structure->mass_block_count; b++) {
    size_t size = (size_t)structure->mass_blocks[b].size;
    count += size * size;
  }
  return count;
}

static size_t count_row_values(const baum_i_kkt_structure *structure)
{
  size_t count = 0;
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    count += (size_t)block->rows * (size_t)block->cols;
  }
  return count;
}

static void add_pair(pair_list *pairs, int row, int column)
{
  pairs->row[pairs->count] = row;
  pairs->column[pairs->count] = column;
  pairs->count++;
}

static void list_mass(const baum_i_kkt_structure *structure, pair_list *pairs)
{
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    for (int i = 0; i < block->size; i++) {
      for (int j = 0; j < block->size; j++) {
        add_pair(pairs, block->first + i, block->first + j);
      }
    }
  }
}

static void list_jacobian(const baum_i_kkt_structure *structure, bool transposed, pair_list *pairs)
{
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    for (int i = 0; i < block->rows; i++) {
      int row = structure->nv + block->row + i;
      for (int k = 0; k < block->cols; k++) {
        if (transposed) {
          add_pair(pairs, block->col[k], row);
        } else {
          add_pair(pairs, row, block->col[k]);
        }
      }
    }
  }
}

static void list_all(const baum_i_kkt_structure *structure, pair_list *pairs)
{
  list_mass(structure, pairs);
  list_jacobian(structure, false, pairs);
  list_jacobian(structure, true, pairs);
  for (int i = 0; i < structure->nv + structure->nc; i++) {
    add_pair(pairs, i, i);
  }
}

/* start (n + 1): where the list of each key begins when pairs are gathered by key. */
static void count_by_key(const int32_t *key, size_t count, int32_t n, int32_t *start)
{
  for (size_t k = 0; k < count; k++) {
    start[key[k] + 1]++;
  }
  for (int32_t i = 0; i < n; i++) {
    start[i + 1] += start[i];
  }
}

/* Rows of the pairs, gathered by column and ascending within it.
 * `next` (n) and `bucket` (count) are scratch. */
static void gather(const pair_list *pairs, int32_t n, const int32_t *start, int32_t *next,
                   int32_t *bucket, int32_t *gathered)
{
  memcpy(next, start, (size_t)n * sizeof *next);
  for (size_t k = 0; k < pairs->count; k++) {
    bucket[next[pairs->column[k]]++] = pairs->row[k];
  }
  memcpy(next, start, (size_t)n * sizeof *next);
  for (int32_t j = 0; j < n; j++) {
    for (int32_t k = start[j]; k < start[j + 1]; k++) {
      gathered[next[bucket[k]]++] = j;
    }
  }
}

/* Take repeated rows out, in place. */
static void remove_repeated(int32_t n, int32_t *start, int32_t *row)
{
  int32_t kept = 0;
  int32_t begin = 0;
  for (int32_t j = 0; j < n; j++) {
    int32_t end = start[j + 1];
    start[j] = kept;
    for (int32_t k = begin; k < end; k++) {
      if (kept == start[j] || row[kept - 1] != row[k]) {
        row[kept++] = row[k];
      }
    }
    begin = end;
  }
  start[n] = kept;
}

static int32_t find_slot(const baum_i_pattern *pattern, int32_t row, int32_t column)
{
  int32_t low = pattern->column_start[column];
  int32_t high = pattern->column_start[column + 1] - 1;
  while (low < high) {
    int32_t middle = low + (high - low) / 2;
    if (pattern->row[middle] < row) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

static baum_status compress(const pair_list *pairs, baum_i_pattern *pattern)
{
  size_t n = (size_t)pattern->n;
  int32_t *next = baum_i_alloc(n, sizeof *next);
  int32_t *bucket = baum_i_alloc(pairs->count, sizeof *bucket);
  pattern->column_start = baum_i_alloc(n + 1, sizeof *pattern->column_start);
  pattern->row = baum_i_alloc(pairs->count, sizeof *pattern->row);
  bool ok = next && bucket && pattern->column_start && pattern->row;
  if (ok) {
    count_by_key(pairs->column, pairs->count, pattern->n, pattern->column_start);
    gather(pairs, pattern->n, pattern->column_start, next, bucket, pattern->row);
    remove_repeated(pattern->n, pattern->column_start, pattern->row);
  }
  baum_i_free(next);
  baum_i_free(bucket);
  return ok ? BAUM_OK : BAUM_ERR_MEMORY;
}

static baum_status find_slots(const pair_list *pairs, size_t mass, size_t jacobian,
                              baum_i_pattern *pattern)
{
  pattern->slot = baum_i_alloc(pairs->count, sizeof *pattern->slot);
  if (!pattern->slot) {
    return BAUM_ERR_MEMORY;
  }
  for (size_t k = 0; k < pairs->count; k++) {
    pattern->slot[k] = find_slot(pattern, pairs->row[k], pairs->column[k]);
  }
  pattern->mass = pattern->slot;
  pattern->jacobian = pattern->mass + mass;
  pattern->transposed = pattern->jacobian + jacobian;
  pattern->diagonal = pattern->transposed + jacobian;
  return BAUM_OK;
}

baum_status baum_i_pattern_create(const baum_i_kkt_structure *structure, baum_i_pattern *pattern)
{
  size_t mass = count_mass_values(structure);
  size_t jacobian = count_row_values(structure);
  size_t n = (size_t)structure->nv + (size_t)structure->nc;
  size_t count = mass + 2 * jacobian + n;
  *pattern = (baum_i_pattern){.structure = structure, .n = (int32_t)n};
  if (count > INT32_MAX) {
    return BAUM_ERR_MEMORY;
  }
  pair_list pairs = {
    .row = baum_i_alloc(count, sizeof *pairs.row),
    .column = baum_i_alloc(count, sizeof *pairs.column),
  };
  baum_status status = BAUM_ERR_MEMORY;
  if (pairs.row && pairs.column) {
    list_all(structure, &pairs);
    status = compress(&pairs, pattern);
  }
  if (status == BAUM_OK) {
    status = find_slots(&pairs, mass, jacobian, pattern);
  }
  baum_i_free(pairs.row);
  baum_i_free(pairs.column);
  if (status != BAUM_OK) {
    baum_i_pattern_clear(pattern);
  }
  return status;
}

void baum_i_pattern_clear(baum_i_pattern *pattern)
{
  baum_i_free(pattern->column_start);
  baum_i_free(pattern->row);
  baum_i_free(pattern->slot);
  *pattern = (baum_i_pattern){0};
}

static void fill_mass(const baum_i_pattern *pattern, const double *mass, const double *d,
                      double *matrix)
{
  const baum_i_kkt_structure *structure = pattern->structure;
  const int32_t *slot = pattern->mass;
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    const double *value = mass + block->value;
    for (int i = 0; i < block->size; i++) {
      for (int j = 0; j < block->size; j++) {
        matrix[*slot++] += d[block->first + i] * *value++ * d[block->first + j];
      }
    }
  }
}

static void fill_jacobian(const baum_i_pattern *pattern, const double *jacobian,
                          const double *scale, double *matrix)
{
  const baum_i_kkt_structure *structure = pattern->structure;
  const int32_t *slot = pattern->jacobian;
  const int32_t *transposed = pattern->transposed;
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    const double *value = jacobian + block->value;
    for (int i = 0; i < block->rows; i++) {
      double e = scale[structure->nv + block->row + i];
      for (int k = 0; k < block->cols; k++) {
        double scaled = e * *value++ * scale[block->col[k]];
        matrix[*slot++] += scaled;
        matrix[*transposed++] += scaled;
      }
    }
  }
}

/* -S, and 1 for a dropped row. */
static void fill_shift(const baum_i_pattern *pattern, const baum_i_kkt_values *values,
                       const double *e, double *matrix)
{
  const int32_t *slot = pattern->diagonal + pattern->structure->nv;
  for (int i = 0; i < pattern->structure->nc; i++) {
    if (e[i] == 0.0) {
      matrix[slot[i]] = 1.0;
    } else if (values->shift) {
      matrix[slot[i]] = -e[i] * values->shift[i] * e[i];
    }
  }
}

void baum_i_pattern_fill(const baum_i_pattern *pattern, const baum_i_kkt_values *values,
                         const double *scale, double *matrix)
{
  memset(matrix, 0, (size_t)pattern->column_start[pattern->n] * sizeof *matrix);
  fill_mass(pattern, values->mass, scale, matrix);
  fill_jacobian(pattern, values->jacobian, scale, matrix);
  fill_shift(pattern, values, scale + pattern->structure->nv, matrix);
}
