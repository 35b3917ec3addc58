/* SPDX-License-Identifier: BSD-3-Clause */
/* A run stores for each event whether its value is above or below zero, which is called the side of
 * the event. These tests check the side after bounces off a stop, after starts at zero, where a
 * function stays zero, after calls that fail, and at breaks. The motions are those of one particle,
 * whose events are known exactly. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "methods.h"
#include "runs.h"
#include "step_mode.h"

static const double RTOL = 1e-8;
static const double STEP = 2e-3;
static const double GRAVITY = 9.81;

/* ---- a particle ---- */

typedef struct flight {
  baum_mechanism *mechanism;
  baum_input_id push; /* a horizontal force */
  baum_simulation *run;
} flight;

/* Makes a run of a particle that starts at (0, y) with the velocity (vx, vy). */
static flight flight_make(step_mode mode, double step, double gravity, double y, double vx,
                          double vy)
{
  flight f = {.mechanism = create_mechanism()};
  check(baum_mechanism_set_gravity(f.mechanism, 0.0, -gravity, 0.0));
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  particle.mass = 1.0;
  particle.position[1] = y;
  particle.velocity[0] = vx;
  particle.velocity[1] = vy;
  baum_body_id id;
  check(baum_mechanism_add_planar_particle(f.mechanism, &particle, &id));
  check(baum_mechanism_add_input(f.mechanism, NULL, 0.0, &f.push));
  check(baum_mechanism_freeze(f.mechanism));
  baum_simulation_options o = step_mode_options(mode, step, RTOL);
  f.run = create_run(f.mechanism, &o);
  return f;
}

static void flight_end(flight f)
{
  baum_simulation_destroy(f.run);
  baum_mechanism_destroy(f.mechanism);
}

static baum_event_record record_of(const flight *f, int64_t k)
{
  baum_event_record record;
  check(baum_simulation_event(f->run, k, &record, sizeof record));
  return record;
}

/* Adds an event function. Its user data may be NULL. */
static void add_function_event(const flight *f, baum_force_fn *function, int direction,
                               bool terminal, double tolerance, void *user)
{
  baum_event_def def = baum_event_def_default();
  def.function = function;
  def.direction = direction;
  def.terminal = terminal;
  def.tolerance = tolerance;
  def.user = user;
  check(baum_simulation_add_event(f->run, &def, NULL));
}

/* ---- bounces ---- */

/* The height above the floor, which is at y = *user. */
static int above(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  out[0] = q[1] - *(const double *)user;
  return 0;
}

typedef enum action { NOTHING, SET_INPUT, SAVE, ACTIONS } action;

/* Does something that does not change the motion. */
static void disturb(const flight *f, action what, int count)
{
  size_t size = 0;
  if (what == SET_INPUT) {
    check(baum_simulation_set_input(f->run, f->push, count));
  }
  if (what == SAVE) {
    free(save_run(f->run, &size));
  }
}

/* Lets the particle fall 1 m onto a floor. Each impact leaves the fraction `rest` of its velocity.
 * Returns the number of impacts before the run fails or reaches 4 s. The particle must not fall
 * through the floor. */
static int bounce(step_mode mode, double step, double floor, double rest, double tolerance,
                  action what)
{
  enum { MOST = 5000 };
  flight f = flight_make(mode, step, GRAVITY, floor + 1.0, 0.0, 0.0);
  add_function_event(&f, above, -1, true, tolerance, &floor);
  int count = 0;
  baum_status status = BAUM_STOP_EVENT;
  for (; count < MOST; count++) {
    status = step_mode_advance(mode, f.run, 4.0);
    if (status != BAUM_STOP_EVENT) {
      break;
    }
    const double after[2] = {0.0, -rest * baum_simulation_v(f.run)[1]};
    check(baum_simulation_set_state(f.run, baum_simulation_time(f.run), baum_simulation_q(f.run),
                                    after));
    disturb(&f, what, count);
  }
  assert_true(status == BAUM_ERR_STEP || baum_simulation_q(f.run)[1] > floor - 1e-9);
  flight_end(f);
  return count;
}

