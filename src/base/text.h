/* SPDX-License-Identifier: BSD-3-Clause */
/* Texts with numbers, which have a point whatever the locale of the program is. */
#ifndef BAUM_I_BASE_TEXT_H
#define BAUM_I_BASE_TEXT_H

#include <stdarg.h>
#include <stddef.h>

#include "base/message.h"

/* As vsnprintf() and snprintf() but for the locale. */
int baum_i_format(char *text, size_t size, const char *format, va_list arguments)
  BAUM_I_PRINTF(3, 0);
int baum_i_print(char *text, size_t size, const char *format, ...) BAUM_I_PRINTF(3, 4);

/* Refuse a name that breaks messages: the empty one, and control characters. NULL, the default
 * name, is fine. */
baum_status baum_i_check_name(const char *family, int number, const char *name);

/* Append to a zero-terminated text in a buffer of `size` characters; what does not fit is cut. */
void baum_i_append(char *text, size_t size, const char *format, ...) BAUM_I_PRINTF(3, 4);

#endif
