/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes the parts of saved data as bytes. For each part it writes the number of its entries and
 * then the entries, followed by unused bytes up to a whole word. */
#include "simulate/saved.h"

#include <assert.h>
#include <string.h>

enum { WORD = sizeof(uint64_t) };

/* ---- the list ---- */

void baum_i_saved_add_some(baum_i_saved *list, void *place, size_t unit, int64_t count,
                           int64_t most)
{
  assert(list->count < BAUM_I_SAVED_PARTS);
  list->parts[list->count++] = (baum_i_saved_part){
    .place = place, .unit = unit, .count = count < most ? count : most, .most = most};
}

void baum_i_saved_add_all(baum_i_saved *list, void *place, size_t unit, int count)
{
  baum_i_saved_add_some(list, place, unit, count, count);
  list->parts[list->count - 1].least = count;
}

void baum_i_saved_add(baum_i_saved *list, void *place, size_t size, int counters)
{
  baum_i_saved_add_all(list, place, size, 1);
  list->parts[list->count - 1].counters = counters;
}

void baum_i_saved_add_array(baum_i_saved *list, double *values, int count)
{
  baum_i_saved_add_all(list, values, sizeof *values, count);
}

void baum_i_saved_add_state(baum_i_saved *list, const baum_mechanism *m, baum_i_state *state)
{
  baum_i_saved_add_array(list, &state->t, 1);
  baum_i_saved_add_array(list, state->q, m->nq);
  baum_i_saved_add_array(list, state->v, m->nv);
}

/* ---- bytes ---- */

static size_t padded(size_t size)
{
  return (size + WORD - 1) / WORD * WORD;
}

size_t baum_i_saved_size(const baum_i_saved *list)
{
  size_t size = 0;
  for (int k = 0; k < list->count; k++) {
    const baum_i_saved_part *part = &list->parts[k];
    int64_t most = part->most == INT64_MAX ? part->count : part->most;
    size += WORD + padded((size_t)most * part->unit);
  }
  return size;
}

unsigned char *baum_i_saved_write(const baum_i_saved *list, unsigned char *to)
{
  for (int k = 0; k < list->count; k++) {
    const baum_i_saved_part *part = &list->parts[k];
    size_t size = (size_t)part->count * part->unit;
    memcpy(to, &part->count, WORD);
    to += WORD;
    if (size > 0) {
      memcpy(to, part->place, size);
      memset(to + size, 0, padded(size) - size);
    }
    to += padded(size);
  }
  return to;
}

/* Tell whether counters are so small that no run can make them overflow. */
static bool counters_are_sound(const unsigned char *at, int counters)
{
  bool sound = true;
  for (int k = 0; k < counters; k++) {
    int64_t value = 0;
    memcpy(&value, at + (size_t)k * sizeof value, sizeof value);
    sound = sound && value >= 0 && value <= INT64_MAX / 2;
  }
  return sound;
}

const char *baum_i_saved_find(const baum_i_saved *list, const unsigned char *from, size_t size,
                              baum_i_saved_places *out)
{
  size_t left = size;
  for (int k = 0; k < list->count; k++) {
    const baum_i_saved_part *part = &list->parts[k];
    int64_t count = -1;
    if (left >= WORD) {
      memcpy(&count, from, WORD);
      left -= WORD;
    }
    if (count < part->least || count > part->most || (size_t)count > left / part->unit) {
      return "does not fit: it has other parts; save and restore with the same library version";
    }
    out->at[k] = from + WORD;
    out->count[k] = count;
    if (count > 0 && !counters_are_sound(out->at[k], part->counters)) {
      return "is damaged: a counter is out of range";
    }
    size_t used = padded((size_t)count * part->unit);
    left -= used;
    from += WORD + used;
  }
  return left == 0 ? NULL : "does not fit: other data follow it";
}