/* The velocity after the last impact that the run finds. */
static double slowest(int impacts, double rest)
{
  return sqrt(2.0 * GRAVITY) * pow(rest, impacts);
}

static step_mode accurate(void)
{
  return (step_mode){baum_rk8(), false};
}

/* Calls between the impact and the next flight must not change the side. If the floor is far from
 * the origin, the rounding errors of q are larger. They may matter only when the flights are hardly
 * higher than these errors. */
static void slow_bounces_are_found_on_every_floor(void **state)
{
  (void)state;
  static const double floors[] = {0.0, 1.0, -3.3, 1000.0};
  for (int what = 0; what < ACTIONS; what++) {
    for (int i = 0; i < 4; i++) {
      int count = bounce(accurate(), STEP, floors[i], 0.7, (double)NAN, (action)what);
      /* A flight reaches the height speed^2 / (2 g). All flights that are higher than 16 rounding
       * errors of q must be found. */
      double rounding = 2.3e-16 * fmax(fabs(floors[i]), 1.0);
      assert_true(slowest(count, 0.7) < sqrt(2.0 * GRAVITY * 16.0 * rounding));
    }
  }
}

static void a_bounce_may_begin_below_the_floor_by_its_tolerance(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    step_mode mode = {k == 0 ? baum_rk8() : baum_rk4(), k > 0};
    double tolerance = 1e-4;
    int count = bounce(mode, k == 1 ? 1e-4 : 1e-2, 0.0, 0.5, tolerance, NOTHING);
    /* All flights that last longer than 20 tolerances must be found. */
    assert_true(2.0 * slowest(count, 0.5) / GRAVITY < 20.0 * tolerance);
  }
}

static void no_method_lets_a_particle_fall_through_the_floor(void **state)
{
  (void)state;
  static const double rests[] = {0.8, 0.5, 0.1};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    for (int i = 0; i < 6; i++) {
      (void)bounce(step_mode_at(k), STEP, i % 2, rests[i / 2], (double)NAN, NOTHING);
    }
  }
}

/* ---- starts at zero ---- */

static void motion_backward_from_a_start_at_zero_is_no_event(void **state)
{
  (void)state;
  double floor = 0.0;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    flight f = flight_make(mode, STEP, GRAVITY, 0.0, 0.0, 1.0);
    add_function_event(&f, above, 0, true, (double)NAN, &floor);
    assert_int_equal(step_mode_advance(mode, f.run, -0.1), BAUM_OK);
    const double q[2] = {0.0, 0.0};
    const double v[2] = {0.0, 1.0};
    check(baum_simulation_set_state(f.run, 0.0, q, v));
    assert_int_equal(step_mode_advance(mode, f.run, 0.1), BAUM_OK);
    assert_int_equal(baum_simulation_event_count(f.run), 0);
    flight_end(f);
  }
}

/* The slope of the path plus 1. The result is not a number if the particle is at rest. */
static int slope(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  (void)t;
  (void)q;
  (void)inputs;
  (void)user;
  out[0] = v[1] / v[0] + 1.0;
  return 0;
}

static void an_event_function_may_divide_by_a_velocity(void **state)
{
  (void)state;
  flight f = flight_make(accurate(), STEP, GRAVITY, 0.0, 1.0, 2.0);
  add_function_event(&f, slope, 0, true, (double)NAN, NULL);
  assert_int_equal(baum_simulation_advance_to(f.run, 1.0), BAUM_STOP_EVENT);
  ASSERT_NEAR(baum_simulation_time(f.run), 3.0 / GRAVITY, 0.0, 1e-12);
  flight_end(f);
}

/* The square root of the distance from the height 0.1 nm, minus 1. The result is not a number above
 * this height. */
static int root(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = sqrt(1e-10 - q[1]) - 1.0;
  return 0;
}

/* The particle rises by only 0.05 nm. A straight motion with the initial velocity, however, would
 * lead to heights at which root() is not a number. */
