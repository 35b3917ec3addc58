/* SPDX-License-Identifier: BSD-3-Clause */
/* Solvers that compute the accelerations of the same scene, with the same code for the geometry. To
 * add a solver, define its struct in solvers.c or in a separate file, and add a line to
 * solver_at(). */
#ifndef BAUM_BENCH_SOLVERS_H
#define BAUM_BENCH_SOLVERS_H

#include "scenes.h"

/* The phases of an evaluation, in the order in which they are made. */
typedef enum solver_phase {
  PHASE_GEOMETRY, /* computes frames, Phi, J, Phi', gamma, M, g and the right side */
  PHASE_ASSEMBLY, /* fills the matrix that is factored */
  PHASE_FACTOR,
  PHASE_SOLVE,
  PHASE_COUNT,
  /* All phases, and the other parts of a solution, such as checks and copies. */
  PHASE_WHOLE = PHASE_COUNT
} solver_phase;

/* The value of both gains, alpha and beta [1/s]. Times do not depend on it. */
static const double SOLVER_GAIN = 10.0;

typedef struct solver {
  const char *name;
  bool has_phases; /* if not set, only PHASE_WHOLE can be run */
  /* Creates the solver for a scene. Returns NULL if the solver is not suitable for the scene. The
   * scene must not be destroyed before the solver. */
  void *(*create)(scene *at);
  /* Runs all phases up to last_phase. With PHASE_WHOLE, a and lambda are computed. Returns false on
   * failure. */
  bool (*run)(void *self, int last_phase);
  /* Copies the solution of PHASE_WHOLE, which is a (nv) and lambda (nc). */
  void (*read)(const void *self, double *a, double *lambda);
  void (*destroy)(void *self); /* NULL is allowed */
} solver;

/* Copies a and lambda from a workspace. */
void solver_read_workspace(const baum_workspace *workspace, double *a, double *lambda);

extern const solver solver_block;
extern const solver solver_block_plain;
extern const solver solver_automatic;

typedef const solver *solver_list(int k);
/* Returns solver number k, where k = 0, 1, ... Returns NULL if k is too large. */
const solver *solver_at(int k);
/* The solvers of spatial scenes; the first is the one that the library chooses. */
const solver *solver_in_space_at(int k);

#endif
