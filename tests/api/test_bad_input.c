/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests inputs and laws of drivers that must be refused. Each test compares the message, and checks
 * that nothing has changed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "every_element.h"
#include "message.h"
#include "runs.h"

static const baum_input_id NONE = {0, 0};
static const baum_input_id SENTINEL = {77, 88};

static const double bad_values[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
enum { BAD_VALUES = sizeof bad_values / sizeof *bad_values };

static baum_simulation *start(const baum_mechanism *mechanism)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk2();
  o.step = 1e-3;
  return create_run(mechanism, &o);
}

/* ---- inputs of a mechanism ---- */

static void a_mechanism_refuses_bad_inputs(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  every_element others = {.fault = NULL};
  assert_int_equal(every_element_build(&parts), BAUM_OK);
  assert_int_equal(every_element_build(&others), BAUM_OK);
  baum_input_id id = SENTINEL;
  double value = 7.0;
  ASSERT_SAYS(baum_mechanism_add_input(NULL, "u", 0.0, &id), BAUM_ERR_ARGUMENT,
              "baum_mechanism_add_input: the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_set_input(NULL, parts.throttle, 0.0), BAUM_ERR_ARGUMENT,
              "baum_mechanism_set_input: the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_get_input(NULL, parts.throttle, &value), BAUM_ERR_ARGUMENT,
              "baum_mechanism_get_input: the mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_get_input(parts.mechanism, parts.throttle, NULL), BAUM_ERR_ARGUMENT,
              "baum_mechanism_get_input: initial is NULL");
  ASSERT_SAYS(baum_mechanism_get_input(parts.mechanism, NONE, &value), BAUM_ERR_ARGUMENT,
              "baum_mechanism_get_input: input is none");
  ASSERT_SAYS(baum_mechanism_set_input(parts.mechanism, others.throttle, 2.0), BAUM_ERR_ARGUMENT,
              "baum_mechanism_set_input: input is not of this mechanism");
  for (int k = 0; k < BAD_VALUES; k++) {
    char message[80];
    (void)snprintf(message, sizeof message, "\" is %g, must be finite", bad_values[k]);
    ASSERT_SAYS(baum_mechanism_add_input(parts.mechanism, "u", bad_values[k], &id),
                BAUM_ERR_ARGUMENT, message);
    assert_non_null(strstr(baum_message(), "input 2 \"u\""));
    ASSERT_SAYS(baum_mechanism_set_input(parts.mechanism, parts.throttle, bad_values[k]),
                BAUM_ERR_ARGUMENT, message);
    assert_non_null(strstr(baum_message(), "input 1 \"throttle\""));
  }
  ASSERT_SAYS(baum_mechanism_add_input(parts.mechanism, "", 0.0, &id), BAUM_ERR_ARGUMENT,
              "input 2: name is empty; NULL stands for the default name");
  ASSERT_SAYS(baum_mechanism_add_input(parts.mechanism, "a\rb", 0.0, &id), BAUM_ERR_ARGUMENT,
              "input 2: name has the control character 0x0d at index 1");
  assert_memory_equal(&id, &SENTINEL, sizeof id);
  assert_int_equal(baum_mechanism_input_count(parts.mechanism), 1);
  assert_true(value == 7.0);
  assert_int_equal(baum_mechanism_get_input(parts.mechanism, parts.throttle, &value), BAUM_OK);
  assert_true(value == 1.0);
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(others.mechanism);
}

static void a_frozen_mechanism_keeps_its_inputs(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_input_id id = SENTINEL;
  double value = 0.0;
  ASSERT_SAYS(baum_mechanism_add_input(parts.mechanism, "u", 0.0, &id), BAUM_ERR_STATE,
              "baum_mechanism_add_input: the mechanism is frozen; change a copy of it");
  ASSERT_SAYS(baum_mechanism_set_input(parts.mechanism, parts.throttle, 0.0), BAUM_ERR_STATE,
              "baum_mechanism_set_input: the mechanism is frozen; change a copy of it");
  assert_memory_equal(&id, &SENTINEL, sizeof id);
  assert_int_equal(baum_mechanism_get_input(parts.mechanism, parts.throttle, &value), BAUM_OK);
  assert_true(value == 1.0);
  baum_mechanism_destroy(parts.mechanism);
}

