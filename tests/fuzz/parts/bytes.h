/* SPDX-License-Identifier: BSD-3-Clause */
/* Reads choices and numbers from the bytes of a fuzzer, and reports errors. */
#ifndef BAUM_FUZZ_BYTES_H
#define BAUM_FUZZ_BYTES_H

#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* Each target defines this function. The fuzzer and replay.c call it. It returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The unread bytes of an input. Reading continues with zeros after the last byte. */
typedef struct fuzz_bytes {
  const uint8_t *at;
  size_t left;
} fuzz_bytes;

int fuzz_byte(fuzz_bytes *b);
/* Returns a number from 0 to count - 1. This reads one byte. */
int fuzz_below(fuzz_bytes *b, int count);
/* Copies the next `count` bytes. */
void fuzz_copy(fuzz_bytes *b, void *out, size_t count);
/* Returns a number. Most numbers are ordinary. Others are zero, infinite, NaN, extremely small or
 * large, or have arbitrary bits. */
double fuzz_number(fuzz_bytes *b);
/* Returns a number, usually between 1e-6 and 1, and occasionally any number. */
double fuzz_small(fuzz_bytes *b);

/* If the condition is false, prints it together with the last message of the library, and
 * aborts. */
#define FUZZ_CHECK(condition) ((condition) ? (void)0 : fuzz_report(#condition, __FILE__, __LINE__))
_Noreturn void fuzz_report(const char *condition, const char *file, int line);

/* Checks that there is a message if the status is a failure. Returns the status. */
baum_status fuzz_status(baum_status status);

#endif
