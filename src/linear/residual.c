/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes and tests the residual of the saddle-point system.
 *
 * Componentwise backward error (W. Oettli, W. Prager 1964): x is the exact solution of a system in
 * which every number is changed by a relative amount of at most omega,
 *
 *   omega = max_i |b - K x|_i / (|K| |x| + |b|)_i .
 *
 * The residual of a row is compared with the terms of the same row, so units and masses of very
 * different size do not matter. A row whose denominator consists only of rounding errors of other
 * rows might never pass. After scaling, it is therefore compared with the largest row (M. Arioli,
 * J. Demmel, I. Duff 1989). baum_i_residual_is_rounding() does so for rows of a size up to eps^2
 * times that of the largest row, because one refinement reduces such rounding errors to this size.
 * baum_i_residual_is_noise() does so for rows up to eps times the largest row. A residual below
 * eps^2 times the largest row always passes, because some rows differ from zero only by rounding
 * and cannot be solved more accurately. The rows of a guide along an axis of the ground are an
 * example. In baum_i_residual_is_noise(), this limit is eps^2 / rcond times the largest row.
 * Refinement by QR cannot reduce the residual further, because the backward error of QR is relative
 * to the largest row (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, 12.2).
 * "The largest row" always means the largest row of the same island.
 */
#include "linear/residual.h"

#include <float.h>
#include <math.h>

#include "base/alloc.h"
#include "base/sets.h"

static const double rounding = 100.0 * DBL_EPSILON;
static const double noise = 1000.0 * DBL_EPSILON; /* times the number of rows */
static const double noise_of_noise = 1e-27;
static const double nothing = 1e-30;

/* ---- islands ---- */

baum_status baum_i_residual_islands_find(const baum_i_kkt_structure *structure,
                                         baum_i_residual_islands *out)
{
  int n = structure->nv + structure->nc;
  *out = (baum_i_residual_islands){.of = baum_i_alloc((size_t)n, sizeof *out->of)};
  if (!out->of) {
    return BAUM_ERR_MEMORY;
  }
  baum_i_sets_begin(out->of, n);
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    for (int i = 1; i < block->size; i++) {
      baum_i_sets_unite(out->of, block->first, block->first + i);
    }
  }
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    for (int i = 0; i < block->rows; i++) {
      for (int k = 0; k < block->cols; k++) {
        baum_i_sets_unite(out->of, structure->nv + block->row + i, block->col[k]);
      }
    }
  }
  out->count = baum_i_sets_number(out->of, n);
  out->largest = baum_i_alloc((size_t)out->count, sizeof *out->largest);
  return out->largest ? BAUM_OK : BAUM_ERR_MEMORY;
}

void baum_i_residual_islands_clear(const baum_i_residual_islands *islands)
{
  baum_i_free(islands->of);
  baum_i_free(islands->largest);
}

/* ---- residual ---- */

static void start_from_b(int n, const double *b, double *residual, double *size)
{
  for (int i = 0; i < n; i++) {
    residual[i] = b[i];
    size[i] = fabs(b[i]);
  }
}

static void subtract_mass(const baum_i_kkt_structure *structure, const double *mass,
                          const double *a, double *residual, double *size)
{
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    const double *value = mass + block->value;
    for (int i = block->first; i < block->first + block->size; i++) {
      for (int j = block->first; j < block->first + block->size; j++) {
        double term = *value++ * a[j];
        residual[i] -= term;
        size[i] += fabs(term);
      }
    }
  }
}

/* Subtracts the terms of one row of a block of J from the residuals of both equations. x = (a,
 * lambda). */
static void subtract_row(const baum_i_row_block *block, const double *value, int row,
                         const double *x, double *residual, double *size)
{
  double sum = 0.0;
  double sum_size = 0.0;
  for (int k = 0; k < block->cols; k++) {
    int column = block->col[k];
    double term = value[k] * x[column];
    sum += term;
    sum_size += fabs(term);
    double force = value[k] * x[row];
    residual[column] -= force;
    size[column] += fabs(force);
  }
  residual[row] -= sum;
  size[row] += sum_size;
}

