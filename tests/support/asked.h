/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism with every kind of user function. The functions of one kind can be made to fail, to
 * return NaN or to call the library.
 *
 * It consists of masses (user coordinates), a bead on a hoop (user constraint), two arms (coupling,
 * torsion spring, user force), a driven crank, and a pea on a curve with a spring. Its only input
 * is the stiffness of the masses.
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

/* The names of the element and of the function in messages. */
typedef struct asked_name {
  const char *element;
  const char *function;
} asked_name;

extern const asked_name asked_names[ASKED_KINDS];

typedef enum asked_fault { ASKED_FINE, ASKED_STOPS, ASKED_GIVES_NAN, ASKED_CALLS_BACK } asked_fault;

/* The `user` of all functions. */
typedef struct asked asked;

struct asked {
  asked_kind kind; /* the kind of functions that fails */
  asked_fault fault;
  int64_t calls; /* calls of that kind while it fails */
  bool inside;   /* prevents recursion */
  baum_mechanism *mechanism;
  baum_joint_id motor;
  baum_input_id input;
  baum_simulation *run;
  const baum_simulation *other; /* another run, for calls that need two */
  baum_workspace *w;
  void (*back)(asked *user); /* called instead of failing, if the fault is ASKED_CALLS_BACK */
};

/* Makes and freezes the mechanism, whose functions keep the address of *b. Fails the test on
 * failure. */
void asked_make(asked *b);

/* An event function that is never zero, and a progress function. Their `user` is the asked. */
int asked_gate(double t, const double *q, const double *v, const double *inputs, double *out,
               void *user);
int asked_progress(const baum_simulation *run, double t, void *user);

#endif
