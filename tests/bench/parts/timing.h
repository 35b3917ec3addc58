/* SPDX-License-Identifier: BSD-3-Clause */
/* How long something takes on a machine that others use too: CPU time of this thread, over windows
 * of at least 0.25 ms, of which the 10th percentile of 41 counts; the smallest of the rounds.
 * Medians would measure the neighbours.
 */
#ifndef BAUM_BENCH_TIMING_H
#define BAUM_BENCH_TIMING_H

#include <stdbool.h>

enum { TIMING_WINDOWS = 41, TIMING_ROUNDS = 3 };

/* One thing to be timed. `part` is passed on. False: it failed. */
typedef bool timing_fn(void *self, int part);

/* Thread CPU time [s]. */
double timing_now(void);

/* One round [s] per call: NaN when a call failed. Windows get fewer where one call takes long, so
 * that a round ends in about a second. */
double timing_round(timing_fn *function, void *self, int part);

/* The smallest of TIMING_ROUNDS. */
double timing_best(timing_fn *function, void *self, int part);

/* Bytes per second of reading, and of updating in place (read and written), doubles in a working
 * set of so many bytes; NaN when there is no memory. */
typedef struct timing_bandwidth {
  double read;
  double update;
} timing_bandwidth;

timing_bandwidth timing_measure_bandwidth(long bytes);

#endif
