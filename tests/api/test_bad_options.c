/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests options, starts, targets and channels that are refused. Each test compares the message, and
 * checks that nothing has changed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "every_element.h"
#include "message.h"
#include "runs.h"

static baum_simulation_options good_options(void)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_euler();
  o.step = 1e-3;
  return o;
}

/* ---- options ---- */

static void a_missing_integrator_is_refused_with_the_list(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = good_options();
  o.integrator = NULL;
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                    "integrator is NULL|there is no default");
  for (int32_t k = 0; baum_integrator_at(k) != NULL; k++) {
    char name[64];
    (void)snprintf(name, sizeof name, "baum_%s", baum_integrator_name(baum_integrator_at(k)));
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, name);
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void a_wrong_struct_size_or_null_is_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = good_options();
  const size_t sizes[] = {0, 1, sizeof(size_t), sizeof o - 1, sizeof o + 8, SIZE_MAX};
  for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
    char message[96];
    (void)snprintf(message, sizeof message, "struct_size of the options is %zu|must be %zu",
                   sizes[k], sizeof o);
    o.struct_size = sizes[k];
    check_run_refused(parts.mechanism, &o, BAUM_ERR_STRUCT, message);
  }
  o = good_options();
  check_run_refused(NULL, &o, BAUM_ERR_ARGUMENT, "baum_simulation_create: the mechanism is NULL");
  check_run_refused(parts.mechanism, NULL, BAUM_ERR_ARGUMENT, "options is NULL");
  ASSERT_SAYS(baum_simulation_create(parts.mechanism, &o, NULL), BAUM_ERR_ARGUMENT, "out is NULL");
  baum_mechanism *copy = NULL;
  assert_int_equal(baum_mechanism_copy(parts.mechanism, &copy), BAUM_OK);
  check_run_refused(copy, &o, BAUM_ERR_STATE,
                    "baum_simulation_create: the mechanism is not frozen");
  baum_mechanism_destroy(copy);
  baum_mechanism_destroy(parts.mechanism);
}

/* A wrong value of one field. `variable` tells whether the other options are for variable steps. */
typedef struct bad_option {
  bool variable;
  size_t offset;
  double value;
  const char *message;
} bad_option;

#define OPTION(name) offsetof(baum_simulation_options, name)

static const bad_option bad_options[] = {
  {false, OPTION(step), 0.0, "step is 0 s, must be finite and > 0"},
  {false, OPTION(step), -1e-3, "step is -0.001 s, must be finite and > 0"},
  {false, OPTION(step), (double)INFINITY, "step is inf s, must be finite and > 0"},
  {false, OPTION(step), (double)NAN, "step is not given|euler needs it"},
  {false, OPTION(rtol), 1e-6, "rtol is 1e-06, but euler has a fixed step"},
  {false, OPTION(atol), 1e-9, "atol is 1e-09, but euler has a fixed step"},
  {false, OPTION(max_step), 0.1, "max_step is 0.1 s, but euler has a fixed step"},
  {false, OPTION(tolerance_q), 2.0, "tolerance_q is 2, but euler has no tolerances here"},
  {false, OPTION(tolerance_v), (double)NAN, "tolerance_v is nan, but euler has no tolerances"},
  {true, OPTION(max_step), 0.0, "max_step is 0 s, must be > 0"},
  {true, OPTION(tolerance_q), 0.0, "tolerance_q is 0, must be > 0"},
  {true, OPTION(tolerance_v), -1.0, "tolerance_v is -1, must be > 0"},
  {true, OPTION(tolerance_q), (double)INFINITY, "tolerance_q is inf, must be > 0 and finite"},
  {true, OPTION(tolerance_v), (double)INFINITY, "tolerance_v is inf, must be > 0 and finite"},
  {true, OPTION(tolerance_lambda), (double)NAN, "tolerance_lambda is nan, must be > 0"},
  {true, OPTION(max_step), -1.0, "max_step is -1 s, must be > 0"},
  {false, OPTION(start_time), (double)NAN, "start_time is nan s, must be finite"},
  {false, OPTION(progress_interval), -1.0, "progress_interval is -1 s, must be finite and >= 0"},
  {false, OPTION(progress_interval), (double)NAN, "progress_interval is nan s, must be finite"},
  {true, OPTION(step), 1e-3, "step is 0.001 s, but cvode_adams chooses its own steps"},
  {true, OPTION(rtol), 0.0, "rtol is 0, must be > 0 and < 1"},
  {true, OPTION(rtol), -1e-6, "rtol is -1e-06, must be > 0"},
  {true, OPTION(rtol), 1.0, "rtol is 1, must be > 0 and < 1"},
  {true, OPTION(rtol), (double)INFINITY, "rtol is inf, must be > 0"},
  {true, OPTION(rtol), (double)NAN, "rtol is not given|cvode_adams needs it"},
  {true, OPTION(atol), -1e-9, "atol is -1e-09, must be finite and >= 0"},
  {true, OPTION(atol), (double)INFINITY, "atol is inf, must be finite and >= 0"},
};

