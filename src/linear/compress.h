/* SPDX-License-Identifier: BSD-3-Clause */
/* Converts a list of places in a square matrix to compressed columns. */
#ifndef BAUM_I_LINEAR_COMPRESS_H
#define BAUM_I_LINEAR_COMPRESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* A growing list of places, in any order. Places may be repeated. A zeroed list is empty. */
typedef struct baum_i_places {
  size_t count;
  struct baum_i_entry_place {
    int32_t row;
    int32_t column;
  } * list;    /* (count) */
  bool broken; /* memory has run out, or the list is too long for an int32_t */
} baum_i_places;

void baum_i_places_add(baum_i_places *places, int32_t row, int32_t column);

/* The pattern of an n x n matrix: the distinct places, column by column, with ascending rows. */
typedef struct baum_i_compressed {
  int32_t n;
  int32_t *start; /* (n + 1) */
  int32_t *row;   /* (start[n]) */
  int32_t *slot;  /* index of each listed place among the distinct ones */
} baum_i_compressed;

/* Compresses a list, which is empty afterwards. Returns BAUM_OK, or BAUM_ERR_MEMORY without a
 * message and with an empty *out. */
baum_status baum_i_compress(baum_i_places *places, int32_t n, baum_i_compressed *out);
void baum_i_compressed_clear(baum_i_compressed *compressed); /* a zeroed pattern is allowed */

#endif
