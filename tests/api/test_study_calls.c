/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the calls of a study: calls that are refused and change nothing, defaults, entries that
 * cannot be run, and lack of memory. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"
#include "heap.h"
#include "message.h"
#include "models.h"
#include "study_entries.h"

static baum_study *make(const model *m)
{
  baum_study *study = NULL;
  assert_int_equal(baum_study_create(m->mechanism, 0.0, 1.0, &study), BAUM_OK);
  return study;
}

static baum_simulation_options rk4(double step)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = step;
  return o;
}

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

/* ---- calls that are refused ---- */

static void a_study_needs_a_frozen_mechanism_and_a_span(void **state)
{
  const model *m = *state;
  baum_study *study = (baum_study *)(uintptr_t)16;
  baum_mechanism *thawed = NULL;
  ASSERT_SAYS(baum_study_create(NULL, 0.0, 1.0, &study), BAUM_ERR_ARGUMENT, "mechanism is NULL");
  assert_null(study);
  ASSERT_SAYS(baum_study_create(m->mechanism, 0.0, 1.0, NULL), BAUM_ERR_ARGUMENT, "out is NULL");
  ASSERT_SAYS(baum_study_create(m->mechanism, 2.0, 2.0, &study), BAUM_ERR_ARGUMENT,
              "t0 is 2 s|must be finite and differ");
  ASSERT_SAYS(baum_study_create(m->mechanism, 0.0, (double)INFINITY, &study), BAUM_ERR_ARGUMENT,
              "t1 is inf");
  assert_int_equal(baum_mechanism_copy(m->mechanism, &thawed), BAUM_OK);
  ASSERT_SAYS(baum_study_create(thawed, 0.0, 1.0, &study), BAUM_ERR_STATE, "not frozen");
  baum_mechanism_destroy(thawed);
  baum_study_destroy(NULL);
  baum_study_cancel(NULL);
}

static void calls_on_a_null_study_are_refused(void **state)
{
  (void)state;
  baum_study_options o = baum_study_options_default();
  baum_study_entry entry;
  baum_study_method method;
  baum_study_reference reference;
  baum_simulation_options best;
  const double one = 1.0;
  double number = 0.0;
  int32_t count = 0;
  const baum_channel q = baum_channel_of(BAUM_Q);
  const baum_status refused[] = {
    baum_study_set_options(NULL, &o),
    baum_study_add(NULL, &best),
    baum_study_add_standard(NULL, NULL),
    baum_study_add_stress(NULL, NULL),
    baum_study_set_error(NULL, &q, 1, 1.0),
    baum_study_set_reference(NULL, &one, 1, &one, NULL, NULL, 9.0),
    baum_study_set_solution(NULL, NULL, NULL, 9.0),
    baum_study_run(NULL),
    baum_study_entry_at(NULL, 0, &entry, sizeof entry),
    baum_study_entry_options(NULL, 0, &best, sizeof best),
    baum_study_method_at(NULL, 0, &method, sizeof method),
    baum_study_reference_read(NULL, &reference, sizeof reference),
    baum_study_reference_sample(NULL, 0, NULL, NULL, NULL, NULL),
    baum_study_settings(NULL, NULL, NULL, NULL, 0),
    baum_study_front(NULL, BAUM_STUDY_WORK, 0, NULL, &count),
    baum_study_cost_at(NULL, 0, 1e-3, BAUM_STUDY_WORK, &number),
    baum_study_compare(NULL, 0, 1, 1e-3, BAUM_STUDY_WORK, &number),
    baum_study_recommend(NULL, 1e-3, BAUM_STUDY_WORK, &best, sizeof best, NULL, 0),
    baum_study_recommend_budget(NULL, 1.0, &best, sizeof best, NULL, 0),
  };
  for (size_t k = 0; k < sizeof refused / sizeof refused[0]; k++) {
    assert_int_equal(refused[k], BAUM_ERR_ARGUMENT);
  }
  assert_int_equal(baum_study_entry_count(NULL), 0);
  assert_int_equal(baum_study_method_count(NULL), 0);
  assert_null(baum_study_error_text(NULL));
  assert_null(baum_study_state_name((baum_study_state)99));
}

