/* SPDX-License-Identifier: BSD-3-Clause */
/* What is saved of a run: one list, by which save.c writes, checks and puts back.
 *
 * Whoever adds something to a run that a later step reads adds it to the list too: in saved.c, or where it is made, as
 * account.c does. BAUM_I_SAVED_VERSION is raised whenever the list, or the meaning of a part, changes;
 * tests/unit/test_saved.c remembers which list each version had.
 */
#ifndef BAUM_I_SIMULATE_SAVED_H
#define BAUM_I_SIMULATE_SAVED_H

#include "simulate/run.h"

enum { BAUM_I_SAVED_VERSION = 8, BAUM_I_SAVED_PARTS = 160, BAUM_I_SAVED_TEXT = 32 };

typedef enum baum_i_saved_kind {
  /* must be here as it was there: */
  BAUM_I_SAVED_NUMBER,  /* a double */
  BAUM_I_SAVED_INTEGER, /* an int64_t */
  BAUM_I_SAVED_TEXT_OF, /* a text, of less than BAUM_I_SAVED_TEXT characters */
  BAUM_I_SAVED_CHOICE,  /* bytes */
  /* is put back: */
  BAUM_I_SAVED_STATE,   /* bytes */
  BAUM_I_SAVED_BOUNDED, /* a bool, int32_t or int64_t, which must be within bounds */
  BAUM_I_SAVED_NUMBERS, /* the run's own parameters, if it has some */
  BAUM_I_SAVED_JUMPS,   /* of the run's inputs, as many as there are */
  BAUM_I_SAVED_ROWS,    /* which rows are left out, as many as here */
  BAUM_I_SAVED_SOME     /* as many of a list as there are */
} baum_i_saved_kind;

typedef struct baum_i_saved_part {
  const char *name; /* in sentences; also tells the part from others */
  baum_i_saved_kind kind;
  void *place; /* not written to where it must agree */
  size_t size; /* at most, in bytes */
  size_t used; /* of SOME, in bytes */
  size_t unit; /* of SOME, one of the list */
  double number;
  int64_t integer; /* of JUMPS, inputs that there are; of ROWS, how many are left out */
  int64_t least;   /* of BOUNDED */
  int64_t most;
} baum_i_saved_part;

struct baum_i_saved {
  int count;
  baum_i_saved_part parts[BAUM_I_SAVED_PARTS];
};

/* Bytes that are put back. */
void baum_i_saved_add(baum_i_saved *list, const char *name, void *place, size_t size);

/* Likewise a whole number of 1, 4 or 8 bytes that is used as one: a count, an index, a flag. */
void baum_i_saved_add_bounded(baum_i_saved *list, const char *name, void *place, size_t size,
                              int64_t least, int64_t most);

/* Likewise the first `count` of a list that has room for `most`, or all of these where there were more. */
void baum_i_saved_add_some(baum_i_saved *list, const char *name, void *place, size_t unit,
                           int64_t count, int64_t most);

/* What must be here as it was there. */
void baum_i_saved_compare(baum_i_saved *list, const char *name, int64_t value);

/* For one object. */
#define BAUM_I_SAVED_ADD(list, name, object) \
  baum_i_saved_add((list), (name), &(object), sizeof(object))

#define BAUM_I_SAVED_ADD_BOUNDED(list, name, object, least, most) \
  baum_i_saved_add_bounded((list), (name), &(object), sizeof(object), (least), (most))
#define BAUM_I_SAVED_ADD_FLAG(list, name, object) BAUM_I_SAVED_ADD_BOUNDED(list, name, object, 0, 1)
/* One that may go on to count for ever. */
#define BAUM_I_SAVED_ADD_COUNT(list, name, object) \
  BAUM_I_SAVED_ADD_BOUNDED(list, name, object, 0, INT64_MAX / 2)

/* All of a run. */
void baum_i_saved_list(baum_simulation *run, baum_i_saved *list);

#endif
