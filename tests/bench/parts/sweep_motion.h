/* SPDX-License-Identifier: BSD-3-Clause */
/* Reference motions in reduced coordinates y, and how much these motions amplify perturbations. */
#ifndef BAUM_BENCH_SWEEP_MOTION_H
#define BAUM_BENCH_SWEEP_MOTION_H

#include "sweep_scenes.h"

enum { SWEEP_NUMBERS = 4 };

typedef struct sweep_motion {
  void (*rate)(const void *data, const long double *y, long double *dy);
  void (*q)(const void *data, const long double *y, long double *q);
  const void *data;
  int n; /* number of entries of y */
  long double y[SWEEP_NUMBERS];
  int directions; /* number of directions in which the start is perturbed */
  long double direction[SWEEP_NUMBERS][SWEEP_NUMBERS];
} sweep_motion;

/* Integrates the motion to its end. Afterwards m->y is the state at the end. Stores samples in s.
 * If `growth` is set, also stores the growth of perturbations. */
void sweep_follow(sweep_scene *s, sweep_motion *m, bool growth);

/* If `fine` is false, ends the program with a message. */
void sweep_must(bool fine, const char *what);

#endif
