/* SPDX-License-Identifier: BSD-3-Clause */
/* A list of mechanisms with reference trajectories. */
#ifndef BAUM_BENCH_PROBLEMS_H
#define BAUM_BENCH_PROBLEMS_H

#include "reference.h"

typedef struct problem {
  const char *name; /* for the command line */
  const char *what; /* description with duration */
  reference with;
  double step; /* [s] longest useful step */
  baum_status (*build)(model *out);
} problem;

/* Returns NULL if k is too large. */
const problem *problem_at(int k);

/* "integrator/formulation" of a pair. */
enum { PAIR_SIZE = 64 };
void problem_pair(const baum_integrator *integrator, baum_formulation formulation,
                  char text[PAIR_SIZE]);

#endif
