/* SPDX-License-Identifier: BSD-3-Clause */
/* Problems for measuring gain rules, with perturbed starts and a reference for each. */
#ifndef BAUM_BENCH_GAIN_PROBLEMS_H
#define BAUM_BENCH_GAIN_PROBLEMS_H

#include "models.h"

enum { GAIN_STARTS = 5 };

/* A start and its reference motion. */
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
  const double *t;     /* (samples) [s] all after the start */
  const double *scale; /* (nq) length [m] or 1 rad; owned by kept */
  gain_start starts[GAIN_STARTS];
  double apart; /* largest difference between a reference and the same with twice the step */
  baum_simulation *kept;
} gain_problem;

int gain_problem_count(void);

/* Builds problem k, perturbs its start with the random numbers of set `lot`, and integrates the
 * references: RK4 with projection, at small steps. Returns false with the reason in
 * baum_message(). */
bool gain_problem_make(int k, int lot, gain_problem *out);
void gain_problem_clear(gain_problem *problem);

/* Returns the largest difference of rows from expected, relative to the scales. */
double gain_problem_error(const gain_problem *problem, const double *rows, const double *expected);

#endif
