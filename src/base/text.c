/* SPDX-License-Identifier: BSD-3-Clause */
/* Texts that grow piece by piece. */
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void baum_i_append(char *text, size_t size, const char *format, ...)
{
  size_t used = strlen(text);
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(text + used, size - used, format, arguments);
  va_end(arguments);
}
