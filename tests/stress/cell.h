/* SPDX-License-Identifier: BSD-3-Clause */
/* One cell of the stress grid: a scene, a way to integrate it, and what has become of it. */
#ifndef BAUM_TEST_CELL_H
#define BAUM_TEST_CELL_H

#include "scene.h"

/* An integrator with a formulation. */
typedef struct way {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  bool fixed;   /* takes a step */
  double order; /* of a fixed step, with the default gains */
  bool built;   /* part of this build */
} way;

typedef struct cell {
  const char *axis;
  double value; /* along the axis */
  scene scene;
  const way *way;
  double periods;   /* length of the run in periods of its fastest rate */
  double step;      /* in those periods, fixed steps */
  double rtol;      /* variable steps */
  double gain;      /* alpha = beta in the rate; NaN: the default rule */
  double share;     /* what of the promise is added for faults of the data [-], of the scale */
  baum_start begin; /* how to begin */
  int64_t most;     /* steps */
} cell;

typedef enum outcome {
  MET,     /* the tolerance */
  REFUSED, /* before the start */
  STOPPED, /* with a reason */
  WARNED,  /* of doubt in the motion */
  CROSSED, /* took branches within 1e-10 of each other for crossing ones, and told of the crossing
              */
  WRONG,   /* status OK, no doubt, and off by more than promised */
  OUTCOMES
} outcome;

typedef struct grade {
  outcome outcome;
  bool false_alarm;   /* refused, or warned of the motion, which is right */
  double error;       /* of the scale, or rad; NaN where there is none */
  double promise;     /* likewise */
  double seconds;     /* of the run */
  double all_seconds; /* and of the oracle */
  int64_t steps;
  baum_status status;
  char message[400];
} grade;

const char *outcome_name(outcome o);

/* How long a cell runs, and in which units of time and length. */
typedef struct cell_time {
  double rate;   /* [rad/s] fastest of the motion */
  double period; /* [s] */
  double span;   /* [s] */
  double scale;  /* [m] */
} cell_time;

cell_time cell_time_of(const cell *c);
/* Error and promise of positions q, in the units of the scene, after out->steps. */
void cell_measure(const cell *c, const scene *s, const double *q, const cell_time *time,
                  grade *out);
grade cell_grade(const cell *c);

#endif