static void options_out_of_range_are_refused_by_name(void **state)
{
  baum_study *study = make(*state);
  const struct {
    baum_study_options options;
    const char *says;
  } wrong[] = {
    {{.samples = 1}, "samples is 1, must be 2 to 1000000"},
    {{.threads = 0}, "threads is 0, must be 1 to 1024"},
    {{.repeats = -1}, "repeats is -1"},
    {{.entry_limit = 0.0}, "entry_limit is 0 s, must be > 0"},
    {{.time_budget = (double)NAN}, "time_budget is nan s"},
  };
  for (int k = 0; k < 5; k++) {
    baum_study_options o = baum_study_options_default();
    o.samples = k == 0 ? wrong[k].options.samples : o.samples;
    o.threads = k == 1 ? wrong[k].options.threads : o.threads;
    o.repeats = k == 2 ? wrong[k].options.repeats : o.repeats;
    o.entry_limit = k == 3 ? wrong[k].options.entry_limit : o.entry_limit;
    o.time_budget = k == 4 ? wrong[k].options.time_budget : o.time_budget;
    ASSERT_SAYS(baum_study_set_options(study, &o), BAUM_ERR_ARGUMENT, wrong[k].says);
  }
  baum_study_options o = baum_study_options_default();
  o.file = "";
  ASSERT_SAYS(baum_study_set_options(study, &o), BAUM_ERR_ARGUMENT, "file is empty");
  o.struct_size = 3;
  ASSERT_SAYS(baum_study_set_options(study, &o), BAUM_ERR_STRUCT, "struct_size is 3");
  baum_study_destroy(study);
}

