/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests how a study names its entries, which settings it treats as separate methods, and how it
 * defines the error. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "message.h"
#include "models.h"
#include "study_entries.h"

static int build(void **state)
{
  static model m;
  *state = &m;
  return model_pendulum_rod(&MODEL_PENDULUM_A01, &m) == BAUM_OK ? 0 : -1;
}

static int clear(void **state)
{
  model_destroy(*state);
  return 0;
}

static baum_study *make(const model *m)
{
  baum_study *study = NULL;
  baum_study_options o = small_study_options();
  o.validate = false;
  check(baum_study_create(m->mechanism, 0.0, 0.5, &study));
  check(baum_study_set_options(study, &o));
  return study;
}

static baum_simulation_options baumgarte(baum_gains gains, double step)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.formulation = BAUM_FORMULATION_BAUMGARTE;
  o.gains = gains;
  o.step = step;
  return o;
}

/* ---- names ---- */

static void entries_have_their_gains_in_their_names(void **state)
{
  baum_study *study = make(*state);
  const struct {
    baum_gains gains;
    const char *name;
  } entries[] = {
    {baum_gains_fixed(5.0, 6.0), "rk4 baumgarte alpha 5 beta 6 1/s, step 0.01 s"},
    {baum_gains_scaled(0.5, 0.25), "rk4 baumgarte alpha h 0.5 beta^2 h^2 0.25, step 0.01 s"},
    {baum_gains_frequency(2.0, 0.7), "rk4 baumgarte 2 Hz ratio 0.7, step 0.01 s"},
    {baum_gains_taylor(), "rk4 baumgarte taylor, step 0.01 s"},
    {baum_gains_deadbeat(), "rk4 baumgarte dead-beat, step 0.01 s"},
    {baum_gains_best_damping(), "rk4 baumgarte best damping, step 0.01 s"},
    {baum_gains_auto(), "rk4 baumgarte auto, step 0.01 s"},
  };
  enum { ENTRIES = sizeof entries / sizeof *entries };
  for (int32_t k = 0; k < ENTRIES; k++) {
    const baum_simulation_options o = baumgarte(entries[k].gains, 0.01);
    check(baum_study_add(study, &o));
    assert_string_equal(study_entry(study, k).name, entries[k].name);
    assert_int_equal(study_entry(study, k).method, k);
  }
  baum_study_destroy(study);
}

/* The study copies the factors of the gains. Entries with other factors belong to another method.
 * Entries that only have another step belong to the same method. */
static void gains_of_rows_belong_to_the_method(void **state)
{
  baum_study *study = make(*state);
  double factor = 2.0;
  baum_simulation_options o = baumgarte(baum_gains_fixed(5.0, 5.0), 0.01);
  o.row_gains = &factor;
  o.row_gain_count = 1;
  check(baum_study_add(study, &o));
  o.step = 0.02;
  check(baum_study_add(study, &o));
  factor = 3.0;
  check(baum_study_add(study, &o));
  static const int32_t methods[3] = {0, 0, 1};
  static const double factors[3] = {2.0, 2.0, 3.0};
  for (int32_t k = 0; k < 3; k++) {
    baum_simulation_options kept;
    check(baum_study_entry_options(study, k, &kept, sizeof kept));
    assert_true(kept.row_gains != &factor && kept.row_gains[0] == factors[k]);
    assert_int_equal(study_entry(study, k).method, methods[k]);
    assert_non_null(strstr(study_entry(study, k).name, "alpha 5 beta 5 1/s by rows, step"));
  }
  baum_study_destroy(study);
}

/* ---- definition of error ---- */

/* Finds the errors of two entries, whose steps are h and h / 2. The study measures the error of
 * `channel`. If `channel` is NULL, it measures its default error. */
static void errors_of(const model *m, const baum_channel *channel, double unit, double errors[2])
{
  baum_study *study = make(m);
  if (channel) {
    check(baum_study_set_error(study, channel, 1, unit));
    const char *text = baum_study_error_text(study);
    assert_non_null(strstr(text, "largest error of "));
    assert_non_null(strstr(text, " over all samples, divided by "));
  }
  for (int k = 0; k < 2; k++) {
    const baum_simulation_options o = baumgarte(baum_gains_fixed(5.0, 5.0), k == 0 ? 0.05 : 0.025);
    check(baum_study_add(study, &o));
  }
  check(baum_study_run(study));
  for (int32_t k = 0; k < 2; k++) {
    assert_int_equal(study_entry(study, k).state, BAUM_STUDY_DONE);
    errors[k] = study_entry(study, k).error;
  }
  baum_study_destroy(study);
}

