/* SPDX-License-Identifier: BSD-3-Clause */
/* Compresses a list of places in a square matrix to columns. */
#ifndef BAUM_I_LINEAR_COMPRESS_H
#define BAUM_I_LINEAR_COMPRESS_H

#include <stddef.h>
#include <stdint.h>

#include <baum/status.h>

/* Places by row and column, in any order; places may be repeated. */
typedef struct baum_i_places {
  size_t count;
  int32_t *row;
  int32_t *column;
} baum_i_places;

/* Makes room for `most` places and lists none. BAUM_OK or BAUM_ERR_MEMORY, also when an int32_t
 * cannot count them; the list is then empty. Sets no message. */
baum_status baum_i_places_create(size_t most, baum_i_places *places);
void baum_i_places_clear(baum_i_places *places); /* a zeroed one is valid */

static inline void baum_i_places_add(baum_i_places *places, int32_t row, int32_t column)
{
  places->row[places->count] = row;
  places->column[places->count] = column;
  places->count++;
}

/* Compresses a list of places in an n x n matrix. start (n + 1) and row (places->count, of which
 * start[n] are used) receive the distinct places by columns, rows ascending; slot (places->count)
 * receives the index of each listed place among them. BAUM_OK or BAUM_ERR_MEMORY, without a
 * message. */
baum_status baum_i_compress(const baum_i_places *places, int32_t n, int32_t *start, int32_t *row,
                            int32_t *slot);

#endif
