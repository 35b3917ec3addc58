/* SPDX-License-Identifier: BSD-3-Clause */
/* Hash of a sequence of bytes. Each group of eight bytes is read as a number w and changes the hash
 * h in two steps:
 *
 *   h := (h xor w) 0x9e3779b97f4a7c15,   h := h xor (h >> 32)
 *
 * Both steps are bijections, so a change of a single number w always changes the hash. The hash
 * does not protect against collisions that somebody constructs on purpose.
 */
#ifndef BAUM_I_BASE_DIGEST_H
#define BAUM_I_BASE_DIGEST_H

#include <stddef.h>
#include <stdint.h>

typedef struct baum_i_digest {
  uint64_t value; /* 0 at first */
} baum_i_digest;

/* Add bytes to the hash. The last group of eight is padded with zeros. */
void baum_i_digest_add(baum_i_digest *digest, const void *bytes, size_t size);

/* Add a text and its length. */
void baum_i_digest_add_text(baum_i_digest *digest, const char *text);

void baum_i_digest_add_integer(baum_i_digest *digest, int64_t value);

#endif
