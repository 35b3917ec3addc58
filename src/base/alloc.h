/* SPDX-License-Identifier: BSD-3-Clause */
/* All heap use of the library's own code goes through here: zeroed, checked against overflow. */
#ifndef BAUM_I_BASE_ALLOC_H
#define BAUM_I_BASE_ALLOC_H

#include <stddef.h>

/* Zeroed memory for count elements; one byte at least, so that NULL always means "out of
 * memory". */
void *baum_i_alloc(size_t count, size_t size);

/* Grow an array to hold count elements, which means room for the least power of two of them; on
 * failure returns NULL and leaves the old one. */
void *baum_i_grow(void *old, size_t count, size_t size);

/* Likewise an array that has come from here or from baum_i_grow() with one element less (NULL for
 * none): it moves seldom, so that many additions cost little more than the last move. */
void *baum_i_grow_by_one(void *old, size_t count, size_t size);

/* Copy of count elements, or NULL. */
void *baum_i_copy(const void *source, size_t count, size_t size);

/* Copy of a string, or NULL. */
char *baum_i_copy_text(const char *text);

/* Release; NULL is fine. Takes const memory too: who frees is who made it. */
void baum_i_free(const void *memory);

/* The one way to drop const: for members of constant objects that may change all the same. */
static inline void *baum_i_mutable(const void *memory)
{
  union {
    const void *constant;
    void *changing;
  } pointer = {.constant = memory};
  return pointer.changing;
}

#endif
