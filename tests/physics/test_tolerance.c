/* SPDX-License-Identifier: BSD-3-Clause */
/* A tighter tolerance must give a smaller error. Runs of the integrators with variable steps are
 * compared with references, at rtol from 1e-4 to 1e-10. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "a01_pendulum_reference.h"
#include "catalog/data/four_bar.h"
#include "catalog/data/slider_crank_eccentric.h"
#include "physics_run.h"
#include "reference.h"
#include "slider_crank_driven_reference.h"

enum { DECADES = 6, PER_DECADE = 4, TOLERANCES = DECADES * PER_DECADE + 1, REFERENCE_COUNT = 4 };
enum { MIDDLE = TOLERANCES / 2 };

/* When rtol decreases by a factor of 10, the error must fall by at least the factor LEAST_FALL, in
 * the geometric mean over all mechanisms. An error proportional to rtol would fall by a factor of
 * 10. */
static const double LEAST_FALL = 7.0;
/* The corresponding factor for BDF. At order p, the error is proportional to rtol^(p / (p + 1)). It
 * falls by a factor of 6.8 at the highest order, 5, and by 5.6 at order 3. The factors measured
 * were 7.0 for CVODE and 7.2 to 7.3 for IDA. With 40 other initial configurations or end times of
 * each mechanism, the mean factors are 6.5 for CVODE and 6.4 for IDA. */
static const double LEAST_FALL_OF_BDF = 6.0;
/* The same factor for a single mechanism. An error that is small by chance has more influence on it
 * than on a mean. */
static const double LEAST_SINGLE_FALL = 5.5;

/* The runs end after nine samples. Until then, cranks make 1 to 2 revolutions, and the pendulum
 * makes 2 swings. In longer runs, the errors at rtol 1e-4 would reach 1 rad and stop growing. */
static const reference REFERENCES[REFERENCE_COUNT] = {
  [PENDULUM] = {.samples = 9,
                .width = A01_PENDULUM_WIDTH,
                .t = A01_PENDULUM_T,
                .q = A01_PENDULUM_Q[0],
                .lengths = "mm"},
  [FREE_CRANK] = {.samples = 9,
                  .width = 9,
                  .t = SLIDER_CRANK_ECCENTRIC_T,
                  .entry = "slider_crank_eccentric",
                  .lengths = "mmrmmrmmr"},
  [DRIVEN_CRANK] = {.samples = 9,
                    .width = SLIDER_CRANK_DRIVEN_WIDTH,
                    .t = SLIDER_CRANK_DRIVEN_T,
                    .q = SLIDER_CRANK_DRIVEN_Q[0],
                    .lengths = "mmrmmrmmr"},
  [FOUR_BAR] =
    {.samples = 9, .width = 9, .t = FOUR_BAR_T, .entry = "four_bar", .lengths = "mmrmmrmmr"},
};

/* Returns the factor by which the error falls when rtol decreases by a factor of 10. A line is
 * fitted to the logarithms of the errors. Single small errors influence this line less than they
 * would influence the ratio of the first to the last error. */
static double fit_fall(const double error[TOLERANCES])
{
  double sum = 0.0;
  double weight = 0.0;
  for (int k = 0; k < TOLERANCES; k++) {
    double decade = (k - MIDDLE) / (double)PER_DECADE;
    sum -= decade * log10(error[k]);
    weight += decade * decade;
  }
  return pow(10.0, sum / weight);
}

static void print_falls(const double error[TOLERANCES])
{
  for (int k = PER_DECADE; k < TOLERANCES; k += PER_DECADE) {
    printf(" %6.1f", error[k - PER_DECADE] / error[k]);
  }
  double ends = pow(error[0] / error[TOLERANCES - 1], 1.0 / DECADES);
  printf("   mean %4.1f   fitted %4.1f   error from %.1e to %.1e\n", ends, fit_fall(error),
         error[0], error[TOLERANCES - 1]);
  (void)fflush(stdout);
}

