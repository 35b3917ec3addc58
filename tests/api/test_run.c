/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests advancing a run: steps, targets, samples, progress, cancelling, warnings, counters,
 * messages. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "every_element.h"
#include "message.h"
#include "runs.h"
#include "step_mode.h"

static const double STEP = 0.01;

/* A run and its mechanism. */
typedef struct scene {
  every_element parts;
  baum_simulation *run;
} scene;

static baum_simulation_options options_in(step_mode mode)
{
  return step_mode_options(mode, STEP, 1e-8);
}

/* Returns options with a fixed step if the integrator has one, otherwise with tolerances. */
static baum_simulation_options options_for(const baum_integrator *integrator)
{
  return options_in((step_mode){integrator, baum_integrator_has_fixed_step(integrator)});
}

static scene open_with(const baum_simulation_options *o)
{
  scene s = {.parts = every_element_make(NULL)};
  s.run = create_run(s.parts.mechanism, o);
  return s;
}

static scene open_scene(const baum_integrator *integrator)
{
  baum_simulation_options o = options_for(integrator);
  return open_with(&o);
}

static scene open_mode(step_mode mode)
{
  baum_simulation_options o = options_in(mode);
  return open_with(&o);
}

static void close_scene(scene *s)
{
  baum_simulation_destroy(s->run);
  baum_mechanism_destroy(s->parts.mechanism);
}

/* Returns the k-th integrator and kind of step that suit this mechanism and are in this build. */
static step_mode mode_at(int k)
{
  int i = 0;
  while (step_mode_at(i).integrator &&
         (!every_element_suits(step_mode_at(i).integrator) || k-- > 0)) {
    i++;
  }
  return step_mode_at(i);
}

/* Compares time, q and v bit for bit. */
static void check_same_state(const baum_simulation *a, const baum_simulation *b)
{
  assert_true(baum_simulation_time(a) == baum_simulation_time(b));
  assert_memory_equal(baum_simulation_q(a), baum_simulation_q(b), EVERY_NQ * sizeof(double));
  assert_memory_equal(baum_simulation_v(a), baum_simulation_v(b), EVERY_NV * sizeof(double));
}

/* ---- steps and targets ---- */

static void whole_steps_end_where_the_grid_says(void **state)
{
  (void)state;
  scene s = open_scene(baum_rk4());
  assert_int_equal(baum_simulation_step(s.run, 7), BAUM_OK);
  assert_true(baum_simulation_time(s.run) == 7 * STEP);
  assert_int_equal(baum_simulation_step(s.run, 1), BAUM_OK);
  assert_true(baum_simulation_time(s.run) == 8 * STEP);
  baum_counters counters = counters_of(s.run);
  assert_int_equal(counters.steps, 8);
  assert_int_equal(counters.short_steps, 0);
  close_scene(&s);
}

static void times_do_not_drift_however_many_steps(void **state)
{
  (void)state;
  baum_simulation_options o = options_for(baum_semi_implicit_euler());
  o.step = 0.001;
  o.start_time = 0.1;
  scene s = open_with(&o);
  assert_true(baum_simulation_step(s.run, 2000) >=
              BAUM_OK); /* the run is inaccurate and may warn */
  assert_true(baum_simulation_time(s.run) == 0.1 + 2000 * 0.001);
  close_scene(&s);
}

static void steps_in_one_call_or_many_are_the_same(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    scene a = open_mode(mode_at(k));
    scene b = open_mode(mode_at(k));
    assert_true(baum_simulation_step(a.run, 12) >= BAUM_OK);
    for (int i = 0; i < 12; i++) {
      assert_true(baum_simulation_step(b.run, 1) >= BAUM_OK);
    }
    check_same_state(a.run, b.run);
    assert_int_equal(counters_of(a.run).steps, 12);
    assert_int_equal(counters_of(b.run).steps, 12);
    close_scene(&a);
    close_scene(&b);
  }
}

static void a_target_on_the_grid_takes_whole_steps(void **state)
{
  (void)state;
  scene a = open_scene(baum_rk3());
  scene b = open_scene(baum_rk3());
  assert_int_equal(baum_simulation_advance_to(a.run, 0.07), BAUM_OK);
  assert_int_equal(baum_simulation_step(b.run, 7), BAUM_OK);
  check_same_state(a.run, b.run);
  assert_int_equal(counters_of(a.run).short_steps, 0);
  close_scene(&a);
  close_scene(&b);
}

