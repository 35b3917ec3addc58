/* SPDX-License-Identifier: BSD-3-Clause */
/* Problems on which the rules for gains are tested. Each has perturbed starts and a reference for
 * each start. */
#ifndef BAUM_BENCH_GAIN_PROBLEMS_H
#define BAUM_BENCH_GAIN_PROBLEMS_H

#include "models.h"

enum { GAIN_STARTS = 5 };

/* A start and its reference motion. */
typedef struct gain_start {
  double t;
  double *q;    /* (nq) */
  double *v;    /* (nv) */
  double *rows; /* (samples x nq) the positions at the sample times */
} gain_start;

typedef struct gain_problem {
  const char *name;
  model m;
  int nq;
  int samples;
  const double *t;     /* (samples) [s] times, all after the start */
  const double *scale; /* (nq) a length [m] or 1 rad; `kept` owns this memory */
  gain_start starts[GAIN_STARTS];
  /* Largest difference between the references and the same motions computed with twice the step. */
  double apart;
  baum_simulation *kept;
} gain_problem;

int gain_problem_count(void);

/* Builds problem k, perturbs its start with the random numbers of set `lot`, and integrates the
 * references by RK4 with projection and small steps. If this fails, returns false, and
 * baum_message() gives the reason. */
bool gain_problem_make(int k, int lot, gain_problem *out);
void gain_problem_clear(gain_problem *problem);

/* Returns the largest difference between `rows` and `expected`, relative to the scales. */
double gain_problem_error(const gain_problem *problem, const double *rows, const double *expected);

#endif
