/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests events of a known motion. The pendulum of pendulum_events.h passes its lowest point at odd
 * multiples of a quarter period. It is at rest at even multiples. The tests cover every integrator,
 * with fixed and with variable steps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "methods.h"
#include "pendulum_events.h"
#include "runs.h"
#include "step_mode.h"

static const double RTOL = 1e-8;
static const double STEP = 2e-3;

/* ---- runs ---- */

static void close_all(baum_simulation *run, const swing *s)
{
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s->mechanism);
}

static int32_t add_angle(baum_simulation *run, const swing *s, double value, int direction,
                         bool terminal)
{
  baum_event_def def = baum_event_def_default();
  def.joint = s->pin;
  def.value = value;
  def.direction = direction;
  def.terminal = terminal;
  int32_t index = -1;
  assert_int_equal(baum_simulation_add_event(run, &def, &index), BAUM_OK);
  return index;
}

/* An event function. Its value is the angular velocity, which is zero where the pendulum
 * reverses. */
static int rate(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)t;
  (void)q;
  (void)inputs;
  (void)user;
  out[0] = v[2];
  return 0;
}

static int32_t add_rest(baum_simulation *run, int direction)
{
  baum_event_def def = baum_event_def_default();
  def.function = rate;
  def.direction = direction;
  def.terminal = false;
  int32_t index = -1;
  assert_int_equal(baum_simulation_add_event(run, &def, &index), BAUM_OK);
  return index;
}

static baum_event_record record_of(const baum_simulation *run, int64_t k)
{
  baum_event_record record;
  assert_int_equal(baum_simulation_event(run, k, &record, sizeof record), BAUM_OK);
  return record;
}

/* Returns the largest allowed error of the time of an event near t. Events are located on the
 * computed motion. The error of their times therefore comes from the error of this motion. */
static double motion_error(step_mode mode, double t)
{
  if (!mode.fixed) {
    /* The limit is 10 rtol seconds for each second of the motion. At about 2.8 rad/s, this is an
     * error of the angle of 28 rtol. The error grows with time, because the computed period is
     * slightly wrong. */
    return 10.0 * RTOL * fmax(t, 1.0);
  }
  /* The allowed errors are twice those that were measured over 12 s at h = 1e-3 s. These were
   * 5.4e-2 s for explicit Euler, 5.3e-4 s for semi-implicit Euler, below 1e-4 s for methods of
   * order 2, and below 1e-6 s for all others. */
  const char *name = baum_integrator_name(mode.integrator);
  int order = baum_integrator_order(mode.integrator);
  double h = STEP / 1e-3;
  if (order == 1) {
    return 2.0 * (strcmp(name, "euler") == 0 ? 5.4e-2 * h : 5.3e-4 * h);
  }
  return 2.0 * (order == 2 ? 1e-4 * h * h : 1e-6 * h * h * h);
}

/* ---- a stop ---- */

/* Reverses the velocities, as a user program does to model a stop. */
static void bounce(baum_simulation *run)
{
  double q[3];
  double v[3];
  for (int i = 0; i < 3; i++) {
    q[i] = baum_simulation_q(run)[i];
    v[i] = -baum_simulation_v(run)[i];
  }
  assert_int_equal(baum_simulation_set_state(run, baum_simulation_time(run), q, v), BAUM_OK);
}

/* Bounces ten times at the lowest point, either forward or backward in time. The event detects
 * crossings in both directions. The test therefore fails if the motion away from the stop is
 * reported as another event. Returns the largest error of a bounce's time. */
