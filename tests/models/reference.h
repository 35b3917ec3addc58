/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs against trajectories of tests/data: largest error over all samples, lengths relative to the
 * length scale of the mechanism, angles in radians.
 */
#ifndef BAUM_TEST_REFERENCE_H
#define BAUM_TEST_REFERENCE_H

#include "models.h"

enum { REFERENCE_WIDTH = 9 };

/* A trajectory, and how the coordinates of a mechanism are compared with it. */
typedef struct reference {
  const char *name;
  int samples;
  int width;
  const double *t;     /* (samples) [s] */
  const double *q;     /* (samples x width) NULL: those of the catalogue */
  const char *entry;   /* of the catalogue, where q is NULL */
  const char *lengths; /* (width) 'm' for a length, 'r' for an angle */
  void (*columns)(const double *q,
                  double *out); /* (width) of all coordinates; NULL: they are the coordinates */
} reference;

/* One run. */
typedef struct reference_run {
  baum_status status; /* > 0: with warnings */
  double error;       /* NaN when the run failed */
  baum_counters counters;
  char message[256];
} reference_run;

/* Run a mechanism through all samples and compare. */
reference_run reference_compare(const reference *with, const baum_mechanism *mechanism,
                                const baum_simulation_options *options);

/* A ladder of tolerances 1e-4 to 1e-12, one run each. */
enum { REFERENCE_RUNGS = 9 };
typedef struct reference_ladder {
  reference_run runs[REFERENCE_RUNGS]; /* rtol = 1e-(4 + k) */
} reference_ladder;

double reference_rtol(int rung);
/* The same runs for each rtol, printed as a table. options->rtol is ignored. */
reference_ladder reference_climb(const reference *with, const baum_mechanism *mechanism,
                                 const baum_simulation_options *options);
/* The largest rtol from which on, among the runs that ended, the error reaches `wanted`; NaN when
 * there is none. */
double reference_rtol_needed(const reference_ladder *ladder, double wanted);

#endif
