/* SPDX-License-Identifier: BSD-3-Clause */
/* A run as a list of parts: plain structs and arrays, each with its place in the run. save.c makes
 * the list and restores it. BAUM_I_SAVED_VERSION rises whenever a part or its meaning changes;
 * tests/unit/test_saved.c records the sizes of each version.
 *
 * Plain structs hold numbers only, with flags as int32_t, so that any bytes are valid. The parts of
 * an object are its members up to the first that is not saved. */
#ifndef BAUM_I_SIMULATE_SAVED_H
#define BAUM_I_SIMULATE_SAVED_H

#include <stddef.h>

#include "simulate/run.h"

enum { BAUM_I_SAVED_VERSION = 11, BAUM_I_SAVED_PARTS = 96, BAUM_I_SAVED_TEXT = 32 };

/* Parts that are read by name, in this order; the others are copied back as they are. */
enum {
  BAUM_I_SAVED_IDENTITY,
  BAUM_I_SAVED_OMITTED,
  BAUM_I_SAVED_PARAMETERS,
  BAUM_I_SAVED_JUMPS,
  BAUM_I_SAVED_PROGRESS,
  BAUM_I_SAVED_CROSSINGS
};

enum { BAUM_I_SAVED_FACTS = 19 };

/* What must agree between the saved run and this one. */
typedef struct baum_i_saved_identity {
  char integrator[BAUM_I_SAVED_TEXT];
  char formulation[BAUM_I_SAVED_TEXT];
  double facts[BAUM_I_SAVED_FACTS];
} baum_i_saved_identity;

typedef struct baum_i_saved_part {
  void *place;
  size_t unit;   /* bytes of an entry */
  int64_t count; /* entries in this run */
  int64_t least; /* limits of the entries in a buffer */
  int64_t most;
  int counters; /* int64_t at the beginning that keep counting up */
} baum_i_saved_part;

struct baum_i_saved {
  int count;
  baum_i_saved_part parts[BAUM_I_SAVED_PARTS];
  baum_i_saved_identity identity;
};

/* Add a plain struct whose first numbers are counters. */
void baum_i_saved_add(baum_i_saved *list, void *place, size_t size, int counters);

/* Add exactly `count` of them. */
void baum_i_saved_add_all(baum_i_saved *list, void *place, size_t unit, int count);
void baum_i_saved_add_array(baum_i_saved *list, double *values, int count);
void baum_i_saved_add_state(baum_i_saved *list, const baum_mechanism *m, baum_i_state *state);

/* Add the first `count` of a list with room for `most`; all of these if there were more. */
void baum_i_saved_add_some(baum_i_saved *list, void *place, size_t unit, int64_t count,
                           int64_t most);

/* save.c: list all parts of a run. */
void baum_i_saved_list(baum_simulation *run, baum_i_saved *list);

/* Largest size of the list in bytes. Writing it returns the actual end. */
size_t baum_i_saved_size(const baum_i_saved *list);
unsigned char *baum_i_saved_write(const baum_i_saved *list, unsigned char *to);

/* Where the parts of a buffer are. */
typedef struct baum_i_saved_places {
  const unsigned char *at[BAUM_I_SAVED_PARTS];
  int64_t count[BAUM_I_SAVED_PARTS];
} baum_i_saved_places;

/* Find the parts of the list in a buffer, which must hold nothing else. Returns NULL, or what is
 * wrong. */
const char *baum_i_saved_find(const baum_i_saved *list, const unsigned char *from, size_t size,
                              baum_i_saved_places *out);

#endif
