/* SPDX-License-Identifier: BSD-3-Clause */
/* The message behind a status. One fixed buffer per thread: the one mutable thing outside
 * objects. */
#ifndef BAUM_I_BASE_MESSAGE_H
#define BAUM_I_BASE_MESSAGE_H

#include <baum/status.h>

#if defined(__GNUC__)
#define BAUM_I_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define BAUM_I_PRINTF(text, first)
#endif

/* Length of the longest message kept, with its terminating zero. */
enum { BAUM_I_MESSAGE_SIZE = 1024 };

/* Set this thread's message and return status, so that one can write `return baum_i_fail(...)`. */
baum_status baum_i_fail(baum_status status, const char *format, ...) BAUM_I_PRINTF(2, 3);

/* Return the status of a call unless it is BAUM_OK. For places that own nothing to be released. */
#define BAUM_I_TRY(call)                     \
  do {                                       \
    const baum_status baum_i_tried = (call); \
    if (baum_i_tried != BAUM_OK) {           \
      return baum_i_tried;                   \
    }                                        \
  } while (0)

/* What a function of the user says of its failure: before it is called, and behind; NULL:
 * nothing. */
void baum_i_listen(void);
const char *baum_i_heard(void);

/* The message for BAUM_ERR_MEMORY. */
baum_status baum_i_fail_memory(void);

/* BAUM_OK if memory was obtained, else baum_i_fail_memory(). */
static inline baum_status baum_i_check_memory(const void *memory)
{
  return memory ? BAUM_OK : baum_i_fail_memory();
}

/* A message put aside while something is tried whose failures do not matter. */
typedef struct baum_i_kept_message {
  char text[BAUM_I_MESSAGE_SIZE];
} baum_i_kept_message;

/* Put this thread's message aside. */
void baum_i_message_keep(baum_i_kept_message *kept);

/* Return status; if all went well in the end, the message from before is this thread's again. */
baum_status baum_i_message_settle(baum_status status, const baum_i_kept_message *kept);

#endif
