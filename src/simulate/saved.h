/* SPDX-License-Identifier: BSD-3-Clause */
/* A run as a list of parts: plain structs and arrays, each where the run has it. save.c makes the
 * list and takes it back; BAUM_I_SAVED_VERSION is raised whenever a part, or its meaning, changes.
 * tests/unit/test_saved.c remembers which sizes each version had.
 *
 * Plain structs hold numbers alone; flags are int32_t, so that any bytes are some. Those that
 * belong to an object are its members up to the first that is not saved.
 */
#ifndef BAUM_I_SIMULATE_SAVED_H
#define BAUM_I_SIMULATE_SAVED_H

#include <stddef.h>

#include "simulate/run.h"

enum { BAUM_I_SAVED_VERSION = 10, BAUM_I_SAVED_PARTS = 96, BAUM_I_SAVED_TEXT = 32 };

/* Parts that are dealt with by name, in this order; the others are put back as they are. */
enum {
  BAUM_I_SAVED_IDENTITY,
  BAUM_I_SAVED_OMITTED,
  BAUM_I_SAVED_PARAMETERS,
  BAUM_I_SAVED_JUMPS,
  BAUM_I_SAVED_PROGRESS,
  BAUM_I_SAVED_CROSSINGS
};

enum { BAUM_I_SAVED_FACTS = 19 };

/* What must be here as it was there. */
typedef struct baum_i_saved_identity {
  char integrator[BAUM_I_SAVED_TEXT];
  char formulation[BAUM_I_SAVED_TEXT];
  double facts[BAUM_I_SAVED_FACTS];
} baum_i_saved_identity;

typedef struct baum_i_saved_part {
  void *place;
  size_t unit;   /* bytes of an entry */
  int64_t count; /* entries that are here, */
  int64_t least; /* and that there may be */
  int64_t most;
  int counters; /* numbers at the beginning, int64_t, that go on counting */
} baum_i_saved_part;

struct baum_i_saved {
  int count;
  baum_i_saved_part parts[BAUM_I_SAVED_PARTS];
  baum_i_saved_identity identity;
};

/* A plain struct, of which the first numbers are counters. */
void baum_i_saved_add(baum_i_saved *list, void *place, size_t size, int counters);

/* `count` of them, no more and no less. */
void baum_i_saved_add_all(baum_i_saved *list, void *place, size_t unit, int count);
void baum_i_saved_add_array(baum_i_saved *list, double *values, int count);
void baum_i_saved_add_state(baum_i_saved *list, const baum_mechanism *m, baum_i_state *state);

/* The first `count` of a list that has room for `most`, or all of these where there were more. */
void baum_i_saved_add_some(baum_i_saved *list, void *place, size_t unit, int64_t count,
                           int64_t most);

/* save.c: all of a run. */
void baum_i_saved_list(baum_simulation *run, baum_i_saved *list);

/* Bytes that the list takes at most; written, it ends where that returns. */
size_t baum_i_saved_size(const baum_i_saved *list);
unsigned char *baum_i_saved_write(const baum_i_saved *list, unsigned char *to);

/* Where the parts of a buffer are. */
typedef struct baum_i_saved_places {
  const unsigned char *at[BAUM_I_SAVED_PARTS];
  int64_t count[BAUM_I_SAVED_PARTS];
} baum_i_saved_places;

/* NULL, or what is wrong with these bytes: they have to be the parts of the list and nothing
 * else. */
const char *baum_i_saved_find(const baum_i_saved *list, const unsigned char *from, size_t size,
                              baum_i_saved_places *out);

#endif
