/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the shapes of drawings. Every kind of element has its symbol, and the outline of a body
 * follows from its joints. test_page.c tests the pages that contain these shapes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "draw/drawing.h"
#include "drawn_crank.h"
#include "every_element.h"

static int shapes_of(const baum_i_drawing *drawing, const char *name, baum_i_style style,
                     baum_i_form form)
{
  int count = 0;
  for (int k = 0; k < drawing->shape_count; k++) {
    const baum_i_shape *shape = &drawing->shapes[k];
    count +=
      strcmp(shape->element->name, name) == 0 && shape->style == style && shape->form == form;
  }
  return count;
}

static void draw_design(const baum_mechanism *m, baum_i_drawing *out)
{
  check(baum_i_drawing_create(m, &(baum_i_samples){NULL, 0, 0}, out));
}

/* ---- every kind ---- */

static bool is_drawn(const baum_i_drawing *drawing, const baum_i_element *element)
{
  for (int k = 0; k < drawing->shape_count; k++) {
    if (drawing->shapes[k].element == element) {
      return true;
    }
  }
  return false;
}

static void every_element_with_a_position_is_drawn(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  check(every_element_build(&parts));
  const baum_mechanism *m = parts.mechanism;
  baum_i_drawing drawing;
  draw_design(m, &drawing); /* the mechanism is not frozen */
  assert_true(drawing.spatial);
  for (int k = 1; k <= m->body_count; k++) {
    assert_int_equal(is_drawn(&drawing, &m->bodies[k]->element),
                     baum_i_frame_of(m->bodies[k]) != BAUM_I_FRAME_NONE);
  }
  for (int k = 0; k < m->joint_count; k++) {
    assert_true(is_drawn(&drawing, &m->joints[k]->element));
  }
  for (int k = 0; k < m->force_count; k++) {
    assert_true(is_drawn(&drawing, &m->forces[k]->element));
  }
  baum_i_drawing_release(&drawing);
  baum_mechanism_destroy(parts.mechanism);
}

/* This test fails if a kind of element has no symbol, or is missing from every_element.c. */
static void every_kind_of_the_library_is_drawn(void **state)
{
  (void)state;
#define KIND(FAMILY, NAME) {#NAME, &baum_i_##NAME##_definition},
  static const struct {
    const char *name;
    const baum_i_definition *const *definition;
  } kinds[] = {BAUM_I_KINDS(KIND)};
#undef KIND
  every_element parts = {.fault = NULL};
  check(every_element_build(&parts));
  baum_i_drawing drawing;
  draw_design(parts.mechanism, &drawing);
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    /* user coordinates have no position that could be drawn */
    bool drawn = strcmp(kinds[k].name, "coordinates") == 0;
    for (int i = 0; i < drawing.shape_count; i++) {
      drawn = drawn || drawing.shapes[i].element->definition == *kinds[k].definition;
    }
    if (!drawn) {
      fail_msg("%s is not drawn", kinds[k].name);
    }
  }
  baum_i_drawing_release(&drawing);
  baum_mechanism_destroy(parts.mechanism);
}

