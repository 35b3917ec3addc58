/* SPDX-License-Identifier: BSD-3-Clause */
/* Heap memory. Only this file calls malloc and related functions. */
#include "base/alloc.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void *baum_i_alloc(size_t count, size_t size)
{
  return calloc(count > 0 ? count : 1, size > 0 ? size : 1);
}

enum { LINE = 64 };

/* The pointer to the whole memory is stored before the line. */
void *baum_i_alloc_lines(size_t count, size_t size)
{
  size_t most = (SIZE_MAX - 2 * LINE) / (size > 0 ? size : 1);
  char *whole = count <= most ? baum_i_alloc(count * size + 2 * LINE, 1) : NULL;
  if (!whole) {
    return NULL;
  }
  char *line = whole + 2 * LINE - (uintptr_t)whole % LINE;
  memcpy(line - sizeof whole, &whole, sizeof whole);
  return line;
}

void baum_i_free_lines(const void *memory)
{
  if (memory) {
    void *whole;
    memcpy(&whole, (const char *)memory - sizeof whole, sizeof whole);
    free(whole);
  }
}

void *baum_i_grow(void *old, size_t count, size_t size)
{
  size_t room = 1;
  while (room < count && room <= SIZE_MAX / 2) {
    room *= 2;
  }
  if (room < count || (size > 0 && room > SIZE_MAX / size)) {
    return NULL;
  }
  size_t bytes = room * size;
  return realloc(old, bytes > 0 ? bytes : 1);
}

void *baum_i_grow_by_one(void *old, size_t count, size_t size)
{
  /* `is_full` is true if count - 1, the old count, is 0 or a power of two: the array then uses its
   * whole capacity. */
  bool is_full = count <= 2 || ((count - 1) & (count - 2)) == 0;
  return old && !is_full ? old : baum_i_grow(old, count, size);
}

void *baum_i_copy(const void *source, size_t count, size_t size)
{
  void *copy = baum_i_alloc(count, size);
  if (copy && count * size > 0) {
    memcpy(copy, source, count * size);
  }
  return copy;
}

char *baum_i_copy_text(const char *text)
{
  return baum_i_copy(text, strlen(text) + 1, 1);
}

void baum_i_free(const void *memory)
{
  free(baum_i_mutable(memory));
}
