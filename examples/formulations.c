/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares the cost and the accuracy of integrators and formulations. The mechanism is the
 * slider-crank without a driver, whose crank is released at 150 rad/s. Each pair of integrator and
 * formulation simulates it for 0.2 s. The error is the largest difference of the positions from the
 * samples of a reference, with angles in radians and lengths divided by the characteristic length.
 * The violation in the table is the largest one of all constraint rows. These rows are in metres,
 * except the row of the guide's angle, which is in radians. */
#include "slider_crank_reference.h"

enum { SETTINGS = 3, SHOWN = 1 }; /* setting 0: coarse, 1: shown in the table, 2: fine */

typedef enum tuning { STEP, RTOL } tuning;

typedef struct method {
  const baum_integrator *(*integrator)(void);
  baum_formulation formulation;
  tuning tuned_by;
  double settings[SETTINGS]; /* steps [s] or values of rtol [-] */
  double error;              /* largest error that is allowed for the setting in the table */
} method;

static const method methods[] = {
  {baum_euler, BAUM_FORMULATION_BAUMGARTE, STEP, {1e-4, 1e-5, 2.5e-6}, 1.0},
  {baum_euler, BAUM_FORMULATION_PROJECTION, STEP, {1e-4, 1e-5, 2.5e-6}, 0.5},
  {baum_semi_implicit_euler, BAUM_FORMULATION_BAUMGARTE, STEP, {1e-4, 1e-5, 2.5e-6}, 5e-4},
  {baum_semi_implicit_euler, BAUM_FORMULATION_PROJECTION, STEP, {1e-4, 1e-5, 2.5e-6}, 0.5},
  {baum_rk4, BAUM_FORMULATION_BAUMGARTE, STEP, {1e-3, 1e-4, 2.5e-5}, 5e-6},
  {baum_rk4, BAUM_FORMULATION_PROJECTION, STEP, {1e-3, 1e-4, 2.5e-5}, 5e-7},
  {baum_rk8, BAUM_FORMULATION_BAUMGARTE, RTOL, {1e-6, 1e-8, 1e-10}, 2e-6},
  {baum_rk8, BAUM_FORMULATION_PROJECTION, RTOL, {1e-6, 1e-8, 1e-10}, 2e-6},
  {baum_generalized_alpha, BAUM_FORMULATION_INDEX3, STEP, {1e-3, 1e-4, 2.5e-5}, 0.1},
  {baum_cvode_adams, BAUM_FORMULATION_BAUMGARTE, RTOL, {1e-6, 1e-8, 1e-10}, 1e-4},
  {baum_cvode_bdf, BAUM_FORMULATION_PROJECTION, RTOL, {1e-6, 1e-8, 1e-10}, 5e-4},
  {baum_ida, BAUM_FORMULATION_GGL, RTOL, {1e-6, 1e-8, 1e-10}, 2e-4},
  {baum_ida, BAUM_FORMULATION_BAUMGARTE, RTOL, {1e-6, 1e-8, 1e-10}, 2e-4},
  {baum_ida, BAUM_FORMULATION_INDEX3, RTOL, {1e-4, 1e-6, 1e-8}, 1.0},
};
enum { METHODS = sizeof methods / sizeof methods[0], BUILT_IN = 9 /* without SUNDIALS */ };

/* The results of one run. */
typedef struct outcome {
  double error;
  double energy; /* [J] largest change of the energy */
  baum_counters counters;
} outcome;

static outcome simulate(const slider_crank *s, const method *how, int setting)
{
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = how->integrator();
  options.formulation = how->formulation;
  *(how->tuned_by == STEP ? &options.step : &options.rtol) = how->settings[setting];
  baum_simulation *run = NULL;
  outcome out = {0};
  CHECK(baum_simulation_create(s->mechanism, &options, &run));
  for (int k = 0; k < REFERENCE_SAMPLES; k++) {
    baum_status status = baum_simulation_advance_to(run, reference_time(k));
    if (status != BAUM_WARNED || setting == SHOWN) { /* print each warning once */
      CHECK(status);
    }
    CHECK(baum_simulation_counters(run, &out.counters, sizeof out.counters));
    out.error = fmax(out.error, slider_crank_error(s, run, k));
    out.energy = fmax(out.energy, fabs(out.counters.energy_change));
  }
  baum_simulation_destroy(run);
  return out;
}

