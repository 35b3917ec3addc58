/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests sweeps: each run has the same results as if it were made alone, a failed run does not
 * affect the others, and wrong arguments are refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "check.h"
#include "construct.h"
#include "runs.h"

enum { RUNS = 20, TIMES = 3, WIDTH = 6, SIZE = TIMES * WIDTH, BAD = 7 };

static const double times[TIMES] = {0.0, 0.1, 0.25};

typedef struct arm {
  baum_mechanism *mechanism;
  baum_body_id body;
  baum_channel channels[2];
  baum_simulation_options options;
  double masses[RUNS];
} arm;

static int set_up(void **state)
{
  static arm a;
  baum_planar_body_def body = baum_planar_body_def_default();
  body.position[0] = 0.3;
  body.inertia = 0.1;
  a.mechanism = create_mechanism();
  check(baum_mechanism_add_planar_body(a.mechanism, &body, &a.body));
  (void)add_planar_pin(a.mechanism, NULL, BAUM_GROUND, a.body, 0.0, 0.0);
  check(baum_mechanism_freeze(a.mechanism));
  a.channels[0] = baum_channel_of_body(BAUM_BODY_POSE, a.body);
  a.channels[1] = baum_channel_of(BAUM_V);
  a.options = baum_simulation_options_default();
  a.options.integrator = baum_rk8();
  a.options.rtol = 1e-8;
  for (int k = 0; k < RUNS; k++) {
    a.masses[k] = 1.0 + 0.1 * k;
  }
  *state = &a;
  return 0;
}

static int tear_down(void **state)
{
  arm *a = *state;
  baum_mechanism_destroy(a->mechanism);
  return 0;
}

static baum_status change_mass(baum_mechanism *copy, int64_t run, void *user)
{
  const arm *a = user;
  baum_planar_body_def def;
  check(baum_mechanism_get_planar_body(copy, a->body, &def, sizeof def));
  def.mass = a->masses[run];
  return baum_mechanism_set_planar_body(copy, a->body, &def);
}

static baum_sweep_def sweep_of(arm *a)
{
  baum_sweep_def def = baum_sweep_def_default();
  def.count = RUNS;
  def.change = change_mass;
  def.user = a;
  def.times = times;
  def.time_count = TIMES;
  def.channels = a->channels;
  def.channel_count = 2;
  return def;
}

static void run_alone(arm *a, int k, double *rows)
{
  baum_mechanism *copy = NULL;
  check(baum_mechanism_copy(a->mechanism, &copy));
  check(change_mass(copy, k, a));
  check(baum_mechanism_freeze(copy));
  baum_simulation *run = create_run(copy, &a->options);
  check(baum_simulation_sample(run, times, TIMES, a->channels, 2, rows, NULL));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(copy);
}

static void each_run_equals_the_run_alone(void **state)
{
  arm *a = *state;
  for (int threads = 1; threads <= 3; threads++) {
    double rows[RUNS][SIZE];
    double alone[SIZE];
    int32_t statuses[RUNS];
    baum_sweep_def def = sweep_of(a);
    def.threads = threads;
    check(baum_sweep(a->mechanism, &a->options, &def, rows[0], statuses));
    for (int k = 0; k < RUNS; k++) {
      run_alone(a, k, alone);
      assert_memory_equal(rows[k], alone, sizeof alone);
      assert_int_equal(statuses[k], BAUM_OK);
    }
    assert_memory_not_equal(rows[0], rows[1], sizeof rows[0]);
  }
}

static void a_failed_run_does_not_stop_the_others(void **state)
{
  arm *a = *state;
  double rows[RUNS][SIZE];
  double alone[SIZE];
  int32_t statuses[RUNS];
  baum_sweep_def def = sweep_of(a);
  def.threads = 2;
  const double masses[2] = {a->masses[BAD], a->masses[BAD + 2]};
  a->masses[BAD] = -1.0;
  a->masses[BAD + 2] = -2.0;
  assert_int_equal(baum_sweep(a->mechanism, &a->options, &def, rows[0], statuses),
                   BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "run 7: body 1 \"body1\": mass is -1 kg"));
  assert_int_equal(baum_sweep(a->mechanism, &a->options, &def, rows[0], NULL), BAUM_ERR_ARGUMENT);
  a->masses[BAD] = masses[0];
  a->masses[BAD + 2] = masses[1];
  for (int k = 0; k < RUNS; k++) {
    const bool bad = k == BAD || k == BAD + 2;
    assert_int_equal(statuses[k], bad ? BAUM_ERR_ARGUMENT : BAUM_OK);
    run_alone(a, k, alone);
    assert_true(bad ? isnan(rows[k][0]) && isnan(rows[k][SIZE - 1])
                    : memcmp(rows[k], alone, sizeof alone) == 0);
  }
}

