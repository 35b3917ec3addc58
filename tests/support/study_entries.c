/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "study_entries.h"

baum_study_options small_study_options(void)
{
  baum_study_options o = baum_study_options_default();
  o.repeats = 1;
  o.samples = 20;
  return o;
}

baum_study *small_study(const baum_mechanism *mechanism, const baum_study_options *options)
{
  baum_study *study = NULL;
  assert_int_equal(baum_study_create(mechanism, 0.0, 1.0, &study), BAUM_OK);
  assert_int_equal(baum_study_set_options(study, options), BAUM_OK);
  baum_study_grid grid = baum_study_grid_default();
  grid.settings = 5;
  grid.integrator = baum_rk4();
  assert_int_equal(baum_study_add_standard(study, &grid), BAUM_OK);
  grid.integrator = baum_rk8();
  assert_int_equal(baum_study_add_standard(study, &grid), BAUM_OK);
  return study;
}

baum_study_entry study_entry(const baum_study *study, int32_t k)
{
  baum_study_entry entry;
  assert_int_equal(baum_study_entry_at(study, k, &entry, sizeof entry), BAUM_OK);
  return entry;
}

/* Bits are compared, so that NaNs are equal to each other. */
#define ASSERT_SAME(type, name, known, unit, meaning) \
  assert_memory_equal(&a.name, &b.name, sizeof a.name);

static void assert_same_figures(baum_study_entry a, baum_study_entry b)
{
  a.cpu = a.cpu_spread = b.cpu = b.cpu_spread = 0.0;
  BAUM_STUDY_ENTRY_LIST(ASSERT_SAME)
}

void assert_same_entries(const baum_study *a, const baum_study *b)
{
  assert_int_equal(baum_study_entry_count(a), baum_study_entry_count(b));
  for (int32_t k = 0; k < baum_study_entry_count(a); k++) {
    baum_study_entry x = study_entry(a, k);
    baum_study_entry y = study_entry(b, k);
    assert_string_equal(x.name, y.name);
    assert_string_equal(x.message, y.message);
    assert_true(memcmp(&x.step, &y.step, sizeof x.step) == 0);
    assert_true(memcmp(&x.rtol, &y.rtol, sizeof x.rtol) == 0);
    assert_same_figures(x, y);
  }
}
