/* SPDX-License-Identifier: BSD-3-Clause */
/* If max_step is given, integrators with variable steps must not step over a short force during a
 * long rest. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "construct.h"
#include "runs.h"

/* A force of 5 N along x, which acts from 5.0 s to 5.2 s. */
static int push(double t, const double *q, const double *v, const double *inputs, double *out,
                void *user)
{
  (void)q, (void)v, (void)inputs, (void)user;
  out[0] = t >= 5.0 && t < 5.2 ? 5.0 : 0.0;
  return 0;
}

/* Makes a particle of 1 kg that hangs at rest on a rod of 1 m. */
static baum_mechanism *hanging_pendulum(void)
{
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  baum_user_force_def force = baum_user_force_def_default();
  baum_body_id body;
  baum_mechanism *m = create_mechanism();
  bob.position[1] = -1.0;
  assert_int_equal(baum_mechanism_add_planar_particle(m, &bob, &body), BAUM_OK);
  rod.body_a = BAUM_GROUND;
  rod.body_b = body;
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  assert_int_equal(baum_mechanism_add_planar_distance(m, &rod, NULL), BAUM_OK);
  force.bodies = &body;
  force.body_count = 1;
  force.force = push;
  assert_int_equal(baum_mechanism_add_user_force(m, &force, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

/* Returns the position x at 5.5 s. */
static double pushed_position(const baum_mechanism *m, const baum_integrator *integrator,
                              double max_step)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  if (isnan(max_step)) {
    o.step = 1e-3;
  } else {
    o.rtol = 1e-6;
    o.max_step = max_step;
  }
  baum_simulation *s = create_run(m, &o);
  assert_int_equal(baum_simulation_advance_to(s, 5.5), BAUM_OK);
  double x = baum_simulation_q(s)[0];
  baum_simulation_destroy(s);
  return x;
}

static void a_force_that_begins_late_is_not_stepped_over(void **state)
{
  (void)state;
  baum_mechanism *m = hanging_pendulum();
  double want = pushed_position(m, baum_rk4(), (double)NAN);
  assert_true(want > 0.1);
  const baum_integrator *integrators[] = {baum_dp5(), baum_rk8(), baum_cvode_adams(),
                                          baum_cvode_bdf(), baum_ida()};
  for (int k = 0; k < (baum_has("sundials") ? 5 : 2); k++) {
    /* The force jumps inside a step, which causes errors above the tolerance. */
    ASSERT_NEAR(pushed_position(m, integrators[k], 0.05), want, 0.0, 1e-3);
  }
  baum_mechanism_destroy(m);
}

static void gravity_determines_alpha_at_rest(void **state)
{
  (void)state;
  if (!baum_has("sundials")) {
    skip();
  }
  baum_mechanism *m = hanging_pendulum();
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_cvode_adams();
  o.rtol = 1e-6;
  baum_simulation *s = create_run(m, &o);
  baum_counters c = counters_of(s);
  ASSERT_NEAR(c.alpha, 0.25 * sqrt(9.81), 1e-12, 0.0); /* 1/4 of sqrt(g / L) */
  baum_simulation_destroy(s);
  baum_mechanism_destroy(m);
}

static void max_step_is_validated(void **state)
{
  (void)state;
  baum_mechanism *m = hanging_pendulum();
  baum_simulation_options o = baum_simulation_options_default();
  baum_simulation *s = NULL;
  o.integrator = baum_rk4();
  o.step = 1e-3;
  o.max_step = 0.1;
  assert_int_equal(baum_simulation_create(m, &o, &s), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "max_step is 0.1 s, but rk4 has a fixed step"));
  o.integrator = baum_ida();
  o.step = (double)NAN;
  o.rtol = 1e-6;
  o.max_step = -1.0;
  assert_int_equal(baum_simulation_create(m, &o, &s), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "max_step is -1 s, must be > 0"));
  assert_null(s);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_force_that_begins_late_is_not_stepped_over),
    cmocka_unit_test(gravity_determines_alpha_at_rest),
    cmocka_unit_test(max_step_is_validated),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