static void an_event_function_may_be_undefined_near_the_start(void **state)
{
  (void)state;
  flight f = flight_make(accurate(), STEP, GRAVITY, 0.0, 0.0, sqrt(GRAVITY * 1e-10));
  add_function_event(&f, root, 0, true, (double)NAN, NULL);
  assert_null(strstr(baum_message(), "its value is"));
  assert_int_equal(baum_simulation_advance_to(f.run, 1.0), BAUM_STOP_EVENT);
  ASSERT_NEAR(baum_simulation_q(f.run)[1], -1.0, 0.0, 1e-9);
  flight_end(f);
}

/* ---- functions that stay zero ---- */

/* The height, or 0 below the floor. */
static int gap(double t, const double *q, const double *v, const double *inputs, double *out,
               void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = fmax(q[1], 0.0);
  return 0;
}

static void a_function_that_stays_zero_is_reported_once_at_its_first_zero(void **state)
{
  (void)state;
  for (int terminal = 0; terminal < 2; terminal++) {
    for (int fixed = 0; fixed < 2; fixed++) {
      flight f = flight_make((step_mode){baum_rk8(), fixed}, STEP, GRAVITY, 1.0, 0.0, 0.0);
      add_function_event(&f, gap, 0, terminal, (double)NAN, NULL);
      baum_status want = terminal ? BAUM_STOP_EVENT : BAUM_OK;
      assert_int_equal(baum_simulation_advance_to(f.run, 1.0), want);
      assert_int_equal(baum_simulation_advance_to(f.run, 1.0), BAUM_OK);
      assert_int_equal(baum_simulation_event_count(f.run), 1);
      ASSERT_NEAR(record_of(&f, 0).t, sqrt(2.0 / GRAVITY), 0.0, 1e-12);
      flight_end(f);
    }
  }
}

/* ---- several events ---- */

/* The displacement from x = *user to the right. */
static int beyond(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  out[0] = q[0] - *(const double *)user;
  return 0;
}

/* Falls through zero at 0.01 m and rises through zero at 0.03 m. */
static int valley(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = (q[0] - 0.01) * (q[0] - 0.03);
  return 0;
}

static void an_unwanted_zero_before_a_stop_hides_no_later_event(void **state)
{
  (void)state;
  double at = 0.02;
  flight f = flight_make((step_mode){baum_rk4(), true}, 0.4, 0.0, 0.0, 1.0, 0.0);
  add_function_event(&f, beyond, 0, true, (double)NAN, &at);
  add_function_event(&f, valley, 1, false, (double)NAN, NULL);
  assert_int_equal(baum_simulation_advance_to(f.run, 1.0), BAUM_STOP_EVENT);
  assert_int_equal(baum_simulation_advance_to(f.run, 1.0), BAUM_OK);
  assert_int_equal(baum_simulation_event_count(f.run), 2);
  ASSERT_NEAR(record_of(&f, 1).t, 0.03, 0.0, 1e-12);
  flight_end(f);
}

/* An event with a large tolerance passes zero just before or after an event without one. */
static void the_tolerance_of_one_event_does_not_delay_another(void **state)
{
  (void)state;
  static const double tolerant_at[] = {0.499, 0.501, 0.503};
  double at = 0.501;
  for (int i = 0; i < 3; i++) {
    double other = tolerant_at[i];
    flight f = flight_make(accurate(), STEP, 0.0, 0.0, 1.0, 0.0);
    add_function_event(&f, beyond, 0, true, (double)NAN, &at);
    add_function_event(&f, beyond, 0, false, 1e-2, &other);
    assert_int_equal(baum_simulation_advance_to(f.run, 1.0), BAUM_STOP_EVENT);
    ASSERT_NEAR(baum_simulation_time(f.run), at, 0.0, 1e-12);
    if (other <= at) { /* the other event has been recorded at the stop */
      assert_int_equal(baum_simulation_event_count(f.run), 2);
      check(baum_simulation_set_state(f.run, baum_simulation_time(f.run), baum_simulation_q(f.run),
                                      baum_simulation_v(f.run)));
    }
    assert_int_equal(baum_simulation_advance_to(f.run, 1.0), BAUM_OK);
    assert_int_equal(baum_simulation_event_count(f.run), 2);
    for (int k = 0; k < 2; k++) {
      baum_event_record r = record_of(&f, k);
      ASSERT_NEAR(r.t, r.event == 0 ? at : other, 0.0, r.event == 0 ? 1e-12 : 1e-2);
    }
    flight_end(f);
  }
}

