/* SPDX-License-Identifier: BSD-3-Clause */
/* The first program: 1 kg on a massless rod of 1 m, released from the horizontal. */
#include <stdio.h>

#include <baum/baum.h>

/* Phi(q) = x^2 + y^2 - 1: the only thing the library needs to know about the rod. */
static int circle(double t, const double *q, double *phi, void *user)
{
  (void)t;
  (void)user;
  phi[0] = q[0] * q[0] + q[1] * q[1] - 1.0;
  return 0;
}

int main(void)
{
  baum_mechanism *mechanism = NULL;
  baum_simulation *run = NULL;
  baum_body_id body;

  baum_planar_particle_def bob = baum_planar_particle_def_default();
  bob.position[0] = 1.0;
  baum_user_constraint_def rod = baum_user_constraint_def_default();
  rod.bodies = &body;
  rod.body_count = 1;
  rod.row_count = 1;
  rod.phi = circle;
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_rk4();
  options.step = 1e-3;

  if (baum_mechanism_create(&mechanism) ||
      baum_mechanism_add_planar_particle(mechanism, &bob, &body) ||
      baum_mechanism_add_user_constraint(mechanism, &rod, NULL) ||
      baum_mechanism_freeze(mechanism) || baum_simulation_create(mechanism, &options, &run)) {
    printf("%s\n", baum_message());
    return 1;
  }
  for (int k = 0; k <= 4; k++) {
    if (baum_simulation_advance_to(run, 0.5 * k) != BAUM_OK) {
      printf("%s\n", baum_simulation_message(run));
      return 1;
    }
    const double *q = baum_simulation_q(run);
    printf("t %.1f s   x %9.6f m   y %9.6f m\n", baum_simulation_time(run), q[0], q[1]);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return 0;
}
