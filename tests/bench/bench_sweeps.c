/* SPDX-License-Identifier: BSD-3-Clause */
/* Makes sweeps over steps and tolerances in difficult scenes. The program counts how many runs are
 * wrong, and how many of these are silently wrong.
 *
 *   bench_sweeps [four-bar | euler | taut | rtol | singular | all] [--full] [--csv FILE]
 *
 *   four-bar  every fixed-step method on linkages within 1 % of a change point (a Grashof equality)
 *   euler     both Euler methods on these linkages, for only half a revolution, because they are
 *             not accurate for longer
 *   taut      every fixed-step method on a light rod that comes taut like a string, with 20 mass
 *             ratios
 *   rtol      every variable-step method on this rod at rtol 1e-9, with 320 mass ratios
 *   singular  every variable-step method through singular configurations, with 60 tolerances
 *
 * References are integrated in reduced coordinates, without the library. The error of a run is its
 * largest position error at ten samples. Lengths are relative to the characteristic length. A run
 * is right if its error is below 0.01, grey if it is below 0.1, and otherwise wrong. Some warnings
 * doubt the motion: they say that it may be wrong. A false alarm is a right run with such a
 * warning. A silent run is a wrong run without such a warning. The last table is the sum of all
 * parts. With --full, every linkage is run both with and without gravity, and the sweeps contain
 * more values of the step. With --csv, a line is written for each run. The program fails if a run
 * is silently wrong.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sweep_runs.h"

static const double MOST_STEPS = 3e4;
static sweep_tally tally; /* too large for the stack */
static sweep_tally all;

typedef struct arguments {
  const char *part;
  bool full;
  FILE *csv;
} arguments;

/* Returns term k of a geometric progression, which has n terms from `first` to `last`. */
static double spread(double first, double last, int k, int n)
{
  return first * pow(last / first, (double)k / (n - 1));
}

static void sweep_steps(const sweep_scene *s, double first, double last, int n)
{
  for (int method = 0; method < tally.method_count; method++) {
    for (int k = 0; k < n; k++) {
      (void)sweep_run(&tally, s, method, spread(first, last, k, n) / s->rate);
    }
  }
}

/* Shortens the step until a run is right. Then makes runs with n different steps, from a quarter of
 * this step to four times this step. About half of these runs are right. */
static void sweep_limit_of(const sweep_scene *s, int method, double longest, int n)
{
  double step = longest;
  double least = s->span / MOST_STEPS;
  while (step > least && sweep_run(&tally, s, method, step) != SWEEP_RIGHT) {
    step /= 1.6;
  }
  for (int k = 0; step > least && k < n; k++) {
    (void)sweep_run(&tally, s, method, spread(fmax(least, step / 4.0), step * 4.0, k, n));
  }
}

static void sweep_limit(const sweep_scene *s, double longest, int n)
{
  for (int method = 0; method < tally.method_count; method++) {
    sweep_limit_of(s, method, longest, n);
  }
}

/* Adds the counts of a part to the total, and prints them. Returns how many runs are silently
 * wrong. */
static int end_part(void)
{
  sweep_add(&tally, &all);
  return sweep_print(&tally);
}

static int sweep_four_bars(const arguments *with)
{
  sweep_begin(&tally, "four-bar", true, with->csv);
  for (int k = 0; k < SWEEP_FOUR_BARS; k++) {
    for (int gravity = 0; gravity < 2; gravity++) {
      if (with->full || gravity == k % 2) {
        sweep_scene s = sweep_four_bar(k, gravity == 1, 3.0);
        printf("%s, relative change of a length %g, gravity %g m/s^2: growth %.2g\n", s.name,
               s.parameter, s.gravity, s.growth);
        (void)fflush(stdout);
        sweep_steps(&s, 0.03, 0.1, with->full ? 40 : 20); /* [rad] */
        sweep_steps(&s, 0.003, 0.03, with->full ? 20 : 10);
        sweep_limit(&s, 0.2 / s.rate, with->full ? 60 : 30);
        sweep_close(&s);
      }
    }
  }
  return end_part();
}

