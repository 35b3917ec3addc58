/* SPDX-License-Identifier: BSD-3-Clause */
/* IFToMM/A Coruna A02 with 40 windows, 243 coordinates and 242 rows, from upright up to its first flat
 * position, where J loses 40 rows, against tests/data.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "n_four_bar_reference.h"
#include "reference_test.h"

enum { LOOPS = 40 };

static double larger(double a, double b)
{
  return isnan(b) || b > a ? b : a;
}

/* Angle of the first crank, and by how much any coordinate is not what that angle says. */
static void angle_and_departure(const double *q, double *out)
{
  double c = cos(q[2]);
  double s = sin(q[2]);
  out[0] = q[2];
  out[1] = 0.0;
  for (int k = 0; k <= LOOPS; k++) {
    const double *crank = q + (ptrdiff_t)6 * k;
    out[1] = larger(out[1], fabs(crank[0] - (k + c / 2)));
    out[1] = larger(out[1], fabs(crank[1] - s / 2));
    out[1] = larger(out[1], fabs(crank[2] - q[2]));
    if (k < LOOPS) {
      out[1] = larger(out[1], fabs(crank[3] - (k + 0.5 + c)));
      out[1] = larger(out[1], fabs(crank[4] - s));
      out[1] = larger(out[1], fabs(crank[5]));
    }
  }
}

/* The last sample is the flat position itself, the one before it is 0.0076 rad away. */
static const reference NEARLY_FLAT = {.name = "four-bar N = 40",
                                      .samples = N_FOUR_BAR_SAMPLES - 1,
                                      .width = N_FOUR_BAR_WIDTH,
                                      .t = N_FOUR_BAR_T,
                                      .q = N_FOUR_BAR_Q[0],
                                      .lengths = "rr",
                                      .columns = angle_and_departure};

static void adams_comes_near_the_flat_position_within_1e_8(void **state)
{
  (void)state;
  need_sundials();
  model m;
  model_n_four_bar data = model_n_four_bar_a02(LOOPS);
  assert_int_equal(model_n_four_bar_build(&data, &m), BAUM_OK);
  baum_simulation_options options = adams_options();
  assert_reached(&NEARLY_FLAT, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

/* By a step from one side to the other. Steps of tighter tolerances end where J has lost rank to
 * rounding, and lose digits there. */
static void adams_passes_the_flat_position_within_1e_8(void **state)
{
  (void)state;
  need_sundials();
  model m;
  model_n_four_bar data = model_n_four_bar_a02(LOOPS);
  assert_int_equal(model_n_four_bar_build(&data, &m), BAUM_OK);
  reference to_flat = NEARLY_FLAT;
  to_flat.samples = N_FOUR_BAR_SAMPLES;
  baum_simulation_options options = adams_options();
  options.rtol = 1e-11;
  reference_run run = reference_compare(&to_flat, m.mechanism, &options);
  printf("\nup to flat: cvode_adams, rtol 1e-11: error %.2e, steps %lld %s\n", run.error,
         (long long)run.counters.steps, run.message);
  assert_true(run.error <= 1e-8);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(adams_comes_near_the_flat_position_within_1e_8),
    cmocka_unit_test(adams_passes_the_flat_position_within_1e_8),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
