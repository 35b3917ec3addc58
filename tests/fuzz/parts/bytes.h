/* SPDX-License-Identifier: BSD-3-Clause */
/* Choices and numbers read from the bytes of a fuzzer, and what a target must never find. */
#ifndef BAUM_FUZZ_BYTES_H
#define BAUM_FUZZ_BYTES_H

#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* Defined by each target; the fuzzer, or replay.c in other builds, calls it. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* What is left of an input. Behind its end there are zeros. */
typedef struct fuzz_bytes {
  const uint8_t *at;
  size_t left;
} fuzz_bytes;

int fuzz_byte(fuzz_bytes *b);
/* 0 to count - 1, of one byte. */
int fuzz_below(fuzz_bytes *b, int count);
/* `count` bytes as they are. */
void fuzz_copy(fuzz_bytes *b, void *out, size_t count);
/* Ordinary ones mostly; else zeros, infinities, NaN, the smallest and largest, and any bits. */
double fuzz_number(fuzz_bytes *b);
/* Between 1e-6 and 1, and now and then any number. */
double fuzz_small(fuzz_bytes *b);

/* A finding: says what is wrong, with the last message of the library, and aborts. */
#define FUZZ_CHECK(condition) ((condition) ? (void)0 : fuzz_report(#condition, __FILE__, __LINE__))
_Noreturn void fuzz_report(const char *condition, const char *file, int line);

/* A failure has a message. */
baum_status fuzz_status(baum_status status);

#endif
