/* SPDX-License-Identifier: BSD-3-Clause */
/* Plain products with the blocks of M and J. */
#include "linear/kkt.h"

void baum_i_mass_times(const baum_i_kkt_structure *structure, const double *mass, const double *x,
                       double *y)
{
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    const double *value = mass + block->value;
    for (int i = 0; i < block->size; i++) {
      double sum = 0.0;
      for (int j = 0; j < block->size; j++) {
        sum += *value++ * x[block->first + j];
      }
      y[block->first + i] += sum;
    }
  }
}

void baum_i_jacobian_times(const baum_i_kkt_structure *structure, const double *jacobian,
                           const double *x, double *y)
{
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    const double *value = jacobian + block->value;
    for (int i = 0; i < block->rows; i++) {
      double sum = 0.0;
      for (int k = 0; k < block->cols; k++) {
        sum += *value++ * x[block->col[k]];
      }
      y[block->row + i] += sum;
    }
  }
}

void baum_i_jacobian_transposed_times(const baum_i_kkt_structure *structure, const double *jacobian,
                                      const double *x, double *y)
{
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    const double *value = jacobian + block->value;
    for (int i = 0; i < block->rows; i++) {
      for (int k = 0; k < block->cols; k++) {
        y[block->col[k]] += *value++ * x[block->row + i];
      }
    }
  }
}
