/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the library's results for random spatial mechanisms with the results of an oracle, which
 * uses quadruple precision. */
#ifndef BAUM_TEST_SPATIAL_JUDGE_H
#define BAUM_TEST_SPATIAL_JUDGE_H

#include "random_spatial.h"

typedef enum spatial_verdict {
  SPATIAL_MET,     /* errors of accelerations, reactions and balance are at most SPATIAL_ERROR */
  SPATIAL_REFUSED, /* refused, which is right because rows are dependent or nearly so */
  /* Accepted, although the second derivatives of omitted rows contradict the other rows. The
   * accelerations satisfy only the rows that are not omitted. */
  SPATIAL_CONFLICT,
  SPATIAL_OFF,         /* a projected state violates the constraints of the oracle */
  SPATIAL_ACCELERATED, /* the error of accelerations is above the limit */
  SPATIAL_REACTION,    /* the error of unique reactions is above the limit */
  SPATIAL_BALANCE,     /* reactions do not balance the forces */
  SPATIAL_FALSE_ALARM, /* refused, although the rows are independent */
  SPATIAL_MOBILITY,    /* the degrees of freedom disagree with the ranks of J */
  SPATIAL_VERDICTS
} spatial_verdict;

/* The largest permitted error. Errors of accelerations are relative to the largest acceleration
 * with constraints or without them, whichever is larger. Errors of reactions are relative to the
 * largest element of all reactions. Rounding of positions and inertias changes the results of the
 * oracle. 100 times this change is added to the limit. */
static const double SPATIAL_ERROR = 1e-9;

/* Counts of the configurations tested so far. */
typedef struct spatial_tally {
  long mechanisms;
  long configurations;
  long not_projected; /* configurations whose projection failed */
  long counts[SPATIAL_VERDICTS];
  long dependent;     /* SPATIAL_MET configurations with dependent rows */
  long mobilities;    /* mechanisms whose degrees of freedom were compared with ranks of J */
  long velocity_rows; /* rows of velocity level in all configurations */
  long joints[ORACLE_KINDS];
  long forces[ORACLE_FORCE_KINDS];
  long reactions;       /* number of compared reactions */
  long unjudged;        /* errors are large, but so is the effect of rounding errors */
  long ill_conditioned; /* SPATIAL_MET configurations whose error exceeds SPATIAL_ERROR */
  double worst; /* largest error of the SPATIAL_MET configurations that are not ill-conditioned */
  double worst_reaction;
  uint64_t worst_seed;
} spatial_tally;

/* Makes the mechanism of a seed in `room`. The mechanism is tested with velocities, in its design
 * configuration and in another configuration on the constraints. In the second one, the ranks of J
 * must give the degrees of freedom that the library reports. Prints wrong results and false
 * alarms. */
void spatial_judge(random_spatial *room, uint64_t seed, bool further, spatial_tally *tally);

/* Returns how many results were wrong or false alarms. */
long spatial_bad(const spatial_tally *tally);

#endif
