/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the values of channels, and how many evaluations they cost. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "every_element.h"
#include "message.h"
#include "models.h"
#include "runs.h"
#include "user_models.h"

static baum_simulation *run_of(const baum_mechanism *mechanism, const baum_integrator *integrator,
                               double step)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  if (baum_integrator_has_fixed_step(integrator)) {
    o.step = step;
  } else {
    o.rtol = 1e-8;
  }
  return create_run(mechanism, &o);
}

/* ---- acceleration ---- */

enum { AROUND = 5, WIDTH = 8 };

/* The samples are at times from t - 2 d to t + 2 d. The channels are velocities and accelerations
 * of the rod's end and of the slider. */
static void accelerations_are_the_slopes_of_velocities(void **state)
{
  (void)state;
  const double d = 1e-5;
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = false}, &m), BAUM_OK);
  const baum_channel channels[] = {
    baum_channel_of_point(BAUM_BODY_VELOCITY, m.bodies[MODEL_ROD], 0.1, 0.07, 0.0),
    baum_channel_of_point(BAUM_BODY_ACCELERATION, m.bodies[MODEL_ROD], 0.1, 0.07, 0.0),
    baum_channel_of_joint(BAUM_PHI, m.joints[MODEL_PIN_GROUND]),
  };
  double times[AROUND];
  double rows[AROUND][WIDTH];
  baum_simulation *run = run_of(m.mechanism, baum_rk4(), d);
  for (int k = 0; k < AROUND; k++) {
    times[k] = (200 + k) * d;
  }
  assert_int_equal(baum_channels_width(m.mechanism, channels, 3), WIDTH);
  assert_int_equal(baum_simulation_sample(run, times, AROUND, channels, 3, rows[0], NULL), BAUM_OK);
  for (int i = 0; i < 3; i++) {
    double slope = (8.0 * (rows[3][i] - rows[1][i]) - (rows[4][i] - rows[0][i])) / (12.0 * d);
    /* There are two relative errors. The truncation error is (150 rad/s x d)^4 / 30 = 2e-13. The
     * rounding error of v causes 1e-16 / (150 rad/s x d) = 1e-13. */
    ASSERT_NEAR(rows[2][3 + i], slope, 1e-9, 0.0);
  }
  baum_simulation_destroy(run);
  model_destroy(&m);
}

static void accelerations_of_bodies_are_their_part_of_a(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation *run = run_of(parts.mechanism, baum_rk4(), 0.01);
  const baum_channel channels[] = {
    baum_channel_of(BAUM_A),
    baum_channel_of_body(BAUM_BODY_ACCELERATION, parts.bob),
    baum_channel_of_body(BAUM_BODY_ACCELERATION, parts.masses),
    baum_channel_of_body(BAUM_BODY_ACCELERATION, parts.tool),
  };
  double row[EVERY_NV + 2 + 2 + 3];
  int32_t first[3];
  const baum_body_id bodies[3] = {parts.bob, parts.masses, parts.tool};
  assert_int_equal(baum_channels_width(parts.mechanism, channels, 4), EVERY_NV + 7);
  assert_int_equal(baum_simulation_get(run, channels, 4, row), BAUM_OK);
  for (int k = 0; k < 3; k++) {
    assert_int_equal(baum_mechanism_columns(parts.mechanism, bodies[k], NULL, &first[k]), BAUM_OK);
  }
  const double *given = row + EVERY_NV;
  assert_memory_equal(given, row + first[0], 2 * sizeof *row);
  assert_memory_equal(given + 2, row + first[1], 2 * sizeof *row);
  assert_memory_equal(given + 4, row + first[2], 3 * sizeof *row);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- effort ---- */

enum { INTERVALS = 200 };

/* The power of the driver is integrated by Simpson's rule. The result is the change of energy,
 * because nothing else does work on a driven slider-crank without dampers. */
static void the_power_of_a_driver_is_the_change_of_energy(void **state)
{
  (void)state;
  const double h = 5e-5;
  model m;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.driven = true}, &m), BAUM_OK);
  const baum_channel channels[] = {
    baum_channel_of(BAUM_ENERGY),
    baum_channel_of_joint(BAUM_DRIVE_EFFORT, m.joints[MODEL_MOTOR]),
    baum_channel_of_joint(BAUM_JOINT_COORDINATE, m.joints[MODEL_PIN_GROUND]),
  };
  enum { COUNT = sizeof channels / sizeof *channels, COLUMNS = 5 };
  static double times[INTERVALS + 1];
  static double rows[INTERVALS + 1][COLUMNS];
  baum_simulation *run = run_of(m.mechanism, baum_rk4(), h);
  for (int k = 0; k <= INTERVALS; k++) {
    times[k] = k * h;
  }
  assert_int_equal(baum_channels_width(m.mechanism, channels, COUNT), COLUMNS);
  assert_int_equal(
    baum_simulation_sample(run, times, INTERVALS + 1, channels, COUNT, rows[0], NULL), BAUM_OK);
  double work = 0.0;
  double largest = 0.0;
  for (int k = 0; k <= INTERVALS; k++) {
    double weight = k == 0 || k == INTERVALS ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    double energy = rows[k][0] + rows[k][1] - rows[0][0] - rows[0][1];
    work += weight * h / 3.0 * rows[k][2] * rows[k][4];
    largest = fmax(largest, fabs(energy));
  }
  /* The power has harmonics of up to about 1500 rad/s, which is ten times the speed of the crank.
   * The relative error of Simpson's rule is therefore near (1500 rad/s x h)^4 / 180 = 2e-7. */
  double change = rows[INTERVALS][0] + rows[INTERVALS][1] - rows[0][0] - rows[0][1];
  assert_true(fabs(change) > 0.1 * largest);
  ASSERT_NEAR(work, change, 0.0, 2e-7 * largest);
  baum_simulation_destroy(run);
  model_destroy(&m);
}

