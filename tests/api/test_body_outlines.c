/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests outlines that users give to bodies: their shapes, wrong outlines, copies, and allocations
 * that fail. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "check.h"
#include "construct.h"
#include "draw/drawing.h"
#include "heap.h"
#include "mechanism/fingerprint.h"
#include "message.h"
#include "user_models.h"

enum { BYTES = 1 << 16, FORMS = 6 };

/* A concave polygon. */
static const double POINTS[4][3] = {{0.0, 0.0, 0.5}, {2.0, 0.0, 0.5}, {0.5, 0.5, 0.5}, {0, 2, 0.5}};
static const int32_t TRIANGLES[2][3] = {{0, 1, 2}, {0, 2, 3}};

/* Returns a good outline of any form. */
static baum_outline outline_of(baum_outline_form form)
{
  baum_outline o = baum_outline_default();
  o.form = form;
  o.points = POINTS[0];
  o.point_count = 4;
  o.triangles = TRIANGLES[0];
  o.triangle_count = 2;
  o.center[0] = 1.0;
  o.size[0] = o.size[1] = 3.0;
  o.end[2] = 4.0;
  o.radius = 0.25;
  o.color = "#12aBcd";
  return o;
}

/* A planar body that is pinned to ground, a free spatial body, and a body with user coordinates. */
typedef struct scene {
  baum_mechanism *mechanism;
  baum_body_id flat, solid, coordinates;
} scene;

static scene make_scene(void)
{
  scene s;
  baum_planar_body_def flat = baum_planar_body_def_default();
  baum_spatial_body_def solid = baum_spatial_body_def_default();
  baum_coordinates_def coordinates = baum_coordinates_def_default();
  flat.name = "flat";
  flat.position[0] = 1.0;
  coordinates.size = 1;
  coordinates.mass = user_mass_of_first;
  coordinates.force = user_no_force;
  s.mechanism = create_mechanism();
  check(baum_mechanism_add_planar_body(s.mechanism, &flat, &s.flat));
  check(baum_mechanism_add_spatial_body(s.mechanism, &solid, &s.solid));
  check(baum_mechanism_add_coordinates(s.mechanism, &coordinates, &s.coordinates));
  (void)add_planar_pin(s.mechanism, NULL, BAUM_GROUND, s.flat, 0.0, 0.0);
  return s;
}

static void draw_design(const baum_mechanism *m, baum_i_drawing *out)
{
  check(baum_i_drawing_create(m, &(baum_i_samples){NULL, 0, 0}, out));
}

/* Returns how many shapes a body has. The index of ground is 0. *last is set to the last shape. */
static int shapes_of(const baum_i_drawing *drawing, int body, baum_i_shape *last)
{
  int count = 0;
  for (int k = 0; k < drawing->shape_count; k++) {
    if (drawing->shapes[k].element == &drawing->mechanism->bodies[body]->element) {
      *last = drawing->shapes[k];
      count++;
    }
  }
  return count;
}

/* ---- shapes ---- */

static void an_outline_replaces_the_shapes_of_its_body(void **state)
{
  (void)state;
  static const struct {
    baum_i_form form;
    int count;
    double radius;
    double last[3]; /* the last point of the shape */
  } wanted[FORMS] = {
    {BAUM_I_AREA, 4, 0.0, {0.0, 2.0, 0.5}},  {BAUM_I_DISC, 2, 0.25, {0.0, 0.0, 1.0}},
    {BAUM_I_BOX, 2, 0.0, {1.5, 1.5, 0.0}},   {BAUM_I_CYLINDER, 2, 0.25, {0.0, 0.0, 4.0}},
    {BAUM_I_BALL, 1, 0.25, {1.0, 0.0, 0.0}}, {BAUM_I_MESH, 4, 0.0, {0.0, 2.0, 0.5}},
  };
  scene s = make_scene();
  const baum_body_id bodies[3] = {BAUM_GROUND, s.flat, s.solid};
  for (int k = 0; k < 3 * FORMS; k++) {
    const baum_outline o = outline_of((baum_outline_form)(k / 3));
    baum_i_drawing drawing;
    baum_i_shape shape = {.style = BAUM_I_GAP};
    check(baum_mechanism_set_outlines(s.mechanism, bodies[k % 3], &o, 1));
    draw_design(s.mechanism, &drawing);
    assert_int_equal(shapes_of(&drawing, k % 3, &shape), 1);
    assert_int_equal(shape.form, wanted[k / 3].form);
    assert_int_equal(shape.style, k % 3 == 0 ? BAUM_I_BASE : BAUM_I_BODY);
    assert_int_equal(shape.count, wanted[k / 3].count);
    assert_true(shape.radius == wanted[k / 3].radius);
    assert_string_equal(shape.color, "#12aBcd");
    assert_int_equal(shape.triangle_count, o.form == BAUM_OUTLINE_MESH ? 2 : 0);
    assert_memory_equal(drawing.points[shape.first + shape.count - 1], wanted[k / 3].last,
                        sizeof wanted->last);
    baum_i_drawing_release(&drawing);
  }
  baum_mechanism_destroy(s.mechanism);
}

