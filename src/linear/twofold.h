/* SPDX-License-Identifier: BSD-3-Clause */
/* Sums in twice the working precision (T. Ogita, S. M. Rump, S. Oishi, 2005, Dot2). */
#ifndef BAUM_I_LINEAR_TWOFOLD_H
#define BAUM_I_LINEAR_TWOFOLD_H

#include <math.h>

/* An unevaluated sum of two numbers. */
typedef struct baum_i_twofold {
  double high;
  double low;
} baum_i_twofold;

static inline void baum_i_twofold_add(baum_i_twofold *sum, double x)
{
  double high = sum->high + x;
  double moved = high - sum->high;
  sum->low += (sum->high - (high - moved)) + (x - moved);
  sum->high = high;
}

static inline void baum_i_twofold_subtract_product(baum_i_twofold *sum, double x, double y)
{
  double product = x * y;
#ifdef BAUM_I_WIDE
  __asm__("" : "+x"(product)); /* prevents the compiler from fusing the product with the addition */
#endif
  sum->low -= fma(x, y, -product);
  baum_i_twofold_add(sum, -product);
}

#endif
