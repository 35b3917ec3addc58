/* SPDX-License-Identifier: BSD-3-Clause */
/* Measures times on a machine on which other programs are also running. One round measures the CPU
 * time of this thread in 41 windows of at least 0.25 ms, and takes the 10th percentile of these
 * times. The result is the smallest one of several rounds. A median would include the effects of
 * other programs. */
#ifndef BAUM_BENCH_TIMING_H
#define BAUM_BENCH_TIMING_H

#include <stdbool.h>

enum { TIMING_WINDOWS = 41, TIMING_ROUNDS = 3 };

/* A function whose time is measured. It is called with `part`, and returns false if it failed. */
typedef bool timing_fn(void *self, int part);

/* Returns the CPU time of this thread [s]. */
double timing_now(void);

/* Returns the time of one call [s], measured in one round. Returns NaN if a call failed. If a call
 * takes a long time, there are fewer windows, so that the round ends in about a second. */
double timing_round(timing_fn *function, void *self, int part);

/* Returns the smallest time of TIMING_ROUNDS rounds. */
double timing_best(timing_fn *function, void *self, int part);

/* Memory bandwidth in bytes per second, for reading and for updating (reading and writing) an array
 * of doubles. It is NaN if there is not enough memory. */
typedef struct timing_bandwidth {
  double read;
  double update;
} timing_bandwidth;

timing_bandwidth timing_measure_bandwidth(long bytes);

#endif
