/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests whether every inaccurate run gives a warning that its motion may be wrong. Such a warning
 * is said to doubt the motion.
 *
 *   bench_doubts [-n MECHANISMS] [-f FIRST_SEED] [-s SETTING] [-j THREADS] [-c] [-e]
 *
 *   -n, -f number of mechanisms, and seed of the first one; by default 100 and 0
 *   -s      only settings whose names contain the text SETTING
 *   -j      1 or 2 threads; 1 by default
 *   -c      print a line of CSV per run instead of the tables
 *   -e      with the option error_check
 *
 * The mechanisms, their equations and the reference are those of tests/judge. They share no code
 * with baum. A mechanism is used only if two runs of the reference agree to 1e-6. The error of a
 * run is its largest position error at ten samples. Lengths are relative to the characteristic
 * length. A run is right if its error is below 0.01, grey if it is below 0.1, and otherwise wrong.
 * The growth of a motion is the largest factor by which a perturbation grows between any two of 20
 * sample times. In a perturbation, velocities are divided by the mean rate of the motion, which
 * makes them comparable with positions.
 *
 * The program fails if more than 3 % of the right runs of a setting are doubted. It also fails if
 * too many wrong fixed-step runs are silent, which means that no warning doubts their motion. If
 * the growth is at most 30, no wrong run may be silent. If the growth is between 30 and 1000, at
 * most 1 % of the wrong runs may be silent. With the option error_check, no wrong run may be silent
 * up to a growth of 1e4.
 */
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "judge_runs.h"

static const judge_setting SETTINGS[] = {
  {"rk4 projection 30 ms", baum_rk4, BAUM_FORMULATION_PROJECTION, 0.03, 0.0},
  {"rk4 projection 10 ms", baum_rk4, BAUM_FORMULATION_PROJECTION, 0.01, 0.0},
  {"rk4 projection 1 ms", baum_rk4, BAUM_FORMULATION_PROJECTION, 0.001, 0.0},
  {"rk4 baumgarte 10 ms", baum_rk4, BAUM_FORMULATION_BAUMGARTE, 0.01, 0.0},
  {"rk4 baumgarte 1 ms", baum_rk4, BAUM_FORMULATION_BAUMGARTE, 0.001, 0.0},
  {"rk2 projection 5 ms", baum_rk2, BAUM_FORMULATION_PROJECTION, 0.005, 0.0},
  {"rk3 baumgarte 10 ms", baum_rk3, BAUM_FORMULATION_BAUMGARTE, 0.01, 0.0},
  {"euler default 0.1 ms", baum_euler, BAUM_FORMULATION_DEFAULT, 0.0001, 0.0},
  {"euler default 1 ms", baum_euler, BAUM_FORMULATION_DEFAULT, 0.001, 0.0},
  {"euler projection 1 ms", baum_euler, BAUM_FORMULATION_PROJECTION, 0.001, 0.0},
  {"semi_implicit_euler default 1 ms", baum_semi_implicit_euler, BAUM_FORMULATION_DEFAULT, 0.001,
   0.0},
  {"semi_implicit_euler projection 1 ms", baum_semi_implicit_euler, BAUM_FORMULATION_PROJECTION,
   0.001, 0.0},
  {"dp5 projection 50 ms", baum_dp5, BAUM_FORMULATION_PROJECTION, 0.05, 0.0},
  {"dp5 projection 20 ms", baum_dp5, BAUM_FORMULATION_PROJECTION, 0.02, 0.0},
  {"dp5 baumgarte 20 ms", baum_dp5, BAUM_FORMULATION_BAUMGARTE, 0.02, 0.0},
  {"rk8 projection 100 ms", baum_rk8, BAUM_FORMULATION_PROJECTION, 0.1, 0.0},
  {"rk8 projection 40 ms", baum_rk8, BAUM_FORMULATION_PROJECTION, 0.04, 0.0},
  {"ab3 baumgarte 3 ms", baum_ab3, BAUM_FORMULATION_BAUMGARTE, 0.003, 0.0},
  {"ab2 baumgarte 2 ms", baum_ab2, BAUM_FORMULATION_BAUMGARTE, 0.002, 0.0},
  {"rattle 5 ms", baum_rattle, BAUM_FORMULATION_DEFAULT, 0.005, 0.0},
  {"generalized_alpha 5 ms", baum_generalized_alpha, BAUM_FORMULATION_DEFAULT, 0.005, 0.0},
  {"rk8 projection 1e-8", baum_rk8, BAUM_FORMULATION_PROJECTION, 0.0, 1e-8},
  {"dp5 projection 1e-4", baum_dp5, BAUM_FORMULATION_PROJECTION, 0.0, 1e-4},
  {"cvode_bdf default 1e-6", baum_cvode_bdf, BAUM_FORMULATION_DEFAULT, 0.0, 1e-6},
  {"cvode_adams default 1e-6", baum_cvode_adams, BAUM_FORMULATION_DEFAULT, 0.0, 1e-6},
  {"ida default 1e-6", baum_ida, BAUM_FORMULATION_DEFAULT, 0.0, 1e-6},
};

