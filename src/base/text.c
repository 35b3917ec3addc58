/* SPDX-License-Identifier: BSD-3-Clause */
/* Texts with numbers. The locale is a thread's own while one is put together: the program's stays as it is. */
#include "base/text.h"

#include <locale.h>
#include <stdio.h>
#include <string.h>

int baum_i_format(char *text, size_t size, const char *format, va_list arguments)
{
  locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0); /* no memory: that of the program */
  locale_t before = plain ? uselocale(plain) : (locale_t)0;
  int length = vsnprintf(text, size, format, arguments);
  if (plain) {
    (void)uselocale(before);
    freelocale(plain);
  }
  return length;
}

int baum_i_print(char *text, size_t size, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  int length = baum_i_format(text, size, format, arguments);
  va_end(arguments);
  return length;
}

void baum_i_append(char *text, size_t size, const char *format, ...)
{
  size_t used = strlen(text);
  va_list arguments;
  va_start(arguments, format);
  (void)baum_i_format(text + used, size - used, format, arguments);
  va_end(arguments);
}
