/* SPDX-License-Identifier: BSD-3-Clause */
/* Reference motions in reduced coordinates y, and their amplification of perturbations. */
#ifndef BAUM_BENCH_SWEEP_MOTION_H
#define BAUM_BENCH_SWEEP_MOTION_H

#include "sweep_scenes.h"

enum { SWEEP_NUMBERS = 4 };

typedef struct sweep_motion {
  void (*rate)(const void *data, const long double *y, long double *dy);
  void (*q)(const void *data, const long double *y, long double *q);
  const void *data;
  int n; /* size of y */
  long double y[SWEEP_NUMBERS];
  int directions; /* number of directions that perturb the start */
  long double direction[SWEEP_NUMBERS][SWEEP_NUMBERS];
} sweep_motion;

/* Integrates the motion to its end, to which m->y is advanced. Stores samples and, if `growth`, the
 * growth of perturbations in s. */
void sweep_follow(sweep_scene *s, sweep_motion *m, bool growth);

/* Ends the program with a message if `fine` is false. */
void sweep_must(bool fine, const char *what);

#endif
