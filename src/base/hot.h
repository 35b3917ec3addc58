/* SPDX-License-Identifier: BSD-3-Clause */
/* Hot files, <name>_hot.c, are compiled twice: as everything else, and for processors with 256-bit
 * vectors and fused multiply-add. Each ends in one const table of its functions, named by
 * BAUM_I_HOT(); which of the two is used is decided at run time, when an object is made. The
 * results of the two differ in the last digits.
 */
#ifndef BAUM_I_BASE_HOT_H
#define BAUM_I_BASE_HOT_H

#include <stdbool.h>

#ifdef BAUM_I_WIDE
#define BAUM_I_HOT(name) name##_wide
#else
#define BAUM_I_HOT(name) name##_plain
#endif

/* For what has to be part of its caller, which knows its arguments. */
#define BAUM_I_INLINE static inline __attribute__((always_inline))

/* Whether the wide tables exist and this processor can run them. */
bool baum_i_hot_is_wide(void);

/* Pointer to the table for this processor. */
#ifdef BAUM_I_HAS_WIDE
#define BAUM_I_HOT_TABLE(name) (baum_i_hot_is_wide() ? &name##_wide : &name##_plain)
#else
#define BAUM_I_HOT_TABLE(name) (&name##_plain)
#endif

#endif
