/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests how reports write texts and numbers. Texts are escaped, and exact numbers must be read back
 * without change. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/buffer.h"

static void check_put(baum_i_quoting quoting, const char *text, const char *want)
{
  baum_i_buffer buffer = {0};
  baum_i_put_user_text(&buffer, text, quoting);
  assert_false(buffer.failed);
  assert_string_equal(buffer.text, want);
  assert_int_equal(buffer.used, strlen(want));
  baum_i_buffer_clear(&buffer);
}

static void json_cannot_end_the_html_script_around_it(void **state)
{
  (void)state;
  check_put(BAUM_I_JSON, "</script><!--", "\\u003c/script>\\u003c!--");
}

static void json_and_csv_escape_quotes(void **state)
{
  (void)state;
  check_put(BAUM_I_JSON, "a\"b\\c", "a\\\"b\\\\c");
  check_put(BAUM_I_CSV, "a\"b\\c, d", "a\"\"b\\c, d");
}

static void control_characters_become_spaces(void **state)
{
  (void)state;
  check_put(BAUM_I_CSV, "a\x1b[1m\r\nb\x7f", "a [1m  b ");
  check_put(BAUM_I_JSON, "a\tb\nc", "a b c");
  check_put(BAUM_I_PLAIN, "a\x1b]0;<b>\"", "a ]0;<b>\"");
}

static void bytes_that_are_not_utf8_are_replaced(void **state)
{
  (void)state;
  const char *const good[] = {"\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x98\x80", "\xf4\x8f\xbf\xbf"};
  for (size_t k = 0; k < sizeof good / sizeof good[0]; k++) {
    check_put(BAUM_I_JSON, good[k], good[k]);
  }
  check_put(BAUM_I_JSON, "\xff", "\xef\xbf\xbd");
  check_put(BAUM_I_JSON, "\x80z", "\xef\xbf\xbdz");
  check_put(BAUM_I_JSON, "\xc3", "\xef\xbf\xbd"); /* incomplete character */
  /* The character "/" in an overlong encoding. */
  check_put(BAUM_I_JSON, "\xc0\xaf", "\xef\xbf\xbd\xef\xbf\xbd");
  check_put(BAUM_I_JSON, "\xed\xa0\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"); /* a surrogate */
  check_put(BAUM_I_JSON, "\xf4\x90\x80\x80", /* a number beyond Unicode */
            "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
}

static void exact_numbers_are_read_back(void **state)
{
  (void)state;
  const double numbers[] = {0.0, 1.0, -1.0 / 3.0, 1e-6, 0.1 + 0.2, DBL_MIN, DBL_MAX, 5e-324, 1e22};
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
    baum_i_number text = baum_i_exact(numbers[k], "");
    double back = strtod(text.text, NULL);
    assert_memory_equal(&back, &numbers[k], sizeof back);
    back = 0.5;
    assert_string_equal(baum_i_read_number(text.text, &back), "");
    assert_memory_equal(&back, &numbers[k], sizeof back);
  }
  double x = 0.0;
  const char *const none[] = {
    "", " ", ".", "x", "1.5x", "1.5.5", "1,5", "1e", "12345678901234567890123456789012345678901"};
  for (size_t k = 0; k < sizeof none / sizeof none[0]; k++) {
    assert_null(baum_i_read_number(none[k], &x));
  }
  assert_string_equal(baum_i_exact(1e-6, "").text, "1e-06");
  assert_string_equal(baum_i_exact((double)NAN, "null").text, "null");
  assert_string_equal(baum_i_exact(-(double)INFINITY, "null").text, "null");
}

static void short_numbers_are_readable(void **state)
{
  (void)state;
  assert_string_equal(baum_i_short(1.2345e-8, 3).text, "1.23e-08");
  assert_string_equal(baum_i_short(54321.0, 2).text, "54321");
  assert_string_equal(baum_i_short(1.2e7, 2).text, "1.2e+07");
  assert_string_equal(baum_i_short((double)NAN, 3).text, "-");
  assert_string_equal(baum_i_short((double)INFINITY, 3).text, "infinite");
}

static void column_widths_count_characters(void **state)
{
  (void)state;
  baum_i_buffer buffer = {0};
  baum_i_put_left(&buffer, "\xc3\xa9t\xc3\xa9", 5);
  baum_i_put_left(&buffer, "longer", 2);
  assert_string_equal(buffer.text, "\xc3\xa9t\xc3\xa9  longer");
  baum_i_buffer_clear(&buffer);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(json_cannot_end_the_html_script_around_it),
    cmocka_unit_test(json_and_csv_escape_quotes),
    cmocka_unit_test(control_characters_become_spaces),
    cmocka_unit_test(bytes_that_are_not_utf8_are_replaced),
    cmocka_unit_test(exact_numbers_are_read_back),
    cmocka_unit_test(short_numbers_are_readable),
    cmocka_unit_test(column_widths_count_characters),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
