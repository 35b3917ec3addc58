/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests pictures and pages: red lines at open joints, texts, samples of motions, and refused
 * calls. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "base/rotation.h"
#include "check.h"
#include "construct.h"
#include "drawn_crank.h"
#include "message.h"

enum { BYTES = 1 << 18 };

/* ---- pictures ---- */

static char *print_svg(const baum_mechanism *m, const double *q)
{
  static char text[BYTES];
  size_t size;
  check(baum_mechanism_svg(m, q, text, sizeof text, &size));
  assert_int_equal(strlen(text), size);
  return text;
}

static void only_an_open_joint_has_a_red_line(void **state)
{
  (void)state;
  static const char RED[] = "#e11d48";
  double q[12];
  baum_mechanism *m = drawn_crank();
  check(baum_mechanism_freeze(m));
  baum_workspace *w;
  check(baum_workspace_create(m, &w));
  check(baum_workspace_design(w, q, NULL));
  assert_null(strstr(print_svg(m, NULL), RED));
  assert_null(strstr(print_svg(m, q), RED));
  q[6] += 0.1; /* moves the block away */
  assert_non_null(strstr(print_svg(m, q), RED));
  q[6] = (double)NAN;
  ASSERT_SAYS(baum_mechanism_svg(m, q, NULL, 0, NULL), BAUM_ERR_NOT_FINITE, "q[6]");
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

static void a_mechanism_that_cannot_be_assembled_is_drawn_where_assembly_stopped(void **state)
{
  (void)state;
  static char text[BYTES];
  baum_mechanism *m = create_mechanism();
  baum_body_id crank = drawn_body(m, "crank", 0.5, 0.0);
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.name = "O";
  pin.body_a = BAUM_GROUND;
  pin.body_b = crank;
  pin.point[0] = pin.point[1] = 0.0;
  check(baum_mechanism_add_planar_revolute(m, &pin, NULL));
  pin.name = "A"; /* the pin is 1 m from O on the crank, but 2 m from O on the ground */
  pin.point[0] = pin.point[1] = (double)NAN;
  pin.point_a[0] = 2.0;
  pin.point_a[1] = 0.0;
  pin.point_b[0] = 0.5;
  pin.point_b[1] = 0.0;
  check(baum_mechanism_add_planar_revolute(m, &pin, NULL));
  check(baum_mechanism_svg_assembled(m, text, sizeof text, NULL)); /* the mechanism is not frozen */
  assert_string_not_equal(text, print_svg(m, NULL));
  assert_non_null(strstr(text, "#e11d48"));
  ASSERT_SAYS(baum_mechanism_svg_assembled(NULL, NULL, 0, NULL), BAUM_ERR_ARGUMENT, "NULL");
  check(baum_mechanism_freeze(m));
  static char again[BYTES];
  check(baum_mechanism_svg_assembled(m, again, sizeof again, NULL));
  assert_string_equal(text, again);
  baum_mobility mobility;
  check(baum_mechanism_mobility(m, &mobility, sizeof mobility));
  assert_non_null(strstr(mobility.text, "before assembly, joint 2 \"A\" is violated most"));
  baum_mechanism_destroy(m);
}

static void names_are_escaped(void **state)
{
  (void)state;
  baum_mechanism *m = drawn_crank();
  const char *svg = print_svg(m, NULL);
  assert_non_null(strstr(svg, "<title>&lt;/script>&lt;/title>&lt;b>\"'&amp;\\ \xd7\x90\xd7\x91<"));
  assert_null(strstr(svg, "<b>"));
  check(baum_mechanism_freeze(m));
  static char text[BYTES];
  const double time = 0.0;
  const double q[12] = {0.0};
  const baum_channel channel = baum_channel_of(BAUM_Q);
  const char *label = DRAWN_HOSTILE;
  baum_page page = baum_page_default();
  page.title = "</script></title>\n\t\x01\xff"; /* control characters, invalid UTF-8 */
  page.times = page.plots = page.mark_times = &time;
  page.count = page.channel_count = page.plot_count = page.mark_count = 1;
  page.channels = &channel;
  page.rows = q;
  page.plot_labels = page.mark_texts = &label;
  check(baum_page_print(m, &page, text, sizeof text, NULL));
  assert_null(strstr(text, "</script></title>"));
  int found = 0;
  for (const char *at = text; (at = strstr(at, "\\u003c/script>\\u003c/title>")) != NULL; at++) {
    found++;
  }
  assert_true(found >= 4); /* in the name of a body, in the title, in a label and in a mark */
  baum_mechanism_destroy(m);
}

/* ---- samples of a motion ---- */

/* Makes a page with three samples of the crank, which rotates by half a revolution, and with the
 * reaction of its pin. */
static baum_page page_of_crank(const baum_mechanism *m, double rows[3][15])
{
  static const double times[3] = {0.0, 1.0, 2.0};
  static baum_channel channels[2], trace;
  for (int k = 0; k < 3; k++) {
    for (int i = 0; i < 15; i++) {
      rows[k][i] = 0.0;
    }
    rows[k][2] = 0.5 * k * BAUM_I_REVOLUTION / 2.0;
    rows[k][0] = cos(rows[k][2]);
    rows[k][1] = sin(rows[k][2]);
    rows[k][12] = k == 1 ? 730.0 : 0.0;
    rows[k][14] = k == 2 ? -3.0 : 0.0;
  }
  channels[0] = baum_channel_of(BAUM_Q);
  channels[1] = baum_channel_of(BAUM_JOINT_REACTION);
  channels[1].joint = baum_mechanism_joint_at(m, 0);
  trace = baum_channel_of(BAUM_BODY_POSE);
  trace.body = baum_mechanism_body_at(m, 0);
  baum_page page = baum_page_default();
  page.times = times;
  page.count = 3;
  page.channels = channels;
  page.channel_count = 2;
  page.rows = rows[0];
  page.traces = &trace;
  page.trace_count = 1;
  return page;
}

static int count_of(const char *text, const char *part)
{
  int count = 0;
  for (const char *at = text; (at = strstr(at, part)) != NULL; at += strlen(part)) {
    count++;
  }
  return count;
}

static void a_sample_shows_paths_and_reactions_in_the_view_of_the_motion(void **state)
{
  (void)state;
  static char text[3][BYTES];
  double rows[3][15];
  baum_mechanism *m = drawn_crank();
  check(baum_mechanism_freeze(m));
  baum_page page = page_of_crank(m, rows);
  for (int k = 0; k < 3; k++) {
    check(baum_page_svg(m, &page, k, text[k], BYTES, NULL));
    assert_non_null(strstr(text[k], ">500 N</text>")); /* the largest force is 730 N */
    assert_int_equal(count_of(text[k], "<title>path of "), 1);
    assert_int_equal(count_of(text[k], "<title>reaction of "), 1);
    /* The first line gives the size and the view, which must be equal in all pictures. */
    assert_int_equal(strncmp(text[k], text[0], strcspn(text[0], "\n")), 0);
    /* The arrow of the force and the scale of forces have this colour. */
    assert_int_equal(count_of(text[k], "#be123c"), k == 1 ? 2 : 1);
    /* The arc that shows the moment and the tip of this arc have this colour. */
    assert_int_equal(count_of(text[k], "#8b5cf6"), k == 2 ? 2 : 0);
    const char *path = strstr(strstr(text[k], "<title>path of "), "<path d=\"M");
    int lines = 0;
    for (path += strlen("<path d=\"M"); *path != '"'; path++) {
      lines += *path == 'L';
    }
    assert_int_equal(lines, k);
  }
  baum_mechanism_destroy(m);
}

static void wrong_samples_are_refused(void **state)
{
  (void)state;
  char text[8];
  double rows[3][15];
  baum_mechanism *m = drawn_crank();
  ASSERT_SAYS(baum_page_svg(m, NULL, 0, text, 8, NULL), BAUM_ERR_STATE, "baum_page_svg");
  check(baum_mechanism_freeze(m));
  baum_page page = page_of_crank(m, rows);
  ASSERT_SAYS(baum_page_svg(m, &page, 3, text, 8, NULL), BAUM_ERR_ARGUMENT,
              "sample is 3, must be 0 to 2");
  ASSERT_SAYS(baum_page_svg(m, &page, -1, text, 8, NULL), BAUM_ERR_ARGUMENT, "sample is -1");
  rows[1][4] = (double)NAN;
  ASSERT_SAYS(baum_page_svg(m, &page, 1, text, 8, NULL), BAUM_ERR_NOT_FINITE, "q[4] is");
  check(baum_page_svg(m, &page, 2, text, 8, NULL));
  assert_string_equal(text, "<svg xm");
  baum_mechanism_destroy(m);
}

static void wrong_calls_are_refused(void **state)
{
  (void)state;
  char text[8];
  const double q[12] = {0.0};
  baum_mechanism *m = drawn_crank();
  ASSERT_SAYS(baum_mechanism_svg(NULL, NULL, text, 8, NULL), BAUM_ERR_ARGUMENT,
              "mechanism is NULL");
  ASSERT_SAYS(baum_mechanism_svg(m, q, text, 8, NULL), BAUM_ERR_STATE, "baum_mechanism_svg");
  ASSERT_SAYS(baum_mechanism_svg(m, NULL, NULL, 8, NULL), BAUM_ERR_ARGUMENT, "text is NULL");
  ASSERT_SAYS(baum_mechanism_write_svg(m, NULL, ""), BAUM_ERR_ARGUMENT, "path is NULL or empty");
  baum_page page = baum_page_default();
  ASSERT_SAYS(baum_page_print(m, &page, text, 8, NULL), BAUM_ERR_STATE, "baum_page_print");
  check(baum_mechanism_freeze(m));
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
  check(baum_page_print(m, &page, text, 8, NULL));
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

static void a_page_of_an_older_program_may_lack_the_last_fields(void **state)
{
  (void)state;
  static char text[BYTES];
  const double time = 0.0;
  const double q[12] = {0.0};
  const baum_channel channel = baum_channel_of(BAUM_Q);
  baum_mechanism *m = drawn_crank();
  check(baum_mechanism_freeze(m));
  baum_page page = baum_page_default();
  page.times = &time;
  page.count = page.channel_count = 1;
  page.channels = &channel;
  page.rows = q;
  page.mark_count = 7; /* the arrays are missing */
  ASSERT_SAYS(baum_page_print(m, &page, text, sizeof text, NULL), BAUM_ERR_ARGUMENT, "mark_texts");
  page.struct_size = offsetof(baum_page, mark_times);
  check(baum_page_print(m, &page, text, sizeof text, NULL));
  page.struct_size = sizeof page + sizeof(size_t);
  ASSERT_SAYS(baum_page_print(m, &page, text, sizeof text, NULL), BAUM_ERR_STRUCT, "struct_size");
  baum_mechanism_destroy(m);
}

/* ---- long runs ---- */

static void a_long_run_keeps_its_extremes_in_at_most_600_frames(void **state)
{
  (void)state;
  enum { N = 5000, NQ = 12 };
  static double times[N], rows[N][NQ], plot[N];
  static char text[BYTES];
  baum_mechanism *m = drawn_crank();
  check(baum_mechanism_freeze(m));
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
  check(baum_page_print(m, &page, text, sizeof text, NULL));
  const char *frames = strstr(text, "\"frames\":");
  assert_non_null(frames);
  int count = 0;
  for (frames += strlen("\"frames\":"); *frames >= '0' && *frames <= '9'; frames++) {
    count = 10 * count + *frames - '0';
  }
  assert_in_range(count, 300, 600);
  assert_non_null(strstr(text, "[-3.5,7.25]"));
  assert_non_null(strstr(text, "[0,4999]")); /* the range of times */
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(only_an_open_joint_has_a_red_line),
    cmocka_unit_test(a_mechanism_that_cannot_be_assembled_is_drawn_where_assembly_stopped),
    cmocka_unit_test(names_are_escaped),
    cmocka_unit_test(a_sample_shows_paths_and_reactions_in_the_view_of_the_motion),
    cmocka_unit_test(wrong_samples_are_refused),
    cmocka_unit_test(wrong_calls_are_refused),
    cmocka_unit_test(a_page_of_an_older_program_may_lack_the_last_fields),
    cmocka_unit_test(a_long_run_keeps_its_extremes_in_at_most_600_frames),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