static void shapes_are_finite_and_sorted_by_style(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  check(every_element_build(&parts));
  baum_i_drawing drawing;
  draw_design(parts.mechanism, &drawing);
  for (int k = 0; k < drawing.point_count; k++) {
    for (int i = 0; i < 3; i++) {
      assert_true(isfinite(drawing.points[k][i]));
    }
  }
  for (int k = 1; k < drawing.shape_count; k++) {
    assert_true(drawing.shapes[k].style >= drawing.shapes[k - 1].style);
    assert_true(isfinite(drawing.shapes[k].radius));
  }
  baum_i_drawing_release(&drawing);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- outlines ---- */

static void outlines_of_bodies_follow_from_their_joints(void **state)
{
  (void)state;
  baum_mechanism *m = drawn_crank();
  baum_i_drawing drawing;
  draw_design(m, &drawing);
  assert_false(drawing.spatial);
  ASSERT_NEAR(drawing.unit, 0.02 * 3.0, 1e-14, 0.0);
  assert_int_equal(shapes_of(&drawing, "crank", BAUM_I_BODY, BAUM_I_LINE), 1); /* a single bar */
  /* A single triangle. */
  assert_int_equal(shapes_of(&drawing, "rod", BAUM_I_BODY, BAUM_I_AREA), 1);
  assert_int_equal(shapes_of(&drawing, "block", BAUM_I_BODY, BAUM_I_AREA), 1);
  assert_int_equal(shapes_of(&drawing, DRAWN_HOSTILE, BAUM_I_WHEEL, BAUM_I_DISC), 1);
  /* The ground at the pin O consists of two shapes, a foot and hatches. */
  assert_int_equal(shapes_of(&drawing, "O", BAUM_I_GROUND, BAUM_I_LINE), 2);
  assert_int_equal(shapes_of(&drawing, "A", BAUM_I_GROUND, BAUM_I_LINE), 0);
  assert_int_equal(shapes_of(&drawing, "guide", BAUM_I_GROUND, BAUM_I_LINE), 1);
  baum_i_drawing_release(&drawing);
  baum_mechanism_destroy(m);
}

static void links_of_a_long_chain_are_longer_than_wide(void **state)
{
  (void)state;
  baum_mechanism *m = create_mechanism();
  baum_body_id before = BAUM_GROUND;
  for (int k = 0; k < 50; k++) {
    baum_body_id body = drawn_body(m, NULL, k + 0.5, 0.0);
    add_planar_pin(m, NULL, before, body, k, 0.0);
    before = body;
  }
  baum_i_drawing drawing;
  draw_design(m, &drawing);
  ASSERT_NEAR(drawing.unit, 0.125 * 0.5, 1e-14, 0.0);
  baum_i_drawing_release(&drawing);
  baum_mechanism_destroy(m);
}

static void inner_points_are_not_part_of_an_outline(void **state)
{
  (void)state;
  static const double points[][2] = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0},
                                     {0.5, 0.5}, {0.5, 0.0}, {0.3, 0.6}};
  baum_mechanism *m = create_mechanism();
  baum_body_id plate = drawn_body(m, "plate", 0.5, 0.4);
  for (size_t k = 0; k < sizeof points / sizeof *points; k++) {
    add_planar_pin(m, NULL, BAUM_GROUND, plate, points[k][0], points[k][1]);
  }
  baum_i_drawing drawing;
  draw_design(m, &drawing);
  for (int k = 0; k < drawing.shape_count; k++) {
    if (drawing.shapes[k].style == BAUM_I_BODY) {
      assert_int_equal(drawing.shapes[k].count, 4);
    }
  }
  assert_int_equal(shapes_of(&drawing, "plate", BAUM_I_BODY, BAUM_I_AREA), 1);
  baum_i_drawing_release(&drawing);
  baum_mechanism_destroy(m);
}

static void a_body_with_an_axis_of_symmetry_is_a_cylinder(void **state)
{
  (void)state;
  enum { Y = 1 };
  const double radius = 0.5, half = 1.0, mass = 2.0;
  const double across = mass * (radius * radius / 4 + half * half / 3);
  baum_mechanism *m = create_mechanism();
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.name = "roller";
  def.mass = mass;
  def.inertia[0] = def.inertia[2] = across;
  def.inertia[Y] = mass * radius * radius / 2;
  check(baum_mechanism_add_spatial_body(m, &def, NULL));
  def.name = "block"; /* none of its moments of inertia are equal */
  def.inertia[0] = 0.9 * across;
  def.position[0] = 10.0;
  check(baum_mechanism_add_spatial_body(m, &def, NULL));
  baum_i_drawing drawing;
  draw_design(m, &drawing);
  assert_int_equal(drawing.shape_count, 3);
  assert_int_equal(shapes_of(&drawing, "roller", BAUM_I_MARK, BAUM_I_LINE), 1);
  assert_int_equal(shapes_of(&drawing, "roller", BAUM_I_BODY, BAUM_I_CYLINDER), 1);
  assert_int_equal(shapes_of(&drawing, "block", BAUM_I_BODY, BAUM_I_BOX), 1);
  const baum_i_shape *roller = &drawing.shapes[0];
  ASSERT_NEAR(roller->radius, radius, 1e-14, 0.0);
  for (int end = 0; end < 2; end++) {
    const double *at = drawing.points[roller->first + end];
    ASSERT_NEAR(at[Y], end ? half : -half, 1e-14, 0.0);
    ASSERT_NEAR(hypot(at[0], at[2]), 0.0, 0.0, 0.0);
  }
  baum_i_drawing_release(&drawing);
  baum_mechanism_destroy(m);
}

