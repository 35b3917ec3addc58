/* SPDX-License-Identifier: BSD-3-Clause */
/* A growing array of items of one type, used while structures are built. */
#ifndef BAUM_I_LINEAR_VECTOR_H
#define BAUM_I_LINEAR_VECTOR_H

#include <stdint.h>
#include <string.h>

#include <baum/status.h>

#include "base/alloc.h"

typedef struct baum_i_vector {
  void *items;
  int count;
  int room;
  size_t size; /* of an item */
} baum_i_vector;

/* Appends a zeroed item and returns it, or NULL when out of memory. */
static inline void *baum_i_vector_append(baum_i_vector *v)
{
  if (v->count == v->room) {
    int room = v->room > 0 ? 2 * v->room : 16;
    void *grown = baum_i_grow(v->items, (size_t)room, v->size);
    if (!grown) {
      return NULL;
    }
    v->items = grown;
    v->room = room;
  }
  void *item = (char *)v->items + (size_t)v->count++ * v->size;
  memset(item, 0, v->size);
  return item;
}

static inline baum_status baum_i_vector_append_number(baum_i_vector *v, int32_t number)
{
  int32_t *item = baum_i_vector_append(v);
  if (!item) {
    return BAUM_ERR_MEMORY;
  }
  *item = number;
  return BAUM_OK;
}

/* Transfers the array to the caller, who frees it. */
static inline void *baum_i_vector_give(baum_i_vector *v, int *count)
{
  void *items = v->items;
  *count = v->count;
  v->items = NULL;
  return items;
}

#endif
