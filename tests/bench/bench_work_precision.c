/* SPDX-License-Identifier: BSD-3-Clause */
/* Shows work against precision. For every integrator and formulation, runs are made with a series
 * of steps or tolerances. The table shows the cheapest runs whose largest error over all samples is
 * at most 1e-4, 1e-6, 1e-8 and 1e-10.
 *
 * usage: bench_work_precision [PROBLEM]
 *
 * Errors of lengths are relative to the characteristic length. Errors of angles are in radians. The
 * time is the CPU time of this thread from the creation of the run to the last sample. It is the
 * smallest one of several repetitions. A series ends when a run takes longer than LONGEST, or when
 * the error no longer decreases.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "problems.h"
#include "timing.h"

static const double LONGEST = 1.0; /* [s] */
static const double REPEATED = 0.02;
enum {
  RUNGS = 40,
  TARGETS = 4,
  WORSE = 6,
  WINDOW_SAMPLES = 10,
  WINDOW_STEPS = 100000,
  REPEATS = 5
};
static const double TARGET[TARGETS] = {1e-4, 1e-6, 1e-8, 1e-10};

/* ---- one setting ---- */

typedef struct priced {
  double seconds;
  long long evaluations;
  double setting; /* step or rtol */
} priced;

static double measure(const problem *at, const baum_mechanism *mechanism,
                      const baum_simulation_options *o, reference_run *run)
{
  double best = (double)INFINITY;
  double all = 0.0;
  for (int k = 0; k < REPEATS && all < REPEATED; k++) {
    double begin = timing_now();
    *run = reference_compare(&at->with, mechanism, o);
    double taken = timing_now() - begin;
    best = fmin(best, taken);
    all += taken;
  }
  return best;
}

static void keep_cheapest(priced best[TARGETS], double error, priced found)
{
  for (int k = 0; k < TARGETS; k++) {
    if (error <= TARGET[k] && !(best[k].seconds <= found.seconds)) {
      best[k] = found;
    }
  }
}

/* Returns a step or a tolerance. Each step is half of the one before. Tolerances decrease by half a
 * decade each. */
static double setting_of(const problem *at, bool fixed, int rung)
{
  return fixed ? at->step / exp2(rung) : pow(10.0, -2.0 - 0.5 * rung);
}

/* Finds the cheapest runs for one integrator with one formulation. */
static void climb(const problem *at, const baum_mechanism *mechanism, baum_simulation_options o,
                  bool fixed, priced best[TARGETS])
{
  double least = (double)INFINITY;
  int worse = 0;
  for (int k = 0; k < TARGETS; k++) {
    best[k] = (priced){.seconds = (double)NAN};
  }
  for (int rung = 0; rung < RUNGS && worse < WORSE; rung++) {
    double setting = setting_of(at, fixed, rung);
    *(fixed ? &o.step : &o.rtol) = setting;
    if (!fixed && setting < 1e-14) {
      break;
    }
    reference_run run;
    double seconds = measure(at, mechanism, &o, &run);
    worse = run.error < 0.9 * least ? 0 : worse + 1;
    least = fmin(least, isnan(run.error) ? least : run.error);
    keep_cheapest(best, run.error, (priced){seconds, run.counters.evaluations, setting});
    if (seconds > LONGEST) {
      break;
    }
  }
}

static void print_row(const baum_simulation_options *o, const char *kind,
                      const priced best[TARGETS])
{
  char pair[PAIR_SIZE];
  problem_pair(o->integrator, o->formulation, pair);
  printf("%-34s %-4s", pair, kind);
  for (int k = 0; k < TARGETS; k++) {
    if (isnan(best[k].seconds)) {
      printf(" | %27s", "-");
    } else {
      printf(" | %9.3f %8lld %8.1e", 1e3 * best[k].seconds, best[k].evaluations, best[k].setting);
    }
  }
  printf("\n");
  (void)fflush(stdout);
}

static void price(const problem *at, const baum_mechanism *mechanism,
                  const baum_integrator *integrator, baum_formulation formulation)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.formulation = formulation;
  for (int fixed = 0; fixed <= 1; fixed++) {
    bool offered = fixed ? baum_integrator_has_fixed_step(integrator)
                         : baum_integrator_has_variable_step(integrator);
    if (offered) {
      priced best[TARGETS];
      climb(at, mechanism, o, fixed == 1, best);
      print_row(&o, fixed ? "step" : "rtol", best);
    }
  }
}

static void print_head(const problem *at)
{
  printf("\n%s: %s\n%-39s", at->name, at->what, "error at most");
  for (int k = 0; k < TARGETS; k++) {
    printf(" | %27.0e", TARGET[k]);
  }
  printf("\n%-39s", "");
  for (int k = 0; k < TARGETS; k++) {
    printf(" | %9s %8s %8s", "ms", "evals", "setting");
  }
  printf("\n");
}

static bool price_all(const problem *at)
{
  model m;
  if (at->build(&m) != BAUM_OK) {
    (void)fprintf(stderr, "%s: %s\n", at->name, baum_message());
    return false;
  }
  print_head(at);
  for (int k = 0; baum_integrator_at(k); k++) {
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      if (baum_integrator_offers(baum_integrator_at(k), (baum_formulation)f)) {
        price(at, m.mechanism, baum_integrator_at(k), (baum_formulation)f);
      }
    }
  }
  model_destroy(&m);
  return true;
}

int main(int count, char **words)
{
  bool fine = true;
  bool known = count == 1;
  for (int k = 0; problem_at(k); k++) {
    bool wanted = count == 1 || (count == 2 && strcmp(words[1], problem_at(k)->name) == 0);
    known = known || wanted;
    fine = (!wanted || price_all(problem_at(k))) && fine;
  }
  if (!known) {
    (void)fprintf(
      stderr,
      "usage: bench_work_precision [pendulum | slider_crank | four_bar | andrews | window]\n");
    return 2;
  }
  return fine ? 0 : 1;
}
