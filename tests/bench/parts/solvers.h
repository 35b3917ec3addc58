/* SPDX-License-Identifier: BSD-3-Clause */
/* Ways to an acceleration of the same scene by the same geometry. To add one: its struct in solvers.c,
 * or a file of its own, and a line in solver_at().
 */
#ifndef BAUM_BENCH_SOLVERS_H
#define BAUM_BENCH_SOLVERS_H

#include "scenes.h"

/* An evaluation goes through these one after the other. */
typedef enum solver_phase {
  PHASE_GEOMETRY, /* frames, Phi, J, Phi', gamma, M, g, right side */
  PHASE_ASSEMBLY, /* the matrix that is factored */
  PHASE_FACTOR,
  PHASE_SOLVE,
  PHASE_COUNT
} solver_phase;

/* What an evaluation costs by count; 0: not known. */
typedef struct solver_cost {
  double bytes; /* of all numbers and indices that it touches */
  double flops;
} solver_cost;

typedef struct solver {
  const char *name;
  bool has_phases; /* else only the whole evaluation can be run */
  /* NULL: not for this scene. The scene outlives it. */
  void *(*create)(scene *at);
  /* From the start up to and with a phase; PHASE_SOLVE leaves a and lambda. False: failed. */
  bool (*run)(void *self, int last_phase);
  /* The solution after a whole run: (nv), (nc). */
  void (*read)(const void *self, double *a, double *lambda);
  solver_cost (*cost)(const void *self); /* NULL: not known */
  void (*destroy)(void *self);           /* NULL is fine */
} solver;

/* 0, 1, ...; NULL past the end. */
const solver *solver_at(int k);

#endif
