/* SPDX-License-Identifier: BSD-3-Clause */
/* Heap memory. All of the library's own code allocates through these functions. */
#ifndef BAUM_I_BASE_ALLOC_H
#define BAUM_I_BASE_ALLOC_H

#include <stddef.h>

/* Allocate zeroed memory for count elements. The result has at least one byte, so NULL always means
 * "out of memory". */
void *baum_i_alloc(size_t count, size_t size);

/* Allocate zeroed memory that begins on a cache line, because vectors that cross cache lines are
 * slow to load and store. It must be freed by the second function, which allows NULL. */
void *baum_i_alloc_lines(size_t count, size_t size);
void baum_i_free_lines(const void *memory);

/* Grow an array to hold count elements. The capacity is rounded up to a power of two. On failure
 * the function returns NULL and the old array stays valid. */
void *baum_i_grow(void *old, size_t count, size_t size);

/* Grow an array by one element, to `count` elements. The array must come from this function or from
 * baum_i_grow(). NULL stands for an empty array. The array is reallocated only if it was empty or
 * its old length is a power of two. */
void *baum_i_grow_by_one(void *old, size_t count, size_t size);

/* Copy count elements. Returns NULL when out of memory. */
void *baum_i_copy(const void *source, size_t count, size_t size);

/* Copy a string. Returns NULL when out of memory. */
char *baum_i_copy_text(const char *text);

/* Free memory. NULL is allowed. The argument is const because an owner may hold its memory through
 * a const pointer. */
void baum_i_free(const void *memory);

/* Return the same pointer without const. The library uses this function to change, free or pass on
 * an object whose owner holds it through a const pointer. */
static inline void *baum_i_mutable(const void *memory)
{
  union {
    const void *constant;
    void *changing;
  } pointer = {.constant = memory};
  return pointer.changing;
}

#endif
