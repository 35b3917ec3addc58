/* SPDX-License-Identifier: BSD-3-Clause */
/* Prints the time of one evaluation of the accelerations with each solver, and the times of its
 * phases.
 *
 * usage: bench_eval [--json] [--case NAME] [--largest N]
 *
 * All solvers run in this process, on the same scene and with the same code for the geometry, in
 * alternating rounds. parts/timing.h defines how times are measured. With --json, the program
 * prints one JSON object per line.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/block_path.h"
#include "scenes.h"
#include "simulate/run.h"
#include "solvers.h"
#include "timing.h"
#include "variants.h"

enum { MOST_SOLVERS = 8, LARGEST_STEPPED = 10000 };

typedef struct arguments {
  bool json;
  const char *only; /* NULL for all cases */
  int largest;
} arguments;

static const struct {
  scene_kind kind;
  int n;
} CASES[] = {
  {SCENE_SLIDER_CRANK, 1}, {SCENE_ANDREWS, 1},    {SCENE_FOUR_BAR, 1},    {SCENE_FOUR_BAR, 10},
  {SCENE_FOUR_BAR, 40},    {SCENE_FOUR_BAR, 100}, {SCENE_FOUR_BAR, 1000}, {SCENE_FOUR_BAR, 10000},
  {SCENE_CHAIN, 10},       {SCENE_CHAIN, 100},    {SCENE_CHAIN, 1000},    {SCENE_CHAIN, 10000},
  {SCENE_CHAIN, 100000},
};
enum { CASE_COUNT = sizeof CASES / sizeof CASES[0] };

/* ---- one scene ---- */

typedef struct measured {
  const solver *way;
  void *self;
  double whole;             /* [s] */
  double upto[PHASE_COUNT]; /* [s] from the start of an evaluation to the end of each phase */
  /* Relative difference between the accelerations of this solver and of the first one. */
  double apart;
} measured;

static double smaller(double a, double b)
{
  return isnan(a) || a < b ? a : b;
}

static int create_all(scene *at, solver_list *list, measured all[MOST_SOLVERS])
{
  int count = 0;
  for (int k = 0; list(k) && count < MOST_SOLVERS; k++) {
    measured m = {.way = list(k), .whole = (double)INFINITY, .apart = (double)NAN};
    m.self = m.way->create(at);
    for (int phase = 0; phase < PHASE_COUNT; phase++) {
      m.upto[phase] = (double)INFINITY;
    }
    if (m.self) {
      all[count++] = m;
    }
  }
  return count;
}

static void time_whole(measured *m)
{
  m->whole = smaller(timing_round(m->way->run, m->self, PHASE_WHOLE), m->whole);
}

static void time_round(measured *m)
{
  for (int phase = 0; phase < PHASE_COUNT && m->way->has_phases; phase++) {
    m->upto[phase] = smaller(timing_round(m->way->run, m->self, phase), m->upto[phase]);
  }
  time_whole(m);
}

/* Compares the accelerations of all solvers. */
static void compare_solutions(const scene *at, measured *all, int count)
{
  size_t nv = (size_t)at->workspace->mechanism->nv;
  size_t nc = (size_t)at->workspace->mechanism->nc;
  double *a = calloc(2 * nv + nc + 1, sizeof *a);
  for (int k = 0; a && k < count; k++) {
    double *mine = k == 0 ? a : a + nv;
    double size = 0.0;
    double apart = 0.0;
    if (!all[k].way->run(all[k].self, PHASE_WHOLE)) {
      continue;
    }
    all[k].way->read(all[k].self, mine, a + 2 * nv);
    for (size_t i = 0; i < nv; i++) {
      size = fmax(size, fabs(a[i]));
      apart = fmax(apart, fabs(mine[i] - a[i]));
    }
    all[k].apart = size > 0.0 ? apart / size : apart;
  }
  free(a);
}

static void print_json(const scene *at, const char *solver_name, double seconds)
{
  printf("{\"case\": \"%s\", \"n\": %d, \"solver\": \"%s\", \"ns_per_eval\": %.1f}\n",
         scene_name(at->kind), at->n, solver_name, 1e9 * seconds);
  (void)fflush(stdout);
}

