/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism with every kind of function that a user may give, each of which can be put at fault,
 * or calls back.
 *
 *   masses (user coordinates), a bead on a hoop (user constraint), two arms (coupling, torsion
 *   spring, user force), a driven crank, a pea on a curve with a spring; one input, the stiffness
 *   of the masses
 */
#ifndef BAUM_TEST_ASKED_H
#define BAUM_TEST_ASKED_H

#include <baum/baum.h>

enum { ASKED_NV = 14, ASKED_NC = 10 };

typedef enum asked_kind {
  ASKED_MASS,
  ASKED_FORCE,
  ASKED_POTENTIAL,
  ASKED_PHI,
  ASKED_JACOBIAN,
  ASKED_NU,
  ASKED_GAMMA,
  ASKED_GUST,
  ASKED_WEIGHT,
  ASKED_TWIST,
  ASKED_COIL,
  ASKED_LEAD,
  ASKED_MOTOR,
  ASKED_TRACK,
  ASKED_EVENT,
  ASKED_KINDS,
  ASKED_PROGRESS = ASKED_KINDS
} asked_kind;

/* Element and function as messages name them. */
typedef struct asked_name {
  const char *element;
  const char *function;
} asked_name;

extern const asked_name asked_names[ASKED_KINDS];

typedef enum asked_fault { ASKED_FINE, ASKED_STOPS, ASKED_GIVES_NAN, ASKED_CALLS_BACK } asked_fault;

/* `user` of all functions. */
typedef struct asked asked;

struct asked {
  asked_kind kind; /* which of them is at fault */
  asked_fault fault;
  int64_t calls; /* of that kind, while it is at fault */
  bool inside;   /* what it calls calls it again */
  baum_mechanism *mechanism;
  baum_joint_id motor;
  baum_input_id input;
  baum_simulation *run;
  const baum_simulation *other; /* to go on from */
  baum_workspace *w;
  void (*back)(asked *user); /* what it does when it calls back */
};

/* Frozen; the functions have the address of *b. Fails the test on failure. */
void asked_make(asked *b);

/* Of an event, which is never zero, and of a run; their `user` is the asked. */
int asked_gate(double t, const double *q, const double *v, const double *inputs, double *out,
               void *user);
int asked_progress(const baum_simulation *run, double t, void *user);

#endif
