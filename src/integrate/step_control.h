/* SPDX-License-Identifier: BSD-3-Clause */
/* Chooses the length of the next step from the errors of the last steps. Lengths are > 0 for both
 * directions of time. */
#ifndef BAUM_I_INTEGRATE_STEP_CONTROL_H
#define BAUM_I_INTEGRATE_STEP_CONTROL_H

#include <stdbool.h>

typedef struct baum_i_step_control {
  double order;      /* the estimated error of a step grows with h^order */
  double step;       /* [s] length to try next */
  double last_step;  /* [s] length of the last accepted step; 0: none yet */
  double last_error; /* error of the last accepted step */
  bool refused;      /* a try from the present state has been refused */
} baum_i_step_control;

/* Start with a first step of length `step`. */
void baum_i_step_control_begin(baum_i_step_control *control, int order, double step);

/* Accept a step of length `taken` with an error <= 1, in units of the tolerance. */
void baum_i_step_control_accept(baum_i_step_control *control, double taken, double error);

/* Refuse a step of length `taken` with an error > 1, or NaN. */
void baum_i_step_control_refuse(baum_i_step_control *control, double taken, double error);

#endif
