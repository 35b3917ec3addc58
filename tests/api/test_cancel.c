/* SPDX-License-Identifier: BSD-3-Clause */
/* A run, a sampling or a study may be cancelled at any step. It must stop at this step. If it is
 * then continued, its result must be the same, to the last bit, as without cancelling. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "driven.h"
#include "message.h"
#include "models.h"
#include "runs.h"
#include "spatial_scenes.h"
#include "step_mode.h"
#include "study_entries.h"

enum { NQ_MOST = 24, MOST_STEPS = 400, SAMPLES = 7 };
static const double END = 0.3; /* [s] */

/* Cancels a run in a call of the progress function, namely the one in which `left` reaches 0. */
typedef struct cancelling {
  int left;
  bool by_flag; /* whether to cancel by the flag of the run instead of by the return value */
  baum_simulation *run;
} cancelling;

static int count_down(const baum_simulation *run, double t, void *user)
{
  cancelling *c = user;
  (void)run;
  (void)t;
  bool now = c->left > 0 && --c->left == 0;
  if (now && c->by_flag) {
    baum_simulation_cancel(c->run);
  }
  return now && !c->by_flag;
}

static baum_simulation *start(const baum_mechanism *m, const baum_simulation_options *given,
                              cancelling *c)
{
  baum_simulation_options o = *given;
  o.progress = count_down;
  o.progress_interval = 0.0;
  o.user = c;
  c->run = create_run(m, &o);
  return c->run;
}

typedef struct state {
  double t;
  double q[NQ_MOST];
  double v[NQ_MOST];
} state;

static state state_of(const baum_mechanism *m, const baum_simulation *run)
{
  state s;
  int32_t nq = 0;
  int32_t nv = 0;
  memset(&s, 0, sizeof s);
  check(baum_mechanism_sizes(m, &nq, &nv, NULL));
  assert_in_range(nq, 1, NQ_MOST);
  s.t = baum_simulation_time(run);
  memcpy(s.q, baum_simulation_q(run), (size_t)nq * sizeof(double));
  memcpy(s.v, baum_simulation_v(run), (size_t)nv * sizeof(double));
  return s;
}

/* ---- advancing ---- */

/* Cancels a run at step k and continues it. Returns false if the run has fewer steps. */
static bool cancel_at(const baum_mechanism *m, const baum_simulation_options *o, int k,
                      const state *want)
{
  cancelling c = {.left = k, .by_flag = k % 2 == 0};
  baum_simulation *run = start(m, o, &c);
  baum_status status = baum_simulation_advance_to(run, END);
  bool cancelled = status == BAUM_STOP_CANCELLED;
  check(status);
  if (cancelled) {
    assert_true(baum_simulation_time(run) < END);
    check(baum_simulation_advance_to(run, END));
  }
  const state end = state_of(m, run);
  assert_memory_equal(&end, want, sizeof end);
  baum_simulation_destroy(run);
  return cancelled;
}

static void cancel_everywhere(const baum_mechanism *m, const baum_simulation_options *o)
{
  cancelling never = {.left = 0};
  baum_simulation *run = start(m, o, &never);
  check(baum_simulation_advance_to(run, END));
  const state want = state_of(m, run);
  baum_simulation_destroy(run);
  int steps = 0;
  while (cancel_at(m, o, steps + 1, &want)) {
    assert_in_range(++steps, 1, MOST_STEPS);
  }
  /* rk8 takes the longest steps, which are a sixteenth of the period. */
  assert_true(steps >= 5);
}

static void a_cancelled_run_of_rattle_in_space_continues(void **unused)
{
  (void)unused;
  baum_mechanism *m = spatial_make_rssr();
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rattle();
  o.step = 0.02;
  cancel_everywhere(m, &o);
  baum_mechanism_destroy(m);
}

static void a_cancelled_run_continues_as_if_it_had_not_been_cancelled(void **unused)
{
  (void)unused;
  model pendulum;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum), BAUM_OK);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    step_mode mode = step_mode_at(i);
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      if (baum_integrator_offers(mode.integrator, (baum_formulation)f)) {
        double rtol = f == BAUM_FORMULATION_INDEX3 ? 1e-4 : 1e-6;
        baum_simulation_options o = step_mode_options(mode, 0.02, rtol);
        o.formulation = (baum_formulation)f;
        o.max_step = mode.fixed ? (double)NAN : 0.03;
        cancel_everywhere(pendulum.mechanism, &o);
      }
    }
  }
  model_destroy(&pendulum);
}