static void a_target_off_the_grid_takes_one_short_step_and_begins_a_grid(void **state)
{
  (void)state;
  scene s = open_scene(baum_rk3());
  assert_int_equal(baum_simulation_advance_to(s.run, 0.0345), BAUM_OK);
  assert_true(baum_simulation_time(s.run) == 0.0345);
  baum_counters counters = counters_of(s.run);
  assert_int_equal(counters.steps, 4);
  assert_int_equal(counters.short_steps, 1);
  assert_int_equal(baum_simulation_step(s.run, 2), BAUM_OK);
  assert_true(baum_simulation_time(s.run) == 0.0345 + 2 * STEP);
  assert_int_equal(counters_of(s.run).short_steps, 1);
  close_scene(&s);
}

static void the_present_time_as_target_does_nothing(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    scene s = open_mode(mode_at(k));
    assert_true(baum_simulation_advance_to(s.run, 0.0) >= BAUM_OK);
    assert_true(baum_simulation_advance_to(s.run, 0.025) >= BAUM_OK);
    int64_t steps = counters_of(s.run).steps;
    assert_int_equal(baum_simulation_advance_to(s.run, 0.025), BAUM_OK);
    assert_int_equal(counters_of(s.run).steps, steps);
    close_scene(&s);
  }
}

/* Every target time is reached exactly. A run that goes forward and back again ends at its start,
 * except for the error of the method. */
static void a_run_forward_and_back_ends_near_its_start(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    baum_simulation_options o = options_in(mode_at(k));
    o.step = isnan(o.step) ? o.step : 1e-4;
    scene s = open_with(&o);
    double start[EVERY_NQ];
    memcpy(start, baum_simulation_q(s.run), sizeof start);
    assert_true(baum_simulation_advance_to(s.run, 0.05) >= BAUM_OK);
    assert_true(baum_simulation_advance_to(s.run, -0.05) >= BAUM_OK);
    assert_true(baum_simulation_time(s.run) == -0.05);
    assert_true(baum_simulation_advance_to(s.run, 0.0) >= BAUM_OK);
    assert_true(baum_simulation_time(s.run) == 0.0);
    for (int i = 0; i < EVERY_NQ; i++) {
      /* For h = 1e-4 and t = 0.2 s, the error of Euler's method, h |a| t, is about 1e-3. */
      ASSERT_NEAR(baum_simulation_q(s.run)[i], start[i], 0.0, 1e-3);
    }
    assert_true(counters_of(s.run).max_phi < 1e-3);
    close_scene(&s);
  }
}

static void targets_do_not_alter_the_steps_of_a_variable_step_method(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    if (mode_at(k).fixed) {
      continue;
    }
    scene a = open_mode(mode_at(k));
    scene b = open_mode(mode_at(k));
    assert_true(baum_simulation_advance_to(a.run, 0.2) >= BAUM_OK);
    for (int i = 1; i <= 100; i++) {
      assert_true(baum_simulation_advance_to(b.run, 0.002 * i) >= BAUM_OK);
    }
    assert_true(baum_simulation_advance_to(b.run, 0.2) >= BAUM_OK);
    check_same_state(a.run, b.run);
    assert_int_equal(counters_of(a.run).steps, counters_of(b.run).steps);
    close_scene(&a);
    close_scene(&b);
  }
}

static void max_steps_ends_a_call_and_the_next_goes_on(void **state)
{
  (void)state;
  baum_simulation_options o = options_for(baum_rk2());
  o.max_steps = 5;
  scene s = open_with(&o);
  ASSERT_SAYS(baum_simulation_advance_to(s.run, 0.08), BAUM_ERR_STEP,
              "t = 0.05 s: max_steps = 5 steps taken in one call; call again");
  assert_true(baum_simulation_time(s.run) == 5 * STEP);
  assert_int_equal(baum_simulation_advance_to(s.run, 0.08), BAUM_OK);
  close_scene(&s);
}

