/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares results for random spatial mechanisms with those in quadruple precision.
 * bench_random_spatial tests more of them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "spatial_judge.h"

static void accelerations_and_reactions_are_accurate(void **state)
{
  static random_spatial room;
  (void)state;
  enum { MECHANISMS = 150 };
  spatial_tally tally = {0};
  for (uint64_t seed = 0; seed < MECHANISMS; seed++) {
    spatial_judge(&room, seed, false, &tally);
    spatial_judge(&room, seed, true, &tally);
  }
  assert_int_equal(spatial_bad(&tally), 0);
  /* Each seed gives two mechanisms, and up to two configurations of each are tested. On average,
   * more than one of them must have accurate results. */
  assert_true(tally.counts[SPATIAL_MET] > 2 * MECHANISMS);
  assert_true(tally.dependent > MECHANISMS / 5);
  assert_true(tally.reactions > 2 * MECHANISMS);
  assert_true(tally.mobilities > MECHANISMS);
  assert_true(tally.velocity_rows > MECHANISMS);
  for (int kind = 0; kind < ORACLE_KINDS; kind++) {
    assert_true(tally.joints[kind] > MECHANISMS / 10);
  }
  for (int kind = 0; kind < ORACLE_FORCE_KINDS; kind++) {
    assert_true(tally.forces[kind] > MECHANISMS / 10);
  }
}

/* Checks that the design configuration of every seed is refused, and that this refusal is right. */
static void check_refused(const uint64_t *seeds, int count)
{
  static random_spatial room;
  spatial_tally tally = {0};
  for (int k = 0; k < count; k++) {
    spatial_judge(&room, seeds[k], false, &tally);
  }
  assert_int_equal(spatial_bad(&tally), 0);
  assert_int_equal(tally.counts[SPATIAL_REFUSED], count);
}

/* In these design configurations, dependent rows contradict each other. Because of rounding,
 * however, a pivot is 2e-15 instead of zero. LU factorization alone would give accelerations of
 * 1e14 m/s^2. Their residual would be small, and would not reveal the contradiction. */
static void contradictions_that_rounding_hides_are_refused(void **state)
{
  static const uint64_t seeds[] = {1993, 2454, 2990, 3741, 5094};
  (void)state;
  check_refused(seeds, 5);
}

/* In these design configurations, no acceleration satisfies all rows. Every acceleration that
 * satisfies the other rows contradicts the omitted rows. */
static void contradictions_of_omitted_rows_are_refused(void **state)
{
  static const uint64_t seeds[] = {2161, 7114, 7849, 8244};
  (void)state;
  check_refused(seeds, 4);
}

/* In these mechanisms, a coupling only repeats what other joints enforce, so its row is zero up to
 * rounding. */
static void couplings_without_effect_are_redundant(void **state)
{
  static const uint64_t seeds[] = {5375, 6167};
  static random_spatial room;
  (void)state;
  spatial_tally tally = {0};
  for (int k = 0; k < 2; k++) {
    spatial_judge(&room, seeds[k], true, &tally);
  }
  assert_int_equal(spatial_bad(&tally), 0);
  assert_true(tally.counts[SPATIAL_MET] >= 2);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(accelerations_and_reactions_are_accurate),
    cmocka_unit_test(contradictions_that_rounding_hides_are_refused),
    cmocka_unit_test(contradictions_of_omitted_rows_are_refused),
    cmocka_unit_test(couplings_without_effect_are_redundant),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