enum { SETTINGS_COUNT = sizeof SETTINGS / sizeof *SETTINGS, GROWTHS = 4, CODES = 256 };

static const double GROWTH_LIMITS[GROWTHS] = {30.0, 1e3, 1e4, INFINITY};

/* A mechanism, its properties, and the results of its runs. */
typedef struct entry {
  uint64_t seed;
  const char *failed;
  const char *family;
  double length;
  double end;
  double mass_ratio;
  bool conservative;
  bool driven;
  int n;
  int rows;
  double agreement;
  double rate;
  double kinetic;
  double growth;
  double growth_end;
  double growth_q;
  judge_outcome runs[SETTINGS_COUNT];
} entry;

typedef struct bench {
  long count;
  uint64_t first;
  const char *only;
  int threads;
  bool csv;
  bool error_check;
  atomic_long next;
  entry *entries;
} bench;

/* ---- runs ---- */

static bool asked_for(const bench *b, int setting)
{
  return !b->only || strstr(SETTINGS[setting].name, b->only);
}

static void judge_one(const bench *b, uint64_t seed, judge_case *c, entry *out)
{
  bool open = judge_open(c, seed);
  *out = (entry){.seed = seed,
                 .failed = c->failed,
                 .family = c->scene.family ? c->scene.family : "none",
                 .length = c->length,
                 .end = c->scene.end,
                 .mass_ratio = c->scene.mass_ratio,
                 .conservative = c->scene.conservative,
                 .driven = c->scene.driven,
                 .n = c->scene.n,
                 .rows = c->scene.rows,
                 .agreement = c->reference.agreement,
                 .rate = c->reference.rate,
                 .kinetic = c->reference.kinetic,
                 .growth = c->reference.growth,
                 .growth_end = c->reference.growth_end,
                 .growth_q = c->reference.growth_q};
  for (int k = 0; open && k < SETTINGS_COUNT; k++) {
    if (asked_for(b, k)) {
      judge_run(c, &SETTINGS[k], b->error_check, &out->runs[k]);
    }
  }
  judge_close(c);
}

static void *run_worker(void *argument)
{
  bench *b = argument;
  judge_case *c = malloc(sizeof *c);
  for (long k = 0; c && (k = atomic_fetch_add(&b->next, 1)) < b->count;) {
    judge_one(b, b->first + (uint64_t)k, c, &b->entries[k]);
  }
  free(c);
  return NULL;
}

/* ---- CSV ---- */

static void print_run(const entry *e, int setting)
{
  static const char *const NAMES[JUDGE_CLASSES] = {"unused", "stopped", "right", "grey", "wrong"};
  const judge_outcome *r = &e->runs[setting];
  const baum_counters *c = &r->counters;
  (void)printf("%llu,%s,%s,%s,%.4g,%.4g,%.4g,%.4g,%.4g,%d,", (unsigned long long)e->seed, e->family,
               SETTINGS[setting].name, NAMES[r->class], r->error, r->error_end, e->growth,
               e->growth_end, e->growth_q, r->doubted);
  for (int k = 0; k < r->code_count; k++) {
    (void)printf("%s%d", k > 0 ? ";" : "", r->codes[k]);
  }
  (void)printf(",%d,%.6g,%.6g,%.6g,%.6g,%.6g,", (int)r->status, c->max_phi, c->max_phi_rate,
               c->predicted_phi, c->energy_change, c->error_estimate);
  (void)printf("%.6g,%d,%d,%.4g,%.6g,%g,%.4g,%.3g,%d,%d,%lld,%lld,%.3g\n", e->kinetic,
               e->conservative, e->driven, e->rate, e->length, e->end, e->mass_ratio, e->agreement,
               e->n, e->rows, (long long)c->steps, (long long)c->near_singular_intervals, c->wall);
}

static void print_csv(const bench *b)
{
  (void)printf(
    "seed,family,setting,class,error,error_end,growth,growth_end,growth_q,doubted,codes,status,"
    "max_phi,max_phi_rate,predicted_phi,energy_change,error_estimate,"
    "kinetic,conservative,driven,rate,length,end,mass_ratio,agreement,"
    "coordinates,rows,steps,near_singular_intervals,wall\n");
  for (long k = 0; k < b->count; k++) {
    for (int i = 0; i < SETTINGS_COUNT; i++) {
      if (b->entries[k].runs[i].class != JUDGE_UNUSED) {
        print_run(&b->entries[k], i);
      }
    }
  }
}

