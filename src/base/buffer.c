/* SPDX-License-Identifier: BSD-3-Clause */
/* Texts of any length that are built in parts, and the conversion of numbers to text. */
#include "base/buffer.h"

#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/text.h"

void baum_i_buffer_clear(baum_i_buffer *buffer)
{
  baum_i_free(buffer->text);
  *buffer = (baum_i_buffer){0};
}

/* Makes room for `more` further characters and the terminating zero. Returns the end of the present
 * text, or NULL when out of memory. */
static char *make_room(baum_i_buffer *buffer, size_t more)
{
  size_t wanted = buffer->used + more + 1;
  if (!buffer->failed && wanted > buffer->room) {
    char *text = baum_i_grow(buffer->text, 2 * wanted, 1);
    buffer->text = text ? text : buffer->text;
    buffer->room = text ? 2 * wanted : buffer->room;
    buffer->failed = !text;
  }
  return buffer->failed ? NULL : buffer->text + buffer->used;
}

void baum_i_put_bytes(baum_i_buffer *buffer, const char *bytes, size_t count)
{
  char *to = make_room(buffer, count);
  if (to) {
    memcpy(to, bytes, count);
    to[count] = '\0';
    buffer->used += count;
  }
}

void baum_i_put(baum_i_buffer *buffer, const char *text)
{
  baum_i_put_bytes(buffer, text, strlen(text));
}

void baum_i_putf(baum_i_buffer *buffer, const char *format, ...)
{
  va_list arguments;
  va_list again;
  va_start(arguments, format);
  va_copy(again, arguments);
  int count = baum_i_format(NULL, 0, format, arguments);
  char *to = count < 0 ? NULL : make_room(buffer, (size_t)count);
  if (to) {
    (void)baum_i_format(to, (size_t)count + 1, format, again);
    buffer->used += (size_t)count;
  }
  va_end(again);
  va_end(arguments);
}

void baum_i_put_left(baum_i_buffer *buffer, const char *text, int width)
{
  int gap = width - baum_i_length(text);
  baum_i_putf(buffer, "%s%*s", text, gap > 0 ? gap : 0, "");
}

/* ---- texts of users ---- */

/* Returns the number of bytes of the character at s, or 0 if the bytes at s are not UTF-8 (RFC
 * 3629). */
static size_t character(const unsigned char *s)
{
  if (s[0] < 0x80) {
    return 1;
  }
  size_t count = s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : 2;
  uint32_t code = s[0] & (0x7fU >> count);
  for (size_t k = 1; k < count; k++) {
    if ((s[k] & 0xc0) != 0x80) {
      return 0;
    }
    code = code << 6 | (s[k] & 0x3fU);
  }
  static const uint32_t LEAST[] = {0, 0, 0x80, 0x800, 0x10000};
  bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  return s[0] < 0xc0 || s[0] > 0xf4 || code < LEAST[count] || code > 0x10ffff || is_surrogate
           ? 0
           : count;
}

bool baum_i_is_utf8(const char *text)
{
  size_t count = 1;
  while (*text && count > 0) {
    count = character((const unsigned char *)text);
    text += count;
  }
  return count > 0;
}

int baum_i_length(const char *text)
{
  int count = 0;
  for (; *text; text++) {
    count += ((unsigned char)*text & 0xc0) != 0x80;
  }
  return count;
}

/* Returns the escape sequence of a character, or NULL if the character needs no escape sequence. */
static const char *escape(char c, baum_i_quoting quoting)
{
  if (quoting == BAUM_I_PLAIN) {
    return NULL;
  }
  if (quoting == BAUM_I_CSV) {
    return c == '"' ? "\"\"" : NULL;
  }
  if (quoting == BAUM_I_XML) {
    return c == '<' ? "&lt;" : c == '&' ? "&amp;" : NULL;
  }
  switch (c) {
  case '"': return "\\\"";
  case '\\': return "\\\\";
  case '<': return "\\u003c"; /* otherwise a text could end the script element that contains it */
  default: return NULL;
  }
}

void baum_i_put_user_text(baum_i_buffer *buffer, const char *text, baum_i_quoting quoting)
{
  while (*text) {
    const unsigned char *s = (const unsigned char *)text;
    size_t count = character(s);
    bool is_control = s[0] < 0x20 || s[0] == 0x7f;
    const char *instead = count == 0 ? "\xef\xbf\xbd" : is_control ? " " : escape(*text, quoting);
    if (instead) {
      baum_i_put(buffer, instead);
    } else {
      baum_i_put_bytes(buffer, text, count);
    }
    text += count ? count : 1;
  }
}

/* ---- numbers ---- */

baum_i_number baum_i_short(double x, int digits)
{
  baum_i_number out = {"-"};
  if (fabs(x) >= 1e3 && fabs(x) < 1e7) {
    (void)snprintf(out.text, sizeof out.text, "%.0f", x);
  } else if (isfinite(x)) {
    (void)baum_i_print(out.text, sizeof out.text, "%.*g", digits, x);
  } else if (isinf(x)) {
    (void)snprintf(out.text, sizeof out.text, "%sinfinite", x < 0.0 ? "-" : "");
  }
  return out;
}

baum_i_number baum_i_exact(double x, const char *otherwise)
{
  baum_i_number out = {""};
  if (!isfinite(x)) {
    (void)snprintf(out.text, sizeof out.text, "%s", otherwise);
    return out;
  }
  int digits = 15;
  double back = 0.0;
  do {
    (void)baum_i_print(out.text, sizeof out.text, "%.*g", digits, x);
  } while (baum_i_read_number(out.text, &back) && back != x && digits++ < 17);
  return out;
}

const char *baum_i_read_number(const char *text, double *out)
{
  enum { LONGEST = 40 };
  char copy[LONGEST + 16];
  char *end = NULL;
  text += strspn(text, " ");
  size_t size = strcspn(text, " ");
  size_t whole = strcspn(text, ". ");
  size_t point = whole < size ? 1 : 0;
  if (size > LONGEST) {
    return NULL;
  }
  (void)snprintf(copy, sizeof copy, "%.*s%s%.*s", (int)whole, text,
                 point ? localeconv()->decimal_point : "", (int)(size - whole - point),
                 text + whole + point);
  *out = strtod(copy, &end);
  return end != copy && *end == '\0' ? text + size : NULL;
}
