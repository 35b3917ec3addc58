/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests whether tolerances mean the same in space as in the plane. For every variable-step
 * integrator with each formulation, the program prints medians of error / rtol at rtol 1e-4, 1e-6
 * and 1e-8. Each line contains
 *
 *   the median for planar and for spatial mechanisms of the catalogue, and spatial / planar
 *   the median for planar mechanisms that consist of bodies ("bodies"), the median for the same
 *   mechanisms built of spatial elements in a tilted plane ("tilted"), and tilted / bodies
 *
 * usage: bench_space [INTEGRATOR [--list]]
 *
 * All mechanisms have a smooth reference and at least one degree of freedom. The error is the
 * largest one of all positions and samples. Lengths are relative to the characteristic length, and
 * angles are in radians. With --list, the program prints every run. The program fails if both
 * ratios of a line are above MOST. If only one ratio is above MOST, this is accepted, because the
 * motions of planar and spatial mechanisms differ in length and in the growth of errors.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <baum/baum.h>
#include <baum/catalog.h>

#include "tilt.h"

static const double MOST = 3.0;
enum { RUNGS = 3, ENTRIES = 64 };
static const double RTOL[RUNGS] = {1e-4, 1e-6, 1e-8};

typedef struct known {
  baum_catalog_entry entry;
  baum_mechanism *mechanism;
  baum_mechanism *tilted; /* the same mechanism in a tilted plane, or NULL */
  int32_t nq;
  bool spatial;
  bool used;
} known;

typedef struct list {
  double value[ENTRIES * RUNGS];
  int count;
} list;

static known know(int32_t k)
{
  known out = {.used = false};
  baum_mobility mobility = {.degrees_of_freedom = 0};
  int32_t nv = 0;
  if (baum_catalog_entry_at(k, &out.entry, sizeof out.entry) == BAUM_OK &&
      out.entry.sample_count > 0 && out.entry.smooth) {
    const baum_catalog_choice choice = {.name = out.entry.name};
    (void)baum_catalog_build(&choice, &out.mechanism);
    (void)baum_mechanism_sizes(out.mechanism, &out.nq, &nv, NULL);
    (void)baum_mechanism_mobility(out.mechanism, &mobility, sizeof mobility);
  }
  out.spatial = out.nq != nv;
  out.used = mobility.degrees_of_freedom > 0;
  if (out.used && !out.spatial && model_tilt(out.mechanism, 0.0, &out.tilted) == BAUM_OK) {
    (void)baum_mechanism_sizes(out.tilted, &nv, NULL, NULL);
    if (3 * nv != 7 * out.nq) { /* the planar mechanism has particles or user coordinates */
      baum_mechanism_destroy(out.tilted);
      out.tilted = NULL;
    }
  }
  return out;
}

/* Converts samples of the tilted mechanism to planar coordinates. Adds whole revolutions to the
 * angles, so that they are close to those of the reference. */
static void untilt(const known *of, const double *times, const double *tilted, double *q)
{
  const baum_catalog_choice choice = {.name = of->entry.name};
  int bodies = of->nq / 3;
  for (int i = 0; i < of->entry.sample_count; i++) {
    double *row = q + (ptrdiff_t)i * of->nq;
    (void)baum_catalog_reference(&choice, times[i], row, NULL);
    for (int k = 0; k < bodies; k++) {
      double pose[3];
      double off[2];
      double angle = row[3 * k + 2];
      model_untilt_body(tilted + (ptrdiff_t)7 * (i * bodies + k), pose, off);
      memcpy(row + (ptrdiff_t)3 * k, pose, sizeof pose);
      row[3 * k + 2] = angle + remainder(pose[2] - angle, 2.0 * acos(-1.0));
    }
  }
}

/* Returns the error of a run. If the run did not reach its end, returns infinity. */
static double error_of(const known *of, bool tilted, const baum_simulation_options *o)
{
  const baum_catalog_choice choice = {.name = of->entry.name};
  const baum_channel positions = baum_channel_of(BAUM_Q);
  size_t n = (size_t)of->entry.sample_count;
  double *times = calloc(n, sizeof *times);
  double *q = calloc(n * (size_t)of->nq, sizeof *q);
  double *rows = calloc(3 * n * (size_t)of->nq, sizeof *rows);
  baum_simulation *run = NULL;
  baum_catalog_error error = {.q = (double)INFINITY};
  if (times && q && rows && baum_catalog_times(choice.name, times) == BAUM_OK &&
      baum_simulation_create(tilted ? of->tilted : of->mechanism, o, &run) >= BAUM_OK &&
      baum_simulation_sample(run, times, (int64_t)n, &positions, 1, tilted ? rows : q, NULL) >=
        BAUM_OK) {
    if (tilted) {
      untilt(of, times, rows, q);
    }
    (void)baum_catalog_compare(&choice, of->mechanism, times, (int64_t)n, q, NULL, &error,
                               sizeof error);
  }
  baum_simulation_destroy(run);
  free(times);
  free(q);
  free(rows);
  return error.q;
}

