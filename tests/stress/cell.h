/* SPDX-License-Identifier: BSD-3-Clause */
/* A cell of the stress grid. It consists of a scene and a way to integrate it, and has a result. */
#ifndef BAUM_TEST_CELL_H
#define BAUM_TEST_CELL_H

#include "scene.h"

/* An integrator with a formulation. */
typedef struct way {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  bool fixed;   /* whether the step is fixed */
  double order; /* order of a fixed-step method with its default gains */
  bool built;   /* whether this build contains the method */
} way;

typedef struct cell {
  const char *axis;
  double value; /* value of the number that varies along the axis */
  scene scene;
  const way *way;
  double periods; /* duration of the run divided by the period of its fastest rate */
  double step;    /* fixed step divided by this period */
  double rtol;    /* tolerance, for variable steps */
  double gain;    /* [1/s] alpha = beta, or NaN for the default rule */
  /* [-] An addition to the permitted error, relative to the characteristic length. It allows for
   * data that are not exact, such as redundant joints at slightly different places. */
  double share;
  baum_start begin; /* the option `start` of the run */
  int64_t most;     /* largest number of steps */
} cell;

typedef enum outcome {
  MET,     /* the error is at most the promise, which is the largest permitted error */
  REFUSED, /* the run was not started */
  STOPPED, /* the run ended early with a message */
  WARNED,  /* a warning says that the motion may be wrong */
  /* The motion is wrong. The run reported a singularity crossing, where two branches are within
   * 1e-10 of each other. */
  CROSSED,
  WRONG, /* the status is OK and there is no warning, but the error is above the promise */
  OUTCOMES
} outcome;

typedef struct grade {
  outcome outcome;
  bool false_alarm;   /* the run was refused or warned, although its motion is right */
  double error;       /* relative to the characteristic length, or in rad; NaN if there is none */
  double promise;     /* the largest permitted error, in the same unit */
  double seconds;     /* [s] time of the run */
  double all_seconds; /* [s] time of the run and the oracle */
  int64_t steps;
  baum_status status;
  char message[400];
} grade;

const char *outcome_name(outcome o);

/* The duration of a cell's run, and the units of time and length in which the cell is described. */
typedef struct cell_time {
  double rate;   /* [rad/s] fastest rate of the motion */
  double period; /* [s] */
  double span;   /* [s] */
  double scale;  /* [m] characteristic length */
} cell_time;

cell_time cell_time_of(const cell *c);
/* Computes the error and the promise of the positions q after out->steps steps. The positions are
 * in the units of the scene. */
void cell_measure(const cell *c, const scene *s, const double *q, const cell_time *time,
                  grade *out);
grade cell_grade(const cell *c);

#endif
