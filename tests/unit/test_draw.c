/* SPDX-License-Identifier: BSD-3-Clause */
/* Drawings and pages: every kind of element has its drawing, the shape of a body follows from its
 * joints, and names that a user gives cannot inject markup. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "assert_near.h"
#include "draw/drawing.h"
#include "every_element.h"
#include "message.h"

enum { BYTES = 1 << 18 };
static const char HOSTILE[] = "</script></title><b>\"'&\\ \xd7\x90\xd7\x91";

static void must(baum_status status)
{
  if (status != BAUM_OK) {
    fail_msg("%s", baum_message());
  }
}

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
  must(baum_i_drawing_create(m, &(baum_i_samples){NULL, 0, 0}, out));
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

static void every_element_with_a_place_is_drawn(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  must(every_element_build(&parts));
  const baum_mechanism *m = parts.mechanism;
  baum_i_drawing drawing;
  draw_design(m, &drawing); /* not frozen */
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

/* Fails if a kind is added without a symbol, or without an element in every_element.c. */
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
  must(every_element_build(&parts));
  baum_i_drawing drawing;
  draw_design(parts.mechanism, &drawing);
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    bool drawn = strcmp(kinds[k].name, "coordinates") == 0; /* which have no place */
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

static void all_numbers_of_shapes_are_finite_and_their_order_is_that_of_styles(void **state)
{
  (void)state;
  every_element parts = {.fault = NULL};
  must(every_element_build(&parts));
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

static baum_body_id add_body(baum_mechanism *m, const char *name, double x, double y)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  baum_body_id id;
  def.name = name;
  def.inertia = 0.02;
  def.position[0] = x;
  def.position[1] = y;
  must(baum_mechanism_add_planar_body(m, &def, &id));
  return id;
}

static void add_pin(baum_mechanism *m, const char *name, baum_body_id a, baum_body_id b, double x,
                    double y)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  def.name = name;
  def.body_a = a;
  def.body_b = b;
  def.point[0] = x;
  def.point[1] = y;
  must(baum_mechanism_add_planar_revolute(m, &def, NULL));
}

static void add_slider(baum_mechanism *m, baum_body_id body)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  def.name = "guide";
  def.body_a = BAUM_GROUND;
  def.body_b = body;
  def.point_a[0] = 0.0;
  def.point_a[1] = 0.0;
  def.point_b[0] = 0.0;
  def.point_b[1] = 0.0;
  must(baum_mechanism_add_planar_translational(m, &def, NULL));
}

/* A crank with two pins, a rod with three pins, a block on a guide, and a wheel. */
static baum_mechanism *make_crank(void)
{
  baum_mechanism *m;
  must(baum_mechanism_create(&m));
  baum_body_id crank = add_body(m, "crank", 0.5, 0.0);
  baum_body_id rod = add_body(m, "rod", 2.0, 0.2);
  baum_body_id block = add_body(m, "block", 3.0, 0.0);
  baum_body_id wheel = add_body(m, HOSTILE, 2.0, 1.0);
  add_pin(m, "O", BAUM_GROUND, crank, 0.0, 0.0);
  add_pin(m, "A", crank, rod, 1.0, 0.0);
  add_pin(m, "B", rod, block, 3.0, 0.0);
  add_pin(m, "C", rod, wheel, 2.0, 1.0);
  add_slider(m, block);
  return m;
}

static void bodies_look_as_their_joints_make_them(void **state)
{
  (void)state;
  baum_mechanism *m = make_crank();
  baum_i_drawing drawing;
  draw_design(m, &drawing);
  assert_false(drawing.spatial);
  ASSERT_NEAR(drawing.unit, 0.02 * 3.0, 1e-14, 0.0);
  assert_int_equal(shapes_of(&drawing, "crank", BAUM_I_BODY, BAUM_I_LINE), 1); /* a bar */
  assert_int_equal(shapes_of(&drawing, "rod", BAUM_I_BODY, BAUM_I_AREA), 1);   /* a triangle */
  assert_int_equal(shapes_of(&drawing, "block", BAUM_I_BODY, BAUM_I_AREA), 1);
  assert_int_equal(shapes_of(&drawing, HOSTILE, BAUM_I_WHEEL, BAUM_I_DISC), 1);
  assert_int_equal(shapes_of(&drawing, "O", BAUM_I_GROUND, BAUM_I_LINE), 2); /* a foot, hatches */
  assert_int_equal(shapes_of(&drawing, "A", BAUM_I_GROUND, BAUM_I_LINE), 0);
  assert_int_equal(shapes_of(&drawing, "guide", BAUM_I_GROUND, BAUM_I_LINE), 1);
  baum_i_drawing_release(&drawing);
  baum_mechanism_destroy(m);
}

