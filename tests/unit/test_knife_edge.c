/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "balance.h"
#include "derivatives.h"
#include "planar_scene.h"

static void add_edge(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_knife_edge_def def = baum_planar_knife_edge_def_default();
  def.body_a = a;
  def.body_b = b;
  planar_scene_arm(scene, a, def.point_a);
  def.axis[0] = -0.5;
  def.axis[1] = 1.5;
  assert_int_equal(baum_mechanism_add_planar_knife_edge(scene->mechanism, &def, NULL), BAUM_OK);
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_edge, false, check_joint_derivatives);
}

static void reactions_balance(void **state)
{
  (void)state;
  for_each_planar_pair(add_edge, false, check_rows_balance);
}

/* The row of J must give the velocity of the blade's point towards the left of the blade. */
static void the_row_is_the_velocity_across_the_blade(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_knife_edge_def def = baum_planar_knife_edge_def_default();
  def.body_a = scene.crank;
  def.point[0] = 0.7;
  def.point[1] = -0.4;
  def.axis[0] = 3.0;
  def.axis[1] = 4.0;
  assert_int_equal(baum_mechanism_add_planar_knife_edge(scene.mechanism, &def, NULL), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double jacobian[TEST_SIZE_MAX];
  const baum_i_joint *joint = p.mechanism->joints[0];
  const double *r = p.q + joint->span.columns[0];
  assert_int_equal(baum_i_mechanism_jacobian(&p.point, jacobian), BAUM_OK);
  ASSERT_NEAR(jacobian[0], -0.8, 0.0, 1e-15);
  ASSERT_NEAR(jacobian[1], 0.6, 0.0, 1e-15);
  ASSERT_NEAR(jacobian[2], 0.6 * (0.7 - r[0]) + 0.8 * (-0.4 - r[1]), 0.0, 1e-14);
  test_point_close(&p);
}

static void bad_definitions_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_knife_edge_def def = baum_planar_knife_edge_def_default();
  def.name = "K";
  def.body_a = scene.crank;
  assert_int_equal(baum_mechanism_add_planar_knife_edge(scene.mechanism, &def, NULL),
                   BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(),
                      "joint 1 \"K\": no point is given; give either point or point_a");
  def.point[0] = def.point[1] = def.point_a[0] = def.point_a[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_knife_edge(scene.mechanism, &def, NULL),
                   BAUM_ERR_ARGUMENT);
  assert_string_equal(
    baum_message(),
    "joint 1 \"K\": point and point_a are both given; give either point or point_a");
  def.point[0] = def.point[1] = (double)NAN;
  def.body_b = scene.crank;
  assert_int_equal(baum_mechanism_add_planar_knife_edge(scene.mechanism, &def, NULL),
                   BAUM_ERR_ARGUMENT);
  def.body_b = scene.ball;
  assert_int_equal(baum_mechanism_add_planar_knife_edge(scene.mechanism, &def, NULL),
                   BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "which has no angle"));
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(reactions_balance),
    cmocka_unit_test(the_row_is_the_velocity_across_the_blade),
    cmocka_unit_test(bad_definitions_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
