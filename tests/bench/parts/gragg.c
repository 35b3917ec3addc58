/* SPDX-License-Identifier: BSD-3-Clause */
#include "gragg.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 8 };

typedef long double state[GRAGG_MOST];

/* Takes n steps of the midpoint rule, which together have the length h. */
static void midpoint(const gragg *g, const long double *y, long double h, int n, long double *out)
{
  state slope;
  state before;
  long double part = h / n;
  g->rate(g->data, y, slope);
  for (int i = 0; i < g->n; i++) {
    before[i] = y[i];
    out[i] = y[i] + part * slope[i];
  }
  for (int k = 1; k < n; k++) {
    g->rate(g->data, out, slope);
    for (int i = 0; i < g->n; i++) {
      long double next = before[i] + 2.0L * part * slope[i];
      before[i] = out[i];
      out[i] = next;
    }
  }
}

/* Extrapolates the results of the midpoint rule to a step of zero. Returns the difference of the
 * last two values, divided by the tolerance. */
static long double extrapolate(const gragg *g, const long double *y, long double h,
                               long double *out)
{
  state table[COLUMNS];
  long double error = 0.0L;
  for (int k = 0; k < COLUMNS; k++) {
    state next;
    midpoint(g, y, h, 2 * (k + 1), next);
    for (int j = 1; j <= k; j++) {
      long double ratio = (long double)(k + 1) / (long double)(k + 1 - j);
      for (int i = 0; i < g->n; i++) {
        long double higher = next[i] + (next[i] - table[j - 1][i]) / (ratio * ratio - 1.0L);
        table[j - 1][i] = next[i];
        next[i] = higher;
      }
    }
    memcpy(table[k], next, sizeof next);
  }
  for (int i = 0; i < g->n; i++) {
    long double size = fmaxl(1.0L, fabsl(y[i])) * g->tolerance;
    long double difference = fabsl(table[COLUMNS - 1][i] - table[COLUMNS - 2][i]) / size;
    error = difference <= error ? error : difference; /* this keeps NaN */
    out[i] = table[COLUMNS - 1][i];
  }
  return error;
}

bool gragg_advance(gragg *g, long double span, long double *y)
{
  long double left = span;
  g->step = g->step > 0.0L ? g->step : span / 100.0L;
  while (left > 0.0L) {
    state next;
    long double h = fminl(g->step, left);
    long double error = extrapolate(g, y, h, next);
    bool taken = error <= 1.0L;
    long double factor = isfinite(error) ? powl(fmaxl(error, 1e-9L), -1.0L / 15.0L) : 0.1L;
    long double proposed = h * fminl(4.0L, fmaxl(0.1L, 0.9L * factor));
    if (taken) {
      memcpy(y, next, (size_t)g->n * sizeof *y);
      left = h < left ? left - h : 0.0L;
      g->step = h < g->step ? fmaxl(g->step, proposed) : proposed;
    } else {
      g->step = proposed;
    }
    if (!(g->step > 1e-15L * span)) {
      return false;
    }
  }
  return true;
}
