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

/* The last sample is 5e-6 rad away from flat. On the flat position itself no digits can be promised:
 * whether a step ends there is chance, and there J has lost rank to rounding. */
static const reference TO_FLAT = {.name = "four-bar N = 40",
                                  .samples = N_FOUR_BAR_SAMPLES,
                                  .width = N_FOUR_BAR_WIDTH,
                                  .t = N_FOUR_BAR_T,
                                  .q = N_FOUR_BAR_Q[0],
                                  .lengths = "rr",
                                  .columns = angle_and_departure};

static void adams_reaches_the_first_flat_position_within_1e_8(void **state)
{
  (void)state;
  need_sundials();
  model m;
  model_n_four_bar data = model_n_four_bar_a02(LOOPS);
  assert_int_equal(model_n_four_bar_build(&data, &m), BAUM_OK);
  baum_simulation_options options = adams_options();
  assert_reached(&TO_FLAT, m.mechanism, &options, 1e-8);
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(adams_reaches_the_first_flat_position_within_1e_8),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
