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

static void add_rack(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_rack_and_pinion_def def = baum_planar_rack_and_pinion_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  def.axis[0] = -0.5;
  def.axis[1] = 1.5;
  def.radius = -0.7;
  assert_int_equal(baum_mechanism_add_planar_rack_and_pinion(scene->mechanism, &def, NULL),
                   BAUM_OK);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_rack_and_pinion(mechanism, def, NULL);
}

static baum_planar_rack_and_pinion_def good(const planar_scene *scene)
{
  baum_planar_rack_and_pinion_def def = baum_planar_rack_and_pinion_def_default();
  def.name = "P";
  PLANAR_BETWEEN(scene, &def, scene->link, scene->crank);
  def.radius = 0.2;
  return def;
}

static double phi_of(test_point *p)
{
  double phi;
  test_point_update(p);
  assert_int_equal(baum_i_mechanism_phi(&p->point, &phi), BAUM_OK);
  return phi;
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_rack, false, check_joint_derivatives);
}

static void reactions_balance(void **state)
{
  (void)state;
  for_each_planar_pair(add_rack, false, check_rows_balance);
}

/* A wheel rolls on the floor, and the floor is the rack. If you look along the axis (1, 0) of the
 * rack, the floor is to the right of the centre of the wheel. The radius is therefore negative. */
static void a_wheel_on_the_floor_rolls_backward_if_its_angle_increases(void **state)
{
  (void)state;
  const double radius = 0.4;
  planar_scene scene = planar_scene_make();
  baum_planar_rack_and_pinion_def def = baum_planar_rack_and_pinion_def_default();
  def.body_a = BAUM_GROUND;
  def.body_b = scene.crank;
  def.point[0] = -0.3; /* the centre of the wheel */
  def.point[1] = 1.2;
  def.radius = -radius;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  int crank = p.mechanism->bodies[scene.crank.index1]->q;
  ASSERT_NEAR(phi_of(&p), 0.0, 0.0, 1e-15);
  /* The contact point is at (0, -radius) from the centre, and has no velocity. A rotation by 3 rad
   * therefore moves the centre by -3 times the radius. */
  p.q[crank] -= radius * 3.0;
  p.q[crank + 2] += 3.0;
  ASSERT_NEAR(phi_of(&p), 0.0, 0.0, 1e-15);
  /* Whole revolutions are not removed from the angle. */
  p.q[crank + 2] += 400.0;
  ASSERT_NEAR(phi_of(&p), radius * 400.0, 1e-15, 0.0);
  test_point_close(&p);
}

static void the_offset_follows_from_the_design_unless_given(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_rack_and_pinion_def def = good(&scene);
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  def.offset = 0.75;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  def.offset = -0.25;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double phi[3];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  ASSERT_NEAR(phi[0], 0.0, 0.0, 1e-15);
  ASSERT_NEAR(phi[2] - phi[1], 1.0, 1e-15, 0.0);
  test_point_close(&p);
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_rack_and_pinion_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_rack_and_pinion_def, axis[1]), TEST_INFINITY,
     "joint 1 \"P\": axis[1] is inf, must be finite"},
    {offsetof(baum_planar_rack_and_pinion_def, radius), TEST_NAN,
     "joint 1 \"P\": radius is nan m, must be finite and not 0"},
    {offsetof(baum_planar_rack_and_pinion_def, radius), 0.0,
     "joint 1 \"P\": radius is 0 m, must be finite and not 0"},
    {offsetof(baum_planar_rack_and_pinion_def, offset), TEST_INFINITY,
     "joint 1 \"P\": offset is inf m, must be finite, or NaN if not given"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 4);
  PLANAR_BETWEEN(&scene, &def, scene.crank, scene.bead);
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"P\": body_b is body 4 \"bead\", which has no angle");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_rack_and_pinion_def first = good(&scene);
  baum_planar_rack_and_pinion_def second = first;
  second.name = "other";
  second.axis[1] = -0.8;
  second.radius = -3.0;
  second.offset = 0.5;
  CHECK_ROUND_TRIP(joint, planar_rack_and_pinion, offset, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(reactions_balance),
    cmocka_unit_test(a_wheel_on_the_floor_rolls_backward_if_its_angle_increases),
    cmocka_unit_test(the_offset_follows_from_the_design_unless_given),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
