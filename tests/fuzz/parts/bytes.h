/* SPDX-License-Identifier: BSD-3-Clause */
/* Choices and numbers read from the bytes of a fuzzer, and the report of errors. */
#ifndef BAUM_FUZZ_BYTES_H
#define BAUM_FUZZ_BYTES_H

#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* Defined by each target; the fuzzer, or replay.c in other builds, calls it. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The rest of an input. Past its end zeros are read. */
typedef struct fuzz_bytes {
  const uint8_t *at;
  size_t left;
} fuzz_bytes;

int fuzz_byte(fuzz_bytes *b);
/* Returns 0 to count - 1; takes one byte. */
int fuzz_below(fuzz_bytes *b, int count);
/* Copies `count` bytes without a change. */
void fuzz_copy(fuzz_bytes *b, void *out, size_t count);
/* Mostly ordinary numbers; else zeros, infinities, NaN, the smallest and largest numbers, and
 * arbitrary bits. */
double fuzz_number(fuzz_bytes *b);
/* Between 1e-6 and 1; occasionally any number. */
double fuzz_small(fuzz_bytes *b);

/* If the condition is false: prints it with the last message of the library, and aborts. */
#define FUZZ_CHECK(condition) ((condition) ? (void)0 : fuzz_report(#condition, __FILE__, __LINE__))
_Noreturn void fuzz_report(const char *condition, const char *file, int line);

/* Checks that a failure has a message. Returns the status. */
baum_status fuzz_status(baum_status status);

#endif
