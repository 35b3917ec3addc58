/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests events. Invalid definitions must be refused, event functions that fail must end the call,
 * and locating events must allocate no memory. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "heap.h"
#include "pendulum_events.h"
#include "runs.h"
#include "step_mode.h"

static baum_simulation *open_mode(const swing *s, step_mode mode)
{
  baum_simulation_options o = step_mode_options(mode, 0.01, 1e-6);
  return create_run(s->mechanism, &o);
}

enum { HEALED = 2 };

/* An event function that fails after 0.25 s. It then returns *user. If *user is 0, it sets an
 * infinite value instead, and if *user is HEALED, it does not fail. */
static int failing(double t, const double *q, const double *v, const double *inputs, double *out,
                   void *user)
{
  (void)v;
  (void)inputs;
  out[0] = q[2];
  if (t <= 0.25 || *(const int *)user == HEALED) {
    return 0;
  }
  int answer = *(const int *)user;
  out[0] = answer == 0 ? (double)INFINITY : q[2];
  return answer;
}

static void refuse(baum_simulation *run, const baum_event_def *def, const char *why)
{
  int32_t index = 77;
  assert_int_equal(baum_simulation_add_event(run, def, &index), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), why));
  assert_int_equal(index, 77);
}

static void definitions_are_checked(void **state)
{
  (void)state;
  swing s = swing_make(1.0);
  baum_simulation *run = open_mode(&s, (step_mode){baum_rk4(), true});
  baum_event_def def = baum_event_def_default();
  def.name = "";
  refuse(run, &def, "event 0: name is empty; NULL stands for the default name");
  def.name = "sto\np";
  refuse(run, &def, "event 0: name has the control character 0x0a at index 3");
  def.name = "stop";
  refuse(run, NULL, "the definition is NULL");
  refuse(NULL, &def, "the simulation is NULL");
  refuse(run, &def, "event 0 \"stop\": neither function() nor joint is given");
  def.joint = s.pin;
  def.function = failing;
  refuse(run, &def, "both given");
  def.function = NULL;
  def.joint.tag++;
  refuse(run, &def, "joint is not of this mechanism");
  def.joint = s.pin;
  def.value = (double)NAN;
  refuse(run, &def, "value is nan");
  def.value = 0.0;
  def.direction = 2;
  refuse(run, &def, "direction is 2, must be -1, 0 or 1");
  def.direction = 0;
  def.tolerance = 0.0;
  refuse(run, &def, "tolerance is 0");
  def.tolerance = (double)NAN;
  def.struct_size = 3;
  assert_int_equal(baum_simulation_add_event(run, &def, NULL), BAUM_ERR_STRUCT);
  baum_event_record record;
  assert_int_equal(baum_simulation_event_count(NULL), 0);
  assert_int_equal(baum_simulation_event_count(run), 0);
  assert_int_equal(baum_simulation_event(NULL, 0, &record, sizeof record), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_event(run, 0, &record, sizeof record), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_event(run, 0, NULL, sizeof record), BAUM_ERR_ARGUMENT);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(s.mechanism);
}

static void failing_functions_end_the_call(void **state)
{
  (void)state;
  static const int answers[] = {-1, 1, 0};
  swing s = swing_make(1.0);
  for (int k = 0; step_mode_at(k).integrator; k++) {
    for (int i = 0; i < 3; i++) {
      int answer = answers[i];
      baum_simulation *run = open_mode(&s, step_mode_at(k));
      baum_event_def def = baum_event_def_default();
      def.function = failing;
      def.user = &answer;
      assert_int_equal(baum_simulation_add_event(run, &def, NULL), BAUM_OK);
      baum_status want = answer == 0 ? BAUM_ERR_NOT_FINITE : BAUM_ERR_CALLBACK;
      assert_int_equal(baum_simulation_advance_to(run, 0.3), want);
      assert_non_null(strstr(baum_message(), "event 0"));
      assert_true(baum_simulation_time(run) <= 0.26); /* at most one more step */
      /* The run can continue when the function works again. */
      answer = HEALED;
      assert_int_equal(baum_simulation_advance_to(run, 0.27), BAUM_OK);
      assert_true(baum_simulation_time(run) == 0.27);
      baum_simulation_destroy(run);
    }
  }
  baum_mechanism_destroy(s.mechanism);
}

static void locating_events_allocates_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  swing s = swing_make(1.0);
  for (int k = 0; step_mode_at(k).integrator; k++) {
    baum_simulation *run = open_mode(&s, step_mode_at(k));
    baum_event_def def = baum_event_def_default();
    def.joint = s.pin;
    def.terminal = k % 2 == 0;
    assert_int_equal(baum_simulation_add_event(run, &def, NULL), BAUM_OK);
    (void)baum_simulation_advance_to(run, 1.0);
    int64_t before = baum_simulation_event_count(run);
    heap_watch();
    for (int i = 2; i < 8; i++) {
      (void)baum_simulation_advance_to(run, i);
    }
    long allocations = heap_stop();
    assert_true(baum_simulation_event_count(run) > before);
    assert_int_equal(allocations, 0);
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(s.mechanism);
}

static void every_allocation_of_an_event_may_fail(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  swing s = swing_make(1.0);
  long blocks = heap_blocks();
  baum_status status = BAUM_ERR_MEMORY;
  for (long n = 0; status != BAUM_OK; n++) {
    baum_simulation *run = open_mode(&s, (step_mode){baum_rk4(), true});
    baum_event_def def = baum_event_def_default();
    def.joint = s.pin;
    def.name = "stop";
    heap_fail(n, false);
    status = baum_simulation_add_event(run, &def, NULL);
    (void)heap_stop();
    assert_true(status == BAUM_OK || status == BAUM_ERR_MEMORY);
    assert_int_equal(baum_simulation_advance_to(run, 1.0),
                     status == BAUM_OK ? BAUM_STOP_EVENT : BAUM_OK);
    baum_simulation_destroy(run);
  }
  assert_int_equal(heap_blocks(), blocks);
  baum_mechanism_destroy(s.mechanism);
}

int main(void)
{
  /* The first call of heap_is_ours() looks up the functions that heap.h excludes. */
  (void)heap_is_ours();
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(definitions_are_checked),
    cmocka_unit_test(failing_functions_end_the_call),
    cmocka_unit_test(locating_events_allocates_nothing),
    cmocka_unit_test(every_allocation_of_an_event_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
