/* SPDX-License-Identifier: BSD-3-Clause */
/* Texts of any length, built piece by piece, and numbers as text. */
#ifndef BAUM_I_STUDY_REPORT_BUFFER_H
#define BAUM_I_STUDY_REPORT_BUFFER_H

#include <stdbool.h>
#include <stddef.h>

#include "base/message.h"

/* An all-zero buffer is empty. After memory has run out nothing is added. */
typedef struct baum_i_buffer {
  char *text; /* (used), zero-terminated; NULL while empty */
  size_t used;
  size_t room;
  bool failed;
} baum_i_buffer;

void baum_i_buffer_clear(baum_i_buffer *buffer);
void baum_i_put(baum_i_buffer *buffer, const char *text);
void baum_i_putf(baum_i_buffer *buffer, const char *format, ...) BAUM_I_PRINTF(2, 3);
/* Puts a text left-aligned in a column of this many characters. */
void baum_i_put_left(baum_i_buffer *buffer, const char *text, int width);

/* Put a text of the user as it is, or escaped for the quotes of JSON or CSV. Bytes that are not
 * UTF-8 become U+FFFD, control characters spaces. */
typedef enum baum_i_quoting { BAUM_I_PLAIN, BAUM_I_JSON, BAUM_I_CSV } baum_i_quoting;
void baum_i_put_user_text(baum_i_buffer *buffer, const char *text, baum_i_quoting quoting);

/* A number as text, valid to the end of the full expression. */
typedef struct baum_i_number {
  char text[40];
} baum_i_number;

/* Prints this many digits; all digits of whole numbers from 1e3 to 1e7; "-" for NaN. */
baum_i_number baum_i_short(double x, int digits);
/* Prints the shortest text that reads back as the same number; `otherwise` for NaN and infinities.
 */
baum_i_number baum_i_exact(double x, const char *otherwise);
/* Reads what baum_i_exact() wrote, up to a blank. Returns where it ends, or NULL where there is no
 * number. */
const char *baum_i_read_number(const char *text, double *out);

/* Returns the number of characters of a UTF-8 text. */
int baum_i_length(const char *text);

#endif
