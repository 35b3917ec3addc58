/* SPDX-License-Identifier: BSD-3-Clause */
/* A small program: it calls only the integrator baum_euler(), so it contains no code of SUNDIALS if
 * it is linked statically. A rod swings about its upper end for one second. */
#include "example_util.h"

static baum_mechanism *turning_rod(void)
{
  baum_mechanism *mechanism = NULL;
  CHECK(baum_mechanism_create(&mechanism));
  baum_planar_body_def rod = baum_planar_body_def_default();
  rod.inertia = 1.0 / 12.0;
  rod.position[0] = 0.5;
  baum_body_id body;
  CHECK(baum_mechanism_add_planar_body(mechanism, &rod, &body));
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = BAUM_GROUND;
  pin.body_b = body;
  pin.point[0] = pin.point[1] = 0.0;
  CHECK(baum_mechanism_add_planar_revolute(mechanism, &pin, NULL));
  CHECK(baum_mechanism_freeze(mechanism));
  return mechanism;
}

int main(int argc, char **argv)
{
  static const example_column columns[] = {
    {"t", "t [s]", 'f', 2}, {"angle", "angle [rad]", 'f', 4}, {"pin", "pin off by [m]", 'e', 1}};
  example_begin(argc, argv, "euler_only");
  baum_mechanism *mechanism = turning_rod();
  baum_simulation_options options = baum_simulation_options_default();
  options.integrator = baum_euler();
  options.step = 1e-4;
  baum_simulation *run = NULL;
  CHECK(baum_simulation_create(mechanism, &options, &run));
  printf("euler_only: rod of 1 m and 1 kg, explicit Euler, h = %g s\n\n", options.step);

  double worst = 0.0;
  example_table("motion", columns, 3, true);
  for (int k = 0; k <= 4; k++) {
    CHECK(baum_simulation_advance_to(run, 0.25 * k));
    const double *q = baum_simulation_q(run);
    double off = fabs(hypot(q[0], q[1]) - 0.5);
    worst = fmax(worst, off);
    example_number(baum_simulation_time(run));
    example_number(q[2]);
    example_number(off);
  }
  example_counters(run);
  example_expect("pin off by [m]", worst, 1e-6);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(mechanism);
  return example_end();
}
