/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the errors that studies compute, for each mechanism of the catalogue. A study runs a grid
 * of settings and compares each run with a reference. Here each study is made twice: once with a
 * reference that the study computes, and once with the reference of the catalogue.
 *
 * usage: bench_catalog [MECHANISM]
 *
 * The grid is small. It contains every integrator with each of its formulations, at three steps or
 * tolerances. If the formulation has gains, there is a run with the integrator's default rule for
 * gains, a run with the rule `auto`, and runs with two constant gains. Runs that take more than
 * 0.05 s are stopped. Each run is an entry of the study. tests/support/catalog_grid.h defines which
 * entries are considered wrong.
 */
#include <stdio.h>
#include <string.h>

#include <baum/baum.h>

#include "catalog_grid.h"
#include "timing.h"

static const double LIMIT = 0.05; /* [s] */

static void print_tally(const char *name, const catalog_tally *t)
{
  printf("%-23s %5d %5d %5d %5d %5d %5d %5d %5d %5d | %4d %4d %4d %4d\n", name, t->entries,
         t->state[BAUM_STUDY_DONE], t->state[BAUM_STUDY_REFUSED], t->state[BAUM_STUDY_FAILED],
         t->state[BAUM_STUDY_TIMED_OUT], t->off, t->unstable, t->at_floor, t->compared, t->missing,
         t->better, t->differ, t->unmarked);
  (void)fflush(stdout);
}

int main(int count, char **words)
{
  baum_study_grid grid = baum_study_grid_default();
  grid.settings = 3;
  catalog_tally sum = {0};
  bool fine = true;
  double begin = timing_now();
  printf("%-23s %5s %5s %5s %5s %5s %5s %5s %5s %5s | %4s %4s %4s %4s\n", "entries", "all", "done",
         "refus", "fail", "time", "off", "unst", "floor", "comp", "miss", "bett", "diff", "unmk");
  for (int32_t k = 0; k < baum_catalog_count(); k++) {
    baum_catalog_entry entry;
    catalog_tally one;
    if (baum_catalog_entry_at(k, &entry, sizeof entry) != BAUM_OK || entry.sample_count == 0 ||
        (count > 1 && strcmp(words[1], entry.name) != 0)) {
      continue;
    }
    if (catalog_grid_judge(&entry, &grid, LIMIT, &one) != BAUM_OK) {
      (void)fprintf(stderr, "%s: %s\n", entry.name, baum_message());
      fine = false;
    }
    print_tally(entry.name, &one);
    catalog_tally_add(&sum, &one);
  }
  print_tally("all", &sum);
  printf("%.0f s of CPU time\n", timing_now() - begin);
  return fine && sum.compared > 0 && catalog_tally_wrong(&sum) == 0 ? 0 : 1;
}