static void row(int k, int setting, const outcome *out)
{
  example_text(baum_integrator_name(methods[k].integrator()));
  example_text(baum_formulation_name(methods[k].formulation));
  example_number(methods[k].settings[setting]);
  example_number(1e3 * out->counters.wall);
  example_number((double)out->counters.steps);
  example_number((double)out->counters.evaluations);
  example_number(out->error);
  example_number(out->counters.max_phi);
  example_number(out->counters.max_phi_rate);
  example_number(out->energy);
}

/* Writes the results into tables, and checks them. The table on the screen contains one setting of
 * each method, and the files contain all settings. */
static void tell(outcome outcomes[][SETTINGS], int count)
{
  static const example_column columns[] = {{"integrator", "integrator", 's', 19},
                                           {"formulation", "formulation", 's', 11},
                                           {"setting", "step [s] or rtol", 'e', 1},
                                           {"wall", "wall [ms]", 'f', 1},
                                           {"steps", "steps", 'd', 6},
                                           {"evaluations", "evaluations", 'd', 6},
                                           {"error", "error [-]", 'e', 1},
                                           {"max_phi", "max|Phi| [m]", 'e', 1},
                                           {"max_phi_rate", "max|Phi'| [m/s]", 'e', 1},
                                           {"energy_change", "energy change [J]", 'e', 1}};
  example_table("formulations", columns, 10, true);
  for (int k = 0; k < count; k++) {
    row(k, SHOWN, &outcomes[k][SHOWN]);
  }
  example_table("work", columns, 10, false);
  for (int k = 0; k < SETTINGS * count; k++) {
    row(k / SETTINGS, k % SETTINGS, &outcomes[k / SETTINGS][k % SETTINGS]);
  }

  double phi[2] = {0.0}; /* largest violation: [0] with projection, [1] without */
  int worse = 0;
  printf("\n");
  for (int k = 0; k < count; k++) {
    const outcome *o = outcomes[k];
    char name[64];
    (void)snprintf(name, sizeof name, "error of %s, %s",
                   baum_integrator_name(methods[k].integrator()),
                   baum_formulation_name(methods[k].formulation));
    example_expect(name, o[SHOWN].error, methods[k].error);
    double *most = &phi[methods[k].formulation != BAUM_FORMULATION_PROJECTION];
    *most = fmax(*most, o[SHOWN].counters.max_phi);
    worse += !(o[2].error < o[1].error && o[1].error < o[0].error);
  }
  example_expect("violation after projection", phi[0], 1e-14);
  example_expect("violation of the others", phi[1], 1e-6);
  example_expect("methods that a finer setting made worse", worse, 0.0);
}

int main(int argc, char **argv)
{
  static outcome outcomes[METHODS][SETTINGS];
  example_begin(argc, argv, "formulations");
  int count = baum_has("sundials") ? METHODS : BUILT_IN;
  slider_crank s = slider_crank_build(false);
  printf("formulations: slider-crank, 3 bodies, 4 joints, 1 degree of freedom; crank released at "
         "%g rad/s, to %g s\n",
         SLIDER_CRANK_SPEED, reference_time(REFERENCE_SAMPLES - 1));
  for (int k = 0; k < SETTINGS * count; k++) {
    outcomes[k / SETTINGS][k % SETTINGS] = simulate(&s, &methods[k / SETTINGS], k % SETTINGS);
  }
  baum_mechanism_destroy(s.mechanism);
  printf("%s\n",
         count < METHODS ? "this library is built without SUNDIALS: no CVODE and IDA\n" : "");
  tell(outcomes, count);
  return example_end();
}
