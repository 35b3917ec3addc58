/* SPDX-License-Identifier: BSD-3-Clause */
#include "linear/arrays.h"

#include <stdint.h>
#include <string.h>

#include "base/alloc.h"

enum { LINE = 8, PAGE = 512 }; /* in doubles */

static size_t padded(size_t count)
{
  size_t lines = (count + LINE - 1) / LINE * LINE;
  return lines % PAGE == 0 ? lines + LINE : lines;
}

double *baum_i_arrays_create(const baum_i_array *arrays, int count)
{
  size_t sum = LINE;
  for (int i = 0; i < count; i++) {
    sum += padded(arrays[i].count);
  }
  double *numbers = baum_i_alloc(sum, sizeof *numbers);
  if (!numbers) {
    return NULL;
  }
  size_t over = (uintptr_t)numbers / sizeof(double) % LINE;
  double *next = numbers + (over > 0 ? LINE - over : 0);
  for (int i = 0; i < count; i++) {
    memcpy(arrays[i].place, &next, sizeof next);
    next += padded(arrays[i].count);
  }
  return numbers;
}
