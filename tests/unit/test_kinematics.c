/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the kinematics integrator. Mechanisms without degrees of freedom must stay on their branch
 * (assembly mode), and their positions must be accurate to rounding. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "driven.h"
#include "mechanism/mechanism.h"
#include "message.h"
#include "methods.h"
#include "models.h"
#include "runs.h"

static const double PI = 3.14159265358979323846;

/* Newton's iteration continues until Phi contains only rounding errors. Positions therefore have
 * only the rounding errors of a few operations with lengths of up to 5 m. */
static const double EXACT = 1e-13;

/* ---- runs ---- */

static baum_simulation *open_run(const baum_mechanism *mechanism)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  return create_run(mechanism, &o);
}

static void advance(baum_simulation *run, double t)
{
  baum_status status = baum_simulation_advance_to(run, t);
  if (status != BAUM_OK) {
    fail_msg("%s: %s", baum_status_name(status), baum_message());
  }
  assert_true(baum_simulation_time(run) == t);
}

static void close_run(baum_simulation *run, baum_mechanism *mechanism)
{
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
}

/* ---- branches ---- */

/* Chooses a random configuration on either branch. It is at least a few hundredths of a radian from
 * a lock-up. The angular velocity of the crank is 0.01 to 100 rad/s, in either direction. */
static slider_crank draw(double crank, double rod, double offset, uint64_t *seed)
{
  slider_crank data = {.crank = crank, .rod = rod, .offset = offset};
  data.branch = uniform(seed, 0.0, 1.0) < 0.5 ? -1 : 1;
  do {
    data.drive.angle = uniform(seed, -PI, PI);
  } while (fabs(offset - crank * sin(data.drive.angle)) > 0.97 * rod);
  data.drive.rate =
    pow(10.0, uniform(seed, -2.0, 2.0)) * (uniform(seed, 0.0, 1.0) < 0.5 ? -1.0 : 1.0);
  return data;
}

typedef struct tally {
  double error;
  double phi;
  int64_t outputs;
  int64_t steps;
  int64_t evaluations;
} tally;

/* Makes a run with 20 outputs. Between two outputs, the crank rotates by `gap` rad. The outputs are
 * compared with the branch on which the run started. */
static void follow(const slider_crank *data, double gap, tally *all)
{
  baum_mechanism *mechanism = slider_crank_make(data);
  baum_simulation *run = open_run(mechanism);
  for (int k = 1; k <= 20; k++) {
    double t = k * gap / fabs(data->drive.rate);
    double x[3];
    advance(run, t);
    slider_crank_motion(data, data->drive.angle + data->drive.rate * t, x);
    all->error = fmax(all->error, fabs(baum_simulation_q(run)[SLIDER_X] - x[0]));
    all->outputs++;
  }
  baum_counters c = counters_of(run);
  all->phi = fmax(all->phi, c.max_phi);
  all->steps += c.steps;
  all->evaluations += c.evaluations;
  close_run(run, mechanism);
}

/* At the same crank angle, the sliders of the two branches are at least 2 sqrt(l^2 - (r + e)^2)
 * apart. Here l is the length of the rod, r the length of the crank, and e the offset. For the
 * three rods, this distance is 0.11 m, 0.011 m and 0.0011 m. */
static void slider_cranks_stay_on_their_branch_from_any_start(void **state)
{
  (void)state;
  const double rods[3] = {0.16, 0.1501, 0.150001};
  uint64_t seed = 2;
  for (int i = 0; i < 3; i++) {
    tally all = {.error = 0.0};
    for (int start = 0; start < 200; start++) {
      slider_crank data = draw(0.1, rods[i], 0.05, &seed);
      follow(&data, uniform(&seed, 0.1, 3.0), &all);
    }
    printf("rod %.6f m: error %.1e m, Phi %.1e; per output %.1f steps, %.1f factorizations of J\n",
           rods[i], all.error, all.phi, (double)all.steps / (double)all.outputs,
           (double)all.evaluations / (double)all.outputs);
    /* The crank angle reaches 60 rad and has a rounding error of 1e-14. Velocity ratios reach
     * 200. */
    assert_true(all.error <= 1e-11);
    assert_true(all.phi <= 1e-13);
  }
}

