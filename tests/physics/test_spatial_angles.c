/* SPDX-License-Identifier: BSD-3-Clause */
/* The angle of a spatial joint counts revolutions in a run, also when it is saved, and a driver
 * prescribes it over many of them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "check.h"

static const double RATE = 40.0;

/* A rotor about a skew axis. */
static baum_mechanism *make(bool driven, baum_joint_id *bearing)
{
  baum_mechanism *m = NULL;
  baum_body_id rotor;
  baum_spatial_body_def body = baum_spatial_body_def_default();
  baum_spatial_revolute_def joint = baum_spatial_revolute_def_default();
  const double axis[3] = {1.0, 2.0, 2.0};
  check(baum_mechanism_create(&m));
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, 0.0));
  if (!driven) {
    for (int i = 0; i < 3; i++) {
      body.angular_velocity[i] = RATE * axis[i] / 3.0;
    }
  }
  check(baum_mechanism_add_spatial_body(m, &body, &rotor));
  joint.body_a = BAUM_GROUND;
  joint.body_b = rotor;
  memset(joint.point, 0, sizeof joint.point);
  memcpy(joint.axis, axis, sizeof axis);
  check(baum_mechanism_add_spatial_revolute(m, &joint, bearing));
  if (driven) {
    baum_driver_def motor = baum_driver_def_default();
    motor.joint = *bearing;
    motor.rate = RATE;
    check(baum_mechanism_add_driver(m, &motor, NULL));
  }
  check(baum_mechanism_freeze(m));
  return m;
}

static baum_simulation *start(const baum_mechanism *m, const baum_integrator *integrator)
{
  baum_simulation *run = NULL;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  if (integrator == baum_rk4()) {
    o.step = 0.01;
  } else if (integrator != baum_kinematics()) {
    o.rtol = 1e-7;
  }
  check(baum_simulation_create(m, &o, &run));
  return run;
}

static double angle_of(baum_simulation *run, baum_joint_id joint)
{
  double out[2];
  const baum_channel channel = baum_channel_of_joint(BAUM_JOINT_COORDINATE, joint);
  check(baum_simulation_get(run, &channel, 1, out));
  return out[0];
}

static void angles_count_revolutions(void **state)
{
  (void)state;
  const baum_integrator *methods[] = {
    baum_rk4(),
    baum_rk8(),
#if BAUM_HAVE_SUNDIALS
    baum_cvode_bdf(),
    baum_ida(),
#endif
  };
  for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
    baum_joint_id bearing;
    baum_mechanism *m = make(false, &bearing);
    baum_simulation *run = start(m, methods[k]);
    for (int i = 1; i <= 10; i++) {
      check(baum_simulation_advance_to(run, 0.5 * i));
      assert_true(fabs(angle_of(run, bearing) - 0.5 * i * RATE) < 1e-2);
    }
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

static void a_restored_run_goes_on_counting(void **state)
{
  (void)state;
  baum_joint_id bearing;
  baum_mechanism *m = make(false, &bearing);
  baum_simulation *run = start(m, baum_rk4());
  baum_simulation *other = start(m, baum_rk4());
  static unsigned char buffer[1 << 16];
  size_t size = 0;
  check(baum_simulation_advance_to(run, 2.0));
  check(baum_simulation_save(run, buffer, sizeof buffer, &size));
  check(baum_simulation_restore(other, buffer, size));
  check(baum_simulation_advance_to(run, 3.0));
  check(baum_simulation_advance_to(other, 3.0));
  assert_true(angle_of(run, bearing) == angle_of(other, bearing));
  assert_true(fabs(angle_of(other, bearing) - 3.0 * RATE) < 1e-2);
  baum_simulation_destroy(run);
  baum_simulation_destroy(other);
  baum_mechanism_destroy(m);
}

static void a_driver_prescribes_many_revolutions(void **state)
{
  (void)state;
  baum_joint_id bearing;
  baum_mechanism *m = make(true, &bearing);
  baum_simulation *run = start(m, baum_kinematics());
  check(baum_simulation_advance_to(run, 5.0));
  assert_true(fabs(angle_of(run, bearing) - 5.0 * RATE) < 1e-9);
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(angles_count_revolutions),
    cmocka_unit_test(a_restored_run_goes_on_counting),
    cmocka_unit_test(a_driver_prescribes_many_revolutions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