/* ---- cost ---- */

/* Makes channels that need no accelerations and no multipliers, so that no equations are solved. */
static int cheap_channels(const every_element *parts, baum_channel channels[8])
{
  int count = 0;
  channels[count++] = baum_channel_of(BAUM_Q);
  channels[count++] = baum_channel_of(BAUM_V);
  channels[count++] = baum_channel_of_body(BAUM_BODY_POSE, parts->tool);
  channels[count++] = baum_channel_of_body(BAUM_BODY_VELOCITY, parts->tool);
  channels[count++] = baum_channel_of_joint(BAUM_JOINT_COORDINATE, parts->pin);
  channels[count++] = baum_channel_of(BAUM_PHI);
  channels[count++] = baum_channel_of(BAUM_PHI_RATE);
  channels[count++] = baum_channel_of(BAUM_ENERGY);
  return count;
}

enum { SAMPLES = 12, ROW = EVERY_NQ + EVERY_NV + 2 * EVERY_NC + 12 };

/* Counts the evaluations of a run that samples the channels at 12 times. There is one time
 * for each step of 0.01 s, from 0.05 s on. */
static int64_t cost_of(const every_element *parts, const baum_integrator *integrator,
                       const baum_channel *channels, int count)
{
  static double rows[SAMPLES * ROW];
  double times[SAMPLES];
  assert_in_range(baum_channels_width(parts->mechanism, channels, count), 0, ROW);
  for (int k = 0; k < SAMPLES; k++) {
    times[k] = (5 + k) * 0.01;
  }
  baum_simulation *run = run_of(parts->mechanism, integrator, 0.01);
  assert_int_equal(baum_simulation_sample(run, times, SAMPLES, channels, count, rows, NULL),
                   BAUM_OK);
  int64_t sum = counters_of(run).evaluations;
  baum_simulation_destroy(run);
  return sum;
}