/* The only output is after 1000 revolutions. Errors must not accumulate until then. */
static void a_thousand_revolutions_accumulate_no_errors(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.1501, 0.05, 1, {.angle = 0.4, .rate = 2.0}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *run = open_run(mechanism);
  double x[3];
  advance(run, 1000.0 * PI);
  slider_crank_motion(&data, data.drive.angle + data.drive.rate * baum_simulation_time(run), x);
  /* An angle of 6e3 rad is rounded to 1e-12. */
  ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, 1e-11);
  assert_int_equal(counters_of(run).warnings, 0);
  close_run(run, mechanism);
}

enum { LOOPS = 8 };

/* One mechanism contains eight independent slider-cranks in random configurations. Any of them may
 * be close to its other branch. */
static void none_of_many_loops_leaves_its_branch(void **state)
{
  (void)state;
  const double rods[3] = {0.16, 0.1501, 0.150001};
  uint64_t seed = 7;
  for (int start = 0; start < 60; start++) {
    slider_crank data[LOOPS];
    baum_mechanism *all = create_mechanism();
    for (int k = 0; k < LOOPS; k++) {
      data[k] = draw(0.1, rods[(start + k) % 3], 0.05, &seed);
      data[k].drive.rate = uniform(&seed, -3.0, 3.0);
      slider_crank_add(all, &data[k]);
    }
    assert_int_equal(baum_mechanism_freeze(all), BAUM_OK);
    baum_simulation *run = open_run(all);
    for (int i = 1; i <= 10; i++) {
      double x[3];
      advance(run, 0.5 * i);
      for (int k = 0; k < LOOPS; k++) {
        slider_crank_motion(&data[k], data[k].drive.angle + data[k].drive.rate * 0.5 * i, x);
        ASSERT_NEAR(baum_simulation_q(run)[SLIDER_NV * k + SLIDER_X], x[0], 0.0, 1e-11);
      }
    }
    close_run(run, all);
  }
}

/* ---- results ---- */

static void positions_velocities_and_accelerations_agree_with_the_closed_form(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.16, 0.05, 1, {.angle = 0.7, .rate = 20.0}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *run = open_run(mechanism);
  double times[40];
  double rows[40][3 * SLIDER_NV];
  const baum_channel channels[3] = {baum_channel_of(BAUM_Q), baum_channel_of(BAUM_V),
                                    baum_channel_of(BAUM_A)};
  for (int k = 0; k < 40; k++) {
    times[k] = 0.0137 * k;
  }
  assert_int_equal(baum_simulation_sample(run, times, 40, channels, 3, rows[0], NULL), BAUM_OK);
  for (int k = 0; k < 40; k++) {
    double x[3];
    slider_crank_motion(&data, 0.7 + 20.0 * times[k], x);
    ASSERT_NEAR(rows[k][SLIDER_X], x[0], 0.0, EXACT);
    ASSERT_NEAR(rows[k][SLIDER_NV + SLIDER_X], x[1], 0.0, 20.0 * EXACT);
    ASSERT_NEAR(rows[k][2 * SLIDER_NV + SLIDER_X], x[2], 0.0, 400.0 * EXACT);
  }
  close_run(run, mechanism);
}

/* By the principle of virtual power, the power of the motor's torque is the sum of (m a - f) v over
 * all coordinates. */
static void the_multiplier_of_the_driver_is_its_torque(void **state)
{
  (void)state;
  enum { MOTOR_ROW = 8 };
  slider_crank data = {0.1, 0.16, 0.05, -1, {.angle = 0.7, .rate = -20.0}};
  const double mass[SLIDER_NV] = {0.2, 0.2, 0.2 * 0.01 / 12.0, 0.2, 0.2, 0.2 * 0.0256 / 12.0, 0.1,
                                  0.1, 1e-4};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *run = open_run(mechanism);
  const baum_channel channels[3] = {baum_channel_of(BAUM_V), baum_channel_of(BAUM_A),
                                    baum_channel_of(BAUM_LAMBDA)};
  for (int k = 1; k < 20; k++) {
    double row[3 * SLIDER_NV];
    double power = 0.0;
    advance(run, 0.021 * k);
    assert_int_equal(baum_simulation_get(run, channels, 3, row), BAUM_OK);
    for (int i = 0; i < SLIDER_NV; i++) {
      double weight = i % 3 == 1 ? -9.81 * mass[i] : 0.0;
      power += (mass[i] * row[SLIDER_NV + i] - weight) * row[i];
    }
    /* The driver's entry in J is 1 for the crank angle. The torque of the driver is therefore
     * -lambda. Powers are about 10 W. */
    ASSERT_NEAR(-row[2 * SLIDER_NV + MOTOR_ROW], power / -20.0, 1e-11, 1e-12);
  }
  close_run(run, mechanism);
}

