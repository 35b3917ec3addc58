/* SPDX-License-Identifier: BSD-3-Clause */
/* Definitions, options and mechanisms chosen by the bytes of a fuzzer: everything a caller may
 * pass, sensible or not. Pointers are valid or NULL, and arrays have at least their stated length,
 * because the library cannot check these. */
#ifndef BAUM_FUZZ_DRAWN_H
#define BAUM_FUZZ_DRAWN_H

#include "bytes.h"
#include "every_element.h"

enum { DRAWN_MOST = 24, DRAWN_ROOM = 8, DRAWN_NAME = 300 };

/* `user` of all functions of one element. The functions depend on one unknown, q[0]. In some
 * elements one call fails. */
typedef struct design_user {
  int size;   /* of the mass matrix */
  int calls;  /* number of the call that fails; 0: none */
  int answer; /* what that call returns; 0: it succeeds with NaN as its result */
} design_user;

/* The existing elements, and the data to which their definitions point. */
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

/* Returns 0 for a body, 1 for a joint, 2 for a force. */
int design_family(const element_kind *kind);

/* Chooses a definition. Its arrays and its name are valid until the next call. */
void design_definition(design_mechanism *m, fuzz_bytes *b, const element_kind *kind, any_def *def);

/* Makes a mechanism with arbitrary calls; it is not frozen. */
void design_mechanism_make(design_mechanism *m, fuzz_bytes *b);
void design_mechanism_destroy(design_mechanism *m);

/* Chooses options, most of them valid, with at most `steps` steps in a call and without `progress`
 * and `user`. `factors` (DRAWN_ROOM) receives factors on gains of rows. */
void design_options(fuzz_bytes *b, int steps, double factors[DRAWN_ROOM],
                    baum_simulation_options *out);

#endif
