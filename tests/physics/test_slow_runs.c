/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs a particle on a guide that moves slowly in the unit of time, and compares the motion and the
 * reaction with those of the same mechanism with w = 1. With the time w t, both are the same:
 *
 *   Phi = x - sin(w t) + 0.1 y cos(w t)
 *
 * The library computes all derivatives of Phi by differences. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "construct.h"
#include "runs.h"
#include "step_mode.h"

static int guide(double t, const double *q, double *out, void *user)
{
  const double w = *(const double *)user;
  out[0] = q[0] - sin(w * t) + 0.1 * q[1] * cos(w * t);
  return 0;
}

static baum_mechanism *make(double *w)
{
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0), BAUM_OK);
  baum_planar_particle_def bead = baum_planar_particle_def_default();
  bead.mass = 1.0;
  bead.position[0] = -0.1;
  bead.position[1] = 1.0;
  bead.velocity[1] = 0.5 * *w;
  baum_body_id body;
  assert_int_equal(baum_mechanism_add_planar_particle(m, &bead, &body), BAUM_OK);
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.bodies = &body;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = guide;
  def.user = w;
  assert_int_equal(baum_mechanism_add_user_constraint(m, &def, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

/* Writes q, a / w^2 and lambda / w^2 at the time 6 / w. */
static void run_at(double w, step_mode mode, double end[5])
{
  baum_mechanism *m = make(&w);
  baum_simulation_options o = step_mode_options(mode, 0.02 / w, 1e-7);
  baum_simulation *run = create_run(m, &o);
  baum_channel channels[3] = {baum_channel_of(BAUM_Q), baum_channel_of(BAUM_A),
                              baum_channel_of(BAUM_LAMBDA)};
  double t = 6.0 / w;
  assert_int_equal(baum_simulation_sample(run, &t, 1, channels, 3, end, NULL), BAUM_OK);
  for (int i = 2; i < 5; i++) {
    end[i] /= w * w;
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

static void slow_motions_are_as_accurate_as_fast_ones(void **state)
{
  (void)state;
  const double rates[] = {1e-2, 1e-4, 1e-6, 1e-7, 1e-8};
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    const char *name = baum_integrator_name(mode.integrator);
    /* The error of CVODE depends on the unit of time, even if all derivatives are given. */
    if (strncmp(name, "cvode", 5) == 0) {
      continue;
    }
    double want[5];
    run_at(1.0, mode, want);
    for (int i = 0; i < 5; i++) {
      double got[5];
      run_at(rates[i], mode, got);
      for (int j = 0; j < 5; j++) {
        /* The error estimates of methods with variable steps depend on rounding. */
        ASSERT_NEAR(got[j], want[j], 0.0, mode.fixed ? 1e-8 : 2e-5);
      }
    }
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(slow_motions_are_as_accurate_as_fast_ones),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
