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

/* Freezes and releases the mechanism. */
static baum_i_islands find(baum_mechanism *m)
{
  baum_workspace *w = NULL;
  baum_i_islands out;
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  assert_int_equal(baum_i_find_islands(w, &out), BAUM_OK);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
  return out;
}

static void assert_island(const baum_i_islands *islands, int k, int bodies, int joints, int rows,
                          int degrees_of_freedom)
{
  const baum_i_island *island = &islands->island[k];
  assert_true(k < islands->count);
  assert_int_equal(island->bodies, bodies);
  assert_int_equal(island->velocities, 3 * bodies);
  assert_int_equal(island->joints, joints);
  assert_int_equal(island->rows, rows);
  assert_int_equal(island->degrees_of_freedom, degrees_of_freedom);
}

/* ---- islands ---- */

static void ground_holds_no_island_together(void **state)
{
  (void)state;
  baum_mechanism *m = begin();
  baum_body_id a = add_body(m, 1.0, 0.0);
  baum_body_id alone = add_body(m, 5.0, 5.0);
  baum_body_id b = add_body(m, 1.0, 3.0);
  baum_body_id tip = add_body(m, 3.0, 0.5);
  (void)alone;
  pin(m, BAUM_GROUND, b, 0.0, 3.0);
  baum_joint_id motor = pin(m, BAUM_GROUND, a, 0.0, 0.0);
  pin(m, tip, a, 2.0, 0.0);
  drive(m, motor);
  baum_i_islands got = find(m);
  const int of_body[] = {-1, 0, 1, 2, 0};
  const int of_joint[] = {2, 0, 0, 0};
  assert_int_equal(got.count, 3);
  assert_memory_equal(got.of_body, of_body, sizeof of_body);
  assert_memory_equal(got.of_joint, of_joint, sizeof of_joint);
  assert_island(&got, 0, 2, 3, 5, 1);
  assert_island(&got, 1, 1, 0, 0, 3);
  assert_island(&got, 2, 1, 1, 2, 1);
  assert_true(got.island[0].moved);
  assert_false(got.island[1].moved || got.island[2].moved);
  assert_int_equal(got.immobile_count, 0);
  assert_true(got.immobile[0]);
  baum_i_islands_clear(&got);
}

/* A row of bodies, joined to their neighbours in a mixed order. */
static void joints_in_any_order_make_one_island(void **state)
{
  (void)state;
  enum { BODIES = 41 };
  for (int step = 1; step < BODIES; step++) { /* 41 is prime: every step comes by all bodies */
    baum_mechanism *m = begin();
    baum_body_id bodies[BODIES];
    for (int k = 0; k < BODIES; k++) {
      bodies[k] = add_body(m, k, 0.0);
    }
    for (int k = 1; k < BODIES; k++) {
      int at = k * step % BODIES;
      pin(m, bodies[at], bodies[at - 1], at - 0.5, 0.5);
    }
    baum_i_islands got = find(m);
    assert_int_equal(got.count, 1);
    assert_island(&got, 0, BODIES, BODIES - 1, 2 * (BODIES - 1), BODIES + 2);
    baum_i_islands_clear(&got);
  }
}

/* ---- what is welded to ground ---- */

static void a_welded_frame_holds_no_island_together(void **state)
{
  (void)state;
  baum_mechanism *m = begin();
  baum_body_id left = add_body(m, 0.0, -1.0);
  baum_body_id frame = add_body(m, 0.0, 0.0);
  baum_body_id right = add_body(m, 2.0, -1.0);
  baum_body_id plate = add_body(m, 1.0, 0.0);
  baum_body_id hand = add_body(m, 2.0, -2.0); /* welded too, but to what swings */
  pin(m, frame, left, 0.0, 0.0);
  weld(m, plate, frame);
  weld(m, frame, BAUM_GROUND);
  pin(m, plate, right, 2.0, 0.0);
  weld(m, right, hand);
  baum_i_islands got = find(m);
  const int of_body[] = {-1, 0, -1, 1, -1, 1};
  const int of_joint[] = {0, -1, -1, 1, 1};
  const bool immobile[] = {true, false, true, false, true, false};
  assert_int_equal(got.count, 2);
  assert_memory_equal(got.of_body, of_body, sizeof of_body);
  assert_memory_equal(got.of_joint, of_joint, sizeof of_joint);
  assert_memory_equal(got.immobile, immobile, sizeof immobile);
  assert_int_equal(got.immobile_count, 2);
  assert_island(&got, 0, 1, 1, 2, 1);
  assert_island(&got, 1, 2, 2, 5, 1);
  baum_i_islands_clear(&got);
}

static void a_frame_welded_twice_is_no_different(void **state)
{
  (void)state;
  baum_mechanism *m = begin();
  baum_body_id frame = add_body(m, 0.0, 0.0);
  baum_body_id left = add_body(m, 0.0, -1.0);
  weld(m, frame, BAUM_GROUND);
  weld(m, frame, BAUM_GROUND);
  pin(m, frame, left, 0.0, 0.0);
  baum_i_islands got = find(m);
  assert_int_equal(got.count, 1);
  assert_int_equal(got.of_body[1], -1);
  assert_island(&got, 0, 1, 1, 2, 1);
  baum_i_islands_clear(&got);
}

