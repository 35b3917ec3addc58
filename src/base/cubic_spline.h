/* SPDX-License-Identifier: BSD-3-Clause */
/* Cubic splines through given values: continuous with their second derivative. */
#ifndef BAUM_I_BASE_CUBIC_SPLINE_H
#define BAUM_I_BASE_CUBIC_SPLINE_H

#include <stdbool.h>
#include <stdint.h>

#include <baum/status.h>

typedef struct baum_i_cubic_spline {
  int32_t count;        /* >= 3 */
  const double *times;  /* (count) rising */
  const double *values; /* (count) */
  double *bends;        /* (count) half the second derivative at each */
} baum_i_cubic_spline;

/* Find the bends: zero at both ends, or periodic. BAUM_OK or BAUM_ERR_MEMORY, without a message. */
baum_status baum_i_cubic_spline_fit(const baum_i_cubic_spline *spline, bool periodic);

/* s, s', s'' at a time from the first to the last. */
void baum_i_cubic_spline_evaluate(const baum_i_cubic_spline *spline, double time, double s[3]);

#endif
