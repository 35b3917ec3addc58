/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the cost of a step with the cost of the evaluations of accelerations that this step
 * needs. The cost of a step includes all checks that a run makes during the step.
 *
 * usage: bench_step                     prints a table
 *        bench_step CASE METHOD COUNT   simulates one case COUNT times, for callgrind
 *
 * The columns are the evaluations per step, the instructions of a step, the instructions of an
 * evaluation, and two ratios. Both ratios compare a step with all of its evaluations. The first is
 * computed from instructions, the second from times. Instructions are counted on Linux if the
 * system permits it; otherwise they are nan.
 *
 * Each case repeats a part of the motion that does not come near a singular configuration.
 * Measurements of steps and of evaluations alternate. The evaluations include those of the
 * companion, a second integration that estimates the error of the run (simulate/companion.c).
 * parts/timing.h defines how times are measured.
 */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* syscall() */
#endif
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __linux__
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include "scenes.h"
#include "simulate/run.h"
#include "timing.h"

static const struct {
  const char *name;
  scene_kind kind;
  int n;
  double end; /* [s] end of the simulated part of the motion, after about 1 rad */
} CASES[] = {
  {"slider_crank", SCENE_ONE_GUIDE, 1, 0.01},
  {"andrews", SCENE_ANDREWS, 1, 0.005},
  {"four_bar_1", SCENE_FOUR_BAR, 1, 0.2},
  {"four_bar_100", SCENE_FOUR_BAR, 100, 0.2},
  {"four_bar_1000", SCENE_FOUR_BAR, 1000, 0.2},
  {"chain_10", SCENE_CHAIN, 10, 0.1},
  {"chain_1000", SCENE_CHAIN, 1000, 0.05},
  {"spatial_slider_crank", SCENE_SPATIAL + (int)MODEL_SPATIAL_SLIDER_CRANK, 1, 0.2},
  {"stewart", SCENE_SPATIAL + (int)MODEL_STEWART, 1, 0.2},
  {"quadruped", SCENE_SPATIAL + (int)MODEL_QUADRUPED, 1, 0.2},
  {"revolute_chain_100", SCENE_SPATIAL + (int)MODEL_REVOLUTE_CHAIN, 100, 0.01},
};
enum { CASE_COUNT = sizeof CASES / sizeof CASES[0] };

static const struct {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  int steps; /* number of steps, or 0 for a variable step */
} METHODS[] = {
  {"semi_implicit_euler", baum_semi_implicit_euler, BAUM_FORMULATION_BAUMGARTE, 2000},
  {"rk4", baum_rk4, BAUM_FORMULATION_BAUMGARTE, 200},
  {"rk4_projection", baum_rk4, BAUM_FORMULATION_PROJECTION, 200},
  {"rk8", baum_rk8, BAUM_FORMULATION_BAUMGARTE, 0},
  {"rk8_projection", baum_rk8, BAUM_FORMULATION_PROJECTION, 0},
  {"dp5_projection", baum_dp5, BAUM_FORMULATION_PROJECTION, 0},
};
enum { METHOD_COUNT = sizeof METHODS / sizeof METHODS[0] };

static const double RTOL = 1e-9;

typedef struct bench {
  scene at;
  baum_simulation *run;
  double end;             /* [s] */
  baum_counters counters; /* of one simulation */
  int evaluations;        /* of one simulation, with those of the companion */
  double alpha;           /* [1/s] */
  double beta;
} bench;

/* ---- counts of instructions ---- */

static int open_counter(void)
{
#ifdef __linux__
  struct perf_event_attr attributes = {.type = PERF_TYPE_HARDWARE,
                                       .size = sizeof attributes,
                                       .config = PERF_COUNT_HW_INSTRUCTIONS,
                                       .exclude_kernel = 1,
                                       .exclude_hv = 1};
  return (int)syscall(SYS_perf_event_open, &attributes, 0, -1, -1, 0);
#else
  return -1;
#endif
}

static double read_counter(int counter)
{
  long long count = 0;
#ifdef __linux__
  if (counter >= 0 && read(counter, &count, sizeof count) == (ssize_t)sizeof count) {
    return (double)count;
  }
#endif
  (void)counter;
  return count == 0 ? (double)NAN : 0.0;
}

/* ---- what is measured ---- */

static baum_status go_back(bench *b)
{
  return baum_simulation_set_state(b->run, 0.0, b->at.q, b->at.v);
}

static bool take_steps(bench *b)
{
  return baum_simulation_advance_to(b->run, b->end) >= BAUM_OK;
}

static bool evaluate(bench *b)
{
  bool fine = true;
  for (int k = 0; k < b->evaluations; k++) {
    fine =
      fine && baum_i_motion(b->at.workspace, 0.0, b->at.q, b->at.v, b->alpha, b->beta) == BAUM_OK;
  }
  return fine;
}

