/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests break times (times of discontinuities) that a mechanism declares, with a torque that
 * jumps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "construct.h"
#include "runs.h"
#include "step_mode.h"
#include "torque_jumps.h"

static int torque(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user)
{
  (void)q;
  (void)v;
  (void)inputs;
  (void)user;
  out[2] = torque_at(t);
  return 0;
}

static baum_mechanism *make(bool declared)
{
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0), BAUM_OK);
  baum_planar_body_def body = baum_planar_body_def_default();
  body.inertia = 1.0;
  baum_body_id disc;
  assert_int_equal(baum_mechanism_add_planar_body(m, &body, &disc), BAUM_OK);
  (void)add_planar_pin(m, NULL, BAUM_GROUND, disc, 0.0, 0.0);
  baum_user_force_def force = baum_user_force_def_default();
  force.depends_on_velocity = false;
  force.bodies = &disc;
  force.body_count = 1;
  force.force = torque;
  force.depends_on_velocity = false;
  assert_int_equal(baum_mechanism_add_user_force(m, &force, NULL), BAUM_OK);
  if (declared) {
    double mixed[JUMPS + 1] = {TIMES[2], TIMES[0], TIMES[1], TIMES[0]};
    assert_int_equal(baum_mechanism_add_break_times(m, mixed, JUMPS + 1), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static baum_simulation *open_run(const baum_mechanism *m, step_mode mode)
{
  baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
  return create_run(m, &o);
}

static void declared_breaks_keep_motions_accurate(void **state)
{
  (void)state;
  baum_mechanism *declared = make(true);
  baum_mechanism *hidden = make(false);
  printf("\n%-22s %10s %10s %9s %9s %9s\n", "", "declared", "hidden", "rejected", "hidden",
         "restarts");
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    double errors[2];
    baum_counters counters[2];
    for (int i = 0; i < 2; i++) {
      baum_simulation *run = open_run(i == 0 ? declared : hidden, mode);
      baum_status status = baum_simulation_advance_to(run, 2.0);
      /* If the breaks are not declared, fixed steps are inaccurate and may give a warning. */
      assert_true(status == BAUM_OK || (i == 1 && mode.fixed && status == BAUM_WARNED));
      errors[i] = error_now(run);
      counters[i] = counters_of(run);
      baum_simulation_destroy(run);
    }
    printf("%-20s %s %10.1e %10.1e %9d %9d %9d\n", baum_integrator_name(mode.integrator),
           mode.fixed ? "h" : " ", errors[0], errors[1], (int)counters[0].rejected,
           (int)counters[1].rejected, (int)counters[0].restarts);
    assert_true(errors[0] <= allowed(mode));
    assert_int_equal(counters[0].restarts >= JUMPS, step_mode_remembers(mode));
    assert_int_equal(counters[0].short_steps, mode.fixed ? 2 + (counters[0].short_steps == 3) : 0);
  }
  baum_mechanism_destroy(declared);
  baum_mechanism_destroy(hidden);
}

/* Runs forward and backward through all breaks, with an output at each of them. */
static void breaks_are_crossed_accurately_forward_and_backward(void **state)
{
  (void)state;
  baum_mechanism *m = make(true);
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    baum_simulation *run = open_run(m, mode);
    static const double targets[] = {0.5,    1.0,   1.2345, 1.2361, 1.7,
                                     1.2361, 1.235, 1.2345, 0.5,    0.2};
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
      assert_int_equal(step_mode_advance(mode, run, targets[i]), BAUM_OK);
      /* The limit is the rounding error of t. */
      ASSERT_NEAR(baum_simulation_time(run), targets[i], 0.0, 1e-9 * STEP);
      assert_true(error_now(run) <= 2.0 * allowed(mode));
    }
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* Outputs must not change the motion, even if they are at breaks. */
static void outputs_at_breaks_do_not_change_the_motion(void **state)
{
  (void)state;
  baum_mechanism *m = make(true);
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    double end[2];
    for (int i = 0; i < 2; i++) {
      baum_simulation *run = open_run(m, mode);
      double times[6] = {0.5, 0.503, 1.2345, 1.23451, 1.2361, 1.9};
      double rows[18];
      baum_channel all = baum_channel_of(BAUM_Q);
      int first = i == 0 ? 0 : 5;
      assert_int_equal(baum_simulation_sample(run, times + first, 6 - first, &all, 1, rows, NULL),
                       BAUM_OK);
      end[i] = baum_simulation_q(run)[2];
      for (int j = 0; j < 6 - first; j++) {
        ASSERT_NEAR(rows[3 * j + 2], exact(times[first + j]).angle, 0.0, 2.0 * allowed(mode));
      }
      baum_simulation_destroy(run);
    }
    assert_true(end[0] == end[1]);
  }
  baum_mechanism_destroy(m);
}

/* Only the torque does work, so its work must equal the kinetic energy. If a step crossed a jump of
 * the torque, the work and the energy would differ. */