static double bounce_ten_times(step_mode mode, double sign)
{
  swing s = swing_make(1.0);
  baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
  baum_simulation *run = create_run(s.mechanism, &o);
  (void)add_angle(run, &s, 0.0, 0, true);
  double worst = 0.0;
  for (int k = 0; k < 10; k++) {
    assert_int_equal(baum_simulation_advance_to(run, sign * 100.0), BAUM_STOP_EVENT);
    double want = sign * (2 * k + 1) * s.quarter;
    double t = baum_simulation_time(run);
    worst = fmax(worst, fabs(t - want));
    assert_true(record_of(run, k).t == t);
    assert_int_equal(record_of(run, k).direction, sign > 0.0 ? -1 : 1);
    /* The limit is the sum of two rounding errors: the error of the time, 4 eps t, times the
     * angular velocity of 2.7 rad/s, and the rounding error of positions. */
    ASSERT_NEAR(baum_simulation_q(run)[2], 0.0, 0.0, 1e-13);
    bounce(run);
  }
  assert_int_equal(baum_simulation_event_count(run), 10);
  close_all(run, &s);
  return worst;
}

static void a_pendulum_bounces_at_a_stop(void **state)
{
  (void)state;
  printf("\n%-22s %12s %12s %12s\n", "ten bounces", "forward", "backward", "allowed");
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    double allowed = motion_error(mode, 12.0);
    double forward = bounce_ten_times(mode, 1.0);
    double backward = bounce_ten_times(mode, -1.0);
    printf("%-20s %s %12.1e %12.1e %12.1e\n", baum_integrator_name(mode.integrator),
           mode.fixed ? "h" : " ", forward, backward, allowed);
    assert_true(forward <= allowed && backward <= allowed);
  }
}

/* ---- records ---- */

typedef struct expected {
  double quarters;
  int32_t event;
  int32_t direction;
} expected;

/* Compares all event records of a run with the expected ones, in their order. The expected times
 * are given in quarter periods. */
static void check_records(const baum_simulation *run, const swing *s, step_mode mode,
                          const expected *want, int count)
{
  assert_int_equal(baum_simulation_event_count(run), count);
  for (int k = 0; k < count; k++) {
    baum_event_record r = record_of(run, k);
    assert_int_equal(r.event, want[k].event);
    assert_int_equal(r.direction, want[k].direction);
    ASSERT_NEAR(r.t, want[k].quarters * s->quarter, 0.0, motion_error(mode, fabs(r.t)));
  }
}

static void directions_of_crossings_refer_to_increasing_time(void **state)
{
  (void)state;
  static const expected forward[] = {{1, 0, -1}, {1, 2, -1}, {2, 3, 1}, {3, 0, 1}, {3, 1, 1},
                                     {5, 0, -1}, {5, 2, -1}, {6, 3, 1}, {7, 0, 1}, {7, 1, 1}};
  /* Backward in time, the motion is the mirror image of the motion forward in time. */
  static const expected backward[] = {{-1, 0, 1}, {-1, 1, 1}, {-2, 3, 1}, {-3, 0, -1}, {-3, 2, -1},
                                      {-5, 0, 1}, {-5, 1, 1}, {-6, 3, 1}, {-7, 0, -1}, {-7, 2, -1}};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    for (int sign = -1; sign <= 1; sign += 2) {
      swing s = swing_make(1.2);
      baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
      baum_simulation *run = create_run(s.mechanism, &o);
      for (int direction = 0; direction < 3; direction++) {
        (void)add_angle(run, &s, 0.0, direction == 2 ? -1 : direction, false);
      }
      (void)add_rest(run, 1);
      assert_int_equal(step_mode_advance(mode, run, sign * 7.5 * s.quarter), BAUM_OK);
      check_records(run, &s, mode, sign > 0 ? forward : backward, 10);
      close_all(run, &s);
    }
  }
}

/* ---- several events at one time, at an output, and at the start ---- */