static void print_phases(const measured *m)
{
  double before = 0.0;
  for (int phase = 0; phase < PHASE_COUNT; phase++) {
    if (m->way->has_phases) {
      printf(" %9.0f", 1e9 * (m->upto[phase] - before));
      before = m->upto[phase];
    } else {
      printf(" %9s", "-");
    }
  }
  if (m->way->has_phases) {
    printf(" %9.0f", 1e9 * (m->whole - before));
  } else {
    printf(" %9s", "-");
  }
}

static void print_row(const scene *at, const measured *m, double reference)
{
  printf("%-12s %6d %-11s %10.0f %8.1f %6.2f", scene_name(at->kind), at->n, m->way->name,
         1e9 * m->whole, 1e9 * m->whole / at->bodies, m->whole / reference);
  print_phases(m);
  printf(" %6.0e\n", m->apart);
  (void)fflush(stdout);
}

static void print_head(void)
{
  printf(
    "\nThe column ns is the CPU time per evaluation. rel: this time divided by that of the first "
    "solver.\nThe phases are in ns. other: time of the whole evaluation outside of the phases, for "
    "checks,\nrefinement and copies. apart: largest difference from the accelerations of the first "
    "solver,\nrelative to the largest acceleration.\n");
  printf("%-12s %6s %-11s %10s %8s %6s %9s %9s %9s %9s %9s %6s\n", "case", "n", "solver", "ns",
         "per body", "rel", "geometry", "assembly", "factor", "solve", "other", "apart");
}

/* Destroys the solvers. Returns false if there is no solver, if a solver failed, or if their
 * accelerations differ. */
static bool finish_all(const measured *all, int count)
{
  bool fine = count > 0;
  for (int k = 0; k < count; k++) {
    fine = fine && all[k].apart < 1e-6 && all[k].whole > 0.0;
    all[k].way->destroy(all[k].self);
  }
  return fine;
}

/* Measures all solvers on one scene. Returns false if something failed, or if the solvers
 * disagree. */
static bool bench_scene(scene_kind kind, int n, bool json)
{
  scene at;
  measured all[MOST_SOLVERS];
  if (!scene_make(kind, n, &at)) {
    (void)fprintf(stderr, "%s %d: %s\n", scene_name(kind), n, baum_message());
    return false;
  }
  int count = create_all(&at, solver_at, all);
  for (int round = 0; round < TIMING_ROUNDS; round++) {
    for (int k = 0; k < count; k++) {
      time_round(&all[k]);
    }
  }
  compare_solutions(&at, all, count);
  for (int k = 0; k < count; k++) {
    if (json) {
      print_json(&at, all[k].way->name, all[k].whole);
    } else {
      print_row(&at, &all[k], all[0].whole);
    }
  }
  bool fine = finish_all(all, count);
  scene_clear(&at);
  return fine;
}

static bool is_wanted(const arguments *given, scene_kind kind, int n)
{
  bool named = !given->only || strcmp(given->only, scene_name(kind)) == 0;
  return named && n <= given->largest;
}

static bool bench_solvers(const arguments *given)
{
  bool fine = true;
  bool begun = given->json;
  for (int k = 0; k < CASE_COUNT; k++) {
    if (is_wanted(given, CASES[k].kind, CASES[k].n)) {
      if (!begun) {
        print_head();
        begun = true;
      }
      fine = bench_scene(CASES[k].kind, CASES[k].n, given->json) && fine;
    }
  }
  return fine;
}

/* ---- spatial scenes ---- */

/* [s] Time that this library needs for one acceleration of the driven planar slider-crank. It was
 * measured on the same machine as the other programs below. */
static const double CRANK_OF_PEERS = 184e-9;

/* [ns] Time that the faster one of two other programs needs for one acceleration. These programs
 * are Pinocchio 4.1.0 and MuJoCo 4.0.0. They were measured on one machine of 3.2 GHz, with their
 * fastest calls. NaN means not measured. MuJoCo's flyball had no springs. No command repeats these
 * measurements. */