static void only_channels_that_need_accelerations_or_multipliers_cost_a_solution(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  const baum_channel effort[2] = {baum_channel_of_joint(BAUM_DRIVE_EFFORT, parts.motor),
                                  baum_channel_of_body(BAUM_BODY_ACCELERATION, parts.bob)};
  baum_channel cheap[8];
  int count = cheap_channels(&parts, cheap);
  for (int k = 0; k < 2 && (k == 0 || baum_has("sundials")); k++) {
    const baum_integrator *integrator = k == 0 ? baum_rk4() : baum_cvode_adams();
    int64_t without = cost_of(&parts, integrator, NULL, 0);
    assert_int_equal(cost_of(&parts, integrator, cheap, count), without);
    assert_int_equal(cost_of(&parts, integrator, effort, 2), without + SAMPLES);
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* For channels that follow from q and v alone, not even user functions may be called. */
static void channels_that_follow_from_the_state_call_no_user_function(void **state)
{
  (void)state;
  every_fault fault = {0};
  every_element parts = every_element_make(&fault);
  baum_channel cheap[8];
  double row[ROW];
  (void)cheap_channels(&parts, cheap);
  baum_simulation *run = run_of(parts.mechanism, baum_rk4(), 0.01);
  int64_t calls = fault.calls;
  assert_int_equal(baum_simulation_get(run, cheap, 5, row), BAUM_OK);
  assert_int_equal(fault.calls, calls);
  const baum_channel energy = baum_channel_of(BAUM_ENERGY);
  const baum_channel phi = baum_channel_of(BAUM_PHI);
  int64_t solutions = counters_of(run).evaluations;
  calls = fault.calls;
  assert_int_equal(baum_simulation_get(run, &phi, 1, row), BAUM_OK);
  assert_int_equal(baum_simulation_get(run, &energy, 1, row), BAUM_OK);
  assert_true(fault.calls > calls);
  assert_int_equal(counters_of(run).evaluations, solutions);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

/* The point is so far from the body that its velocity overflows. */
static void overflow_is_reported(void **state)
{
  (void)state;
  double row[ROW];
  every_element parts = every_element_make(NULL);
  baum_simulation *run = run_of(parts.mechanism, baum_rk4(), 0.01);
  baum_channel channels[2] = {baum_channel_of(BAUM_Q),
                              baum_channel_of_body(BAUM_BODY_VELOCITY, parts.crank)};
  assert_int_equal(baum_simulation_get(run, channels, 2, row), BAUM_OK);
  channels[1].point[0] = -1.79e308; /* the body rotates at 2 rad/s */
  ASSERT_SAYS(baum_simulation_get(run, channels, 2, row), BAUM_ERR_NOT_FINITE,
              "channel 1|of the velocity is -inf");
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

/* Each channel has 10000 columns. The call is refused only because of the number of columns.
 * Nothing is evaluated or written. */
static void more_columns_than_can_be_counted_are_refused(void **state)
{
  (void)state;
  enum { MANY = 214749 };
  baum_coordinates_def def = baum_coordinates_def_default();
  baum_channel *channels = calloc(MANY, sizeof *channels);
  assert_non_null(channels);
  for (int k = 0; k < MANY; k++) {
    channels[k] = baum_channel_of(BAUM_Q);
  }
  def.size = 10000;
  def.mass = user_never_asked;
  def.force = user_never_pushed;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_coordinates(m, &def, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_channels_width(m, channels, MANY - 1), 2147480000);
  assert_int_equal(baum_channels_width(m, channels, MANY), -1);
  assert_non_null(strstr(baum_message(), "channel 214748"));
  assert_non_null(strstr(baum_message(), "more columns than an int can count"));
  baum_mechanism_destroy(m);
  free(channels);
}

/* ---- structs of other versions ---- */

/* The struct of a channel in an older version, in which it had no fields for bodies, joints and
 * points. */
typedef struct short_channel {
  size_t struct_size;
  baum_quantity quantity;
} short_channel;

static void channels_of_an_older_version_have_defaults_where_they_end(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation *run = run_of(parts.mechanism, baum_rk4(), 0.01);
  const baum_channel whole[] = {baum_channel_of(BAUM_V), baum_channel_of(BAUM_ENERGY),
                                baum_channel_of(BAUM_PHI)};
  const short_channel old[] = {
    {sizeof *old, BAUM_V}, {sizeof *old, BAUM_ENERGY}, {sizeof *old, BAUM_PHI}};
  const baum_channel *cut = (const void *)old;
  enum { COLUMNS = EVERY_NV + 2 + EVERY_NC };
  double want[COLUMNS];
  double got[COLUMNS];
  assert_int_equal(baum_channels_width(parts.mechanism, cut, 3), COLUMNS);
  assert_int_equal(baum_simulation_get(run, whole, 3, want), BAUM_OK);
  assert_int_equal(baum_simulation_get(run, cut, 3, got), BAUM_OK);
  assert_memory_equal(got, want, sizeof want);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

static void channels_of_wrong_or_mixed_sizes_are_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation *run = run_of(parts.mechanism, baum_rk4(), 0.01);
  const double t = 0.1;
  double row[EVERY_NV];
  const size_t sizes[] = {0, sizeof(size_t), sizeof(baum_channel) - 1, 2 * sizeof(baum_channel)};
  for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
    baum_channel channels[2] = {baum_channel_of(BAUM_V), baum_channel_of(BAUM_ENERGY)};
    channels[0].struct_size = sizes[k];
    ASSERT_SAYS(baum_simulation_get(run, channels, 1, row), BAUM_ERR_STRUCT,
                "channel 0: struct_size is |must be |baum_channel_of()");
    channels[0].struct_size = sizeof *channels;
    channels[1].struct_size = sizes[k];
    ASSERT_SAYS(baum_simulation_sample(run, &t, 1, channels, 2, row, NULL), BAUM_ERR_STRUCT,
                "channel 1: struct_size is |as in channel 0|baum_channel_of()");
    assert_int_equal(baum_channels_width(parts.mechanism, channels, 2), -1);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
}

static void a_point_outside_of_a_bodys_plane_is_refused(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_channel channel = baum_channel_of_point(BAUM_BODY_POSE, parts.crank, 0.1, 0.0, 0.2);
  assert_int_equal(baum_channels_width(parts.mechanism, &channel, 1), -1);
  assert_non_null(strstr(baum_message(), "point is (0.1, 0, 0.2) m"));
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(accelerations_are_the_slopes_of_velocities),
    cmocka_unit_test(accelerations_of_bodies_are_their_part_of_a),
    cmocka_unit_test(the_power_of_a_driver_is_the_change_of_energy),
    cmocka_unit_test(only_channels_that_need_accelerations_or_multipliers_cost_a_solution),
    cmocka_unit_test(channels_that_follow_from_the_state_call_no_user_function),
    cmocka_unit_test(more_columns_than_can_be_counted_are_refused),
    cmocka_unit_test(overflow_is_reported),
    cmocka_unit_test(channels_of_an_older_version_have_defaults_where_they_end),
    cmocka_unit_test(channels_of_wrong_or_mixed_sizes_are_refused),
    cmocka_unit_test(a_point_outside_of_a_bodys_plane_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
