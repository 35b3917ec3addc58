/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the library's results for random spatial mechanisms with an oracle in quadruple
 * precision. */
#ifndef BAUM_TEST_SPATIAL_JUDGE_H
#define BAUM_TEST_SPATIAL_JUDGE_H

#include "random_spatial.h"

typedef enum spatial_verdict {
  SPATIAL_MET,     /* accelerations, reactions and balance within SPATIAL_ERROR */
  SPATIAL_REFUSED, /* rightly refused: rows are dependent or nearly so */
  /* Accepted, although omitted rows contradict the others in their second derivative; the
   * accelerations fulfil only the remaining rows. */
  SPATIAL_CONFLICT,
  SPATIAL_OFF,         /* a projected state violates the oracle's constraints */
  SPATIAL_ACCELERATED, /* the error of accelerations is above the limit */
  SPATIAL_REACTION,    /* the error of unique reactions is above the limit */
  SPATIAL_BALANCE,     /* reactions do not balance the forces */
  SPATIAL_FALSE_ALARM, /* refused, but the rows are independent */
  SPATIAL_VERDICTS
} spatial_verdict;

/* Permitted error, relative to the largest acceleration, with or without constraints, or to the
 * largest element of a reaction. A hundred times the oracle's own sensitivity to rounding of
 * positions and inertias is added to it. */
static const double SPATIAL_ERROR = 1e-9;

/* Counts over all configurations so far. */
typedef struct spatial_tally {
  long mechanisms;
  long configurations;
  long not_projected; /* configurations where the projection failed */
  long counts[SPATIAL_VERDICTS];
  long dependent;       /* SPATIAL_MET configurations with dependent rows */
  long reactions;       /* number of compared reactions */
  long ill_conditioned; /* SPATIAL_MET configurations whose error exceeds SPATIAL_ERROR */
  double worst;         /* largest error of the other SPATIAL_MET configurations */
  double worst_reaction;
  uint64_t worst_seed;
} spatial_tally;

/* Makes the mechanism of a seed in `room` and tests it in its design configuration and in another
 * one on the constraints, both with velocities. Prints wrong results and false alarms. */
void spatial_judge(random_spatial *room, uint64_t seed, spatial_tally *tally);

/* Number of wrong results and false alarms. */
long spatial_bad(const spatial_tally *tally);

#endif