static const struct {
  model_spatial which;
  int n;
  double peer;
} SPATIAL[] = {
  {MODEL_SPATIAL_SLIDER_CRANK, 1, 1590.0},
  {MODEL_RSSR, 1, 1538.0},
  {MODEL_BRICARD, 1, 2595.0},
  {MODEL_SLENDER_BRICARD, 1, (double)NAN},
  {MODEL_STEWART, 1, 8640.0},
  {MODEL_QUADRUPED, 1, 2630.0},
  {MODEL_FLYBALL, 1, 807.0},
  {MODEL_SPHERICAL_CHAIN, 10, 3700.0},
  {MODEL_SPHERICAL_CHAIN, 100, 39100.0},
  {MODEL_SPHERICAL_CHAIN, 1000, (double)NAN},
  {MODEL_SPHERICAL_CHAIN, 10000, (double)NAN},
  {MODEL_REVOLUTE_CHAIN, 10, 1720.0},
  {MODEL_REVOLUTE_CHAIN, 100, 31800.0},
  {MODEL_REVOLUTE_CHAIN, 1000, (double)NAN},
  {MODEL_REVOLUTE_CHAIN, 10000, (double)NAN},
};
enum { SPATIAL_COUNT = sizeof SPATIAL / sizeof SPATIAL[0] };

static void print_spatial_head(void)
{
  printf(
    "\nspatial scenes, ns of CPU time per acceleration. scaled: this time, scaled to a machine "
    "on which the\ndriven planar slider-crank takes %.0f ns. peers: time of the fastest other "
    "program on that machine.\napart: as above\n",
    1e9 * CRANK_OF_PEERS);
  printf("%-20s %6s %-11s %10s %8s %10s %8s %8s %6s %6s\n", "case", "n", "solver", "ns", "per body",
         "scaled", "per body", "peers", "rel", "apart");
}

static void print_spatial_row(const scene *at, const measured *m, double crank, double peer,
                              double reference)
{
  double scaled = m->whole * CRANK_OF_PEERS / crank;
  printf("%-20s %6d %-11s %10.0f %8.1f %10.0f %8.1f %8.0f %6.2f %6.0e\n", scene_name(at->kind),
         at->n, m->way->name, 1e9 * m->whole, 1e9 * m->whole / at->bodies, 1e9 * scaled,
         1e9 * scaled / at->bodies, peer, m->whole / reference, m->apart);
  (void)fflush(stdout);
}

/* Measures the solvers of a spatial scene. These measurements alternate with those of the planar
 * slider-crank `crank`. */
static bool bench_spatial_scene(int k, measured *crank, bool json)
{
  scene at;
  measured all[MOST_SOLVERS];
  if (!scene_make(scene_of_space(SPATIAL[k].which), SPATIAL[k].n, &at)) {
    (void)fprintf(stderr, "%s %d: %s\n", model_spatial_name(SPATIAL[k].which), SPATIAL[k].n,
                  baum_message());
    return false;
  }
  int count = create_all(&at, solver_in_space_at, all);
  crank->whole = (double)INFINITY;
  for (int round = 0; round < TIMING_ROUNDS; round++) {
    time_whole(crank);
    for (int i = 0; i < count; i++) {
      time_whole(&all[i]);
    }
  }
  compare_solutions(&at, all, count);
  for (int i = 0; i < count; i++) {
    if (json) {
      print_json(&at, all[i].way->name, all[i].whole);
    } else {
      print_spatial_row(&at, &all[i], crank->whole, SPATIAL[k].peer, all[0].whole);
    }
  }
  bool fine = finish_all(all, count);
  scene_clear(&at);
  return fine;
}

static bool bench_spatial(const arguments *given)
{
  scene planar;
  measured crank = {.way = &solver_automatic};
  bool fine = scene_make(SCENE_SLIDER_CRANK, 1, &planar);
  crank.self = fine ? crank.way->create(&planar) : NULL;
  fine = fine && crank.self;
  bool begun = given->json;
  for (int k = 0; k < SPATIAL_COUNT && crank.self; k++) {
    if (is_wanted(given, scene_of_space(SPATIAL[k].which), SPATIAL[k].n)) {
      if (!begun) {
        print_spatial_head();
        begun = true;
      }
      fine = bench_spatial_scene(k, &crank, given->json) && fine;
    }
  }
  crank.way->destroy(crank.self);
  scene_clear(&planar);
  return fine;
}