/* The pins come first and are kept; one row of the weld is omitted for what they hold twice. */
static void where_a_weld_has_lost_a_row_freedoms_are_still_right(void **state)
{
  (void)state;
  baum_mechanism *m = begin();
  baum_body_id frame = add_body(m, 0.0, 0.0);
  baum_body_id bar = add_body(m, 1.0, 1.0);
  baum_body_id swing = add_body(m, 0.0, -1.0);
  pin(m, frame, bar, 0.0, 1.0);
  pin(m, BAUM_GROUND, bar, 2.0, 1.5);
  weld(m, frame, BAUM_GROUND);
  pin(m, frame, swing, 0.0, 0.0);
  baum_i_islands got = find(m);
  assert_int_equal(got.count, 1);
  assert_island(&got, 0, 3, 4, 9, 1);
  assert_true(got.immobile[1]);
  assert_false(got.immobile[2] || got.immobile[3]);
  baum_i_islands_clear(&got);
}

/* ---- what cannot move though nothing is welded ---- */

/* Two bars from the ground to a common pin at some height, and a pendulum beside them. With a motor
 * the second bar hangs free. */
static baum_mechanism *two_bars(double height, bool driven)
{
  baum_mechanism *m = begin();
  baum_body_id a = add_body(m, 0.5, 0.5 * height);
  baum_body_id b = add_body(m, 1.5, 0.5 * height);
  baum_body_id pendulum = add_body(m, 5.0, 5.0);
  baum_joint_id foot = pin(m, BAUM_GROUND, a, 0.0, 0.0);
  pin(m, a, b, 1.0, height);
  if (driven) {
    drive(m, foot);
  } else {
    pin(m, b, BAUM_GROUND, 2.0, 0.0);
  }
  pin(m, pendulum, BAUM_GROUND, 5.0, 6.0);
  return m;
}

static void an_island_without_freedom_is_immobile(void **state)
{
  (void)state;
  baum_i_islands got = find(two_bars(0.8, false));
  assert_int_equal(got.count, 2);
  assert_island(&got, 0, 2, 3, 6, 0);
  assert_true(got.island[0].immobile && got.immobile[1] && got.immobile[2]);
  assert_false(got.island[1].immobile || got.immobile[3]);
  assert_int_equal(got.immobile_count, 2);
  baum_i_islands_clear(&got);
}

static void what_a_motor_moves_is_not_immobile(void **state)
{
  (void)state;
  baum_mechanism *m = begin();
  drive(m, pin(m, BAUM_GROUND, add_body(m, 1.0, 0.0), 0.0, 0.0));
  baum_i_islands got = find(m);
  assert_island(&got, 0, 1, 2, 3, 0);
  assert_true(got.island[0].moved);
  assert_false(got.island[0].immobile || got.immobile[1]);
  baum_i_islands_clear(&got);
  got = find(two_bars(0.8, true));
  assert_island(&got, 0, 2, 3, 5, 1);
  assert_int_equal(got.immobile_count, 0);
  baum_i_islands_clear(&got);
}

/* Bars in one line can move by a little: no proof that they cannot by much. */
static void a_singular_pose_proves_nothing(void **state)
{
  (void)state;
  baum_i_islands got = find(two_bars(0.0, false));
  assert_int_equal(got.immobile_count, 0);
  baum_i_islands_clear(&got);
}

static void where_rows_contradict_each_other_freedoms_are_unknown(void **state)
{
  (void)state;
  baum_mechanism *m = begin();
  baum_body_id body = add_body(m, 1.0, 0.0);
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.body_a = BAUM_GROUND;
  rod.body_b = body;
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  for (int k = 0; k < 2; k++) {
    rod.length = 1.0 + 0.1 * k;
    assert_int_equal(baum_mechanism_add_planar_distance(m, &rod, NULL), BAUM_OK);
  }
  baum_i_islands got = find(m);
  assert_island(&got, 0, 1, 2, 2, -1);
  assert_int_equal(got.immobile_count, 0);
  baum_i_islands_clear(&got);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(ground_holds_no_island_together),
    cmocka_unit_test(joints_in_any_order_make_one_island),
    cmocka_unit_test(a_welded_frame_holds_no_island_together),
    cmocka_unit_test(a_frame_welded_twice_is_no_different),
    cmocka_unit_test(where_a_weld_has_lost_a_row_freedoms_are_still_right),
    cmocka_unit_test(an_island_without_freedom_is_immobile),
    cmocka_unit_test(what_a_motor_moves_is_not_immobile),
    cmocka_unit_test(a_singular_pose_proves_nothing),
    cmocka_unit_test(where_rows_contradict_each_other_freedoms_are_unknown),
  };
  return cmocka_run_group_tests_name("islands", tests, NULL, NULL);
}