static void the_error_may_be_that_of_channels_divided_by_a_unit(void **state)
{
  const model *m = *state;
  const baum_channel place = baum_channel_of(BAUM_Q);
  const baum_channel speed = baum_channel_of(BAUM_V);
  const baum_channel pull = baum_channel_of(BAUM_LAMBDA);
  double own[2];
  double same[2];
  double finer[2];
  double of_speed[2];
  double of_pull[2];
  errors_of(m, NULL, 0.0, own);
  /* By default, the error of positions is relative to the characteristic length, which is 1 m
   * here. */
  errors_of(m, &place, 1.0, same);
  errors_of(m, &place, 0.5, finer);
  errors_of(m, &speed, 1.0, of_speed);
  errors_of(m, &pull, 1.0, of_pull);
  for (int k = 0; k < 2; k++) {
    ASSERT_NEAR(same[k], own[k], 1e-12, 0.0);
    ASSERT_NEAR(finer[k], 2.0 * own[k], 1e-12, 0.0);
  }
  /* The method has order 4. The ratio is therefore near 2^4. The limits allow for higher terms. */
  assert_in_range(own[0] / own[1], 12, 40);
  assert_in_range(of_speed[0] / of_speed[1], 12, 40);
  assert_in_range(of_pull[0] / of_pull[1], 12, 40);
}

/* ---- refused ---- */

static void invalid_units_entries_and_costs_are_refused(void **state)
{
  baum_study *study = make(*state);
  const baum_simulation_options o = baumgarte(baum_gains_fixed(5.0, 5.0), 0.05);
  baum_simulation_options best;
  baum_study_entry entry;
  const baum_channel place = baum_channel_of(BAUM_Q);
  const baum_channel foreign = baum_channel_of_body(BAUM_BODY_POSE, (baum_body_id){1, 1});
  const baum_study_cost none = (baum_study_cost)7;
  double number = 0.0;
  int32_t count = 0;
  ASSERT_SAYS(baum_study_set_error(study, &place, 1, 0.0), BAUM_ERR_ARGUMENT,
              "unit is 0, must be finite and > 0");
  ASSERT_SAYS(baum_study_set_error(study, &foreign, 1, 1.0), BAUM_ERR_ARGUMENT, "body");
  check(baum_study_add(study, &o));
  check(baum_study_run(study));
  ASSERT_SAYS(baum_study_entry_at(study, 1, &entry, sizeof entry), BAUM_ERR_ARGUMENT,
              "k is 1, must be 0 to 0");
  ASSERT_SAYS(baum_study_front(study, none, 0, NULL, &count), BAUM_ERR_ARGUMENT,
              "cost is 7, must be one of baum_study_cost");
  ASSERT_SAYS(baum_study_front(study, BAUM_STUDY_WORK, 3, NULL, &count), BAUM_ERR_ARGUMENT,
              "entries are NULL");
  ASSERT_SAYS(baum_study_compare(study, 0, 0, 1e-3, BAUM_STUDY_WORK, NULL), BAUM_ERR_ARGUMENT,
              "ratio is NULL");
  ASSERT_SAYS(baum_study_cost_at(study, 0, 1e-3, none, &number), BAUM_ERR_ARGUMENT,
              "cost is 7, must be one of baum_study_cost");
  ASSERT_SAYS(baum_study_recommend(study, 0.0, BAUM_STUDY_WORK, &best, sizeof best, NULL, 0),
              BAUM_ERR_ARGUMENT, "error is 0, must be finite and > 0");
  baum_study_destroy(study);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(entries_have_their_gains_in_their_names),
    cmocka_unit_test(gains_of_rows_belong_to_the_method),
    cmocka_unit_test(the_error_may_be_that_of_channels_divided_by_a_unit),
    cmocka_unit_test(invalid_units_entries_and_costs_are_refused),
  };
  return cmocka_run_group_tests(tests, build, clear);
}
