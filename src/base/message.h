/* SPDX-License-Identifier: BSD-3-Clause */
/* The message behind a status. Each thread has one fixed buffer, the only mutable data outside
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

/* Set this thread's message and return the status, as in `return baum_i_fail(...)`. */
baum_status baum_i_fail(baum_status status, const char *format, ...) BAUM_I_PRINTF(2, 3);

/* Return from the function if a call fails. Only for functions that own nothing at that place. */
#define BAUM_I_TRY(call)                     \
  do {                                       \
    const baum_status baum_i_tried = (call); \
    if (baum_i_tried != BAUM_OK) {           \
      return baum_i_tried;                   \
    }                                        \
  } while (0)

/* For messages of user functions: call the first function before the user function and the second
 * after it. The second returns NULL if the user function set no message. */
void baum_i_listen(void);
const char *baum_i_heard(void);

/* Set the message for BAUM_ERR_MEMORY and return it. */
baum_status baum_i_fail_memory(void);

/* BAUM_OK if memory was obtained, else baum_i_fail_memory(). */
static inline baum_status baum_i_check_memory(const void *memory)
{
  return memory ? BAUM_OK : baum_i_fail_memory();
}

/* A saved message, for calls whose failure does not matter. */
typedef struct baum_i_kept_message {
  char text[BAUM_I_MESSAGE_SIZE];
} baum_i_kept_message;

/* Save this thread's message. */
void baum_i_message_keep(baum_i_kept_message *kept);

/* Return the status. If it is BAUM_OK, restore the saved message. */
baum_status baum_i_message_settle(baum_status status, const baum_i_kept_message *kept);

#endif
