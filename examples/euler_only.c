/* SPDX-License-Identifier: BSD-3-Clause */
/* The smallest program: a static one that calls only baum_euler() holds nothing of SUNDIALS. A rod turns about
 * its upper end for one second. */
#include <math.h>
#include <stdio.h>

#include <baum/baum.h>

int main(void)
{
  baum_mechanism *mechanism = NULL;
  baum_simulation *run = NULL;
  baum_body_id body;

  baum_planar_body_def rod = baum_planar_body_def_default();
  rod.inertia = 1.0 / 12.0;
  rod.position[0] = 0.5;
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = BAUM_GROUND;
  pin.point[0] = pin.point[1] = 0.0;
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_euler();
  options.step = 1e-4;

  if (baum_mechanism_create(&mechanism) != BAUM_OK ||
      baum_mechanism_add_planar_body(mechanism, &rod, &body) != BAUM_OK ||
      (pin.body_b = body, baum_mechanism_add_planar_revolute(mechanism, &pin, NULL)) != BAUM_OK ||
      baum_mechanism_freeze(mechanism) != BAUM_OK ||
      baum_simulation_create(mechanism, &options, &run) != BAUM_OK ||
      baum_simulation_advance_to(run, 1.0) != BAUM_OK) {
    printf("%s\n", baum_message());
    return 1;
  }
  const double *q = baum_simulation_q(run);
  double off = fabs(hypot(q[0], q[1]) - 0.5);
  printf("after %g s the rod's angle is %.4f rad, its pin is off by %.1e m\n",
         baum_simulation_time(run), q[2], off);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return off < 1e-6 ? 0 : 1;
}
