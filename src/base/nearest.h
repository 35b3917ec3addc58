/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds, for messages, the known name that is most similar to a misspelt name. */
#ifndef BAUM_I_BASE_NEAREST_H
#define BAUM_I_BASE_NEAREST_H

#include "base/text.h"

/* A search. Begin with baum_i_nearest_to(), then offer every known name. */
typedef struct baum_i_nearest {
  const char *given;
  const char *name; /* the most similar name so far; NULL: none is similar */
  int distance;     /* number of characters to insert, delete or replace; see nearest.c */
} baum_i_nearest;

baum_i_nearest baum_i_nearest_to(const char *given);
void baum_i_nearest_offer(baum_i_nearest *search, const char *name);

/* Return the end of a message, such as `; did you mean "mass"?`. If no name is similar, return
 * "". */
baum_i_text baum_i_nearest_note(const baum_i_nearest *search);

#endif
