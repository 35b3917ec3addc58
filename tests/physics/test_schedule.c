/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests schedules of inputs. The input is a torque that jumps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "runs.h"
#include "step_mode.h"
#include "torque_jumps.h"

typedef struct disc {
  baum_mechanism *mechanism;
  baum_joint_id pin;
  baum_joint_id motor; /* not set if the disc has no motor */
  baum_input_id torque;
  baum_input_id other; /* a torque in the opposite direction; its initial value is 0 */
} disc;

static baum_input_id add_torque(baum_mechanism *m, baum_body_id body, double direction,
                                double initial)
{
  baum_planar_load_def load = baum_planar_load_def_default();
  load.body = body;
  load.torque = direction;
  assert_int_equal(baum_mechanism_add_input(m, NULL, initial, &load.input), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_load(m, &load, NULL), BAUM_OK);
  return load.input;
}

/* `torque` is the initial value of the first torque. */
static disc make_with(bool driven, double torque)
{
  disc d = {.mechanism = create_mechanism()};
  assert_int_equal(baum_mechanism_set_gravity(d.mechanism, 0.0, 0.0, 0.0), BAUM_OK);
  baum_planar_body_def body = baum_planar_body_def_default();
  body.inertia = 1.0;
  baum_body_id wheel;
  assert_int_equal(baum_mechanism_add_planar_body(d.mechanism, &body, &wheel), BAUM_OK);
  d.pin = add_planar_pin(d.mechanism, NULL, BAUM_GROUND, wheel, 0.0, 0.0);
  d.torque = add_torque(d.mechanism, wheel, 1.0, torque);
  d.other = add_torque(d.mechanism, wheel, -1.0, 0.0);
  if (driven) {
    baum_driver_def motor = baum_driver_def_default();
    motor.joint = d.pin;
    motor.rate = 2.0;
    assert_int_equal(baum_mechanism_add_driver(d.mechanism, &motor, &d.motor), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(d.mechanism), BAUM_OK);
  return d;
}

static disc make(bool driven)
{
  return make_with(driven, TORQUE[0]);
}

static void schedule(baum_simulation *run, const disc *d)
{
  assert_int_equal(baum_simulation_schedule_input(run, d->torque, TIMES, TORQUE + 1, JUMPS),
                   BAUM_OK);
}

static baum_simulation *open_mode(const disc *d, step_mode mode, bool account)
{
  baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
  o.energy_account = account;
  return create_run(d->mechanism, &o);
}

static void close_all(baum_simulation *run, disc *d)
{
  baum_simulation_destroy(run);
  baum_mechanism_destroy(d->mechanism);
}

/* ---- the free disc ---- */

static void scheduled_jumps_keep_motions_accurate(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make(false);
    baum_simulation *run = open_mode(&d, mode, false);
    schedule(run, &d);
    int64_t before = counters_of(run).restarts;
    assert_int_equal(before, step_mode_remembers(mode));
    assert_int_equal(step_mode_advance(mode, run, 2.0), BAUM_OK);
    baum_counters counters = counters_of(run);
    assert_true(error_now(run) <= allowed(mode));
    assert_int_equal(counters.restarts - before >= JUMPS, step_mode_remembers(mode));
    if (!mode.fixed) { /* nothing else causes restarts */
      assert_int_equal(counters.restarts - before, JUMPS);
    }
    assert_true(baum_simulation_input(run, d.torque) == TORQUE[JUMPS]);
    close_all(run, &d);
  }
}

/* Runs forward and backward through all jumps, and makes an output at each of them. At the time of
 * a jump the input has its value after the jump. */
static void jumps_are_crossed_accurately_forward_and_backward(void **state)
{
  (void)state;
  static const double targets[] = {0.5,   1.0,    1.2345, 1.2361, 1.7,  1.2361,
                                   1.235, 1.2345, 0.5,    0.2,    -0.3, 1.3};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make(false);
    baum_simulation *run = open_mode(&d, mode, false);
    schedule(run, &d);
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
      assert_int_equal(step_mode_advance(mode, run, targets[i]), BAUM_OK);
      /* The limit is the rounding error of t. */
      ASSERT_NEAR(baum_simulation_time(run), targets[i], 0.0, 1e-9 * STEP);
      assert_true(error_now(run) <= 2.0 * allowed(mode));
      double t = baum_simulation_time(run);
      assert_true(baum_simulation_input(run, d.torque) == torque_at(t));
    }
    close_all(run, &d);
  }
}

/* The torque is 0 before -0.1 s, then 2 N m, and -1 N m after 0.2 s. A run from rest at t = 0 turns
 * round at 0.3 s and goes back to -0.3 s. The angle at -0.3 s is 0.05 rad. */
