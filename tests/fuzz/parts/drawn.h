/* SPDX-License-Identifier: BSD-3-Clause */
/* Definitions, options and mechanisms that the bytes of a fuzzer determine. They contain everything
 * that a caller may pass, sensible or not. The exception is what the library cannot check: pointers
 * are always valid or NULL, and arrays have at least the stated length. */
#ifndef BAUM_FUZZ_DRAWN_H
#define BAUM_FUZZ_DRAWN_H

#include "bytes.h"
#include "every_element.h"

enum { DRAWN_MOST = 24, DRAWN_ROOM = 8, DRAWN_NAME = 300 };

/* The `user` of all functions of one element points to this struct. The functions depend only on
 * one coordinate, q[0]. In some elements, one call of a function fails. */
typedef struct design_user {
  int size;   /* number of rows of the mass matrix */
  int calls;  /* number of the call that fails; 0 if none fails */
  int answer; /* what this call returns; 0 if it succeeds with NaN as its result */
} design_user;

/* The elements that exist, and the data to which their definitions point. */
typedef struct design_mechanism {
  baum_mechanism *mechanism;
  any_id ids[3][DRAWN_MOST]; /* ids of bodies, joints and forces */
  int kinds[3][DRAWN_MOST];  /* indices in element_kinds */
  int counts[3];
  baum_input_id input; /* {0, 0} if there is none */
  design_user users[3 * DRAWN_MOST];
  int user_count;
  double numbers[4][DRAWN_ROOM];
  baum_body_id bodies[DRAWN_ROOM];
  char name[DRAWN_NAME];
} design_mechanism;

/* Returns 0 for a body, 1 for a joint, 2 for a force. */
int design_family(const element_kind *kind);

/* Chooses a definition. Its arrays and its name are valid until the next call. */
void design_definition(design_mechanism *m, fuzz_bytes *b, const element_kind *kind, any_def *def);

/* Makes a mechanism by arbitrary calls. The mechanism is not frozen. */
void design_mechanism_make(design_mechanism *m, fuzz_bytes *b);
void design_mechanism_destroy(design_mechanism *m);

/* Chooses options, most of which are valid. max_steps is at most `steps`. `progress` and `user`
 * keep their defaults. `factors` (DRAWN_ROOM) is memory for factors on the gains of rows. */
void design_options(fuzz_bytes *b, int steps, double factors[DRAWN_ROOM],
                    baum_simulation_options *out);

#endif