static int rising(const void *a, const void *b)
{
  double x = *(const double *)a;
  double y = *(const double *)b;
  return (x > y) - (x < y);
}

static double median(list *of)
{
  qsort(of->value, (size_t)of->count, sizeof *of->value, rising);
  int half = of->count / 2;
  return of->count == 0       ? (double)NAN
         : of->count % 2 == 1 ? of->value[half]
                              : 0.5 * (of->value[half - 1] + of->value[half]);
}

enum { PLANAR, SPATIAL, FLAT, TILTED, LISTS };

static void add(list *to, double value)
{
  to->value[to->count++] = value;
}

static void run_all(const known *of, baum_simulation_options o, bool print, list lists[LISTS])
{
  for (int r = 0; r < RUNGS; r++) {
    o.rtol = RTOL[r];
    double error = error_of(of, false, &o) / o.rtol;
    double tilted = of->tilted ? error_of(of, true, &o) / o.rtol : (double)NAN;
    add(&lists[of->spatial ? SPATIAL : PLANAR], error);
    if (of->tilted) {
      add(&lists[FLAT], error);
      add(&lists[TILTED], tilted);
    }
    if (print) {
      printf("  %-24s rtol %.0e: error / rtol %9.3g, tilted %9.3g\n", of->entry.name, o.rtol, error,
             tilted);
    }
  }
}

static bool compare(const known *entries, int count, const baum_integrator *integrator,
                    baum_formulation formulation, bool print)
{
  list lists[LISTS] = {{.count = 0}};
  double m[LISTS];
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.formulation = formulation;
  for (int k = 0; k < count; k++) {
    if (entries[k].used) {
      run_all(&entries[k], o, print, lists);
    }
  }
  for (int k = 0; k < LISTS; k++) {
    m[k] = median(&lists[k]);
  }
  double ratio = m[SPATIAL] / m[PLANAR];
  double twins = m[TILTED] / m[FLAT];
  printf("| %-11s | %-12s | %8.3g | %8.3g | %6.2f | %8.3g | %8.3g | %6.2f |\n",
         baum_integrator_name(integrator), baum_formulation_name(formulation), m[PLANAR],
         m[SPATIAL], ratio, m[FLAT], m[TILTED], twins);
  (void)fflush(stdout);
  return fmin(ratio, twins) <= MOST;
}

static bool compare_formulations(const known *entries, int count, const baum_integrator *integrator,
                                 bool print)
{
  bool fine = true;
  for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
    if (baum_integrator_offers(integrator, (baum_formulation)f)) {
      fine = compare(entries, count, integrator, (baum_formulation)f, print) && fine;
    }
  }
  return fine;
}

int main(int argc, char **argv)
{
  static known entries[ENTRIES];
  bool print = argc > 2 && strcmp(argv[2], "--list") == 0;
  bool fine = true;
  int count = baum_catalog_count() < ENTRIES ? baum_catalog_count() : ENTRIES;
  for (int k = 0; k < count; k++) {
    entries[k] = know(k);
  }
  printf(
    "| integrator  | formulation  | planar   | spatial  | ratio  | bodies   | tilted   | ratio  |\n"
    "|---|---|---|---|---|---|---|---|\n");
  for (int i = 0; baum_integrator_at(i); i++) {
    const baum_integrator *one = baum_integrator_at(i);
    bool wanted = argc < 2 || strcmp(baum_integrator_name(one), argv[1]) == 0;
    if (wanted && baum_integrator_has_variable_step(one) && one != baum_kinematics()) {
      fine = compare_formulations(entries, count, one, print) && fine;
    }
  }
  for (int k = 0; k < count; k++) {
    baum_mechanism_destroy(entries[k].mechanism);
    baum_mechanism_destroy(entries[k].tilted);
  }
  return fine ? EXIT_SUCCESS : EXIT_FAILURE;
}