static int sweep_eulers(const arguments *with)
{
  static const double TURNS = 0.5;
  sweep_begin(&tally, "euler", true, with->csv);
  for (int k = 0; k < SWEEP_FOUR_BARS; k++) {
    sweep_scene s = sweep_four_bar(k, k % 2 == 1, TURNS);
    for (int method = 0; method < tally.method_count; method++) {
      const baum_integrator *integrator = tally.methods[method].integrator;
      if (integrator == baum_euler() || integrator == baum_semi_implicit_euler()) {
        sweep_limit_of(&s, method, 0.2 / s.rate, with->full ? 200 : 100);
      }
    }
    sweep_close(&s);
  }
  return end_part();
}

static int sweep_taut_steps(const arguments *with)
{
  enum { RATIOS = 20 };
  sweep_begin(&tally, "taut", true, with->csv);
  for (int k = 0; k < RATIOS; k++) {
    sweep_scene s = sweep_taut(spread(1e-5, 1e-1, k, RATIOS), true);
    double turn = sqrt(s.parameter) * s.rate; /* the rod comes taut within about this angle */
    sweep_steps(&s, 5e-4 * s.rate, 2e-2 * s.rate, with->full ? 60 : 15);
    sweep_limit(&s, 0.3 * turn / s.rate, with->full ? 60 : 30);
    sweep_close(&s);
  }
  return end_part();
}

static int sweep_taut_tolerance(const arguments *with)
{
  enum { RATIOS = 320 };
  sweep_begin(&tally, "rtol", false, with->csv);
  for (int k = 0; k < RATIOS; k++) {
    sweep_scene s = sweep_taut(spread(1e-5, 1e-1, k, RATIOS), false);
    for (int method = 0; method < tally.method_count; method++) {
      (void)sweep_run(&tally, &s, method, 1e-9);
    }
    sweep_close(&s);
  }
  return end_part();
}

static int sweep_crossings(const arguments *with)
{
  enum { TOLERANCES = 60 };
  int n = with->full ? 4 * TOLERANCES : TOLERANCES;
  sweep_begin(&tally, "singular", false, with->csv);
  for (int k = 0; k < SWEEP_SINGULAR; k++) {
    sweep_scene s = sweep_singular(k);
    for (int method = 0; method < tally.method_count; method++) {
      for (int i = 0; i < n; i++) {
        (void)sweep_run(&tally, &s, method, spread(1e-3, 1e-13, i, n));
      }
    }
    sweep_close(&s);
  }
  return end_part();
}

typedef struct part {
  const char *name;
  int (*sweep)(const arguments *with);
} part;

static const part PARTS[] = {
  {"four-bar", sweep_four_bars},  {"euler", sweep_eulers},       {"taut", sweep_taut_steps},
  {"rtol", sweep_taut_tolerance}, {"singular", sweep_crossings},
};
enum { PART_COUNT = sizeof PARTS / sizeof *PARTS };

static bool read_arguments(int count, char **words, arguments *out)
{
  *out = (arguments){.part = "all"};
  bool known = true;
  for (int k = 1; k < count && known; k++) {
    if (strcmp(words[k], "--full") == 0) {
      out->full = true;
    } else if (strcmp(words[k], "--csv") == 0 && k + 1 < count) {
      out->csv = fopen(words[++k], "w");
      known = out->csv != NULL;
    } else {
      out->part = words[k];
      known = strcmp(out->part, "all") == 0;
      for (int i = 0; i < PART_COUNT; i++) {
        known = known || strcmp(out->part, PARTS[i].name) == 0;
      }
    }
  }
  return known;
}

int main(int count, char **words)
{
  arguments with;
  int silent = 0;
  if (!read_arguments(count, words, &with)) {
    (void)fprintf(stderr, "usage: bench_sweeps [four-bar | euler | taut | rtol | singular | all] "
                          "[--full] [--csv FILE]\n");
    return 2;
  }
  if (with.csv) {
    sweep_csv_head(with.csv);
  }
  all.part = "all parts";
  for (int k = 0; k < PART_COUNT; k++) {
    if (strcmp(with.part, "all") == 0 || strcmp(with.part, PARTS[k].name) == 0) {
      silent += PARTS[k].sweep(&with);
    }
  }
  (void)sweep_print(&all);
  if (with.csv && fclose(with.csv) != 0) {
    return 2;
  }
  return silent == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
