/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares accelerations and reactions of random spatial mechanisms with those in quadruple
 * precision.
 *
 *   bench_random_spatial [COUNT [FIRST_SEED]]     10000 seeds from seed 0 by default
 *
 * Each seed gives two mechanisms, one without and one with further elements (random_further.h). The
 * program prints and counts results with an error above 1e-9, mechanisms that are refused although
 * their rows are independent, and wrong numbers of degrees of freedom. It fails if there is any of
 * these.
 */
#include <stdio.h>
#include <stdlib.h>

#include "spatial_judge.h"

static void report(const spatial_tally *t)
{
  (void)printf(
    "%ld mechanisms, %ld configurations and %ld that could not be projected\n"
    "accurate %ld, %ld of them with dependent rows, %ld ill-conditioned, %ld reactions; rightly "
    "refused %ld, too sensitive to rounding %ld\n"
    "%ld rows of velocity level; degrees of freedom of %ld mechanisms compared\n"
    "wrong: conflicts %ld, constraints %ld, accelerations %ld, reactions %ld, balance %ld, degrees "
    "of freedom %ld; false alarms %ld\n"
    "largest errors of the accurate ones: accelerations %.2g (seed %llu), reactions %.2g\n",
    t->mechanisms, t->configurations, t->not_projected, t->counts[SPATIAL_MET], t->dependent,
    t->ill_conditioned, t->reactions, t->counts[SPATIAL_REFUSED], t->unjudged, t->velocity_rows,
    t->mobilities, t->counts[SPATIAL_CONFLICT], t->counts[SPATIAL_OFF],
    t->counts[SPATIAL_ACCELERATED], t->counts[SPATIAL_REACTION], t->counts[SPATIAL_BALANCE],
    t->counts[SPATIAL_MOBILITY], t->counts[SPATIAL_FALSE_ALARM], t->worst,
    (unsigned long long)t->worst_seed, t->worst_reaction);
  (void)printf(
    "%ld screws, %ld constant-velocity joints, %ld rolling discs, %ld knife edges, %ld "
    "couplings, %ld user constraints, %ld torsion springs, %ld bushings, %ld spatial knife edges, "
    "%ld curves, %ld cables\n",
    t->joints[ORACLE_SCREW], t->joints[ORACLE_CONSTANT_VELOCITY], t->joints[ORACLE_ROLLING_DISC],
    t->joints[ORACLE_KNIFE_EDGE], t->joints[ORACLE_COUPLING], t->joints[ORACLE_USER],
    t->forces[ORACLE_TORSION_SPRING], t->forces[ORACLE_BUSHING], t->joints[ORACLE_SPATIAL_EDGE],
    t->joints[ORACLE_CURVE], t->forces[ORACLE_CABLE]);
}

int main(int count, char **arguments)
{
  static random_spatial room;
  spatial_tally tally = {0};
  uint64_t mechanisms = count > 1 ? strtoull(arguments[1], NULL, 10) : 10000;
  uint64_t first = count > 2 ? strtoull(arguments[2], NULL, 10) : 0;
  for (uint64_t k = 0; k < mechanisms; k++) {
    spatial_judge(&room, first + k, false, &tally);
    spatial_judge(&room, first + k, true, &tally);
  }
  report(&tally);
  return spatial_bad(&tally) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
