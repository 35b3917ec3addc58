/* SPDX-License-Identifier: BSD-3-Clause */
/* One cell of the stress grid: a scene, a way to integrate it, and the result. */
#ifndef BAUM_TEST_CELL_H
#define BAUM_TEST_CELL_H

#include "scene.h"

/* An integrator with a formulation. */
typedef struct way {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  bool fixed;   /* the step is fixed */
  double order; /* order of a fixed-step method with its default gains */
  bool built;   /* part of this build */
} way;

typedef struct cell {
  const char *axis;
  double value; /* value of the number that the axis varies */
  scene scene;
  const way *way;
  double periods;   /* duration of the run / period of its fastest rate */
  double step;      /* fixed step / this period */
  double rtol;      /* for variable steps */
  double gain;      /* [1/s] alpha = beta; NaN: the default rule */
  double share;     /* [-] added to the permitted error for inexact data, relative to the scale */
  baum_start begin; /* option `start` of the run */
  int64_t most;     /* largest number of steps */
} cell;

typedef enum outcome {
  MET,     /* the error is within the promise */
  REFUSED, /* the run was not started */
  STOPPED, /* the run ended early with a message */
  WARNED,  /* a warning doubts the motion */
  CROSSED, /* wrong, but reported a singularity crossing where branches are within 1e-10 */
  WRONG,   /* status OK, no warning, and an error above the promise */
  OUTCOMES
} outcome;

typedef struct grade {
  outcome outcome;
  bool false_alarm;   /* refused or warned, although the motion is right */
  double error;       /* relative to the scale, or in rad; NaN: none */
  double promise;     /* largest permitted error, in the same unit */
  double seconds;     /* of the run */
  double all_seconds; /* of run and oracle */
  int64_t steps;
  baum_status status;
  char message[400];
} grade;

const char *outcome_name(outcome o);

/* Duration of a cell's run, and its units of time and length. */
typedef struct cell_time {
  double rate;   /* [rad/s] fastest rate of the motion */
  double period; /* [s] */
  double span;   /* [s] */
  double scale;  /* [m] */
} cell_time;

cell_time cell_time_of(const cell *c);
/* Writes error and promise for positions q, in the units of the scene, after out->steps steps. */
void cell_measure(const cell *c, const scene *s, const double *q, const cell_time *time,
                  grade *out);
grade cell_grade(const cell *c);

#endif