static void numbers_out_of_range_and_of_the_other_kind_are_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  for (size_t k = 0; k < sizeof bad_options / sizeof *bad_options; k++) {
    const bad_option *bad = &bad_options[k];
    if (bad->variable && !baum_has("sundials")) {
      continue;
    }
    baum_simulation_options o = good_options();
    if (bad->variable) {
      o.integrator = baum_cvode_adams();
      o.step = (double)NAN;
      o.rtol = 1e-6;
    }
    memcpy((char *)&o + bad->offset, &bad->value, sizeof bad->value);
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, bad->message);
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void invalid_choices_are_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = good_options();
  o.start = (baum_start)3;
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                    "start is 3, must be one of baum_start");
  o = good_options();
  o.solver = (baum_solver)9;
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                    "solver is 9, must be one of baum_solver");
  o = good_options();
  o.max_steps = 0;
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, "max_steps is 0, must be > 0");
  o = good_options();
  o.formulation = (baum_formulation)17;
  check_run_refused(parts.mechanism, &o, BAUM_ERR_UNSUPPORTED,
                    "euler does not offer the formulation with that number|it offers baumgarte");
  o = good_options();
  o.integrator = baum_cvode_adams();
  o.step = (double)NAN;
  o.rtol = 1e-4;
  o.formulation = BAUM_FORMULATION_PROJECTION;
  check_run_refused(parts.mechanism, &o, BAUM_ERR_UNSUPPORTED,
                    "cvode_adams does not offer the formulation projection; it offers baumgarte, "
                    "unstabilized; CVODE projects only within BDF");
  o = good_options();
  o.gains.rule = 99;
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, "gains: rule 99 is unknown");
  baum_mechanism_destroy(parts.mechanism);
}

/* An integrator accepts the formulations that it offers and names them when it refuses another
 * formulation. */
static void check_pair(const baum_mechanism *mechanism, const baum_integrator *integrator,
                       baum_formulation formulation)
{
  baum_simulation_options o = good_options();
  o.integrator = integrator;
  o.formulation = formulation;
  if (!baum_integrator_has_fixed_step(integrator)) {
    o.step = (double)NAN;
    o.rtol = integrator == baum_kinematics() ? (double)NAN : 1e-4;
  }
  if (baum_integrator_offers(integrator, formulation)) {
    if (!every_element_suits(integrator)) {
      return;
    }
    baum_simulation *run = create_run(mechanism, &o);
    baum_simulation_destroy(run);
    return;
  }
  char message[256];
  (void)snprintf(message, sizeof message, "%s does not offer the formulation %s; it offers",
                 baum_integrator_name(integrator), baum_formulation_name(formulation));
  for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
    if (baum_integrator_offers(integrator, (baum_formulation)f)) {
      size_t used = strlen(message);
      (void)snprintf(message + used, sizeof message - used, "|%s",
                     baum_formulation_name((baum_formulation)f));
    }
  }
  check_run_refused(mechanism, &o, BAUM_ERR_UNSUPPORTED, message);
}

