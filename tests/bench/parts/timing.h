/* SPDX-License-Identifier: BSD-3-Clause */
/* Timing on a machine that runs other programs too. A round measures the CPU time of this thread in
 * 41 windows of at least 0.25 ms and takes their 10th percentile; the result is the smallest of
 * several rounds. A median would include the load of other programs. */
#ifndef BAUM_BENCH_TIMING_H
#define BAUM_BENCH_TIMING_H

#include <stdbool.h>

enum { TIMING_WINDOWS = 41, TIMING_ROUNDS = 3 };

/* A function to time, called with `part`; returns false if it failed. */
typedef bool timing_fn(void *self, int part);

/* Thread CPU time [s]. */
double timing_now(void);

/* Time of one call [s] from one round, or NaN if a call failed. If a call takes long, there are
 * fewer windows, so that a round ends in about a second. */
double timing_round(timing_fn *function, void *self, int part);

/* The smallest time of TIMING_ROUNDS rounds. */
double timing_best(timing_fn *function, void *self, int part);

/* Bytes per second when reading and when updating (read and write) an array of doubles of the given
 * size; NaN if there is no memory. */
typedef struct timing_bandwidth {
  double read;
  double update;
} timing_bandwidth;

timing_bandwidth timing_measure_bandwidth(long bytes);

#endif
