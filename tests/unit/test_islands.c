/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <baum/baum.h>
#include <cmocka.h>

#include "construct.h"
#include "dynamics/islands.h"

/* ---- mechanisms ---- */

static baum_body_id add_body(baum_mechanism *m, double x, double y)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.position[0] = x;
  def.position[1] = y;
  assert_int_equal(baum_mechanism_add_planar_body(m, &def, &id), BAUM_OK);
  return id;
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

static void ground_does_not_connect_islands(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_body_id a = add_body(m, 1.0, 0.0);
  (void)add_body(m, 5.0, 5.0); /* a body without joints */
  baum_body_id b = add_body(m, 1.0, 3.0);
  baum_body_id tip = add_body(m, 3.0, 0.5);
  add_planar_pin(m, NULL, BAUM_GROUND, b, 0.0, 3.0);
  baum_joint_id motor = add_planar_pin(m, NULL, BAUM_GROUND, a, 0.0, 0.0);
  add_planar_pin(m, NULL, tip, a, 2.0, 0.0);
  drive(m, motor);
  assert_island(count(m, 3), 2, 3, 5);
}

/* Makes a chain of bodies. Its joints are added in a mixed order. */
static void joints_in_any_order_form_one_island(void **state)
{
  (void)state;
  enum { BODIES = 41 };
  for (int step = 1; step < BODIES; step++) { /* 41 is prime, so any step joins all bodies */
    baum_mechanism *m = create_mechanism();
    baum_body_id bodies[BODIES];
    for (int k = 0; k < BODIES; k++) {
      bodies[k] = add_body(m, k, 0.0);
    }
    for (int k = 1; k < BODIES; k++) {
      int at = k * step % BODIES;
      add_planar_pin(m, NULL, bodies[at], bodies[at - 1], at - 0.5, 0.5);
    }
    assert_island(count(m, 1), BODIES, BODIES - 1, 2 * (BODIES - 1));
  }
}

static void a_welded_frame_does_not_connect_islands(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_body_id left = add_body(m, 0.0, -1.0);
  baum_body_id frame = add_body(m, 0.0, 0.0);
  baum_body_id right = add_body(m, 2.0, -1.0);
  baum_body_id plate = add_body(m, 1.0, 0.0);
  baum_body_id hand = add_body(m, 2.0, -2.0); /* this body is welded to a body that moves */
  add_planar_pin(m, NULL, frame, left, 0.0, 0.0);
  add_planar_weld(m, plate, frame, 0.3, -0.2);
  add_planar_weld(m, frame, BAUM_GROUND, 0.3, -0.2);
  add_planar_weld(m, frame, BAUM_GROUND, 0.3, -0.2); /* a second weld changes nothing */
  add_planar_pin(m, NULL, plate, right, 2.0, 0.0);
  add_planar_weld(m, right, hand, 0.3, -0.2);
  assert_island(count(m, 2), 2, 2, 5);
}

static void fixed_bodies_form_no_island(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  add_planar_weld(m, add_body(m, 1.0, 0.0), BAUM_GROUND, 0.3, -0.2);
  assert_island(count(m, 0), 0, 0, 0);
}

/* ---- errors of one island ---- */

/* Makes a slider-crank at a dead centre. A driver prescribes the acceleration of its slider, which
 * no acceleration of the crank can produce. In another island, a force of 1e9 N accelerates a
 * lever. */
static baum_workspace *make_driven(double acceleration, baum_mechanism *m)
{
  baum_joint_id guide;
  baum_workspace *w = NULL;
  baum_planar_translational_def line = baum_planar_translational_def_default();
  baum_driver_def driver = baum_driver_def_default();
  baum_planar_load_def load = baum_planar_load_def_default();
  baum_body_id crank = add_body(m, 0.5, 0.0);
  baum_body_id rod = add_body(m, 2.0, 0.0);
  baum_body_id slider = add_body(m, 3.0, 0.0);
  baum_body_id lever = add_body(m, 10.0, 5.0);
  add_planar_pin(m, NULL, BAUM_GROUND, crank, 0.0, 0.0);
  add_planar_pin(m, NULL, crank, rod, 1.0, 0.0);
  add_planar_pin(m, NULL, rod, slider, 3.0, 0.0);
  line.body_a = BAUM_GROUND;
  line.body_b = slider;
  line.axis[0] = 1.0;
  line.axis[1] = 0.0;
  line.point[0] = 3.0;
  line.point[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_translational(m, &line, &guide), BAUM_OK);
  driver.joint = guide;
  driver.acceleration = acceleration;
  assert_int_equal(baum_mechanism_add_driver(m, &driver, NULL), BAUM_OK);
  add_planar_pin(m, NULL, BAUM_GROUND, lever, 9.0, 5.0);
  load.body = lever;
  load.force[1] = 1e9;
  assert_int_equal(baum_mechanism_add_planar_load(m, &load, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  return w;
}

static void a_fast_lever_does_not_hide_a_contradiction_in_another_island(void **state)
{
  (void)state;
  /* With the first acceleration, the row of the driver is omitted; with the second, all rows are
   * kept. */
  const double accelerations[] = {1.0, 1e-6};
  for (int k = 0; k < 2; k++) {
    double q[12], v[12] = {0.0}, a[12] = {0.0};
    baum_mechanism *m = create_mechanism();
    baum_workspace *w = make_driven(accelerations[k], m);
    assert_int_equal(baum_workspace_design(w, q, v), BAUM_OK);
    memset(v, 0, sizeof v);
    baum_status status = baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, a, NULL);
    assert_true(status == BAUM_ERR_INCONSISTENT || status == BAUM_ERR_SINGULAR);
    baum_workspace_destroy(w);
    baum_mechanism_destroy(m);
  }
}

/* Two drivers of one pin contradict each other by 1e-3 rad/s. In another island, a body rotates at
 * 1e6 rad/s. */
static void a_fast_body_does_not_hide_a_contradiction_of_two_drivers(void **state)
{
  (void)state;
  double q[6], v[6] = {[5] = 1e6};
  baum_workspace *w = NULL;
  baum_mechanism *m = create_mechanism();
  baum_driver_def driver = baum_driver_def_default();
  driver.joint = add_planar_pin(m, NULL, BAUM_GROUND, add_body(m, 1.0, 0.0), 0.0, 0.0);
  for (int k = 0; k < 2; k++) {
    driver.rate = 1.0 + 1e-3 * k;
    assert_int_equal(baum_mechanism_add_driver(m, &driver, NULL), BAUM_OK);
  }
  (void)add_body(m, 5.0, 0.0);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  assert_int_equal(baum_workspace_design(w, q, (double[6]){0.0}), BAUM_OK);
  assert_int_equal(baum_workspace_project(w, 0.0, q, v), BAUM_ERR_INCONSISTENT);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(ground_does_not_connect_islands),
    cmocka_unit_test(joints_in_any_order_form_one_island),
    cmocka_unit_test(a_welded_frame_does_not_connect_islands),
    cmocka_unit_test(fixed_bodies_form_no_island),
    cmocka_unit_test(a_fast_lever_does_not_hide_a_contradiction_in_another_island),
    cmocka_unit_test(a_fast_body_does_not_hide_a_contradiction_of_two_drivers),
  };
  return cmocka_run_group_tests_name("islands", tests, NULL, NULL);
}
