/* SPDX-License-Identifier: BSD-3-Clause */
#include "bytes.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int fuzz_byte(fuzz_bytes *b)
{
  if (b->left == 0) {
    return 0;
  }
  b->left--;
  return *b->at++;
}

int fuzz_below(fuzz_bytes *b, int count)
{
  return fuzz_byte(b) % count;
}

void fuzz_copy(fuzz_bytes *b, void *out, size_t count)
{
  size_t there = count < b->left ? count : b->left;
  memset(out, 0, count);
  memcpy(out, b->at, there);
  b->at += there;
  b->left -= there;
}

double fuzz_number(fuzz_bytes *b)
{
  static const double special[] = {
    0.0,    -0.0,  1.0,     -1.0,    (double)NAN, (double)INFINITY, 1e-9,        1e9,
    1e-160, 1e160, DBL_MAX, DBL_MIN, 5e-324,      -DBL_MAX,         DBL_EPSILON, (double)-INFINITY};
  enum { SPECIAL = sizeof special / sizeof *special, ANY = SPECIAL + 4 };
  int kind = fuzz_byte(b);
  if (kind < SPECIAL) {
    return special[kind];
  }
  if (kind < ANY) {
    double x;
    fuzz_copy(b, &x, sizeof x);
    return x;
  }
  return (kind - 128) / 32.0 + fuzz_byte(b) / 8192.0;
}

double fuzz_small(fuzz_bytes *b)
{
  int kind = fuzz_byte(b);
  return kind < 16 ? fuzz_number(b) : pow(10.0, -6.0 * kind / 255.0);
}

_Noreturn void fuzz_report(const char *condition, const char *file, int line)
{
  (void)fprintf(stderr, "%s:%d: not true: %s\nthe last message: %s\n", file, line, condition,
                baum_message());
  abort();
}

baum_status fuzz_status(baum_status status)
{
  FUZZ_CHECK(status >= BAUM_OK || baum_message()[0] != '\0');
  return status;
}