static void simultaneous_events_are_all_reported(void **state)
{
  (void)state;
  static const expected want[] = {{1, 0, -1}, {1, 1, -1}, {1, 2, -1}};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    swing s = swing_make(1.2);
    baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
    baum_simulation *run = create_run(s.mechanism, &o);
    (void)add_angle(run, &s, 0.0, 0, false);
    (void)add_angle(run, &s, 0.0, -1, true);
    (void)add_angle(run, &s, 1e-15, 0, true); /* its angle is reached 1e-15 rad earlier */
    assert_int_equal(baum_simulation_advance_to(run, 2.0 * s.quarter), BAUM_STOP_EVENT);
    check_records(run, &s, mode, want, 3);
    assert_true(record_of(run, 0).t == baum_simulation_time(run));
    assert_true(record_of(run, 1).t == record_of(run, 0).t);
    assert_true(record_of(run, 2).t == record_of(run, 0).t);
    /* The run must continue after the events and must not report them again. */
    assert_int_equal(baum_simulation_advance_to(run, 2.0 * s.quarter), BAUM_OK);
    assert_int_equal(baum_simulation_event_count(run), 3);
    close_all(run, &s);
  }
}

/* Makes a pendulum and its mirror image, each on its own pin. */
static baum_mechanism *make_mirrored(double angle, baum_joint_id pins[2])
{
  baum_mechanism *m = create_mechanism();
  for (int k = 0; k < 2; k++) {
    double a = k == 0 ? angle : -angle;
    baum_planar_body_def bob = baum_planar_body_def_default();
    bob.inertia = 0.25;
    bob.angle = a;
    bob.position[0] = 3.0 * k + sin(a);
    bob.position[1] = -cos(a);
    bob.angular_velocity = 0.0;
    baum_body_id id;
    assert_int_equal(baum_mechanism_add_planar_body(m, &bob, &id), BAUM_OK);
    pins[k] = add_planar_pin(m, NULL, BAUM_GROUND, id, 3.0 * k, 0.0);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

/* The times of the two events differ only by rounding. With IDA they differ by up to 5e-13 s,
 * because of its iteration. The differences are below the tolerance of the events, so the run must
 * treat the events as simultaneous. */
static void simultaneous_terminal_events_stop_the_run_once(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    baum_joint_id pins[2];
    swing s = {.mechanism = make_mirrored(1.2, pins)};
    baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
    baum_simulation *run = create_run(s.mechanism, &o);
    for (int i = 0; i < 2; i++) {
      baum_event_def def = baum_event_def_default();
      def.joint = pins[i];
      def.tolerance = 1e-11;
      assert_int_equal(baum_simulation_add_event(run, &def, NULL), BAUM_OK);
    }
    for (int stops = 1; stops <= 3; stops++) {
      assert_int_equal(baum_simulation_advance_to(run, 100.0), BAUM_STOP_EVENT);
      assert_int_equal(baum_simulation_event_count(run), 2 * stops);
      for (int i = 0; i < 2; i++) {
        baum_event_record r = record_of(run, 2 * (stops - 1) + i);
        assert_true(r.t == baum_simulation_time(run) && r.event == i);
        assert_int_equal(r.direction, (i == 0) == (stops % 2 == 1) ? -1 : 1);
      }
    }
    close_all(run, &s);
  }
}

/* Returns the time of the event in a run without outputs. */
static double event_time(step_mode mode)
{
  swing s = swing_make(1.2);
  baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
  baum_simulation *run = create_run(s.mechanism, &o);
  (void)add_angle(run, &s, 0.0, 0, true);
  assert_int_equal(baum_simulation_advance_to(run, 2.0 * s.quarter), BAUM_STOP_EVENT);
  double t = baum_simulation_time(run);
  close_all(run, &s);
  return t;
}

static void an_event_at_the_time_of_an_output_is_found_and_sampled(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    double t = event_time(mode);
    for (int terminal = 0; terminal < 2; terminal++) {
      swing s = swing_make(1.2);
      baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
      baum_simulation *run = create_run(s.mechanism, &o);
      (void)add_angle(run, &s, 0.0, 0, terminal != 0);
      double times[4] = {0.3 * t, t, 1.0001 * t, 1.5 * t};
      double rows[12];
      int64_t done = 0;
      baum_channel angle = baum_channel_of_joint(BAUM_JOINT_COORDINATE, s.pin);
      baum_status status = baum_simulation_sample(run, times, 4, &angle, 1, rows, &done);
      assert_int_equal(status, terminal ? BAUM_STOP_EVENT : BAUM_OK);
      assert_int_equal(done, terminal ? 1 : 4);
      assert_int_equal(baum_simulation_event_count(run), 1);
      /* The search for the time of an event is accurate to 4 eps t. */
      ASSERT_NEAR(record_of(run, 0).t, t, 4e-16, 0.0);
      assert_true(baum_simulation_time(run) == (terminal ? record_of(run, 0).t : times[3]));
      /* The run now makes the samples at the remaining times, which include the time of the
       * event. */
      times[1] = baum_simulation_time(run);
      if (terminal) {
        status = baum_simulation_sample(run, times + 1, 3, &angle, 1, rows + 2, &done);
        assert_int_equal(status, BAUM_OK);
        assert_int_equal(done, 3);
      }
      ASSERT_NEAR(rows[2], 0.0, 0.0, 1e-13); /* rounding errors, as in bounce_ten_times() */
      assert_int_equal(baum_simulation_event_count(run), 1);
      close_all(run, &s);
    }
  }
}

