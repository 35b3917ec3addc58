/* SPDX-License-Identifier: BSD-3-Clause */
/* Pattern of the saddle-point matrix in compressed columns: lists all entries and compresses the
 * list. */
#include "linear/pattern.h"

#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/compress.h"
#include "linear/scale.h"

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

static void list_mass(const baum_i_kkt_structure *structure, baum_i_places *places)
{
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    for (int i = 0; i < block->size; i++) {
      for (int j = 0; j < block->size; j++) {
        baum_i_places_add(places, block->first + i, block->first + j);
      }
    }
  }
}

static void list_jacobian(const baum_i_kkt_structure *structure, bool transposed,
                          baum_i_places *places)
{
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    for (int i = 0; i < block->rows; i++) {
      int row = structure->nv + block->row + i;
      for (int k = 0; k < block->cols; k++) {
        if (transposed) {
          baum_i_places_add(places, block->col[k], row);
        } else {
          baum_i_places_add(places, row, block->col[k]);
        }
      }
    }
  }
}

static void list_all(const baum_i_kkt_structure *structure, baum_i_places *places)
{
  list_mass(structure, places);
  list_jacobian(structure, false, places);
  list_jacobian(structure, true, places);
  for (int i = 0; i < structure->nv + structure->nc; i++) {
    baum_i_places_add(places, i, i);
  }
}

static baum_status compress(const baum_i_places *places, baum_i_pattern *pattern)
{
  pattern->column_start = baum_i_alloc((size_t)pattern->n + 1, sizeof *pattern->column_start);
  pattern->row = baum_i_alloc(places->count, sizeof *pattern->row);
  pattern->slot = baum_i_alloc(places->count, sizeof *pattern->slot);
  if (!pattern->column_start || !pattern->row || !pattern->slot) {
    return BAUM_ERR_MEMORY;
  }
  BAUM_I_TRY(
    baum_i_compress(places, pattern->n, pattern->column_start, pattern->row, pattern->slot));
  pattern->scale = baum_i_alloc((size_t)pattern->n, sizeof *pattern->scale);
  pattern->matrix =
    baum_i_alloc((size_t)pattern->column_start[pattern->n], sizeof *pattern->matrix);
  return pattern->scale && pattern->matrix ? BAUM_OK : BAUM_ERR_MEMORY;
}

baum_status baum_i_pattern_create(const baum_i_kkt_structure *structure, baum_i_pattern *pattern)
{
  size_t mass = count_mass_values(structure);
  size_t jacobian = count_row_values(structure);
  size_t n = (size_t)structure->nv + (size_t)structure->nc;
  *pattern = (baum_i_pattern){.structure = structure, .n = (int32_t)n};
  baum_i_places places;
  baum_status status = baum_i_places_create(mass + 2 * jacobian + n, &places);
  if (status == BAUM_OK) {
    list_all(structure, &places);
    status = compress(&places, pattern);
  }
  baum_i_places_clear(&places);
  if (status != BAUM_OK) {
    baum_i_pattern_clear(pattern);
    return status;
  }
  pattern->mass = pattern->slot;
  pattern->jacobian = pattern->mass + mass;
  pattern->transposed = pattern->jacobian + jacobian;
  pattern->diagonal = pattern->transposed + jacobian;
  return BAUM_OK;
}

void baum_i_pattern_clear(baum_i_pattern *pattern)
{
  baum_i_free(pattern->column_start);
  baum_i_free(pattern->row);
  baum_i_free(pattern->slot);
  baum_i_free(pattern->scale);
  baum_i_free(pattern->matrix);
  *pattern = (baum_i_pattern){0};
}

static void fill_mass(const baum_i_pattern *pattern, const double *mass)
{
  const baum_i_kkt_structure *structure = pattern->structure;
  const double *d = pattern->scale;
  const int32_t *slot = pattern->mass;
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    const double *value = mass + block->value;
    for (int i = 0; i < block->size; i++) {
      for (int j = 0; j < block->size; j++) {
        pattern->matrix[*slot++] += d[block->first + i] * *value++ * d[block->first + j];
      }
    }
  }
}

static void fill_jacobian(const baum_i_pattern *pattern, const double *jacobian)
{
  const baum_i_kkt_structure *structure = pattern->structure;
  const double *scale = pattern->scale;
  const int32_t *slot = pattern->jacobian;
  const int32_t *transposed = pattern->transposed;
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    const double *value = jacobian + block->value;
    for (int i = 0; i < block->rows; i++) {
      double e = scale[structure->nv + block->row + i];
      for (int k = 0; k < block->cols; k++) {
        double scaled = e * *value++ * scale[block->col[k]];
        pattern->matrix[*slot++] += scaled;
        pattern->matrix[*transposed++] += scaled;
      }
    }
  }
}

/* -S, and 1 for an omitted row. */
static void fill_shift(const baum_i_pattern *pattern, const double *shift)
{
  const double *e = pattern->scale + pattern->structure->nv;
  const int32_t *slot = pattern->diagonal + pattern->structure->nv;
  for (int i = 0; i < pattern->structure->nc; i++) {
    if (e[i] == 0.0) {
      pattern->matrix[slot[i]] = 1.0;
    } else if (shift) {
      pattern->matrix[slot[i]] = -e[i] * shift[i] * e[i];
    }
  }
}

void baum_i_pattern_fill(baum_i_pattern *pattern, const baum_i_kkt_values *values,
                         const double *scale, double root)
{
  baum_i_scale_weigh(pattern->structure, values, scale, root, pattern->scale);
  memset(pattern->matrix, 0, (size_t)pattern->column_start[pattern->n] * sizeof *pattern->matrix);
  fill_mass(pattern, values->mass);
  fill_jacobian(pattern, values->jacobian);
  fill_shift(pattern, values->shift);
}

void baum_i_pattern_scale(const baum_i_pattern *pattern, double *x)
{
  for (int i = 0; i < pattern->n; i++) {
    x[i] *= pattern->scale[i];
  }
}