static void a_run_can_be_put_back_to_where_it_was(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    scene s = open_mode(mode_at(k));
    double q[EVERY_NQ];
    double v[EVERY_NV];
    assert_true(baum_simulation_advance_to(s.run, 0.05) >= BAUM_OK);
    memcpy(q, baum_simulation_q(s.run), sizeof q);
    memcpy(v, baum_simulation_v(s.run), sizeof v);
    assert_true(baum_simulation_advance_to(s.run, 0.08) >= BAUM_OK);
    assert_int_equal(baum_simulation_set_state(s.run, 0.05, q, v), BAUM_OK);
    assert_memory_equal(baum_simulation_q(s.run), q, sizeof q);
    assert_memory_equal(baum_simulation_v(s.run), v, sizeof v);
    close_scene(&s);
  }
}

static void a_state_can_be_set_and_the_run_goes_on_from_there(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    scene a = open_mode(mode_at(k));
    scene b = open_mode(mode_at(k));
    double q[EVERY_NQ];
    double v[EVERY_NV];
    memcpy(q, baum_simulation_q(a.run), sizeof q);
    memcpy(v, baum_simulation_v(a.run), sizeof v);
    assert_true(baum_simulation_advance_to(a.run, 0.043) >= BAUM_OK);
    assert_int_equal(baum_simulation_set_state(a.run, 0.0, q, v), BAUM_OK);
    assert_true(baum_simulation_time(a.run) == 0.0);
    assert_true(baum_simulation_advance_to(a.run, 0.1) >= BAUM_OK);
    assert_true(baum_simulation_advance_to(b.run, 0.1) >= BAUM_OK);
    for (int i = 0; i < EVERY_NQ; i++) {
      /* A state that is set is assembled, which changes it by rounding errors. */
      ASSERT_NEAR(baum_simulation_q(a.run)[i], baum_simulation_q(b.run)[i], 0.0, 1e-7);
    }
    close_scene(&a);
    close_scene(&b);
  }
}

/* ---- samples ---- */

enum { TIMES = 9 };

static void samples_off_the_grid_do_not_alter_the_motion(void **state)
{
  (void)state;
  const double off[TIMES] = {0.0, 0.003, 0.0101, 0.0255, 0.0256, 0.03, 0.047, 0.0699, 0.1};
  const baum_channel channel = baum_channel_of(BAUM_Q);
  double rows[TIMES * EVERY_NQ];
  int64_t done = 0;
  for (int k = 0; mode_at(k).integrator; k++) {
    scene a = open_mode(mode_at(k));
    scene b = open_mode(mode_at(k));
    assert_true(baum_simulation_advance_to(a.run, 0.1) >= BAUM_OK);
    assert_true(baum_simulation_sample(b.run, off, TIMES, &channel, 1, rows, &done) >= BAUM_OK);
    assert_int_equal(done, TIMES);
    check_same_state(a.run, b.run);
    assert_memory_equal(rows + (TIMES - 1) * EVERY_NQ, baum_simulation_q(a.run),
                        EVERY_NV * sizeof(double));
    assert_int_equal(counters_of(a.run).steps, counters_of(b.run).steps);
    assert_int_equal(counters_of(b.run).short_steps, 0);
    close_scene(&a);
    close_scene(&b);
  }
}

static void a_sample_equals_the_state_after_advancing_to_its_time(void **state)
{
  (void)state;
  const double times[3] = {0.0134, 0.0345, 0.06};
  const baum_channel channel = baum_channel_of(BAUM_Q);
  double rows[3 * EVERY_NQ];
  for (int k = 0; mode_at(k).integrator; k++) {
    scene a = open_mode(mode_at(k));
    scene b = open_mode(mode_at(k));
    assert_true(baum_simulation_sample(a.run, times, 3, &channel, 1, rows, NULL) >= BAUM_OK);
    assert_true(baum_simulation_advance_to(b.run, times[0]) >= BAUM_OK);
    assert_memory_equal(rows, baum_simulation_q(b.run), EVERY_NQ * sizeof(double));
    close_scene(&a);
    close_scene(&b);
  }
}

static void samples_backward_and_at_the_present_time_are_fine(void **state)
{
  (void)state;
  const double times[4] = {0.0, 0.0, -0.015, -0.02};
  const baum_channel channel = baum_channel_of(BAUM_ENERGY);
  double rows[8];
  for (int k = 0; mode_at(k).integrator; k++) {
    scene s = open_mode(mode_at(k));
    assert_true(baum_simulation_sample(s.run, times, 4, &channel, 1, rows, NULL) >= BAUM_OK);
    assert_true(baum_simulation_time(s.run) == -0.02);
    assert_memory_equal(rows, rows + 2, 2 * sizeof *rows);
    close_scene(&s);
  }
}

