/* SPDX-License-Identifier: BSD-3-Clause */
/* What the library says of random spatial mechanisms, against an oracle in quadruple precision. */
#ifndef BAUM_TEST_SPATIAL_JUDGE_H
#define BAUM_TEST_SPATIAL_JUDGE_H

#include "random_spatial.h"

typedef enum spatial_verdict {
  SPATIAL_MET,         /* accelerations, reactions and balance within SPATIAL_ERROR */
  SPATIAL_REFUSED,     /* and rightly: rows depend on each other, or nearly so */
  SPATIAL_OFF,         /* a projected state does not fulfil the oracle's constraints */
  SPATIAL_ACCELERATED, /* accelerations are farther off */
  SPATIAL_REACTION,    /* reactions that are unique are farther off */
  SPATIAL_BALANCE,     /* reactions do not balance the forces */
  SPATIAL_FALSE_ALARM, /* refused, but the rows are independent */
  SPATIAL_VERDICTS
} spatial_verdict;

/* Relative to the largest acceleration with or without the constraints, or to the largest part of a
 * reaction. What rounding of positions and inertias costs the oracle itself is added a hundred
 * times. */
static const double SPATIAL_ERROR = 1e-9;

/* Of all configurations so far. */
typedef struct spatial_tally {
  long mechanisms;
  long configurations;
  long not_projected; /* configurations that the library could not move onto the constraints */
  long counts[SPATIAL_VERDICTS];
  long dependent;       /* of those met, with dependent rows */
  long reactions;       /* compared */
  long ill_conditioned; /* of those met, farther off because rounding costs the oracle as much */
  double worst;         /* largest error of the others met */
  double worst_reaction;
  uint64_t worst_seed;
} spatial_tally;

/* The mechanism of a seed at its design configuration, and at another that fulfils the constraints,
 * both in motion. Prints what is wrong or a false alarm. `room` holds the mechanism. */
void spatial_judge(random_spatial *room, uint64_t seed, spatial_tally *tally);

/* How many are wrong, or false alarms. */
long spatial_bad(const spatial_tally *tally);

#endif
