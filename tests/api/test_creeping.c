/* SPDX-License-Identifier: BSD-3-Clause */
/* If the steps of a run are too short to ever reach the end, the run must stop with a message. If
 * the steps are short but still advance the run, the run must continue. */
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
#include "models.h"
#include "runs.h"

enum { STEPS = 10000 }; /* after this many steps, a run checks its progress */

/* Makes a horizontal link of 1 kg and 1 m with a viscous damper. The damper makes the angular
 * velocity decay like exp(-rate t), with `rate` in 1/s. */
static baum_mechanism *greased_link(double rate)
{
  baum_body_id body;
  baum_planar_body_def link = baum_planar_body_def_default();
  baum_planar_torsion_spring_def grease = baum_planar_torsion_spring_def_default();
  baum_mechanism *m = create_mechanism();
  link.mass = 1.0;
  link.inertia = 1.0 / 12.0;
  link.position[0] = 0.5;
  assert_int_equal(baum_mechanism_add_planar_body(m, &link, &body), BAUM_OK);
  (void)add_planar_pin(m, "pin", BAUM_GROUND, body, 0.0, 0.0);
  grease.body_a = BAUM_GROUND;
  grease.body_b = body;
  grease.damping = rate / 3.0; /* the moment of inertia of the link about the pin is 1/3 kg m^2 */
  assert_int_equal(baum_mechanism_add_planar_torsion_spring(m, &grease, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static baum_simulation *open_run(const baum_mechanism *m, const baum_integrator *integrator,
                                 double rtol)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.rtol = rtol;
  return create_run(m, &o);
}

/* For stability, explicit steps must be at most about 5 / rate = 5e-12 s. The motion takes about 1
 * s, so the end cannot be reached. */
static void a_run_whose_steps_are_too_short_to_reach_the_end_stops_with_a_message(void **state)
{
  (void)state;
  baum_mechanism *m = greased_link(1e12);
  const baum_integrator *const explicit[] = {baum_dp5(), baum_rk8()};
  for (int k = 0; k < 2; k++) {
    baum_simulation *run = open_run(m, explicit[k], 1e-6);
    assert_int_equal(baum_simulation_advance_to(run, 1.0), BAUM_ERR_STEP);
    const char *message = baum_simulation_message(run);
    assert_non_null(strstr(message, "hardly advances: the last 10000 steps"));
    assert_non_null(strstr(message, "\"pin\" bears the largest load"));
    assert_true(counters_of(run).steps == STEPS);
    assert_true(baum_simulation_time(run) > 0.0); /* the end of its last step */
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* In this run, steps are about 5e-7 s. They are accepted until max_steps is reached. */
static void short_steps_that_still_advance_the_run_are_accepted(void **state)
{
  (void)state;
  baum_mechanism *m = greased_link(1e7);
  baum_simulation *run = open_run(m, baum_dp5(), 1e-6);
  assert_int_equal(baum_simulation_step(run, 3 * STEPS), BAUM_OK);
  assert_true(baum_simulation_time(run) < 0.1); /* shows that the steps are short */
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* Next to a flat configuration, BDF may fail to advance. The run must then stop within few
 * steps. */
static void a_run_next_to_a_singular_configuration_ends(void **state)
{
  (void)state;
  need_sundials();
  const baum_integrator *const integrators[] = {baum_ida(), baum_cvode_adams(), baum_cvode_bdf()};
  const model_parallelogram_data data = {
    .which = MODEL_THREE_CRANKS, .angle = 1e-8, .units = &MODEL_MILLI};
  model m;
  assert_int_equal(model_parallelogram_build_of(&data, &m), BAUM_OK);
  for (int k = 0; k < 3; k++) {
    baum_simulation *run = open_run(m.mechanism, integrators[k], 1e-7);
    baum_status status = baum_simulation_advance_to(run, 1000.0); /* [ms] */
    assert_true(status == BAUM_WARNED || strlen(baum_simulation_message(run)) > 0);
    assert_true(counters_of(run).steps <=
                2 * STEPS); /* a run that succeeds makes a few hundred steps */
    baum_simulation_destroy(run);
  }
  model_destroy(&m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_run_whose_steps_are_too_short_to_reach_the_end_stops_with_a_message),
    cmocka_unit_test(short_steps_that_still_advance_the_run_are_accepted),
    cmocka_unit_test(a_run_next_to_a_singular_configuration_ends),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
