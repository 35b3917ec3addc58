/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "definitions.h"
#include "derivatives.h"
#include "planar_scene.h"

static void add_weld(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_fixed_def def = baum_planar_fixed_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  def.angle = -0.3;
  assert_int_equal(baum_mechanism_add_planar_fixed(scene->mechanism, &def, NULL), BAUM_OK);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_fixed(mechanism, def, NULL);
}

static baum_planar_fixed_def good(const planar_scene *scene)
{
  baum_planar_fixed_def def = baum_planar_fixed_def_default();
  def.name = "weld";
  PLANAR_BETWEEN(scene, &def, scene->link, scene->crank);
  return def;
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_weld, false, check_joint_derivatives);
}

static void a_missing_angle_follows_from_the_design(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_fixed_def def = baum_planar_fixed_def_default();
  def.body_a = scene.link;
  def.body_b = scene.crank;
  def.point[0] = 0.3;
  def.point[1] = -1.0;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  def.angle = 0.5;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double phi[6];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  for (int i = 0; i < 5; i++) {
    ASSERT_NEAR(phi[i], 0.0, 0.0, 1e-15); /* rounding errors of two rotations */
  }
  ASSERT_NEAR(phi[5], -1.1 - 0.4 - 0.5, 1e-15, 0.0);
  double at[3];
  const baum_i_joint *joint = p.mechanism->joints[0];
  joint->type->place(joint, &p.point, at);
  ASSERT_NEAR(at[0], 0.3, 0.0, 1e-15);
  ASSERT_NEAR(at[1], -1.0, 0.0, 1e-15);
  test_point_close(&p);
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_fixed_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_fixed_def, angle), TEST_INFINITY,
     "joint 1 \"weld\": angle is inf rad, must be finite, or NaN if not given"},
    {offsetof(baum_planar_fixed_def, point_a[1]), TEST_INFINITY,
     "joint 1 \"weld\": point_a[1] is inf m, must be finite"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 2);
  PLANAR_BETWEEN(&scene, &def, scene.crank, scene.ball);
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"weld\": body_b is body 2 \"ball\", which has no angle");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_fixed_def first = good(&scene);
  baum_planar_fixed_def second = first;
  second.name = "other";
  second.point_b[1] = -6.0;
  second.angle = 2.5;
  CHECK_ROUND_TRIP(joint, planar_fixed, angle, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(a_missing_angle_follows_from_the_design),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
