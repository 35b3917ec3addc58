/* SPDX-License-Identifier: BSD-3-Clause */
/* Planar mechanisms with redundant rows and uneven masses, chosen at random; what M a + J^T
 * lambda = g leaves. The same seed gives the same mechanism on every machine. */
#ifndef BAUM_TEST_REDUNDANT_MECHANISM_H
#define BAUM_TEST_REDUNDANT_MECHANISM_H

#include <stdbool.h>
#include <stdint.h>

#include <baum/baum.h>

/* Frozen. Kind by seed: doubled pins, welds with pins, parallel cranks, stacked parallelograms,
 * closed chains. Masses lie between 1/ratio and 1 kg. */
baum_mechanism *redundant_mechanism(uint64_t seed, double *ratio);

/* A bracket of 1/ratio kg, pinned and welded to the ground, holds 1 kg at rest. */
baum_mechanism *redundant_bracket(double ratio, baum_joint_id *hold);

/* A solution to be judged. */
typedef struct redundant_state {
  baum_workspace *w; /* of a planar mechanism without particles, of the order of 1 m */
  int32_t nv;
  int32_t nc;
  double *q; /* (nv) */
  double *v;
  double *a;
  double *lambda; /* (nc) */
  bool *unique;   /* (nc) */
} redundant_state;

/* The largest row of M a + J^T lambda - g against the largest term on its body, or against 1e-14 of
 * the largest term of all; NaN is infinite. *rows, where it is given, receives the largest row of J
 * a - gamma against the largest term of all, with or without the constraints. */
double redundant_imbalance(const redundant_state *s, double *rows);

typedef enum redundant_verdict {
  REDUNDANT_MET,
  REDUNDANT_REFUSED,
  REDUNDANT_WRONG,
  REDUNDANT_VERDICTS
} redundant_verdict;

/* Forces are met within it. */
static const double REDUNDANT_ERROR = 1e-9;

enum { REDUNDANT_STATES = 3 };

/* By state: on the constraints, 1e-6 and 1e-3 off them. */
typedef struct redundant_tally {
  long workspace[REDUNDANT_STATES][REDUNDANT_VERDICTS];
  long run[REDUNDANT_STATES][REDUNDANT_VERDICTS];
  double worst;      /* imbalance of those met */
  long wrong_unique; /* multipliers that the run calls unique and are not, or the reverse, on the
                        constraints */
} redundant_tally;

/* Judge the workspace and a run that starts as given, in the three states. What is wrong is
 * printed. */
void redundant_judge(uint64_t seed, redundant_tally *tally);

#endif
