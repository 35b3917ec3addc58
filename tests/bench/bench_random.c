/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares accelerations of random mechanisms with those in quadruple precision.
 *
 *   bench_random [COUNT [FIRST_SEED]]     10000 seeds from seed 0 by default
 *
 * Each seed gives two mechanisms, one without and one with velocity-level constraints. The program
 * prints and counts accelerations with an error above 1e-9, mechanisms that are refused although
 * their rows are independent, and wrong numbers of degrees of freedom. It fails if there is any of
 * these.
 */
#include <stdio.h>
#include <stdlib.h>

#include "random_judge.h"

static void report(const random_tally *t)
{
  (void)printf(
    "%ld mechanisms with %ld rows of velocity level, %ld configurations: %ld accurate (%ld of them "
    "with dependent rows), %ld rightly refused, "
    "%ld wrong, %ld with rows that contradict each other, %ld false alarms; degrees of freedom of "
    "%ld mechanisms compared, %ld wrong; largest error of an accurate one %.2g\n",
    t->mechanisms, t->velocity_rows, t->poses, t->counts[RANDOM_MET], t->dependent,
    t->counts[RANDOM_REFUSED], t->counts[RANDOM_WRONG], t->counts[RANDOM_CONFLICT],
    t->counts[RANDOM_FALSE_ALARM], t->mobilities, t->counts[RANDOM_MOBILITY], t->worst);
}

int main(int count, char **arguments)
{
  static random_mechanism room;
  random_tally tally = {0};
  uint64_t mechanisms = count > 1 ? strtoull(arguments[1], NULL, 10) : 10000;
  uint64_t first = count > 2 ? strtoull(arguments[2], NULL, 10) : 0;
  for (uint64_t k = 0; k < mechanisms; k++) {
    random_judge(&room, first + k, false, &tally);
    random_judge(&room, first + k, true, &tally);
  }
  report(&tally);
  return random_bad(&tally) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
