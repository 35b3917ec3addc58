/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <baum/planar.h>
#include <cmocka.h>

#include "dynamics/islands.h"

/* ---- mechanisms ---- */

static baum_mechanism *begin(void)
{
  baum_mechanism *m = NULL;
  assert_int_equal(baum_mechanism_create(&m), BAUM_OK);
  return m;
}

static baum_body_id add_body(baum_mechanism *m, double x, double y)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.position[0] = x;
  def.position[1] = y;
  assert_int_equal(baum_mechanism_add_planar_body(m, &def, &id), BAUM_OK);
  return id;
}

static baum_joint_id pin(baum_mechanism *m, baum_body_id a, baum_body_id b, double x, double y)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  baum_joint_id id;
  def.body_a = a;
  def.body_b = b;
  def.point[0] = x;
  def.point[1] = y;
  assert_int_equal(baum_mechanism_add_planar_revolute(m, &def, &id), BAUM_OK);
  return id;
}

static void weld(baum_mechanism *m, baum_body_id a, baum_body_id b)
{
  baum_planar_fixed_def def = baum_planar_fixed_def_default();
  def.body_a = a;
  def.body_b = b;
  def.point[0] = 0.3;
  def.point[1] = -0.2;
  assert_int_equal(baum_mechanism_add_planar_fixed(m, &def, NULL), BAUM_OK);
}

static void drive(baum_mechanism *m, baum_joint_id joint)
{
  baum_driver_def def = baum_driver_def_default();
  def.joint = joint;
  def.rate = 1.0;
  assert_int_equal(baum_mechanism_add_driver(m, &def, NULL), BAUM_OK);
}

/* Freezes the mechanism, counts its islands and destroys it. */
static baum_i_island count(baum_mechanism *m, int want)
{
  int got = -1;
  baum_i_island largest;
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_i_count_islands(m, &got, &largest), BAUM_OK);
  assert_int_equal(got, want);
  baum_mechanism_destroy(m);
  return largest;
}

static void assert_island(baum_i_island island, int bodies, int joints, int rows)
{
  assert_int_equal(island.bodies, bodies);
  assert_int_equal(island.joints, joints);
  assert_int_equal(island.rows, rows);
}

static void ground_holds_no_island_together(void **state)
{
  (void)state;
  baum_mechanism *m = begin();
  baum_body_id a = add_body(m, 1.0, 0.0);
  (void)add_body(m, 5.0, 5.0); /* a body without joints */
  baum_body_id b = add_body(m, 1.0, 3.0);
  baum_body_id tip = add_body(m, 3.0, 0.5);
  pin(m, BAUM_GROUND, b, 0.0, 3.0);
  baum_joint_id motor = pin(m, BAUM_GROUND, a, 0.0, 0.0);
  pin(m, tip, a, 2.0, 0.0);
  drive(m, motor);
  assert_island(count(m, 3), 2, 3, 5);
}

/* Makes a chain of bodies. Its joints are added in a mixed order. */
static void joints_in_any_order_make_one_island(void **state)
{
  (void)state;
  enum { BODIES = 41 };
  for (int step = 1; step < BODIES; step++) { /* 41 is prime, so this joins all bodies */
    baum_mechanism *m = begin();
    baum_body_id bodies[BODIES];
    for (int k = 0; k < BODIES; k++) {
      bodies[k] = add_body(m, k, 0.0);
    }
    for (int k = 1; k < BODIES; k++) {
      int at = k * step % BODIES;
      pin(m, bodies[at], bodies[at - 1], at - 0.5, 0.5);
    }
    assert_island(count(m, 1), BODIES, BODIES - 1, 2 * (BODIES - 1));
  }
}

static void a_welded_frame_holds_no_island_together(void **state)
{
  (void)state;
  baum_mechanism *m = begin();
  baum_body_id left = add_body(m, 0.0, -1.0);
  baum_body_id frame = add_body(m, 0.0, 0.0);
  baum_body_id right = add_body(m, 2.0, -1.0);
  baum_body_id plate = add_body(m, 1.0, 0.0);
  baum_body_id hand = add_body(m, 2.0, -2.0); /* it is welded, but to a body that moves */
  pin(m, frame, left, 0.0, 0.0);
  weld(m, plate, frame);
  weld(m, frame, BAUM_GROUND);
  weld(m, frame, BAUM_GROUND); /* a second weld changes nothing */
  pin(m, plate, right, 2.0, 0.0);
  weld(m, right, hand);
  assert_island(count(m, 2), 2, 2, 5);
}

static void fixed_bodies_make_no_island(void **state)
{
  (void)state;
  baum_mechanism *m = begin();
  weld(m, add_body(m, 1.0, 0.0), BAUM_GROUND);
  assert_island(count(m, 0), 0, 0, 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(ground_holds_no_island_together),
    cmocka_unit_test(joints_in_any_order_make_one_island),
    cmocka_unit_test(a_welded_frame_holds_no_island_together),
    cmocka_unit_test(fixed_bodies_make_no_island),
  };
  return cmocka_run_group_tests_name("islands", tests, NULL, NULL);
}
