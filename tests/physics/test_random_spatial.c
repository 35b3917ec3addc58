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

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(accelerations_and_reactions_are_met),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