static void cancelled_kinematics_continue_as_if_not_cancelled(void **unused)
{
  (void)unused;
  const drive motor = {.angle = 0.4, .rate = 1.0};
  baum_mechanism *four_bar = four_bar_make(&motor);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  o.max_step = 0.03;
  cancel_everywhere(four_bar, &o);
  baum_mechanism_destroy(four_bar);
}

/* ---- cancelling by a user function ---- */

/* How often the law has been called, and in which call it cancels. */
typedef struct caller {
  int calls;
  int last;
  baum_simulation *run;
} caller;

static int turn_and_cancel(double t, double s[3], void *user)
{
  caller *c = user;
  s[0] = 0.4 + t;
  s[1] = 1.0;
  s[2] = 0.0;
  if (++c->calls == c->last) {
    baum_simulation_cancel(c->run);
  }
  return 0;
}

/* The law cancels in its last call, which is at the end of the run. No step that could be cancelled
 * follows. */
static void cancelling_in_the_last_step_does_not_cancel_the_next_call(void **unused)
{
  (void)unused;
  caller c = {0};
  const drive motor = {.angle = 0.4, .law = turn_and_cancel, .user = &c};
  baum_mechanism *four_bar = four_bar_make(&motor);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  o.max_step = 0.03;
  for (int round = 0; round < 2; round++) {
    c.last = c.calls;
    c.calls = 0;
    c.run = create_run(four_bar, &o);
    assert_int_equal(baum_simulation_advance_to(c.run, END), BAUM_OK);
    if (round == 1) {
      assert_int_equal(c.calls, c.last);
      assert_int_equal(baum_simulation_advance_to(c.run, 2.0 * END), BAUM_OK);
    }
    baum_simulation_destroy(c.run);
  }
  baum_mechanism_destroy(four_bar);
}

/* ---- sampling ---- */

/* Samples positions and energies. If a call is cancelled or its time limit passes, the function
 * makes another call for the remaining samples. */
static void sample(baum_simulation *run, double rows[SAMPLES][4])
{
  const baum_channel channels[] = {baum_channel_of(BAUM_Q), baum_channel_of(BAUM_ENERGY)};
  double times[SAMPLES];
  int64_t first = 0;
  baum_status status = BAUM_STOP_CANCELLED;
  for (int k = 0; k < SAMPLES; k++) {
    times[k] = (k + 1) * END / (SAMPLES + 0.5);
  }
  while (status == BAUM_STOP_CANCELLED || status == BAUM_STOP_TIME) {
    int64_t done = 0;
    status =
      baum_simulation_sample(run, times + first, SAMPLES - first, channels, 2, rows[first], &done);
    check(status);
    first += done;
  }
  assert_int_equal(first, SAMPLES);
}

static void samples_are_the_same_wherever_they_were_cancelled(void **unused)
{
  (void)unused;
  model pendulum;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum), BAUM_OK);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    double want[SAMPLES][4];
    double got[SAMPLES][4];
    const baum_simulation_options o = step_mode_options(step_mode_at(i), 0.02, 1e-6);
    for (int k = 0; k < 20; k++) {
      cancelling c = {.left = k, .by_flag = false};
      baum_simulation *run = start(pendulum.mechanism, &o, &c);
      sample(run, k == 0 ? want : got);
      baum_simulation_destroy(run);
      if (k > 0) {
        assert_memory_equal(got, want, sizeof want);
      }
    }
  }
  model_destroy(&pendulum);
}

/* ---- studies ---- */

static int cancel_study(const baum_study *study, int32_t done, int32_t total, void *user)
{
  int *left = user;
  (void)study;
  (void)done;
  (void)total;
  return *left > 0 && --*left == 0;
}