static void the_work_over_breaks_equals_the_energy(void **state)
{
  (void)state;
  baum_mechanism *m = make(true);
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
    o.energy_account = true;
    baum_energy_account account;
    baum_simulation *run = create_run(m, &o);
    assert_int_equal(step_mode_advance(mode, run, 2.0), BAUM_OK);
    assert_int_equal(baum_simulation_energy_account(run, &account, sizeof account), BAUM_OK);
    double rate = exact(2.0).rate;
    /* The error of the work is the error of the angle times a torque of at most 50 N m. The error
     * of the energy is the error of the angular velocity times an angular momentum of at most 6 N m
     * s. */
    double most = (50.0 + 6.0) * allowed(mode);
    ASSERT_NEAR(account.user_forces, 0.5 * rate * rate, 0.0, most);
    ASSERT_NEAR(account.residual, 0.0, 0.0, most);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* A law of motion (s, s', s'') for the driver. Its velocity jumps at the first break, and its
 * acceleration jumps at the second break. */
static int kinked(double t, double s[3], void *user)
{
  (void)user;
  double late = fmax(t - TIMES[1], 0.0);
  bool fast = t >= TIMES[0];
  s[0] = t + (fast ? 2.0 * (t - TIMES[0]) : 0.0) + 2.0 * late * late;
  s[1] = (fast ? 3.0 : 1.0) + 4.0 * late;
  s[2] = t >= TIMES[1] ? 4.0 : 0.0;
  return 0;
}

static void kinematics_crosses_breaks_in_both_directions(void **state)
{
  (void)state;
  static const double targets[] = {0.3, 0.499999, 0.5, 0.7, 1.2345, 2.0, 1.2345, 1.234, 0.5, 0.4};
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0), BAUM_OK);
  baum_planar_body_def body = baum_planar_body_def_default();
  body.inertia = 2.0;
  baum_body_id pinned;
  baum_driver_def motor = baum_driver_def_default();
  motor.law = kinked;
  baum_joint_id drive;
  assert_int_equal(baum_mechanism_add_planar_body(m, &body, &pinned), BAUM_OK);
  motor.joint = add_planar_pin(m, NULL, BAUM_GROUND, pinned, 0.0, 0.0);
  assert_int_equal(baum_mechanism_add_driver(m, &motor, &drive), BAUM_OK);
  assert_int_equal(baum_mechanism_add_break_times(m, TIMES, 2), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  o.check_derivatives = false; /* the law is not smooth */
  baum_simulation *run = create_run(m, &o);
  const baum_channel channels[2] = {baum_channel_of_joint(BAUM_JOINT_COORDINATE, motor.joint),
                                    baum_channel_of_joint(BAUM_DRIVE_EFFORT, drive)};
  for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
    double row[3];
    double s[3];
    (void)kinked(targets[i], s, NULL);
    assert_int_equal(baum_simulation_advance_to(run, targets[i]), BAUM_OK);
    assert_int_equal(baum_simulation_get(run, channels, 2, row), BAUM_OK);
    ASSERT_NEAR(row[0], s[0], 0.0, 1e-13); /* rounding error of values that are at most 10 */
    ASSERT_NEAR(row[1], s[1], 0.0, 1e-12);
    ASSERT_NEAR(row[2], 2.0 * s[2], 0.0, 1e-11);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* Breaks are treated as one if they are closer to each other than the shortest step. */
static void breaks_closer_than_the_shortest_step_are_merged(void **state)
{
  (void)state;
  const double near[4] = {0.5, 0.5 * (1.0 + 1e-15), 0.5 * (1.0 + 4e-15), 0.5 * (1.0 + 1e-14)};
  baum_mechanism *single = make(true);
  baum_mechanism *m = NULL;
  assert_int_equal(baum_mechanism_copy(single, &m), BAUM_OK);
  assert_int_equal(baum_mechanism_add_break_times(m, near, 4), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    baum_simulation *run = open_run(m, mode);
    assert_int_equal(step_mode_advance(mode, run, 2.0), BAUM_OK);
    assert_true(error_now(run) <= allowed(mode));
    assert_int_equal(step_mode_advance(mode, run, 0.2), BAUM_OK);
    assert_true(error_now(run) <= 2.0 * allowed(mode));
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
  baum_mechanism_destroy(single);
}

static void break_times_are_checked_sorted_and_copied(void **state)
{
  (void)state;
  baum_mechanism *m = make(true);
  double bad[2] = {1.0, (double)NAN};
  int32_t count = -1;
  assert_int_equal(baum_mechanism_add_break_times(m, TIMES, 1), BAUM_ERR_STATE);
  baum_mechanism *copy = NULL;
  assert_int_equal(baum_mechanism_copy(m, &copy), BAUM_OK);
  baum_mechanism_destroy(m);
  assert_int_equal(baum_mechanism_add_break_times(copy, bad, 2), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "times[1] is nan s"));
  assert_int_equal(baum_mechanism_add_break_times(copy, NULL, 1), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_mechanism_add_break_times(copy, bad, -1), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_mechanism_add_break_times(NULL, bad, 1), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_mechanism_add_break_times(copy, NULL, 0), BAUM_OK);
  const double *times = baum_mechanism_break_times(copy, &count);
  assert_int_equal(count, JUMPS);
  assert_memory_equal(times, TIMES, sizeof TIMES);
  assert_null(baum_mechanism_break_times(NULL, &count));
  assert_int_equal(count, 0);
  baum_mechanism_destroy(copy);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(declared_breaks_keep_motions_accurate),
    cmocka_unit_test(breaks_are_crossed_accurately_forward_and_backward),
    cmocka_unit_test(outputs_at_breaks_do_not_change_the_motion),
    cmocka_unit_test(the_work_over_breaks_equals_the_energy),
    cmocka_unit_test(kinematics_crosses_breaks_in_both_directions),
    cmocka_unit_test(breaks_closer_than_the_shortest_step_are_merged),
    cmocka_unit_test(break_times_are_checked_sorted_and_copied),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
