/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "mechanism/planar/planar.h"

#include "assert_near.h"
#include "definitions.h"
#include "planar_scene.h"
#include "user_models.h"

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_revolute(mechanism, def, NULL);
}

static baum_planar_revolute_def pin(baum_body_id a, baum_body_id b)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  def.name = "B";
  def.body_a = a;
  def.body_b = b;
  return def;
}

/* ---- common fields of definitions ---- */

#define HAS_HEAD(NAME)                                                                             \
  do {                                                                                             \
    assert_int_equal(offsetof(baum_##NAME##_def, name), offsetof(baum_i_planar_head, name));       \
    assert_int_equal(offsetof(baum_##NAME##_def, body_a), offsetof(baum_i_planar_head, body_a));   \
    assert_int_equal(offsetof(baum_##NAME##_def, body_b), offsetof(baum_i_planar_head, body_b));   \
    assert_int_equal(offsetof(baum_##NAME##_def, point), offsetof(baum_i_planar_head, point));     \
    assert_int_equal(offsetof(baum_##NAME##_def, point_a), offsetof(baum_i_planar_head, point_a)); \
    assert_int_equal(offsetof(baum_##NAME##_def, point_b), offsetof(baum_i_planar_head, point_b)); \
  } while (0)

static void definitions_between_two_bodies_begin_with_the_same_fields(void **state)
{
  (void)state;
  HAS_HEAD(planar_revolute);
  HAS_HEAD(planar_translational);
  HAS_HEAD(planar_distance);
  HAS_HEAD(planar_fixed);
  HAS_HEAD(planar_spring);
}

/* ---- refused definitions ---- */

static void bodies_that_cannot_be_joined_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_revolute_def def = pin((baum_body_id){0}, scene.link);
  def.point[0] = 1.0;
  def.point[1] = 1.0;
  check_refused(scene.mechanism, add, &def, "joint 1 \"B\": body_a is none, must be given");
  def.body_a = scene.link;
  def.body_b = (baum_body_id){0};
  check_refused(scene.mechanism, add, &def, "joint 1 \"B\": body_b is none, must be given");
  def.body_b = scene.link;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"B\": body_a and body_b are both body 1 \"link\"");
  def.body_a = BAUM_GROUND;
  def.body_b = BAUM_GROUND;
  check_refused(scene.mechanism, add, &def, "joint 1 \"B\": body_a and body_b are both ground");

  planar_scene other = planar_scene_make();
  def.body_a = other.link;
  check_refused(scene.mechanism, add, &def, "joint 1 \"B\": body_a is not of this mechanism");
  baum_mechanism_destroy(other.mechanism);
  baum_mechanism_destroy(scene.mechanism);
}

static void user_coordinates_have_no_place_in_the_plane(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_coordinates_def coordinates = baum_coordinates_def_default();
  coordinates.name = "theta";
  coordinates.size = 1;
  coordinates.mass = user_mass_of_first;
  coordinates.force = user_no_force;
  baum_body_id theta;
  assert_int_equal(baum_mechanism_add_coordinates(scene.mechanism, &coordinates, &theta), BAUM_OK);
  baum_planar_revolute_def def = pin(scene.link, theta);
  def.point[0] = 1.0;
  def.point[1] = 1.0;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"B\": body_b is body 5 \"theta\", which has no position in the plane");
  baum_mechanism_destroy(scene.mechanism);
}

static void points_are_given_either_in_ground_or_in_body_axes(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_revolute_def def = pin(scene.link, scene.crank);
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"B\": no point is given; give point, or point_a and point_b");
  def.point_a[0] = 1.0;
  def.point_a[1] = 2.0;
  check_refused(scene.mechanism, add, &def, "joint 1 \"B\": point_a is given, but not point_b");
  def.point[0] = 1.0;
  def.point[1] = 2.0;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"B\": point and point_a are both given; give point alone, or point_a and "
                "point_b");
  def = pin(scene.link, scene.crank);
  def.point_b[0] = 1.0;
  def.point_b[1] = 2.0;
  check_refused(scene.mechanism, add, &def, "joint 1 \"B\": point_b is given, but not point_a");
  def.point[0] = 1.0;
  def.point[1] = 2.0;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"B\": point and point_b are both given; give point alone, or point_a and "
                "point_b");
  baum_mechanism_destroy(scene.mechanism);
}

static void a_point_on_a_particle_must_be_at_the_particle(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_revolute_def def = pin(scene.ball, scene.crank);
  def.point_a[0] = 0.1;
  def.point_a[1] = 0.0;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"B\": point_a is (0.1, 0) m, must be (0, 0) on the particle body 2 "
                "\"ball\"");
  def.body_a = scene.crank;
  def.body_b = scene.bead;
  def.point_b[1] = -2.0;
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"B\": point_b is (0, -2) m, must be (0, 0) on the particle body 4 "
                "\"bead\"");

  /* Only freeze() can compare the point with the design configuration. */
  def = pin(scene.crank, scene.ball);
  def.point[0] = -0.6;
  def.point[1] = 0.9;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(scene.mechanism), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(),
                      "joint 1 \"B\": point is (-0.6, 0.9) m, must be at the particle body 2 "
                      "\"ball\", which is at (-0.6, 0.8) m");
  assert_false(baum_mechanism_is_frozen(scene.mechanism));
  baum_mechanism_destroy(scene.mechanism);
}

/* ---- design configuration ---- */

static void a_point_of_the_design_is_converted_into_body_axes(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_revolute_def def = pin(scene.link, BAUM_GROUND);
  /* The design pose of the link is the position (1, 0.5) and the angle 0.4 rad. In the axes of the
   * link, the point is (2, 3). */
  double c = cos(0.4);
  double s = sin(0.4);
  def.point[0] = 1.0 + 2.0 * c - 3.0 * s;
  def.point[1] = 0.5 + 2.0 * s + 3.0 * c;
  double points[4];
  assert_int_equal(baum_i_planar_points(scene.mechanism, &(baum_i_element){.def = &def}, points),
                   BAUM_OK);
  ASSERT_NEAR(points[0], 2.0, 1e-15, 0.0);
  ASSERT_NEAR(points[1], 3.0, 1e-15, 0.0);
  ASSERT_NEAR(points[2], def.point[0], 0.0, 0.0);
  ASSERT_NEAR(points[3], def.point[1], 0.0, 0.0);
  baum_mechanism_destroy(scene.mechanism);
}

static void a_point_may_differ_from_its_particle_by_rounding(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  particle.position[0] = 0.1 + 0.2;
  baum_body_id id;
  assert_int_equal(baum_mechanism_add_planar_particle(scene.mechanism, &particle, &id), BAUM_OK);
  baum_planar_revolute_def def = pin(scene.link, id);
  def.point[0] = 0.3;
  def.point[1] = 0.0;
  double points[4] = {1.0, 1.0, 1.0, 1.0};
  assert_int_equal(baum_i_planar_points(scene.mechanism, &(baum_i_element){.def = &def}, points),
                   BAUM_OK);
  ASSERT_NEAR(points[2], 0.0, 0.0, 0.0);
  ASSERT_NEAR(points[3], 0.0, 0.0, 0.0);
  baum_mechanism_destroy(scene.mechanism);
}

static void design_frames_are_at_rest(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_body_def def = baum_planar_body_def_default();
  def.position[0] = 2.0;
  def.angle = 8.0;
  def.velocity[0] = 5.0;
  baum_body_id id;
  assert_int_equal(baum_mechanism_add_planar_body(scene.mechanism, &def, &id), BAUM_OK);
  baum_i_frame frame = baum_i_design_frame(scene.mechanism, id.index1);
  ASSERT_NEAR(frame.x, 2.0, 0.0, 0.0);
  ASSERT_NEAR(frame.angle, 8.0, 0.0, 0.0);
  ASSERT_NEAR(frame.c, cos(8.0), 0.0, 0.0);
  ASSERT_NEAR(frame.s, sin(8.0), 0.0, 0.0);
  ASSERT_NEAR(frame.vx, 0.0, 0.0, 0.0);
  frame = baum_i_design_frame(scene.mechanism, scene.ball.index1);
  ASSERT_NEAR(frame.y, 0.8, 0.0, 0.0);
  ASSERT_NEAR(frame.c, 1.0, 0.0, 0.0);
  frame = baum_i_design_frame(scene.mechanism, 0);
  ASSERT_NEAR(frame.x, 0.0, 0.0, 0.0);
  ASSERT_NEAR(frame.c, 1.0, 0.0, 0.0);
  baum_mechanism_destroy(scene.mechanism);
}

static void a_driver_does_not_change_the_characteristic_length(void **state)
{
  (void)state;
  double length[2];
  for (int driven = 0; driven < 2; driven++) {
    planar_scene scene = planar_scene_make();
    baum_planar_revolute_def def = pin(scene.link, scene.crank);
    def.point[0] = 1.0;
    def.point[1] = 1.0;
    baum_driver_def driver = baum_driver_def_default();
    driver.value = 1e6;
    assert_int_equal(baum_mechanism_add_planar_revolute(scene.mechanism, &def, &driver.joint),
                     BAUM_OK);
    if (driven) {
      assert_int_equal(baum_mechanism_add_driver(scene.mechanism, &driver, NULL), BAUM_OK);
    }
    assert_int_equal(baum_mechanism_freeze(scene.mechanism), BAUM_OK);
    length[driven] = scene.mechanism->length;
    baum_mechanism_destroy(scene.mechanism);
  }
  ASSERT_NEAR(length[1], length[0], 0.0, 0.0);
}

/* ---- packing ---- */

/* Opens a test point with a joint between a particle and a rigid body. */
static void open_span(test_point *p)
{
  planar_scene scene = planar_scene_make();
  baum_planar_revolute_def def = pin(scene.ball, scene.crank);
  PLANAR_BETWEEN(&scene, &def, scene.ball, scene.crank);
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point_open(p, scene.mechanism);
}

static void packing_omits_the_angle_of_a_particle(void **state)
{
  (void)state;
  test_point p;
  open_span(&p);
  const baum_i_span *span = &p.mechanism->joints[0]->span;
  assert_int_equal(span->nl, 5);
  double six[36];
  for (int i = 0; i < 36; i++) {
    six[i] = i;
  }
  double packed[25];
  baum_i_columns_pack(p.mechanism, span, 2, six, packed);
  const double rows[10] = {0, 1, 3, 4, 5, 6, 7, 9, 10, 11};
  assert_memory_equal(packed, rows, sizeof rows);
  baum_i_columns_pack_square(p.mechanism, span, BAUM_I_PLANE, six, packed);
  const double square[25] = {0,  1,  3,  4,  5,  6,  7,  9,  10, 11, 18, 19, 21,
                             22, 23, 24, 25, 27, 28, 29, 30, 31, 33, 34, 35};
  assert_memory_equal(packed, square, sizeof square);
  test_point_close(&p);
}

static void scattering_adds_what_gathering_takes(void **state)
{
  (void)state;
  test_point p;
  open_span(&p);
  const baum_i_joint *joint = p.mechanism->joints[0];
  double x[TEST_SIZE_MAX];
  for (int i = 0; i < p.nv; i++) {
    x[i] = 1.0 + i;
  }
  double six[6];
  baum_i_columns_gather(&p.point, &joint->span, BAUM_I_PLANE, x, six);
  /* The velocities belong to link (3), ball (2), crank (3) and bead (2). The joint is between ball
   * and crank. */
  const double want[6] = {4.0, 5.0, 0.0, 6.0, 7.0, 8.0};
  assert_memory_equal(six, want, sizeof six);
  baum_i_columns_scatter(p.mechanism, &joint->span, six, x);
  for (int i = 0; i < p.nv; i++) {
    bool ours = i >= 3 && i < 8;
    ASSERT_NEAR(x[i], (ours ? 2.0 : 1.0) * (1.0 + i), 0.0, 0.0);
  }
  test_point_close(&p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(definitions_between_two_bodies_begin_with_the_same_fields),
    cmocka_unit_test(bodies_that_cannot_be_joined_are_refused),
    cmocka_unit_test(user_coordinates_have_no_place_in_the_plane),
    cmocka_unit_test(points_are_given_either_in_ground_or_in_body_axes),
    cmocka_unit_test(a_point_on_a_particle_must_be_at_the_particle),
    cmocka_unit_test(a_point_of_the_design_is_converted_into_body_axes),
    cmocka_unit_test(a_point_may_differ_from_its_particle_by_rounding),
    cmocka_unit_test(design_frames_are_at_rest),
    cmocka_unit_test(a_driver_does_not_change_the_characteristic_length),
    cmocka_unit_test(packing_omits_the_angle_of_a_particle),
    cmocka_unit_test(scattering_adds_what_gathering_takes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
