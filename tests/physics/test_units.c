/* SPDX-License-Identifier: BSD-3-Clause */
/* A mechanism described in millimetres, grams and milliseconds must have the same motion, with the
 * same steps, as in metres, kilograms and seconds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "posed.h"
#include "runs.h"

enum { CASES = 6, LINKS = 10 };

static const char *const NAMES[CASES] = {"slider-crank", "slider-crank, driven", "four-bar",
                                         "Andrews",      "four-bar N = 10",      "chain N = 10"};
/* [s] The slider-cranks and Andrews' mechanism make some revolutions in these times, and the other
 * mechanisms make some swings. The times are short enough for the motion to amplify rounding errors
 * only a little. */
static const double END[CASES] = {0.02, 0.02, 0.5, 0.005, 0.5, 0.5};

static baum_status build_chain(const model_units *units, model *m)
{
  double angle[LINKS];
  for (int k = 0; k < LINKS; k++) {
    angle[k] = 0.1 * k;
  }
  model_chain data = {.links = LINKS, .angle = angle, .units = units};
  return model_chain_build(&data, m);
}

static baum_status build_case(int which, const model_units *units, model *m)
{
  model_slider_crank crank = {.driven = which == 1, .units = units};
  model_n_four_bar bars = model_n_four_bar_a02(10);
  bars.units = units;
  switch (which) {
  case 0:
  case 1: return model_slider_crank_build(crank, m);
  case 2: return model_four_bar_in(units, m);
  case 3: return model_andrews_bodies_in(units, m);
  case 4: return model_n_four_bar_build(&bars, m);
  default: return build_chain(units, m);
  }
}

typedef struct pair {
  /* Largest difference of positions; lengths are divided by the characteristic length. */
  double apart;
  int64_t steps[2];
} pair;

/* Runs until `end` [s]. `end` and `options` are in SI units, and are converted to `units`. */
static baum_simulation *run_in(const model *m, const model_units *units,
                               const baum_simulation_options *options, double end, int64_t *steps)
{
  baum_simulation_options scaled = *options;
  scaled.step *= units ? units->time : 1.0;
  baum_simulation *run = create_run(m->mechanism, &scaled);
  check(baum_simulation_advance_to(run, end * (units ? units->time : 1.0)));
  baum_counters counters = counters_of(run);
  *steps = counters.steps;
  return run;
}

static pair compare_units(int which, const baum_simulation_options *options)
{
  pair out = {0};
  model m[2];
  int32_t nq = 0;
  double scale = (double)NAN;
  check(build_case(which, NULL, &m[0]));
  check(build_case(which, &MODEL_MILLI, &m[1]));
  check(baum_mechanism_sizes(m[0].mechanism, &nq, NULL, NULL));
  check(baum_mechanism_get_characteristic_length(m[0].mechanism, &scale));
  baum_simulation *si = run_in(&m[0], NULL, options, END[which], &out.steps[0]);
  baum_simulation *milli = run_in(&m[1], &MODEL_MILLI, options, END[which], &out.steps[1]);
  for (int i = 0; i < nq; i++) {
    double unit = i % 3 < 2 ? MODEL_MILLI.length : 1.0;
    double apart = fabs(baum_simulation_q(milli)[i] / unit - baum_simulation_q(si)[i]);
    apart /= i % 3 < 2 ? scale : 1.0;
    out.apart = isnan(apart) || apart > out.apart ? apart : out.apart;
  }
  baum_simulation_destroy(si);
  baum_simulation_destroy(milli);
  model_destroy(&m[0]);
  model_destroy(&m[1]);
  return out;
}

static void print_pair(int which, const baum_simulation_options *options, const pair *found)
{
  printf("%-22s %-20s %-12s %10.1e %6lld %6lld\n", NAMES[which],
         baum_integrator_name(options->integrator), baum_formulation_name(options->formulation),
         found->apart, (long long)found->steps[0], (long long)found->steps[1]);
  (void)fflush(stdout);
}

static void fixed_steps_give_the_same_motion_in_other_units(void **state)
{
  (void)state;
  /* The limit is the rounding error of several hundred steps. */
  const double limit = 1e-10;
  enum { METHODS = 4 };
  const baum_integrator *methods[METHODS] = {baum_semi_implicit_euler(), baum_rk4(), baum_dp5(),
                                             baum_rk8()};
  const baum_formulation formulations[] = {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_PROJECTION,
                                           BAUM_FORMULATION_UNSTABILIZED};
  int failures = 0;
  printf("\n%-22s %-20s %-12s %10s %6s %6s\n", "fixed step", "", "", "apart", "SI", "milli");
  for (int k = 0; k < 3 * METHODS * CASES; k++) {
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = methods[k % METHODS];
    options.formulation = formulations[k / METHODS % 3];
    int which = k / (3 * METHODS);
    options.step = END[which] / 256;
    pair found = compare_units(which, &options);
    print_pair(which, &options, &found);
    failures += found.apart <= limit && found.steps[0] == found.steps[1] ? 0 : 1;
  }
  assert_int_equal(failures, 0);
}

static void the_number_of_variable_steps_is_the_same_within_two_percent(void **state)
{
  (void)state;
  enum { METHODS = 9 };
  /* A build without SUNDIALS has only the first four methods. */
  const int methods_here = BAUM_HAVE_SUNDIALS ? METHODS : 4;
  const baum_integrator *methods[METHODS] = {baum_dp5(), baum_dp5(),         baum_rk8(),
                                             baum_rk8(), baum_cvode_adams(), baum_cvode_bdf(),
                                             baum_ida(), baum_ida(),         baum_ida()};
  const baum_formulation forms[METHODS] = {
    BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_PROJECTION,
    BAUM_FORMULATION_BAUMGARTE,  BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_BAUMGARTE,
    BAUM_FORMULATION_BAUMGARTE,  BAUM_FORMULATION_GGL,       BAUM_FORMULATION_INDEX2};
  int failures = 0;
  printf("\n%-22s %-20s %-12s %10s %6s %6s\n", "rtol 1e-6", "", "", "apart", "SI", "milli");
  for (int k = 0; k < methods_here * CASES; k++) {
    baum_simulation_options options = baum_simulation_options_default();
    options.integrator = methods[k % methods_here];
    options.formulation = forms[k % methods_here];
    options.rtol = 1e-6;
    pair found = compare_units(k / methods_here, &options);
    print_pair(k / methods_here, &options, &found);
    /* Rounding may change the choice of steps, and therefore their number. */
    double more = fabs((double)(found.steps[1] - found.steps[0]));
    bool same = more <= 0.02 * (double)found.steps[0];
    failures += same && found.apart <= 10.0 * options.rtol ? 0 : 1;
  }
  assert_int_equal(failures, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(fixed_steps_give_the_same_motion_in_other_units),
    cmocka_unit_test(the_number_of_variable_steps_is_the_same_within_two_percent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