/* The displacement from x = 0.35 m to the right. If *user is true, the function fails near this
 * place. */
static int failing(double t, const double *q, const double *v, const double *inputs, double *out,
                   void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  out[0] = q[0] - 0.35;
  return *(const bool *)user && fabs(out[0]) < 0.005 ? -1 : 0;
}

/* The search fails after it has located the first of two events. The run is then set to another
 * state. */
static void events_of_a_failed_search_are_forgotten(void **state)
{
  (void)state;
  double at = 0.31;
  bool fails = true;
  flight f = flight_make((step_mode){baum_rk4(), true}, 0.4, 0.0, 0.0, 1.0, 0.0);
  add_function_event(&f, beyond, 0, true, (double)NAN, &at);
  add_function_event(&f, failing, 0, true, (double)NAN, &fails);
  assert_int_equal(baum_simulation_advance_to(f.run, 1.0), BAUM_ERR_CALLBACK);
  fails = false;
  const double q[2] = {0.34, 0.0};
  const double v[2] = {1.0, 0.0};
  check(baum_simulation_set_state(f.run, 2.0, q, v));
  assert_int_equal(baum_simulation_advance_to(f.run, 3.0), BAUM_STOP_EVENT);
  assert_int_equal(record_of(&f, 0).event, 1);
  ASSERT_NEAR(baum_simulation_time(f.run), 2.01, 0.0, 1e-12);
  flight_end(f);
}

/* ---- breaks ---- */

/* The value of the input minus 0.5. */
static int pushed(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)user;
  out[0] = inputs[0] - 0.5;
  return 0;
}

/* The input passes 0.5 at two scheduled times. Forward in time, a call ends at each of them. */
static void a_scheduled_input_that_jumps_through_zero_is_an_event(void **state)
{
  (void)state;
  static const double times[] = {0.3, 0.5};
  static const double values[] = {1.0, 0.0};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    for (int terminal = 0; terminal < 2; terminal++) {
      step_mode mode = step_mode_at(k);
      flight f = flight_make(mode, STEP, GRAVITY, 0.0, 1.0, 0.0);
      add_function_event(&f, pushed, 0, terminal, (double)NAN, NULL);
      check(baum_simulation_schedule_input(f.run, f.push, times, values, 2));
      baum_status stop = terminal ? BAUM_STOP_EVENT : BAUM_OK;
      for (int i = 0; i < 4; i++) { /* forward over both times, and backward */
        double t = times[i < 2 ? i : 3 - i];
        double end = i < 2 ? t : t - 0.1;
        assert_int_equal(step_mode_advance(mode, f.run, end), stop);
        assert_int_equal(baum_simulation_event_count(f.run), i + 1);
        ASSERT_NEAR(record_of(&f, i).t, t, 0.0, 1e-14);
        assert_int_equal(record_of(&f, i).direction, t == times[0] ? 1 : -1);
        assert_int_equal(step_mode_advance(mode, f.run, i < 2 ? t + 0.01 : end), BAUM_OK);
      }
      check(baum_simulation_set_input(f.run, f.push, 2.0));
      assert_int_equal(step_mode_advance(mode, f.run, 1.0), BAUM_OK);
      assert_int_equal(baum_simulation_event_count(f.run), 4);
      flight_end(f);
    }
  }
}

/* The time minus *user. */
static int after(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  (void)q;
  (void)v;
  (void)inputs;
  out[0] = t - *(const double *)user;
  return 0;
}

