/* SPDX-License-Identifier: BSD-3-Clause */
/* Texts of any length that are built in parts, and the conversion of numbers to text. */
#ifndef BAUM_I_BASE_BUFFER_H
#define BAUM_I_BASE_BUFFER_H

#include <stdbool.h>
#include <stddef.h>

#include "base/message.h"

/* A text that grows. A zeroed buffer is empty. Once memory has run out, functions that append to
 * the buffer do nothing. */
typedef struct baum_i_buffer {
  char *text; /* `used` bytes and then a zero byte; NULL while empty */
  size_t used;
  size_t room;
  bool failed;
} baum_i_buffer;

void baum_i_buffer_clear(baum_i_buffer *buffer);
void baum_i_put(baum_i_buffer *buffer, const char *text);
void baum_i_put_bytes(baum_i_buffer *buffer, const char *bytes, size_t count);
void baum_i_putf(baum_i_buffer *buffer, const char *format, ...) BAUM_I_PRINTF(2, 3);
/* Appends a text, left-aligned in a column of `width` characters. */
void baum_i_put_left(baum_i_buffer *buffer, const char *text, int width);

/* Appends a user's text, escaped for a quoted string in JSON or CSV, or for XML, or not escaped at
 * all. Bytes that are not UTF-8 always become U+FFFD, and control characters become spaces. */
typedef enum baum_i_quoting { BAUM_I_PLAIN, BAUM_I_JSON, BAUM_I_CSV, BAUM_I_XML } baum_i_quoting;
void baum_i_put_user_text(baum_i_buffer *buffer, const char *text, baum_i_quoting quoting);

/* A number as text. Functions return it by value: baum_i_short(x, 3).text, for example, is valid
 * until the end of the full expression that contains the call. */
typedef struct baum_i_number {
  char text[40];
} baum_i_number;

/* Converts a number to text with `digits` significant digits. Numbers whose magnitude is from 1e3
 * to 1e7 are rounded to whole numbers. NaN becomes "-", and infinities become "infinite" and
 * "-infinite". */
baum_i_number baum_i_short(double x, int digits);
/* Converts a number to text with 15, 16 or 17 digits. It uses as few digits as are needed to get
 * the same number when the text is read. NaN and infinities are converted to the text `otherwise`.
 */
baum_i_number baum_i_exact(double x, const char *otherwise);
/* Reads a number that baum_i_exact() has written. The number ends at the next blank or at the end
 * of the text. Returns the end of the number, or NULL if there is no number. */
const char *baum_i_read_number(const char *text, double *out);

/* Tells whether a text is UTF-8. */
bool baum_i_is_utf8(const char *text);

/* Returns the number of characters of a UTF-8 text. */
int baum_i_length(const char *text);

#endif
