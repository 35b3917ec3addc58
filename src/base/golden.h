/* SPDX-License-Identifier: BSD-3-Clause */
/* Numbers without a pattern, the same in every run. */
#ifndef BAUM_I_BASE_GOLDEN_H
#define BAUM_I_BASE_GOLDEN_H

#include <math.h>

/* In [-1, 1): where k steps of the golden ratio lead; they fill the interval evenly. */
static inline double baum_i_golden(int k)
{
  double turns = 0.6180339887498949 * k;
  return 2.0 * (turns - floor(turns)) - 1.0;
}

#endif