static baum_study *study_of(const baum_mechanism *m, int *left)
{
  baum_study *study = NULL;
  baum_study_options o = small_study_options();
  o.progress = cancel_study;
  o.user = left;
  check(baum_study_create(m, 0.0, 0.1, &study));
  check(baum_study_set_options(study, &o));
  for (int k = 0; k < 4; k++) {
    const step_mode mode = {k % 2 == 0 ? baum_rk4() : baum_rk8(), k % 2 == 0};
    const baum_simulation_options run = step_mode_options(mode, 0.01 / (k + 1), 1e-4 / (k + 1));
    check(baum_study_add(study, &run));
  }
  return study;
}

/* All three samples are inside a step that has already been taken. */
static void samples_that_need_no_step_are_cancelled(void **unused)
{
  (void)unused;
  model m;
  check(model_chain_3(&m));
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk8();
  o.rtol = 1e-6;
  baum_simulation *run = create_run(m.mechanism, &o);
  check(baum_simulation_advance_to(run, 1e-6));
  const double times[3] = {2e-6, 3e-6, 4e-6};
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  double rows[3 * 2];
  int64_t done = -1;
  baum_simulation_cancel(run);
  assert_int_equal(baum_simulation_sample(run, times, 3, &energy, 1, rows, &done),
                   BAUM_STOP_CANCELLED);
  assert_int_equal(done, 0);
  check(baum_simulation_sample(run, times, 3, &energy, 1, rows, &done));
  assert_int_equal(done, 3);
  baum_simulation_destroy(run);
  model_destroy(&m);
}

static void a_request_stops_the_next_call_even_if_it_needs_no_step(void **unused)
{
  (void)unused;
  model m;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &m), BAUM_OK);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    const baum_simulation_options o = step_mode_options(step_mode_at(i), 0.02, 1e-6);
    baum_simulation *run = create_run(m.mechanism, &o);
    check(baum_simulation_step(run, 3));
    double t = baum_simulation_time(run);
    baum_simulation_cancel(run);
    assert_int_equal(baum_simulation_advance_to(run, t), BAUM_STOP_CANCELLED);
    assert_int_equal(baum_simulation_advance_to(run, t), BAUM_OK);
    baum_simulation_cancel(run);
    assert_int_equal(baum_simulation_sample(run, NULL, 0, NULL, 0, NULL, NULL),
                     BAUM_STOP_CANCELLED);
    check(baum_simulation_advance_to(run, t + 0.1));
    baum_simulation_destroy(run);
  }
  model_destroy(&m);
}

static void a_study_goes_on_to_the_same_entries(void **unused)
{
  (void)unused;
  model pendulum;
  int left = 0;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum), BAUM_OK);
  baum_study *want = study_of(pendulum.mechanism, &left);
  assert_int_equal(baum_study_run(want), BAUM_OK);
  baum_status status = BAUM_STOP_CANCELLED;
  int k = 1;
  for (; status == BAUM_STOP_CANCELLED; k++) {
    left = k;
    baum_study *got = study_of(pendulum.mechanism, &left);
    status = baum_study_run(got);
    assert_int_equal(baum_study_run(got), BAUM_OK);
    assert_same_entries(got, want);
    baum_study_destroy(got);
  }
  assert_true(k > 2 * 4); /* there are four entries, and each of them is measured and then timed */
  baum_study_destroy(want);
  model_destroy(&pendulum);
}

static void entries_are_not_added_by_a_study_that_is_cancelled(void **unused)
{
  (void)unused;
  model pendulum;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum), BAUM_OK);
  baum_study *study = NULL;
  check(baum_study_create(pendulum.mechanism, 0.0, 1000.0, &study));
  baum_study_cancel(study);
  assert_int_equal(baum_study_add_standard(study, NULL), BAUM_STOP_CANCELLED);
  assert_int_equal(baum_study_entry_count(study), 0);
  assert_int_equal(baum_study_add_standard(study, NULL), BAUM_OK);
  assert_true(baum_study_entry_count(study) > 0);
  baum_study_destroy(study);
  model_destroy(&pendulum);
}

/* ---- time limits ---- */

static void limit_time(baum_simulation *run)
{
  assert_int_equal(baum_simulation_set_time_limit(run, 1e-12), BAUM_OK);
}

static baum_counters counters_except_wall(baum_simulation *run)
{
  baum_counters out = counters_of(run);
  out.wall = 0.0;
  return out;
}

