/* SPDX-License-Identifier: BSD-3-Clause */
/* Random planar mechanisms with redundant rows and very different masses. The file also computes
 * the residual of M a + J^T lambda = g. The same seed gives the same mechanism on every machine. */
#ifndef BAUM_TEST_REDUNDANT_MECHANISM_H
#define BAUM_TEST_REDUNDANT_MECHANISM_H

#include <stdbool.h>
#include <stdint.h>

#include <baum/baum.h>

/* Returns a frozen mechanism. The seed determines which kind of mechanism it is: doubled pins,
 * welds with pins, parallel cranks, stacked parallelograms, or closed chains. Masses are between
 * 1/ratio and 1 kg. *ratio is set to the ratio that the seed determines. */
baum_mechanism *redundant_mechanism(uint64_t seed, double *ratio);

/* Makes a bracket of 1/ratio kg that is both pinned and welded to ground. It carries a body of 1 kg
 * at rest. *hold is set to the joint between bracket and body. */
baum_mechanism *redundant_bracket(double ratio, baum_joint_id *hold);

/* A state, with the accelerations and multipliers that are tested. */
typedef struct redundant_state {
  /* Workspace of a planar mechanism without particles, with lengths of about 1 m. */
  baum_workspace *w;
  int32_t nv;
  int32_t nc;
  double *q; /* (nv) */
  double *v;
  double *a;
  double *lambda; /* (nc) */
  bool *unique;   /* (nc) */
} redundant_state;

/* Returns the largest residual of M a + J^T lambda = g over all bodies. Each residual is divided by
 * the largest term of its body, or by 1e-14 of the largest term of all bodies if that is larger.
 * The result is infinite if there is a NaN. Unless `rows` is NULL, *rows is set to the largest
 * residual of J a = gamma. This residual is relative to the largest term of J a, for the actual
 * accelerations or for those without constraints, whichever term is larger. */
double redundant_imbalance(const redundant_state *s, double *rows);

typedef enum redundant_verdict {
  REDUNDANT_MET,
  REDUNDANT_REFUSED,
  REDUNDANT_WRONG,
  REDUNDANT_VERDICTS
} redundant_verdict;

/* The largest permitted relative residual. */
static const double REDUNDANT_ERROR = 1e-9;

enum { REDUNDANT_STATES = 3 };

/* Counts of results. Every mechanism is tested in three states: on the constraints, 1e-6 off them,
 * and 1e-3 off them. */
typedef struct redundant_tally {
  long workspace[REDUNDANT_STATES][REDUNDANT_VERDICTS];
  long run[REDUNDANT_STATES][REDUNDANT_VERDICTS];
  double worst;      /* largest residual of REDUNDANT_MET results */
  long wrong_unique; /* number of wrong flags of uniqueness, only in states on the constraints */
} redundant_tally;

/* Tests a workspace in the three states, and also a run that starts in them without assembly.
 * Prints wrong results. */
void redundant_judge(uint64_t seed, redundant_tally *tally);

#endif
