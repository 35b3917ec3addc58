/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanisms of random kinds, and what the library says of their accelerations against quadruple
 * precision. */
#ifndef BAUM_TEST_RANDOM_JUDGE_H
#define BAUM_TEST_RANDOM_JUDGE_H

#include "random_mechanism.h"

typedef enum random_verdict {
  RANDOM_MET,         /* within RANDOM_ERROR */
  RANDOM_REFUSED,     /* and rightly: rows depend on each other, or nearly so */
  RANDOM_WRONG,       /* farther off */
  RANDOM_CONFLICT,    /* rows contradict each other: accelerated by those that were not omitted */
  RANDOM_FALSE_ALARM, /* refused, but the rows are independent */
  RANDOM_VERDICTS
} random_verdict;

/* Relative to the largest acceleration with or without the constraints, whichever is larger. */
static const double RANDOM_ERROR = 1e-9;

/* Of all configurations so far. */
typedef struct random_tally {
  long mechanisms;
  long poses;
  long counts[RANDOM_VERDICTS];
  long dependent; /* configurations with dependent rows and correct accelerations */
  double worst;   /* largest error of those met */
  uint64_t worst_seed;
} random_tally;

/* One mechanism of the kind that its seed determines: at its design configuration in motion, at
 * another that fulfils the constraints, and, with independent rows, at one that does not. Prints
 * what is wrong or a false alarm. `room` holds the mechanism. */
void random_judge(random_mechanism *room, uint64_t seed, random_tally *tally);

#endif
