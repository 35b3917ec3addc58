/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares formulations. For each formulation, the program prints errors, violations, steps and
 * evaluations at the same tolerances or steps.
 *
 * usage: bench_formulations [INTEGRATOR/FORMULATION ...]
 *
 * An argument names an integrator and a formulation, for example ida/ggl or rk4/projection. Without
 * arguments, the program compares the formulations of IDA. Fixed steps are 1/100, 1/1000 and
 * 1/10000 of the span. The references are taken from tests/data. The error is the largest one over
 * all samples. Lengths are relative to the characteristic length, and angles are in radians. Phi [m
 * or rad] and Phi' [m/s or rad/s] are the largest violations over all steps. The number of
 * evaluations counts evaluations of residuals or of accelerations. Setups are factorizations of
 * matrices.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "problems.h"

enum { RUNGS = 3 };
static const double RTOL[RUNGS] = {1e-4, 1e-6, 1e-8};
static const double PARTS[RUNGS] = {1e2, 1e3, 1e4};

/* ---- methods ---- */

typedef struct method {
  const baum_integrator *integrator;
  baum_formulation formulation;
} method;

/* Reads a text of the form "integrator/formulation". Returns false if there is no such pair. */
static bool find_method(const char *text, method *out)
{
  for (int32_t k = 0; baum_integrator_at(k); k++) {
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      char name[PAIR_SIZE];
      out->integrator = baum_integrator_at(k);
      out->formulation = (baum_formulation)f;
      problem_pair(out->integrator, out->formulation, name);
      if (strcmp(name, text) == 0) {
        return baum_integrator_offers(out->integrator, out->formulation);
      }
    }
  }
  return false;
}

static baum_simulation_options options_of(const method *with, const problem *of, int rung)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = with->integrator;
  options.formulation = with->formulation;
  if (baum_integrator_has_variable_step(with->integrator)) {
    options.rtol = RTOL[rung];
  } else {
    options.step = of->with.t[of->with.samples - 1] / PARTS[rung];
  }
  return options;
}

/* ---- runs ---- */

static void print_run(const method *with, const problem *of, const baum_mechanism *mechanism,
                      int rung)
{
  char name[PAIR_SIZE];
  baum_simulation_options options = options_of(with, of, rung);
  problem_pair(with->integrator, with->formulation, name);
  reference_run run = reference_compare(&of->with, mechanism, &options);
  printf("| %-36s | %-20s | %.0e |", of->what, name,
         isnan(options.rtol) ? options.step : options.rtol);
  if (run.status < BAUM_OK) {
    printf(" %s |\n", run.message);
    return;
  }
  printf(" %.1e | %.1e | %.1e | %lld | %lld | %lld |\n", run.error, run.counters.max_phi,
         run.counters.max_phi_rate, (long long)run.counters.steps,
         (long long)run.counters.evaluations, (long long)run.counters.factorizations);
}

static int run_all(const method *methods, int count)
{
  printf("| problem | method | rtol or h | error | Phi | Phi' | steps | evaluations | setups |\n");
  printf("|---|---|---|---|---|---|---|---|---|\n");
  for (int p = 0; problem_at(p); p++) {
    model m;
    if (problem_at(p)->build(&m) != BAUM_OK) {
      (void)fprintf(stderr, "%s: %s\n", problem_at(p)->name, baum_message());
      return 1;
    }
    for (int k = 0; k < count; k++) {
      for (int rung = 0; rung < RUNGS; rung++) {
        print_run(&methods[k], problem_at(p), m.mechanism, rung);
      }
    }
    model_destroy(&m);
  }
  return 0;
}

int main(int argc, char **argv)
{
  enum { MOST = 32 };
  static const char *const DEFAULTS[] = {"ida/index3", "ida/index2", "ida/ggl", "ida/baumgarte"};
  int count = argc > 1 ? argc - 1 : (int)(sizeof DEFAULTS / sizeof *DEFAULTS);
  method methods[MOST];
  if (count > MOST) {
    (void)fprintf(stderr, "bench_formulations: at most %d methods\n", MOST);
    return 2;
  }
  for (int k = 0; k < count; k++) {
    const char *text = argc > 1 ? argv[k + 1] : DEFAULTS[k];
    if (!find_method(text, &methods[k])) {
      (void)fprintf(stderr, "bench_formulations: %s is no INTEGRATOR/FORMULATION\n", text);
      return 2;
    }
  }
  return run_all(methods, count);
}
