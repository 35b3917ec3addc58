/* SPDX-License-Identifier: BSD-3-Clause */
/* Local errors of fixed steps, estimated from the accelerations that the run evaluates anyway. */
#ifndef BAUM_I_SIMULATE_LOCAL_ERROR_H
#define BAUM_I_SIMULATE_LOCAL_ERROR_H

#include "simulate/run.h"

enum { BAUM_I_ACCELERATIONS = 4 };

typedef struct baum_i_local_error {
  double *q;                       /* (nq) at the start of the last step */
  double *v;                       /* (nv) */
  double *a[BAUM_I_ACCELERATIONS]; /* (nv) at the starts of the last steps, newest first */
  double t;                        /* [s] start of the last step */
  double h;                        /* [s] length of the step that ended at t */
  /* number of valid entries of `a`; the steps between them have equal lengths */
  int known;
} baum_i_local_error;

/* The first function returns how many numbers the arrays of a baum_i_local_error need. The second
 * function places the arrays in `numbers`, which has room for this many numbers. */
size_t baum_i_local_error_size(const baum_mechanism *m);
void baum_i_local_error_place(baum_i_local_error *local, const baum_mechanism *m, double *numbers);

/* Estimate the error of the last step, relative to the scales. Call this when the end of the step
 * is the present state and the workspace contains its acceleration. Returns 0 as long as too few
 * accelerations are known. Set known = 0 to discard all stored accelerations. */
double baum_i_local_error_of_step(baum_i_local_error *local, const baum_simulation *run);

#endif