/* Adds a body in one run, so that the channel of all positions has more numbers in that run. */
static baum_status add_body(baum_mechanism *copy, int64_t run, void *user)
{
  (void)user;
  const baum_planar_body_def def = baum_planar_body_def_default();
  return run == BAD ? baum_mechanism_add_planar_body(copy, &def, NULL) : BAUM_OK;
}

static void a_run_with_more_numbers_fails(void **state)
{
  arm *a = *state;
  double rows[RUNS][SIZE];
  int32_t statuses[RUNS];
  baum_sweep_def def = sweep_of(a);
  baum_channel all;
  baum_channel_init(&all, sizeof all);
  all.quantity = BAUM_Q;
  def.change = add_body;
  def.channels = &all;
  def.channel_count = 1;
  assert_int_equal(baum_sweep(a->mechanism, &a->options, &def, rows[0], statuses),
                   BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "run 7: the channels have 6 columns"));
  assert_int_equal(statuses[BAD - 1], BAUM_OK);
  assert_int_equal(statuses[BAD + 1], BAUM_OK);
}

static baum_status fail_with_a_message(baum_mechanism *copy, int64_t run, void *user)
{
  (void)copy;
  (void)run;
  (void)user;
  return baum_fail(BAUM_ERR_CALLBACK, "a message");
}

static baum_status fail_silently(baum_mechanism *copy, int64_t run, void *user)
{
  (void)copy;
  (void)run;
  (void)user;
  return BAUM_ERR_CALLBACK;
}

static void messages_are_those_of_the_failure(void **state)
{
  arm *a = *state;
  double rows[RUNS][SIZE];
  baum_sweep_def def = sweep_of(a);
  def.change = fail_with_a_message;
  def.threads = 1;
  def.count = 1;
  assert_int_equal(baum_sweep(a->mechanism, &a->options, &def, rows[0], NULL), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "run 0: a message");
  def.change = fail_silently;
  assert_int_equal(baum_sweep(a->mechanism, &a->options, &def, rows[0], NULL), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "run 0: change() returned an error without a message");
  (void)baum_fail(BAUM_ERR_STATE, "an earlier message");
  def.change = change_mass;
  check(baum_sweep(a->mechanism, &a->options, &def, rows[0], NULL));
  assert_string_equal(baum_message(), "an earlier message");
}

static void wrong_arguments_are_refused(void **state)
{
  arm *a = *state;
  double rows[RUNS * SIZE];
  const baum_sweep_def good = sweep_of(a);
  baum_sweep_def wrong[9];
  for (int k = 0; k < 9; k++) {
    wrong[k] = good;
  }
  const baum_channel none = baum_channel_of_body(BAUM_BODY_POSE, (baum_body_id){0});
  wrong[0].count = 0;
  wrong[1].change = NULL;
  wrong[2].times = NULL;
  wrong[3].time_count = 0;
  wrong[4].channels = NULL;
  wrong[5].channel_count = -1;
  wrong[6].threads = 0;
  wrong[7].threads = 1025;
  wrong[8].channels = &none;
  wrong[8].channel_count = 1;
  for (int k = 0; k < 9; k++) {
    assert_int_equal(baum_sweep(a->mechanism, &a->options, &wrong[k], rows, NULL),
                     BAUM_ERR_ARGUMENT);
  }
  wrong[0].struct_size = 3;
  assert_int_equal(baum_sweep(a->mechanism, &a->options, &wrong[0], rows, NULL), BAUM_ERR_STRUCT);
  assert_int_equal(baum_sweep(NULL, &a->options, &good, rows, NULL), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_sweep(a->mechanism, NULL, &good, rows, NULL), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_sweep(a->mechanism, &a->options, NULL, rows, NULL), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_sweep(a->mechanism, &a->options, &good, NULL, NULL), BAUM_ERR_ARGUMENT);
  baum_mechanism *open = NULL;
  check(baum_mechanism_copy(a->mechanism, &open));
  assert_int_equal(baum_sweep(open, &a->options, &good, rows, NULL), BAUM_ERR_STATE);
  baum_mechanism_destroy(open);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(each_run_equals_the_run_alone),
    cmocka_unit_test(a_failed_run_does_not_stop_the_others),
    cmocka_unit_test(a_run_with_more_numbers_fails),
    cmocka_unit_test(messages_are_those_of_the_failure),
    cmocka_unit_test(wrong_arguments_are_refused),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
