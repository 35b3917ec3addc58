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

/* Same bits, so that NaNs are compared too. */
static void assert_same_numbers(const baum_study_entry *a, const baum_study_entry *b)
{
  const double x[] = {a->step,         a->rtol,           a->error,           a->error_final,
                      a->error_half,   a->error_q,        a->error_q_final,   a->error_v,
                      a->error_lambda, a->energy_error,   a->max_phi,         a->max_phi_rate,
                      a->gains_work,   a->violation_work, a->projection_work, a->error_validated,
                      a->work};
  const double y[] = {b->step,         b->rtol,           b->error,           b->error_final,
                      b->error_half,   b->error_q,        b->error_q_final,   b->error_v,
                      b->error_lambda, b->energy_error,   b->max_phi,         b->max_phi_rate,
                      b->gains_work,   b->violation_work, b->projection_work, b->error_validated,
                      b->work};
  assert_memory_equal(x, y, sizeof x);
  const double g[] = {a->alpha, a->beta, a->error_v_final};
  const double h[] = {b->alpha, b->beta, b->error_v_final};
  assert_memory_equal(g, h, sizeof g);
  const int64_t i[] = {a->steps,    a->rejected, a->evaluations, a->factorizations,
                       a->warnings, a->at_floor, a->off,         a->untrusted};
  const int64_t j[] = {b->steps,    b->rejected, b->evaluations, b->factorizations,
                       b->warnings, b->at_floor, b->off,         b->untrusted};
  assert_memory_equal(i, j, sizeof i);
}

void assert_same_entries(const baum_study *a, const baum_study *b)
{
  assert_int_equal(baum_study_entry_count(a), baum_study_entry_count(b));
  for (int32_t k = 0; k < baum_study_entry_count(a); k++) {
    baum_study_entry x = study_entry(a, k);
    baum_study_entry y = study_entry(b, k);
    assert_string_equal(x.name, y.name);
    assert_string_equal(x.message, y.message);
    assert_int_equal(x.state, y.state);
    assert_int_equal(x.status, y.status);
    assert_same_numbers(&x, &y);
  }
}