/* A step ends just before a break, and the next one begins at the break. */
static void a_zero_between_the_two_sides_of_a_break_is_an_event(void **state)
{
  (void)state;
  static const double value = 1.0;
  double b = 0.1 * 3.0;
  double zeros[] = {b, nextafter(b, 0.0)};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    for (int i = 0; i < 2; i++) {
      step_mode mode = step_mode_at(k);
      flight f = flight_make(mode, STEP, GRAVITY, 0.0, 1.0, 0.0);
      add_function_event(&f, after, 0, true, (double)NAN, &zeros[i]);
      check(baum_simulation_schedule_input(f.run, f.push, &b, &value, 1));
      assert_int_equal(step_mode_advance(mode, f.run, b), BAUM_STOP_EVENT);
      assert_true(baum_simulation_time(f.run) == b);
      assert_int_equal(step_mode_advance(mode, f.run, 1.0), BAUM_OK);
      assert_int_equal(baum_simulation_event_count(f.run), 1);
      flight_end(f);
    }
  }
}

/* 1 before *user, and -1 from then on. */
static int before(double t, const double *q, const double *v, const double *inputs, double *out,
                  void *user)
{
  (void)q;
  (void)v;
  (void)inputs;
  out[0] = t < *(const double *)user ? 1.0 : -1.0;
  return 0;
}

/* The value of one event jumps at the break. The particle reaches the position of a second event
 * shortly after the break, within the tolerance of the second event. The first event must not hide
 * the second one. */
static void a_function_may_jump_through_zero_at_a_declared_break(void **state)
{
  (void)state;
  double b = 0.3;
  double soon = 0.305;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    flight f = flight_make(mode, STEP, GRAVITY, 0.0, 1.0, 0.0);
    baum_mechanism *m = NULL;
    check(baum_mechanism_copy(f.mechanism, &m));
    check(baum_mechanism_add_break_times(m, &b, 1));
    check(baum_mechanism_freeze(m));
    flight_end(f);
    baum_simulation_options o = step_mode_options(mode, STEP, RTOL);
    f = (flight){.mechanism = m, .run = create_run(m, &o)};
    add_function_event(&f, before, 0, false, (double)NAN, &b);
    add_function_event(&f, beyond, 0, false, 0.01, &soon);
    for (int i = 0; i < 2; i++) {
      assert_int_equal(step_mode_advance(mode, f.run, i == 0 ? 1.0 : 0.0), BAUM_OK);
      assert_int_equal(baum_simulation_event_count(f.run), 2 * (i + 1));
      ASSERT_NEAR(record_of(&f, 3 * i).t, b, 0.0, 1e-14);
      assert_int_equal(record_of(&f, 3 * i).direction, -1);
      assert_int_equal(record_of(&f, 1 + i).event, 1);
    }
    flight_end(f);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(slow_bounces_are_found_on_every_floor),
    cmocka_unit_test(a_bounce_may_begin_below_the_floor_by_its_tolerance),
    cmocka_unit_test(no_method_lets_a_particle_fall_through_the_floor),
    cmocka_unit_test(motion_backward_from_a_start_at_zero_is_no_event),
    cmocka_unit_test(an_event_function_may_divide_by_a_velocity),
    cmocka_unit_test(an_event_function_may_be_undefined_near_the_start),
    cmocka_unit_test(a_function_that_stays_zero_is_reported_once_at_its_first_zero),
    cmocka_unit_test(an_unwanted_zero_before_a_stop_hides_no_later_event),
    cmocka_unit_test(the_tolerance_of_one_event_does_not_delay_another),
    cmocka_unit_test(events_of_a_failed_search_are_forgotten),
    cmocka_unit_test(a_scheduled_input_that_jumps_through_zero_is_an_event),
    cmocka_unit_test(a_zero_between_the_two_sides_of_a_break_is_an_event),
    cmocka_unit_test(a_function_may_jump_through_zero_at_a_declared_break),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
