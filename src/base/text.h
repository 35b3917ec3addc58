/* SPDX-License-Identifier: BSD-3-Clause */
/* Formats texts. Numbers have a decimal point in every locale. */
#ifndef BAUM_I_BASE_TEXT_H
#define BAUM_I_BASE_TEXT_H

#include "base/platform.h"

/* Like snprintf(), but in the "C" locale. */
int baum_i_print(char *text, size_t size, const char *format, ...) BAUM_I_PRINTF(3, 4);

/* A short text, such as a name in a message, which functions return by value. With a larger size,
 * the compiler would no longer inline functions that use such texts in their messages. */
typedef struct baum_i_text {
  char text[208];
} baum_i_text;

/* Format a short text. What does not fit is cut. */
baum_i_text baum_i_text_of(const char *format, ...) BAUM_I_PRINTF(1, 2);

/* Fail with BAUM_ERR_ARGUMENT if a name is empty or has control characters, which would make
 * messages unreadable. The message names the object by its family and number. `name` may be NULL,
 * which stands for the default name. */
baum_status baum_i_check_name(const char *family, int number, const char *name);

/* Append a formatted text to the zero-terminated text in a buffer of `size` characters. What does
 * not fit is cut. */
void baum_i_append(char *text, size_t size, const char *format, ...) BAUM_I_PRINTF(3, 4);

#endif