static void jumps_before_the_start_are_crossed_backward(void **state)
{
  (void)state;
  const double times[2] = {-0.1, 0.2};
  const double values[2] = {2.0, -1.0};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make_with(false, 0.0);
    baum_simulation *run = open_mode(&d, mode, false);
    assert_int_equal(baum_simulation_schedule_input(run, d.torque, times, values, 2), BAUM_OK);
    assert_int_equal(step_mode_advance(mode, run, 0.3), BAUM_OK);
    assert_int_equal(step_mode_advance(mode, run, -0.3), BAUM_OK);
    assert_true(baum_simulation_input(run, d.torque) == 0.0);
    ASSERT_NEAR(baum_simulation_q(run)[2], 0.05, 0.0, 2.0 * allowed(mode));
    close_all(run, &d);
  }
}

static void a_run_turns_round_after_an_input_has_ended_its_schedule(void **state)
{
  (void)state;
  const double times[2] = {0.1, 0.5};
  const double values[2] = {2.0, -1.0};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make(false);
    baum_simulation *run = open_mode(&d, mode, false);
    assert_int_equal(baum_simulation_set_input(run, d.torque, 0.0), BAUM_OK);
    assert_int_equal(baum_simulation_schedule_input(run, d.other, times, values, 2), BAUM_OK);
    assert_int_equal(step_mode_advance(mode, run, 0.3), BAUM_OK);
    assert_int_equal(baum_simulation_set_input(run, d.other, 0.0), BAUM_OK);
    assert_int_equal(step_mode_advance(mode, run, 0.4), BAUM_OK);
    assert_int_equal(step_mode_advance(mode, run, 0.2), BAUM_OK);
    /* From 0.1 s to 0.3 s, the torque changes the angular velocity to -0.4 rad/s and the angle to
     * -0.04 rad. After that the torque is 0, even when the run goes back to 0.2 s. */
    ASSERT_NEAR(baum_simulation_q(run)[2], 0.0, 0.0, 2.0 * allowed(mode));
    close_all(run, &d);
  }
}

/* Takes single steps. Each step must end at the next jump or before it. */
static void steps_stop_at_jumps(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make(false);
    baum_simulation *run = open_mode(&d, mode, false);
    schedule(run, &d);
    int next = 0;
    while (baum_simulation_time(run) < 2.0) {
      double from = baum_simulation_time(run);
      assert_int_equal(baum_simulation_step(run, 1), BAUM_OK);
      double to = baum_simulation_time(run);
      if (next < JUMPS && to > TIMES[next] - 1e-12) {
        assert_true(from < TIMES[next]);
        ASSERT_NEAR(to, TIMES[next], 0.0, 1e-13); /* 16 times the rounding error of t */
        next++;
      }
    }
    assert_int_equal(next, JUMPS);
    assert_true(error_now(run) <= allowed(mode));
    close_all(run, &d);
  }
}

/* Two inputs jump at almost the same time, so that both jumps are treated as one. If the run goes
 * back to an earlier time, both inputs must have their earlier values again. */
static void inputs_that_jump_together_are_all_reset_before_the_jump(void **state)
{
  (void)state;
  const double near[2] = {1.2345, 1.2345 * (1.0 + 1e-15)};
  const double values[2] = {4.0, 5.0};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make(false);
    baum_simulation *run = open_mode(&d, mode, false);
    schedule(run, &d);
    assert_int_equal(baum_simulation_schedule_input(run, d.other, near, values, 2), BAUM_OK);
    for (int turn = 0; turn < 2; turn++) {
      assert_int_equal(step_mode_advance(mode, run, 2.0), BAUM_OK);
      assert_true(baum_simulation_input(run, d.other) == 5.0);
      assert_true(baum_simulation_input(run, d.torque) == TORQUE[JUMPS]);
      assert_int_equal(step_mode_advance(mode, run, 0.1), BAUM_OK);
      assert_true(baum_simulation_input(run, d.other) == 0.0);
      assert_true(baum_simulation_input(run, d.torque) == TORQUE[0]);
      assert_true(error_now(run) <= 4.0 * allowed(mode));
    }
    close_all(run, &d);
  }
}

/* A schedule is given or replaced during a run. At this moment, a run with variable steps has
 * already integrated beyond the time that it reports. The new schedule must nevertheless take
 * effect at the reported time. */