/* ---- steps of a run ---- */

static bool step_once(void *self, int part)
{
  (void)part;
  return baum_simulation_step(self, 16) == BAUM_OK;
}

/* Takes steps of 1e-9 s, so that the configuration hardly changes. The gains are not computed from
 * this step. If they were, they would be about 1e9 1/s, which would amplify the rounding errors of
 * Phi, and refinement would take longer. */
static bool bench_steps_of(scene_kind kind, int n)
{
  scene at;
  baum_simulation *run = NULL;
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_semi_implicit_euler();
  options.step = 1e-9;
  options.gains = baum_gains_fixed(100.0, 100.0);
  options.max_steps = INT64_MAX;
  bool fine = scene_make(kind, n, &at);
  if (fine) {
    fine = baum_simulation_create(at.m.mechanism, &options, &run) >= BAUM_OK;
  }
  double step = fine ? timing_best(step_once, run, 0) / 16 : (double)NAN;
  if (fine) {
    printf("%-12s %6d %12.0f %12.0f %9.1f\n", scene_name(kind), n, 1.0 / step, 1e9 * step,
           1e9 * step / at.bodies);
    (void)fflush(stdout);
  } else {
    (void)fprintf(stderr, "%s %d: %s\n", scene_name(kind), n, baum_message());
  }
  baum_simulation_destroy(run);
  scene_clear(&at);
  return fine && step > 0.0;
}

static bool bench_steps(const arguments *given)
{
  bool fine = true;
  printf("\nsemi-implicit Euler with Baumgarte's gains, time of a whole step\n");
  printf("%-12s %6s %12s %12s %9s\n", "case", "n", "steps/s", "ns", "per body");
  for (int k = 0; k < CASE_COUNT; k++) {
    if (is_wanted(given, CASES[k].kind, CASES[k].n) && CASES[k].n <= LARGEST_STEPPED) {
      fine = bench_steps_of(CASES[k].kind, CASES[k].n) && fine;
    }
  }
  return fine;
}

/* ---- fixed bodies ---- */

/* Returns the time of a step [s] of a mechanism with fixed bodies. If `all` is set, the equations
 * include the fixed bodies and their joints. */
static double time_mounted(int frames, bool all)
{
  model m;
  baum_simulation *run = NULL;
  double step = (double)NAN;
  const model_slider_crank crank = {.driven = true, .angle = 1.0, .moving = true, .frames = frames};
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_semi_implicit_euler();
  options.step = 1e-9;
  options.max_steps = INT64_MAX;
  if (model_slider_crank_build(crank, &m) != BAUM_OK) {
    return step;
  }
  if (baum_simulation_create(m.mechanism, &options, &run) >= BAUM_OK) {
    baum_workspace *w = run->workspace;
    if (all && w->motion != w->path) {
      baum_i_block_path_destroy(w->motion);
      w->motion = w->path;
    }
    step = timing_best(step_once, run, 0) / 16;
  }
  baum_simulation_destroy(run);
  model_destroy(&m);
  return step;
}

static bool bench_fixed_bodies(void)
{
  bool fine = true;
  printf("\nslider-crank on welded frames, ns per step of semi-implicit Euler\n%6s %10s %10s %6s\n",
         "frames", "omitted", "solved", "ratio");
  for (int frames = 0; frames <= 10; frames += 5) {
    double without = time_mounted(frames, false);
    double with = time_mounted(frames, true);
    printf("%6d %10.0f %10.0f %6.2f\n", frames, 1e9 * without, 1e9 * with, with / without);
    fine = fine && with > 0.0 && without > 0.0;
  }
  return fine;
}

/* ---- redundant rows ---- */

/* Returns the time of an evaluation [s] with the library's block solver. */
static double time_library(scene_kind kind)
{
  scene at;
  double best = (double)NAN;
  if (scene_make(kind, 1, &at)) {
    void *self = solver_block.create(&at);
    best = self ? timing_best(solver_block.run, self, PHASE_WHOLE) : best;
    solver_block.destroy(self);
    scene_clear(&at);
  }
  return best;
}

