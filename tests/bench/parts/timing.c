/* SPDX-License-Identifier: BSD-3-Clause */
#include "timing.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

static const double WINDOW = 0.25e-3;    /* [s] */
static const double LONGEST_ROUND = 0.5; /* [s] */
enum { FEWEST_WINDOWS = 3 };

double timing_now(void)
{
  struct timespec now;
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Makes `calls` calls, and returns the time that they take. Returns NaN if a call fails. */
static double time_calls(timing_fn *function, void *self, int part, long calls)
{
  double start = timing_now();
  for (long k = 0; k < calls; k++) {
    if (!function(self, part)) {
      return (double)NAN;
    }
  }
  return timing_now() - start;
}

/* Returns how many calls fill a window of WINDOW seconds. *one is set to the time of one call. */
static long find_calls(timing_fn *function, void *self, int part, double *one)
{
  long calls = 1;
  double spent = time_calls(function, self, part, calls);
  while (spent < WINDOW) {
    calls *= 2;
    spent = time_calls(function, self, part, calls);
  }
  *one = spent / (double)calls;
  return calls;
}

static int compare(const void *a, const void *b)
{
  double x = *(const double *)a;
  double y = *(const double *)b;
  return x < y ? -1 : x > y;
}

double timing_round(timing_fn *function, void *self, int part)
{
  double window[TIMING_WINDOWS];
  double one = (double)NAN;
  long calls = find_calls(function, self, part, &one);
  double wanted = floor(LONGEST_ROUND / (one * (double)calls));
  if (isnan(wanted)) {
    return wanted;
  }
  int windows = (int)fmax(FEWEST_WINDOWS, fmin(TIMING_WINDOWS, wanted));
  for (int k = 0; k < windows; k++) {
    window[k] = time_calls(function, self, part, calls) / (double)calls;
    if (isnan(window[k])) {
      return window[k];
    }
  }
  qsort(window, (size_t)windows, sizeof window[0], compare);
  return window[windows / 10];
}

double timing_best(timing_fn *function, void *self, int part)
{
  double best = timing_round(function, self, part);
  for (int k = 1; k < TIMING_ROUNDS; k++) {
    double round = timing_round(function, self, part);
    best = isnan(round) || round < best ? round : best;
  }
  return best;
}

/* ---- bandwidth ---- */

typedef struct memory {
  double *values;
  long count;
  volatile double sink; /* written so that the compiler cannot omit reading the memory */
} memory;

/* Computes sixteen sums in parallel, so that additions do not have to wait for each other. */
static bool read_all(void *self, int part)
{
  (void)part;
  memory *m = self;
  double sum[16] = {0.0};
  for (long k = 0; k + 16 <= m->count; k += 16) {
    for (int i = 0; i < 16; i++) {
      sum[i] += m->values[k + i];
    }
  }
  double all = 0.0;
  for (int i = 0; i < 16; i++) {
    all += sum[i];
  }
  m->sink = all;
  return true;
}

static bool update_all(void *self, int part)
{
  (void)part;
  memory *m = self;
  for (long k = 0; k < m->count; k++) {
    m->values[k] = 0.5 * m->values[k] + 1.0;
  }
  return true;
}

timing_bandwidth timing_measure_bandwidth(long bytes)
{
  timing_bandwidth out = {(double)NAN, (double)NAN};
  memory m = {.count = bytes / (long)sizeof(double)};
  m.values = calloc((size_t)m.count, sizeof *m.values);
  if (m.values) {
    double size = (double)m.count * (double)sizeof *m.values;
    (void)update_all(&m, 0);
    out.read = size / timing_best(read_all, &m, 0);
    out.update = 2.0 * size / timing_best(update_all, &m, 0);
  }
  free(m.values);
  return out;
}