static void impossible_pairs_are_refused_with_what_is_offered(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  for (int32_t k = 0; baum_integrator_at(k) != NULL; k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      if (baum_integrator_has_fixed_step(integrator) || baum_has("sundials")) {
        check_pair(parts.mechanism, integrator, (baum_formulation)f);
      }
    }
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void integrators_that_are_not_built_in_refuse_by_name(void **state)
{
  (void)state;
  if (baum_has("sundials")) {
    skip();
  }
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = good_options();
  o.step = (double)NAN;
  o.rtol = 1e-6;
  const baum_integrator *absent[] = {baum_cvode_adams(), baum_cvode_bdf(), baum_ida()};
  for (int k = 0; k < 3; k++) {
    char message[128];
    (void)snprintf(message, sizeof message, "%s needs SUNDIALS, which this build does not have",
                   baum_integrator_name(absent[k]));
    o.integrator = absent[k];
    check_run_refused(parts.mechanism, &o, BAUM_ERR_UNSUPPORTED, message);
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- gains ---- */

static void gains_with_a_formulation_that_has_none_are_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = good_options();
  o.gains = baum_gains_fixed(5.0, 5.0);
  o.formulation = BAUM_FORMULATION_UNSTABILIZED;
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                    "gains are given, but the formulation unstabilized has none");
  o.formulation = BAUM_FORMULATION_PROJECTION;
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                    "gains are given, but the formulation projection has none");
  baum_mechanism_destroy(parts.mechanism);
}

static void gains_out_of_range_are_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = good_options();
  o.gains = baum_gains_fixed(-5.0, 5.0);
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                    "gains fixed: alpha is -5 1/s, must be");
  o.gains = baum_gains_fixed(5.0, (double)NAN);
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                    "gains fixed: beta is nan 1/s, must be");
  o.gains = baum_gains_scaled(0.5, -1.0);
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, "gains scaled: beta^2 h^2 is -1 [-]");
  o.gains = baum_gains_frequency(0.0, 1.0);
  check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, "gains frequency: frequency is 0 Hz");
  if (baum_has("sundials")) {
    o.integrator = baum_ida();
    o.step = (double)NAN;
    o.rtol = 1e-6;
    o.gains = baum_gains_taylor();
    o.formulation = BAUM_FORMULATION_BAUMGARTE;
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                      "gains taylor: the rule needs a fixed step|ida");
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void pairs_take_either_a_step_or_a_tolerance(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  const baum_integrator *const pairs[] = {baum_dp5(), baum_rk8()};
  for (int k = 0; k < 2; k++) {
    char message[128];
    baum_simulation_options o = good_options();
    o.integrator = pairs[k];
    (void)snprintf(message, sizeof message, "%s takes either step|or rtol|neither is given",
                   baum_integrator_name(pairs[k]));
    o.step = (double)NAN;
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, message);
    o.step = 1e-3;
    o.rtol = 1e-6;
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                      "takes either step|or rtol|both are given");
    o.rtol = (double)NAN;
    o.max_step = 0.1;
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, "max_step is 0.1|give step alone");
    o.max_step = (double)NAN;
    o.step = 0.0;
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT,
                      "step is 0 s, must be finite and > 0");
    o.step = (double)NAN;
    o.rtol = 1.0;
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, "rtol is 1, must be > 0 and < 1");
    o.rtol = 1e-6;
    o.max_step = 0.0;
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, "max_step is 0 s, must be > 0");
    o.max_step = (double)NAN;
    o.tolerance_v = 0.0;
    check_run_refused(parts.mechanism, &o, BAUM_ERR_ARGUMENT, "tolerance_v is 0, must be > 0");
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* Reads the pair of numbers after "nearest good pair: (" in the message. */
static void read_nearest(double good[2])
{
  const char *text = strstr(baum_message(), "nearest good pair: (");
  assert_non_null(text);
  char *end = NULL;
  good[0] = strtod(text + strlen("nearest good pair: ("), &end);
  good[1] = strtod(end + strlen(", "), NULL);
}

static void check_unstable(const baum_mechanism *mechanism, const baum_integrator *integrator,
                           double alpha_h, double beta2_h2, double most_phi)
{
  baum_simulation_options o = good_options();
  char message[160];
  double good[2];
  o.integrator = integrator;
  o.formulation = BAUM_FORMULATION_BAUMGARTE;
  o.gains = baum_gains_scaled(alpha_h, beta2_h2);
  (void)snprintf(message, sizeof message, "%s and h = 0.001 s|= (%.6g, %.6g)|spectral radius",
                 baum_integrator_name(integrator), alpha_h, beta2_h2);
  check_run_refused(mechanism, &o, BAUM_ERR_UNSTABLE, message);
  read_nearest(good);
  o.gains = baum_gains_scaled(good[0], good[1]);
  baum_simulation *run = create_run(mechanism, &o);
  assert_int_equal(baum_simulation_advance_to(run, 0.3), BAUM_OK);
  baum_counters counters = counters_of(run);
  assert_true(counters.max_phi < most_phi);
  baum_simulation_destroy(run);
}