/* ---- tables ---- */

typedef struct tally {
  long count[JUDGE_CLASSES];
  long doubted[JUDGE_CLASSES];
  long wrong[GROWTHS];
  long silent[GROWTHS];
  long codes[JUDGE_CLASSES][CODES];
  double wall; /* [s] */
} tally;

static int growth_class(double growth)
{
  int k = 0;
  while (k + 1 < GROWTHS && !(growth <= GROWTH_LIMITS[k])) {
    k++;
  }
  return k;
}

static void add_run(const entry *e, const judge_outcome *r, tally *out)
{
  out->count[r->class]++;
  out->doubted[r->class] += r->doubted;
  out->wall += r->counters.wall;
  if (r->class == JUDGE_WRONG) {
    out->wrong[growth_class(e->growth)]++;
    out->silent[growth_class(e->growth)] += !r->doubted;
  }
  for (int k = 0; k < r->code_count; k++) {
    out->codes[r->class][r->codes[k] & (CODES - 1)]++;
  }
}

static void print_tally(const char *name, const tally *t)
{
  long right = t->count[JUDGE_RIGHT];
  (void)printf("%-36s %5ld %5ld (%4.1f %%) %4ld (%3ld) %5ld ", name, right, t->doubted[JUDGE_RIGHT],
               right > 0 ? 100.0 * (double)t->doubted[JUDGE_RIGHT] / (double)right : 0.0,
               t->count[JUDGE_GREY], t->doubted[JUDGE_GREY], t->count[JUDGE_WRONG]);
  for (int k = 0; k < GROWTHS; k++) {
    (void)printf(" %4ld/%-4ld", t->silent[k], t->wrong[k]);
  }
  (void)printf(" %5ld %8.2f\n", t->count[JUDGE_STOPPED], t->wall);
}

static void print_codes(const char *name, const tally *t)
{
  for (int code = 0; code < CODES; code++) {
    long sum = 0;
    for (int k = 0; k < JUDGE_CLASSES; k++) {
      sum += t->codes[k][code];
    }
    if (sum > 0) {
      (void)printf("%-36s %4d %-20s %6ld %6ld %6ld %6ld\n", name, code,
                   baum_warning_name((baum_warning_code)code), t->codes[JUDGE_RIGHT][code],
                   t->codes[JUDGE_GREY][code], t->codes[JUDGE_WRONG][code],
                   t->codes[JUDGE_STOPPED][code]);
    }
  }
}

