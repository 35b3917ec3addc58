/* SPDX-License-Identifier: BSD-3-Clause */
/* Ways to an acceleration of the same scene by the same geometry. To add one: its struct in
 * solvers.c, or a file of its own, and a line in solver_at().
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
  PHASE_COUNT,
  PHASE_WHOLE = PHASE_COUNT /* all, and what else belongs to a solution: checks, copies */
} solver_phase;

/* alpha and beta [1/s] of an ordinary run; their values do not matter here. */
static const double SOLVER_GAIN = 10.0;

typedef struct solver {
  const char *name;
  bool has_phases; /* else only PHASE_WHOLE can be run */
  /* NULL: not for this scene. The scene outlives it. */
  void *(*create)(scene *at);
  /* From the start up to and with a phase; PHASE_WHOLE leaves a and lambda. False: failed. */
  bool (*run)(void *self, int last_phase);
  /* The solution after a whole run: (nv), (nc). */
  void (*read)(const void *self, double *a, double *lambda);
  void (*destroy)(void *self); /* NULL is fine */
} solver;

/* a and lambda of a workspace. */
void solver_read_workspace(const baum_workspace *workspace, double *a, double *lambda);

extern const solver solver_block;
extern const solver solver_block_plain;

/* 0, 1, ...; NULL past the end. */
const solver *solver_at(int k);

#endif