/* Every call ends after one step. */
static void advance_within_limits(const baum_mechanism *m, const baum_simulation_options *o)
{
  baum_simulation *run = start(m, o, &(cancelling){.left = 0});
  baum_simulation *limited = start(m, o, &(cancelling){.left = 0});
  limit_time(limited);
  int calls = 1;
  while (baum_simulation_advance_to(limited, END) == BAUM_STOP_TIME) {
    assert_string_equal(baum_simulation_message(limited), "");
    calls++;
  }
  check(baum_simulation_advance_to(run, END));
  const state want = state_of(m, run);
  const state got = state_of(m, limited);
  const baum_counters work = counters_except_wall(run);
  const baum_counters same = counters_except_wall(limited);
  assert_memory_equal(&got, &want, sizeof want);
  assert_memory_equal(&same, &work, sizeof work);
  assert_in_range(calls, work.steps, work.steps + 1);
  baum_simulation_destroy(run);
  baum_simulation_destroy(limited);
}

static void time_limits_change_neither_motion_nor_counters(void **unused)
{
  (void)unused;
  model pendulum;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum), BAUM_OK);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    baum_simulation_options o = step_mode_options(step_mode_at(i), 0.02, 1e-6);
    advance_within_limits(pendulum.mechanism, &o);
    o.error_check = true;
    advance_within_limits(pendulum.mechanism, &o);
  }
  model_destroy(&pendulum);
}

static void samples_do_not_depend_on_time_limits(void **unused)
{
  (void)unused;
  model pendulum;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum), BAUM_OK);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    double want[SAMPLES][4];
    double got[SAMPLES][4];
    const baum_simulation_options o = step_mode_options(step_mode_at(i), 0.02, 1e-6);
    baum_simulation *run = start(pendulum.mechanism, &o, &(cancelling){.left = 0});
    baum_simulation *limited = start(pendulum.mechanism, &o, &(cancelling){.left = 0});
    limit_time(limited);
    sample(run, want);
    sample(limited, got);
    assert_memory_equal(got, want, sizeof want);
    baum_simulation_destroy(run);
    baum_simulation_destroy(limited);
  }
  model_destroy(&pendulum);
}

static void time_limits_are_checked(void **unused)
{
  (void)unused;
  model pendulum;
  assert_int_equal(model_pendulum_rod(&MODEL_PENDULUM_A01, &pendulum), BAUM_OK);
  baum_simulation_options o = step_mode_options(step_mode_at(0), 0.02, 1e-6);
  baum_simulation *run = start(pendulum.mechanism, &o, &(cancelling){.left = 0});
  ASSERT_SAYS(baum_simulation_set_time_limit(run, 0.0), BAUM_ERR_ARGUMENT,
              "limit is 0 s, must be > 0");
  limit_time(run);
  ASSERT_SAYS(baum_simulation_advance_to(run, END), BAUM_STOP_TIME,
              "t = 0.02 s: the time limit of the call, 1e-12 s, has passed");
  assert_int_equal(baum_simulation_set_time_limit(run, (double)INFINITY), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(run, END), BAUM_OK);
  baum_simulation_destroy(run);
  model_destroy(&pendulum);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_cancelled_run_continues_as_if_it_had_not_been_cancelled),
    cmocka_unit_test(a_cancelled_run_of_rattle_in_space_continues),
    cmocka_unit_test(cancelled_kinematics_continue_as_if_not_cancelled),
    cmocka_unit_test(cancelling_in_the_last_step_does_not_cancel_the_next_call),
    cmocka_unit_test(samples_are_the_same_wherever_they_were_cancelled),
    cmocka_unit_test(samples_that_need_no_step_are_cancelled),
    cmocka_unit_test(a_request_stops_the_next_call_even_if_it_needs_no_step),
    cmocka_unit_test(time_limits_change_neither_motion_nor_counters),
    cmocka_unit_test(samples_do_not_depend_on_time_limits),
    cmocka_unit_test(time_limits_are_checked),
    cmocka_unit_test(a_study_goes_on_to_the_same_entries),
    cmocka_unit_test(entries_are_not_added_by_a_study_that_is_cancelled),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
