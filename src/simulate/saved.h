/* SPDX-License-Identifier: BSD-3-Clause */
/* The data that are saved for a run, as a list of parts. A part is a plain struct or an array
 * together with its address in the run. save.c makes the list and restores the parts. If a part or
 * its meaning changes, BAUM_I_SAVED_VERSION must be increased. tests/unit/test_saved.c records the
 * sizes of the parts for each version.
 *
 * Plain structs contain only numbers, and flags are stored as int32_t. Every sequence of bytes is
 * therefore a valid struct. If only some members of a struct are saved, they are its first members,
 * and together they form one part. */
#ifndef BAUM_I_SIMULATE_SAVED_H
#define BAUM_I_SIMULATE_SAVED_H

#include <stddef.h>

#include "simulate/run.h"

enum { BAUM_I_SAVED_VERSION = 15, BAUM_I_SAVED_PARTS = 96, BAUM_I_SAVED_TEXT = 32 };

/* The first parts of the list, in this order. They are checked before a run is restored. All other
 * parts are copied without a check. */
enum {
  BAUM_I_SAVED_IDENTITY,
  BAUM_I_SAVED_OMITTED,
  BAUM_I_SAVED_PARAMETERS,
  BAUM_I_SAVED_JUMPS,
  BAUM_I_SAVED_PROGRESS,
  BAUM_I_SAVED_CROSSINGS
};

enum { BAUM_I_SAVED_FACTS = 19 };

/* Data that must be the same in the saved run and in the run that is restored. */
typedef struct baum_i_saved_identity {
  char integrator[BAUM_I_SAVED_TEXT];
  char formulation[BAUM_I_SAVED_TEXT];
  double facts[BAUM_I_SAVED_FACTS];
} baum_i_saved_identity;

typedef struct baum_i_saved_part {
  void *place;
  size_t unit;   /* number of bytes in an entry */
  int64_t count; /* number of entries in this run */
  int64_t least; /* smallest and largest number of entries that saved data may have */
  int64_t most;
  int counters; /* number of counters (int64_t) at the beginning of the struct */
} baum_i_saved_part;

struct baum_i_saved {
  int count;
  baum_i_saved_part parts[BAUM_I_SAVED_PARTS];
  baum_i_saved_identity identity;
};

/* Add a plain struct to the list. The struct begins with as many int64_t counters as `counters`
 * says. */
void baum_i_saved_add(baum_i_saved *list, void *place, size_t size, int counters);

/* Add an array to the list. It always has exactly `count` entries. */
void baum_i_saved_add_all(baum_i_saved *list, void *place, size_t unit, int count);
void baum_i_saved_add_array(baum_i_saved *list, double *values, int count);
void baum_i_saved_add_state(baum_i_saved *list, const baum_mechanism *m, baum_i_state *state);

/* Add an array of at most `most` entries to the list. Only its first `count` entries are saved. */
void baum_i_saved_add_some(baum_i_saved *list, void *place, size_t unit, int64_t count,
                           int64_t most);

/* Make the list of all parts of a run (save.c). */
void baum_i_saved_list(baum_simulation *run, baum_i_saved *list);

/* The first function returns the largest number of bytes that the written list can have. The second
 * function writes the list and returns the end of the written bytes. */
size_t baum_i_saved_size(const baum_i_saved *list);
unsigned char *baum_i_saved_write(const baum_i_saved *list, unsigned char *to);

/* The address of each part in a buffer, and the number of its entries. */
typedef struct baum_i_saved_places {
  const unsigned char *at[BAUM_I_SAVED_PARTS];
  int64_t count[BAUM_I_SAVED_PARTS];
} baum_i_saved_places;

/* Find the parts of the list in a buffer. The buffer must not contain anything else. Returns NULL
 * on success, otherwise a text that tells what is wrong. */
const char *baum_i_saved_find(const baum_i_saved *list, const unsigned char *from, size_t size,
                              baum_i_saved_places *out);

#endif
