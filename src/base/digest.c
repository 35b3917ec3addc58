/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/digest.h"

#include <string.h>

static void add_word(baum_i_digest *digest, uint64_t word)
{
  uint64_t h = (digest->value ^ word) * UINT64_C(0x9e3779b97f4a7c15);
  digest->value = h ^ (h >> 32);
}

void baum_i_digest_add(baum_i_digest *digest, const void *bytes, size_t size)
{
  const unsigned char *next = bytes;
  uint64_t word = 0;
  for (; size >= sizeof word; size -= sizeof word, next += sizeof word) {
    memcpy(&word, next, sizeof word);
    add_word(digest, word);
  }
  if (size > 0) {
    word = 0;
    memcpy(&word, next, size);
    add_word(digest, word);
  }
}

void baum_i_digest_add_text(baum_i_digest *digest, const char *text)
{
  size_t size = strlen(text);
  baum_i_digest_add_integer(digest, (int64_t)size);
  baum_i_digest_add(digest, text, size);
}

void baum_i_digest_add_integer(baum_i_digest *digest, int64_t value)
{
  uint64_t word = 0;
  memcpy(&word, &value, sizeof word);
  add_word(digest, word);
}
