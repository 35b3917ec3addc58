/* SPDX-License-Identifier: BSD-3-Clause */
/* Cubic splines through given values. Their first and second derivatives are continuous. */
#ifndef BAUM_I_BASE_CUBIC_SPLINE_H
#define BAUM_I_BASE_CUBIC_SPLINE_H

#include <stdbool.h>
#include <stdint.h>

#include <baum/status.h>

typedef struct baum_i_cubic_spline {
  int32_t count;        /* >= 3 */
  const double *times;  /* (count) ascending */
  const double *values; /* (count) */
  double *bends;        /* (count) half of the second derivative at each time */
} baum_i_cubic_spline;

/* Find the second derivatives of the spline. They are zero at both ends unless the spline is
 * periodic. Returns BAUM_OK or BAUM_ERR_MEMORY and sets no message. */
baum_status baum_i_cubic_spline_fit(const baum_i_cubic_spline *spline, bool periodic);

/* Evaluate s, s', s'' at a time between the first and the last of the given times. */
void baum_i_cubic_spline_evaluate(const baum_i_cubic_spline *spline, double time, double s[3]);

#endif
