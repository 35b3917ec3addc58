/* SPDX-License-Identifier: BSD-3-Clause */
/* Integrates y' = f(y) much more accurately than any run. It uses Gragg's extrapolated midpoint
 * rule (Gragg 1965, Bulirsch and Stoer 1966) of order 16 with error control, in long double. */
#ifndef BAUM_BENCH_GRAGG_H
#define BAUM_BENCH_GRAGG_H

#include <stdbool.h>

enum { GRAGG_MOST = 8 }; /* largest number of entries of y */

typedef struct gragg {
  void (*rate)(const void *data, const long double *y, long double *dy);
  const void *data;
  int n;
  long double tolerance; /* for the local error, relative to max(1, |y|) */
  long double step;      /* [s] the next step; 0 at the beginning */
} gragg;

/* Advances y by the time `span`, which must be > 0. Returns false if steps become too short. */
bool gragg_advance(gragg *g, long double span, long double *y);

#endif
