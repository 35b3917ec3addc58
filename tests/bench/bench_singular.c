/* SPDX-License-Identifier: BSD-3-Clause */
/* Prints the results and warnings of runs that pass through singular configurations.
 *
 *   bench_singular [STARTS [MECHANISM [SEED]]]
 *
 * STARTS is the number of starts, 20 by default. MECHANISM is a name in the table MECHANISMS below.
 * By default all mechanisms are run. SEED is the seed for the starts, 1 by default.
 *
 * Each line is for one mechanism and one setting. It first counts the failed runs. Then it counts
 * the right runs and the right runs with a branch warning, and gives the largest error of right
 * runs. Finally it counts the wrong runs (the error of an angle is above 0.1 rad), the wrong runs
 * without a branch warning, and the wrong runs without any warning. The last two columns count the
 * near-singular intervals of all runs, and the forced steps, which are steps across a singularity.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "singular_scenes.h"

static const double WRONG = 0.1; /* [rad] */

typedef struct mechanism {
  const char *name;
  singular_kind kind;
  int loops;
} mechanism;

static const mechanism MECHANISMS[] = {
  {"four-bar-1", SINGULAR_N_FOUR_BAR, 1},
  {"four-bar-2", SINGULAR_N_FOUR_BAR, 2},
  {"four-bar-20", SINGULAR_N_FOUR_BAR, 20},
  {"four-bar-40", SINGULAR_N_FOUR_BAR, 40},
  {"parallelogram", SINGULAR_PARALLELOGRAM, 0},
  {"three-cranks", SINGULAR_THREE_CRANKS, 0},
  {"slider-crank", SINGULAR_SLIDER_CRANK, 0},
  {"near-parallelogram", SINGULAR_NEAR_PARALLELOGRAM, 0},
};

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
    c->silent += r->doubts == 0;
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

static void measure(const mechanism *m, int starts, uint64_t seed, counts *sum)
{
  enum { SETTINGS = 32 };
  counts c[SETTINGS] = {{0}};
  counts all = {0};
  printf("%s\n  %-28s %6s %6s %7s %9s %6s %7s %6s %10s %6s\n", m->name, "", "failed", "right",
         "alarmed", "error", "wrong", "no br.", "silent", "intervals", "forced");
  for (int k = 0; k < starts; k++) {
    singular_scene scene = singular_open(m->kind, m->loops, &seed);
    for (int i = 0; SINGULAR_SETTINGS[i].name; i++) {
      singular_result r = singular_run(&scene, &SINGULAR_SETTINGS[i]);
      count(&c[i], &r);
    }
    singular_close(&scene);
  }
  for (int i = 0; SINGULAR_SETTINGS[i].name; i++) {
    print(SINGULAR_SETTINGS[i].name, &c[i]);
    add(&all, &c[i]);
  }
  print("all settings", &all);
  add(sum, &all);
}

int main(int argc, char **argv)
{
  int starts = argc > 1 ? atoi(argv[1]) : 20;
  const char *name = argc > 2 ? argv[2] : "all";
  uint64_t seed = argc > 3 ? strtoull(argv[3], NULL, 10) : 1;
  counts sum = {0};
  for (size_t k = 0; k < sizeof MECHANISMS / sizeof *MECHANISMS; k++) {
    if (strcmp(name, "all") == 0 || strcmp(name, MECHANISMS[k].name) == 0) {
      measure(&MECHANISMS[k], starts, seed, &sum);
    }
  }
  print("all", &sum);
  return sum.right + sum.wrong > 0 && sum.silent == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