/* ---- the ground ---- */

/* Computes the mean point of all shapes of the ground, in drawing units. */
static void find_ground(const baum_mechanism *m, double middle[2])
{
  baum_i_drawing drawing;
  draw_design(m, &drawing);
  int count = 0;
  middle[0] = middle[1] = 0.0;
  for (int k = 0; k < drawing.shape_count; k++) {
    const baum_i_shape *shape = &drawing.shapes[k];
    for (int i = 0; i < shape->count && shape->style == BAUM_I_GROUND; i++) {
      middle[0] += drawing.points[shape->first + i][0] / drawing.unit;
      middle[1] += drawing.points[shape->first + i][1] / drawing.unit;
      count++;
    }
  }
  assert_true(count > 0);
  middle[0] /= count;
  middle[1] /= count;
  baum_i_drawing_release(&drawing);
}

/* Finds the ground of a bar with its centre at (x, y). The bar is pinned or welded to the ground at
 * the origin. */
static void find_ground_of_bar(double x, double y, bool weld, const double gravity[2],
                               double middle[2])
{
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, gravity[0], gravity[1], 0.0));
  baum_body_id bar = drawn_body(m, "bar", x, y);
  if (weld) {
    baum_planar_fixed_def def = baum_planar_fixed_def_default();
    def.body_a = BAUM_GROUND;
    def.body_b = bar;
    def.point[0] = def.point[1] = 0.0;
    check(baum_mechanism_add_planar_fixed(m, &def, NULL));
  } else {
    add_planar_pin(m, "pin", BAUM_GROUND, bar, 0.0, 0.0);
  }
  find_ground(m, middle);
  baum_mechanism_destroy(m);
}

static void the_ground_is_below_a_joint_unless_the_body_hangs_there(void **state)
{
  (void)state;
  const double down[2] = {0.0, -9.81}, left[2] = {-1.0, 0.0}, none[2] = {0.0, 0.0};
  double middle[2];
  find_ground_of_bar(1.0, 0.3, false, down, middle);
  assert_true(middle[1] < -1.0);
  find_ground_of_bar(0.0, 1.0, false, down, middle);
  assert_true(middle[1] < -1.0);
  find_ground_of_bar(0.2, -1.0, false, down, middle);
  assert_true(middle[1] > 1.0);
  find_ground_of_bar(0.0, 1.0, false, left, middle);
  assert_true(middle[0] < -1.0);
  find_ground_of_bar(1.0, 0.0, false, none, middle);
  assert_true(middle[1] < -1.0);
  find_ground_of_bar(1.0, 0.0, true, down, middle); /* the ground is a wall on the left */
  assert_true(middle[0] < -0.2);
  find_ground_of_bar(-1.0, 0.1, true, down, middle);
  assert_true(middle[0] > 0.2);
  find_ground_of_bar(0.1, -1.0, true, down, middle); /* the ground is a ceiling */
  assert_true(middle[1] > 0.2);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_element_with_a_position_is_drawn),
    cmocka_unit_test(every_kind_of_the_library_is_drawn),
    cmocka_unit_test(shapes_are_finite_and_sorted_by_style),
    cmocka_unit_test(outlines_of_bodies_follow_from_their_joints),
    cmocka_unit_test(links_of_a_long_chain_are_longer_than_wide),
    cmocka_unit_test(inner_points_are_not_part_of_an_outline),
    cmocka_unit_test(the_ground_is_below_a_joint_unless_the_body_hangs_there),
    cmocka_unit_test(a_body_with_an_axis_of_symmetry_is_a_cylinder),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