static void a_driven_four_bar_follows_its_crank_for_many_revolutions(void **state)
{
  (void)state;
  const drive motor = {.angle = 1.0, .rate = 3.0};
  baum_mechanism *mechanism = four_bar_make(&motor);
  baum_simulation *run = open_run(mechanism);
  for (int k = 1; k <= 100; k++) {
    advance(run, 0.9 * k);
    double off = baum_simulation_q(run)[ROCKER_ANGLE] - four_bar_rocker(1.0 + 2.7 * k);
    /* An angle of 270 rad is rounded to 6e-14. */
    ASSERT_NEAR(remainder(off, 2.0 * PI), 0.0, 0.0, 2e-13);
  }
  assert_true(counters_of(run).max_phi <= 1e-13 * 5.0);
  close_run(run, mechanism);
}

/* The crank angle is 1.55 + 1.2 sin 2 t. It varies from 0.35 to 2.75 rad, and thus avoids the flat
 * configurations at 0 and pi. */
static int swing(double t, double s[3], void *user)
{
  (void)user;
  s[0] = 1.55 + 1.2 * sin(2.0 * t);
  s[1] = 2.4 * cos(2.0 * t);
  s[2] = -4.8 * sin(2.0 * t);
  return 0;
}

static void a_third_crank_is_redundant_and_changes_nothing(void **state)
{
  (void)state;
  const drive motor = {.angle = 1.55, .law = swing};
  baum_mechanism *mechanism = parallelogram_make(&motor);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  baum_simulation *run = create_run(mechanism, &o);
  for (int k = 1; k <= 60; k++) {
    double t = 0.31 * k;
    double s[3];
    baum_status status = baum_simulation_advance_to(run, t);
    /* The first call warns of the redundant row. */
    assert_true(status == BAUM_OK || (status == BAUM_WARNED && k == 1));
    (void)swing(t, s, NULL);
    const double *q = baum_simulation_q(run);
    const double *v = baum_simulation_v(run);
    /* Errors are amplified by 1 / sin(angle), which is at most 3. */
    ASSERT_NEAR(q[0], cos(s[0]) + 1.0, 0.0, 10.0 * EXACT);
    ASSERT_NEAR(q[1], sin(s[0]), 0.0, 10.0 * EXACT);
    ASSERT_NEAR(q[2], 0.0, 0.0, 10.0 * EXACT);
    for (int i = 0; i < 3; i++) {
      ASSERT_NEAR(q[5 + 3 * i], s[0], 0.0, 10.0 * EXACT);
      ASSERT_NEAR(v[5 + 3 * i], s[1], 0.0, 100.0 * EXACT);
    }
  }
  assert_int_equal(counters_of(run).warnings, 1);
  close_run(run, mechanism);
}

static void check_cranks(const baum_simulation *run, double angle, double rate)
{
  for (int i = 0; i < 3; i++) {
    /* In short steps, active rows may be about 0.05 from dependence, which amplifies rounding
     * errors of Phi. */
    ASSERT_NEAR(baum_simulation_q(run)[5 + 3 * i], angle, 0.0, 20.0 * EXACT);
    ASSERT_NEAR(baum_simulation_v(run)[5 + 3 * i], rate, 0.0, 100.0 * EXACT);
  }
}

/* The omitted row changes several times per revolution. In relation to masses, the rows of cranks
 * with a small moment of inertia are nearly dependent everywhere, but the motion does not depend on
 * masses. */
