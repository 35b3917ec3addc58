/* SPDX-License-Identifier: BSD-3-Clause */
/* User functions of every kind fail, return NaN, or call the library. If a function fails, the
 * message must name it. The run must stay at its last good step, and must then continue as if
 * nothing had happened. Calls that a user function may not make must be refused. The motion must
 * stay the same to the last bit. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "asked.h"
#include "check.h"
#include "message.h"
#include "runs.h"
#include "step_mode.h"

enum { GOOD = 5, STEPS = 10, BYTES = 1 << 16 };

static baum_simulation *start(asked *b, step_mode mode)
{
  baum_simulation_options o = step_mode_options(mode, 1e-3, 1e-6);
  baum_event_def event = baum_event_def_default();
  o.energy_account = true;
  o.progress = asked_progress;
  o.progress_interval = 0.0;
  o.user = b;
  baum_simulation *run = create_run(b->mechanism, &o);
  event.name = "gate";
  event.function = asked_gate;
  event.user = b;
  check(baum_simulation_add_event(run, &event, NULL));
  return run;
}

/* Reads the energies, for which potentials are evaluated, and then takes steps. */
static baum_status go(baum_simulation *run, int64_t steps)
{
  double energies[2];
  const baum_channel channel = baum_channel_of(BAUM_ENERGY);
  baum_status status = baum_simulation_get(run, &channel, 1, energies);
  return status < BAUM_OK ? status : baum_simulation_step(run, steps);
}

typedef struct state {
  double t;
  double q[ASKED_NV];
  double v[ASKED_NV];
} state;

static state state_of(const baum_simulation *run)
{
  state s = {.t = baum_simulation_time(run)};
  memcpy(s.q, baum_simulation_q(run), sizeof s.q);
  memcpy(s.v, baum_simulation_v(run), sizeof s.v);
  return s;
}

/* ---- functions that fail ---- */

/* Stores the time and the state after GOOD steps, and again after STEPS more. */
static void run_well(asked *b, step_mode mode, state after[2])
{
  baum_simulation *run = start(b, mode);
  check(go(run, GOOD));
  after[0] = state_of(run);
  check(go(run, STEPS));
  after[1] = state_of(run);
  baum_simulation_destroy(run);
}

/* Multistep methods restart after a failure, so that their result differs slightly. For a one-step
 * method with a fixed step, the result must be the same to the last bit. */
static void fail_one(asked *b, step_mode mode, const state after[2])
{
  char says[80];
  bool nan = b->fault == ASKED_GIVES_NAN;
  asked_fault now = b->fault;
  (void)snprintf(says, sizeof says, "%s%s%s", asked_names[b->kind].element, nan ? "" : "|",
                 nan ? "" : asked_names[b->kind].function);
  b->fault = ASKED_FINE;
  baum_simulation *run = start(b, mode);
  check(go(run, GOOD));
  b->fault = now;
  b->calls = 0;
  baum_status status = go(run, STEPS);
  if (b->calls == 0) { /* some methods do not call nu or the Jacobian */
    assert_true(status >= BAUM_OK && (b->kind == ASKED_NU || b->kind == ASKED_JACOBIAN));
  } else {
    ASSERT_SAYS(status, nan ? BAUM_ERR_NOT_FINITE : BAUM_ERR_CALLBACK, says);
    const state stands = state_of(run);
    assert_true(stands.t >= after[0].t && stands.t < after[1].t);
    assert_true(stands.t > after[0].t || memcmp(&stands, &after[0], sizeof stands) == 0);
    b->fault = ASKED_FINE;
    check(baum_simulation_advance_to(run, after[1].t));
    const state end = state_of(run);
    for (int i = 0; i < ASKED_NV; i++) {
      double close = step_mode_remembers(mode) ? 1e-4 : 0.0; /* 100 rtol */
      assert_true(fabs(end.q[i] - after[1].q[i]) <= close);
    }
  }
  b->fault = now;
  baum_simulation_destroy(run);
}

