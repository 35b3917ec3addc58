/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the pattern of the saddle-point matrix in compressed columns from a list of all entries. */
#include "linear/pattern.h"

#include <string.h>

#include "base/alloc.h"
#include "base/message.h"
#include "linear/scale.h"

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

baum_status baum_i_pattern_create(const baum_i_kkt_structure *structure, baum_i_pattern *pattern)
{
  int32_t n = structure->nv + structure->nc;
  baum_i_places places = {0};
  list_mass(structure, &places);
  size_t mass = places.count;
  list_jacobian(structure, false, &places);
  size_t jacobian = places.count;
  list_jacobian(structure, true, &places);
  size_t transposed = places.count;
  for (int32_t i = 0; i < n; i++) {
    baum_i_places_add(&places, i, i);
  }
  *pattern = (baum_i_pattern){.structure = structure, .n = n};
  BAUM_I_TRY(baum_i_compress(&places, n, &pattern->columns));
  pattern->scale = baum_i_alloc((size_t)n, sizeof *pattern->scale);
  pattern->matrix = baum_i_alloc((size_t)pattern->columns.start[n], sizeof *pattern->matrix);
  if (!pattern->scale || !pattern->matrix) {
    baum_i_pattern_clear(pattern);
    return BAUM_ERR_MEMORY;
  }
  pattern->mass = pattern->columns.slot;
  pattern->jacobian = pattern->mass + mass;
  pattern->transposed = pattern->mass + jacobian;
  pattern->diagonal = pattern->mass + transposed;
  return BAUM_OK;
}

void baum_i_pattern_clear(baum_i_pattern *pattern)
{
  baum_i_compressed_clear(&pattern->columns);
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

/* Sets the diagonal of the constraint rows: 1 for an omitted row, -S for the others. */
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
  memset(pattern->matrix, 0, (size_t)pattern->columns.start[pattern->n] * sizeof *pattern->matrix);
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
