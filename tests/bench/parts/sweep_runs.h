/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs of bench_sweeps: what they are judged by, and how they are counted. */
#ifndef BAUM_BENCH_SWEEP_RUNS_H
#define BAUM_BENCH_SWEEP_RUNS_H

#include <stdio.h>

#include "sweep_scenes.h"

enum { SWEEP_METHODS = 64, SWEEP_FAULTS = 8000 };

/* Errors are below 0.01 of the scales, below 0.1, or above. */
typedef enum sweep_class {
  SWEEP_RIGHT,
  SWEEP_GREY,
  SWEEP_WRONG,
  SWEEP_STOPPED,
  SWEEP_CLASSES
} sweep_class;

/* An integrator and a formulation. */
typedef struct sweep_method {
  const baum_integrator *integrator;
  baum_formulation formulation;
  bool fixed; /* takes a step, not rtol */
} sweep_method;

typedef struct sweep_fault {
  int method;
  char text[256];
} sweep_fault;

/* Of one part. */
typedef struct sweep_tally {
  const char *part;
  FILE *csv; /* or NULL */
  sweep_method methods[SWEEP_METHODS];
  int method_count;
  int runs[SWEEP_METHODS][SWEEP_CLASSES];
  int doubted[SWEEP_METHODS][SWEEP_CLASSES];
  int fault_count;
  sweep_fault faults[SWEEP_FAULTS]; /* runs that are wrong, and not doubted */
} sweep_tally;

/* Every method of fixed steps, or of variable ones, with each of its formulations. */
void sweep_begin(sweep_tally *tally, const char *part, bool fixed, FILE *csv);
/* setting: step [s] or rtol. */
sweep_class sweep_run(sweep_tally *tally, const sweep_scene *scene, int method, double setting);
/* Counts of a part into those of others. */
void sweep_add(const sweep_tally *part, sweep_tally *all);
/* A line for each method that has run, and the silently wrong runs; returns how many these are. */
int sweep_print(const sweep_tally *tally);

void sweep_csv_head(FILE *csv);

#endif
