/* SPDX-License-Identifier: BSD-3-Clause */
/* Arrays of numbers in one allocation. */
#ifndef BAUM_I_LINEAR_ARRAYS_H
#define BAUM_I_LINEAR_ARRAYS_H

#include <stddef.h>

/* An array and its number of doubles. */
typedef struct baum_i_array {
  void *place; /* address of the pointer to the array */
  size_t count;
} baum_i_array;

/* Allocates zeroed memory for all arrays and sets their pointers. Each array begins on a cache
 * line. The distance from one array to the next is never a whole number of pages, because arrays
 * whole pages apart would compete for the same cache sets. Returns the memory, or NULL when out of
 * memory. */
double *baum_i_arrays_create(const baum_i_array *arrays, int count);

#endif
