/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests Runge-Kutta methods: their coefficients, one step compared with its closed form, and stages
 * that fail. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "integrator_run.h"
#include "one_coordinate.h"

typedef const baum_integrator *method_fn(void);
static method_fn *const METHODS[] = {baum_rk2, baum_rk3, baum_rk4};

static integrator_setup setup_of(baum_mechanism *mechanism, const baum_integrator *integrator)
{
  integrator_setup setup =
    integrator_setup_make(mechanism, integrator, BAUM_FORMULATION_UNSTABILIZED);
  setup.step = 0.1;
  return setup;
}

/* For x'' = -4 x, one step multiplies the complex number x - i x'/2 by R(2 i h). Here R is the
 * stability polynomial of the method. In this test h = 0.1. */
static void one_step_of_an_oscillator_is_the_stability_polynomial(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_oscillator();
  for (int k = 0; k < 3; k++) {
    const baum_integrator *integrator = METHODS[k]();
    const double *c = integrator->method.coefficients;
    integrator_setup setup = setup_of(mechanism, integrator);
    integrator_run run;
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
    double z = 0.2;
    double re = c[0] - c[2] * z * z + (k == 2 ? c[4] * z * z * z * z : 0.0);
    double im = c[1] * z - (k > 0 ? c[3] * z * z * z : 0.0);
    ASSERT_NEAR(run.state_q[0], re, 0.0, 1e-15);
    ASSERT_NEAR(run.state_v[0], -2.0 * im, 0.0, 1e-15);
    integrator_run_close(&run);
  }
  baum_mechanism_destroy(mechanism);
}

/* A method integrates v' = t^p exactly up to p = order - 1. This tests the times c of the stages
 * together with the weights b. */
static int push(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)q;
  (void)v;
  (void)inputs;
  out[0] = pow(t, *(const int *)user);
  return 0;
}

static void polynomial_forces_of_time_are_integrated_exactly(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    const baum_integrator *integrator = METHODS[k]();
    for (int power = 0; power < integrator->order; power++) {
      baum_mechanism *mechanism = one_coordinate(0.0, 0.0, push, &power, NULL);
      integrator_setup setup = setup_of(mechanism, integrator);
      integrator_run run;
      assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
      assert_int_equal(integrator_run_to(&run, 1.0), BAUM_OK);
      ASSERT_NEAR(run.v[0], 1.0 / (power + 1.0), 0.0, 1e-14);
      integrator_run_close(&run);
      baum_mechanism_destroy(mechanism);
    }
  }
}

/* If a stage fails, the step must leave the state unchanged, so that it can be repeated. */
static void a_failing_stage_keeps_the_state(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    force_fault fault = {.after = (double)INFINITY, .answer = -1};
    baum_mechanism *mechanism = make_faulty_pendulum(&fault);
    integrator_setup setup = setup_of(mechanism, METHODS[k]());
    integrator_run run;
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    assert_int_equal(integrator_run_to(&run, 0.5), BAUM_OK);
    double q[2] = {run.state_q[0], run.state_q[1]};
    double v[2] = {run.state_v[0], run.state_v[1]};
    for (int stage = 0; stage < 2; stage++) {
      fault.after = 0.52 + 0.04 * stage; /* the stages are at 0.5, 0.55 and 0.6 */
      baum_status status = integrator_run_step(&run);
      if (METHODS[k]()->order == 2 && stage == 1) {
        assert_int_equal(status, BAUM_OK);
        continue;
      }
      assert_int_equal(status, BAUM_ERR_CALLBACK);
      assert_memory_equal(run.state_q, q, sizeof q);
      assert_memory_equal(run.state_v, v, sizeof v);
    }
    fault.after = (double)INFINITY;
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
    integrator_run_close(&run);
    baum_mechanism_destroy(mechanism);
  }
}

/* A step needs one evaluation for each stage. This includes the first stage, which the caller
 * evaluates. */
static void a_step_costs_one_evaluation_for_each_stage(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_pendulum();
  for (int k = 0; k < 3; k++) {
    integrator_setup setup = setup_of(mechanism, METHODS[k]());
    integrator_run run;
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    int64_t before = run.workspace->evaluations;
    assert_int_equal(integrator_run_to(&run, 1.0), BAUM_OK);
    assert_int_equal(run.workspace->evaluations - before, 10 * METHODS[k]()->order);
    integrator_run_close(&run);
  }
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(one_step_of_an_oscillator_is_the_stability_polynomial),
    cmocka_unit_test(polynomial_forces_of_time_are_integrated_exactly),
    cmocka_unit_test(a_failing_stage_keeps_the_state),
    cmocka_unit_test(a_step_costs_one_evaluation_for_each_stage),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
