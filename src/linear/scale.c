/* SPDX-License-Identifier: BSD-3-Clause */
/* Scaling by powers of two. */
#include "linear/scale.h"

#include <math.h>
#include <string.h>

/* Fields of a double. EXPONENT_LIMIT is the largest exponent of the scales; with this limit, they
 * neither overflow nor become subnormal. */
enum { EXPONENT_BIAS = 1023, EXPONENT_BITS = 52, EXPONENT_MASK = 0x7ff, EXPONENT_LIMIT = 1000 };

/* floor(log2(x)) of a finite x > 0. */
static int exponent_of(double x)
{
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return (int)(bits >> EXPONENT_BITS & EXPONENT_MASK) - EXPONENT_BIAS;
}

static double power_of_two(int exponent)
{
  if (exponent > EXPONENT_LIMIT) {
    exponent = EXPONENT_LIMIT;
  }
  if (exponent < -EXPONENT_LIMIT) {
    exponent = -EXPONENT_LIMIT;
  }
  uint64_t bits = (uint64_t)(exponent + EXPONENT_BIAS) << EXPONENT_BITS;
  double power;
  memcpy(&power, &bits, sizeof power);
  return power;
}

static double inverse(double x)
{
  return power_of_two(-exponent_of(x));
}

static double inverse_root(double x)
{
  int exponent = exponent_of(x);
  return power_of_two(-(exponent - (exponent & 1)) / 2);
}

/* In the functions below, a scale of 0 means that the scale is not yet known. */

static void scale_velocities(const baum_i_kkt_structure *structure, const double *mass, double *d)
{
  for (int j = 0; j < structure->nv; j++) {
    d[j] = 0.0;
  }
  for (int b = 0; b < structure->mass_block_count; b++) {
    const baum_i_mass_block *block = &structure->mass_blocks[b];
    const double *diagonal = mass + block->value;
    for (int j = 0; j < block->size; j++) {
      double size = fabs(diagonal[(ptrdiff_t)j * (block->size + 1)]);
      d[block->first + j] = size > 0.0 ? inverse_root(size) : 0.0;
    }
  }
}

/* Raises largest[i] to the largest scaled entry of row i in columns with a known scale. */
static void measure_rows(const baum_i_kkt_structure *structure, const double *jacobian,
                         const double *d, double *largest)
{
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    const double *value = jacobian + block->value;
    for (int i = 0; i < block->rows; i++) {
      double *row = &largest[block->row + i];
      for (int k = 0; k < block->cols; k++) {
        double size = fabs(*value++) * d[block->col[k]];
        *row = size > *row ? size : *row;
      }
    }
  }
}

static void scale_constraints(const baum_i_kkt_structure *structure,
                              const baum_i_kkt_values *values, const double *d, double *e)
{
  for (int i = 0; i < structure->nc; i++) {
    e[i] = values->shift ? sqrt(fabs(values->shift[i])) : 0.0;
  }
  measure_rows(structure, values->jacobian, d, e);
  for (int i = 0; i < structure->nc; i++) {
    e[i] = e[i] > 0.0 ? inverse(e[i]) : 0.0;
  }
}

/* Sets d of each column without a known scale to minus its largest scaled entry. */
static void measure_massless(const baum_i_kkt_structure *structure, const double *jacobian,
                             const double *e, double *d)
{
  for (int b = 0; b < structure->row_block_count; b++) {
    const baum_i_row_block *block = &structure->row_blocks[b];
    const double *value = jacobian + block->value;
    for (int i = 0; i < block->rows; i++) {
      for (int k = 0; k < block->cols; k++) {
        double *column = &d[block->col[k]];
        double size = fabs(*value++) * e[block->row + i];
        *column = *column <= 0.0 && -size < *column ? -size : *column;
      }
    }
  }
}

/* Finds scales of velocities without mass from the rows in which they occur. Returns true if it
 * found any. */
static bool spread_scales(const baum_i_kkt_structure *structure, const double *jacobian,
                          const double *e, double *d)
{
  bool found = false;
  measure_massless(structure, jacobian, e, d);
  for (int j = 0; j < structure->nv; j++) {
    if (d[j] < 0.0) {
      d[j] = inverse(-d[j]);
      found = true;
    }
  }
  return found;
}

static bool any_unknown(const double *scale, int n)
{
  for (int i = 0; i < n; i++) {
    if (scale[i] == 0.0) {
      return true;
    }
  }
  return false;
}

static void replace_unknown(double *scale, int n)
{
  for (int i = 0; i < n; i++) {
    scale[i] = scale[i] == 0.0 ? 1.0 : scale[i];
  }
}

void baum_i_scale_compute(const baum_i_kkt_structure *structure, const baum_i_kkt_values *values,
                          double *scale)
{
  double *d = scale;
  double *e = scale + structure->nv;
  scale_velocities(structure, values->mass, d);
  scale_constraints(structure, values, d, e);
  if (any_unknown(d, structure->nv)) {
    while (spread_scales(structure, values->jacobian, e, d)) {
      scale_constraints(structure, values, d, e);
    }
    replace_unknown(d, structure->nv);
    scale_constraints(structure, values, d, e);
  }
  replace_unknown(e, structure->nc);
  for (int i = 0; i < structure->nc; i++) {
    if (values->omitted && values->omitted[i]) {
      e[i] = 0.0;
    }
  }
}

void baum_i_scale_weigh(const baum_i_kkt_structure *structure, const baum_i_kkt_values *values,
                        const double *scale, double root, double *weighted)
{
  int nv = structure->nv;
  for (int j = 0; j < nv; j++) {
    weighted[j] = scale[j] * root;
  }
  for (int i = 0; i < structure->nc; i++) {
    double shift = values->shift ? fabs(values->shift[i]) : 0.0;
    double wanted = scale[nv + i] / root;
    weighted[nv + i] = shift > 0.0 ? fmin(wanted, inverse_root(shift)) : wanted;
  }
}