/* Tells whether the target time was reached. Fixed-step methods of low order may give a warning
 * that the step is too long. */
static bool is_there(baum_status status, step_mode mode)
{
  return status == BAUM_OK || (mode.fixed && status == BAUM_WARNED);
}

static void a_zero_at_the_start_is_only_reported_when_it_recurs(void **state)
{
  (void)state;
  static const expected want[] = {{2, 0, 1}, {4, 0, -1}};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    swing s = swing_make(1.2);
    baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
    baum_simulation *run = create_run(s.mechanism, &o);
    /* The run starts 1e-16 rad before the lowest point. This is only a rounding error, so no event
     * may be reported at the start. */
    double v = -2.0 * sqrt(9.81 / 1.25) * sin(0.6);
    double q0[3] = {1e-16, -1.0, 1e-16};
    double v0[3] = {v, 0.0, v};
    assert_int_equal(baum_simulation_set_state(run, 0.0, q0, v0), BAUM_OK);
    (void)add_angle(run, &s, 0.0, 0, false);
    assert_int_equal(baum_simulation_set_state(run, 0.0, q0, v0), BAUM_OK);
    assert_true(is_there(baum_simulation_advance_to(run, 5.0 * s.quarter), mode));
    check_records(run, &s, mode, want, 2);
    close_all(run, &s);
  }
}

/* A run stops at an event, and then continues backward in time. It must not report the event
 * again. */
static void reversing_at_an_event_does_not_report_it_again(void **state)
{
  (void)state;
  static const expected want[] = {{1, 0, -1}, {-1, 0, 1}};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    swing s = swing_make(1.2);
    baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
    baum_simulation *run = create_run(s.mechanism, &o);
    (void)add_angle(run, &s, 0.0, 0, true);
    assert_int_equal(baum_simulation_advance_to(run, 2.0 * s.quarter), BAUM_STOP_EVENT);
    assert_true(is_there(baum_simulation_advance_to(run, 0.0), mode));
    assert_int_equal(baum_simulation_advance_to(run, -2.0 * s.quarter), BAUM_STOP_EVENT);
    check_records(run, &s, mode, want, 2);
    close_all(run, &s);
  }
}

/* ---- dips ---- */

/* Two events use the angle. Where the pendulum reverses, the angle is `depth` below the value of
 * the first event and `depth` above the value of the second. The angle therefore passes only the
 * first value. */
