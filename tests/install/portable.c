/* SPDX-License-Identifier: BSD-3-Clause */
/* This program runs on every system for which packages are built. It compares every integrator with
 * stored results. It also tests a mechanism with redundant rows, a study with two threads whose
 * files have names beyond ASCII, and messages in a locale with a decimal comma.
 *
 * usage: portable FOLDER
 *
 * The program prints results with all digits, for comparison between systems. */
#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include <baum/baum.h>
#include <baum/catalog.h>

static const double END = 0.05; /* [s] 1.2 revolutions of the crank */

static int failures;

static void check(bool holds, const char *what, const char *message)
{
  if (!holds) {
    printf("FAILED %s: %s\n", what, message ? message : "");
    failures++;
  }
}

/* The position x of the slider at END, as computed on Linux x86-64. On other systems and with other
 * compilers, it may differ by rounding errors. With CVODE and IDA it may differ by their tolerance,
 * because their steps depend on the last digits. */
static const struct stored {
  const char *integrator;
  double x;         /* [m] */
  double tolerance; /* [m] */
} STORED[] = {
  {"euler", 0.28261841312534269, 1e-10},      {"semi_implicit_euler", 0.28021422186397166, 1e-10},
  {"rk2", 0.28021053571647275, 1e-10},        {"rk3", 0.28021120388747356, 1e-10},
  {"rk4", 0.28021120397654886, 1e-10},        {"dp5", 0.28021120569970526, 1e-10},
  {"rk8", 0.28021120281574008, 1e-10},        {"ab2", 0.28020349002277495, 1e-10},
  {"ab3", 0.28021117432043174, 1e-10},        {"ab4", 0.28021120523019571, 1e-10},
  {"rattle", 0.28021174216754824, 1e-10},     {"generalized_alpha", 0.28021285475492952, 1e-10},
  {"cvode_adams", 0.28021117280363361, 1e-7}, {"cvode_bdf", 0.28021115667892199, 1e-7},
  {"ida", 0.28021124428887378, 1e-7},         {"kinematics", 0.34439603227358118, 1e-10},
};

enum { SLIDER = 6 };

static baum_mechanism *build(const char *name)
{
  const baum_catalog_choice choice = {.name = name};
  baum_mechanism *mechanism = NULL;
  check(baum_catalog_build(&choice, &mechanism) == BAUM_OK, name, baum_message());
  return mechanism;
}

