/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the lines of study files. Numbers must be read back bit for bit, and lines that no study
 * would write must be refused. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/study.h>

#include "study/study_line.h"

enum { LINE = BAUM_I_STUDY_LINE };

static baum_study_entry entry_with(double error)
{
  return (baum_study_entry){
    .state = BAUM_STUDY_DONE,
    .status = BAUM_WARNED,
    .off = true,
    .error = error,
    .error_v = -error,
    .max_phi = 1.0 / 3.0,
    .steps = INT64_MAX,
    .repeats = 5,
    .cpu = 1e-5,
  };
}

static void numbers_of_all_kinds_are_read_back(void **state)
{
  (void)state;
  const double numbers[] = {0.0,     -0.0,    0.1 + 0.2,   1e-6,         1e22,
                            DBL_MAX, DBL_MIN, (double)NAN, -(double)NAN, (double)INFINITY};
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
    char line[LINE] = "entry";
    char again[LINE] = "entry";
    baum_study_entry from = entry_with(numbers[k]);
    baum_study_entry to = {.name = NULL};
    baum_i_study_write_fields(line, &from, baum_i_entry_fields);
    baum_i_study_write_text(line, "two\nlines");
    const char *end = baum_i_study_read_fields(line + 5, &to, baum_i_entry_fields);
    assert_non_null(end);
    assert_string_equal(end, " | two lines");
    assert_memory_equal(&to.error, &from.error, sizeof to.error);
    baum_i_study_write_fields(again, &to, baum_i_entry_fields);
    assert_memory_equal(again, line, strlen(again));
  }
}

static void lines_that_no_study_writes_are_refused(void **state)
{
  (void)state;
  const baum_i_field fields[] = {
    {"steps", "", "", BAUM_I_COUNT, true, true, offsetof(baum_study_entry, steps)},
    /* This list marks `state` as a field that files do not contain. */
    {"state", "", "", BAUM_I_STATE, true, false, offsetof(baum_study_entry, state)},
    {"repeats", "", "", BAUM_I_INDEX, true, true, offsetof(baum_study_entry, repeats)},
    {"cpu", "", "", BAUM_I_NUMBER, true, true, offsetof(baum_study_entry, cpu)},
    {.key = NULL}};
  const char *const bad[] = {" -1 0 1", " 1 -1 1", " 1 5000000000 1", " 1 0 1,5",
                             " 1 0 x",  " 1 0",    " 1 x 1",          ""};
  baum_study_entry entry;
  assert_non_null(baum_i_study_read_fields(" 1 0 1.5", &entry, fields));
  assert_true(entry.cpu == 1.5);
  for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
    assert_null(baum_i_study_read_fields(bad[k], &entry, fields));
  }
}

/* The first three fields of an entry are its state, its status and a flag. The reader must refuse
 * values that do not exist. The fourth number of each row tells whether the three values exist. */
static void states_and_statuses_that_do_not_exist_are_refused(void **state)
{
  (void)state;
  const int tries[][4] = {{1, 0, 1, true},    {4, 1, 0, true},    {3, -3, 0, true},
                          {0, 0, 0, false},   {5, 0, 0, false},   {-1, 0, 0, false},
                          {1, 777, 0, false}, {1, -77, 0, false}, {1, 0, 2, false}};
  for (size_t k = 0; k < sizeof tries / sizeof tries[0]; k++) {
    char line[LINE] = "";
    char text[LINE];
    baum_study_entry entry = entry_with(1e-6);
    baum_i_study_write_fields(line, &entry, baum_i_entry_fields);
    assert_memory_equal(line, " 1 10 0", 7);
    (void)snprintf(text, sizeof text, " %d %d %d%s", tries[k][0], tries[k][1], tries[k][2],
                   line + 7);
    const char *end = baum_i_study_read_fields(text, &entry, baum_i_entry_fields);
    assert_int_equal(end != NULL, tries[k][3]);
  }
}

static void changed_lines_and_lines_of_other_studies_are_refused(void **state)
{
  (void)state;
  char line[LINE] = "entry 0 # 1";
  char copy[LINE];
  baum_i_study_seal(line, 17);
  for (size_t k = 0; k < strlen(line); k++) {
    memcpy(copy, line, sizeof copy);
    copy[k] = copy[k] == '7' ? '8' : '7';
    assert_false(baum_i_study_unseal(copy, 17));
    memcpy(copy, line, sizeof copy);
    copy[k] = '\0';
    assert_false(baum_i_study_unseal(copy, 17));
  }
  memcpy(copy, line, sizeof copy);
  assert_false(baum_i_study_unseal(copy, 18));
  assert_true(baum_i_study_unseal(line, 17));
  assert_string_equal(line, "entry 0 # 1");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(numbers_of_all_kinds_are_read_back),
    cmocka_unit_test(lines_that_no_study_writes_are_refused),
    cmocka_unit_test(states_and_statuses_that_do_not_exist_are_refused),
    cmocka_unit_test(changed_lines_and_lines_of_other_studies_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
