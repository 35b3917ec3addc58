/* SPDX-License-Identifier: BSD-3-Clause */
/* Local errors of fixed steps, estimated from the accelerations that the run evaluates anyway. */
#ifndef BAUM_I_SIMULATE_LOCAL_ERROR_H
#define BAUM_I_SIMULATE_LOCAL_ERROR_H

#include "simulate/run.h"

enum { BAUM_I_ACCELERATIONS = 4 };

typedef struct baum_i_local_error {
  double *q;                       /* (nq) where the last step began */
  double *v;                       /* (nv) */
  double *a[BAUM_I_ACCELERATIONS]; /* (nv) where the last steps began, newest first */
  double t;                        /* [s] where the last step began */
  double h;                        /* [s] of the step before it */
  int known;                       /* accelerations, at equal distances */
} baum_i_local_error;

/* Count of the numbers that it needs, and where they are. */
size_t baum_i_local_error_size(const baum_mechanism *m);
void baum_i_local_error_place(baum_i_local_error *local, const baum_mechanism *m, double *numbers);

/* Estimate the error of the last step, relative to the scales, at its end: the present state, with
 * its acceleration in the workspace. 0 as long as too few accelerations are known. known = 0
 * forgets them. */
double baum_i_local_error_of_step(baum_i_local_error *local, const baum_simulation *run);

#endif