static double observe_fall(physics_mechanism which, const baum_integrator *integrator,
                           baum_formulation formulation)
{
  double error[TOLERANCES];
  model m = build_mechanism(which);
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = integrator;
  options.formulation = formulation;
  for (int k = 0; k < TOLERANCES; k++) {
    options.rtol = pow(10.0, -4.0 - k / (double)PER_DECADE);
    reference_run run = reference_compare(&REFERENCES[which], m.mechanism, &options);
    if (run.status < BAUM_OK) {
      fail_msg("%s", run.message);
    }
    error[k] = run.error;
  }
  model_destroy(&m);
  printf("%-12s %-20s", baum_integrator_name(integrator), mechanism_name(which));
  print_falls(error);
  return fit_fall(error);
}

static void compare_falls(const baum_integrator *integrator, baum_formulation formulation,
                          double least_mean)
{
  double product = 1.0;
  double least = (double)INFINITY;
  int fits = 0;
  printf("fall of the error in each decade of rtol from 1e-4 to 1e-10\n");
  for (int which = 0; which < REFERENCE_COUNT; which++) {
    /* If there are no degrees of freedom, projection leaves only rounding errors, whatever the
     * tolerance. */
    if (which == DRIVEN_CRANK && formulation == BAUM_FORMULATION_PROJECTION) {
      continue;
    }
    double fall = observe_fall((physics_mechanism)which, integrator, formulation);
    product *= fall;
    least = fmin(least, fall);
    fits++;
  }
  double mean = pow(product, 1.0 / fits);
  printf("%-12s mean of the fitted factors %.2f, least factor %.2f\n",
         baum_integrator_name(integrator), mean, least);
  assert_true(mean >= least_mean);
  assert_true(least >= LEAST_SINGLE_FALL);
}

static void the_error_of_adams_falls_with_its_tolerance(void **state)
{
  (void)state;
  need_sundials();
  compare_falls(baum_cvode_adams(), BAUM_FORMULATION_BAUMGARTE, LEAST_FALL);
}

static void the_error_of_bdf_falls_with_its_tolerance(void **state)
{
  (void)state;
  need_sundials();
  compare_falls(baum_cvode_bdf(), BAUM_FORMULATION_BAUMGARTE, LEAST_FALL_OF_BDF);
}

static void the_error_of_ida_at_index_1_falls_with_its_tolerance(void **state)
{
  (void)state;
  need_sundials();
  compare_falls(baum_ida(), BAUM_FORMULATION_BAUMGARTE, LEAST_FALL_OF_BDF);
}

static void the_error_of_ida_with_ggl_falls_with_its_tolerance(void **state)
{
  (void)state;
  need_sundials();
  compare_falls(baum_ida(), BAUM_FORMULATION_GGL, LEAST_FALL_OF_BDF);
}

static void the_error_of_ida_at_index_2_falls_with_its_tolerance(void **state)
{
  (void)state;
  need_sundials();
  compare_falls(baum_ida(), BAUM_FORMULATION_INDEX2, LEAST_FALL_OF_BDF);
}

static void the_error_of_pairs_falls_with_their_tolerance(void **state)
{
  (void)state;
  compare_falls(baum_dp5(), BAUM_FORMULATION_BAUMGARTE, LEAST_FALL);
  compare_falls(baum_dp5(), BAUM_FORMULATION_PROJECTION, LEAST_FALL);
  compare_falls(baum_rk8(), BAUM_FORMULATION_BAUMGARTE, LEAST_FALL);
  compare_falls(baum_rk8(), BAUM_FORMULATION_PROJECTION, LEAST_FALL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_error_of_pairs_falls_with_their_tolerance),
    cmocka_unit_test(the_error_of_adams_falls_with_its_tolerance),
    cmocka_unit_test(the_error_of_bdf_falls_with_its_tolerance),
    cmocka_unit_test(the_error_of_ida_at_index_1_falls_with_its_tolerance),
    cmocka_unit_test(the_error_of_ida_with_ggl_falls_with_its_tolerance),
    cmocka_unit_test(the_error_of_ida_at_index_2_falls_with_its_tolerance),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
