/* SPDX-License-Identifier: BSD-3-Clause */
/* Detects the vector instructions of this processor. */
#include "base/hot.h"

bool baum_i_hot_is_wide(void)
{
#ifdef BAUM_I_HAS_WIDE
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  return false;
#endif
}