/* ---- channels ---- */

static void channels_agree_with_each_other(void **state)
{
  (void)state;
  scene s = open_scene(baum_rk4());
  assert_int_equal(baum_simulation_advance_to(s.run, 0.05), BAUM_OK);
  const baum_channel channels[] = {
    baum_channel_of(BAUM_Q),
    baum_channel_of_point(BAUM_BODY_POSE, s.parts.crank, 0.05, 0.0, 0.0),
    baum_channel_of_body(BAUM_BODY_VELOCITY, s.parts.crank),
    baum_channel_of_joint(BAUM_JOINT_COORDINATE, s.parts.pin),
    baum_channel_of(BAUM_PHI),
    baum_channel_of_joint(BAUM_PHI, s.parts.motor),
    baum_channel_of_body(BAUM_BODY_POSE, s.parts.masses),
  };
  enum { COUNT = sizeof channels / sizeof *channels };
  double row[EVERY_NQ + 3 + 3 + 2 + EVERY_NC + 1 + 2];
  assert_int_equal(baum_channels_width(s.parts.mechanism, channels, COUNT),
                   (int)(sizeof row / sizeof *row));
  assert_int_equal(baum_simulation_get(s.run, channels, COUNT, row), BAUM_OK);
  const double *q = row;
  const double *tip = q + EVERY_NQ;
  const double *rate = tip + 3;
  const double *coordinate = rate + 3;
  const double *phi = coordinate + 2;
  assert_memory_equal(q, baum_simulation_q(s.run), EVERY_NQ * sizeof *q);
  ASSERT_NEAR(tip[0], q[0] + 0.05 * cos(q[2]), 1e-14, 0.0);
  ASSERT_NEAR(tip[1], q[1] + 0.05 * sin(q[2]), 1e-14, 0.0);
  assert_memory_equal(rate, baum_simulation_v(s.run), 3 * sizeof *rate);
  ASSERT_NEAR(coordinate[0], q[2], 1e-14, 0.0);
  ASSERT_NEAR(coordinate[1], rate[2], 1e-14, 0.0);
  assert_true(phi[8] == phi[EVERY_NC]);
  assert_memory_equal(phi + EVERY_NC + 1, q + 11, 2 * sizeof *q);
  close_scene(&s);
}

/* ---- progress and cancelling ---- */

typedef struct progress_log {
  int calls;
  int cancel_at; /* the call that cancels, or 0 if none does */
  double last;
  const baum_simulation *run;
} progress_log;

static int log_progress(const baum_simulation *run, double t, void *user)
{
  progress_log *log = user;
  log->calls++;
  log->last = t;
  log->run = run;
  assert_true(t == baum_simulation_time(run));
  return log->calls == log->cancel_at ? 1 : 0;
}

static scene open_with_progress(progress_log *log, double interval)
{
  baum_simulation_options o = options_for(baum_rk4());
  o.progress = log_progress;
  o.progress_interval = interval;
  o.user = log;
  return open_with(&o);
}

static void progress_is_called_by_wall_time(void **state)
{
  (void)state;
  progress_log every_step = {.calls = 0};
  progress_log never = {.calls = 0};
  scene a = open_with_progress(&every_step, 0.0);
  scene b = open_with_progress(&never, 3600.0);
  assert_int_equal(baum_simulation_advance_to(a.run, 0.1), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(b.run, 0.1), BAUM_OK);
  assert_int_equal(every_step.calls, 10);
  assert_ptr_equal(every_step.run, a.run);
  assert_int_equal(never.calls, 0);
  check_same_state(a.run, b.run);
  ASSERT_SAYS(baum_simulation_set_progress_interval(b.run, -1.0), BAUM_ERR_ARGUMENT,
              "interval is -1 s, must be finite and >= 0");
  ASSERT_SAYS(baum_simulation_set_progress_interval(b.run, (double)INFINITY), BAUM_ERR_ARGUMENT,
              "interval is inf s");
  assert_int_equal(baum_simulation_set_progress_interval(b.run, 0.0), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(b.run, 0.2), BAUM_OK);
  assert_int_equal(never.calls, 10);
  close_scene(&a);
  close_scene(&b);
}

