/* SPDX-License-Identifier: BSD-3-Clause */
/* Problems on which gain rules are measured, from perturbed starts, with a reference for each. */
#ifndef BAUM_BENCH_GAIN_PROBLEMS_H
#define BAUM_BENCH_GAIN_PROBLEMS_H

#include "models.h"

enum { GAIN_STARTS = 5 };

/* One start and the motion from there on. */
typedef struct gain_start {
  double t;
  double *q;    /* (nq) */
  double *v;    /* (nv) */
  double *rows; /* (samples x nq) the motion at the sample times */
} gain_start;

typedef struct gain_problem {
  const char *name;
  model m;
  int nq;
  int samples;
  const double *t;     /* (samples) [s] past every start */
  const double *scale; /* (nq) a length or 1 rad; of a run that is kept */
  gain_start starts[GAIN_STARTS];
  double apart; /* of the references, from those at half the steps, over all starts */
  baum_simulation *kept;
} gain_problem;

int gain_problem_count(void);

/* Build problem k, perturb its start by a lot of random numbers, and integrate the references: RK4
 * with projection, at steps so small that halving them changes nothing that matters. False, with
 * the reason in baum_message(). */
bool gain_problem_make(int k, int lot, gain_problem *out);
void gain_problem_clear(gain_problem *problem);

/* Largest difference over all samples, relative to the scales. */
double gain_problem_error(const gain_problem *problem, const double *rows, const double *expected);

#endif
