/* SPDX-License-Identifier: BSD-3-Clause */
/* Random planar mechanisms with redundant rows and uneven masses, and the residual of M a + J^T
 * lambda = g. The same seed gives the same mechanism on every machine. */
#ifndef BAUM_TEST_REDUNDANT_MECHANISM_H
#define BAUM_TEST_REDUNDANT_MECHANISM_H

#include <stdbool.h>
#include <stdint.h>

#include <baum/baum.h>

/* Frozen. The seed determines the kind: doubled pins, welds with pins, parallel cranks, stacked
 * parallelograms, closed chains. Masses are between 1/ratio and 1 kg. */
baum_mechanism *redundant_mechanism(uint64_t seed, double *ratio);

/* A bracket of 1/ratio kg, pinned and welded to the ground, carries 1 kg at rest. `hold` receives
 * the joint between them. */
baum_mechanism *redundant_bracket(double ratio, baum_joint_id *hold);

/* A state with accelerations and multipliers to test. */
typedef struct redundant_state {
  baum_workspace *w; /* of a planar mechanism without particles, with a size of about 1 m */
  int32_t nv;
  int32_t nc;
  double *q; /* (nv) */
  double *v;
  double *a;
  double *lambda; /* (nc) */
  bool *unique;   /* (nc) */
} redundant_state;

/* Largest residual of M a + J^T lambda = g on a body, relative to the largest term on this body or
 * to 1e-14 of the largest term of all; infinite with NaN. *rows, if not NULL, receives the largest
 * residual of J a = gamma relative to the largest term, with or without the constraints. */
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

/* Counts for each state: on the constraints, 1e-6 and 1e-3 off them. */
typedef struct redundant_tally {
  long workspace[REDUNDANT_STATES][REDUNDANT_VERDICTS];
  long run[REDUNDANT_STATES][REDUNDANT_VERDICTS];
  double worst;      /* largest residual of the results that are met */
  long wrong_unique; /* wrong flags of uniqueness on the constraints */
} redundant_tally;

/* Tests a workspace and a run that starts as given, in the three states. Prints wrong results. */
void redundant_judge(uint64_t seed, redundant_tally *tally);

#endif
