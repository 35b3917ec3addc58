/* SPDX-License-Identifier: BSD-3-Clause */
/* The sentence behind a status. One fixed buffer per thread: the one mutable thing outside objects. */
#ifndef BAUM_I_BASE_MESSAGE_H
#define BAUM_I_BASE_MESSAGE_H

#include <baum/status.h>

#if defined(__GNUC__)
#define BAUM_I_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define BAUM_I_PRINTF(text, first)
#endif

/* Length of the longest sentence kept, with its terminating zero. */
enum { BAUM_I_MESSAGE_SIZE = 1024 };

/* Set this thread's sentence and return status, so that one can write `return baum_i_fail(...)`. */
baum_status baum_i_fail(baum_status status, const char *format, ...) BAUM_I_PRINTF(2, 3);

/* The sentence for BAUM_ERR_MEMORY. */
baum_status baum_i_fail_memory(void);

/* Put a prefix such as "t = 1.2 s: " before this thread's sentence. */
void baum_i_message_prefix(const char *format, ...) BAUM_I_PRINTF(1, 2);

#endif