static int by_size(const void *a, const void *b)
{
  double x = *(const double *)a;
  double y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Prints quantiles of the error divided by the estimated error. Runs that have stopped, and runs
 * without an estimated error, are skipped. */
static void print_quantiles(const bench *b, int setting)
{
  double *ratios = malloc((size_t)b->count * sizeof *ratios);
  int n = 0;
  for (long k = 0; ratios && k < b->count; k++) {
    const judge_outcome *r = &b->entries[k].runs[setting];
    double ratio = r->error / r->counters.error_estimate;
    if (r->class >= JUDGE_RIGHT && isfinite(ratio)) {
      ratios[n++] = ratio;
    }
  }
  if (n > 0) {
    qsort(ratios, (size_t)n, sizeof *ratios, by_size);
    (void)printf("%-36s %6d", SETTINGS[setting].name, n);
    for (int k = 0; k < 5; k++) {
      const double at[] = {0.01, 0.1, 0.5, 0.9, 0.99};
      (void)printf(" %8.2g", ratios[(int)(at[k] * (n - 1))]);
    }
    (void)printf("\n");
  }
  free(ratios);
}

static void print_mechanisms(const bench *b)
{
  long growth[GROWTHS] = {0};
  long good = 0;
  for (long k = 0; k < b->count; k++) {
    const entry *e = &b->entries[k];
    if (e->failed) {
      (void)printf("seed %llu, %s: no reference (%s, agreement %.1g)\n",
                   (unsigned long long)e->seed, e->family, e->failed, e->agreement);
    } else {
      good++;
      growth[growth_class(e->growth)]++;
    }
  }
  (void)printf("%ld of %ld mechanisms have a reference; growth up to 30: %ld, 1000: %ld, 1e4: %ld, "
               "above: %ld\n\n",
               good, b->count, growth[0], growth[1], growth[2], growth[3]);
}

static void add_runs(const bench *b, tally *tallies)
{
  for (long k = 0; k < b->count; k++) {
    for (int i = 0; i < SETTINGS_COUNT; i++) {
      add_run(&b->entries[k], &b->entries[k].runs[i], &tallies[i]);
      add_run(&b->entries[k], &b->entries[k].runs[i], &tallies[SETTINGS_COUNT]);
    }
  }
}

/* Prints the tables. The last tally is the sum over all settings. */
static void print_tables(const bench *b, const tally *tallies)
{
  print_mechanisms(b);
  (void)printf("%-36s %5s %-14s %-10s %5s  silent/wrong by growth %23s %8s\n", "setting", "right",
               "doubted", "grey (dbt)", "wrong", "stopped", "wall [s]");
  (void)printf("%74s %-9s %-9s %-9s %-9s\n", "", "<= 30", "<= 1000", "<= 1e4", "above");
  for (int i = 0; i <= SETTINGS_COUNT; i++) {
    if (i == SETTINGS_COUNT || asked_for(b, i)) {
      print_tally(i < SETTINGS_COUNT ? SETTINGS[i].name : "all", &tallies[i]);
    }
  }
  (void)printf("\n%-36s %4s %-20s %6s %6s %6s %6s\n", "setting", "code", "", "right", "grey",
               "wrong", "stopped");
  for (int i = 0; i <= SETTINGS_COUNT; i++) {
    print_codes(i < SETTINGS_COUNT ? SETTINGS[i].name : "all", &tallies[i]);
  }
  (void)printf("\n%-36s %6s %8s %8s %8s %8s %8s\n", "error / error_estimate", "runs", "1 %", "10 %",
               "50 %", "90 %", "99 %");
  for (int i = 0; i < SETTINGS_COUNT; i++) {
    print_quantiles(b, i);
  }
}

/* ---- verdict ---- */

static bool complain(const char *name, const char *what, long part, long whole)
{
  (void)printf("FAILS %s: %s, %ld of %ld\n", name, what, part, whole);
  return false;
}

/* Tells whether the warnings satisfy the conditions at the beginning of this file. */
static bool judge_tallies(const bench *b, const tally *tallies)
{
  bool fine = true;
  long silent[GROWTHS] = {0};
  long wrong[GROWTHS] = {0};
  for (int i = 0; i < SETTINGS_COUNT; i++) {
    const tally *t = &tallies[i];
    long right = t->count[JUDGE_RIGHT];
    for (int k = 0; k < GROWTHS && SETTINGS[i].step > 0.0; k++) {
      silent[k] += t->silent[k];
      wrong[k] += t->wrong[k];
    }
    if (100 * t->doubted[JUDGE_RIGHT] > 3 * right) {
      fine = complain(SETTINGS[i].name, "right but doubted", t->doubted[JUDGE_RIGHT], right);
    }
  }
  if (silent[0] > 0) {
    fine = complain("fixed steps", "silently wrong at growth up to 30", silent[0], wrong[0]);
  }
  if (100 * silent[1] > wrong[1] || (b->error_check && silent[1] > 0)) {
    fine = complain("fixed steps", "silently wrong at growth up to 1000", silent[1], wrong[1]);
  }
  if (b->error_check && silent[2] > 0) {
    fine = complain("fixed steps", "silently wrong at growth up to 1e4", silent[2], wrong[2]);
  }
  return fine;
}

/* ---- main ---- */

static bool read_argument(bench *b, const char *name, const char *value)
{
  if (strcmp(name, "-n") == 0) {
    b->count = strtol(value, NULL, 10);
  } else if (strcmp(name, "-f") == 0) {
    b->first = strtoull(value, NULL, 10);
  } else if (strcmp(name, "-s") == 0) {
    b->only = value;
  } else if (strcmp(name, "-j") == 0) {
    b->threads = strcmp(value, "2") == 0 ? 2 : 1;
  } else {
    return false;
  }
  return true;
}

static bool report(const bench *b)
{
  static tally tallies[SETTINGS_COUNT + 1];
  if (b->csv) {
    print_csv(b);
    return true;
  }
  add_runs(b, tallies);
  print_tables(b, tallies);
  return judge_tallies(b, tallies);
}

int main(int count, char **arguments)
{
  static bench b = {.count = 100, .threads = 1};
  for (int k = 1; k < count; k++) {
    b.csv = b.csv || strcmp(arguments[k], "-c") == 0;
    b.error_check = b.error_check || strcmp(arguments[k], "-e") == 0;
    if (k + 1 < count && read_argument(&b, arguments[k], arguments[k + 1])) {
      k++;
    }
  }
  b.entries = b.count > 0 ? calloc((size_t)b.count, sizeof *b.entries) : NULL;
  if (!b.entries) {
    return EXIT_FAILURE;
  }
  pthread_t second;
  bool two = b.threads == 2 && pthread_create(&second, NULL, run_worker, &b) == 0;
  (void)run_worker(&b);
  if (two) {
    (void)pthread_join(second, NULL);
  }
  bool fine = report(&b);
  free(b.entries);
  return fine ? EXIT_SUCCESS : EXIT_FAILURE;
}
