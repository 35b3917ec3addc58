/* SPDX-License-Identifier: BSD-3-Clause */
/* Reference motions in reduced coordinates y, and how much they amplify perturbations. */
#ifndef BAUM_BENCH_SWEEP_MOTION_H
#define BAUM_BENCH_SWEEP_MOTION_H

#include "sweep_scenes.h"

enum { SWEEP_NUMBERS = 4 };

typedef struct sweep_motion {
  void (*rate)(const void *data, const long double *y, long double *dy);
  void (*q)(const void *data, const long double *y, long double *q);
  const void *data;
  int n; /* numbers in y */
  long double y[SWEEP_NUMBERS];
  int directions; /* of perturbations at the start */
  long double direction[SWEEP_NUMBERS][SWEEP_NUMBERS];
} sweep_motion;

/* Samples into s and, where it is asked for, growth; leaves the end in m->y. */
void sweep_follow(sweep_scene *s, sweep_motion *m, bool growth);

/* End the program unless it is so. */
void sweep_must(bool fine, const char *what);

#endif
