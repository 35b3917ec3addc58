/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests inconsistent starts, and user functions that fail. Messages must name the cause, and the
 * run must keep its last good step. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "every_element.h"
#include "message.h"
#include "runs.h"
#include "step_mode.h"

static void *const GARBAGE = (void *)(uintptr_t)16;

static baum_simulation_options euler_options(void)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_euler();
  o.step = 1e-3;
  return o;
}

/* ---- a bead on a rod that can rotate about the origin ---- */

typedef struct bead_def {
  double x;
  double y;
  double v[2];
  double length;
  double second_length; /* length of a second rod, or 0 if there is none */
  bool held;
} bead_def;

static const bead_def GOOD_BEAD = {1.0, 0.0, {(double)NAN, (double)NAN}, 1.0, 0.0, false};

static void add_rod(baum_mechanism *mechanism, const char *name, baum_body_id body, double length)
{
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.name = name;
  rod.body_a = BAUM_GROUND;
  rod.body_b = body;
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  rod.length = length;
  assert_int_equal(baum_mechanism_add_planar_distance(mechanism, &rod, NULL), BAUM_OK);
}

static baum_mechanism *make_bead(const bead_def *def)
{
  baum_planar_particle_def bead = baum_planar_particle_def_default();
  baum_body_id id;
  bead.name = "bead";
  bead.position[0] = def->x;
  bead.position[1] = def->y;
  memcpy(bead.velocity, def->v, sizeof bead.velocity);
  bead.held = def->held;
  baum_mechanism *mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_particle(mechanism, &bead, &id), BAUM_OK);
  add_rod(mechanism, "rod", id, def->length);
  if (def->second_length > 0.0) {
    add_rod(mechanism, "second rod", id, def->second_length);
  }
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  return mechanism;
}

static void check_bead_refused(const bead_def *def, baum_start start, const char *message)
{
  baum_mechanism *mechanism = make_bead(def);
  baum_simulation_options o = euler_options();
  o.start = start;
  check_run_refused(mechanism, &o, BAUM_ERR_INCONSISTENT, message);
  baum_mechanism_destroy(mechanism);
}

static void an_exact_start_refuses_positions_off_the_constraints(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.length = 1.01;
  check_bead_refused(&def, BAUM_START_EXACT,
                     "t = 0 s: start is exact, but in joint 1 \"rod\" Phi = -0.00995 m or rad");
}

static void an_exact_start_refuses_velocities_off_the_constraints(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.v[0] = 0.5;
  def.v[1] = 2.0;
  check_bead_refused(&def, BAUM_START_EXACT,
                     "t = 0 s: start is exact, but in joint 1 \"rod\" Phi' = 0.5 m/s or rad/s");
}

static void given_velocities_that_conflict_are_named(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.v[0] = 0.5;
  check_bead_refused(&def, BAUM_START_ASSEMBLE,
                     "the given velocities do not satisfy joint 1 \"rod\"|0.5|leave those free");
  assert_null(strstr(baum_message(), "away from the design configuration"));
}

/* The velocity would fit a rod along the x axis. In the assembled configuration, the rod is
 * inclined, so the velocity does not fit. */
