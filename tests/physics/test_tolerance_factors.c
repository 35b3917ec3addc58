/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the options tolerance_q and tolerance_v with every method that has variable steps. Both are
 * factors of rtol. If one factor is so large that its tolerance has no effect, the other factor
 * alone must control the error. If both are equal to c, the result must be the same as with the
 * tolerance c rtol and without factors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "a01_pendulum_reference.h"
#include "physics_run.h"
#include "reference.h"
#include "runs.h"

/* The first two seconds of the motion, which are about one swing. */
static const reference SWING = {.name = "pendulum",
                                .samples = 4,
                                .width = A01_PENDULUM_WIDTH,
                                .t = A01_PENDULUM_T,
                                .q = A01_PENDULUM_Q[0],
                                .lengths = "mm"};
static const double RTOL = 1e-5;
static const double SMALL = 1e-3;
static const double OUT_OF_THE_WAY = 1e6;
/* If a tolerance is multiplied by SMALL = 1e-3, the error must fall by at least the factor
 * LEAST_FALL. At order p, the error falls by a factor of (1e3)^(p/(p+1)). For orders 2 to 8 this is
 * 100 to 500. Factors from 22 to 7e3 were measured, because the error of a single swing may be
 * small by chance. */
static const double LEAST_FALL = 10.0;

typedef struct factors {
  double q;
  double v;
} factors;

static reference_run run_with(const baum_integrator *integrator, baum_formulation formulation,
                              double rtol, factors with)
{
  model m = build_mechanism(PENDULUM);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = formulation;
  options.rtol = rtol;
  options.tolerance_q = with.q;
  options.tolerance_v = with.v;
  reference_run out = reference_compare(&SWING, m.mechanism, &options);
  if (out.status < BAUM_OK) {
    fail_msg("%s, %s: %s", baum_integrator_name(integrator), baum_formulation_name(formulation),
             out.message);
  }
  model_destroy(&m);
  return out;
}

static void the_explanation_of_a_run_names_the_factors(void **state)
{
  (void)state;
  model m = build_mechanism(PENDULUM);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk8();
  options.rtol = 1e-6;
  options.tolerance_v = 20.0;
  baum_simulation *run = create_run(m.mechanism, &options);
  assert_non_null(strstr(baum_simulation_explain(run), "rtol 1e-06, tolerance_v 20; positions"));
  baum_simulation_destroy(run);
  model_destroy(&m);
}

static void compare(const char *what, const baum_integrator *integrator,
                    baum_formulation formulation, factors loose, factors tight)
{
  reference_run one = run_with(integrator, formulation, RTOL, loose);
  reference_run other = run_with(integrator, formulation, RTOL, tight);
  printf("%-14s %-14s %-12s error %.1e and %.1e, steps %5lld and %5lld\n", what,
         baum_integrator_name(integrator), baum_formulation_name(formulation), one.error,
         other.error, (long long)one.counters.steps, (long long)other.counters.steps);
  (void)fflush(stdout);
  assert_true(other.error <= one.error / LEAST_FALL);
  assert_true(other.counters.steps > one.counters.steps);
}

static void try_factors(const baum_integrator *integrator, baum_formulation formulation)
{
  /* At index 3 the error test omits velocities. */
  bool tests_velocities = formulation != BAUM_FORMULATION_INDEX3;
  compare("tolerance_q", integrator, formulation, (factors){1.0, OUT_OF_THE_WAY},
          (factors){SMALL, OUT_OF_THE_WAY});
  if (tests_velocities) {
    compare("tolerance_v", integrator, formulation, (factors){OUT_OF_THE_WAY, 1.0},
            (factors){OUT_OF_THE_WAY, SMALL});
  }
  /* Both runs have the same tolerances. With some methods the first step differs, because its
   * choice uses rtol without the factors. */
  reference_run both = run_with(integrator, formulation, RTOL, (factors){SMALL, SMALL});
  reference_run rtol = run_with(integrator, formulation, RTOL * SMALL, (factors){1.0, 1.0});
  printf("%-14s %-14s %-12s error %.1e and %.1e, steps %5lld and %5lld\n", "both, or rtol",
         baum_integrator_name(integrator), baum_formulation_name(formulation), both.error,
         rtol.error, (long long)both.counters.steps, (long long)rtol.counters.steps);
  (void)fflush(stdout);
  double more = fabs((double)(both.counters.steps - rtol.counters.steps));
  assert_true(more <= 0.1 * (double)rtol.counters.steps + 4.0);
}

static void each_tolerance_controls_the_error_alone(void **state)
{
  (void)state;
  int tried = 0;
  for (int32_t k = 0; baum_integrator_at(k); k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    bool built = baum_integrator_has_fixed_step(integrator) || BAUM_HAVE_SUNDIALS;
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      if (built && baum_integrator_has_variable_step(integrator) &&
          baum_integrator_offers(integrator, (baum_formulation)f)) {
        try_factors(integrator, (baum_formulation)f);
        tried++;
      }
    }
  }
  assert_true(tried > 0 || !BAUM_HAVE_SUNDIALS);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_explanation_of_a_run_names_the_factors),
    cmocka_unit_test(each_tolerance_controls_the_error_alone),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