static void progress_can_cancel_and_the_next_call_goes_on(void **state)
{
  (void)state;
  progress_log log = {.cancel_at = 4};
  scene s = open_with_progress(&log, 0.0);
  ASSERT_SAYS(baum_simulation_advance_to(s.run, 0.1), BAUM_STOP_CANCELLED, "t = 0.03 s: cancelled");
  assert_string_equal(baum_simulation_message(s.run), baum_message());
  assert_true(baum_simulation_time(s.run) == 3 * STEP);
  assert_int_equal(baum_simulation_advance_to(s.run, 0.1), BAUM_OK);
  close_scene(&s);
}

static void cancelling_before_a_call_stops_that_call_only(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    scene a = open_mode(mode_at(k));
    scene b = open_mode(mode_at(k));
    baum_simulation_cancel(a.run);
    ASSERT_SAYS(baum_simulation_advance_to(a.run, 0.1), BAUM_STOP_CANCELLED, "t = 0 s: cancelled");
    assert_true(baum_simulation_time(a.run) == 0.0);
    assert_true(baum_simulation_advance_to(a.run, 0.1) >= BAUM_OK);
    assert_true(baum_simulation_advance_to(b.run, 0.1) >= BAUM_OK);
    check_same_state(a.run, b.run);
    close_scene(&a);
    close_scene(&b);
  }
}

/* ---- warnings, messages, counters ---- */

static void warnings_are_announced_once_and_stay_listed(void **state)
{
  (void)state;
  baum_simulation_options o = options_for(baum_euler());
  o.gains = baum_gains_taylor();
  scene s = open_with(&o);
  baum_warning warning;
  assert_int_equal(counters_of(s.run).warnings, 1);
  assert_int_equal(counters_of(s.run).doubts, 0);
  assert_int_equal(baum_simulation_warning(s.run, 0, &warning, sizeof warning), BAUM_OK);
  assert_int_equal(warning.code, BAUM_WARNING_GAINS);
  assert_int_equal(warning.count, 1);
  assert_false(warning.doubts_motion);
  assert_non_null(strstr(warning.text, "marginal"));
  ASSERT_SAYS(baum_simulation_warning(s.run, 1, &warning, sizeof warning), BAUM_ERR_ARGUMENT,
              "k is 1, must be from 0 to 0");
  ASSERT_SAYS(baum_simulation_step(s.run, 1), BAUM_WARNED, "t = 0.01 s: 1 new warning: ");
  assert_non_null(strstr(baum_message(), "marginal"));
  assert_int_equal(baum_simulation_step(s.run, 1), BAUM_OK);
  assert_int_equal(counters_of(s.run).warnings, 1);
  close_scene(&s);
}

static void a_run_explains_itself(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    if (!baum_integrator_offers(mode_at(k).integrator, BAUM_FORMULATION_BAUMGARTE)) {
      continue;
    }
    baum_simulation_options o = options_in(mode_at(k));
    o.formulation = BAUM_FORMULATION_BAUMGARTE;
    o.gains = baum_gains_fixed(4.5, 5.5);
    scene s = open_with(&o);
    const char *text = baum_simulation_explain(s.run);
    assert_non_null(strstr(text, baum_integrator_name(o.integrator)));
    assert_non_null(strstr(text, "baumgarte"));
    assert_non_null(strstr(text, "alpha 4.5 1/s, beta 5.5 1/s"));
    assert_non_null(strstr(text, isnan(o.step) ? "rtol 1e-08" : "fixed step 0.01 s"));
    assert_non_null(strstr(text, "klu"));
    assert_non_null(strstr(text, "degrees of freedom 23 of velocity, 27 of position"));
    close_scene(&s);
  }
}

