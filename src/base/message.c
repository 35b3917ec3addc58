/* SPDX-License-Identifier: BSD-3-Clause */
/* The message that explains a status. Each thread has one fixed buffer. */
#include "base/message.h"

#include <stdarg.h>
#include <stdbool.h>
#include <string.h>

#include "base/text.h"

static _Thread_local char message[BAUM_I_MESSAGE_SIZE];
static _Thread_local bool has_said; /* baum_fail() has set a message since baum_i_listen() */

const char *baum_message(void)
{
  return message;
}

baum_status baum_i_fail(baum_status status, const char *format, ...)
{
  /* An argument may be the present message, so the new one is formatted in another buffer. */
  char text[BAUM_I_MESSAGE_SIZE];
  va_list arguments;
  va_start(arguments, format);
  (void)baum_i_format(text, sizeof text, format, arguments);
  va_end(arguments);
  memcpy(message, text, sizeof text);
  return status;
}

baum_status baum_fail(baum_status status, const char *given)
{
  has_said = given != NULL;
  return baum_i_fail(status, "%s", given ? given : baum_status_text(status));
}

void baum_i_listen(void)
{
  has_said = false;
}

const char *baum_i_heard(void)
{
  return has_said ? message : NULL;
}

baum_status baum_i_fail_memory(void)
{
  return baum_i_fail(BAUM_ERR_MEMORY, "out of memory");
}

baum_i_kept_message baum_i_message_keep(void)
{
  baum_i_kept_message kept;
  memcpy(kept.text, message, sizeof message);
  return kept;
}

baum_status baum_i_message_settle(baum_status status, const baum_i_kept_message *kept)
{
  if (status == BAUM_OK) {
    memcpy(message, kept->text, sizeof message);
  }
  return status;
}