static void unstable_gains_are_refused_and_the_nearest_good_pair_runs(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  check_unstable(parts.mechanism, baum_euler(), 0.5, 2.0, 1e-4);
  check_unstable(parts.mechanism, baum_euler(), 3.0, 0.5, 2.5e-4);
  check_unstable(parts.mechanism, baum_semi_implicit_euler(), 1.0, 1.0, 1.5e-4);
  check_unstable(parts.mechanism, baum_semi_implicit_euler(), 0.5, 4.0, 5e-6);
  check_unstable(parts.mechanism, baum_rk2(), 2.5, 6.25, 4e-5);
  check_unstable(parts.mechanism, baum_rk3(), 4.0, 4.0, 1.5e-5);
  check_unstable(parts.mechanism, baum_rk4(), 5.0, 25.0, 7e-5);
  baum_mechanism_destroy(parts.mechanism);
}

static void unstable_gains_run_when_allowed_and_warn(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = good_options();
  o.gains = baum_gains_scaled(0.5, 1.1);
  o.allow_unstable = true;
  baum_simulation *run = create_run(parts.mechanism, &o);
  baum_warning warning;
  assert_int_equal(baum_simulation_warning(run, 0, &warning, sizeof warning), BAUM_OK);
  assert_non_null(strstr(warning.text, "UNSTABLE"));
  ASSERT_SAYS(baum_simulation_step(run, 1), BAUM_WARNED, "1 new warning: |UNSTABLE");
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- targets ---- */

static baum_simulation *make_run(const every_element *parts)
{
  baum_simulation_options o = good_options();
  o.formulation = BAUM_FORMULATION_PROJECTION;
  baum_simulation *run = create_run(parts->mechanism, &o);
  assert_int_equal(baum_simulation_advance_to(run, 0.05), BAUM_OK);
  return run;
}

/* Time, q and v of a run, for comparison. */
typedef struct snapshot {
  double t;
  double q[EVERY_NQ];
  double v[EVERY_NV];
} snapshot;

static snapshot take(const baum_simulation *run)
{
  snapshot s = {.t = baum_simulation_time(run)};
  memcpy(s.q, baum_simulation_q(run), sizeof s.q);
  memcpy(s.v, baum_simulation_v(run), sizeof s.v);
  return s;
}

static void check_unchanged(const baum_simulation *run, const snapshot *before)
{
  snapshot now = take(run);
  assert_memory_equal(&now, before, sizeof now);
}

static void invalid_targets_are_refused_and_change_nothing(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation *run = make_run(&parts);
  snapshot before = take(run);
  ASSERT_SAYS(baum_simulation_advance_to(run, (double)NAN), BAUM_ERR_ARGUMENT,
              "baum_simulation_advance_to: t is nan s, must be finite");
  ASSERT_SAYS(baum_simulation_advance_to(run, (double)INFINITY), BAUM_ERR_ARGUMENT, "t is inf s");
  ASSERT_SAYS(baum_simulation_step(run, 0), BAUM_ERR_ARGUMENT,
              "baum_simulation_step: count is 0, must be > 0");
  ASSERT_SAYS(baum_simulation_step(run, -3), BAUM_ERR_ARGUMENT, "count is -3, must be > 0");
  check_unchanged(run, &before);
  assert_int_equal(baum_simulation_advance_to(run, before.t), BAUM_OK);
  check_unchanged(run, &before);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

static void sample_times_that_are_not_monotone_change_nothing(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation *run = make_run(&parts);
  snapshot before = take(run);
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  double rows[6] = {7.0, 7.0, 7.0, 7.0, 7.0, 7.0};
  int64_t done = 9;
  const double bad[][3] = {{0.05, 0.07, 0.06},
                           {0.04, 0.03, 0.05},
                           {0.06, 0.04, 0.03},
                           {0.06, (double)NAN, 0.08},
                           {0.06, 0.07, (double)INFINITY}};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    ASSERT_SAYS(baum_simulation_sample(run, bad[k], 3, &energy, 1, rows, &done), BAUM_ERR_ARGUMENT,
                "baum_simulation_sample: times[| s|must be finite and monotonic");
    assert_int_equal(done, 0);
    assert_true(rows[0] == 7.0);
  }
  ASSERT_SAYS(baum_simulation_sample(run, bad[0], -1, &energy, 1, rows, &done), BAUM_ERR_ARGUMENT,
              "n is negative");
  ASSERT_SAYS(baum_simulation_sample(run, NULL, 1, &energy, 1, rows, NULL), BAUM_ERR_ARGUMENT,
              "times or rows are NULL");
  ASSERT_SAYS(baum_simulation_sample(run, bad[0], 1, &energy, 1, NULL, NULL), BAUM_ERR_ARGUMENT,
              "times or rows are NULL");
  check_unchanged(run, &before);
  assert_int_equal(baum_simulation_sample(run, NULL, 0, &energy, 1, NULL, &done), BAUM_OK);
  check_unchanged(run, &before);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

static void an_invalid_state_is_refused_and_changes_nothing(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation *run = make_run(&parts);
  snapshot before = take(run);
  snapshot s = before;
  ASSERT_SAYS(baum_simulation_set_state(run, (double)NAN, s.q, s.v), BAUM_ERR_ARGUMENT,
              "baum_simulation_set_state: t is nan s");
  ASSERT_SAYS(baum_simulation_set_state(run, 0.0, NULL, s.v), BAUM_ERR_ARGUMENT, "q is NULL");
  ASSERT_SAYS(baum_simulation_set_state(run, 0.0, s.q, NULL), BAUM_ERR_ARGUMENT, "v is NULL");
  s.q[4] = (double)NAN;
  ASSERT_SAYS(baum_simulation_set_state(run, 0.0, s.q, s.v), BAUM_ERR_ARGUMENT, "q[4] is nan");
  s = before;
  s.v[5] = (double)INFINITY;
  ASSERT_SAYS(baum_simulation_set_state(run, 0.0, s.q, s.v), BAUM_ERR_ARGUMENT, "v[5] is inf");
  s = before;
  s.v[2] += 1.0; /* contradicts the motor's prescribed velocity */
  ASSERT_SAYS(baum_simulation_set_state(run, 0.05, s.q, s.v), BAUM_ERR_INCONSISTENT, "\"motor\"");
  assert_string_equal(baum_simulation_message(run), baum_message());
  check_unchanged(run, &before);
  assert_int_equal(baum_simulation_set_state(run, before.t, before.q, before.v), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(run, 0.06), BAUM_OK);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- channels ---- */

static void check_channel(baum_simulation *run, const every_element *parts, baum_channel bad,
                          const char *message)
{
  const baum_channel channels[2] = {baum_channel_of(BAUM_Q), bad};
  double row[4 * EVERY_NV];
  double t = baum_simulation_time(run) + 0.01;
  int64_t done = 9;
  row[0] = 7.0;
  assert_int_equal(baum_channels_width(parts->mechanism, channels, 2), -1);
  ASSERT_SAYS(BAUM_ERR_ARGUMENT, BAUM_ERR_ARGUMENT, message);
  ASSERT_SAYS(baum_simulation_get(run, channels, 2, row), BAUM_ERR_ARGUMENT, message);
  ASSERT_SAYS(baum_simulation_sample(run, &t, 1, channels, 2, row, &done), BAUM_ERR_ARGUMENT,
              message);
  assert_int_equal(done, 0);
  assert_true(row[0] == 7.0);
}

static baum_channel bad_coordinate(baum_joint_id joint, baum_joint_coordinate coordinate)
{
  baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, joint);
  channel.coordinate = coordinate;
  return channel;
}

static void channels_that_do_not_fit_are_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  every_element others = every_element_make(NULL);
  baum_simulation *run = make_run(&parts);
  snapshot before = take(run);
  const struct {
    baum_channel channel;
    const char *message;
  } bad[] = {
    {baum_channel_of((baum_quantity)0), "channel 1: quantity is not a baum_quantity"},
    {baum_channel_of((baum_quantity)15), "channel 1: quantity is not a baum_quantity"},
    {baum_channel_of(BAUM_BODY_POSE), "channel 1: body is none or not of this mechanism"},
    {baum_channel_of_body(BAUM_BODY_POSE, others.crank), "channel 1: body is none or not of"},
    {baum_channel_of_body(BAUM_BODY_VELOCITY, BAUM_GROUND), "channel 1: ground has no pose"},
    {baum_channel_of_point(BAUM_BODY_POSE, parts.bob, 0.1, 0.0, 0.0),
     "channel 1: point is given, but the body has no axes"},
    {baum_channel_of_joint(BAUM_PHI, others.pin), "channel 1: joint is not of this mechanism"},
    {baum_channel_of(BAUM_JOINT_REACTION), "channel 1: joint is none or not of this mechanism"},
    {baum_channel_of_joint(BAUM_JOINT_COORDINATE, parts.rod),
     "channel 1: joint is joint 2 \"rod\", a planar distance joint, which has no coordinate to "
     "record; all joints have BAUM_JOINT_REACTION, BAUM_LAMBDA, BAUM_PHI and BAUM_PHI_RATE"},
    {bad_coordinate(parts.sleeve, BAUM_COORDINATE_X),
     "channel 1: coordinate is \"x\", but joint 22 \"sleeve\", a spatial cylindrical joint, has "
     "\"displacement\", \"angle\""},
    {bad_coordinate(parts.pin, (baum_joint_coordinate)17),
     "channel 1: coordinate is \"unknown\", but joint 1 \"pin\", a planar revolute joint, has "
     "\"angle\""},
    {baum_channel_of_joint(BAUM_DRIVE_EFFORT, parts.pin), "\"pin\" is a planar|but only drivers"},
    {baum_channel_of(BAUM_DRIVE_EFFORT), "channel 1: joint is none or not of this mechanism"},
    {baum_channel_of_body(BAUM_BODY_ACCELERATION, BAUM_GROUND), "channel 1: ground has no pose"},
  };
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    check_channel(run, &parts, bad[k].channel, bad[k].message);
  }
  double row[12];
  const baum_channel account = baum_channel_of(BAUM_ENERGY_ACCOUNT);
  ASSERT_SAYS(baum_simulation_get(run, &account, 1, row), BAUM_ERR_STATE, "no energy account");
  ASSERT_SAYS(baum_simulation_get(run, NULL, 1, row), BAUM_ERR_ARGUMENT, "channels are NULL");
  ASSERT_SAYS(baum_simulation_get(run, NULL, -1, row), BAUM_ERR_ARGUMENT, "count is negative");
  assert_int_equal(baum_simulation_get(run, NULL, 0, NULL), BAUM_OK);
  const baum_channel all = baum_channel_of(BAUM_Q);
  ASSERT_SAYS(baum_simulation_get(run, &all, 1, NULL), BAUM_ERR_ARGUMENT, "row is NULL");
  check_unchanged(run, &before);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(others.mechanism);
}