static void cranks_out_of_line_exchange_their_omitted_row(void **state)
{
  (void)state;
  const drive motor = {.angle = 0.3, .rate = 2.0};
  for (int light = 0; light < 2; light++) {
    baum_mechanism *mechanism = parallelogram_make_of(&motor, 1.5, light ? 1e-9 : 0.1);
    baum_simulation *run = open_run(mechanism);
    for (int k = 1; k <= 200; k++) {
      assert_true(baum_simulation_advance_to(run, 0.1 * k) >= BAUM_OK);
      check_cranks(run, 0.3 + 0.2 * k, 2.0);
    }
    assert_true(counters_of(run).steps < 1000);
    close_run(run, mechanism);
  }
}

/* From many times, the run is set to a state in which some sets of rows are dependent. A saved run
 * continues with the rows of the run. */
static void omitted_rows_suit_given_and_restored_states(void **state)
{
  (void)state;
  const drive motor = {.angle = 0.0, .rate = 1.0};
  baum_mechanism *mechanism = parallelogram_make_of(&motor, 1.5, 0.1);
  baum_simulation *run = open_run(mechanism);
  baum_simulation *restored = open_run(mechanism);
  double q[PARALLELOGRAM_NV];
  double v[PARALLELOGRAM_NV];
  memcpy(q, baum_simulation_q(run), sizeof q);
  memcpy(v, baum_simulation_v(run), sizeof v);
  for (int k = 1; k <= 30; k++) {
    size_t size = 0;
    assert_int_equal(baum_simulation_set_state(run, 0.0, q, v), BAUM_OK);
    assert_true(baum_simulation_advance_to(run, 0.1 * k) >= BAUM_OK);
    unsigned char *saved = save_run(run, &size);
    assert_int_equal(baum_simulation_restore(restored, saved, size), BAUM_OK);
    free(saved);
    assert_true(baum_simulation_advance_to(run, 0.2 * k) >= BAUM_OK);
    assert_true(baum_simulation_advance_to(restored, 0.2 * k) >= BAUM_OK);
    check_cranks(run, 0.2 * k, 1.0);
    assert_memory_equal(baum_simulation_q(restored), baum_simulation_q(run), sizeof q);
  }
  baum_simulation_destroy(restored);
  close_run(run, mechanism);
}

static void a_second_guide_is_redundant_and_changes_nothing(void **state)
{
  (void)state;
  double x[2];
  for (int doubled = 0; doubled < 2; doubled++) {
    model scene;
    baum_status status = model_slider_crank_build(
      (model_slider_crank){.driven = true, .doubled_guide = doubled}, &scene);
    assert_int_equal(status, BAUM_OK);
    baum_simulation *run = open_run(scene.mechanism);
    assert_true(baum_simulation_advance_to(run, 0.1) >= BAUM_OK);
    x[doubled] = baum_simulation_q(run)[SLIDER_X];
    baum_simulation_destroy(run);
    model_destroy(&scene);
  }
  ASSERT_NEAR(x[1], x[0], 0.0, EXACT);
}

/* ---- time ---- */

static void backward_in_time_is_the_same_motion(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.1501, 0.05, -1, {.angle = 0.3, .rate = 7.0}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *run = open_run(mechanism);
  const double times[6] = {-0.5, -3.0, -2.0, 1.0, 4.0, 0.0};
  for (int k = 0; k < 6; k++) {
    double x[3];
    advance(run, times[k]);
    slider_crank_motion(&data, 0.3 + 7.0 * times[k], x);
    /* The tolerance is the rounding error of 28 rad, times the velocity ratio 20. */
    ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, 1e-12);
    ASSERT_NEAR(baum_simulation_v(run)[SLIDER_X], x[1], 0.0, 1e-10);
  }
  assert_int_equal(counters_of(run).restarts, 3);
  close_run(run, mechanism);
}

static void a_crank_at_rest_stays_at_rest(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.16, 0.05, 1, {.angle = 0.3, .rate = 0.0}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *run = open_run(mechanism);
  double q[SLIDER_NV];
  memcpy(q, baum_simulation_q(run), sizeof q);
  advance(run, 1e6);
  for (int i = 0; i < SLIDER_NV; i++) {
    ASSERT_NEAR(baum_simulation_q(run)[i], q[i], 0.0, 1e-15);
    assert_true(baum_simulation_v(run)[i] == 0.0);
  }
  assert_true(counters_of(run).steps < 100);
  assert_int_equal(baum_simulation_step(run, 200), BAUM_OK);
  assert_true(isfinite(baum_simulation_time(run)));
  close_run(run, mechanism);
}

