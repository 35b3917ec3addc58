/* SPDX-License-Identifier: BSD-3-Clause */
/* Hot files, <name>_hot.c, are compiled twice: once like all other files, and once for processors
 * with 256-bit vectors and fused multiply-add. Each file ends with one const table of its
 * functions, named by BAUM_I_HOT(). When a mechanism is created, one of the two tables is selected
 * for all its workspaces and runs. The results of the two versions of a function differ in the last
 * digits.
 */
#ifndef BAUM_I_BASE_HOT_H
#define BAUM_I_BASE_HOT_H

#include <stdbool.h>

#ifdef BAUM_I_WIDE
#define BAUM_I_HOT(name) name##_wide
#else
#define BAUM_I_HOT(name) name##_plain
#endif

/* Functions with this specifier are always inlined, so that the compiler can use the values of
 * constant arguments. */
#define BAUM_I_INLINE static inline __attribute__((always_inline))

/* Unrolls the next loop, so that its local arrays can stay in registers. */
#define BAUM_I_PRAGMA(text) _Pragma(#text)
#if defined(__clang__)
#define BAUM_I_UNROLL(times) BAUM_I_PRAGMA(unroll times)
#elif defined(__GNUC__)
#define BAUM_I_UNROLL(times) BAUM_I_PRAGMA(GCC unroll times)
#else
#define BAUM_I_UNROLL(times)
#endif

/* Tell whether this build has the tables for wide vectors and this processor can run them. The test
 * may take 100 us, because virtual machines emulate CPUID. Mechanisms therefore store the
 * answer. */
bool baum_i_hot_is_wide(void);

/* The table of functions: for wide vectors if `wide` is true, otherwise the plain table. */
#ifdef BAUM_I_HAS_WIDE
#define BAUM_I_HOT_TABLE(wide, name) ((wide) ? &name##_wide : &name##_plain)
#else
#define BAUM_I_HOT_TABLE(wide, name) (&name##_plain)
#endif

#endif
