/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares accelerations of random mechanisms of slender rods (slender_rods.h) with those in
 * quadruple precision.
 *
 *   bench_slender [COUNT [FIRST_SEED [UNITS OF LENGTH IN A METRE]]]   1000 seeds from 0 by default
 *
 * Prints how many results are right, refused or wrong, for each decade of the smallest ratio of an
 * axial to a transverse moment of inertia. Fails if a result is wrong without a message, or refused
 * without a reason. */
#include <stdio.h>
#include <stdlib.h>

#include "slender_rods.h"

static void print_row(const char *name, const long *counts)
{
  (void)printf("%-12s", name);
  for (int k = 0; k < SLENDER_VERDICTS; k++) {
    (void)printf(" %9ld", counts[k]);
  }
  (void)printf("\n");
}

int main(int count, char **arguments)
{
  slender_tally tally = {0};
  uint64_t mechanisms = count > 1 ? strtoull(arguments[1], NULL, 10) : 1000;
  uint64_t first = count > 2 ? strtoull(arguments[2], NULL, 10) : 0;
  double unit = count > 3 ? strtod(arguments[3], NULL) : 1.0;
  for (uint64_t k = 0; k < mechanisms; k++) {
    slender_judge(first + k, unit, &tally, NULL);
  }
  (void)printf("%ld mechanisms, %ld configurations could not be projected\n%-12s %9s %9s %9s %9s "
               "%9s %9s\n",
               tally.mechanisms, tally.not_projected, "ratio", "right", "rounded", "unjudged",
               "refused", "falsely", "wrong");
  for (int k = 0; k < SLENDER_CLASSES; k++) {
    char name[16];
    (void)snprintf(name, sizeof name, k == SLENDER_CLASSES - 1 ? "0" : "1e-%d", k + 1);
    print_row(name, tally.by_class[k]);
  }
  print_row("all", tally.counts);
  (void)printf("largest errors: of right results %.2g, of those that rounding explains %.2g\n",
               tally.worst, tally.worst_rounded);
  long bad = tally.counts[SLENDER_WRONG] + tally.counts[SLENDER_FALSE_REFUSAL];
  return bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