/* From t = 5 s to 5.2 s, the crank rotates by 2 rad and back. At all other times it is at rest. */
static int bump(double t, double s[3], void *user)
{
  (void)user;
  double x = PI * (t - 5.0) / 0.2;
  bool moves = x > 0.0 && x < PI;
  s[0] = 0.3 + (moves ? 2.0 * sin(x) * sin(x) : 0.0);
  s[1] = moves ? 2.0 * PI / 0.2 * sin(2.0 * x) : 0.0;
  s[2] = moves ? 4.0 * PI * PI / 0.04 * cos(2.0 * x) : 0.0;
  return 0;
}

/* Without max_step, the kinematics integrator may step over this motion. Outputs during this motion
 * must still be right. */
static void outputs_are_right_where_steps_may_pass_over_a_motion(void **state)
{
  (void)state;
  for (int kind = 0; kind < 2; kind++) {
    slider_crank data = {0.1, 0.1501, 0.05, 1, {.angle = 0.3, .law = bump}};
    baum_mechanism *mechanism = slider_crank_make(&data);
    baum_simulation_options o = baum_simulation_options_default();
    o.integrator = baum_kinematics();
    o.max_step = kind == 0 ? (double)NAN : 0.05;
    baum_simulation *run = create_run(mechanism, &o);
    for (int k = 0; k <= 50; k++) {
      double t = 4.9 + 0.01 * k;
      double s[3];
      double x[3];
      advance(run, t);
      (void)bump(t, s, NULL);
      slider_crank_motion(&data, s[0], x);
      ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, EXACT);
    }
    assert_true(kind == 0 || counters_of(run).steps >= (int64_t)(5.3 / 0.05));
    close_run(run, mechanism);
  }
}

static void targets_do_not_alter_the_steps(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.1501, 0.05, 1, {.angle = 0.3, .rate = 9.0}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *once = open_run(mechanism);
  baum_simulation *often = open_run(mechanism);
  advance(once, 2.0);
  for (int k = 1; k <= 400; k++) {
    advance(often, 0.005 * k);
  }
  assert_int_equal(counters_of(once).steps, counters_of(often).steps);
  assert_int_equal(counters_of(once).rejected, counters_of(often).rejected);
  for (int i = 0; i < SLIDER_NV; i++) {
    ASSERT_NEAR(baum_simulation_q(often)[i], baum_simulation_q(once)[i], 0.0, EXACT);
  }
  baum_simulation_destroy(once);
  close_run(often, mechanism);
}

/* In millimetres, grams and milliseconds the steps and the motion are the same as in SI units. */
static void units_do_not_matter(void **state)
{
  (void)state;
  const model_units *const units[2] = {NULL, &MODEL_MILLI};
  double x[2];
  int64_t steps[2];
  for (int k = 0; k < 2; k++) {
    model scene;
    model_slider_crank options = {.driven = true, .units = units[k]};
    assert_int_equal(model_slider_crank_build(options, &scene), BAUM_OK);
    baum_simulation *run = open_run(scene.mechanism);
    advance(run, k == 0 ? 0.4 : 400.0);
    x[k] = baum_simulation_q(run)[SLIDER_X];
    steps[k] = counters_of(run).steps;
    baum_simulation_destroy(run);
    model_destroy(&scene);
  }
  ASSERT_NEAR(x[1], 1000.0 * x[0], 1e-13, 0.0);
  assert_int_equal(steps[1], steps[0]);
}

/* The other branch is equally valid. If set_state() sets a state on this branch, the run must stay
 * there. */
static void a_state_of_the_other_branch_can_be_set(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.1501, 0.05, 1, {.angle = 0.3, .rate = 9.0}};
  slider_crank other = data;
  other.branch = -1;
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_mechanism *mirror = slider_crank_make(&other);
  baum_simulation *run = open_run(mechanism);
  baum_simulation *there = open_run(mirror);
  double x[3];
  advance(run, 0.7);
  assert_int_equal(
    baum_simulation_set_state(run, 0.0, baum_simulation_q(there), baum_simulation_v(there)),
    BAUM_OK);
  advance(run, 5.0);
  slider_crank_motion(&other, 0.3 + 45.0, x);
  ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, 1e-12);
  close_run(run, mechanism);
  close_run(there, mirror);
}

