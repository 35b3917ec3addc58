/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism with every kind of user function. All functions of one kind can be made to fail, to
 * return NaN, or to call the library.
 *
 * The mechanism contains masses with user coordinates, a bead that a user constraint keeps on a
 * hoop, and two arms with a coupling, a torsion spring and a user force. It also contains a driven
 * crank, and a particle (the pea) that moves on a curve and is attached to a spring. Its only input
 * is the stiffness of the spring that acts on the masses.
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

/* The names with which messages identify an element and its user function. */
typedef struct asked_name {
  const char *element;
  const char *function;
} asked_name;

extern const asked_name asked_names[ASKED_KINDS];

typedef enum asked_fault { ASKED_FINE, ASKED_STOPS, ASKED_GIVES_NAN, ASKED_CALLS_BACK } asked_fault;

/* All functions receive a pointer to this struct as their `user`. */
typedef struct asked asked;

struct asked {
  asked_kind kind; /* the kind of functions that fails */
  asked_fault fault;
  int64_t calls; /* how often functions of that kind were called while they had to fail */
  bool inside;   /* set during a call, to prevent recursion */
  baum_mechanism *mechanism;
  baum_joint_id motor;
  baum_input_id input;
  baum_simulation *run;
  const baum_simulation *other; /* another run, for calls that need two */
  baum_workspace *w;
  void (*back)(asked *user); /* called instead of failing, if the fault is ASKED_CALLS_BACK */
};

/* Makes the mechanism and freezes it. The functions of the mechanism keep the address of *b. If a
 * call fails, the test fails. */
void asked_make(asked *b);

/* An event function that never becomes zero, and a progress function. Their `user` is a pointer to
 * a struct `asked`. */
int asked_gate(double t, const double *q, const double *v, const double *inputs, double *out,
               void *user);
int asked_progress(const baum_simulation *run, double t, void *user);

#endif