static void print_svg(const baum_mechanism *m, char text[BYTES])
{
  check(baum_mechanism_svg(m, NULL, text, BYTES, NULL));
}

static void a_body_whose_outlines_are_removed_is_drawn_as_before(void **state)
{
  (void)state;
  static char before[BYTES], with[BYTES], after[BYTES];
  scene s = make_scene();
  const baum_outline two[2] = {outline_of(BAUM_OUTLINE_CIRCLE), outline_of(BAUM_OUTLINE_MESH)};
  print_svg(s.mechanism, before);
  check(baum_mechanism_set_outlines(s.mechanism, s.flat, two, 2));
  print_svg(s.mechanism, with);
  assert_string_not_equal(with, before);
  assert_non_null(strstr(with, "fill=\"#12aBcd\""));
  check(baum_mechanism_set_outlines(s.mechanism, s.flat, NULL, 0));
  print_svg(s.mechanism, after);
  assert_string_equal(after, before);
  baum_mechanism_destroy(s.mechanism);
}

/* Seen from above, the red triangle is nearer. */
static void nearer_triangles_of_two_meshes_cover_those_behind(void **state)
{
  (void)state;
  static char text[BYTES];
  static const double low[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  static const double high[3][3] = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  scene s = make_scene();
  baum_outline two[2] = {outline_of(BAUM_OUTLINE_MESH), outline_of(BAUM_OUTLINE_MESH)};
  for (int k = 0; k < 2; k++) { /* for both orders of the meshes */
    two[k].points = high[0];
    two[1 - k].points = low[0];
    two[0].point_count = two[1].point_count = 3;
    two[0].triangle_count = two[1].triangle_count = 1;
    two[k].color = "#ff0000";
    two[1 - k].color = "#0000ff";
    /* Gravity along -z makes z vertical, so that the picture shows the meshes from above. */
    check(baum_mechanism_set_gravity(s.mechanism, 0.0, 0.0, -9.81));
    check(baum_mechanism_set_outlines(s.mechanism, s.solid, two, 2));
    print_svg(s.mechanism, text);
    const char *red = NULL, *blue = NULL;
    for (const char *at = text; (at = strstr(at, " fill=\"#")) != NULL; at++) {
      red = strncmp(at + 10, "0000\"", 5) == 0 ? at : red;
      blue = strncmp(at + 8, "0000", 4) == 0 && at[14] == '"' ? at : blue;
    }
    assert_non_null(red);
    assert_non_null(blue);
    assert_true(red > blue);
  }
  baum_mechanism_destroy(s.mechanism);
}

/* ---- storage ---- */

static void copies_have_the_outlines_and_no_number_changes(void **state)
{
  (void)state;
  scene s = make_scene();
  baum_mechanism *copy;
  baum_outline outlines[FORMS], got;
  for (int k = 0; k < FORMS; k++) {
    outlines[k] = outline_of((baum_outline_form)k);
  }
  check(baum_mechanism_freeze(s.mechanism));
  const baum_i_fingerprint before = baum_i_mechanism_fingerprint(s.mechanism);
  check(baum_mechanism_set_outlines(s.mechanism, BAUM_GROUND, outlines, 2));
  check(baum_mechanism_set_outlines(s.mechanism, s.solid, outlines, FORMS));
  check(baum_mechanism_copy(s.mechanism, &copy));
  check(baum_mechanism_freeze(copy));
  for (int k = 0; k < 2; k++) {
    const baum_i_fingerprint after = baum_i_mechanism_fingerprint(k ? copy : s.mechanism);
    assert_memory_equal(&after, &before, sizeof before);
  }
  baum_mechanism_destroy(s.mechanism);
  assert_int_equal(baum_mechanism_outline_count(copy, BAUM_GROUND), 2);
  assert_int_equal(baum_mechanism_outline_count(copy, s.flat), 0);
  assert_int_equal(baum_mechanism_outline_count(copy, s.solid), FORMS);
  check(baum_mechanism_get_outline(copy, s.solid, BAUM_OUTLINE_MESH, &got, sizeof got));
  assert_memory_equal(got.points, POINTS, sizeof POINTS);
  assert_memory_equal(got.triangles, TRIANGLES, sizeof TRIANGLES);
  assert_string_equal(got.color, "#12aBcd");
  assert_ptr_not_equal(got.points, POINTS);
  check(baum_mechanism_get_outline(copy, s.solid, BAUM_OUTLINE_BOX, &got, sizeof got));
  assert_true(got.form == BAUM_OUTLINE_BOX && got.size[1] == 3.0 && got.points == NULL);
  baum_mechanism_destroy(copy);
}

static void copying_loses_no_memory_if_allocations_fail(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  scene s = make_scene();
  baum_outline outlines[FORMS];
  for (int k = 0; k < FORMS; k++) {
    outlines[k] = outline_of((baum_outline_form)k);
  }
  check(baum_mechanism_set_outlines(s.mechanism, s.flat, outlines, FORMS));
  const long before = heap_blocks();
  baum_status status = BAUM_ERR_MEMORY;
  long n = 0;
  for (; status == BAUM_ERR_MEMORY; n++) {
    baum_mechanism *copy;
    heap_fail(n, false);
    status = baum_mechanism_copy(s.mechanism, &copy);
    (void)heap_stop();
    baum_mechanism_destroy(copy);
    assert_int_equal(heap_blocks(), before);
  }
  assert_int_equal(status, BAUM_OK);
  assert_true(n > 10);
  baum_mechanism_destroy(s.mechanism);
}

/* ---- wrong calls ---- */

static void wrong_calls_are_refused(void **state)
{
  (void)state;
  scene s = make_scene(), other = make_scene();
  baum_outline o = outline_of(BAUM_OUTLINE_BOX), got;
  baum_mechanism *m = s.mechanism;
  check(baum_mechanism_set_outlines(m, s.flat, &o, 1));
  ASSERT_SAYS(baum_mechanism_set_outlines(NULL, s.flat, &o, 1), BAUM_ERR_ARGUMENT,
              "mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_set_outlines(m, other.flat, &o, 1), BAUM_ERR_ARGUMENT,
              "body is not of this mechanism");
  ASSERT_SAYS(baum_mechanism_set_outlines(m, (baum_body_id){0}, &o, 1), BAUM_ERR_ARGUMENT,
              "body is none");
  ASSERT_SAYS(baum_mechanism_set_outlines(m, s.coordinates, &o, 1), BAUM_ERR_ARGUMENT,
              "\"body3\"|user coordinates");
  ASSERT_SAYS(baum_mechanism_set_outlines(m, s.flat, NULL, 1), BAUM_ERR_ARGUMENT,
              "outlines are NULL");
  ASSERT_SAYS(baum_mechanism_set_outlines(m, s.flat, &o, -1), BAUM_ERR_ARGUMENT, "count");
  ASSERT_SAYS(baum_mechanism_get_outline(m, s.flat, 1, &got, sizeof got), BAUM_ERR_ARGUMENT,
              "k is 1");
  ASSERT_SAYS(baum_mechanism_get_outline(m, s.solid, 0, &got, sizeof got), BAUM_ERR_ARGUMENT,
              "there are no entries");
  ASSERT_SAYS(baum_mechanism_get_outline(m, s.flat, 0, NULL, sizeof got), BAUM_ERR_ARGUMENT,
              "out is NULL");
  ASSERT_SAYS(baum_mechanism_get_outline(m, other.flat, 0, &got, sizeof got), BAUM_ERR_ARGUMENT,
              "body");
  assert_int_equal(baum_mechanism_outline_count(NULL, s.flat), 0);
  assert_int_equal(baum_mechanism_outline_count(m, other.flat), 0);
  o.struct_size = 8;
  ASSERT_SAYS(baum_mechanism_set_outlines(m, s.flat, &o, 1), BAUM_ERR_STRUCT, "struct_size");
  baum_mechanism_destroy(m);
  baum_mechanism_destroy(other.mechanism);
}

/* A wrong value for one field of a good outline. */
typedef struct wrong {
  baum_outline_form form;
  const char *says;
  size_t offset;
  size_t size;
  const void *value;
} wrong;

#define WRONG(FORM, FIELD, VALUE, SAYS)                                               \
  {                                                                                   \
    BAUM_OUTLINE_##FORM, SAYS, offsetof(baum_outline, FIELD), sizeof(VALUE), &(VALUE) \
  }

static void wrong_fields_are_named_and_change_nothing(void **state)
{
  (void)state;
  static const double negative = -1.0, zeros[2] = {0.0, 0.0}, nan[3] = {0.0, 0.0, (double)NAN};
  static const double infinite = (double)INFINITY, zero = 0.0;
  static const double bent[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}};
  static const double hole[4][3] = {{0, 0, 0}, {1, (double)NAN, 0}, {1, 1, 1}, {0, 1, 0}};
  static const int32_t two = 2, none = 0, many = BAUM_OUTLINE_MAX_TRIANGLES + 1, seventh = 6;
  static const int32_t outside[2][3] = {{0, 1, 2}, {0, 4, 2}},
                       below[2][3] = {{0, 1, 2}, {0, -1, 2}};
  static const void *const null = NULL;
  static const double *const bent_points = bent[0], *const hole_points = hole[0];
  static const int32_t *const outside_triangles = outside[0], *const below_triangles = below[0];
  static const char *const red = "red", *const wide = "#12345g", *const empty = "";
  static const wrong wrongs[] = {
    WRONG(BOX, form, seventh, "form is not one of"),
    WRONG(BOX, color, red, "color"),
    WRONG(BOX, color, wide, "color"),
    WRONG(BOX, color, empty, "color"),
    WRONG(POLYGON, points, null, "points are NULL"),
    WRONG(POLYGON, point_count, two, "point_count is 2, must be at least 3"),
    WRONG(POLYGON, points, bent_points, "z of point 2 of a polygon is 1 m, must be 0 m"),
    WRONG(POLYGON, points, hole_points, "y of point 1 is nan m, must be finite"),
    WRONG(CIRCLE, radius, negative, "radius is -1 m, must be > 0"),
    WRONG(CIRCLE, center, nan, "center[2] is nan m"),
    WRONG(SPHERE, radius, zero, "radius is 0 m"),
    WRONG(SPHERE, radius, infinite, "radius is inf m"),
    WRONG(BOX, center, nan, "center[2] is nan m"),
    WRONG(BOX, size, negative, "size[0] is -1 m, must be >= 0"),
    WRONG(BOX, size, zeros, "two edges of a box are 0"),
    WRONG(BOX, size, nan, "size[2] is nan m"),
    WRONG(CYLINDER, start, nan, "start[2] is nan m"),
    WRONG(CYLINDER, end, nan, "end[2] is nan m"),
    WRONG(CYLINDER, radius, zero, "radius"),
    WRONG(MESH, points, hole_points, "y of point 1 is nan m"),
    WRONG(MESH, triangles, null, "triangles are NULL"),
    WRONG(MESH, triangle_count, none, "triangle_count is 0, must be from 1 to 200000"),
    WRONG(MESH, triangle_count, many, "triangle_count is 200001"),
    WRONG(MESH, triangles, outside_triangles, "triangle 1 refers to point 4, must be from 0 to 3"),
    WRONG(MESH, triangles, below_triangles, "triangle 1 refers to point -1"),
  };
  scene s = make_scene();
  baum_outline two_outlines[2] = {outline_of(BAUM_OUTLINE_BOX), outline_of(BAUM_OUTLINE_BOX)}, got;
  check(baum_mechanism_set_outlines(s.mechanism, s.flat, two_outlines, 1));
  for (size_t k = 0; k < sizeof wrongs / sizeof *wrongs; k++) {
    two_outlines[1] = outline_of(wrongs[k].form);
    memcpy((char *)&two_outlines[1] + wrongs[k].offset, wrongs[k].value, wrongs[k].size);
    const baum_status status = baum_mechanism_set_outlines(s.mechanism, s.flat, two_outlines, 2);
    ASSERT_SAYS(status, BAUM_ERR_ARGUMENT, wrongs[k].says);
    ASSERT_SAYS(status, BAUM_ERR_ARGUMENT, "outlines[1]");
  }
  two_outlines[1] = outline_of(BAUM_OUTLINE_CYLINDER);
  two_outlines[1].end[2] = 0.0;
  ASSERT_SAYS(baum_mechanism_set_outlines(s.mechanism, s.flat, two_outlines, 2), BAUM_ERR_ARGUMENT,
              "the same point");
  assert_int_equal(baum_mechanism_outline_count(s.mechanism, s.flat), 1);
  check(baum_mechanism_get_outline(s.mechanism, s.flat, 0, &got, sizeof got));
  assert_int_equal(got.form, BAUM_OUTLINE_BOX);
  baum_mechanism_destroy(s.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(an_outline_replaces_the_shapes_of_its_body),
    cmocka_unit_test(a_body_whose_outlines_are_removed_is_drawn_as_before),
    cmocka_unit_test(nearer_triangles_of_two_meshes_cover_those_behind),
    cmocka_unit_test(copies_have_the_outlines_and_no_number_changes),
    cmocka_unit_test(copying_loses_no_memory_if_allocations_fail),
    cmocka_unit_test(wrong_calls_are_refused),
    cmocka_unit_test(wrong_fields_are_named_and_change_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
