/* SPDX-License-Identifier: BSD-3-Clause */
/* Loops over arrays. The functions that monitor a run call them after every step. The loops use
 * vectors of four numbers, because plain loops would cost half as much time as an evaluation of the
 * accelerations. */
#ifndef BAUM_I_BASE_MEASURE_H
#define BAUM_I_BASE_MEASURE_H

#include <stdbool.h>

/* A step whose local error is estimated; the equations are in simulate/local_error.c. */
typedef struct baum_i_step_samples {
  const double *q[2]; /* q at the start and at the end of the step; not used if dq is given */
  const double *v[2];
  /* accelerations at the end of the step, at its start, and at the starts of the three steps
   * before */
  const double *a[5];
  const double *dq; /* NULL if q' = v; otherwise dq of local_error.c without its last term */
  const double *scale;
  double h;
  double period; /* [s] factor by which errors of v are multiplied */
} baum_i_step_samples;

typedef struct baum_i_measure_kernel {
  /* Return the largest |x_i|, or NaN if an x_i is not finite. */
  double (*largest)(int n, const double *x);
  /* Return the largest |x_i| / scale_i. NaN is ignored. */
  double (*largest_scaled)(int n, const double *x, const double *scale);
  bool (*is_finite)(int n, const double *x);
  /* Return the largest scaled local error of n coordinates. */
  double (*local_error)(int n, const baum_i_step_samples *samples);
} baum_i_measure_kernel;

extern const baum_i_measure_kernel baum_i_measure_kernel_plain;
extern const baum_i_measure_kernel baum_i_measure_kernel_wide;

#endif