static void subtract_jacobian(const baum_i_kkt_structure *structure, const double *jacobian,
                              const double *x, double *residual, double *size)
{
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    for (int i = 0; i < block->rows; i++) {
      const double *value = jacobian + block->value + (ptrdiff_t)i * block->cols;
      subtract_row(block, value, structure->nv + block->row + i, x, residual, size);
    }
  }
}

static void add_shift(int nc, const double *shift, const double *lambda, double *residual,
                      double *size)
{
  for (int i = 0; i < nc; i++) {
    double term = shift[i] * lambda[i];
    residual[i] += term;
    size[i] += fabs(term);
  }
}

static void clear_omitted(int nc, const unsigned char *omitted, double *residual, double *size)
{
  for (int i = 0; i < nc; i++) {
    if (omitted[i]) {
      residual[i] = 0.0;
      size[i] = 0.0;
    }
  }
}

void baum_i_residual_form(const baum_i_kkt_structure *structure, const baum_i_kkt_values *values,
                          const double *b, const double *x, double *residual, double *size)
{
  int nv = structure->nv;
  start_from_b(nv + structure->nc, b, residual, size);
  subtract_mass(structure, values->mass, x, residual, size);
  subtract_jacobian(structure, values->jacobian, x, residual, size);
  if (values->shift) {
    add_shift(structure->nc, values->shift, x + nv, residual + nv, size + nv);
  }
  if (values->omitted) {
    clear_omitted(structure->nc, values->omitted, residual + nv, size + nv);
  }
}

void baum_i_residual_largest(int n, const baum_i_residual_islands *islands, const double *scale,
                             const double *size)
{
  for (int k = 0; k < islands->count; k++) {
    islands->largest[k] = 0.0;
  }
  for (int i = 0; i < n; i++) {
    double *largest = &islands->largest[islands->of[i]];
    *largest = fmax(*largest, scale[i] * fabs(size[i]));
  }
}

/* Tests the residual. Rows of scaled size up to `negligible` times the size of the largest row of
 * their island are compared with this row. A residual of at most `least` times the largest row
 * always passes. */
static bool is_rounding(int n, const baum_i_residual_islands *islands, const double *scale,
                        const double *residual, const double *size, double negligible, double least)
{
  bool found = false;
  for (int i = 0; i < n; i++) {
    if (fabs(residual[i]) <= rounding * size[i]) {
      continue;
    }
    if (!found) {
      baum_i_residual_largest(n, islands, scale, size);
      found = true;
    }
    double largest = islands->largest[islands->of[i]];
    bool is_negligible = scale[i] * size[i] <= negligible * largest;
    double most = is_negligible ? rounding : least;
    if (!(scale[i] * fabs(residual[i]) <= most * largest)) {
      return false;
    }
  }
  return true;
}

bool baum_i_residual_is_rounding(int n, const baum_i_residual_islands *islands, const double *scale,
                                 const double *residual, const double *size)
{
  return is_rounding(n, islands, scale, residual, size, noise_of_noise, nothing);
}

bool baum_i_residual_is_noise(int n, const baum_i_residual_islands *islands, const double *scale,
                              const double *residual, const double *size, double rcond)
{
  return is_rounding(n, islands, scale, residual, size, n * noise, fmin(nothing / rcond, rounding));
}

bool baum_i_residual_is_below(int n, const baum_i_residual_islands *islands, const double *scale,
                              const double *residual, const double *b, double tolerance)
{
  baum_i_residual_largest(n, islands, scale, b);
  for (int i = 0; i < n; i++) {
    if (!(scale[i] * fabs(residual[i]) <= tolerance * islands->largest[islands->of[i]])) {
      return false;
    }
  }
  return true;
}
