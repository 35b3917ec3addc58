/* SPDX-License-Identifier: BSD-3-Clause */
/* Passes over arrays that monitors make after every step. They are optimized because with plain
 * loops they would cost half as much as an evaluation. */
#ifndef BAUM_I_BASE_MEASURE_H
#define BAUM_I_BASE_MEASURE_H

#include <stdbool.h>

/* A step whose local error is estimated; the equations are in simulate/local_error.c. */
typedef struct baum_i_step_samples {
  const double *q[2]; /* at the start and at the end of the step, or NULL */
  const double *v[2];
  const double *a[5]; /* at the end of the step, at its start, and at the starts before */
  const double *dq;   /* dq without its last term if q is not a vector; otherwise NULL */
  const double *scale;
  double h;
  double period; /* [s] weight of errors of v */
} baum_i_step_samples;

typedef struct baum_i_measure_kernel {
  /* Return the largest |x_i|, or NaN if a number is not finite. */
  double (*largest)(int n, const double *x);
  /* Return the largest |x_i| / scale_i. Numbers that are NaN are ignored. */
  double (*largest_scaled)(int n, const double *x, const double *scale);
  bool (*is_finite)(int n, const double *x);
  /* Return the largest scaled local error of n coordinates. */
  double (*local_error)(int n, const baum_i_step_samples *samples);
} baum_i_measure_kernel;

extern const baum_i_measure_kernel baum_i_measure_kernel_plain;
extern const baum_i_measure_kernel baum_i_measure_kernel_wide;

#endif
