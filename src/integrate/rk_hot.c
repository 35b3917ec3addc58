/* SPDX-License-Identifier: BSD-3-Clause */
/* Linear combinations of rates. A loop computes BAUM_I_RK_LANES coordinates at a time, so that
 * their sums stay in registers. It skips weights that are zero, which are frequent in tables of
 * high order. */
#include "base/hot.h"
#include "integrate/rk_kernel.h"

enum { LANES = BAUM_I_RK_LANES };

BAUM_I_INLINE void add_up(int n, int count, const double *weights, const double *rates,
                          double sum[LANES])
{
  for (int k = 0; k < LANES; k++) {
    sum[k] = 0.0;
  }
  for (int j = 0; j < count; j++, rates += n) {
    double weight = weights[j];
    if (weight == 0.0) {
      continue;
    }
    for (int k = 0; k < LANES; k++) {
      sum[k] += weight * rates[k];
    }
  }
}

static void combine(int n, int count, const double *weights, double h, const double *rates,
                    const double *base, double *out)
{
  for (int i = 0; i < n; i += LANES) {
    double sum[LANES];
    add_up(n, count, weights, rates + i, sum);
    for (int k = 0; k < LANES; k++) {
      out[i + k] = base[i + k] + h * sum[k];
    }
  }
}

static double square(int n, int count, const double *weights, const double *rates,
                     const double *scale)
{
  double squares[LANES] = {0.0};
  for (int i = 0; i < n; i += LANES) {
    double part[LANES];
    add_up(n, count, weights, rates + i, part);
    for (int k = 0; k < LANES; k++) {
      part[k] *= scale[i + k];
      squares[k] += part[k] * part[k];
    }
  }
  double sum = 0.0;
  for (int k = 0; k < LANES; k++) {
    sum += squares[k];
  }
  return sum;
}

const baum_i_rk_kernel BAUM_I_HOT(baum_i_rk_kernel) = {.combine = combine, .square = square};
