/* SPDX-License-Identifier: BSD-3-Clause */
/* A list of mechanisms with reference trajectories. */
#ifndef BAUM_BENCH_PROBLEMS_H
#define BAUM_BENCH_PROBLEMS_H

#include "reference.h"

typedef struct problem {
  const char *name; /* name for the command line */
  const char *what; /* description, which includes the duration */
  reference with;
  double step; /* [s] longest step that is useful */
  baum_status (*build)(model *out);
} problem;

/* Returns problem number k, or NULL if k is too large. */
const problem *problem_at(int k);

enum { PAIR_SIZE = 64 };
/* Writes an integrator and a formulation as a text of the form "integrator/formulation". */
void problem_pair(const baum_integrator *integrator, baum_formulation formulation,
                  char text[PAIR_SIZE]);

#endif
