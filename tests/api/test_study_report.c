/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the reports of a study: their content, and names with special characters. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <baum/draw.h>

#include "construct.h"
#include "message.h"
#include "report_scene.h"

static const baum_report_form FORMS[] = {BAUM_REPORT_TEXT, BAUM_REPORT_CSV, BAUM_REPORT_JSON,
                                         BAUM_REPORT_PAGE};
enum { FORM_COUNT = sizeof FORMS / sizeof FORMS[0] };

static const char PATH[] = "test_study_report.out";

static report_scene scene;

static int set_up(void **state)
{
  (void)state;
  scene = report_scene_make();
  return !scene.study || baum_study_run(scene.study) != BAUM_OK;
}

static int tear_down(void **state)
{
  (void)state;
  report_scene_end(&scene);
  return 0;
}

static char *print(const baum_study *study, baum_report_form form)
{
  size_t size = 0;
  assert_int_equal(baum_study_print(study, form, REPORT_TITLE, NULL, 0, &size), BAUM_OK);
  char *text = malloc(size + 1);
  assert_non_null(text);
  assert_int_equal(baum_study_print(study, form, REPORT_TITLE, text, size + 1, NULL), BAUM_OK);
  assert_int_equal(strlen(text), size);
  return text;
}

static int count(const char *text, const char *part)
{
  int found = 0;
  for (; (text = strstr(text, part)); text++) {
    found++;
  }
  return found;
}

/* ---- content ---- */

static void the_scene_has_an_entry_of_each_kind(void **state)
{
  (void)state;
  assert_int_equal(baum_study_entry_count(scene.study), REPORT_ENTRIES);
  for (int k = 0; k < REPORT_ENTRIES; k++) {
    baum_study_entry entry;
    assert_int_equal(baum_study_entry_at(scene.study, k, &entry, sizeof entry), BAUM_OK);
    assert_int_equal(entry.state, k == REPORT_REFUSED_ENTRY ? BAUM_STUDY_REFUSED : BAUM_STUDY_DONE);
    if (k == REPORT_WARNED_ENTRY) {
      assert_non_null(strstr(entry.message, REPORT_JOINT));
    }
  }
}

static void a_text_contains_every_entry_and_its_messages(void **state)
{
  (void)state;
  char *text = print(scene.study, BAUM_REPORT_TEXT);
  for (int k = 0; k < REPORT_ENTRIES; k++) {
    baum_study_entry entry;
    assert_int_equal(baum_study_entry_at(scene.study, k, &entry, sizeof entry), BAUM_OK);
    assert_true(count(text, entry.name) >= 1);
  }
  /* This word is once in the counts, once in the entry, and once in the messages. */
  assert_true(count(text, "refused") >= 3);
  assert_true(count(text, "unstable") >= 1);
  assert_int_equal(count(text, "Recommended settings"), 1);
  assert_int_equal(count(text, "\n  1e-10  "), 1);
  assert_int_equal(count(text, "\t") + count(text, "\xff"), 0);
  free(text);
}

static void a_csv_has_a_line_for_each_entry_and_as_many_cells(void **state)
{
  (void)state;
  char *text = print(scene.study, BAUM_REPORT_CSV);
  assert_int_equal(count(text, "\r\n"), 1 + REPORT_ENTRIES);
  assert_int_equal(strncmp(text, "name,integrator,formulation,gains,gain_1,", 41), 0);
  int titles = 1;
  for (const char *c = text; *c != '\r'; c++) {
    titles += *c == ',';
  }
  const char *entry = strstr(text, "\r\n") + 2;
  int cells = 1;
  bool quoted = false;
  for (; *entry != '\r'; entry++) {
    quoted ^= *entry == '"';
    cells += !quoted && *entry == ',';
  }
  assert_int_equal(cells, titles);
  free(text);
}

static void a_json_has_null_for_what_is_not_known(void **state)
{
  (void)state;
  char *text = print(scene.study, BAUM_REPORT_JSON);
  assert_int_equal(count(text, "\"state\": \"refused\""), 1);
  assert_int_equal(count(text, "nan"), 0);
  assert_int_equal(count(text, "inf"), 0);
  const char *refused = strstr(text, "\"state\": \"refused\"");
  assert_int_equal(strncmp(strstr(refused, "\"error\": "), "\"error\": null", 13), 0);
  const char *units = strstr(text, "\"units\": ");
  assert_non_null(units);
  assert_non_null(strstr(units, "\"cpu\": \"s\""));
  free(text);
}

/* The page contains a script that shows these data. tests/browser tests the script. */
static void a_page_has_the_data_of_every_entry_and_loads_nothing(void **state)
{
  (void)state;
  char *page = print(scene.study, BAUM_REPORT_PAGE);
  assert_int_equal(count(page, "\"DATA\""), 0);
  assert_int_equal(count(page, "\"levels\": "), 1); /* only rk2 has gains */
  /* There is one object for each entry, and one for each of the 4 methods. */
  assert_int_equal(count(page, "\n  {\"name\": "), REPORT_ENTRIES + 4);
  /* "http" occurs once in http-equiv, and twice in the name of the namespace of SVG. */
  assert_int_equal(count(page, "http"), 3);
  assert_int_equal(count(page, "default-src 'none'"), 1);
  free(page);
}

/* Checks that a report contains the picture of a rod at q. The rod is 1 m long, between pins at the
 * origin and at x = `to`. */
