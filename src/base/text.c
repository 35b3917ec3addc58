/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/text.h"

#include <string.h>

#include "base/buffer.h"

enum { DELETE = 0x7f };

int baum_i_print(char *text, size_t size, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  int length = baum_i_format(text, size, format, arguments);
  va_end(arguments);
  return length;
}

baum_i_text baum_i_text_of(const char *format, ...)
{
  baum_i_text out;
  va_list arguments;
  va_start(arguments, format);
  (void)baum_i_format(out.text, sizeof out.text, format, arguments);
  va_end(arguments);
  return out;
}

void baum_i_append(char *text, size_t size, const char *format, ...)
{
  size_t used = strlen(text);
  va_list arguments;
  va_start(arguments, format);
  (void)baum_i_format(text + used, size - used, format, arguments);
  va_end(arguments);
}

baum_status baum_i_check_name(const char *family, int number, const char *name)
{
  if (name && !name[0]) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s %d: name is empty; NULL stands for the default name",
                       family, number);
  }
  for (const char *at = name; at && *at; at++) {
    unsigned char byte = (unsigned char)*at;
    if (byte < ' ' || byte == DELETE) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s %d: name has the control character 0x%02x at index %d; messages print "
                         "names, so names must not contain control characters",
                         family, number, byte, (int)(at - name));
    }
  }
  return !name || baum_i_is_utf8(name)
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s %d: name is not UTF-8", family, number);
}
