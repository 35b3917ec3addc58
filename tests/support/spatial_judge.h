/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the library's results for random spatial mechanisms with an oracle in quadruple
 * precision. */
#ifndef BAUM_TEST_SPATIAL_JUDGE_H
#define BAUM_TEST_SPATIAL_JUDGE_H

#include "random_spatial.h"

typedef enum spatial_verdict {
  SPATIAL_MET,     /* accelerations, reactions and balance within SPATIAL_ERROR */
  SPATIAL_REFUSED, /* rightly refused: rows are dependent or nearly so */
  /* Accepted, although omitted rows contradict the others in their second derivative. The
   * accelerations fulfil only the remaining rows. */
  SPATIAL_CONFLICT,
  SPATIAL_OFF,         /* a projected state violates the constraints of the oracle */
  SPATIAL_ACCELERATED, /* the error of accelerations is above the limit */
  SPATIAL_REACTION,    /* the error of unique reactions is above the limit */
  SPATIAL_BALANCE,     /* reactions do not balance the forces */
  SPATIAL_FALSE_ALARM, /* refused, but the rows are independent */
  SPATIAL_VERDICTS
} spatial_verdict;

/* Permitted error. Accelerations: relative to the largest acceleration, either with or without
 * constraints. Reactions: relative to the largest element. To this is added 100 times the change of
 * the oracle's results that rounding of positions and inertias causes. */
static const double SPATIAL_ERROR = 1e-9;

/* Counts of all configurations so far. */
typedef struct spatial_tally {
  long mechanisms;
  long configurations;
  long not_projected; /* configurations whose projection failed */
  long counts[SPATIAL_VERDICTS];
  long dependent;       /* SPATIAL_MET configurations with dependent rows */
  long reactions;       /* number of compared reactions */
  long ill_conditioned; /* SPATIAL_MET configurations whose error exceeds SPATIAL_ERROR */
  double worst;         /* largest error of the other SPATIAL_MET configurations */
  double worst_reaction;
  uint64_t worst_seed;
} spatial_tally;

/* Makes the mechanism of a seed in `room`. Tests it with velocities in its design configuration and
 * in another configuration on the constraints. Prints wrong results and false alarms. */
void spatial_judge(random_spatial *room, uint64_t seed, spatial_tally *tally);

/* Returns the number of wrong results and false alarms. */
long spatial_bad(const spatial_tally *tally);

#endif
