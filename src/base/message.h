/* SPDX-License-Identifier: BSD-3-Clause */
/* The message that explains a status. Each thread has one fixed buffer for its message. These
 * buffers are the only mutable data of the library outside its objects. */
#ifndef BAUM_I_BASE_MESSAGE_H
#define BAUM_I_BASE_MESSAGE_H

#include <baum/status.h>

#if defined(__GNUC__)
#define BAUM_I_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define BAUM_I_PRINTF(text, first)
#endif

/* Size of the buffer, including the terminating zero. Longer messages are cut. */
enum { BAUM_I_MESSAGE_SIZE = 1024 };

/* Set this thread's message and return the status, as in `return baum_i_fail(...)`. */
baum_status baum_i_fail(baum_status status, const char *format, ...) BAUM_I_PRINTF(2, 3);

/* If a call fails, return its status from the function that contains the macro. The macro may be
 * used only where this function owns nothing that it must free. */
#define BAUM_I_TRY(call)                     \
  do {                                       \
    const baum_status baum_i_tried = (call); \
    if (baum_i_tried != BAUM_OK) {           \
      return baum_i_tried;                   \
    }                                        \
  } while (0)

/* These two functions handle messages that user functions set. Call baum_i_listen() before the user
 * function and baum_i_heard() after it. baum_i_heard() returns the message, or NULL if the user
 * function set none. */
void baum_i_listen(void);
const char *baum_i_heard(void);

/* Set the message of BAUM_ERR_MEMORY and return this status. */
baum_status baum_i_fail_memory(void);

/* Return BAUM_OK if `memory` is not NULL, otherwise set the message of BAUM_ERR_MEMORY and return
 * this status. */
static inline baum_status baum_i_check_memory(const void *memory)
{
  return memory ? BAUM_OK : baum_i_fail_memory();
}

/* A saved message. A call whose parts may fail saves the present message first, and restores it if
 * the call as a whole succeeds. */
typedef struct baum_i_kept_message {
  char text[BAUM_I_MESSAGE_SIZE];
} baum_i_kept_message;

/* Save this thread's message. */
baum_i_kept_message baum_i_message_keep(void);

/* Return `status`. If `status` is BAUM_OK, first restore the saved message. */
baum_status baum_i_message_settle(baum_status status, const baum_i_kept_message *kept);

#endif
