/* SPDX-License-Identifier: BSD-3-Clause */
/* Compresses a list of places. The list is sorted by row, and then by column, with a stable sort in
 * linear time. The rows of each column then ascend, and repeated places are adjacent. */
#include "linear/compress.h"

#include <string.h>

#include "base/alloc.h"

typedef struct baum_i_entry_place place;

void baum_i_places_add(baum_i_places *places, int32_t row, int32_t column)
{
  place *list = places->broken || places->count == INT32_MAX
                  ? NULL
                  : baum_i_grow_by_one(places->list, places->count + 1, sizeof *list);
  places->broken = !list;
  if (list) {
    places->list = list;
    list[places->count++] = (place){row, column};
  }
}

/* Converts counts to starts. On entry start[j + 1] is the number of places in row or column j < n.
 * On return start[j] is the index of the first of them. */
static void accumulate(int32_t n, int32_t *start)
{
  for (int32_t j = 0; j < n; j++) {
    start[j + 1] += start[j];
  }
}

/* Stably sorts the indices `before` by row or column into `after`. next (n + 1) is scratch
 * memory. */
static void sort_by(const baum_i_places *places, bool column, int32_t n, const int32_t *before,
                    int32_t *next, int32_t *after)
{
  const place *list = places->list;
  memset(next, 0, ((size_t)n + 1) * sizeof *next);
  for (size_t k = 0; k < places->count; k++) {
    next[(column ? list[k].column : list[k].row) + 1]++;
  }
  accumulate(n, next);
  for (size_t k = 0; k < places->count; k++) {
    const place *at = &list[before[k]];
    after[next[column ? at->column : at->row]++] = before[k];
  }
}

/* Numbers the places in ascending order. Repeated places share a slot. */
static void number_places(const baum_i_places *places, const int32_t *order,
                          const baum_i_compressed *out)
{
  int32_t used = 0;
  memset(out->start, 0, ((size_t)out->n + 1) * sizeof *out->start);
  for (size_t k = 0; k < places->count; k++) {
    const place *at = &places->list[order[k]];
    const place *last = k > 0 ? &places->list[order[k - 1]] : NULL;
    if (!last || at->row != last->row || at->column != last->column) {
      out->start[at->column + 1]++;
      out->row[used++] = at->row;
    }
    out->slot[order[k]] = used - 1;
  }
  accumulate(out->n, out->start);
}

baum_status baum_i_compress(baum_i_places *places, int32_t n, baum_i_compressed *out)
{
  int32_t *order = baum_i_alloc(places->count, sizeof *order);
  int32_t *by_row = baum_i_alloc(places->count, sizeof *by_row);
  *out = (baum_i_compressed){.n = n,
                             .start = baum_i_alloc((size_t)n + 1, sizeof *out->start),
                             .row = baum_i_alloc(places->count, sizeof *out->row),
                             .slot = baum_i_alloc(places->count, sizeof *out->slot)};
  bool complete = order && by_row && out->start && out->row && out->slot && !places->broken;
  if (complete) {
    for (size_t k = 0; k < places->count; k++) {
      order[k] = (int32_t)k;
    }
    sort_by(places, false, n, order, out->start, by_row);
    sort_by(places, true, n, by_row, out->start, order);
    number_places(places, order, out);
  } else {
    baum_i_compressed_clear(out);
  }
  baum_i_free(order);
  baum_i_free(by_row);
  baum_i_free(places->list);
  *places = (baum_i_places){0};
  return complete ? BAUM_OK : BAUM_ERR_MEMORY;
}

void baum_i_compressed_clear(baum_i_compressed *compressed)
{
  baum_i_free(compressed->start);
  baum_i_free(compressed->row);
  baum_i_free(compressed->slot);
  *compressed = (baum_i_compressed){0};
}
