/* SPDX-License-Identifier: BSD-3-Clause */
/* The saved data of a run as a list of parts: plain structs and arrays, with their addresses in the
 * run. save.c creates the list and restores the parts. BAUM_I_SAVED_VERSION must be increased
 * whenever a part or its meaning changes; tests/unit/test_saved.c records the sizes of each
 * version.
 *
 * Plain structs contain only numbers, with flags as int32_t, so that arbitrary bytes are valid. If
 * only some members of a struct are saved, they are its first members and form one part. */
#ifndef BAUM_I_SIMULATE_SAVED_H
#define BAUM_I_SIMULATE_SAVED_H

#include <stddef.h>

#include "simulate/run.h"

enum { BAUM_I_SAVED_VERSION = 13, BAUM_I_SAVED_PARTS = 96, BAUM_I_SAVED_TEXT = 32 };

/* The first parts of the list, in this order, which are checked. All other parts are only
 * copied. */
enum {
  BAUM_I_SAVED_IDENTITY,
  BAUM_I_SAVED_OMITTED,
  BAUM_I_SAVED_PARAMETERS,
  BAUM_I_SAVED_JUMPS,
  BAUM_I_SAVED_PROGRESS,
  BAUM_I_SAVED_CROSSINGS
};

enum { BAUM_I_SAVED_FACTS = 19 };

/* Data that must be the same for the saved run and the run that is restored. */
typedef struct baum_i_saved_identity {
  char integrator[BAUM_I_SAVED_TEXT];
  char formulation[BAUM_I_SAVED_TEXT];
  double facts[BAUM_I_SAVED_FACTS];
} baum_i_saved_identity;

typedef struct baum_i_saved_part {
  void *place;
  size_t unit;   /* bytes per entry */
  int64_t count; /* number of entries in this run */
  int64_t least; /* least and largest number of entries in a buffer */
  int64_t most;
  int counters; /* number of int64_t counters at the beginning */
} baum_i_saved_part;

struct baum_i_saved {
  int count;
  baum_i_saved_part parts[BAUM_I_SAVED_PARTS];
  baum_i_saved_identity identity;
};

/* Add a plain struct that begins with `counters` counters. */
void baum_i_saved_add(baum_i_saved *list, void *place, size_t size, int counters);

/* Add an array of exactly `count` entries. */
void baum_i_saved_add_all(baum_i_saved *list, void *place, size_t unit, int count);
void baum_i_saved_add_array(baum_i_saved *list, double *values, int count);
void baum_i_saved_add_state(baum_i_saved *list, const baum_mechanism *m, baum_i_state *state);

/* Add the first `count` entries, but at most `most`, of an array of `most` entries. */
void baum_i_saved_add_some(baum_i_saved *list, void *place, size_t unit, int64_t count,
                           int64_t most);

/* save.c: list all parts of a run. */
void baum_i_saved_list(baum_simulation *run, baum_i_saved *list);

/* The first function returns the largest size of the list in bytes. The second writes the list and
 * returns the end of the written bytes. */
size_t baum_i_saved_size(const baum_i_saved *list);
unsigned char *baum_i_saved_write(const baum_i_saved *list, unsigned char *to);

/* The addresses and numbers of entries of the parts in a buffer. */
typedef struct baum_i_saved_places {
  const unsigned char *at[BAUM_I_SAVED_PARTS];
  int64_t count[BAUM_I_SAVED_PARTS];
} baum_i_saved_places;

/* Find the parts of the list in a buffer, which must contain nothing else. Returns NULL, or a text
 * that tells what is wrong. */
const char *baum_i_saved_find(const baum_i_saved *list, const unsigned char *from, size_t size,
                              baum_i_saved_places *out);

#endif