static void check_dips(step_mode mode, double step, double depth)
{
  static const int directions[] = {-1, 1, -1, 1};
  double angle = 1.2;
  swing s = swing_make(angle);
  baum_simulation_options o = step_mode_options(mode, step, RTOL);
  baum_simulation *run = create_run(s.mechanism, &o);
  (void)add_angle(run, &s, depth - angle, 0, false);
  (void)add_angle(run, &s, -depth - angle, 0, false);
  assert_int_equal(baum_simulation_advance_to(run, 7.0 * s.quarter), BAUM_OK);
  assert_int_equal(baum_simulation_event_count(run), 4);
  /* depth = alpha / 2 (t - turn)^2, where alpha is the angular acceleration at the time `turn` */
  double half = sqrt(2.0 * depth / (9.81 / 1.25 * sin(angle)));
  for (int k = 0; k < 4; k++) {
    baum_event_record r = record_of(run, k);
    double turn = (k < 2 ? 2 : 6) * s.quarter;
    assert_int_equal(r.event, 0);
    assert_int_equal(r.direction, directions[k]);
    ASSERT_NEAR(r.t, turn + directions[k] * half, 0.0, 0.2 * half);
  }
  close_all(run, &s);
}

/* Methods of order 3 and lower, and Adams-Bashforth methods, do not keep the amplitude of the swing
 * accurately enough, and are not tested. The dips last much less than a quarter of a step. */
static void an_angle_that_passes_a_value_and_returns_within_a_step_is_found(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    if (!mode.fixed) {
      check_dips(mode, 0.0, 2e-6);
      check_dips(mode, 0.0, 5e-5);
    } else if (baum_integrator_order(mode.integrator) >= 4 && !step_mode_is_adams(mode)) {
      check_dips(mode, 1e-2, 1e-6);
    }
  }
}

/* ---- no event is lost, and none is reported twice ---- */

enum { CASES = 1000, FIXED_CASES = 100 };

static const double RANDOM_RTOL = 1e-6;

/* Makes a randomly chosen call that advances the run, but not beyond `end`. */
static baum_status go_on(baum_simulation *run, uint64_t *seed, double end)
{
  double t = baum_simulation_time(run);
  double chance = uniform(seed, 0.0, 1.0);
  if (chance < 0.2) {
    return baum_simulation_advance_to(run, end);
  }
  if (chance < 0.5) {
    return baum_simulation_advance_to(run, fmin(end, t + uniform(seed, 0.0, 0.4)));
  }
  double times[5];
  double rows[30];
  baum_channel all = baum_channel_of(BAUM_Q);
  for (int k = 0; k < 5; k++) {
    times[k] =
      fmin(end, (k > 0 ? times[k - 1] : t) + uniform(seed, 0.0, chance < 0.6 ? 1e-3 : 0.1));
  }
  return baum_simulation_sample(run, times, 5, &all, 1, rows, NULL);
}

/* Runs a pendulum that starts at a random angle, and advances the run by random calls. Events are
 * at the lowest point and at the points of rest. The event at the lowest point may be terminal.
 * Returns the number of wrong events. If the relative error of an event's time is larger than
 * *worst, sets *worst to this error. */
static int random_case(step_mode mode, uint64_t *seed, double *worst)
{
  swing s = swing_make(uniform(seed, 0.3, 2.5));
  /* With Euler methods, the amplitude of the swing grows. The step is so short that this growth
   * changes the times of events much less than the time between two events. */
  double h = baum_integrator_order(mode.integrator) == 1 ? 1e-4 : STEP;
  baum_simulation_options o = step_mode_options(mode, h, RANDOM_RTOL);
  baum_simulation *run = create_run(s.mechanism, &o);
  (void)add_angle(run, &s, 0.0, 0, uniform(seed, 0.0, 1.0) < 0.5);
  (void)add_rest(run, 0);
  double end = (4.0 + uniform(seed, 0.1, 0.9)) * s.quarter;
  int calls = 0;
  while (baum_simulation_time(run) < end && calls++ < 10000) {
    baum_status status = go_on(run, seed, end);
    assert_true(status == BAUM_STOP_EVENT || is_there(status, mode));
  }
  int wrong = baum_simulation_event_count(run) != 4;
  for (int k = 0; k < 4 && !wrong; k++) {
    baum_event_record r = record_of(run, k);
    wrong += r.event != k % 2;
    *worst = fmax(*worst, fabs(r.t - (k + 1) * s.quarter) / fmax(r.t, 1.0));
    /* Events that follow each other are a quarter period apart. */
    wrong += !(fabs(r.t - (k + 1) * s.quarter) <= 0.1 * s.quarter);
  }
  close_all(run, &s);
  return wrong;
}

