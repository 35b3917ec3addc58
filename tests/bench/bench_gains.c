/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests whether constant gains alpha = beta are better than the gains of the rule `auto`.
 *
 * usage: bench_gains [--quick] [--table] [--problem K] [--integrator NAME] [--lot N]
 *
 * A cell is a combination of a problem, an integrator and an rtol. The cost and the error of a cell
 * are geometric means over perturbed starts. The cost is a number of factorizations. Each
 * evaluation of the accelerations by equation (7) of docs/theory/formulations.md factors a matrix.
 * If the integrator is implicit, the factorizations of its iteration matrix are added. The cost of
 * `auto` includes its pilot run. The error is the largest one over all coordinates and samples.
 * Lengths are relative to the characteristic length, and angles are in radians. In a cell, a
 * constant beats `auto` if it
 *   costs no more than `auto` and has less than a third of its error, or
 *   has no larger error than `auto` and costs less than 1 / 1.25 of its cost.
 * The sweep has 49 constants. They cover 12 decades, with four constants in each. A run with
 * constant gains is stopped when it has taken twice the steps of `auto`, because it can then no
 * longer beat `auto`. A constant for which a run fails does not beat `auto` either. With --table,
 * the program prints every constant, and runs may take six times the steps of `auto`. With --quick,
 * it uses every fourth constant and only two starts.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gain_problems.h"
#include "simulate/run.h"

enum { RTOLS = 4, ALPHAS = 49, STARTS_QUICK = 2, STRIDE_QUICK = 4 };

static const double RTOL[RTOLS] = {1e-4, 1e-6, 1e-8, 1e-10};
static const char *const INTEGRATORS[] = {"cvode_adams", "cvode_bdf", "rk8"};
enum { INTEGRATOR_COUNT = sizeof INTEGRATORS / sizeof INTEGRATORS[0] };

typedef struct arguments {
  bool quick;
  bool table;
  int problem;            /* -1 for all problems */
  int lot;                /* selects a set of random perturbations of the starts */
  const char *integrator; /* NULL for all integrators */
} arguments;

/* Geometric means over all starts. */
typedef struct outcome {
  bool ended; /* whether the runs from all starts reached the end */
  double alpha;
  double cost;
  double error;
  double steps;
  char message[160];
} outcome;

typedef struct cell {
  const gain_problem *problem;
  const baum_integrator *integrator;
  double rtol;
  int starts;
} cell;

/* ---- one run ---- */

static baum_status sample(const cell *at, const gain_start *start, baum_simulation *run,
                          double *error)
{
  const baum_channel positions = baum_channel_of(BAUM_Q);
  const gain_problem *p = at->problem;
  double *rows = calloc((size_t)p->samples * (size_t)p->nq, sizeof *rows);
  baum_status status =
    rows ? baum_simulation_set_state(run, start->t, start->q, start->v) : BAUM_ERR_MEMORY;
  if (status >= 0) {
    status = baum_simulation_sample(run, p->t, p->samples, &positions, 1, rows, NULL);
  }
  *error = status >= 0 ? gain_problem_error(p, rows, start->rows) : (double)NAN;
  free(rows);
  return status;
}

static double own_factorizations(const baum_simulation *run)
{
  baum_i_statistics own = {0};
  if (run->integrator->statistics) {
    run->integrator->statistics(run->self, &own);
  }
  return (double)own.factorizations;
}

/* Makes a run from one start. Adds the logarithms of its cost, steps and error to the sums in
 * `out`. */
static baum_status run_once(const cell *at, const gain_start *start,
                            const baum_simulation_options *options, outcome *out)
{
  baum_simulation *run = NULL;
  double error = (double)NAN;
  baum_counters counters;
  baum_status status = baum_simulation_create(at->problem->m.mechanism, options, &run);
  if (status >= 0) {
    out->alpha = run->problem.alpha;
    status = sample(at, start, run, &error);
  }
  if (status >= 0) {
    status = baum_simulation_counters(run, &counters, sizeof counters);
  }
  if (status >= 0) {
    out->cost += log((double)counters.evaluations + own_factorizations(run));
    out->steps += log((double)counters.steps);
    out->error += log(fmax(error, 1e-15));
  }
  baum_simulation_destroy(run);
  return status;
}

static outcome run_all(const cell *at, baum_gains gains, int64_t max_steps)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = at->integrator;
  options.formulation = BAUM_FORMULATION_BAUMGARTE;
  options.rtol = at->rtol;
  options.gains = gains;
  options.max_steps = max_steps;
  outcome out = {.ended = true};
  for (int s = 0; s < at->starts && out.ended; s++) {
    out.ended = run_once(at, &at->problem->starts[s], &options, &out) >= 0;
  }
  if (!out.ended) {
    (void)snprintf(out.message, sizeof out.message, "%s", baum_message());
  }
  out.cost = exp(out.cost / at->starts);
  out.steps = exp(out.steps / at->starts);
  out.error = exp(out.error / at->starts);
  return out;
}