static void reading_inputs_refuses_null_and_foreign_ids(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  every_element others = every_element_make(NULL);
  baum_simulation *run = start(parts.mechanism);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(parts.mechanism, &w), BAUM_OK);
  assert_int_equal(baum_mechanism_input_count(NULL), 0);
  assert_null(baum_mechanism_input_name(NULL, parts.throttle));
  assert_true(isnan(baum_simulation_input(NULL, parts.throttle)));
  assert_true(isnan(baum_workspace_input(NULL, parts.throttle)));
  const baum_input_id foreign[] = {NONE, SENTINEL, others.throttle, {2, parts.throttle.tag}};
  for (int k = 0; k < 4; k++) {
    assert_null(baum_mechanism_input_name(parts.mechanism, foreign[k]));
    assert_true(isnan(baum_simulation_input(run, foreign[k])));
    assert_true(isnan(baum_workspace_input(w, foreign[k])));
  }
  baum_workspace_destroy(w);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(others.mechanism);
}

/* ---- inputs of a workspace and of a run ---- */

static void a_workspace_refuses_bad_inputs(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  every_element others = every_element_make(NULL);
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(parts.mechanism, &w), BAUM_OK);
  ASSERT_SAYS(baum_workspace_set_input(NULL, parts.throttle, 0.0), BAUM_ERR_ARGUMENT,
              "baum_workspace_set_input: the workspace is NULL");
  ASSERT_SAYS(baum_workspace_set_input(w, NONE, 0.0), BAUM_ERR_ARGUMENT,
              "baum_workspace_set_input: input is none");
  ASSERT_SAYS(baum_workspace_set_input(w, others.throttle, 0.0), BAUM_ERR_ARGUMENT,
              "baum_workspace_set_input: input is not of this mechanism");
  ASSERT_SAYS(baum_workspace_set_input(w, parts.throttle, bad_values[0]), BAUM_ERR_ARGUMENT,
              "baum_workspace_set_input: input 1 \"throttle\" is nan, must be finite");
  assert_true(baum_workspace_input(w, parts.throttle) == 1.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(others.mechanism);
}

static void a_run_refuses_bad_inputs(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  every_element others = every_element_make(NULL);
  baum_simulation *run = start(parts.mechanism);
  ASSERT_SAYS(baum_simulation_set_input(NULL, parts.throttle, 0.0), BAUM_ERR_ARGUMENT,
              "baum_simulation_set_input: the simulation is NULL");
  ASSERT_SAYS(baum_simulation_set_input(run, NONE, 0.0), BAUM_ERR_ARGUMENT,
              "baum_simulation_set_input: input is none");
  ASSERT_SAYS(baum_simulation_set_input(run, others.throttle, 0.0), BAUM_ERR_ARGUMENT,
              "baum_simulation_set_input: input is not of this mechanism");
  for (int k = 0; k < BAD_VALUES; k++) {
    ASSERT_SAYS(baum_simulation_set_input(run, parts.throttle, bad_values[k]), BAUM_ERR_ARGUMENT,
                "baum_simulation_set_input: input 1 \"throttle\" is |must be finite");
  }
  assert_true(baum_simulation_input(run, parts.throttle) == 1.0);
  assert_string_equal(baum_simulation_message(run), "");
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(others.mechanism);
}

static void a_run_refuses_bad_schedules(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  every_element others = every_element_make(NULL);
  baum_simulation *run = start(parts.mechanism);
  const baum_input_id u = parts.throttle;
  const double rising[3] = {1.0, 2.0, 3.0};
  ASSERT_SAYS(baum_simulation_schedule_input(NULL, u, rising, rising, 3), BAUM_ERR_ARGUMENT,
              "baum_simulation_schedule_input: the simulation is NULL");
  ASSERT_SAYS(baum_simulation_schedule_input(run, NONE, rising, rising, 3), BAUM_ERR_ARGUMENT,
              "baum_simulation_schedule_input: input is none");
  ASSERT_SAYS(baum_simulation_schedule_input(run, others.throttle, rising, rising, 3),
              BAUM_ERR_ARGUMENT, "schedule_input: input is not of this mechanism");
  ASSERT_SAYS(baum_simulation_schedule_input(run, u, rising, rising, -1), BAUM_ERR_ARGUMENT,
              "count is negative");
  ASSERT_SAYS(baum_simulation_schedule_input(run, u, NULL, rising, 3), BAUM_ERR_ARGUMENT,
              "times or values are NULL");
  ASSERT_SAYS(baum_simulation_schedule_input(run, u, rising, NULL, 3), BAUM_ERR_ARGUMENT,
              "times or values are NULL");
  for (int k = 0; k < BAD_VALUES; k++) {
    const double bad[3] = {-1.0, 0.5, bad_values[k]};
    ASSERT_SAYS(baum_simulation_schedule_input(run, u, rising, bad, 3), BAUM_ERR_ARGUMENT,
                "input 1 \"throttle\": values[2] is |, must be finite");
    ASSERT_SAYS(baum_simulation_schedule_input(run, u, bad, rising, 3), BAUM_ERR_ARGUMENT,
                "input 1 \"throttle\": times[2] is | s, must be finite");
  }
  const double falling[3] = {1.0, 3.0, 2.0};
  const double same[3] = {1.0, 1.0, 2.0};
  ASSERT_SAYS(baum_simulation_schedule_input(run, u, falling, rising, 3), BAUM_ERR_ARGUMENT,
              "\"throttle\": times[2] is 2 s, must be above times[1], which is 3 s");
  ASSERT_SAYS(baum_simulation_schedule_input(run, u, same, rising, 3), BAUM_ERR_ARGUMENT,
              "times[1] is 1 s, must be above times[0], which is 1 s");
  assert_string_equal(baum_simulation_message(run), "");
  assert_int_equal(baum_simulation_step(run, 1), BAUM_OK); /* no schedule may be in effect */
  assert_true(baum_simulation_input(run, u) == 1.0);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(others.mechanism);
}

