/* SPDX-License-Identifier: BSD-3-Clause */
/* Definitions, options and mechanisms drawn from the bytes of a fuzzer: whatever a caller may hand
 * in, sensible or not. Pointers are good or NULL, and arrays as long as they are said to be: nobody
 * can check these.
 */
#ifndef BAUM_FUZZ_DRAWN_H
#define BAUM_FUZZ_DRAWN_H

#include "bytes.h"
#include "every_element.h"

enum { DRAWN_MOST = 24, DRAWN_ROOM = 8, DRAWN_NAME = 300 };

/* `user` of all functions of one element. Its functions are those of one unknown, q[0]; every so
 * often one fails. */
typedef struct design_user {
  int size;   /* of the mass matrix */
  int calls;  /* until the one that fails; 0: none does */
  int answer; /* of that, or 0: NaN */
} design_user;

/* Elements that there are, and what their definitions point to. */
typedef struct design_mechanism {
  baum_mechanism *mechanism;
  any_id ids[3][DRAWN_MOST]; /* bodies, joints, forces */
  int kinds[3][DRAWN_MOST];  /* of element_kinds */
  int counts[3];
  baum_input_id input; /* all-zero: none */
  design_user users[3 * DRAWN_MOST];
  int user_count;
  double numbers[4][DRAWN_ROOM];
  baum_body_id bodies[DRAWN_ROOM];
  char name[DRAWN_NAME];
} design_mechanism;

/* 0, 1, 2: body, joint, force. */
int design_family(const element_kind *kind);

/* What its arrays and name point to is good until the next one is drawn. */
void design_definition(design_mechanism *m, fuzz_bytes *b, const element_kind *kind, any_def *def);

/* A mechanism, and calls of all kinds on it while it is built; not frozen. */
void design_mechanism_make(design_mechanism *m, fuzz_bytes *b);
void design_mechanism_destroy(design_mechanism *m);

/* Options of which most are good, without `progress` and `user`; at most `steps` steps in a call.
 * Factors on gains of rows are in `factors` (DRAWN_ROOM). */
void design_options(fuzz_bytes *b, int steps, double factors[DRAWN_ROOM],
                    baum_simulation_options *out);

#endif
