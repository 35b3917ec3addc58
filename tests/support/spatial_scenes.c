/* SPDX-License-Identifier: BSD-3-Clause */
#include "spatial_scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/rotation.h"
#include "check.h"

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

void spatial_build_planar_four_bar(baum_mechanism *m)
{
  baum_body_id last = BAUM_GROUND;
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
      def.angular_velocity = k == 0 ? 4.0 : (double)NAN;
      check(baum_mechanism_add_planar_body(m, &def, &next));
    }
    baum_planar_revolute_def pin = baum_planar_revolute_def_default();
    pin.body_a = last;
    pin.body_b = next;
    memcpy(pin.point, PINS[k], sizeof pin.point);
    check(baum_mechanism_add_planar_revolute(m, &pin, NULL));
    last = next;
  }
}

/* Of spatial revolute joints, in the tilted plane. */
void spatial_build_four_bar(baum_mechanism *m)
{
  static const double normal[3] = {0.0, 0.0, 1.0};
  static const double down[3] = {0.0, -9.81, 0.0};
  double gravity[3];
  baum_body_id last = BAUM_GROUND;
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
      def.angular_velocity[2] = k == 0 ? 4.0 : (double)NAN;
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
}

void spatial_translate_four_bar(const double *twin_q, double *q)
{
  double p[4];
  memcpy(p, TILT, sizeof p);
  baum_i_quaternion_normalize(p);
  for (int k = 0; k < 3; k++) {
    const double at[3] = {twin_q[3 * k], twin_q[3 * k + 1], 0.0};
    double half = 0.5 * twin_q[3 * k + 2];
    const double spin[4] = {cos(half), 0.0, 0.0, sin(half)};
    tilt(at, q + 7 * k);
    baum_i_quaternion_product(p, spin, q + 7 * k + 3);
  }
}