/* Returns the angle of the crank after 0.1 s. After a law was refused, this angle must be the same
 * as without the attempt. */
static double crank_angle(baum_simulation *run, baum_joint_id pin)
{
  double row[2];
  const baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, pin);
  assert_int_equal(baum_simulation_advance_to(run, 0.1), BAUM_OK);
  assert_int_equal(baum_simulation_get(run, &channel, 1, row), BAUM_OK);
  return row[0];
}

static void a_run_refuses_bad_laws_of_drivers(void **state)
{
  (void)state;
  static const char *const names[3] = {"s", "ds", "dds"};
  every_element parts = every_element_make(NULL);
  every_element others = every_element_make(NULL);
  baum_simulation *run = start(parts.mechanism);
  baum_simulation *untouched = start(parts.mechanism);
  const char *none = "baum_simulation_set_driver: driver is none";
  ASSERT_SAYS(baum_simulation_set_driver(NULL, parts.motor, 0.0, 0.0, 0.0), BAUM_ERR_ARGUMENT,
              "baum_simulation_set_driver: the simulation is NULL");
  ASSERT_SAYS(baum_simulation_set_driver(run, (baum_joint_id){0, 0}, 0.0, 0.0, 0.0),
              BAUM_ERR_ARGUMENT, none);
  ASSERT_SAYS(baum_simulation_set_driver(run, others.motor, 0.0, 0.0, 0.0), BAUM_ERR_ARGUMENT,
              "baum_simulation_set_driver: driver is not of this mechanism");
  ASSERT_SAYS(baum_simulation_set_driver(run, parts.pin, 0.0, 0.0, 0.0), BAUM_ERR_ARGUMENT,
              "baum_simulation_set_driver: joint 1 \"pin\" is a planar revolute joint, not a "
              "driver");
  ASSERT_SAYS(baum_simulation_set_driver(run, parts.circle, 0.0, 0.0, 0.0), BAUM_ERR_ARGUMENT,
              "\"circle\" is a user constraint, not a driver");
  for (int k = 0; k < 3 * BAD_VALUES; k++) {
    double law[3] = {0.0, 0.0, 0.0};
    law[k % 3] = bad_values[k / 3];
    char message[80];
    (void)snprintf(message, sizeof message, "\"motor\": %s is %g rad|must be finite", names[k % 3],
                   bad_values[k / 3]);
    ASSERT_SAYS(baum_simulation_set_driver(run, parts.motor, law[0], law[1], law[2]),
                BAUM_ERR_ARGUMENT, message);
  }
  assert_string_equal(baum_simulation_message(run), "");
  assert_true(crank_angle(run, parts.pin) == crank_angle(untouched, parts.pin));
  baum_simulation_destroy(run);
  baum_simulation_destroy(untouched);
  baum_mechanism_destroy(parts.mechanism);
  baum_mechanism_destroy(others.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_mechanism_refuses_bad_inputs),
    cmocka_unit_test(a_frozen_mechanism_keeps_its_inputs),
    cmocka_unit_test(reading_inputs_refuses_null_and_foreign_ids),
    cmocka_unit_test(a_workspace_refuses_bad_inputs),
    cmocka_unit_test(a_run_refuses_bad_inputs),
    cmocka_unit_test(a_run_refuses_bad_schedules),
    cmocka_unit_test(a_run_refuses_bad_laws_of_drivers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
