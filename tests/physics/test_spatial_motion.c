/* SPDX-License-Identifier: BSD-3-Clause */
/* Motions in space against solutions found in another way: tops by Euler's equations
 * (manifold_tops.c), planar mechanisms in a tilted plane by their planar twins. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/rotation.h"
#include "check.h"

#include <baum/baum.h>

/* The plane of the twins: x and y of the plane in ground axes. */
static const double TILT[4] = {0.7, -0.1, 0.5, 0.5};

static void tilt(const double xyz[3], double out[3])
{
  double p[4];
  double axes[9];
  memcpy(p, TILT, sizeof p);
  baum_i_quaternion_normalize(p);
  baum_i_rotation_of(p, axes);
  baum_i_turn(axes, xyz, out);
}

/* ---- a four-bar ---- */

static const double PINS[4][2] = {{0.0, 0.0}, {0.3, 0.4}, {1.1, 0.9}, {1.4, 0.0}};

static void link_place(int k, double place[3])
{
  const double *a = PINS[k];
  const double *b = PINS[k + 1];
  place[0] = 0.5 * (a[0] + b[0]);
  place[1] = 0.5 * (a[1] + b[1]);
  place[2] = atan2(b[1] - a[1], b[0] - a[0]);
}

static baum_mechanism *planar_four_bar(void)
{
  baum_mechanism *m = NULL;
  baum_body_id last = BAUM_GROUND;
  check(baum_mechanism_create(&m));
  for (int k = 0; k < 4; k++) {
    baum_body_id next = BAUM_GROUND;
    if (k < 3) {
      baum_planar_body_def def = baum_planar_body_def_default();
      double place[3];
      link_place(k, place);
      def.mass = 1.0 + k;
      def.inertia = 0.1 * (k + 1);
      memcpy(def.position, place, sizeof def.position);
      def.angle = place[2];
      def.angular_velocity = k == 0 ? 2.0 : (double)NAN;
      check(baum_mechanism_add_planar_body(m, &def, &next));
    }
    baum_planar_revolute_def pin = baum_planar_revolute_def_default();
    pin.body_a = last;
    pin.body_b = next;
    memcpy(pin.point, PINS[k], sizeof pin.point);
    check(baum_mechanism_add_planar_revolute(m, &pin, NULL));
    last = next;
  }
  check(baum_mechanism_freeze(m));
  return m;
}

/* Of spatial revolute joints, in the tilted plane. */
static baum_mechanism *spatial_four_bar(void)
{
  static const double normal[3] = {0.0, 0.0, 1.0};
  static const double down[3] = {0.0, -9.81, 0.0};
  double gravity[3];
  baum_mechanism *m = NULL;
  baum_body_id last = BAUM_GROUND;
  check(baum_mechanism_create(&m));
  tilt(down, gravity);
  check(baum_mechanism_set_gravity(m, gravity[0], gravity[1], gravity[2]));
  for (int k = 0; k < 4; k++) {
    baum_body_id next = BAUM_GROUND;
    if (k < 3) {
      baum_spatial_body_def def = baum_spatial_body_def_default();
      double place[3];
      double p[4];
      link_place(k, place);
      def.mass = 1.0 + k;
      const double inertia[6] = {0.06 * (k + 1), 0.07 * (k + 1), 0.1 * (k + 1)};
      memcpy(def.inertia, inertia, sizeof inertia);
      const double at[3] = {place[0], place[1], 0.0};
      const double spin[4] = {cos(0.5 * place[2]), 0.0, 0.0, sin(0.5 * place[2])};
      tilt(at, def.position);
      memcpy(p, TILT, sizeof p);
      baum_i_quaternion_normalize(p);
      baum_i_quaternion_product(p, spin, def.orientation);
      def.angular_velocity[2] = k == 0 ? 2.0 : (double)NAN;
      check(baum_mechanism_add_spatial_body(m, &def, &next));
    }
    baum_spatial_revolute_def pin = baum_spatial_revolute_def_default();
    pin.body_a = last;
    pin.body_b = next;
    const double at[3] = {PINS[k][0], PINS[k][1], 0.0};
    tilt(at, pin.point);
    tilt(normal, pin.axis);
    check(baum_mechanism_add_spatial_revolute(m, &pin, NULL));
    last = next;
  }
  check(baum_mechanism_freeze(m));
  return m;
}

static baum_simulation *start(const baum_mechanism *m, const baum_integrator *integrator,
                              baum_formulation formulation, double rtol)
{
  baum_simulation *run = NULL;
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.formulation = formulation;
  if (rtol > 0.0) {
    o.rtol = rtol;
  } else {
    o.step = 1e-3;
  }
  check(baum_simulation_create(m, &o, &run));
  return run;
}

static void a_four_bar_in_a_tilted_plane_moves_as_its_planar_twin(void **state)
{
  (void)state;
  baum_mechanism *planar = planar_four_bar();
  baum_mechanism *spatial = spatial_four_bar();
  baum_simulation *a = start(planar, baum_rk8(), BAUM_FORMULATION_PROJECTION, 0.0);
  baum_simulation *b = start(spatial, baum_rk8(), BAUM_FORMULATION_PROJECTION, 0.0);
  for (int i = 1; i <= 10; i++) {
    check(baum_simulation_advance_to(a, 0.2 * i));
    check(baum_simulation_advance_to(b, 0.2 * i));
    const double *q = baum_simulation_q(a);
    const double *p = baum_simulation_q(b);
    for (int k = 0; k < 3; k++) {
      const double at[3] = {q[3 * k], q[3 * k + 1], 0.0};
      double want[3];
      tilt(at, want);
      for (int j = 0; j < 3; j++) {
        if (fabs(p[7 * k + j] - want[j]) > 1e-10) {
          fail_msg("t = %g: body %d is off by %g", 0.2 * i, k, p[7 * k + j] - want[j]);
        }
      }
    }
  }
  baum_simulation_destroy(a);
  baum_simulation_destroy(b);
  baum_mechanism_destroy(planar);
  baum_mechanism_destroy(spatial);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_four_bar_in_a_tilted_plane_moves_as_its_planar_twin),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
