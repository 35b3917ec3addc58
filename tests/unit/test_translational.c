/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>

#include "assert_near.h"
#include "definitions.h"
#include "derivatives.h"
#include "planar_scene.h"

static void add_slider(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  def.axis[0] = -0.5;
  def.axis[1] = 1.5;
  def.angle = 0.8;
  assert_int_equal(baum_mechanism_add_planar_translational(scene->mechanism, &def, NULL), BAUM_OK);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_translational(mechanism, def, NULL);
}

static baum_planar_translational_def good(const planar_scene *scene)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.name = "D";
  PLANAR_BETWEEN(scene, &def, scene->link, scene->crank);
  return def;
}

/* Adds one slider and opens a test point at the design configuration. */
static void open_with(test_point *p, planar_scene *scene, const baum_planar_translational_def *def)
{
  assert_int_equal(add(scene->mechanism, def), BAUM_OK);
  test_point_open(p, scene->mechanism);
}

static baum_i_coordinate coordinate_of(const test_point *p)
{
  const baum_i_joint *joint = p->mechanism->joints[0];
  baum_i_coordinate c;
  joint->type->coordinate(joint, 0, &p->point, &c);
  return c;
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_slider, false, check_joint_derivatives);
}

static void coordinate_derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_slider, false, check_coordinate_derivatives);
}

static void with_a_design_point_the_axis_is_in_ground_axes(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.body_a = scene.link;
  def.body_b = scene.crank;
  def.point[0] = 0.2;
  def.point[1] = 0.3;
  def.axis[0] = 3.0;
  def.axis[1] = 4.0;
  test_point p;
  open_with(&p, &scene, &def);
  int crank = p.mechanism->bodies[scene.crank.index1]->q;
  p.q[crank] += 3.0;
  p.q[crank + 1] += 4.0;
  test_point_update(&p);
  double phi[2];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  ASSERT_NEAR(phi[0], 0.0, 0.0, 1e-14); /* rounding error of 5 m */
  ASSERT_NEAR(phi[1], 0.0, 0.0, 1e-15);
  ASSERT_NEAR(coordinate_of(&p).value, 5.0, 1e-15, 0.0);
  test_point_close(&p);
}

static void with_body_points_the_axis_is_in_the_axes_of_body_a(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_translational_def def = good(&scene);
  def.axis[0] = 0.0;
  def.axis[1] = 2.0;
  def.angle = 0.0;
  test_point p;
  open_with(&p, &scene, &def);
  /* The angle of the link is 90 degrees, so its y axis is the -x axis of the ground. */
  const baum_mechanism *m = p.mechanism;
  double *link = p.q + m->bodies[scene.link.index1]->q;
  double *crank = p.q + m->bodies[scene.crank.index1]->q;
  double quarter = acos(0.0);
  link[0] = 0.0;
  link[1] = 0.0;
  link[2] = quarter;
  crank[0] = -7.0;
  crank[1] = 5.0;
  crank[2] = quarter;
  test_point_update(&p);
  double phi[2];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  /* In body axes the points are (0.3, -0.2) and (-0.45, 0.15). In the axes of the link, the centre
   * of the crank is at (5, 7). */
  ASSERT_NEAR(coordinate_of(&p).value, 7.0 + 0.15 + 0.2, 1e-15, 0.0);
  /* The distance across the axis is measured along k x axis = (-1, 0), where k is the unit normal
   * of the plane. */
  ASSERT_NEAR(phi[0], -(5.0 - 0.45 - 0.3), 1e-14, 0.0);
  ASSERT_NEAR(phi[1], 0.0, 0.0, 1e-15);
  test_point_close(&p);
}

static void the_relative_angle_follows_from_the_design_unless_given(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_translational_def def = good(&scene);
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  def.angle = 0.25;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double phi[4];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  ASSERT_NEAR(phi[1], 0.0, 0.0, 1e-15);
  ASSERT_NEAR(phi[3], -1.1 - 0.4 - 0.25, 1e-15, 0.0);
  test_point_close(&p);
}

static void an_axis_of_any_length_is_a_direction(void **state)
{
  (void)state;
  const double axes[][2] = {{DBL_MAX, -DBL_MAX},
                            {1e200, 1e-200},
                            {1e-200, 1e200},
                            {1e-200, 1e-200},
                            {DBL_TRUE_MIN, -DBL_TRUE_MIN}};
  for (int i = 0; i < 5; i++) {
    planar_scene scene = planar_scene_make();
    baum_planar_translational_def def = good(&scene);
    def.axis[0] = axes[i][0];
    def.axis[1] = axes[i][1];
    test_point p;
    open_with(&p, &scene, &def);
    baum_i_coordinate c = coordinate_of(&p);
    ASSERT_NEAR(hypot(c.gradient[3], c.gradient[4]), 1.0, 1e-15, 0.0);
    test_point_close(&p);
  }
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_translational_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_translational_def, point_a[0]), TEST_INFINITY,
     "joint 1 \"D\": point_a[0] is inf m, must be finite"},
    {offsetof(baum_planar_translational_def, axis[0]), TEST_NAN,
     "joint 1 \"D\": axis[0] is nan, must be finite"},
    {offsetof(baum_planar_translational_def, axis[1]), TEST_INFINITY,
     "joint 1 \"D\": axis[1] is inf, must be finite"},
    {offsetof(baum_planar_translational_def, axis[0]), 0.0,
     "joint 1 \"D\": axis is (0, 0), which has no direction"},
    {offsetof(baum_planar_translational_def, angle), -TEST_INFINITY,
     "joint 1 \"D\": angle is -inf rad, must be finite, or NaN if not given"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 5);
  PLANAR_BETWEEN(&scene, &def, scene.ball, scene.crank);
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"D\": body_a is body 2 \"ball\", which has no angle");
  PLANAR_BETWEEN(&scene, &def, scene.crank, scene.bead);
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"D\": body_b is body 4 \"bead\", which has no angle");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_translational_def first = good(&scene);
  baum_planar_translational_def second = first;
  second.name = "other";
  second.point_a[0] = 11.0;
  second.axis[0] = 0.6;
  second.axis[1] = -0.8;
  second.angle = 2.5;
  CHECK_ROUND_TRIP(joint, planar_translational, angle, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(coordinate_derivatives_agree_with_differences),
    cmocka_unit_test(with_a_design_point_the_axis_is_in_ground_axes),
    cmocka_unit_test(with_body_points_the_axis_is_in_the_axes_of_body_a),
    cmocka_unit_test(the_relative_angle_follows_from_the_design_unless_given),
    cmocka_unit_test(an_axis_of_any_length_is_a_direction),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