static void links_of_a_long_chain_are_longer_than_wide(void **state)
{
  (void)state;
  baum_mechanism *m;
  must(baum_mechanism_create(&m));
  baum_body_id before = BAUM_GROUND;
  for (int k = 0; k < 50; k++) {
    baum_body_id body = add_body(m, NULL, k + 0.5, 0.0);
    add_pin(m, NULL, before, body, k, 0.0);
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
  baum_mechanism *m;
  must(baum_mechanism_create(&m));
  baum_body_id plate = add_body(m, "plate", 0.5, 0.4);
  for (size_t k = 0; k < sizeof points / sizeof *points; k++) {
    add_pin(m, NULL, BAUM_GROUND, plate, points[k][0], points[k][1]);
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
  baum_mechanism *m;
  must(baum_mechanism_create(&m));
  baum_spatial_body_def def = baum_spatial_body_def_default();
  def.name = "roller";
  def.mass = mass;
  def.inertia[0] = def.inertia[2] = across;
  def.inertia[Y] = mass * radius * radius / 2;
  must(baum_mechanism_add_spatial_body(m, &def, NULL));
  def.name = "block"; /* no two moments are equal */
  def.inertia[0] = 0.9 * across;
  def.position[0] = 10.0;
  must(baum_mechanism_add_spatial_body(m, &def, NULL));
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

/* The middle of the shapes of the ground, from a pin at the origin. */
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

/* A bar from the origin to a point, pinned or welded to the ground at the origin. */
static void find_ground_of_bar(double x, double y, bool weld, const double gravity[2],
                               double middle[2])
{
  baum_mechanism *m;
  must(baum_mechanism_create(&m));
  must(baum_mechanism_set_gravity(m, gravity[0], gravity[1], 0.0));
  baum_body_id bar = add_body(m, "bar", x, y);
  if (weld) {
    baum_planar_fixed_def def = baum_planar_fixed_def_default();
    def.body_a = BAUM_GROUND;
    def.body_b = bar;
    def.point[0] = def.point[1] = 0.0;
    must(baum_mechanism_add_planar_fixed(m, &def, NULL));
  } else {
    add_pin(m, "pin", BAUM_GROUND, bar, 0.0, 0.0);
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
  find_ground_of_bar(1.0, 0.0, true, down, middle); /* a wall on the left */
  assert_true(middle[0] < -0.2);
  find_ground_of_bar(-1.0, 0.1, true, down, middle);
  assert_true(middle[0] > 0.2);
  find_ground_of_bar(0.1, -1.0, true, down, middle); /* a ceiling */
  assert_true(middle[1] > 0.2);
}

/* ---- pictures ---- */

static char *print_svg(const baum_mechanism *m, const double *q)
{
  static char text[BYTES];
  size_t size;
  must(baum_mechanism_svg(m, q, text, sizeof text, &size));
  assert_int_equal(strlen(text), size);
  return text;
}

static void only_an_open_joint_has_a_red_line(void **state)
{
  (void)state;
  static const char RED[] = "#e11d48";
  double q[12];
  baum_mechanism *m = make_crank();
  must(baum_mechanism_freeze(m));
  baum_workspace *w;
  must(baum_workspace_create(m, &w));
  must(baum_workspace_design(w, q, NULL));
  assert_null(strstr(print_svg(m, NULL), RED));
  assert_null(strstr(print_svg(m, q), RED));
  q[6] += 0.1; /* the block */
  assert_non_null(strstr(print_svg(m, q), RED));
  q[6] = (double)NAN;
  ASSERT_SAYS(baum_mechanism_svg(m, q, NULL, 0, NULL), BAUM_ERR_NOT_FINITE, "q[6]");
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

static void a_mechanism_that_cannot_be_assembled_is_drawn_where_assembly_gave_up(void **state)
{
  (void)state;
  static char text[BYTES];
  baum_mechanism *m;
  must(baum_mechanism_create(&m));
  baum_body_id crank = add_body(m, "crank", 0.5, 0.0);
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.name = "O";
  pin.body_a = BAUM_GROUND;
  pin.body_b = crank;
  pin.point[0] = pin.point[1] = 0.0;
  must(baum_mechanism_add_planar_revolute(m, &pin, NULL));
  pin.name = "A"; /* 1 m from O on the crank, 2 m from it on the ground */
  pin.point[0] = pin.point[1] = (double)NAN;
  pin.point_a[0] = 2.0;
  pin.point_a[1] = 0.0;
  pin.point_b[0] = 0.5;
  pin.point_b[1] = 0.0;
  must(baum_mechanism_add_planar_revolute(m, &pin, NULL));
  must(baum_mechanism_svg_assembled(m, text, sizeof text, NULL)); /* not frozen */
  assert_string_not_equal(text, print_svg(m, NULL));
  assert_non_null(strstr(text, "#e11d48"));
  ASSERT_SAYS(baum_mechanism_svg_assembled(NULL, NULL, 0, NULL), BAUM_ERR_ARGUMENT, "NULL");
  must(baum_mechanism_freeze(m));
  static char again[BYTES];
  must(baum_mechanism_svg_assembled(m, again, sizeof again, NULL));
  assert_string_equal(text, again);
  baum_mobility mobility;
  must(baum_mechanism_mobility(m, &mobility, sizeof mobility));
  assert_non_null(strstr(mobility.text, "before assembly, joint 2 \"A\" is open most"));
  baum_mechanism_destroy(m);
}

static void names_stay_texts(void **state)
{
  (void)state;
  baum_mechanism *m = make_crank();
  const char *svg = print_svg(m, NULL);
  assert_non_null(strstr(svg, "<title>&lt;/script>&lt;/title>&lt;b>\"'&amp;\\ \xd7\x90\xd7\x91<"));
  assert_null(strstr(svg, "<b>"));
  must(baum_mechanism_freeze(m));
  static char text[BYTES];
  const double time = 0.0;
  const double q[12] = {0.0};
  const baum_channel channel = baum_channel_of(BAUM_Q);
  const char *label = HOSTILE;
  baum_page page = baum_page_default();
  page.title = "</script></title>\n\t\x01\xff"; /* control characters, invalid UTF-8 */
  page.times = page.plots = page.mark_times = &time;
  page.count = page.channel_count = page.plot_count = page.mark_count = 1;
  page.channels = &channel;
  page.rows = q;
  page.plot_labels = page.mark_texts = &label;
  must(baum_page_print(m, &page, text, sizeof text, NULL));
  assert_null(strstr(text, "</script></title>"));
  int found = 0;
  for (const char *at = text; (at = strstr(at, "\\u003c/script>\\u003c/title>")) != NULL; at++) {
    found++;
  }
  assert_true(found >= 4); /* body, title, label, mark */
  baum_mechanism_destroy(m);
}

static void wrong_calls_are_refused(void **state)
{
  (void)state;
  char text[8];
  const double q[12] = {0.0};
  baum_mechanism *m = make_crank();
  ASSERT_SAYS(baum_mechanism_svg(NULL, NULL, text, 8, NULL), BAUM_ERR_ARGUMENT,
              "mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_svg(m, q, text, 8, NULL), BAUM_ERR_STATE, "baum_mechanism_svg");
  ASSERT_SAYS(baum_mechanism_svg(m, NULL, NULL, 8, NULL), BAUM_ERR_ARGUMENT, "text is NULL");
  ASSERT_SAYS(baum_mechanism_write_svg(m, NULL, ""), BAUM_ERR_ARGUMENT, "path is NULL or empty");
  baum_page page = baum_page_default();
  ASSERT_SAYS(baum_page_print(m, &page, text, 8, NULL), BAUM_ERR_STATE, "baum_page_print");
  must(baum_mechanism_freeze(m));
  ASSERT_SAYS(baum_page_print(m, NULL, text, 8, NULL), BAUM_ERR_ARGUMENT, "page is NULL");
  ASSERT_SAYS(baum_page_print(m, &page, text, 8, NULL), BAUM_ERR_ARGUMENT, "times and rows");
  page.times = page.rows = q;
  page.count = 1;
  ASSERT_SAYS(baum_page_print(m, &page, text, 8, NULL), BAUM_ERR_ARGUMENT, "channels");
  baum_channel channel = baum_channel_of(BAUM_V);
  page.channels = &channel;
  page.channel_count = 1;
  ASSERT_SAYS(baum_page_print(m, &page, text, 8, NULL), BAUM_ERR_ARGUMENT, "BAUM_Q");
  channel.quantity = BAUM_Q;
  must(baum_page_print(m, &page, text, 8, NULL));
  assert_string_equal(text, "<!DOCTY");
  page.traces = &channel;
  page.trace_count = 1;
  ASSERT_SAYS(baum_page_print(m, &page, text, 8, NULL), BAUM_ERR_ARGUMENT, "traces[0]");
  page.trace_count = 0;
  page.plot_count = 1;
  ASSERT_SAYS(baum_page_print(m, &page, text, 8, NULL), BAUM_ERR_ARGUMENT, "plot_labels");
  page.plot_count = 0;
  page.mark_count = -1;
  ASSERT_SAYS(baum_page_print(m, &page, text, 8, NULL), BAUM_ERR_ARGUMENT, "mark_texts");
  const int32_t kinds[2] = {BAUM_MARK_EVENT, 3};
  const char *texts[2] = {"", ""};
  page.mark_times = q;
  page.mark_texts = texts;
  page.mark_kinds = kinds;
  page.mark_count = 2;
  ASSERT_SAYS(baum_page_print(m, &page, text, 8, NULL), BAUM_ERR_ARGUMENT, "mark_kinds[1] is 3");
  page.struct_size = 8;
  ASSERT_SAYS(baum_page_write(m, &page, "page.html"), BAUM_ERR_STRUCT, "struct_size");
  baum_mechanism_destroy(m);
}

static void the_page_of_an_older_program_lacks_its_last_fields(void **state)
{
  (void)state;
  static char text[BYTES];
  const double time = 0.0;
  const double q[12] = {0.0};
  const baum_channel channel = baum_channel_of(BAUM_Q);
  baum_mechanism *m = make_crank();
  must(baum_mechanism_freeze(m));
  baum_page page = baum_page_default();
  page.times = &time;
  page.count = page.channel_count = 1;
  page.channels = &channel;
  page.rows = q;
  page.mark_count = 7; /* without its arrays */
  ASSERT_SAYS(baum_page_print(m, &page, text, sizeof text, NULL), BAUM_ERR_ARGUMENT, "mark_texts");
  page.struct_size = offsetof(baum_page, mark_times);
  must(baum_page_print(m, &page, text, sizeof text, NULL));
  page.struct_size = sizeof page + sizeof(size_t);
  ASSERT_SAYS(baum_page_print(m, &page, text, sizeof text, NULL), BAUM_ERR_STRUCT, "struct_size");
  baum_mechanism_destroy(m);
}

/* ---- thinning ---- */

static void a_long_run_keeps_600_frames_and_its_extremes(void **state)
{
  (void)state;
  enum { N = 5000, NQ = 12 };
  static double times[N], rows[N][NQ], plot[N];
  static char text[BYTES];
  baum_mechanism *m = make_crank();
  must(baum_mechanism_freeze(m));
  for (int k = 0; k < N; k++) {
    times[k] = k;
    plot[k] = k == 1234 ? 7.25 : k == 4321 ? -3.5 : 0.0;
  }
  const baum_channel channel = baum_channel_of(BAUM_Q);
  const char *label = "peak [m]";
  baum_page page = baum_page_default();
  page.times = times;
  page.count = N;
  page.channels = &channel;
  page.channel_count = page.plot_count = 1;
  page.rows = rows[0];
  page.plots = plot;
  page.plot_labels = &label;
  must(baum_page_print(m, &page, text, sizeof text, NULL));
  const char *frames = strstr(text, "\"frames\":");
  assert_non_null(frames);
  int count = 0;
  for (frames += strlen("\"frames\":"); *frames >= '0' && *frames <= '9'; frames++) {
    count = 10 * count + *frames - '0';
  }
  assert_in_range(count, 300, 600);
  assert_non_null(strstr(text, "[-3.5,7.25]"));
  assert_non_null(strstr(text, "[0,4999]")); /* range of times */
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_element_with_a_place_is_drawn),
    cmocka_unit_test(every_kind_of_the_library_is_drawn),
    cmocka_unit_test(all_numbers_of_shapes_are_finite_and_their_order_is_that_of_styles),
    cmocka_unit_test(bodies_look_as_their_joints_make_them),
    cmocka_unit_test(links_of_a_long_chain_are_longer_than_wide),
    cmocka_unit_test(inner_points_are_not_part_of_an_outline),
    cmocka_unit_test(the_ground_is_below_a_joint_unless_the_body_hangs_there),
    cmocka_unit_test(a_body_with_an_axis_of_symmetry_is_a_cylinder),
    cmocka_unit_test(only_an_open_joint_has_a_red_line),
    cmocka_unit_test(a_mechanism_that_cannot_be_assembled_is_drawn_where_assembly_gave_up),
    cmocka_unit_test(names_stay_texts),
    cmocka_unit_test(wrong_calls_are_refused),
    cmocka_unit_test(the_page_of_an_older_program_lacks_its_last_fields),
    cmocka_unit_test(a_long_run_keeps_600_frames_and_its_extremes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