static void a_schedule_given_during_a_run_takes_effect_at_once(void **state)
{
  (void)state;
  static const double later[1] = {1.5};
  static const double none[1] = {0.0};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make(false);
    baum_simulation *run = open_mode(&d, mode, false);
    assert_int_equal(step_mode_advance(mode, run, 0.499), BAUM_OK);
    schedule(run, &d);
    assert_int_equal(step_mode_advance(mode, run, 1.3), BAUM_OK);
    assert_true(error_now(run) <= allowed(mode));
    double rate = baum_simulation_v(run)[2];
    assert_int_equal(baum_simulation_schedule_input(run, d.torque, later, none, 1), BAUM_OK);
    assert_int_equal(step_mode_advance(mode, run, 1.6), BAUM_OK);
    ASSERT_NEAR(baum_simulation_v(run)[2], rate + 0.2 * TORQUE[JUMPS], 0.0, allowed(mode));
    /* The new schedule must replace the old one. Before its first jump, the input has the value
     * that it had when the schedule was set. */
    assert_int_equal(step_mode_advance(mode, run, 1.0), BAUM_OK);
    ASSERT_NEAR(baum_simulation_v(run)[2], rate - 0.3 * TORQUE[JUMPS], 0.0, 2.0 * allowed(mode));
    close_all(run, &d);
  }
}

static void the_energy_residual_is_small_over_jumps(void **state)
{
  (void)state;
  printf("\n%-22s %10s %10s\n", "", "residual", "work off");
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make(false);
    baum_simulation *run = open_mode(&d, mode, true);
    schedule(run, &d);
    assert_int_equal(step_mode_advance(mode, run, 2.0), BAUM_OK);
    baum_energy_account account;
    assert_int_equal(baum_simulation_energy_account(run, &account, sizeof account), BAUM_OK);
    double work = exact(2.0).work;
    printf("%-20s %s %10.1e %10.1e\n", baum_integrator_name(mode.integrator),
           mode.fixed ? "h" : " ", account.residual, account.loads - work);
    /* The error of the work is the error of the angle times a torque of at most 50 N m. The error
     * of the energy is the error of the angular velocity times an angular momentum of at most 6 N m
     * s. */
    double most = (50.0 + 6.0) * allowed(mode);
    ASSERT_NEAR(account.residual, 0.0, 0.0, most);
    ASSERT_NEAR(account.loads, work, 0.0, most);
    close_all(run, &d);
  }
}

/* ---- the driven disc ---- */

/* A motor prescribes the motion of the disc. The torque therefore does not change the motion, but
 * the effort of the motor must balance the torque. */
static void kinematics_gives_the_effort_for_the_present_input(void **state)
{
  (void)state;
  static const double targets[] = {0.499999, 0.5, 1.2345, 1.236, 1.2361, 2.0, 1.2345, 1.2, 0.4};
  disc d = make(true);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  baum_simulation *run = create_run(d.mechanism, &o);
  schedule(run, &d);
  const baum_channel channels[2] = {baum_channel_of_joint(BAUM_DRIVE_EFFORT, d.motor),
                                    baum_channel_of_joint(BAUM_JOINT_COORDINATE, d.pin)};
  for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
    double row[3];
    double t = targets[i];
    assert_int_equal(baum_simulation_advance_to(run, t), BAUM_OK);
    assert_int_equal(baum_simulation_get(run, channels, 2, row), BAUM_OK);
    ASSERT_NEAR(row[0], -torque_at(t), 0.0, 1e-12); /* rounding error of at most 50 N m */
    ASSERT_NEAR(row[1], 2.0 * t, 0.0, 1e-13);       /* rounding error of angles */
  }
  close_all(run, &d);
}

/* ---- other states and runs ---- */

static void inputs_have_the_values_scheduled_for_the_time_that_is_set(void **state)
{
  (void)state;
  const double q[3] = {0.0, 0.0, 0.0};
  disc d = make(false);
  baum_simulation *run = open_mode(&d, (step_mode){baum_rk8(), false}, false);
  schedule(run, &d);
  static const double times[] = {1.2345, 0.2, 3.0, 0.5, -1.0};
  for (size_t k = 0; k < sizeof times / sizeof *times; k++) {
    assert_int_equal(baum_simulation_set_state(run, times[k], q, q), BAUM_OK);
    assert_true(baum_simulation_input(run, d.torque) == torque_at(times[k]));
  }
  const double broken[3] = {0.0, 0.0, (double)NAN};
  assert_int_equal(baum_simulation_set_state(run, 3.0, broken, q), BAUM_ERR_ARGUMENT);
  assert_true(baum_simulation_input(run, d.torque) == TORQUE[0]);
  close_all(run, &d);
}

static void a_continuing_run_takes_over_the_schedule(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make(false);
    baum_simulation *from = open_mode(&d, (step_mode){baum_rk8(), false}, false);
    baum_simulation *run = open_mode(&d, mode, false);
    schedule(from, &d);
    assert_int_equal(baum_simulation_schedule_input(run, d.torque, TIMES, TORQUE, 1), BAUM_OK);
    assert_int_equal(baum_simulation_advance_to(from, 0.8), BAUM_OK);
    assert_int_equal(baum_simulation_continue(run, from), BAUM_OK);
    baum_simulation_destroy(from);
    assert_int_equal(step_mode_advance(mode, run, 2.0), BAUM_OK);
    assert_true(error_now(run) <= 2.0 * allowed(mode));
    close_all(run, &d);
  }
}

