/* SPDX-License-Identifier: BSD-3-Clause */
/* Quasi-random numbers that are the same in every run. */
#ifndef BAUM_I_BASE_GOLDEN_H
#define BAUM_I_BASE_GOLDEN_H

#include <math.h>

/* Return the k-th quasi-random number in [-1, 1). The numbers are multiples of the golden ratio
 * modulo 1, scaled to this interval, and fill it evenly. */
static inline double baum_i_golden(int k)
{
  double turns = 0.6180339887498949 * k;
  return 2.0 * (turns - floor(turns)) - 1.0;
}

#endif
