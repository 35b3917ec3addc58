/* SPDX-License-Identifier: BSD-3-Clause */
/* Linear combinations of rates. A loop computes BAUM_I_RK_LANES coordinates at a time, so that
 * their sums stay in registers. It skips weights that are zero, which are frequent in tables of
 * high order. */
#include <stddef.h>

#include "base/four.h"
#include "integrate/rk_kernel.h"

enum { LANES = BAUM_I_RK_LANES };

typedef struct lanes {
  baum_i_four low;
  baum_i_four high;
} lanes;

BAUM_I_INLINE lanes load(const double *from)
{
  return (lanes){baum_i_four_load(from), baum_i_four_load(from + LANES / 2)};
}

BAUM_I_INLINE void store(double *to, lanes x)
{
  baum_i_four_store(to, x.low);
  baum_i_four_store(to + LANES / 2, x.high);
}

/* sum + x s */
BAUM_I_INLINE lanes add(lanes sum, lanes x, double s)
{
  return (lanes){baum_i_four_add(sum.low, x.low, s), baum_i_four_add(sum.high, x.high, s)};
}

BAUM_I_INLINE lanes add_up(int n, int count, const double *weights, const double *rates)
{
  lanes sum = {baum_i_four_all(0.0), baum_i_four_all(0.0)};
  for (int j = 0; j < count; j++, rates += n) {
    if (weights[j] != 0.0) {
      sum = add(sum, load(rates), weights[j]);
    }
  }
  return sum;
}

static void combine(int n, int count, const double *weights, double h, const double *rates,
                    const double *base, double *out)
{
  for (int i = 0; i < n; i += LANES) {
    store(out + i, add(load(base + i), add_up(n, count, weights, rates + i), h));
  }
}

/* (sum + x) s. The product is not fused with the next sum. Both compilations of this file
 * (base/hot.h) therefore give the same result. */
BAUM_I_INLINE baum_i_four nest(baum_i_four sum, const double *x, double s)
{
  sum = baum_i_four_plus(sum, baum_i_four_load(x));
  return baum_i_four_rounded(baum_i_four_times(sum, baum_i_four_all(s)));
}

static void interpolate(int n, int count, double x, const double *terms, const double *base,
                        double *out)
{
  const double factors[2] = {x, 1.0 - x};
  for (int i = 0; i < n; i += LANES / 2) {
    baum_i_four sum = baum_i_four_all(0.0);
    for (int k = count - 1; k >= 0; k--) {
      sum = nest(sum, terms + (ptrdiff_t)k * n + i, factors[k % 2]);
    }
    baum_i_four_store(out + i, baum_i_four_plus(baum_i_four_load(base + i), sum));
  }
}

/* sum + (part scale)^2 */
BAUM_I_INLINE baum_i_four add_square(baum_i_four sum, baum_i_four part, const double *scale)
{
  baum_i_four x = baum_i_four_times(part, baum_i_four_load(scale));
  return baum_i_four_plus(sum, baum_i_four_times(x, x));
}

static double square(int n, int count, const double *weights, const double *rates,
                     const double *scale)
{
  lanes squares = {baum_i_four_all(0.0), baum_i_four_all(0.0)};
  for (int i = 0; i < n; i += LANES) {
    lanes part = add_up(n, count, weights, rates + i);
    squares.low = add_square(squares.low, part.low, scale + i);
    squares.high = add_square(squares.high, part.high, scale + i + LANES / 2);
  }
  double all[LANES];
  store(all, squares);
  double sum = 0.0;
  for (int k = 0; k < LANES; k++) {
    sum += all[k];
  }
  return sum;
}

const baum_i_rk_kernel BAUM_I_HOT(baum_i_rk_kernel) = {
  .combine = combine, .interpolate = interpolate, .square = square};
