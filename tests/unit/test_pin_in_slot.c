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

static bool is_particle(const planar_scene *scene, baum_body_id body)
{
  return body.index1 == scene->ball.index1 || body.index1 == scene->bead.index1;
}

/* Adds a pin in a slot. The slot belongs to body a. If a is a particle, the slot belongs to b. If
 * both are particles, it belongs to the link. */
static void add_slot(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_pin_in_slot_def def = baum_planar_pin_in_slot_def_default();
  if (is_particle(scene, a)) {
    baum_body_id other = is_particle(scene, b) ? scene->link : b;
    PLANAR_BETWEEN(scene, &def, other, a);
  } else {
    PLANAR_BETWEEN(scene, &def, a, b);
  }
  def.axis[0] = -0.5;
  def.axis[1] = 1.5;
  assert_int_equal(baum_mechanism_add_planar_pin_in_slot(scene->mechanism, &def, NULL), BAUM_OK);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_pin_in_slot(mechanism, def, NULL);
}

static baum_planar_pin_in_slot_def good(const planar_scene *scene)
{
  baum_planar_pin_in_slot_def def = baum_planar_pin_in_slot_def_default();
  def.name = "S";
  PLANAR_BETWEEN(scene, &def, scene->link, scene->bead);
  return def;
}

static double coordinate_of(const test_point *p)
{
  const baum_i_joint *joint = p->mechanism->joints[0];
  baum_i_coordinate c;
  joint->type->coordinate(joint, 0, &p->point, &c);
  return c.value;
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_slot, true, check_joint_derivatives);
}

static void coordinate_derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_slot, true, check_coordinate_derivatives);
}

static void reactions_balance(void **state)
{
  (void)state;
  for_each_planar_pair(add_slot, true, check_rows_balance);
}

static void the_pin_moves_along_the_axis_and_rotates(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_pin_in_slot_def def = baum_planar_pin_in_slot_def_default();
  def.body_a = scene.link;
  def.body_b = scene.crank;
  def.point[0] = -0.3; /* the centre of the crank, so that the angle of the crank does not matter */
  def.point[1] = 1.2;
  def.axis[0] = 3.0;
  def.axis[1] = 4.0;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double *crank = p.q + p.mechanism->bodies[scene.crank.index1]->q;
  double phi;
  crank[0] += 3.0 - 0.8;
  crank[1] += 4.0 + 0.6;
  crank[2] += 2.0;
  test_point_update(&p);
  assert_int_equal(baum_i_mechanism_phi(&p.point, &phi), BAUM_OK);
  /* The tolerance is the rounding error of lengths of 7 m. */
  ASSERT_NEAR(phi, 1.0, 0.0, 1e-14);
  ASSERT_NEAR(coordinate_of(&p), 5.0, 0.0, 1e-14);
  test_point_close(&p);
}

static void a_slot_may_be_driven_with_a_particle_in_it(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_pin_in_slot_def def = good(&scene);
  baum_driver_def drive = baum_driver_def_default();
  assert_int_equal(baum_mechanism_add_planar_pin_in_slot(scene.mechanism, &def, &drive.joint),
                   BAUM_OK);
  drive.value = 0.25;
  assert_int_equal(baum_mechanism_add_driver(scene.mechanism, &drive, NULL), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  uint64_t seed = 11;
  for (int k = 0; k < 5; k++) {
    double phi[2];
    test_point_random(&p, &seed);
    assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
    ASSERT_NEAR(phi[1], coordinate_of(&p) - 0.25, 0.0, 1e-15);
    check_joint_derivatives(&p);
  }
  test_point_close(&p);
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_pin_in_slot_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_pin_in_slot_def, point_a[1]), TEST_NAN,
     "joint 1 \"S\": point_a[1] is nan m, must be finite"},
    {offsetof(baum_planar_pin_in_slot_def, axis[0]), TEST_NAN,
     "joint 1 \"S\": axis[0] is nan, must be finite"},
    {offsetof(baum_planar_pin_in_slot_def, axis[0]), 0.0,
     "joint 1 \"S\": axis is (0, 0), which has no direction"},
    {offsetof(baum_planar_pin_in_slot_def, point_b[0]), 0.5,
     "joint 1 \"S\": point_b is (0.5, 0) m, must be (0, 0) on the particle body 4 \"bead\""},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 4);
  PLANAR_BETWEEN(&scene, &def, scene.ball, scene.crank);
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"S\": body_a is body 2 \"ball\", which has no angle");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_pin_in_slot_def first = good(&scene);
  baum_planar_pin_in_slot_def second = first;
  second.name = "other";
  second.point_a[0] = 11.0;
  second.axis[0] = 0.6;
  second.axis[1] = -0.8;
  CHECK_ROUND_TRIP(joint, planar_pin_in_slot, axis, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(coordinate_derivatives_agree_with_differences),
    cmocka_unit_test(reactions_balance),
    cmocka_unit_test(the_pin_moves_along_the_axis_and_rotates),
    cmocka_unit_test(a_slot_may_be_driven_with_a_particle_in_it),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