static void expect_picture(double to, const double *q)
{
  baum_study *study = NULL;
  baum_planar_body_def rod = baum_planar_body_def_default();
  rod.position[0] = 0.5;
  rod.position[1] = 0.1;
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = BAUM_GROUND;
  pin.point_a[1] = pin.point_b[1] = 0.0;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_body(m, &rod, &pin.body_b), BAUM_OK);
  for (int end = 0; end < 2; end++) {
    pin.name = end ? REPORT_JOINT : "pin";
    pin.point_a[0] = end ? to : 0.0;
    pin.point_b[0] = end ? 0.5 : -0.5;
    assert_int_equal(baum_mechanism_add_planar_revolute(m, &pin, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_study_create(m, 0.0, 1.0, &study), BAUM_OK);

  char *page = print(study, BAUM_REPORT_PAGE);
  char picture[20000];
  assert_int_equal(baum_mechanism_svg(m, q, picture, sizeof picture, NULL), BAUM_OK);
  assert_int_equal(count(page, picture), 1);
  assert_int_equal(count(page, "<svg xmlns"), 1);
  free(page);
  baum_study_destroy(study);
  baum_mechanism_destroy(m);
}

static void a_page_shows_the_initial_configuration(void **state)
{
  (void)state;
  expect_picture(1.0, (double[3]){0.5, 0.0, 0.0});
}

static void a_page_of_a_mechanism_that_cannot_be_assembled_shows_its_design(void **state)
{
  (void)state;
  expect_picture(2.0, NULL);
}

static void a_page_has_no_markup_of_users(void **state)
{
  (void)state;
  char *page = print(scene.study, BAUM_REPORT_PAGE);
  assert_int_equal(count(page, "<script"), 2); /* one for the data, one for the program */
  assert_int_equal(count(page, "</title><script>"), 0);
  assert_int_equal(count(page, "<img"), 0);
  assert_true(count(page, "\\u003cimg src=x onerror=\\\"") >= 1);
  assert_int_equal(count(page, "\\u003c/title>\\u003cscript>"), 1);
  free(page);
}

static void a_study_that_has_not_been_run_is_reported_too(void **state)
{
  (void)state;
  report_scene fresh = report_scene_make();
  baum_study *empty = NULL;
  assert_int_equal(baum_study_create(fresh.mechanism, 0.0, 1.0, &empty), BAUM_OK);
  for (int k = 0; k < FORM_COUNT; k++) {
    char *text = print(fresh.study, FORMS[k]);
    assert_true(count(text, "waiting") >= REPORT_ENTRIES || FORMS[k] == BAUM_REPORT_TEXT);
    free(text);
    text = print(empty, FORMS[k]);
    assert_true(strlen(text) > 100);
    free(text);
  }
  baum_study_destroy(empty);
  report_scene_end(&fresh);
}

/* ---- calls ---- */

static void a_buffer_that_is_too_short_gets_the_beginning(void **state)
{
  (void)state;
  char text[11];
  size_t size = 0;
  memset(text, 'x', sizeof text);
  assert_int_equal(
    baum_study_print(scene.study, BAUM_REPORT_TEXT, "a title", text, sizeof text, &size), BAUM_OK);
  assert_string_equal(text, "a title\nsp");
  assert_true(size > 1000);
}

static void bad_calls_are_refused(void **state)
{
  (void)state;
  char text[8];
  const baum_study *s = scene.study;
  baum_report_form none = (baum_report_form)17;
  ASSERT_SAYS(baum_study_print(NULL, BAUM_REPORT_CSV, NULL, text, 8, NULL), BAUM_ERR_ARGUMENT,
              "baum_study_print|study is NULL");
  ASSERT_SAYS(baum_study_print(s, none, NULL, text, 8, NULL), BAUM_ERR_ARGUMENT, "form is 17");
  ASSERT_SAYS(baum_study_print(s, BAUM_REPORT_CSV, NULL, NULL, 8, NULL), BAUM_ERR_ARGUMENT,
              "text is NULL");
  ASSERT_SAYS(baum_study_write(s, BAUM_REPORT_CSV, NULL, NULL), BAUM_ERR_ARGUMENT,
              "baum_study_write|path");
  ASSERT_SAYS(baum_study_write(s, BAUM_REPORT_CSV, NULL, ""), BAUM_ERR_ARGUMENT, "path");
  ASSERT_SAYS(baum_study_write(NULL, BAUM_REPORT_CSV, NULL, PATH), BAUM_ERR_ARGUMENT, "NULL");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_scene_has_an_entry_of_each_kind),
    cmocka_unit_test(a_text_contains_every_entry_and_its_messages),
    cmocka_unit_test(a_csv_has_a_line_for_each_entry_and_as_many_cells),
    cmocka_unit_test(a_json_has_null_for_what_is_not_known),
    cmocka_unit_test(a_page_has_the_data_of_every_entry_and_loads_nothing),
    cmocka_unit_test(a_page_shows_the_initial_configuration),
    cmocka_unit_test(a_page_of_a_mechanism_that_cannot_be_assembled_shows_its_design),
    cmocka_unit_test(a_page_has_no_markup_of_users),
    cmocka_unit_test(a_study_that_has_not_been_run_is_reported_too),
    cmocka_unit_test(a_buffer_that_is_too_short_gets_the_beginning),
    cmocka_unit_test(bad_calls_are_refused),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
