/* SPDX-License-Identifier: BSD-3-Clause */
/* If the design position of a body is the origin, its coordinates are small compared with the arms
 * of its joints. In this case the arms determine the size of rounding errors. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "construct.h"
#include "runs.h"

/* Makes a body at rest whose pin is about 0.3 m from its centre. */
static baum_mechanism *make_swing(double gravity)
{
  baum_body_id body;
  baum_planar_body_def bar = baum_planar_body_def_default();
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(m, 0.0, -gravity, 0.0), BAUM_OK);
  bar.mass = 1.0;
  bar.inertia = 0.1;
  assert_int_equal(baum_mechanism_add_planar_body(m, &bar, &body), BAUM_OK);
  (void)add_planar_pin(m, NULL, BAUM_GROUND, body, -0.3, 0.03);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static void swing(const baum_integrator *integrator, double gravity, double step)
{
  baum_mechanism *m = make_swing(gravity);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.step = step;
  baum_simulation *run = create_run(m, &o);
  if (baum_simulation_step(run, 1000) != BAUM_OK) {
    fail_msg("%s, step %g s, gravity %g: %s", baum_integrator_name(integrator), step, gravity,
             baum_message());
  }
  baum_counters counters = counters_of(run);
  assert_true(counters.max_phi <= 4e-16); /* rounding error of the arm */
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void methods_that_solve_for_positions_make_small_steps_at_the_origin(void **state)
{
  (void)state;
  static const double GRAVITY[3] = {9.81, 1e-3, 1e-9};
  static const double STEP[3] = {1e-3, 1e-4, 1e-5};
  for (int g = 0; g < 3; g++) {
    for (int h = 0; h < 3; h++) {
      swing(baum_rattle(), GRAVITY[g], STEP[h]);
      swing(baum_generalized_alpha(), GRAVITY[g], STEP[h]);
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(methods_that_solve_for_positions_make_small_steps_at_the_origin),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