/* ---- one cell ---- */

static bool beats(const outcome *constant, const outcome *automatic)
{
  bool more_exact = constant->cost <= automatic->cost && constant->error < automatic->error / 3.0;
  bool cheaper = constant->error <= automatic->error && constant->cost < automatic->cost / 1.25;
  return constant->ended && (!automatic->ended || more_exact || cheaper);
}

static double alpha_at(int k)
{
  return pow(10.0, -5.0 + 0.25 * k);
}

static void print_outcome(const cell *at, const char *what, const outcome *o)
{
  printf("%-22s %-12s %6.0e %-6s alpha %8.2e", at->problem->name,
         baum_integrator_name(at->integrator), at->rtol, what, o->alpha);
  if (o->ended) {
    printf(" cost %9.0f steps %8.0f error %8.2e\n", o->cost, o->steps, o->error);
  } else {
    printf(" %s\n", o->message);
  }
}

/* Prints the results of a cell. Returns whether no constant beats `auto`. */
static bool judge(const cell *at, const arguments *args)
{
  outcome automatic = run_all(at, baum_gains_auto(), 1000000);
  double most = automatic.ended ? 2.0 * automatic.steps : 1e5;
  outcome worst = {.ended = false};
  int beaten = 0;
  print_outcome(at, "auto", &automatic);
  for (int k = 0; k < ALPHAS; k += args->quick ? STRIDE_QUICK : 1) {
    double alpha = alpha_at(k);
    outcome constant = run_all(at, baum_gains_fixed(alpha, alpha),
                               (int64_t)((args->table ? 3.0 : 1.0) * most) + 100);
    if (args->table) {
      print_outcome(at, "fixed", &constant);
    }
    if (beats(&constant, &automatic)) {
      beaten++;
      if (!worst.ended || constant.cost * constant.error < worst.cost * worst.error) {
        worst = constant;
      }
    }
  }
  if (beaten > 0) {
    print_outcome(at, "BEATEN", &worst);
  }
  (void)fflush(stdout);
  return beaten == 0;
}

/* ---- all cells ---- */

static const baum_integrator *find(const char *name)
{
  const baum_integrator *found = NULL;
  for (int k = 0; baum_integrator_at(k) && !found; k++) {
    if (strcmp(baum_integrator_name(baum_integrator_at(k)), name) == 0) {
      found = baum_integrator_at(k);
    }
  }
  return found;
}

static void judge_problem(const gain_problem *problem, const arguments *args, int *cells, int *held)
{
  for (int i = 0; i < INTEGRATOR_COUNT; i++) {
    const baum_integrator *integrator = find(INTEGRATORS[i]);
    bool wanted = !args->integrator || strcmp(args->integrator, INTEGRATORS[i]) == 0;
    for (int r = 0; r < RTOLS && wanted && integrator; r++) {
      cell at = {problem, integrator, RTOL[r], args->quick ? STARTS_QUICK : GAIN_STARTS};
      (*cells)++;
      *held += judge(&at, args);
    }
  }
}

static arguments read_arguments(int argc, char **argv)
{
  arguments args = {.problem = -1};
  for (int k = 1; k < argc; k++) {
    args.quick = args.quick || strcmp(argv[k], "--quick") == 0;
    args.table = args.table || strcmp(argv[k], "--table") == 0;
    if (strcmp(argv[k], "--problem") == 0 && k + 1 < argc) {
      args.problem = (int)strtol(argv[++k], NULL, 10);
    } else if (strcmp(argv[k], "--integrator") == 0 && k + 1 < argc) {
      args.integrator = argv[++k];
    } else if (strcmp(argv[k], "--lot") == 0 && k + 1 < argc) {
      args.lot = (int)strtol(argv[++k], NULL, 10);
    }
  }
  return args;
}

int main(int argc, char **argv)
{
  arguments args = read_arguments(argc, argv);
  int cells = 0;
  int held = 0;
  for (int k = 0; k < gain_problem_count(); k++) {
    gain_problem problem;
    if (args.problem >= 0 && args.problem != k) {
      continue;
    }
    if (!gain_problem_make(k, args.lot, &problem)) {
      (void)fprintf(stderr, "bench_gains: %s\n", baum_message());
      return 1;
    }
    printf("%-22s references with a step and with half of it differ by %.1e\n", problem.name,
           problem.apart);
    judge_problem(&problem, &args, &cells, &held);
    gain_problem_clear(&problem);
  }
  printf("no constant beats auto in %d of %d cells\n", held, cells);
  return 0;
}