/* Every cost is measured this many times, and the smallest result is used. The resolution of CPU
 * times is better than a tenth of each measured time. */
enum { REPETITIONS = 5 };

typedef struct cost {
  double step[2]; /* [s], instructions */
  double evaluation[2];
} cost;

static bool measure(bench *b, int counter, cost *least)
{
  for (int k = 0; k < REPETITIONS; k++) {
    if (go_back(b) < BAUM_OK) {
      return false;
    }
    double now[2] = {timing_now(), read_counter(counter)};
    bool fine = take_steps(b);
    double middle[2] = {timing_now(), read_counter(counter)};
    fine = evaluate(b) && fine;
    double end[2] = {timing_now(), read_counter(counter)};
    for (int i = 0; i < 2; i++) {
      double step = (middle[i] - now[i]) / (double)b->counters.steps;
      double evaluation = (end[i] - middle[i]) / b->evaluations;
      least->step[i] = k == 0 ? step : fmin(least->step[i], step);
      least->evaluation[i] = k == 0 ? evaluation : fmin(least->evaluation[i], evaluation);
    }
    if (!fine) {
      return false;
    }
  }
  return true;
}

/* ---- one case ---- */

static bool make(int k, int method, bench *out)
{
  baum_simulation_options options = baum_simulation_options_default();
  bool stabilized = METHODS[method].formulation == BAUM_FORMULATION_BAUMGARTE;
  *out = (bench){.end = CASES[k].end, .alpha = stabilized ? 1.0 : 0.0};
  out->beta = out->alpha;
  options.integrator = METHODS[method].integrator();
  options.formulation = METHODS[method].formulation;
  if (METHODS[method].steps > 0) {
    options.step = out->end / METHODS[method].steps;
  } else {
    options.rtol = RTOL;
  }
  return scene_make(CASES[k].kind, CASES[k].n, &out->at) &&
         baum_simulation_create(out->at.m.mechanism, &options, &out->run) >= BAUM_OK;
}

/* Counts the steps and evaluations of one simulation. */
static bool count(bench *b)
{
  const baum_workspace *companion = b->run->beside[1];
  int64_t before = b->run->workspace->evaluations;
  bool fine = go_back(b) >= BAUM_OK && take_steps(b);
  (void)baum_simulation_counters(b->run, &b->counters, sizeof b->counters);
  int64_t count = b->run->workspace->evaluations - before;
  b->evaluations = (int)(count + (companion ? companion->evaluations : 0));
  return fine && b->evaluations > 0;
}

static void clear(bench *b)
{
  baum_simulation_destroy(b->run);
  scene_clear(&b->at);
}

static bool print(int k, int method, int counter)
{
  bench b;
  cost c;
  bool fine = make(k, method, &b) && count(&b) && measure(&b, counter, &c);
  if (fine) {
    double evaluations = (double)b.evaluations / (double)b.counters.steps;
    printf("%-20s %-19s %6.2f %11.0f %11.0f %6.2f %6.2f\n", CASES[k].name, METHODS[method].name,
           evaluations, c.step[1], c.evaluation[1], c.step[1] / (evaluations * c.evaluation[1]),
           c.step[0] / (evaluations * c.evaluation[0]));
  } else {
    printf("%-20s %-19s %s\n", CASES[k].name, METHODS[method].name, baum_message());
  }
  (void)fflush(stdout);
  clear(&b);
  return fine;
}

static bool print_all(void)
{
  bool fine = true;
  int counter = open_counter();
  printf("%-20s %-19s %6s %11s %11s %6s %6s\n", "case", "method", "evals", "step", "evaluation",
         "ratio", "time");
  for (int k = 0; k < CASE_COUNT; k++) {
    for (int method = 0; method < METHOD_COUNT; method++) {
      fine = print(k, method, counter) && fine;
    }
  }
  return fine;
}

static bool take(const char *name, const char *method_name, long times)
{
  for (int k = 0; k < CASE_COUNT; k++) {
    for (int method = 0; method < METHOD_COUNT; method++) {
      if (strcmp(CASES[k].name, name) == 0 && strcmp(METHODS[method].name, method_name) == 0) {
        bench b;
        bool fine = make(k, method, &b);
        for (long i = 0; fine && i < times; i++) {
          fine = go_back(&b) >= BAUM_OK && take_steps(&b);
        }
        clear(&b);
        return fine;
      }
    }
  }
  return false;
}

int main(int argc, char **argv)
{
  bool fine = argc == 4 ? take(argv[1], argv[2], atol(argv[3])) : argc == 1 && print_all();
  if (!fine) {
    (void)fprintf(stderr, "bench_step: %s\n", baum_message());
  }
  return fine ? EXIT_SUCCESS : EXIT_FAILURE;
}
