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

static void add_rod(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_distance_def def = baum_planar_distance_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  def.length = 1.6;
  assert_int_equal(baum_mechanism_add_planar_distance(scene->mechanism, &def, NULL), BAUM_OK);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_distance(mechanism, def, NULL);
}

static baum_planar_distance_def good(const planar_scene *scene)
{
  baum_planar_distance_def def = baum_planar_distance_def_default();
  def.name = "rod";
  PLANAR_BETWEEN(scene, &def, scene->link, scene->crank);
  return def;
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_rod, true, check_joint_derivatives);
}

static void reactions_balance(void **state)
{
  (void)state;
  for_each_planar_pair(add_rod, true, check_rows_balance);
}

static void the_row_is_the_change_of_length_to_first_order(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_distance_def def = good(&scene);
  PLANAR_BETWEEN(&scene, &def, scene.ball, scene.bead);
  def.length = 5.0;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double *ball = p.q + p.mechanism->bodies[scene.ball.index1]->q;
  double *bead = p.q + p.mechanism->bodies[scene.bead.index1]->q;
  double longer = 1.0 + 1e-4;
  ball[0] = 1.0;
  ball[1] = 1.0;
  bead[0] = 1.0 + 3.0 * longer;
  bead[1] = 1.0 - 4.0 * longer;
  test_point_update(&p);
  double phi;
  assert_int_equal(baum_i_mechanism_phi(&p.point, &phi), BAUM_OK);
  /* If L = 5 and the extension is x = 5e-4, then Phi = x + x^2 / (2 L). */
  ASSERT_NEAR(phi, 5e-4 + 25e-8 / 10.0, 0.0, 1e-14);
  test_point_close(&p);
}

static void the_length_follows_from_the_design_unless_given(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_distance_def def = good(&scene);
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double phi;
  assert_int_equal(baum_i_mechanism_phi(&p.point, &phi), BAUM_OK);
  ASSERT_NEAR(phi, 0.0, 0.0, 1e-15);
  test_point_close(&p);
}

static void coincident_points_have_finite_rows(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  add_rod(&scene, scene.ball, scene.bead);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double *ball = p.q + p.mechanism->bodies[scene.ball.index1]->q;
  double *bead = p.q + p.mechanism->bodies[scene.bead.index1]->q;
  bead[0] = ball[0];
  bead[1] = ball[1];
  test_point_update(&p);
  double phi;
  assert_int_equal(baum_i_mechanism_phi(&p.point, &phi), BAUM_OK);
  ASSERT_NEAR(phi, -0.8, 1e-15, 0.0);
  check_joint_derivatives(&p);
  test_point_close(&p);
}

static void a_design_without_length_cannot_be_frozen(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_distance_def def = good(&scene);
  def.body_a = BAUM_GROUND;
  def.body_b = scene.ball;
  def.point_a[0] = -0.6;
  def.point_a[1] = 0.8;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(scene.mechanism), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(),
                      "joint 1 \"rod\": length is not given and is 0 m in the design "
                      "configuration, must be > 0");
  assert_false(baum_mechanism_is_frozen(scene.mechanism));
  baum_mechanism_destroy(scene.mechanism);
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_distance_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_distance_def, length), 0.0,
     "joint 1 \"rod\": length is 0 m, must be finite and > 0"},
    {offsetof(baum_planar_distance_def, length), -2.0,
     "joint 1 \"rod\": length is -2 m, must be finite and > 0"},
    {offsetof(baum_planar_distance_def, length), TEST_INFINITY,
     "joint 1 \"rod\": length is inf m, must be finite and > 0"},
    {offsetof(baum_planar_distance_def, point_b[1]), TEST_NAN,
     "joint 1 \"rod\": point_b[1] is nan m, must be finite"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 4);
  def.point[0] = 1.0;
  def.point[1] = 1.0;
  check_refused(
    scene.mechanism, add, &def,
    "joint 1 \"rod\": point is given, but the length would be zero; give point_a and point_b "
    "instead");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_distance_def first = good(&scene);
  baum_planar_distance_def second = first;
  second.name = "other";
  second.point_b[1] = -6.0;
  second.length = 2.5;
  CHECK_ROUND_TRIP(joint, planar_distance, length, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(reactions_balance),
    cmocka_unit_test(the_row_is_the_change_of_length_to_first_order),
    cmocka_unit_test(the_length_follows_from_the_design_unless_given),
    cmocka_unit_test(coincident_points_have_finite_rows),
    cmocka_unit_test(a_design_without_length_cannot_be_frozen),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