static void a_failing_function_is_named_and_the_run_continues(void **unused)
{
  (void)unused;
  asked b;
  state after[2];
  asked_make(&b);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    step_mode mode = step_mode_at(i);
    if (mode.integrator == baum_rattle()) {
      continue; /* RATTLE does not support forces that depend on velocities */
    }
    b.fault = ASKED_FINE;
    run_well(&b, mode, after);
    for (int k = 0; k < ASKED_KINDS; k++) {
      for (b.fault = ASKED_STOPS; b.fault <= ASKED_GIVES_NAN; b.fault++) {
        b.kind = (asked_kind)k;
        fail_one(&b, mode, after);
      }
    }
  }
  baum_mechanism_destroy(b.mechanism);
}

/* ---- functions that call the library ---- */

#define REFUSED(CALL) ASSERT_SAYS(CALL, BAUM_ERR_STATE, "baum_")

/* Makes all calls that would change the run. */
static void try_to_change(const asked *b)
{
  static unsigned char bytes[BYTES];
  size_t size = 0;
  double x[ASKED_NV] = {0.0};
  const double one = 1.0;
  const double later = baum_simulation_time(b->run) + 0.5;
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  baum_event_def event = baum_event_def_default();
  event.function = asked_gate;
  REFUSED(baum_simulation_step(b->run, 1));
  REFUSED(baum_simulation_advance_to(b->run, later));
  REFUSED(baum_simulation_sample(b->run, &later, 1, &energy, 1, x, NULL));
  REFUSED(baum_simulation_set_state(b->run, 0.0, x, x));
  REFUSED(baum_simulation_set_angle(b->run, b->motor, BAUM_COORDINATE_FIRST, 1.0));
  REFUSED(baum_simulation_set_input(b->run, b->input, 2.0));
  REFUSED(baum_simulation_set_driver(b->run, b->motor, 0.0, 0.0, 0.0));
  REFUSED(baum_simulation_schedule_input(b->run, b->input, &later, &one, 1));
  REFUSED(baum_simulation_add_event(b->run, &event, NULL));
  REFUSED(baum_simulation_continue(b->run, b->other));
  REFUSED(baum_simulation_save(b->run, bytes, sizeof bytes, &size));
  REFUSED(baum_simulation_restore(b->run, bytes, sizeof bytes));
  baum_simulation_destroy(b->run);
}

/* Makes the calls that evaluate the present state. Only the progress function may make them. */
static void look(const asked *b, baum_status want)
{
  bool unique[ASKED_NC];
  double x[2];
  baum_counters counters;
  baum_energy_account account;
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  assert_int_equal(baum_simulation_get(b->run, &energy, 1, x), want);
  assert_int_equal(baum_simulation_counters(b->run, &counters, sizeof counters), want);
  assert_int_equal(baum_simulation_energy_account(b->run, &account, sizeof account), want);
  assert_int_equal(baum_simulation_unique_multipliers(b->run, unique), want);
  assert_int_equal(baum_simulation_set_progress_interval(b->run, 0.0), want);
  assert_int_equal(baum_simulation_set_time_limit(b->run, 1.0), want);
}

static void read_run(const asked *b)
{
  assert_true(isfinite(baum_simulation_time(b->run)));
  assert_true(isfinite(baum_simulation_q(b->run)[0]) && isfinite(baum_simulation_v(b->run)[0]));
  assert_true(baum_simulation_input(b->run, b->input) == 1.0);
  assert_int_equal(baum_simulation_event_count(b->run), 0);
  assert_non_null(baum_simulation_explain(b->run));
  assert_non_null(baum_simulation_message(b->run));
}

static void try_workspace(baum_workspace *w, baum_input_id input)
{
  double q[ASKED_NV] = {0.0};
  double v[ASKED_NV] = {0.0};
  double y[2 * ASKED_NV + 2 * ASKED_NC] = {0.0};
  double out[ASKED_NV * ASKED_NV];
  const baum_dae dae = {.index = BAUM_RESIDUAL_INDEX3};
  baum_sparse sparse = {NULL, NULL, NULL, 0};
  REFUSED(baum_workspace_phi(w, 0.0, q, out));
  REFUSED(baum_workspace_jacobian(w, 0.0, q, out));
  REFUSED(baum_workspace_nu(w, 0.0, q, out));
  REFUSED(baum_workspace_mass(w, 0.0, q, out));
  REFUSED(baum_workspace_gamma(w, 0.0, q, v, out));
  REFUSED(baum_workspace_force(w, 0.0, q, v, out));
  REFUSED(baum_workspace_energy(w, 0.0, q, v, &out[0], &out[1]));
  REFUSED(baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, out, NULL));
  REFUSED(baum_workspace_residual(w, &dae, 0.0, y, y, out));
  REFUSED(baum_workspace_residual_jacobian(w, &dae, 1.0, 0.0, y, y, &sparse));
  REFUSED(baum_workspace_assemble(w, 0.0, q, v, NULL, 0));
  REFUSED(baum_workspace_project(w, 0.0, q, v));
  REFUSED(baum_workspace_set_input(w, input, 2.0));
  assert_true(baum_workspace_input(w, input) == 1.0);
  baum_workspace_destroy(w);
}