/* Returns coordinate k at time t. If the run fails, returns NaN. */
static double advance(const char *name, const baum_integrator *integrator, double t, int k)
{
  baum_mechanism *mechanism = build(name);
  baum_simulation *run = NULL;
  baum_simulation_options o = baum_simulation_options_default();
  double value = (double)NAN;
  o.integrator = integrator;
  if (baum_integrator_has_variable_step(integrator)) {
    o.rtol = 1e-8;
  } else if (baum_integrator_has_fixed_step(integrator)) {
    o.step = 1e-5;
  }
  check(baum_simulation_create(mechanism, &o, &run) == BAUM_OK, name, baum_message());
  if (run) {
    baum_status status = baum_simulation_advance_to(run, t);
    check(status >= BAUM_OK, baum_integrator_name(integrator), baum_simulation_message(run));
    value = baum_simulation_q(run)[k];
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return value;
}

static void run_every_integrator(void)
{
  const int known = (int)(sizeof STORED / sizeof STORED[0]);
  int count = 0;
  for (const baum_integrator *method; (method = baum_integrator_at(count)) != NULL; count++) {
    const char *name = baum_integrator_name(method);
    bool driven = method == baum_kinematics();
    double x = advance(driven ? "slider_crank_driven" : "slider_crank", method, END, SLIDER);
    printf("%s %.17g\n", name, x);
    check(count < known && strcmp(STORED[count].integrator, name) == 0, name, "is not stored");
    check(count < known && fabs(x - STORED[count].x) <= STORED[count].tolerance, name, "differs");
  }
  check(count == known, "integrators", "are missing");
}

static void run_redundant(void)
{
  const double stored = 0.48407693571736832;
  double x = advance("bricard", baum_rk8(), 0.5, 0);
  printf("bricard %.17g\n", x);
  check(fabs(x - stored) <= 1e-7, "bricard", "differs");
}

static void path_in(char *path, size_t size, const char *folder, const char *name)
{
  (void)snprintf(path, size, "%s/%s", folder, name);
}

/* Writes a report, and checks that the file contains its title. */
static void write_report(const baum_study *study, const char *path, const char *title)
{
  check(baum_study_write(study, BAUM_REPORT_TEXT, title, path) == BAUM_OK, path, baum_message());
#ifndef _WIN32 /* fopen() on Windows does not accept UTF-8 */
  char text[64] = "";
  FILE *file = fopen(path, "r");
  size_t size = file ? fread(text, 1, sizeof text - 1, file) : 0;
  check(size > 0 && strstr(text, title) != NULL, path, "has another title");
  if (file) {
    (void)fclose(file);
  }
#endif
}

static void run_study(const char *folder)
{
  char file[512];
  char report[512];
  path_in(file, sizeof file, folder,
          "gr\xc3\xb6\xc3\x9f"
          "e.study");
  path_in(report, sizeof report, folder,
          "gr\xc3\xb6\xc3\x9f"
          "e.txt");
  baum_mechanism *mechanism = build("slider_crank");
  baum_study *study = NULL;
  baum_study_options options = baum_study_options_default();
  options.threads = 2;
  options.repeats = 1;
  options.file = file;
  check(baum_study_create(mechanism, 0.0, 0.02, &study) == BAUM_OK, "study", baum_message());
  check(baum_study_set_options(study, &options) == BAUM_OK, "options", baum_message());
  for (int k = 1; k <= 4; k++) {
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_rk4();
    o.step = 1e-4 / k;
    check(baum_study_add(study, &o) == BAUM_OK, "add", baum_message());
  }
  baum_status status = baum_study_run(study);
  check(status >= BAUM_OK, "study", baum_message());
  for (int k = 0; k < baum_study_entry_count(study); k++) {
    baum_study_entry entry;
    check(baum_study_entry_at(study, k, &entry, sizeof entry) == BAUM_OK, "entry", baum_message());
    check(entry.state == BAUM_STUDY_DONE, "entry", "is not done");
  }
  write_report(study, report, "first");
  write_report(study, report, "second"); /* replaces the file */
  baum_study_destroy(study);
  baum_mechanism_destroy(mechanism);
}

static void fail_in_german(void)
{
  const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "German_Germany.1252", "de-DE"};
  bool has_comma = false;
  for (int k = 0; k < 4 && !has_comma; k++) {
    has_comma = setlocale(LC_ALL, names[k]) && localeconv()->decimal_point[0] == ',';
  }
  printf("# decimal comma: %s\n", has_comma ? "yes" : "no such locale here");
  (void)advance("pendulum", baum_rk4(), 0.25, 0);
  baum_simulation_options o = baum_simulation_options_default();
  baum_mechanism *mechanism = build("pendulum");
  baum_simulation *run = NULL;
  o.integrator = baum_rk4();
  o.step = -0.5;
  check(baum_simulation_create(mechanism, &o, &run) == BAUM_ERR_ARGUMENT, "step", "is accepted");
  check(strstr(baum_message(), "-0.5") != NULL, "locale", baum_message());
  baum_mechanism_destroy(mechanism);
  (void)setlocale(LC_ALL, "C");
}

int main(int count, char **words)
{
  if (count != 2) {
    printf("usage: portable FOLDER\n");
    return 2;
  }
  run_every_integrator();
  run_redundant();
  run_study(words[1]);
  fail_in_german();
  printf("# %d failures\n", failures);
  return failures == 0 ? 0 : 1;
}
