/* SPDX-License-Identifier: BSD-3-Clause */
/* Sorts the list by row, then by column, each time in linear time and stably. The rows of a column
 * then ascend, and repeated places are adjacent. */
#include "linear/compress.h"

#include <stdbool.h>
#include <string.h>

#include "base/alloc.h"

baum_status baum_i_places_create(size_t most, baum_i_places *places)
{
  *places = (baum_i_places){0};
  if (most > INT32_MAX) {
    return BAUM_ERR_MEMORY;
  }
  places->row = baum_i_alloc(most, sizeof *places->row);
  places->column = baum_i_alloc(most, sizeof *places->column);
  if (!places->row || !places->column) {
    baum_i_places_clear(places);
    return BAUM_ERR_MEMORY;
  }
  return BAUM_OK;
}

void baum_i_places_clear(baum_i_places *places)
{
  baum_i_free(places->row);
  baum_i_free(places->column);
  *places = (baum_i_places){0};
}

/* Turns the counts in start (n + 1), which are one place further on, into the starts of runs. */
static void accumulate(int32_t n, int32_t *start)
{
  for (int32_t j = 0; j < n; j++) {
    start[j + 1] += start[j];
  }
}

/* Sorts indices from the order `before` to the order `after` by key, stably. next (n + 1) is
 * scratch. */
static void sort_by(const int32_t *key, size_t count, int32_t n, const int32_t *before,
                    int32_t *next, int32_t *after)
{
  memset(next, 0, ((size_t)n + 1) * sizeof *next);
  for (size_t k = 0; k < count; k++) {
    next[key[k] + 1]++;
  }
  accumulate(n, next);
  for (size_t k = 0; k < count; k++) {
    after[next[key[before[k]]]++] = before[k];
  }
}

static bool is_same(const baum_i_places *places, int32_t a, int32_t b)
{
  return places->row[a] == places->row[b] && places->column[a] == places->column[b];
}

/* Numbers the places in ascending order; repeated ones share a slot. */
static void assign(const baum_i_places *places, const int32_t *order, int32_t n, int32_t *start,
                   int32_t *row, int32_t *slot)
{
  int32_t used = 0;
  memset(start, 0, ((size_t)n + 1) * sizeof *start);
  for (size_t k = 0; k < places->count; k++) {
    int32_t place = order[k];
    if (k == 0 || !is_same(places, place, order[k - 1])) {
      start[places->column[place] + 1]++;
      row[used++] = places->row[place];
    }
    slot[place] = used - 1;
  }
  accumulate(n, start);
}

baum_status baum_i_compress(const baum_i_places *places, int32_t n, int32_t *start, int32_t *row,
                            int32_t *slot)
{
  int32_t *order = baum_i_alloc(places->count, sizeof *order);
  int32_t *by_row = baum_i_alloc(places->count, sizeof *by_row);
  bool complete = order && by_row;
  if (complete) {
    for (size_t k = 0; k < places->count; k++) {
      order[k] = (int32_t)k;
    }
    sort_by(places->row, places->count, n, order, start, by_row);
    sort_by(places->column, places->count, n, by_row, start, order);
    assign(places, order, n, start, row, slot);
  }
  baum_i_free(order);
  baum_i_free(by_row);
  return complete ? BAUM_OK : BAUM_ERR_MEMORY;
}