/* The mechanism is constant and may be used. A new workspace does not depend on the run that is
 * calling the function. */
static void use_another(const asked *b)
{
  double q[ASKED_NV];
  double v[ASKED_NV] = {0.0};
  double a[ASKED_NV];
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(b->mechanism, &w), BAUM_OK);
  assert_int_equal(baum_workspace_design(w, q, NULL), BAUM_OK);
  assert_int_equal(baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, a, NULL), BAUM_OK);
  baum_workspace_destroy(w);
}

static void call_back(asked *b)
{
  if (b->run) {
    read_run(b);
    try_to_change(b);
    look(b, b->kind == ASKED_PROGRESS ? BAUM_OK : BAUM_ERR_STATE);
  }
  if (b->w) {
    try_workspace(b->w, b->input);
  }
  if (b->calls % 50 == 1) {
    use_another(b);
  }
}

static void runs_cannot_be_used_by_the_functions_they_call(void **unused)
{
  (void)unused;
  asked b;
  state after[2];
  asked_make(&b);
  b.back = call_back;
  for (int i = 0; step_mode_at(i).integrator; i++) {
    step_mode mode = step_mode_at(i);
    if (mode.integrator == baum_rattle()) {
      continue;
    }
    b.fault = ASKED_FINE;
    run_well(&b, mode, after);
    for (int k = 0; k <= ASKED_PROGRESS; k++) {
      b.fault = ASKED_FINE;
      baum_simulation *other = start(&b, mode);
      b.other = other;
      b.run = start(&b, mode);
      b.kind = (asked_kind)k;
      b.fault = ASKED_CALLS_BACK;
      b.calls = 0;
      check(go(b.run, GOOD));
      check(go(b.run, STEPS));
      assert_true(b.calls > 0 || k == ASKED_NU || k == ASKED_JACOBIAN);
      const state end = state_of(b.run);
      assert_memory_equal(&end, &after[1], sizeof end);
      b.fault = ASKED_FINE;
      baum_simulation_destroy(b.run);
      baum_simulation_destroy(other);
      b.run = NULL;
    }
  }
  baum_mechanism_destroy(b.mechanism);
}

static void workspaces_cannot_be_used_by_the_functions_they_call(void **unused)
{
  (void)unused;
  asked b;
  asked_make(&b);
  b.back = call_back;
  for (int k = 0; k < ASKED_EVENT; k++) {
    double q[ASKED_NV];
    double v[ASKED_NV] = {0.0};
    double a[2][ASKED_NV];
    double energy = 0.0;
    baum_workspace *w = NULL;
    b.kind = (asked_kind)k;
    check(baum_workspace_create(b.mechanism, &w));
    check(baum_workspace_design(w, q, NULL));
    check(baum_workspace_acceleration(w, 0.0, q, v, 1.0, 1.0, a[0], NULL));
    b.w = w;
    b.calls = 0;
    b.fault = ASKED_CALLS_BACK;
    check(baum_workspace_acceleration(w, 0.0, q, v, 1.0, 1.0, a[1], NULL));
    check(baum_workspace_energy(w, 0.0, q, v, NULL, &energy));
    check(baum_workspace_project(w, 0.0, q, v));
    assert_true(b.calls > 0);
    assert_memory_equal(a[0], a[1], sizeof a[0]);
    b.fault = ASKED_FINE;
    b.w = NULL;
    baum_workspace_destroy(w);
  }
  baum_mechanism_destroy(b.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_failing_function_is_named_and_the_run_continues),
    cmocka_unit_test(runs_cannot_be_used_by_the_functions_they_call),
    cmocka_unit_test(workspaces_cannot_be_used_by_the_functions_they_call),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
