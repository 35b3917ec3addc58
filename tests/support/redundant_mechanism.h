/* SPDX-License-Identifier: BSD-3-Clause */
/* Random planar mechanisms with redundant rows and very different masses, and the residual of M a +
 * J^T lambda = g in them. The same seed gives the same mechanism on every machine. */
#ifndef BAUM_TEST_REDUNDANT_MECHANISM_H
#define BAUM_TEST_REDUNDANT_MECHANISM_H

#include <stdbool.h>
#include <stdint.h>

#include <baum/baum.h>

/* Returns a frozen mechanism. The seed determines its kind: doubled pins, welds with pins, parallel
 * cranks, stacked parallelograms, closed chains. Masses are between 1/ratio and 1 kg; sets
 * *ratio. */
baum_mechanism *redundant_mechanism(uint64_t seed, double *ratio);

/* A bracket of 1/ratio kg, both pinned and welded to ground, carries a body of 1 kg at rest. *hold
 * receives the joint between them. */
baum_mechanism *redundant_bracket(double ratio, baum_joint_id *hold);

/* A state with accelerations and multipliers to test. */
typedef struct redundant_state {
  baum_workspace *w; /* of a planar mechanism of about 1 m without particles */
  int32_t nv;
  int32_t nc;
  double *q; /* (nv) */
  double *v;
  double *a;
  double *lambda; /* (nc) */
  bool *unique;   /* (nc) */
} redundant_state;

/* Returns the largest residual of M a + J^T lambda = g of all bodies. Each is relative to the
 * largest term of its body, or to 1e-14 of the largest term of all bodies. Infinite if there is a
 * NaN. *rows, unless NULL, receives the largest residual of J a = gamma, relative to the largest
 * term of J a with the actual or the unconstrained accelerations. */
double redundant_imbalance(const redundant_state *s, double *rows);

typedef enum redundant_verdict {
  REDUNDANT_MET,
  REDUNDANT_REFUSED,
  REDUNDANT_WRONG,
  REDUNDANT_VERDICTS
} redundant_verdict;

/* Limit of the relative residual. */
static const double REDUNDANT_ERROR = 1e-9;

enum { REDUNDANT_STATES = 3 };

/* Counts for the three states: on the constraints, and 1e-6 and 1e-3 off them. */
typedef struct redundant_tally {
  long workspace[REDUNDANT_STATES][REDUNDANT_VERDICTS];
  long run[REDUNDANT_STATES][REDUNDANT_VERDICTS];
  double worst;      /* largest residual of REDUNDANT_MET results */
  long wrong_unique; /* wrong flags of uniqueness, in states on the constraints */
} redundant_tally;

/* Tests a workspace, and a run that starts without assembly, in the three states. Prints wrong
 * results. */
void redundant_judge(uint64_t seed, redundant_tally *tally);

#endif
