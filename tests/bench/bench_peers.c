/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the computing time that this library and other software need for a given error.
 *
 * usage: bench_peers [PROBLEM]
 *
 * PROBLEM is the name of a mechanism of the catalogue. By default, all problems are run.
 *
 * A study runs rk8, dp5 and rk4 with every formulation, and with many steps and tolerances. For
 * each given error, the table shows the smallest CPU time of a run that has at most this error. The
 * CPU time is measured from the creation of a run to its end.
 *
 * For planar problems, the errors include all positions, at 50 samples. bench_work_precision
 * compares only one angle of the N-four-bar, at ten times, and has more settings. Its cheapest runs
 * therefore cost less. Runs of baum locate and report each flat configuration that they pass
 * through. For N = 1 and an error of 1e-4, this takes a fifth of their time. The other programs do
 * not do this. They are Exudyn 1.13.6, MuJoCo 4.0.0, Pinocchio 4.1.0 with RK4, DOP853 and CVODE
 * with compiled right-hand sides, and a hand-written RK4.
 *
 * For spatial problems, the errors include all positions at the end, compared with the references
 * of the catalogue. For all programs, a run is considered to reach a given error if its error is at
 * most 10 % larger. The other programs are Pinocchio with RK4 and Baumgarte stabilization, MuJoCo
 * with RK4, and Exudyn with generalized-alpha.
 *
 * The times of other programs were measured for this table on similar machines. They are the times
 * of whole runs, and the table shows the cheapest of them. There is no command that repeats these
 * measurements. Only ratios of 2 or more are significant.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <baum/baum.h>
#include <baum/catalog.h>

enum { TARGETS = 4, SAMPLES = 50 };
static const double PLANAR[TARGETS] = {1e-4, 1e-6, 1e-8, 1e-10};
static const double SPATIAL[TARGETS] = {1.1e-3, 1.1e-6, 1.1e-8, 1.1e-10};

/* [s] Time limit of a run. The cheapest runs, which the table shows, take much less time. */
static const double LONGEST = 0.2;

typedef struct peer {
  const char *entry;
  const char *what;
  /* One parameter whose value differs from its default, if there is one. */
  baum_catalog_setting setting;
  double span;          /* [s] */
  const double *target; /* (TARGETS) errors */
  /* [ms] of the cheapest other program; NaN if none reached the error. */
  double ms[TARGETS];
} peer;

static const peer PEERS[] = {
  {"slider_crank",
   "slider-crank from 10 rad/s, 2 s (other programs: other lengths, masses and speed)",
   {"speed", 10.0},
   2.0,
   PLANAR,
   {7.7, 7.7, 39, 58}},
  {"n_four_bar", "N-four-bar, N = 1, 10 s", {"windows", 1.0}, 10.0, PLANAR, {7, 7, 90, 90}},
  {"n_four_bar",
   "N-four-bar, N = 10, 10 s",
   {"windows", 10.0},
   10.0,
   PLANAR,
   {107, 107, 1580, 1700}},
  {"n_four_bar",
   "N-four-bar, N = 40, 10 s",
   {"windows", 40.0},
   10.0,
   PLANAR,
   {620, 1190, (double)NAN, (double)NAN}},
  {"andrews_bodies", "Andrews' mechanism, 0.03 s", {NULL, 0.0}, 0.03, PLANAR, {11, 22, 22, 37}},
  {"spatial_slider_crank",
   "spatial slider-crank, 5 s",
   {NULL, 0.0},
   5.0,
   SPATIAL,
   {9.2, 84, 213, (double)NAN}},
  {"bricard", "Bricard's mechanism, 5 s", {NULL, 0.0}, 5.0, SPATIAL, {7.9, 7.9, 39, 136}},
  {"flyball", "flyball governor, soft springs, 5 s", {NULL, 0.0}, 5.0, SPATIAL, {4.2, 8.3, 21, 84}},
};
enum { PEER_COUNT = sizeof PEERS / sizeof PEERS[0] };

