/* SPDX-License-Identifier: BSD-3-Clause */
/* Local errors of steps of fixed length, from accelerations that the run has evaluated anyway. */
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

/* Numbers that it needs, and where it puts them. */
size_t baum_i_local_error_size(const baum_mechanism *m);
void baum_i_local_error_place(baum_i_local_error *local, const baum_mechanism *m, double *numbers);

/* At the present state of a run, where its last step has ended, and the acceleration there, in the
 * workspace: the estimated error of that step relative to the scales; 0 while too few accelerations
 * are known. known = 0: forget those before. */
double baum_i_local_error_of_step(baum_i_local_error *local, const baum_simulation *run);

#endif