/* The test sets the driver three times: to another velocity, to an angle slightly ahead of the
 * crank, and to an angle that is too far from the crank. This last angle must be refused. */
static void a_driver_can_be_set_in_a_run(void **state)
{
  (void)state;
  slider_crank data = {0.1, 0.1501, 0.05, 1, {.angle = 0.3, .rate = 9.0}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_simulation *run = open_run(mechanism);
  baum_joint_id motor = baum_i_joint_id(mechanism, 4);
  double x[3];

  advance(run, 0.5);
  assert_int_equal(baum_simulation_set_driver(run, motor, 4.8, -2.0, 0.0), BAUM_OK);
  advance(run, 4.0);
  slider_crank_motion(&data, 4.8 - 2.0 * 3.5, x);
  ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, EXACT);
  assert_int_equal(baum_simulation_set_driver(run, motor, -2.1, 2.0, 0.0), BAUM_OK);
  advance(run, 5.0);
  slider_crank_motion(&data, -0.1, x);
  ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, EXACT);
  ASSERT_SAYS(baum_simulation_set_driver(run, motor, 1.5, 2.0, 0.0), BAUM_ERR_INCONSISTENT,
              "t = 5 s: kinematics: no configuration|let the laws of drivers start at the present "
              "coordinates");
  advance(run, 6.0);
  slider_crank_motion(&data, 1.9, x);
  ASSERT_NEAR(baum_simulation_q(run)[SLIDER_X], x[0], 0.0, EXACT);
  close_run(run, mechanism);
}

/* ---- cost ---- */

static baum_counters cost_of(const baum_mechanism *mechanism, const baum_integrator *integrator,
                             double rtol)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.rtol = rtol;
  baum_simulation *run = create_run(mechanism, &o);
  advance(run, 10.0);
  baum_counters counters = counters_of(run);
  baum_simulation_destroy(run);
  return counters;
}

static void kinematics_are_cheaper_than_integration(void **state)
{
  (void)state;
  if (!baum_has("sundials")) {
    skip();
  }
  slider_crank data = {0.1, 0.16, 0.05, 1, {.angle = 0.3, .rate = 2.0 * PI}};
  baum_mechanism *mechanism = slider_crank_make(&data);
  baum_counters exact = cost_of(mechanism, baum_kinematics(), (double)NAN);
  baum_counters adams = cost_of(mechanism, baum_cvode_adams(), 1e-8);
  printf("10 revolutions: kinematics %lld steps, %lld factorizations; cvode_adams at 1e-8 %lld and "
         "%lld\n",
         (long long)exact.steps, (long long)exact.factorizations, (long long)adams.steps,
         (long long)adams.factorizations);
  assert_true(2 * exact.factorizations < adams.factorizations);
  assert_true(exact.nonlinear_iterations <= 5 * (exact.steps + exact.rejected));
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(slider_cranks_stay_on_their_branch_from_any_start),
    cmocka_unit_test(a_thousand_revolutions_accumulate_no_errors),
    cmocka_unit_test(none_of_many_loops_leaves_its_branch),
    cmocka_unit_test(positions_velocities_and_accelerations_agree_with_the_closed_form),
    cmocka_unit_test(the_multiplier_of_the_driver_is_its_torque),
    cmocka_unit_test(a_driven_four_bar_follows_its_crank_for_many_revolutions),
    cmocka_unit_test(a_third_crank_is_redundant_and_changes_nothing),
    cmocka_unit_test(cranks_out_of_line_exchange_their_omitted_row),
    cmocka_unit_test(omitted_rows_suit_given_and_restored_states),
    cmocka_unit_test(a_second_guide_is_redundant_and_changes_nothing),
    cmocka_unit_test(backward_in_time_is_the_same_motion),
    cmocka_unit_test(a_crank_at_rest_stays_at_rest),
    cmocka_unit_test(outputs_are_right_where_steps_may_pass_over_a_motion),
    cmocka_unit_test(targets_do_not_alter_the_steps),
    cmocka_unit_test(units_do_not_matter),
    cmocka_unit_test(a_state_of_the_other_branch_can_be_set),
    cmocka_unit_test(a_driver_can_be_set_in_a_run),
    cmocka_unit_test(kinematics_are_cheaper_than_integration),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
