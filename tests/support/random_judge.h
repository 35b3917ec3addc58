/* SPDX-License-Identifier: BSD-3-Clause */
/* For random mechanisms, compares the accelerations from the library with accelerations that are
 * computed in quadruple precision. */
#ifndef BAUM_TEST_RANDOM_JUDGE_H
#define BAUM_TEST_RANDOM_JUDGE_H

#include "random_mechanism.h"

typedef enum random_verdict {
  RANDOM_MET,         /* the error is at most RANDOM_ERROR */
  RANDOM_REFUSED,     /* refused, which is right because rows are dependent or nearly so */
  RANDOM_WRONG,       /* the error is larger */
  RANDOM_CONFLICT,    /* accepted, although omitted rows contradict the others */
  RANDOM_FALSE_ALARM, /* refused, although the rows are independent */
  RANDOM_MOBILITY,    /* the degrees of freedom disagree with the ranks of J */
  RANDOM_VERDICTS
} random_verdict;

/* The largest permitted error. It is relative to the largest acceleration with constraints or
 * without them, whichever is larger. */
static const double RANDOM_ERROR = 1e-9;

/* Counts of the configurations tested so far. */
typedef struct random_tally {
  long mechanisms;
  long poses;
  long counts[RANDOM_VERDICTS];
  long dependent;     /* configurations with dependent rows and correct accelerations */
  long velocity_rows; /* rows of velocity level in all mechanisms */
  long mobilities;    /* mechanisms whose degrees of freedom were compared with ranks of J */
  double worst;       /* largest error of all RANDOM_MET configurations */
  uint64_t worst_seed;
} random_tally;

/* Makes the mechanism of a seed in `room`, and tests it with velocities. If `velocity_rows` is
 * true, rows of velocity level are added to the mechanism. It is tested in its design
 * configuration, and in another configuration on the constraints. In the second one, the ranks of J
 * must give the degrees of freedom that the library reports. If no rows are redundant, the
 * mechanism is also tested in a configuration off the constraints. Prints wrong results and false
 * alarms. */
void random_judge(random_mechanism *room, uint64_t seed, bool velocity_rows, random_tally *tally);

/* Returns how many results were wrong or false alarms. */
long random_bad(const random_tally *tally);

#endif
