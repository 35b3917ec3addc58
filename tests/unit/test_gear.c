/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "balance.h"
#include "definitions.h"
#include "derivatives.h"
#include "planar_scene.h"

static baum_body_id add_arm(planar_scene *scene, double angle)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = "arm";
  def.angle = angle;
  baum_body_id id;
  assert_int_equal(baum_mechanism_add_planar_body(scene->mechanism, &def, &id), BAUM_OK);
  return id;
}

/* Adds gears whose carrier is an arm. If neither wheel is ground, also adds gears whose carrier is
 * ground. */
static void add_gears(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_gear_def def = baum_planar_gear_def_default();
  def.body_a = a;
  def.body_b = b;
  def.radius_a = 0.3;
  def.radius_b = -1.7;
  def.offset = 0.4;
  def.carrier = add_arm(scene, 0.2);
  assert_int_equal(baum_mechanism_add_planar_gear(scene->mechanism, &def, NULL), BAUM_OK);
  if (a.index1 > 0 && b.index1 > 0) {
    def.carrier = BAUM_GROUND;
    assert_int_equal(baum_mechanism_add_planar_gear(scene->mechanism, &def, NULL), BAUM_OK);
  }
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_gear(mechanism, def, NULL);
}

static baum_planar_gear_def good(const planar_scene *scene)
{
  baum_planar_gear_def def = baum_planar_gear_def_default();
  def.name = "G";
  def.body_a = scene->link;
  def.body_b = scene->crank;
  def.radius_a = 0.2;
  def.radius_b = 0.3;
  return def;
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_gears, false, check_joint_derivatives);
}

static void reactions_balance(void **state)
{
  (void)state;
  for_each_planar_pair(add_gears, false, check_rows_balance);
}

/* A sun wheel with 20 teeth, a planet wheel with 35 teeth, and a fixed ring with 90 teeth. By
 * Willis' equation the sun rotates 1 + 90 / 20 times as fast as the arm. Relative to the arm, the
 * planet rotates -20 / 35 times as fast as the sun. */
static void a_planetary_gear_follows_willis(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_body_id arm = add_arm(&scene, 0.0);
  baum_planar_gear_def def = baum_planar_gear_def_default();
  def.carrier = arm;
  def.body_a = scene.link;  /* the sun wheel */
  def.body_b = scene.crank; /* the planet wheel */
  def.radius_a = 20.0;
  def.radius_b = 35.0;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  def.body_a = scene.crank;
  def.body_b = BAUM_GROUND; /* the ring */
  def.radius_a = 35.0;
  def.radius_b = -90.0;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double phi[2];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  ASSERT_NEAR(phi[0], 0.0, 0.0, 1e-13); /* rounding error of a sum of terms of about 50 */
  ASSERT_NEAR(phi[1], 0.0, 0.0, 1e-13);
  double sun = 11.0;
  double arm_angle = sun / (1.0 + 90.0 / 20.0);
  p.q[p.mechanism->bodies[scene.link.index1]->q + 2] += sun;
  p.q[p.mechanism->bodies[arm.index1]->q + 2] += arm_angle;
  p.q[p.mechanism->bodies[scene.crank.index1]->q + 2] +=
    arm_angle - 20.0 / 35.0 * (sun - arm_angle);
  test_point_update(&p);
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  ASSERT_NEAR(phi[0], 0.0, 0.0, 1e-12); /* rounding error of a sum of terms of about 500 */
  ASSERT_NEAR(phi[1], 0.0, 0.0, 1e-12);
  test_point_close(&p);
}

static void the_offset_follows_from_the_design_unless_given(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_gear_def def = good(&scene);
  def.carrier = add_arm(&scene, 0.7);
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  def.offset = 0.05;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double phi[2];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  ASSERT_NEAR(phi[0], 0.0, 0.0, 1e-15);
  ASSERT_NEAR(phi[1], 0.2 * (0.4 - 0.7) + 0.3 * (-1.1 - 0.7) - 0.05, 1e-15, 0.0);
  test_point_close(&p);
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_gear_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_gear_def, radius_a), TEST_NAN,
     "joint 1 \"G\": radius_a is nan m, must be finite and not 0"},
    {offsetof(baum_planar_gear_def, radius_b), 0.0,
     "joint 1 \"G\": radius_b is 0 m, must be finite and not 0"},
    {offsetof(baum_planar_gear_def, offset), TEST_INFINITY,
     "joint 1 \"G\": offset is inf m, must be finite, or NaN if not given"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 3);
  baum_mechanism_destroy(scene.mechanism);
}

static void wrong_bodies_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_gear_def def = good(&scene);
  def.carrier = scene.link;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"G\": carrier and body_a are both body 1 \"link\"");
  def.carrier = scene.crank;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"G\": carrier and body_b are both body 3 \"crank\"");
  def.carrier = scene.ball;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"G\": carrier is body 2 \"ball\", which has no angle");
  def.carrier = (baum_body_id){0, 0};
  check_refused(scene.mechanism, add, &def, "joint 1 \"G\": carrier is none, must be given");
  def = good(&scene);
  def.body_b = BAUM_GROUND;
  check_refused(scene.mechanism, add, &def, "joint 1 \"G\": carrier and body_b are both ground");
  def.body_b = scene.bead;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"G\": body_b is body 4 \"bead\", which has no angle");
  def.body_b = scene.link;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"G\": body_a and body_b are both body 1 \"link\"");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_gear_def first = good(&scene);
  baum_planar_gear_def second = first;
  second.name = "other";
  second.radius_a = -3.0;
  second.radius_b = 2.0;
  second.offset = 0.5;
  CHECK_ROUND_TRIP(joint, planar_gear, offset, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(reactions_balance),
    cmocka_unit_test(a_planetary_gear_follows_willis),
    cmocka_unit_test(the_offset_follows_from_the_design_unless_given),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(wrong_bodies_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