/* Returns the largest allowed relative error of an event's time. For variable steps it is ten times
 * rtol. For high swings, errors of up to 8 times rtol were measured. */
static double random_error(step_mode mode)
{
  return mode.fixed ? 0.1 : 10.0 * RANDOM_RTOL;
}

static void no_event_is_lost_in_random_cases(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    int cases = mode.fixed ? FIXED_CASES : CASES;
    uint64_t seed = 42 + (uint64_t)k;
    int wrong = 0;
    double worst = 0.0;
    for (int i = 0; i < cases; i++) {
      wrong += random_case(mode, &seed, &worst) != 0;
    }
    printf("%-20s %s %d of %d wrong, times off by %.1e\n", baum_integrator_name(mode.integrator),
           mode.fixed ? "h" : " ", wrong, cases, worst);
    assert_int_equal(wrong, 0);
    assert_true(worst <= random_error(mode));
  }
}

/* ---- impacts that follow each other faster and faster ---- */

static int height(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = q[1];
  return 0;
}

/* A particle falls from 1 m, and each impact leaves the fraction E of its velocity. The number of
 * impacts before a finite time is infinite. The flights soon fit into the first part of a step.
 * Until they are as short as rounding errors, each impact must be found at the right time. The run
 * then fails, so that the particle does not fall through the floor. */
static void a_bouncing_particle_never_falls_through_the_floor(void **state)
{
  (void)state;
  enum { LEAST = 40, MOST = 1000 };
  const double E = 0.7, G = 9.81;
  baum_mechanism *m = create_mechanism();
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  particle.mass = 1.0;
  particle.position[1] = 1.0;
  check(baum_mechanism_add_planar_particle(m, &particle, NULL));
  check(baum_mechanism_freeze(m));
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk8();
  o.rtol = 1e-9;
  baum_simulation *run = create_run(m, &o);
  baum_event_def def = baum_event_def_default();
  def.function = height;
  def.direction = -1;
  check(baum_simulation_add_event(run, &def, NULL));
  double impact = sqrt(2.0 / G), speed = sqrt(2.0 * G);
  int count = 0;
  baum_status status = baum_simulation_advance_to(run, 5.0);
  for (; status == BAUM_STOP_EVENT && count < MOST; count++) {
    const double *v = baum_simulation_v(run);
    const double after[2] = {0.0, -E * v[1]};
    ASSERT_NEAR(baum_simulation_time(run), impact, 0.0, 1e-12);
    speed *= E;
    impact += 2.0 * speed / G;
    check(baum_simulation_set_state(run, baum_simulation_time(run), baum_simulation_q(run), after));
    status = baum_simulation_advance_to(run, 5.0);
  }
  assert_int_equal(status, BAUM_ERR_STEP);
  assert_true(strstr(baum_message(), "let it rest") != NULL);
  assert_true(count >= LEAST && count < MOST);
  assert_true(fabs(baum_simulation_q(run)[1]) < 1e-12);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_pendulum_bounces_at_a_stop),
    cmocka_unit_test(directions_of_crossings_refer_to_increasing_time),
    cmocka_unit_test(simultaneous_events_are_all_reported),
    cmocka_unit_test(simultaneous_terminal_events_stop_the_run_once),
    cmocka_unit_test(an_event_at_the_time_of_an_output_is_found_and_sampled),
    cmocka_unit_test(a_zero_at_the_start_is_only_reported_when_it_recurs),
    cmocka_unit_test(reversing_at_an_event_does_not_report_it_again),
    cmocka_unit_test(an_angle_that_passes_a_value_and_returns_within_a_step_is_found),
    cmocka_unit_test(no_event_is_lost_in_random_cases),
    cmocka_unit_test(a_bouncing_particle_never_falls_through_the_floor),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