static void a_point_of_a_channel_that_is_not_finite_is_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation *run = make_run(&parts);
  check_channel(run, &parts,
                baum_channel_of_point(BAUM_BODY_POSE, parts.crank, 0.0, (double)NAN, 0.0),
                "channel 1: point is (0, nan, 0) m, must be finite");
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_missing_integrator_is_refused_with_the_list),
    cmocka_unit_test(a_wrong_struct_size_or_null_is_refused),
    cmocka_unit_test(numbers_out_of_range_and_of_the_other_kind_are_refused),
    cmocka_unit_test(invalid_choices_are_refused),
    cmocka_unit_test(impossible_pairs_are_refused_with_what_is_offered),
    cmocka_unit_test(integrators_that_are_not_built_in_refuse_by_name),
    cmocka_unit_test(gains_with_a_formulation_that_has_none_are_refused),
    cmocka_unit_test(gains_out_of_range_are_refused),
    cmocka_unit_test(pairs_take_either_a_step_or_a_tolerance),
    cmocka_unit_test(unstable_gains_are_refused_and_the_nearest_good_pair_runs),
    cmocka_unit_test(unstable_gains_run_when_allowed_and_warn),
    cmocka_unit_test(invalid_targets_are_refused_and_change_nothing),
    cmocka_unit_test(sample_times_that_are_not_monotone_change_nothing),
    cmocka_unit_test(an_invalid_state_is_refused_and_changes_nothing),
    cmocka_unit_test(channels_that_do_not_fit_are_refused),
    cmocka_unit_test(a_point_of_a_channel_that_is_not_finite_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
