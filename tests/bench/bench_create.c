/* SPDX-License-Identifier: BSD-3-Clause */
/* Measures the time that the creation of a run takes, and the time of whole short runs.
 *
 * usage: bench_create                        prints a table
 *        bench_create SCENE METHOD COUNT     creates and destroys COUNT runs, for callgrind
 *        bench_create SCENE METHOD COUNT run also advances each run to the end of the scene
 *
 * The first column of the table is the time of baum_simulation_create() and
 * baum_simulation_destroy(). The second column is the same time for a run that is also advanced to
 * the end of the scene. The last columns are the steps, rejected steps and evaluations of this run.
 * parts/timing.h defines how times are measured.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <baum/baum.h>
#include <baum/catalog.h>

#include "timing.h"

static const struct {
  const char *name;
  const char *entry;
  baum_catalog_setting setting; /* one parameter whose value differs from its default, if any */
  double end;                   /* [s] end time of the short run */
  double step;                  /* [s] step of the fixed-step methods */
} SCENES[] = {
  {"slider_crank", "slider_crank", {"speed", 10.0}, 2.0, 1e-2},
  {"andrews", "andrews_bodies", {NULL, 0.0}, 0.01, 1e-4},
  {"n_four_bar_10", "n_four_bar", {"windows", 10.0}, 1.0, 1e-2},
  {"spatial_slider_crank", "spatial_slider_crank", {NULL, 0.0}, 1.0, 1e-2},
};
enum { SCENE_COUNT = sizeof SCENES / sizeof SCENES[0] };

static const double RTOL = 1e-5;

static const struct {
  const char *name;
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  bool fixed_step;
} METHODS[] = {
  {"semi_implicit_euler", baum_semi_implicit_euler, BAUM_FORMULATION_DEFAULT, true},
  {"rk4", baum_rk4, BAUM_FORMULATION_DEFAULT, true},
  {"rk4_projection", baum_rk4, BAUM_FORMULATION_PROJECTION, true},
  {"rk8", baum_rk8, BAUM_FORMULATION_DEFAULT, false},
  {"rk8_baumgarte", baum_rk8, BAUM_FORMULATION_BAUMGARTE, false},
  {"dp5", baum_dp5, BAUM_FORMULATION_DEFAULT, false},
  {"generalized_alpha", baum_generalized_alpha, BAUM_FORMULATION_DEFAULT, true},
  {"cvode_bdf", baum_cvode_bdf, BAUM_FORMULATION_DEFAULT, false},
  {"ida", baum_ida, BAUM_FORMULATION_DEFAULT, false},
};
enum { METHOD_COUNT = sizeof METHODS / sizeof METHODS[0] };

typedef struct job {
  baum_mechanism *mechanism;
  baum_simulation_options options;
  double end; /* [s] */
  baum_counters counters;
} job;

/* Creates and destroys a run. If `part` is 1, also advances the run to its end. */
static bool create(void *self, int part)
{
  job *j = self;
  baum_simulation *run = NULL;
  baum_status status = baum_simulation_create(j->mechanism, &j->options, &run);
  if (status >= BAUM_OK && part == 1) {
    status = baum_simulation_advance_to(run, j->end);
    (void)baum_simulation_counters(run, &j->counters, sizeof j->counters);
  }
  baum_simulation_destroy(run);
  return status >= BAUM_OK;
}

static bool prepare(int scene, int method, job *out)
{
  const baum_catalog_setting *setting = &SCENES[scene].setting;
  const baum_catalog_choice choice = {SCENES[scene].entry, setting, setting->name != NULL};
  *out = (job){.options = baum_simulation_options_default(), .end = SCENES[scene].end};
  out->options.integrator = METHODS[method].integrator();
  out->options.formulation = METHODS[method].formulation;
  if (METHODS[method].fixed_step) {
    out->options.step = SCENES[scene].step;
  } else {
    out->options.rtol = RTOL;
  }
  return baum_catalog_build(&choice, &out->mechanism) == BAUM_OK;
}

static bool print(int scene, int method)
{
  job j;
  bool fine = prepare(scene, method, &j);
  if (fine && create(&j, 1)) {
    double alone = timing_best(create, &j, 0);
    double whole = timing_best(create, &j, 1);
    printf("%-21s %-19s %9.1f %9.1f %7lld %7lld %7lld\n", SCENES[scene].name, METHODS[method].name,
           1e6 * alone, 1e6 * whole, (long long)j.counters.steps, (long long)j.counters.rejected,
           (long long)j.counters.evaluations);
  } else {
    printf("%-21s %-19s %s\n", SCENES[scene].name, METHODS[method].name, baum_message());
  }
  (void)fflush(stdout);
  baum_mechanism_destroy(j.mechanism);
  return fine;
}

static bool print_all(void)
{
  bool fine = true;
  printf("%-21s %-19s %9s %9s %7s %7s %7s\n", "scene", "method", "create us", "run us", "steps",
         "refused", "evals");
  for (int scene = 0; scene < SCENE_COUNT; scene++) {
    for (int method = 0; method < METHOD_COUNT; method++) {
      fine = print(scene, method) && fine;
    }
  }
  return fine;
}

static bool repeat(const char *scene, const char *method, long count, int part)
{
  int s = 0;
  int m = 0;
  job j;
  while (s < SCENE_COUNT && strcmp(SCENES[s].name, scene) != 0) {
    s++;
  }
  while (m < METHOD_COUNT && strcmp(METHODS[m].name, method) != 0) {
    m++;
  }
  bool fine = s < SCENE_COUNT && m < METHOD_COUNT && prepare(s, m, &j);
  for (long k = 0; k < count && fine; k++) {
    fine = create(&j, part);
  }
  if (!fine) {
    (void)fprintf(stderr, "%s %s: %s\n", scene, method, baum_message());
  }
  return fine;
}

int main(int count, char **words)
{
  bool fine =
    count > 3 ? repeat(words[1], words[2], strtol(words[3], NULL, 10), count > 4) : print_all();
  return fine ? EXIT_SUCCESS : EXIT_FAILURE;
}
