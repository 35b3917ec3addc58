/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests whether projection is as accurate as Baumgarte's gains. For every integrator that offers
 * both, the table shows three errors at the same step or tolerance. The first error is measured
 * with PROJECTION. The second is measured with BAUMGARTE and the gains of `auto`. The third is
 * measured with BAUMGARTE and the best constant gains alpha = beta of a sweep, which has four
 * constants a decade over twelve decades. A run of the sweep may take at most a quarter more
 * evaluations than the run with PROJECTION.
 *
 * usage: bench_projection
 *
 * The best gain of the sweep is the one with the smallest of 49 errors, which scatter. This error
 * is thus small partly by chance. The number in brackets shows how large this effect is. It is the
 * geometric mean of the errors at the two neighbouring gains.
 */
#include <math.h>
#include <stdio.h>

#include "problems.h"

enum { GAINS = 49, RUNGS = 3 };
static const double RTOL[RUNGS] = {1e-4, 1e-6, 1e-8};
static const double PARTS[RUNGS] = {16.0, 64.0, 256.0}; /* the longest step divided by the step */

typedef struct outcome {
  double error;
  double evaluations;
} outcome;

typedef struct swept {
  double error[GAINS]; /* infinite if the run failed, or if it was more expensive than allowed */
  int best;
} swept;

static const double MOST_COST = 1.25;

static double gain_at(int k)
{
  return pow(10.0, -4.0 + 0.25 * k);
}

static outcome run(const problem *at, const baum_mechanism *mechanism,
                   const baum_simulation_options *o)
{
  reference_run out = reference_compare(&at->with, mechanism, o);
  return (outcome){.error = isnan(out.error) ? (double)INFINITY : out.error,
                   .evaluations = (double)out.counters.evaluations};
}

static swept sweep(const problem *at, const baum_mechanism *mechanism, baum_simulation_options o,
                   double evaluations)
{
  swept all = {.best = 0};
  o.max_steps = (int64_t)evaluations; /* every step takes at least one evaluation */
  for (int k = 0; k < GAINS; k++) {
    o.gains = baum_gains_fixed(gain_at(k), gain_at(k));
    outcome found = run(at, mechanism, &o);
    all.error[k] = found.evaluations <= MOST_COST * evaluations ? found.error : (double)INFINITY;
    all.best = all.error[k] < all.error[all.best] ? k : all.best;
  }
  return all;
}

static double neighbours(const swept *all)
{
  int before = all->best > 0 ? all->best - 1 : 0;
  int after = all->best < GAINS - 1 ? all->best + 1 : GAINS - 1;
  return sqrt(all->error[before] * all->error[after]);
}

static void compare(const problem *at, const baum_mechanism *mechanism,
                    const baum_integrator *integrator, bool fixed)
{
  char pair[PAIR_SIZE];
  problem_pair(integrator, BAUM_FORMULATION_PROJECTION, pair);
  printf("%-13s %-30s %s", at->name, pair, fixed ? "step" : "rtol");
  for (int rung = 0; rung < RUNGS; rung++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = integrator;
    *(fixed ? &o.step : &o.rtol) = fixed ? at->step / PARTS[rung] : RTOL[rung];
    o.formulation = BAUM_FORMULATION_PROJECTION;
    outcome projected = run(at, mechanism, &o);
    o.formulation = BAUM_FORMULATION_BAUMGARTE;
    o.gains = baum_gains_auto();
    outcome automatic = run(at, mechanism, &o);
    swept all = sweep(at, mechanism, o, projected.evaluations);
    printf(" | %8.1e %8.1e %8.1e (%8.1e)", projected.error, automatic.error, all.error[all.best],
           neighbours(&all));
  }
  printf("\n");
  (void)fflush(stdout);
}

static void compare_all(const problem *at, const baum_mechanism *mechanism)
{
  for (int k = 0; baum_integrator_at(k); k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    if (!baum_integrator_offers(integrator, BAUM_FORMULATION_PROJECTION) ||
        !baum_integrator_offers(integrator, BAUM_FORMULATION_BAUMGARTE)) {
      continue;
    }
    if (baum_integrator_has_fixed_step(integrator)) {
      compare(at, mechanism, integrator, true);
    }
    if (baum_integrator_has_variable_step(integrator)) {
      compare(at, mechanism, integrator, false);
    }
  }
}

int main(void)
{
  printf("errors with projection, with the gains of auto, with the best gains (with neighbouring "
         "gains);\nsteps and tolerances decrease from left to right\n");
  for (int k = 0; problem_at(k); k++) {
    model m;
    if (problem_at(k)->build(&m) != BAUM_OK) {
      (void)fprintf(stderr, "%s: %s\n", problem_at(k)->name, baum_message());
      return 1;
    }
    compare_all(problem_at(k), m.mechanism);
    model_destroy(&m);
  }
  return 0;
}