/* A run is saved, and then gets another schedule. Restoring the run must bring the first schedule
 * back. */
static void restoring_a_run_restores_its_schedule(void **state)
{
  (void)state;
  static unsigned char buffer[1 << 17];
  size_t size = 0;
  double times[100];
  double values[100];
  for (int k = 0; k < 100; k++) {
    times[k] = 0.01 * (k + 1);
    values[k] = k;
  }
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    disc d = make(false);
    baum_simulation *run = open_mode(&d, mode, false);
    schedule(run, &d);
    assert_int_equal(step_mode_advance(mode, run, 0.8), BAUM_OK);
    assert_int_equal(baum_simulation_save(run, buffer, sizeof buffer, &size), BAUM_OK);
    assert_int_equal(baum_simulation_schedule_input(run, d.torque, times, values, 100), BAUM_OK);
    assert_true(baum_simulation_input(run, d.torque) == 79.0);
    assert_int_equal(step_mode_advance(mode, run, 1.1), BAUM_OK);
    assert_int_equal(baum_simulation_restore(run, buffer, size), BAUM_OK);
    assert_true(baum_simulation_input(run, d.torque) == TORQUE[1]);
    assert_int_equal(step_mode_advance(mode, run, 2.0), BAUM_OK);
    assert_true(error_now(run) <= 2.0 * allowed(mode));
    close_all(run, &d);
  }
}

/* ---- the end of a schedule ---- */

static void setting_an_input_ends_its_schedule(void **state)
{
  (void)state;
  disc d = make(false);
  baum_simulation *run = open_mode(&d, (step_mode){baum_rk8(), false}, false);
  schedule(run, &d);
  assert_int_equal(baum_simulation_schedule_input(run, d.other, TIMES, TORQUE, 1), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(run, 0.3), BAUM_OK);
  int64_t restarts = counters_of(run).restarts;
  /* Setting an input ends its schedule, even if its value does not change. This must not cause a
   * restart. */
  assert_int_equal(baum_simulation_set_input(run, d.torque, TORQUE[0]), BAUM_OK);
  assert_int_equal(baum_simulation_schedule_input(run, d.other, NULL, NULL, 0), BAUM_OK);
  assert_int_equal(baum_simulation_advance_to(run, 2.0), BAUM_OK);
  assert_int_equal(counters_of(run).restarts, restarts);
  assert_true(baum_simulation_input(run, d.torque) == TORQUE[0]);
  assert_true(baum_simulation_input(run, d.other) == 0.0);
  ASSERT_NEAR(baum_simulation_v(run)[2], 2.0 * TORQUE[0], 0.0, 1e-11); /* rounding */
  close_all(run, &d);
}

/* If a scheduled value equals the value before it, there is no jump and no restart. */
static void equal_successive_values_cause_no_restart(void **state)
{
  (void)state;
  static const double times[4] = {0.25, 0.5, 0.75, 1.0};
  const double values[4] = {TORQUE[0], TORQUE[0], 5.0, 5.0};
  disc d = make(false);
  baum_simulation *run = open_mode(&d, (step_mode){baum_rk8(), false}, false);
  assert_int_equal(baum_simulation_schedule_input(run, d.torque, times, values, 4), BAUM_OK);
  int64_t restarts = counters_of(run).restarts;
  assert_int_equal(baum_simulation_advance_to(run, 2.0), BAUM_OK);
  assert_int_equal(counters_of(run).restarts, restarts + 1);
  close_all(run, &d);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(scheduled_jumps_keep_motions_accurate),
    cmocka_unit_test(jumps_are_crossed_accurately_forward_and_backward),
    cmocka_unit_test(jumps_before_the_start_are_crossed_backward),
    cmocka_unit_test(a_run_turns_round_after_an_input_has_ended_its_schedule),
    cmocka_unit_test(steps_stop_at_jumps),
    cmocka_unit_test(inputs_that_jump_together_are_all_reset_before_the_jump),
    cmocka_unit_test(a_schedule_given_during_a_run_takes_effect_at_once),
    cmocka_unit_test(the_energy_residual_is_small_over_jumps),
    cmocka_unit_test(kinematics_gives_the_effort_for_the_present_input),
    cmocka_unit_test(inputs_have_the_values_scheduled_for_the_time_that_is_set),
    cmocka_unit_test(a_continuing_run_takes_over_the_schedule),
    cmocka_unit_test(restoring_a_run_restores_its_schedule),
    cmocka_unit_test(setting_an_input_ends_its_schedule),
    cmocka_unit_test(equal_successive_values_cause_no_restart),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
