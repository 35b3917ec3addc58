/* SPDX-License-Identifier: BSD-3-Clause */
/* Integrates y' = f(y) far more accurately than any run: Gragg's extrapolated midpoint rule (Gragg
 * 1965, Bulirsch and Stoer 1966) of order 16 with error control, in long double. */
#ifndef BAUM_BENCH_GRAGG_H
#define BAUM_BENCH_GRAGG_H

#include <stdbool.h>

enum { GRAGG_MOST = 8 }; /* largest size of y */

typedef struct gragg {
  void (*rate)(const void *data, const long double *y, long double *dy);
  const void *data;
  int n;
  long double tolerance; /* local, relative to max(1, |y|) */
  long double step;      /* [s] next step; 0 at first */
} gragg;

/* Advances by span > 0; returns false if steps become too short. */
bool gragg_advance(gragg *g, long double span, long double *y);

#endif
