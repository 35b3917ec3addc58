/* SPDX-License-Identifier: BSD-3-Clause */
/* A study of accuracy and cost. The mechanism is the slider-crank without a driver, whose crank is
 * released at 150 rad/s. The study simulates it for 0.2 s with every integrator and every
 * formulation, and recommends settings. With the option --page FILE, the program writes all results
 * as a page for a browser. */
#include "slider_crank_reference.h"

static const char TITLE[] = "Undriven slider-crank, released at 150 rad/s";

/* Makes a study that takes only a few seconds: its grid has few settings, and the cost of each is
 * limited. */
static baum_study *make_study(const slider_crank *s)
{
  baum_study *study = NULL;
  CHECK(baum_study_create(s->mechanism, 0.0, reference_time(REFERENCE_SAMPLES - 1), &study));
  baum_study_options options = baum_study_options_default();
  options.repeats = 2;
  options.entry_limit = 0.06;
  CHECK(baum_study_set_options(study, &options));
  baum_study_grid grid = baum_study_grid_default();
  grid.settings = 6;
  grid.constants = 1;
  CHECK(baum_study_add_standard(study, &grid));
  return study;
}

enum { COLUMNS = 9, SHOWN = 6 };

static void tell_entry(const baum_study *study, int32_t k, int columns)
{
  baum_study_entry entry;
  baum_study_method method;
  CHECK(baum_study_entry_at(study, k, &entry, sizeof entry));
  CHECK(baum_study_method_at(study, entry.method, &method, sizeof method));
  example_text(entry.name);
  example_number(entry.error);
  example_number(entry.work);
  example_number(1e3 * entry.cpu);
  example_number(entry.max_phi);
  example_number(entry.energy_error);
  if (columns > SHOWN) {
    example_text(method.name);
    example_text(method.fixed_step ? "step" : "rtol");
    example_text(baum_study_state_name(entry.state));
  }
}

/* Prints the entries on the Pareto front, and writes all entries to the files. */
static void tell_entries(const baum_study *study)
{
  enum { MOST = 100 };
  static const example_column columns[COLUMNS] = {
    {"name", "setting", 's', 48},
    {"error", "error [-]", 'e', 1},
    {"work", "work [evaluations]", 'f', 0},
    {"cpu", "CPU [ms]", 'f', 2},
    {"max_phi", "max|Phi| [m]", 'e', 1},
    {"energy_error", "energy error [J]", 'e', 1},
    {"method", "method", 's', 40},
    {"by", "by", 's', 4},
    {"state", "state", 's', 9},
  };
  int32_t front[MOST];
  int32_t count = 0;
  CHECK(baum_study_front(study, BAUM_STUDY_WORK, MOST, front, &count));
  printf("the Pareto front: settings that no other setting beats in both work and error\n");
  example_table("front", columns, SHOWN, true);
  for (int k = 0; k < count && k < MOST; k++) {
    tell_entry(study, front[k], SHOWN);
  }
  example_table("entries", columns, COLUMNS, false);
  for (int k = 0; k < baum_study_entry_count(study); k++) {
    tell_entry(study, k, COLUMNS);
  }
}

/* Returns the error of a run with these options against a reference that was computed without this
 * library. */
static double error_of(const slider_crank *s, const baum_simulation_options *options)
{
  baum_simulation *run = NULL;
  double error = 0.0;
  CHECK(baum_simulation_create(s->mechanism, options, &run));
  for (int k = 0; k < REFERENCE_SAMPLES; k++) {
    CHECK(baum_simulation_advance_to(run, reference_time(k)));
    error = fmax(error, slider_crank_error(s, run, k));
  }
  baum_simulation_destroy(run);
  return error;
}

/* Prints the recommendations for some errors and simulates with them. */
static void recommend(const baum_study *study, const slider_crank *s)
{
  static const double wanted[] = {1e-2, 1e-4, 1e-6, 1e-8};
  char why[1024];
  double got[sizeof wanted / sizeof wanted[0]];
  printf("\n");
  for (size_t k = 0; k < sizeof wanted / sizeof wanted[0]; k++) {
    baum_simulation_options best = baum_simulation_options_default();
    CHECK(
      baum_study_recommend(study, wanted[k], BAUM_STUDY_WORK, &best, sizeof best, why, sizeof why));
    printf("for an error of %.0e take %s\n\n", wanted[k], why);
    got[k] = error_of(s, &best);
  }
  for (size_t k = 0; k < sizeof wanted / sizeof wanted[0]; k++) {
    char name[64];
    (void)snprintf(name, sizeof name, "error with the setting for %.0e", wanted[k]);
    example_expect(name, got[k], wanted[k]);
  }
}

int main(int argc, char **argv)
{
  example_begin(argc, argv, "tradeoff");
  slider_crank s = slider_crank_build(false);
  baum_study *study = make_study(&s);
  CHECK(baum_study_run(study));
  baum_study_reference reference;
  CHECK(baum_study_reference_read(study, &reference, sizeof reference));
  printf("tradeoff: %s, 0.2 s; %d settings of %d methods\nerror     %s\nreference %s\n\n", TITLE,
         (int)baum_study_entry_count(study), (int)baum_study_method_count(study),
         baum_study_error_text(study), reference.text);
  tell_entries(study);
  recommend(study, &s);
  example_expect("uncertainty of the reference", reference.uncertainty, 1e-9);
  if (example.page) {
    CHECK(baum_study_write(study, BAUM_REPORT_PAGE, TITLE, example.page));
  }
  baum_study_destroy(study);
  baum_mechanism_destroy(s.mechanism);
  return example_end();
}