static bool bench_redundancy(void)
{
  static const struct {
    scene_kind with;
    scene_kind without;
  } pairs[] = {
    {SCENE_TWO_GUIDES, SCENE_ONE_GUIDE},
    {SCENE_THREE_CRANKS, SCENE_THIRD_BY_A_ROD},
    /* 4 bodies with the redundant row, and 3 bodies without it. */
    {SCENE_THREE_CRANKS, SCENE_TWO_CRANKS},
  };
  bool fine = true;
  printf("\nredundant rows, ns per evaluation\n%-26s %8s   %-26s %8s %6s\n", "with", "", "without",
         "", "ratio");
  for (size_t k = 0; k < sizeof pairs / sizeof pairs[0]; k++) {
    double with = time_library(pairs[k].with);
    double without = time_library(pairs[k].without);
    printf("%-26s %8.0f   %-26s %8.0f %6.2f\n", scene_name(pairs[k].with), 1e9 * with,
           scene_name(pairs[k].without), 1e9 * without, with / without);
    fine = fine && with > 0.0 && without > 0.0;
  }
  return fine;
}

/* ---- variants ---- */

static bool make_one_variant(void *self, int part)
{
  (void)part;
  return variant_make(self, 0.1, NULL) == BAUM_OK;
}

static bool make_and_evaluate(void *self, int part)
{
  (void)part;
  variant_result out;
  return variant_make(self, 0.1, &out) == BAUM_OK;
}

static bool bench_variants(void)
{
  variant_plan plan;
  if (variant_plan_make(&plan) != BAUM_OK) {
    return false;
  }
  double made = timing_best(make_one_variant, &plan, 0);
  double evaluated = timing_best(make_and_evaluate, &plan, 0);
  printf("\nvariants of the slider-crank, us each\n");
  printf("copy, set, freeze, destroy                 %8.2f\n", 1e6 * made);
  printf("the same with a workspace and one solution %8.2f\n", 1e6 * evaluated);
  variant_plan_clear(&plan);
  return made > 0.0 && evaluated > 0.0;
}

/* ---- program ---- */

static void print_machine(void)
{
  printf("%s. CPU time of one thread: the 10th percentile of %d windows of at least 0.25 ms, the "
         "smallest of %d rounds\n",
         baum_version(), TIMING_WINDOWS, TIMING_ROUNDS);
  printf("%12s %12s %12s\n", "memory", "read GB/s", "update GB/s");
  for (long kib = 16; kib <= 65536; kib *= 8) {
    timing_bandwidth found = timing_measure_bandwidth(1024 * kib);
    printf("%8ld KiB %12.1f %12.1f\n", kib, 1e-9 * found.read, 1e-9 * found.update);
  }
}

static bool parse(int count, char **words, arguments *out)
{
  *out = (arguments){.largest = 100000};
  for (int k = 1; k < count; k++) {
    if (strcmp(words[k], "--json") == 0) {
      out->json = true;
    } else if (strcmp(words[k], "--case") == 0 && k + 1 < count) {
      out->only = words[++k];
    } else if (strcmp(words[k], "--largest") == 0 && k + 1 < count) {
      out->largest = (int)strtol(words[++k], NULL, 10);
    } else {
      return false;
    }
  }
  return true;
}

int main(int count, char **words)
{
  arguments given;
  if (!parse(count, words, &given)) {
    (void)fprintf(stderr, "usage: bench_eval [--json] [--case NAME] [--largest N]\n");
    return 2;
  }
  if (given.json) {
    bool solved = bench_solvers(&given);
    return bench_spatial(&given) && solved ? 0 : 1;
  }
  print_machine();
  bool fine = bench_solvers(&given);
  fine = bench_spatial(&given) && fine;
  fine = bench_steps(&given) && fine;
  if (!given.only) {
    fine = bench_fixed_bodies() && fine;
    fine = bench_redundancy() && fine;
    fine = bench_variants() && fine;
  }
  return fine ? 0 : 1;
}