static void velocities_of_an_inaccurate_design_are_explained(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.y = 0.01;
  def.length = 1.02;
  def.v[0] = 0.0;
  def.v[1] = 1.0;
  check_bead_refused(
    &def, BAUM_START_ASSEMBLE,
    "the given velocities do not satisfy joint 1 \"rod\"|leave those free|they must fit "
    "the assembled configuration, in which body 1 \"bead\" is 0.0199 m away from");
  def.v[0] = (double)NAN;
  baum_mechanism *mechanism = make_bead(&def);
  baum_simulation_options o = euler_options();
  baum_simulation *run = create_run(mechanism, &o);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

/* Makes an arm whose design angle is `angle` [rad]. A pin on ground holds the left end of the arm.
 * If `link` [m] is positive, a rod of this length connects the centre of the arm with the pin.
 * Up to two drivers rotate the arm at 1 and at 2 rad/s from an angle `value` [rad]. */
static baum_mechanism *make_rod(double angle, double link, int drivers, double value)
{
  baum_mechanism *m = create_mechanism();
  baum_planar_body_def body = baum_planar_body_def_default();
  body.name = "arm";
  body.position[0] = 0.5;
  body.angle = angle;
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = BAUM_GROUND;
  pin.point_a[0] = pin.point_a[1] = pin.point_b[1] = 0.0;
  pin.point_b[0] = -0.5;
  baum_driver_def driver = baum_driver_def_default();
  assert_int_equal(baum_mechanism_add_planar_body(m, &body, &pin.body_b), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_revolute(m, &pin, &driver.joint), BAUM_OK);
  if (link > 0.0) {
    add_rod(m, "link", pin.body_b, link);
  }
  for (int k = 0; k < drivers; k++) {
    driver.value = value;
    driver.rate = 1.0 + k;
    assert_int_equal(baum_mechanism_add_driver(m, &driver, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static void drivers_with_different_velocities_are_named(void **state)
{
  (void)state;
  baum_mechanism *m = make_rod(0.0, 0.0, 2, 0.0);
  baum_simulation_options o = euler_options();
  check_run_refused(m, &o, BAUM_ERR_INCONSISTENT,
                    "no velocities satisfy joint 2|joint 3|a driver, or another function");
  assert_null(strstr(baum_message(), "given velocities"));
  baum_mechanism_destroy(m);
}

static void a_large_angle_may_be_in_degrees(void **state)
{
  (void)state;
  static const char hint[] = "(angles are in radians, and angle of body 1 \"arm\" is 80 rad)";
  baum_simulation_options o = euler_options();
  const double angles[] = {80.0, 1.4};
  for (int k = 0; k < 2; k++) {
    baum_mechanism *far = make_rod(angles[k], 0.0, 1, 0.0);
    check_run_refused(far, &o, BAUM_ERR_INCONSISTENT, "assembly would move body 1 \"arm\" by");
    assert_true((strstr(baum_message(), hint) != NULL) == (k == 0));
    baum_mechanism_destroy(far);
    baum_mechanism *open = make_rod(angles[k], 0.9, 0, 0.0);
    check_run_refused(open, &o, BAUM_ERR_INCONSISTENT, "too far from an assembled one|\"link\"");
    assert_true((strstr(baum_message(), hint) != NULL) == (k == 0));
    baum_mechanism_destroy(open);
  }
  baum_mechanism *driven = make_rod(0.0, 0.0, 1, 90.0);
  check_run_refused(driven, &o, BAUM_ERR_INCONSISTENT,
                    "(angles are in radians, and value of joint 2 \"joint2\" is 90 rad)");
  baum_mechanism_destroy(driven);
}

static void given_velocities_that_fit_are_held_exactly(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.v[1] = 0.1;
  baum_mechanism *mechanism = make_bead(&def);
  baum_simulation_options o = euler_options();
  baum_simulation *run = create_run(mechanism, &o);
  assert_true(baum_simulation_v(run)[1] == 0.1);
  ASSERT_NEAR(baum_simulation_v(run)[0], 0.0, 0.0, 1e-15);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

static void rounded_dimensions_of_redundant_joints_are_named_as_a_cause(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.second_length = 1.000001;
  check_bead_refused(&def, BAUM_START_ASSEMBLE,
                     "\"rod\"|m or rad|redundant constraints were rounded|with all digits");
}

static void joints_that_contradict_each_other_are_named(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.second_length = 1.1;
  check_bead_refused(&def, BAUM_START_ASSEMBLE, "contradict each other|\"rod\"|\"second rod\"");
  baum_mechanism *mechanism = make_bead(&def);
  baum_mobility mobility;
  assert_int_equal(baum_mechanism_mobility(mechanism, &mobility, sizeof mobility), BAUM_OK);
  assert_int_equal(mobility.conflicting_rows, 2);
  assert_non_null(strstr(mobility.text, "\"second rod\""));
  baum_mechanism_destroy(mechanism);
}

static void a_held_body_out_of_place_is_named(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.length = 1.01;
  def.held = true;
  check_bead_refused(&def, BAUM_START_ASSEMBLE, "constraints and held bodies|\"rod\"");
}

static void a_design_too_far_off_is_refused(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.length = 2.0;
  check_bead_refused(
    &def, BAUM_START_ASSEMBLE,
    "assembly would move body 1 \"bead\" by 1 m, more than| m; the design configuration|"
    "\"rod\"|closer");
}

/* The arm has three bars and is straight in the design. Its drivers, however, begin at joint angles
 * of 2.5 rad. Assembly must find this bent configuration. */
static void drivers_may_begin_away_from_the_design(void **state)
{
  (void)state;
  enum { BARS = 3 };
  const double start = 2.5;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  baum_driver_def motor = baum_driver_def_default();
  motor.value = start;
  pin.body_a = BAUM_GROUND;
  for (int k = 0; k < BARS; k++) {
    baum_planar_body_def bar = baum_planar_body_def_default();
    bar.position[0] = 0.5 + k;
    pin.point[0] = k;
    pin.point[1] = 0.0;
    assert_int_equal(baum_mechanism_add_planar_body(mechanism, &bar, &pin.body_b), BAUM_OK);
    assert_int_equal(baum_mechanism_add_planar_revolute(mechanism, &pin, &motor.joint), BAUM_OK);
    assert_int_equal(baum_mechanism_add_driver(mechanism, &motor, NULL), BAUM_OK);
    pin.body_a = pin.body_b;
  }
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  baum_simulation *run = create_run(mechanism, &o);
  baum_counters counters = counters_of(run);
  ASSERT_NEAR(counters.start_change, 0.0, 1e-12, 0.0);
  double x = 0.0;
  for (int k = 0; k < BARS; k++) {
    const double angle = (k + 1) * start;
    const double *q = baum_simulation_q(run) + 3 * (ptrdiff_t)k;
    ASSERT_NEAR(q[0], x + 0.5 * cos(angle), 1e-12, 0.0);
    ASSERT_NEAR(q[2], angle, 1e-12, 0.0);
    x += cos(angle);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

/* A rod keeps the centre of the bar 1 m from the origin, but the driver of the slot begins at a
 * displacement of 9 m. */
static void drivers_that_begin_out_of_reach_are_refused(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_body_def bar = baum_planar_body_def_default();
  bar.position[0] = 0.6;
  bar.position[1] = 0.8;
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.body_a = BAUM_GROUND;
  rod.point_a[0] = rod.point_a[1] = rod.point_b[0] = rod.point_b[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &bar, &rod.body_b), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_distance(mechanism, &rod, NULL), BAUM_OK);
  baum_planar_pin_in_slot_def slot = baum_planar_pin_in_slot_def_default();
  slot.body_a = BAUM_GROUND;
  slot.body_b = rod.body_b;
  slot.point[0] = 0.6;
  slot.point[1] = 0.8;
  baum_driver_def motor = baum_driver_def_default();
  assert_int_equal(baum_mechanism_add_planar_pin_in_slot(mechanism, &slot, &motor.joint), BAUM_OK);
  motor.name = "motor";
  motor.value = 9.0;
  assert_int_equal(baum_mechanism_add_driver(mechanism, &motor, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  check_run_refused(mechanism, &o, BAUM_ERR_INCONSISTENT, "contradict each other|\"motor\"");
  assert_null(strstr(baum_message(), "radians")); /* the value is a length */
  baum_mechanism_destroy(mechanism);
}

static void a_rough_design_is_assembled_and_reported(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.length = 1.01;
  baum_mechanism *mechanism = make_bead(&def);
  baum_simulation_options o = euler_options();
  double scale = 0.0;
  baum_simulation *run = create_run(mechanism, &o);
  baum_counters counters = counters_of(run);
  assert_int_equal(baum_mechanism_get_characteristic_length(mechanism, &scale), BAUM_OK);
  ASSERT_NEAR(baum_simulation_q(run)[0], 1.01, 1e-10, 0.0);
  ASSERT_NEAR(counters.start_change, 0.01 / scale, 1e-6, 0.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

static void a_start_as_given_uses_the_design_unchanged(void **state)
{
  (void)state;
  bead_def def = GOOD_BEAD;
  def.length = 1.01;
  def.v[1] = -3.0;
  baum_mechanism *mechanism = make_bead(&def);
  baum_simulation_options o = euler_options();
  o.start = BAUM_START_AS_GIVEN;
  baum_simulation *run = create_run(mechanism, &o);
  assert_true(baum_simulation_q(run)[0] == 1.0);
  assert_true(baum_simulation_v(run)[0] == 0.0);
  assert_true(baum_simulation_v(run)[1] == -3.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

/* ---- functions that fail ---- */

static baum_simulation_options start_options(step_mode mode)
{
  return step_mode_options(mode, 2e-3, 1e-5);
}

static const struct {
  int answer;
  baum_status status;
  const char *message;
} faults[] = {
  {-3, BAUM_ERR_CALLBACK, "returned -3 (stop)"},
  {4, BAUM_ERR_CALLBACK, "returned 4 (retry)"},
  {0, BAUM_ERR_NOT_FINITE, "nan"},
};
enum { FAULTS = 3 };

static bool all_finite(const double *values, int count)
{
  for (int i = 0; i < count; i++) {
    if (!isfinite(values[i])) {
      return false;
    }
  }
  return true;
}

static void check_readable(baum_simulation *run)
{
  double q[EVERY_NQ];
  const baum_channel channel = baum_channel_of(BAUM_Q);
  assert_int_equal(baum_simulation_get(run, &channel, 1, q), BAUM_OK);
  assert_memory_equal(q, baum_simulation_q(run), sizeof q);
  baum_counters counters = counters_of(run);
  assert_true(counters.steps > 0);
}

/* Steps until a function begins to fail. Then reads from the run and continues it. */
static void check_fault_on_the_way(step_mode mode, int f)
{
  every_fault fault = {.answer = faults[f].answer, .fails = true, .after = 0.0505};
  every_element parts = every_element_make(&fault);
  baum_simulation_options o = start_options(mode);
  /* This ensures that rk8 has made at least one step before a step fails. */
  o.max_step = mode.fixed ? (double)NAN : 0.02;
  baum_simulation *run = create_run(parts.mechanism, &o);
  ASSERT_SAYS(baum_simulation_advance_to(run, 0.2), faults[f].status, faults[f].message);
  assert_non_null(strstr(baum_simulation_message(run), faults[f].message));
  assert_non_null(strstr(baum_simulation_message(run), "t = 0.0"));
  double t = baum_simulation_time(run);
  /* The run must be at the end of the step before the fault. The last step of Euler's method may
   * end after the fault, because this method evaluates functions only at the beginning of a
   * step. */
  bool fixed = mode.fixed;
  if (t > (fixed ? 0.0525 : 0.0505) || t < (fixed ? 0.0495 : 0.02)) {
    fail_msg("%s, %s: the run stands at %.9g s", baum_integrator_name(mode.integrator),
             faults[f].message, t);
  }
  assert_true(all_finite(baum_simulation_q(run), EVERY_NQ));
  assert_true(all_finite(baum_simulation_v(run), EVERY_NV));
  ASSERT_SAYS(baum_simulation_advance_to(run, 0.2), faults[f].status, faults[f].message);
  fault.fails = false;
  check_readable(run);
  baum_status status = baum_simulation_advance_to(run, 0.2);
  assert_true(status == BAUM_OK || status == BAUM_WARNED);
  assert_true(baum_simulation_time(run) == 0.2);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

static void a_function_that_fails_during_a_call_leaves_the_last_good_step(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    for (int f = 0; f < FAULTS && every_element_suits(step_mode_at(k).integrator); f++) {
      check_fault_on_the_way(step_mode_at(k), f);
    }
  }
}

static bool is_documented_failure(baum_status status, int f)
{
  return status == faults[f].status;
}

/* Creates runs in which call number n of all functions fails, together with all later calls. n goes
 * from 1 to the number of calls that the creation makes. */
static void check_fault_at_create(const baum_integrator *integrator, int f, baum_start start)
{
  every_fault fault = {.answer = faults[f].answer, .fails = false, .from = 1};
  every_element parts = every_element_make(&fault);
  bool fixed = baum_integrator_has_fixed_step(integrator);
  baum_simulation_options o = start_options((step_mode){integrator, fixed});
  o.start = start;
  baum_simulation *run = create_run(parts.mechanism, &o);
  baum_simulation_destroy(run);
  int64_t calls = fault.calls;
  fault.fails = true;
  for (int64_t n = 1; n <= calls; n += 1 + n / 8) {
    fault.calls = 0;
    fault.from = n;
    run = GARBAGE;
    baum_status status = baum_simulation_create(parts.mechanism, &o, &run);
    if (!is_documented_failure(status, f) || run != NULL ||
        strstr(baum_message(), faults[f].message) == NULL) {
      fail_msg("call %lld fails: %s: %s", (long long)n, baum_status_name(status), baum_message());
    }
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void a_function_that_fails_at_create_is_named(void **state)
{
  (void)state;
  for (int f = 0; f < FAULTS; f++) {
    check_fault_at_create(baum_rk4(), f, BAUM_START_ASSEMBLE);
    check_fault_at_create(baum_euler(), f, BAUM_START_AS_GIVEN);
    if (baum_has("sundials")) {
      check_fault_at_create(baum_ida(), f, BAUM_START_AS_GIVEN);
    }
  }
}

/* Lets the functions fail from call number n on, until the run stops. For every n, the run must
 * stop at a good step, and must be able to continue. */
static void check_single_fault(step_mode mode, int f, int64_t n)
{
  every_fault fault = {.answer = faults[f].answer};
  every_element parts = every_element_make(&fault);
  baum_simulation_options o = start_options(mode);
  o.check_derivatives = false;
  baum_simulation *run = create_run(parts.mechanism, &o);
  fault.fails = true;
  fault.from = fault.calls + n;
  baum_status status = baum_simulation_advance_to(run, 0.02);
  fault.fails = false;
  if (status != BAUM_OK && status != BAUM_WARNED && status != faults[f].status) {
    fail_msg("%s, call %lld: %s: %s", baum_integrator_name(mode.integrator), (long long)n,
             baum_status_name(status), baum_message());
  }
  assert_true(all_finite(baum_simulation_q(run), EVERY_NQ));
  assert_true(all_finite(baum_simulation_v(run), EVERY_NV));
  status = baum_simulation_advance_to(run, 0.02);
  assert_true(status == BAUM_OK || status == BAUM_WARNED);
  assert_true(baum_simulation_time(run) == 0.02);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

static void whichever_call_fails_the_run_can_go_on(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    for (int f = 0; f < FAULTS && every_element_suits(step_mode_at(k).integrator); f++) {
      for (int64_t n = 1; n < 60; n += 1 + n / 10) {
        check_single_fault(step_mode_at(k), f, n);
      }
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(an_exact_start_refuses_positions_off_the_constraints),
    cmocka_unit_test(an_exact_start_refuses_velocities_off_the_constraints),
    cmocka_unit_test(given_velocities_that_conflict_are_named),
    cmocka_unit_test(velocities_of_an_inaccurate_design_are_explained),
    cmocka_unit_test(drivers_with_different_velocities_are_named),
    cmocka_unit_test(a_large_angle_may_be_in_degrees),
    cmocka_unit_test(given_velocities_that_fit_are_held_exactly),
    cmocka_unit_test(rounded_dimensions_of_redundant_joints_are_named_as_a_cause),
    cmocka_unit_test(joints_that_contradict_each_other_are_named),
    cmocka_unit_test(a_held_body_out_of_place_is_named),
    cmocka_unit_test(a_design_too_far_off_is_refused),
    cmocka_unit_test(drivers_may_begin_away_from_the_design),
    cmocka_unit_test(drivers_that_begin_out_of_reach_are_refused),
    cmocka_unit_test(a_rough_design_is_assembled_and_reported),
    cmocka_unit_test(a_start_as_given_uses_the_design_unchanged),
    cmocka_unit_test(a_function_that_fails_during_a_call_leaves_the_last_good_step),
    cmocka_unit_test(a_function_that_fails_at_create_is_named),
    cmocka_unit_test(whichever_call_fails_the_run_can_go_on),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