/* The largest number of samples depends on the number of coordinates. */
static void sizes_that_cannot_be_meant_are_refused_with_their_limit(void **state)
{
  baum_study *study = make(*state);
  const struct {
    int32_t sizes[3];
    const char *says;
  } large[] = {
    {{INT32_MAX, 1, 1}, "study options: samples is 2147483647, must be 2 to 1000000"},
    {{1000001, 1, 1}, "samples is 1000001"},
    {{2, 1025, 1}, "study options: threads is 1025, must be 1 to 1024"},
    {{2, 1, INT32_MAX}, "study options: repeats is 2147483647, must be 1 to 1000000"},
  };
  baum_study_options o = baum_study_options_default();
  for (size_t k = 0; k < sizeof large / sizeof large[0]; k++) {
    o.samples = large[k].sizes[0];
    o.threads = large[k].sizes[1];
    o.repeats = large[k].sizes[2];
    ASSERT_SAYS(baum_study_set_options(study, &o), BAUM_ERR_ARGUMENT, large[k].says);
  }
  o = (baum_study_options){.samples = 1000000, .threads = 1024, .repeats = 1000000};
  o.struct_size = sizeof o;
  o.entry_limit = o.time_budget = 1.0;
  assert_int_equal(baum_study_set_options(study, &o), BAUM_OK);
  baum_study_destroy(study);

  enum { BODIES = 200 }; /* each sample has 1200 values of q and v */
  const baum_planar_body_def body = baum_planar_body_def_default();
  baum_mechanism *mechanism = create_mechanism();
  for (int k = 0; k < BODIES; k++) {
    assert_int_equal(baum_mechanism_add_planar_body(mechanism, &body, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  study = make(&(model){.mechanism = mechanism});
  ASSERT_SAYS(baum_study_set_options(study, &o), BAUM_ERR_ARGUMENT,
              "samples is 1000000, must be 2 to 83333");
  baum_study_destroy(study);
  baum_mechanism_destroy(mechanism);
}

static void grids_out_of_range_are_refused_and_add_nothing(void **state)
{
  baum_study *study = make(*state);
  baum_study_grid g = baum_study_grid_default();
  g.settings = 0;
  ASSERT_SAYS(baum_study_add_standard(study, &g), BAUM_ERR_ARGUMENT, "settings is 0");
  g = baum_study_grid_default();
  g.constants = 5;
  ASSERT_SAYS(baum_study_add_standard(study, &g), BAUM_ERR_ARGUMENT, "constants is 5");
  g = baum_study_grid_default();
  g.finest = 0.5;
  ASSERT_SAYS(baum_study_add_standard(study, &g), BAUM_ERR_ARGUMENT, "finest is 0.5");
  g = baum_study_grid_default();
  g.coarsest = -1.0;
  ASSERT_SAYS(baum_study_add_standard(study, &g), BAUM_ERR_ARGUMENT, "coarsest is -1 s");
  g = baum_study_grid_default();
  g.integrator = baum_rk4();
  g.formulation = BAUM_FORMULATION_INDEX3;
  ASSERT_SAYS(baum_study_add_standard(study, &g), BAUM_ERR_ARGUMENT,
              "no integrator of this build that you allow offers the formulation index3");
  assert_int_equal(baum_study_entry_count(study), 0);
  assert_int_equal(baum_study_method_count(study), 0);
  ASSERT_SAYS(baum_study_run(study), BAUM_ERR_STATE, "no entries");
  baum_study_destroy(study);
}

static int change_all(const baum_study *study, int32_t done, int32_t total, void *user)
{
  (void)done;
  (void)total;
  baum_study *under_way = user;
  assert_ptr_equal(study, under_way);
  const baum_simulation_options o = rk4(0.02);
  const baum_study_options options = baum_study_options_default();
  const baum_channel q = baum_channel_of(BAUM_Q);
  ASSERT_SAYS(baum_study_run(under_way), BAUM_ERR_STATE, "baum_study_run() is still running");
  ASSERT_SAYS(baum_study_add(under_way, &o), BAUM_ERR_STATE, "is still running");
  ASSERT_SAYS(baum_study_add_standard(under_way, NULL), BAUM_ERR_STATE, "is still running");
  ASSERT_SAYS(baum_study_add_stress(under_way, NULL), BAUM_ERR_STATE, "is still running");
  ASSERT_SAYS(baum_study_set_options(under_way, &options), BAUM_ERR_STATE, "is still running");
  ASSERT_SAYS(baum_study_set_error(under_way, &q, 1, 1.0), BAUM_ERR_STATE, "can no longer change");
  return 0;
}

static void progress_cannot_change_a_running_study(void **state)
{
  baum_study *study = make(*state);
  const baum_simulation_options o = rk4(0.01);
  assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  baum_study_options options = baum_study_options_default();
  options.validate = false;
  options.progress = change_all;
  options.user = study;
  assert_int_equal(baum_study_set_options(study, &options), BAUM_OK);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  assert_int_equal(baum_study_entry_count(study), 1);
  assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  baum_study_destroy(study);
}

/* The first entry exceeds the time limit. Entries with smaller steps are therefore skipped. Invalid
 * entries must still be reported as refused. */
static void invalid_settings_are_refused_even_if_others_exceed_the_time_limit(void **state)
{
  baum_study *study = make(*state);
  const double steps[] = {1e-6, -1.0, (double)NAN};
  for (int k = 0; k < 3; k++) {
    const baum_simulation_options o = rk4(steps[k]);
    assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  }
  baum_study_options options = baum_study_options_default();
  options.validate = false;
  options.entry_limit = 1e-6;
  assert_int_equal(baum_study_set_options(study, &options), BAUM_OK);
  (void)baum_study_run(study); /* fails: the limit also applies to the reference */
  assert_int_equal(study_entry(study, 0).state, BAUM_STUDY_TIMED_OUT);
  assert_int_equal(study_entry(study, 1).state, BAUM_STUDY_REFUSED);
  assert_int_equal(study_entry(study, 2).state, BAUM_STUDY_REFUSED);
  baum_study_destroy(study);
}

static void the_definition_of_error_is_described_with_names(void **state)
{
  const model *m = *state;
  baum_study *study = make(m);
  const baum_channel pose = baum_channel_of_body(BAUM_BODY_POSE, m->bodies[0]);
  const baum_channel entry = baum_channel_of_joint(BAUM_PHI, m->joints[0]);
  const baum_channel channels[5] = {pose, entry, baum_channel_of(BAUM_ENERGY), pose, entry};
  assert_string_equal(
    baum_study_error_text(study),
    "largest error of all positions over all samples, lengths divided by 1 m, angles in rad");
  assert_int_equal(baum_study_set_error(study, channels, 2, 1e-3), BAUM_OK);
  assert_string_equal(baum_study_error_text(study),
                      "largest error of pose of body 1 \"bob\", violation of joint 1 \"rod\" over "
                      "all samples, divided by 0.001");
  assert_int_equal(baum_study_set_error(study, channels, 5, 2.0), BAUM_OK);
  assert_non_null(
    strstr(baum_study_error_text(study), ", energy and 2 more over all samples, divided by 2"));
  baum_study_destroy(study);
}

static void results_of_entries_that_were_not_run_are_refused(void **state)
{
  baum_study *study = make(*state);
  baum_simulation_options o = rk4(0.01);
  baum_simulation_options best;
  double cost = 0.0;
  assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  o.integrator = NULL;
  ASSERT_SAYS(baum_study_add(study, &o), BAUM_ERR_ARGUMENT, "integrator is NULL");
  ASSERT_SAYS(baum_study_recommend(study, 1e-3, BAUM_STUDY_WORK, &best, sizeof best, NULL, 0),
              BAUM_ERR_STATE, "no entry is finished");
  ASSERT_SAYS(baum_study_cost_at(study, 1, 1e-3, BAUM_STUDY_WORK, &cost), BAUM_ERR_ARGUMENT,
              "no method 1");
  ASSERT_SAYS(baum_study_reference_sample(study, 0, NULL, NULL, NULL, NULL), BAUM_ERR_STATE,
              "has not been computed");
  baum_study_entry entry = study_entry(study, 0);
  assert_int_equal(entry.state, BAUM_STUDY_WAITING);
  assert_true(isnan(entry.error) && isnan(entry.cpu) && isnan(entry.error_validated));
  assert_string_equal(entry.name, "rk4 projection, step 0.01 s");
  baum_study_destroy(study);
}

static void options_that_entries_depend_on_cannot_change_after_a_run(void **state)
{
  baum_study *study = make(*state);
  baum_study_options o = small_study_options();
  const baum_simulation_options run = rk4(0.01);
  const baum_channel q = baum_channel_of(BAUM_Q);
  assert_int_equal(baum_study_set_options(study, &o), BAUM_OK);
  assert_int_equal(baum_study_add(study, &run), BAUM_OK);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  o.threads = 2;
  assert_int_equal(baum_study_set_options(study, &o), BAUM_OK);
  o.samples++;
  ASSERT_SAYS(baum_study_set_options(study, &o), BAUM_ERR_STATE, "samples can no longer change");
  ASSERT_SAYS(baum_study_set_error(study, &q, 1, 1.0), BAUM_ERR_STATE,
              "the definition of the error");
  const double t = 1.0;
  const double place[2] = {0.0, -1.0};
  ASSERT_SAYS(baum_study_set_reference(study, &t, 1, place, NULL, NULL, 9.0), BAUM_ERR_STATE,
              "the reference");
  baum_study_destroy(study);
}

static void references_out_of_order_or_without_digits_are_refused(void **state)
{
  baum_study *study = make(*state);
  const double q[4] = {0.0, -1.0, 0.0, -1.0};
  const double good[2] = {0.5, 1.0};
  const double start[2] = {0.0, 1.0};
  const double late[2] = {0.5, 1.5};
  ASSERT_SAYS(baum_study_set_reference(study, good, 2, q, NULL, NULL, 0.0), BAUM_ERR_ARGUMENT,
              "digits is 0");
  ASSERT_SAYS(baum_study_set_reference(study, start, 2, q, NULL, NULL, 9.0), BAUM_ERR_ARGUMENT,
              "times[0] is 0 s");
  ASSERT_SAYS(baum_study_set_reference(study, late, 2, q, NULL, NULL, 9.0), BAUM_ERR_ARGUMENT,
              "times[1] is 1.5 s");
  assert_int_equal(baum_study_set_reference(study, good, 2, q, NULL, NULL, 9.0), BAUM_OK);
  baum_study_destroy(study);
}

static void nothing_is_recommended_where_nothing_was_compared(void **state)
{
  baum_study *study = make(*state);
  const double end = 1.0;
  const double none[2] = {(double)NAN, (double)NAN};
  const baum_simulation_options o = rk4(0.01);
  baum_simulation_options best;
  assert_int_equal(baum_study_set_reference(study, &end, 1, none, NULL, NULL, 9.0), BAUM_OK);
  assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  ASSERT_SAYS(baum_study_recommend(study, 1e-3, BAUM_STUDY_WORK, &best, sizeof best, NULL, 0),
              BAUM_ERR_ARGUMENT, "none of the finished entries followed the true motion");
  ASSERT_SAYS(baum_study_recommend_budget(study, 1.0, &best, sizeof best, NULL, 0),
              BAUM_ERR_ARGUMENT, "none of the finished entries followed the true motion");
  ASSERT_SAYS(baum_study_recommend_budget(study, INFINITY, &best, sizeof best, NULL, 0),
              BAUM_ERR_ARGUMENT, "seconds is inf s, must be finite and > 0");
  baum_study_destroy(study);
}

/* ---- entries ---- */

static void a_setting_that_cannot_be_run_is_an_entry_with_its_reason(void **state)
{
  baum_study *study = make(*state);
  baum_study_options options = small_study_options();
  options.entry_limit = 1e-3;
  options.validate = false;
  assert_int_equal(baum_study_set_options(study, &options), BAUM_OK);
  baum_simulation_options o = rk4(0.01);
  o.formulation = BAUM_FORMULATION_GGL;
  assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  o = rk4(0.01);
  o.formulation = BAUM_FORMULATION_BAUMGARTE;
  o.gains = baum_gains_fixed(1e4, 1e4);
  assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  /* Ten million steps take longer than the limit of a millisecond, and twice as many take even
   * longer. */
  o = rk4(1e-7);
  assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  o.step = 5e-8;
  assert_int_equal(baum_study_add(study, &o), BAUM_OK);
  /* The reference is given, because a computed one could exceed the time limit. */
  double t = 1.0;
  const double place[2] = {0.0, -1.0};
  assert_int_equal(baum_study_set_reference(study, &t, 1, place, NULL, NULL, 9.0), BAUM_OK);
  assert_int_equal(baum_study_run(study), BAUM_OK);
  const struct {
    baum_study_state entry;
    baum_status status;
    const char *says;
  } want[] = {
    {BAUM_STUDY_REFUSED, BAUM_ERR_UNSUPPORTED, "does not offer"},
    {BAUM_STUDY_REFUSED, BAUM_ERR_UNSTABLE, "violations grow"},
    {BAUM_STUDY_TIMED_OUT, BAUM_STOP_CANCELLED, "more than 0.001 s"},
    {BAUM_STUDY_TIMED_OUT, BAUM_STOP_CANCELLED, "more than 0.001 s"},
  };
  for (int32_t k = 0; k < 4; k++) {
    baum_study_entry entry = study_entry(study, k);
    assert_int_equal(entry.state, want[k].entry);
    assert_int_equal(entry.status, want[k].status);
    assert_non_null(strstr(entry.message, want[k].says));
    assert_true(isnan(entry.error) && isnan(entry.work));
  }
  assert_true(study_entry(study, 1).unstable);
  baum_study_destroy(study);
}

static void the_standard_grid_has_all_integrators_and_formulations(void **state)
{
  baum_study *study = make(*state);
  baum_study_grid g = baum_study_grid_default();
  g.settings = 1;
  assert_int_equal(baum_study_add_standard(study, &g), BAUM_OK);
  for (int32_t i = 0; baum_integrator_at(i); i++) {
    const baum_integrator *integrator = baum_integrator_at(i);
    bool of_sundials = strncmp(baum_integrator_name(integrator), "cvode", 5) == 0 ||
                       strcmp(baum_integrator_name(integrator), "ida") == 0;
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      bool found = false;
      for (int32_t k = 0; k < baum_study_entry_count(study); k++) {
        baum_study_entry entry = study_entry(study, k);
        found =
          found || (entry.integrator == integrator && entry.formulation == (baum_formulation)f);
      }
      bool wanted = baum_integrator_offers(integrator, (baum_formulation)f) &&
                    (!of_sundials || baum_has("sundials"));
      assert_int_equal(found, wanted);
    }
  }
  baum_study_destroy(study);
}

/* For each integrator and kind of step, which is fixed or variable, the quick grid has one method
 * with default settings. */
static void the_quick_grid_has_all_integrators_with_default_settings(void **state)
{
  baum_study *study = make(*state);
  baum_study_grid g = baum_study_grid_default();
  g.quick = true;
  assert_int_equal(baum_study_add_standard(study, &g), BAUM_OK);
  int32_t methods = 0;
  for (int32_t i = 0; baum_integrator_at(i); i++) {
    const baum_integrator *integrator = baum_integrator_at(i);
    bool of_sundials = strncmp(baum_integrator_name(integrator), "cvode", 5) == 0 ||
                       strcmp(baum_integrator_name(integrator), "ida") == 0;
    int kinds =
      baum_integrator_has_fixed_step(integrator) + baum_integrator_has_variable_step(integrator);
    methods += of_sundials && !baum_has("sundials") ? 0 : kinds > 0 ? kinds : 1;
  }
  assert_int_equal(baum_study_method_count(study), methods);
  for (int32_t k = 0; k < baum_study_entry_count(study); k++) {
    baum_study_entry entry = study_entry(study, k);
    assert_int_equal(entry.gains.rule, BAUM_GAINS_DEFAULT);
    baum_study_method method;
    assert_int_equal(baum_study_method_at(study, entry.method, &method, sizeof method), BAUM_OK);
    assert_true(method.entries <= 5);
  }
  int32_t entries = baum_study_entry_count(study);
  g.settings = 2;
  g.integrator = baum_rk4();
  g.formulation = BAUM_FORMULATION_BAUMGARTE;
  assert_int_equal(baum_study_add_standard(study, &g), BAUM_OK);
  assert_int_equal(baum_study_entry_count(study), entries + 2);
  assert_int_equal(study_entry(study, entries).formulation, BAUM_FORMULATION_BAUMGARTE);
  baum_study_destroy(study);
}

/* ---- memory ---- */

static baum_status study_little(const model *m)
{
  baum_study *study = NULL;
  baum_study_options o = small_study_options();
  o.threads = 2;
  o.samples = 2;
  baum_status status = baum_study_create(m->mechanism, 0.0, 0.05, &study);
  status = status == BAUM_OK ? baum_study_set_options(study, &o) : status;
  const baum_simulation_options run = rk4(0.01);
  status = status == BAUM_OK ? baum_study_add(study, &run) : status;
  status = status == BAUM_OK ? baum_study_run(study) : status;
  baum_study_destroy(study);
  return status;
}

/* To save time, only every seventh allocation is tested. Lack of memory must never be reported as a
 * refused entry. */
static void a_study_without_memory_fails_and_loses_no_memory(void **state)
{
  const model *m = *state;
  if (!heap_is_ours()) {
    skip();
  }
  assert_int_equal(study_little(m), BAUM_OK);
  long before = heap_blocks();
  heap_watch();
  assert_int_equal(study_little(m), BAUM_OK);
  long allocations = heap_stop();
  assert_true(allocations > 100);
  for (long n = 0; n < allocations; n += 7) {
    heap_fail(n, true);
    baum_status status = study_little(m);
    (void)heap_stop();
    assert_int_equal(status, BAUM_ERR_MEMORY);
    assert_int_equal(heap_blocks(), before);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_study_needs_a_frozen_mechanism_and_a_span),
    cmocka_unit_test(calls_on_a_null_study_are_refused),
    cmocka_unit_test(options_out_of_range_are_refused_by_name),
    cmocka_unit_test(sizes_that_cannot_be_meant_are_refused_with_their_limit),
    cmocka_unit_test(grids_out_of_range_are_refused_and_add_nothing),
    cmocka_unit_test(progress_cannot_change_a_running_study),
    cmocka_unit_test(invalid_settings_are_refused_even_if_others_exceed_the_time_limit),
    cmocka_unit_test(the_definition_of_error_is_described_with_names),
    cmocka_unit_test(results_of_entries_that_were_not_run_are_refused),
    cmocka_unit_test(options_that_entries_depend_on_cannot_change_after_a_run),
    cmocka_unit_test(references_out_of_order_or_without_digits_are_refused),
    cmocka_unit_test(nothing_is_recommended_where_nothing_was_compared),
    cmocka_unit_test(a_setting_that_cannot_be_run_is_an_entry_with_its_reason),
    cmocka_unit_test(the_standard_grid_has_all_integrators_and_formulations),
    cmocka_unit_test(the_quick_grid_has_all_integrators_with_default_settings),
    cmocka_unit_test(a_study_without_memory_fails_and_loses_no_memory),
  };
  return cmocka_run_group_tests(tests, build, clear);
}
