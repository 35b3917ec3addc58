/* SPDX-License-Identifier: BSD-3-Clause */
/* What becomes of runs through singular poses, and what they say of it.
 *
 *   bench_singular [STARTS]      20 by default, of each mechanism
 *
 * A line for each mechanism and setting: runs that failed; right ones, those of them with a branch warning, and their
 * largest error; wrong ones (an angle off by more than 0.1 rad), and those of them without a branch warning and without
 * any. The last two columns: near-singular intervals and forced steps of all runs.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "singular_scenes.h"

static const double WRONG = 0.1; /* [rad] */

typedef struct counts {
  int failed;
  int right;
  int alarmed;
  int wrong;
  int no_branch_warning;
  int silent;
  double error;
  int64_t intervals;
  int64_t forced;
} counts;

static void count(counts *c, const singular_result *r)
{
  c->intervals += r->intervals;
  c->forced += r->forced;
  if (r->status < BAUM_OK) {
    c->failed++;
  } else if (r->error <= WRONG) {
    c->right++;
    c->alarmed += r->branch_warnings > 0;
    c->error = fmax(c->error, r->error);
  } else {
    c->wrong++;
    c->no_branch_warning += r->branch_warnings == 0;
    c->silent += r->warnings == 0;
  }
}

static void add(counts *sum, const counts *c)
{
  sum->failed += c->failed;
  sum->right += c->right;
  sum->alarmed += c->alarmed;
  sum->wrong += c->wrong;
  sum->no_branch_warning += c->no_branch_warning;
  sum->silent += c->silent;
  sum->error = fmax(sum->error, c->error);
  sum->intervals += c->intervals;
  sum->forced += c->forced;
}

static void print(const char *name, const counts *c)
{
  printf("  %-28s %6d %6d %7d %9.1e %6d %7d %6d %10lld %6lld\n", name, c->failed, c->right,
         c->alarmed, c->error, c->wrong, c->no_branch_warning, c->silent, (long long)c->intervals,
         (long long)c->forced);
  (void)fflush(stdout);
}

static void measure(const char *name, singular_kind kind, int loops, int starts, counts *sum)
{
  enum { SETTINGS = 32 };
  counts c[SETTINGS] = {{0}};
  uint64_t seed = 1;
  printf("%s\n  %-28s %6s %6s %7s %9s %6s %7s %6s %10s %6s\n", name, "", "failed", "right",
         "alarmed", "error", "wrong", "no br.", "silent", "intervals", "forced");
  for (int k = 0; k < starts; k++) {
    singular_scene scene = singular_open(kind, loops, &seed);
    for (int i = 0; SINGULAR_SETTINGS[i].name; i++) {
      singular_result r = singular_run(&scene, &SINGULAR_SETTINGS[i]);
      count(&c[i], &r);
    }
    singular_close(&scene);
  }
  for (int i = 0; SINGULAR_SETTINGS[i].name; i++) {
    print(SINGULAR_SETTINGS[i].name, &c[i]);
    add(sum, &c[i]);
  }
}

int main(int argc, char **argv)
{
  static const int LOOPS[] = {1, 2, 20, 40};
  int starts = argc > 1 ? atoi(argv[1]) : 20;
  counts sum = {0};
  for (int k = 0; k < 4; k++) {
    char name[40];
    (void)snprintf(name, sizeof name, "N-four-bar, N = %d", LOOPS[k]);
    measure(name, SINGULAR_N_FOUR_BAR, LOOPS[k], starts, &sum);
  }
  measure("parallelogram", SINGULAR_PARALLELOGRAM, 0, starts, &sum);
  measure("parallelogram, three cranks", SINGULAR_THREE_CRANKS, 0, starts, &sum);
  measure("slider-crank, equal links", SINGULAR_SLIDER_CRANK, 0, starts, &sum);
  measure("near-parallelogram", SINGULAR_NEAR_PARALLELOGRAM, 0, starts, &sum);
  print("all", &sum);
  return sum.silent == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
