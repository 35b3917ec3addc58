/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares runs with reference trajectories. The error is the largest one over all samples. Lengths
 * are relative to the characteristic length, and angles are in radians. */
#ifndef BAUM_TEST_REFERENCE_H
#define BAUM_TEST_REFERENCE_H

#include "models.h"

enum { REFERENCE_WIDTH = 9 };

/* A reference trajectory, and the columns that are compared with it. */
typedef struct reference {
  const char *name;
  int samples;
  int width;
  const double *t;     /* (samples) [s] */
  const double *q;     /* (samples x width) or NULL for a reference of the catalogue */
  const char *entry;   /* name of the catalogue's entry, if q is NULL */
  const char *lengths; /* (width) 'm' for each length, 'r' for each angle */
  void (*columns)(const double *q,
                  /* (width) receives the columns, which are computed from all coordinates; if
                   * `columns` is NULL, the columns are the coordinates. */
                  double *out);
} reference;

/* The result of a run. */
typedef struct reference_run {
  baum_status status; /* > 0 if there were warnings */
  double error;       /* NaN if the run failed */
  baum_counters counters;
  char message[256];
} reference_run;

/* Runs a mechanism through all samples, and compares it with the reference. */
reference_run reference_compare(const reference *with, const baum_mechanism *mechanism,
                                const baum_simulation_options *options);

/* The results of runs with the tolerances 1e-4, 1e-5, ..., 1e-12. */
enum { REFERENCE_RUNGS = 9 };
typedef struct reference_ladder {
  reference_run runs[REFERENCE_RUNGS]; /* rtol = 1e-(4 + k) */
} reference_ladder;

double reference_rtol(int rung);
/* Makes a run with each rtol instead of options->rtol, and prints a table. */
reference_ladder reference_climb(const reference *with, const baum_mechanism *mechanism,
                                 const baum_simulation_options *options);
/* Returns the largest rtol for which the following holds: with this and all smaller rtol, all
 * successful runs have at most the error `wanted`. Returns NaN if there is none. */
double reference_rtol_needed(const reference_ladder *ladder, double wanted);

#endif