/* Gives the study the positions at the end of the span. The catalogue stores these positions. */
static baum_status give_end(baum_study *study, const baum_mechanism *mechanism,
                            const baum_catalog_choice *choice, double end, double digits)
{
  int32_t nq = 0;
  baum_status status = baum_mechanism_sizes(mechanism, &nq, NULL, NULL);
  double *q = calloc((size_t)nq + 1, sizeof *q);
  if (status == BAUM_OK) {
    status = q ? baum_catalog_reference(choice, end, q, NULL) : BAUM_ERR_MEMORY;
  }
  if (status == BAUM_OK) {
    status = baum_study_set_reference(study, &end, 1, q, NULL, NULL, digits);
  }
  free(q);
  return status;
}

/* Gives a reference of the catalogue to the study. For spatial problems, the reference consists of
 * the positions at the end. For planar problems, it is the exact solution. If there is no exact
 * solution, the study computes a reference. */
static baum_status give_reference(baum_study *study, const baum_mechanism *mechanism,
                                  baum_catalog_choice *choice, const peer *at)
{
  baum_catalog_entry entry;
  baum_status status = baum_catalog_find(choice->name, &entry, sizeof entry);
  if (status == BAUM_OK && at->target == SPATIAL) {
    return give_end(study, mechanism, choice, at->span, entry.digits_q);
  }
  return status == BAUM_OK && entry.exact
           ? baum_study_set_solution(study, baum_catalog_solution, choice, entry.digits_q)
           : status;
}

static baum_status add_settings(baum_study *study)
{
  const baum_integrator *const methods[] = {baum_rk8(), baum_dp5(), baum_rk4()};
  baum_study_options options = baum_study_options_default();
  options.samples = SAMPLES;
  options.entry_limit = LONGEST;
  options.energy_account = false;
  baum_status status = baum_study_set_options(study, &options);
  for (size_t k = 0; k < sizeof methods / sizeof methods[0] && status == BAUM_OK; k++) {
    baum_study_grid grid = baum_study_grid_default();
    grid.integrator = methods[k];
    grid.settings = 12;
    grid.constants = 0;
    status = baum_study_add_standard(study, &grid);
  }
  return status;
}

/* Returns the cost of the cheapest entry with at most this error, and its name. If there is no such
 * entry, the cost is NaN and the name is "". */
static double cheapest(const baum_study *study, double error, const char **name)
{
  double best = (double)NAN;
  *name = "";
  for (int32_t k = 0; k < baum_study_entry_count(study); k++) {
    baum_study_entry entry;
    (void)baum_study_entry_at(study, k, &entry, sizeof entry);
    if (entry.state == BAUM_STUDY_DONE && entry.error <= error && !(best <= entry.cpu)) {
      best = entry.cpu;
      *name = entry.name;
    }
  }
  return best;
}

static void print(const baum_study *study, const peer *at)
{
  for (int k = 0; k < TARGETS; k++) {
    const char *name;
    double ms = 1e3 * cheapest(study, at->target[k], &name);
    printf("  %5.0e %10.3f %10.4g %8.1f   %s\n", at->target[k], ms, at->ms[k], at->ms[k] / ms,
           name);
  }
  (void)fflush(stdout);
}

static baum_status compare(const peer *at)
{
  baum_catalog_choice choice = {at->entry, &at->setting, at->setting.name != NULL};
  baum_mechanism *mechanism = NULL;
  baum_study *study = NULL;
  baum_status status = baum_catalog_build(&choice, &mechanism);
  if (status == BAUM_OK) {
    status = baum_study_create(mechanism, 0.0, at->span, &study);
  }
  if (status == BAUM_OK) {
    status = give_reference(study, mechanism, &choice, at);
  }
  if (status == BAUM_OK) {
    status = add_settings(study);
  }
  if (status == BAUM_OK) {
    status = baum_study_run(study);
  }
  if (status >= BAUM_OK) {
    printf("%s\n  %5s %10s %10s %8s   %s\n", at->what, "error", "ms", "others", "ratio", "by");
    print(study, at);
  } else {
    (void)fprintf(stderr, "%s: %s\n", at->what, baum_message());
  }
  baum_study_destroy(study);
  baum_mechanism_destroy(mechanism);
  return status;
}

int main(int count, char **words)
{
  bool fine = true;
  for (int k = 0; k < PEER_COUNT; k++) {
    if (count < 2 || strcmp(words[1], PEERS[k].entry) == 0) {
      fine = compare(&PEERS[k]) >= BAUM_OK && fine;
    }
  }
  return fine ? 0 : 1;
}
