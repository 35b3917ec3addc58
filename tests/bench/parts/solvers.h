/* SPDX-License-Identifier: BSD-3-Clause */
/* Solvers that compute the acceleration of the same scene with the same geometry. To add one,
 * define its struct in solvers.c or a file of its own, and add a line in solver_at(). */
#ifndef BAUM_BENCH_SOLVERS_H
#define BAUM_BENCH_SOLVERS_H

#include "scenes.h"

/* The phases of an evaluation, in their order. */
typedef enum solver_phase {
  PHASE_GEOMETRY, /* frames, Phi, J, Phi', gamma, M, g, right side */
  PHASE_ASSEMBLY, /* the matrix that is factored */
  PHASE_FACTOR,
  PHASE_SOLVE,
  PHASE_COUNT,
  PHASE_WHOLE = PHASE_COUNT /* all phases and the rest of a solution: checks, copies */
} solver_phase;

/* alpha and beta [1/s]; the time does not depend on their values. */
static const double SOLVER_GAIN = 10.0;

typedef struct solver {
  const char *name;
  bool has_phases; /* if false, only PHASE_WHOLE can be run */
  /* Returns NULL if the solver does not suit the scene. The scene must outlive the solver. */
  void *(*create)(scene *at);
  /* Runs all phases up to last_phase; PHASE_WHOLE computes a and lambda. Returns false on
   * failure. */
  bool (*run)(void *self, int last_phase);
  /* Gives the solution of PHASE_WHOLE: a (nv), lambda (nc). */
  void (*read)(const void *self, double *a, double *lambda);
  void (*destroy)(void *self); /* accepts NULL */
} solver;

/* Copies a and lambda of a workspace. */
void solver_read_workspace(const baum_workspace *workspace, double *a, double *lambda);

extern const solver solver_block;
extern const solver solver_block_plain;
extern const solver solver_automatic;

/* The k-th solver, k = 0, 1, ...; NULL if k is too large. */
typedef const solver *solver_list(int k);
const solver *solver_at(int k);
/* The solvers of spatial scenes; the first is the one that the library chooses. */
const solver *solver_in_space_at(int k);

#endif
