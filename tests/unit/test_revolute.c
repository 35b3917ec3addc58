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

static void add_pin(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  assert_int_equal(baum_mechanism_add_planar_revolute(scene->mechanism, &def, NULL), BAUM_OK);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_revolute(mechanism, def, NULL);
}

static baum_planar_revolute_def good(const planar_scene *scene)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  def.name = "B";
  PLANAR_BETWEEN(scene, &def, scene->link, scene->crank);
  return def;
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_pin, true, check_joint_derivatives);
}

static void coordinate_derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_pin, false, check_coordinate_derivatives);
}

static void rows_are_the_point_of_body_a_minus_the_point_of_body_b(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  add_pin(&scene, BAUM_GROUND, scene.crank);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double phi[2];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  /* In the design, the crank is at (-0.3, 1.2) with the angle -1.1 rad. The point of the joint is
   * (-0.45, 0.15) on the crank, and (0.5, 0.7) on the ground. */
  double c = cos(-1.1);
  double s = sin(-1.1);
  ASSERT_NEAR(phi[0], 0.5 - (-0.3 - 0.45 * c - 0.15 * s), 0.0, 1e-15);
  ASSERT_NEAR(phi[1], 0.7 - (1.2 - 0.45 * s + 0.15 * c), 0.0, 1e-15);
  test_point_close(&p);
}

static void both_bodies_meet_at_the_design_point(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  def.body_a = scene.link;
  def.body_b = scene.crank;
  def.point[0] = 0.25;
  def.point[1] = 0.75;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  def.body_b = scene.ball;
  def.point[0] = -0.6;
  def.point[1] = 0.8;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double phi[4];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  for (int i = 0; i < 4; i++) {
    ASSERT_NEAR(phi[i], 0.0, 0.0, 1e-15); /* rounding errors of two rotations */
  }
  double at[3];
  const baum_i_joint *joint = p.mechanism->joints[0];
  joint->type->place(joint, &p.point, at);
  ASSERT_NEAR(at[0], 0.25, 0.0, 1e-15);
  ASSERT_NEAR(at[1], 0.75, 0.0, 1e-15);
  test_point_close(&p);
}

static void coordinate_counts_revolutions(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  add_pin(&scene, scene.link, scene.crank);
  test_point p;
  test_point_open(&p, scene.mechanism);
  int crank = p.mechanism->bodies[scene.crank.index1]->q + 2;
  p.q[crank] += 200.0;
  test_point_update(&p);
  const baum_i_joint *joint = p.mechanism->joints[0];
  baum_i_coordinate c;
  joint->type->coordinate(joint, 0, &p.point, &c);
  ASSERT_NEAR(c.value, 200.0 - 1.1 - 0.4, 0.0, 1e-13); /* rounding error of 200 rad */
  test_point_close(&p);
}

static void wrong_points_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  const baum_planar_revolute_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_revolute_def, point_a[0]), TEST_INFINITY,
     "joint 1 \"B\": point_a[0] is inf m, must be finite"},
    {offsetof(baum_planar_revolute_def, point_a[1]), TEST_NAN,
     "joint 1 \"B\": point_a[1] is nan m, must be finite"},
    {offsetof(baum_planar_revolute_def, point_b[0]), TEST_NAN,
     "joint 1 \"B\": point_b[0] is nan m, must be finite"},
    {offsetof(baum_planar_revolute_def, point_b[1]), -TEST_INFINITY,
     "joint 1 \"B\": point_b[1] is -inf m, must be finite"},
    {offsetof(baum_planar_revolute_def, point[0]), 1.0,
     "joint 1 \"B\": point[1] is nan m, must be finite"},
    {offsetof(baum_planar_revolute_def, point[1]), 1.0,
     "joint 1 \"B\": point[0] is nan m, must be finite"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 6);
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_revolute_def first = good(&scene);
  baum_planar_revolute_def second = baum_planar_revolute_def_default();
  second.name = "other";
  second.body_a = scene.link;
  second.body_b = scene.crank;
  second.point[0] = 3.0;
  second.point[1] = -4.0;
  CHECK_ROUND_TRIP(joint, planar_revolute, point_b, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(coordinate_derivatives_agree_with_differences),
    cmocka_unit_test(rows_are_the_point_of_body_a_minus_the_point_of_body_b),
    cmocka_unit_test(both_bodies_meet_at_the_design_point),
    cmocka_unit_test(coordinate_counts_revolutions),
    cmocka_unit_test(wrong_points_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
