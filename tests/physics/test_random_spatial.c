/* SPDX-License-Identifier: BSD-3-Clause */
/* Spatial mechanisms by chance against an oracle in quadruple precision; bench_random_spatial has
 * more of them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "spatial_judge.h"

static void accelerations_and_reactions_are_met(void **state)
{
  static random_spatial room;
  (void)state;
  enum { MECHANISMS = 150 };
  spatial_tally tally = {0};
  for (uint64_t seed = 0; seed < MECHANISMS; seed++) {
    spatial_judge(&room, seed, &tally);
  }
  assert_int_equal(spatial_bad(&tally), 0);
  assert_true(tally.counts[SPATIAL_MET] > MECHANISMS); /* of two configurations each */
  assert_true(tally.dependent > MECHANISMS / 10);
  assert_true(tally.reactions > MECHANISMS);
}

/* In their design configurations dependent rows contradict each other, and rounding leaves a pivot
 * of 2e-15: by LU, accelerations would be 1e14 m/s^2, and no residual would show it. */
static void contradictions_that_rounding_hides_are_refused(void **state)
{
  static const uint64_t seeds[] = {1993, 2454, 2990, 3741, 5094};
  static random_spatial room;
  (void)state;
  enum { COUNT = sizeof seeds / sizeof *seeds };
  spatial_tally tally = {0};
  for (int k = 0; k < COUNT; k++) {
    spatial_judge(&room, seeds[k], &tally);
  }
  assert_int_equal(spatial_bad(&tally), 0);
  assert_int_equal(tally.counts[SPATIAL_REFUSED], COUNT);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(accelerations_and_reactions_are_met),
    cmocka_unit_test(contradictions_that_rounding_hides_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
