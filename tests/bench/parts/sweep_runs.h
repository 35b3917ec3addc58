/* SPDX-License-Identifier: BSD-3-Clause */
/* The runs of bench_sweeps, and how they are judged and counted. */
#ifndef BAUM_BENCH_SWEEP_RUNS_H
#define BAUM_BENCH_SWEEP_RUNS_H

#include <stdio.h>

#include "sweep_scenes.h"

enum { SWEEP_METHODS = 64, SWEEP_FAULTS = 8000 };

/* The class of a run. Its largest error, relative to the units of the scene, is below 0.01 (right),
 * below 0.1 (grey), or larger (wrong). */
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
  bool fixed; /* true for a fixed step, false for a variable step with rtol */
} sweep_method;

typedef struct sweep_fault {
  int method;
  char text[256];
} sweep_fault;

/* Counts of one part of the sweeps. */
typedef struct sweep_tally {
  const char *part;
  FILE *csv; /* or NULL */
  sweep_method methods[SWEEP_METHODS];
  int method_count;
  int runs[SWEEP_METHODS][SWEEP_CLASSES];
  int doubted[SWEEP_METHODS][SWEEP_CLASSES];
  int fault_count;
  /* The wrong runs that have no warning which doubts the motion. */
  sweep_fault faults[SWEEP_FAULTS];
} sweep_tally;

/* Begins a part of the sweeps. If `fixed` is true, the part contains all methods with a fixed step,
 * otherwise all methods with a variable step. Each integrator is used with all its formulations. */
void sweep_begin(sweep_tally *tally, const char *part, bool fixed, FILE *csv);
/* Makes one run with a method. `setting` is the step [s] or rtol. */
sweep_class sweep_run(sweep_tally *tally, const sweep_scene *scene, int method, double setting);
/* Adds the counts of a part to `all`. */
void sweep_add(const sweep_tally *part, sweep_tally *all);
/* Prints a line for each method that has run, and all runs that are silently wrong. Returns the
 * number of silently wrong runs. */
int sweep_print(const sweep_tally *tally);

void sweep_csv_head(FILE *csv);

#endif
