/* SPDX-License-Identifier: BSD-3-Clause */
/* A sum over bytes by which two of them are told apart, with w the next eight bytes as a number:
 *
 *   h := (h xor w) 0x9e3779b97f4a7c15,   h := h xor (h >> 32)
 *
 * Both are one to one, so that a change of one word alone always changes the sum. No protection
 * against people who mean it.
 */
#ifndef BAUM_I_BASE_DIGEST_H
#define BAUM_I_BASE_DIGEST_H

#include <stddef.h>
#include <stdint.h>

typedef struct baum_i_digest {
  uint64_t value; /* 0 at first */
} baum_i_digest;

/* What is not a whole number of words is filled up with zeros. */
void baum_i_digest_add(baum_i_digest *digest, const void *bytes, size_t size);

/* With its length. */
void baum_i_digest_add_text(baum_i_digest *digest, const char *text);

void baum_i_digest_add_integer(baum_i_digest *digest, int64_t value);

#endif