static void counters_fit_what_was_done(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    if (!baum_integrator_offers(mode_at(k).integrator, BAUM_FORMULATION_BAUMGARTE)) {
      continue;
    }
    baum_simulation_options o = options_in(mode_at(k));
    o.formulation = BAUM_FORMULATION_BAUMGARTE;
    o.gains = baum_gains_fixed(4.5, 5.5);
    scene s = open_with(&o);
    baum_counters before = counters_of(s.run);
    assert_int_equal(before.steps, 0);
    assert_true(before.wall == 0.0);
    assert_true(baum_simulation_advance_to(s.run, 0.1) >= BAUM_OK);
    baum_counters c = counters_of(s.run);
    assert_int_equal(c.struct_size, sizeof c);
    assert_true(c.steps >= (mode_at(k).fixed ? 10 : 1));
    assert_true(c.evaluations - before.evaluations >= c.steps);
    assert_true(c.factorizations >= c.full_factorizations);
    assert_true(c.wall > 0.0);
    assert_true(c.max_phi > 0.0 && c.max_phi < 1e-2);
    assert_true(c.max_phi_rate > 0.0 && c.max_phi_rate < 1.0);
    assert_non_null(baum_mechanism_joint_name(s.parts.mechanism, c.max_phi_joint));
    assert_non_null(baum_mechanism_joint_name(s.parts.mechanism, c.max_phi_rate_joint));
    assert_true(c.alpha == 4.5 && c.beta == 5.5);
    assert_true(isfinite(c.energy_change));
    assert_int_equal(c.restarts, 0);
    assert_int_equal(c.near_singular, 0);
    close_scene(&s);
  }
}

static void evaluations_of_a_fixed_step_method_are_its_stages(void **state)
{
  (void)state;
  const struct {
    const baum_integrator *integrator;
    int64_t stages;
  } rows[] = {{baum_euler(), 1}, {baum_semi_implicit_euler(), 1},
              {baum_rk2(), 2},   {baum_rk3(), 3},
              {baum_rk4(), 4},   {baum_dp5(), 6},
              {baum_rk8(), 12}};
  for (int k = 0; k < 7; k++) {
    scene s = open_scene(rows[k].integrator);
    int64_t before = counters_of(s.run).evaluations;
    assert_true(baum_simulation_step(s.run, 20) >= BAUM_OK);
    assert_int_equal(counters_of(s.run).evaluations - before, 20 * rows[k].stages);
    close_scene(&s);
  }
}

static void reversing_restarts_multistep_methods_only(void **state)
{
  (void)state;
  for (int k = 0; mode_at(k).integrator; k++) {
    scene s = open_mode(mode_at(k));
    assert_true(baum_simulation_advance_to(s.run, 0.03) >= BAUM_OK);
    assert_true(baum_simulation_advance_to(s.run, 0.01) >= BAUM_OK);
    assert_true(baum_simulation_advance_to(s.run, 0.0) >= BAUM_OK);
    const char *name = baum_integrator_name(mode_at(k).integrator);
    bool multistep =
      !mode_at(k).fixed || strncmp(name, "ab", 2) == 0 || strcmp(name, "generalized_alpha") == 0;
    assert_int_equal(counters_of(s.run).restarts, multistep ? 1 : 0);
    close_scene(&s);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(whole_steps_end_where_the_grid_says),
    cmocka_unit_test(times_do_not_drift_however_many_steps),
    cmocka_unit_test(steps_in_one_call_or_many_are_the_same),
    cmocka_unit_test(a_target_on_the_grid_takes_whole_steps),
    cmocka_unit_test(a_target_off_the_grid_takes_one_short_step_and_begins_a_grid),
    cmocka_unit_test(the_present_time_as_target_does_nothing),
    cmocka_unit_test(a_run_forward_and_back_ends_near_its_start),
    cmocka_unit_test(targets_do_not_alter_the_steps_of_a_variable_step_method),
    cmocka_unit_test(max_steps_ends_a_call_and_the_next_goes_on),
    cmocka_unit_test(a_run_can_be_put_back_to_where_it_was),
    cmocka_unit_test(a_state_can_be_set_and_the_run_goes_on_from_there),
    cmocka_unit_test(samples_off_the_grid_do_not_alter_the_motion),
    cmocka_unit_test(a_sample_equals_the_state_after_advancing_to_its_time),
    cmocka_unit_test(samples_backward_and_at_the_present_time_are_fine),
    cmocka_unit_test(channels_agree_with_each_other),
    cmocka_unit_test(progress_is_called_by_wall_time),
    cmocka_unit_test(progress_can_cancel_and_the_next_call_goes_on),
    cmocka_unit_test(cancelling_before_a_call_stops_that_call_only),
    cmocka_unit_test(warnings_are_announced_once_and_stay_listed),
    cmocka_unit_test(a_run_explains_itself),
    cmocka_unit_test(counters_fit_what_was_done),
    cmocka_unit_test(evaluations_of_a_fixed_step_method_are_its_stages),
    cmocka_unit_test(reversing_restarts_multistep_methods_only),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
