/* SPDX-License-Identifier: BSD-3-Clause */
/* Detects the vector instructions of this processor. */
#include "base/hot.h"

#if !defined(BAUM_I_HAS_WIDE)

bool baum_i_hot_is_wide(void)
{
  return false;
}

#elif !defined(BAUM_I_CPUID)

bool baum_i_hot_is_wide(void)
{
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
}

#else /* for zig, whose runtime never fills the table that __builtin_cpu_supports() reads */

#include <cpuid.h>

/* Tell whether the system saves the registers of wide vectors (bits 1 and 2 of XCR0). */
static bool are_saved(void)
{
  unsigned low = 0;
  unsigned high = 0;
  __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return (low & 6u) == 6u;
}

bool baum_i_hot_is_wide(void)
{
  const unsigned needed = bit_FMA | bit_OSXSAVE;
  unsigned a = 0;
  unsigned b = 0;
  unsigned c = 0;
  unsigned d = 0;
  if (!__get_cpuid_count(7, 0, &a, &b, &c, &d) || (b & bit_AVX2) == 0) {
    return false;
  }
  __cpuid(1, a, b, c, d);
  return (c & needed) == needed && are_saved();
}

#endif
