/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares runs with reference trajectories. The error is the largest over all samples, with
 * lengths relative to the characteristic length and angles in radians. */
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
  const double *q;     /* (samples x width) NULL: from the catalogue */
  const char *entry;   /* of the catalogue if q is NULL */
  const char *lengths; /* (width) 'm' for a length, 'r' for an angle */
  void (*columns)(const double *q,
                  double *out); /* (width) computes the columns from all coordinates; NULL: the
                                 * coordinates themselves */
} reference;

/* The result of a run. */
typedef struct reference_run {
  baum_status status; /* > 0: warnings */
  double error;       /* NaN if the run failed */
  baum_counters counters;
  char message[256];
} reference_run;

/* Runs a mechanism through all samples and compares. */
reference_run reference_compare(const reference *with, const baum_mechanism *mechanism,
                                const baum_simulation_options *options);

/* Runs with tolerances 1e-4 to 1e-12. */
enum { REFERENCE_RUNGS = 9 };
typedef struct reference_ladder {
  reference_run runs[REFERENCE_RUNGS]; /* rtol = 1e-(4 + k) */
} reference_ladder;

double reference_rtol(int rung);
/* Runs with each rtol in place of options->rtol, and prints a table. */
reference_ladder reference_climb(const reference *with, const baum_mechanism *mechanism,
                                 const baum_simulation_options *options);
/* The largest rtol from which on all successful runs have at most the error `wanted`; NaN if there
 * is none. */
double reference_rtol_needed(const reference_ladder *ladder, double wanted);

#endif
