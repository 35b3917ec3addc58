/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests which of several known names is suggested for a wrong name. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/nearest.h"

static const char *const NAMES[] = {"mass", "inertia", "position", "planar_revolute", "a"};

static void check(const char *given, const char *note)
{
  baum_i_nearest search = baum_i_nearest_to(given);
  for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; k++) {
    baum_i_nearest_offer(&search, NAMES[k]);
  }
  assert_string_equal(baum_i_nearest_note(&search).text, note);
}

static void a_misspelt_name_is_found(void **state)
{
  (void)state;
  check("mas", "; did you mean \"mass\"?");
  check("masss", "; did you mean \"mass\"?");
  check("inretia", "; did you mean \"inertia\"?");
  check("ma", "; did you mean \"a\"?");
  check("postion", "; did you mean \"position\"?");
  check("revolute", "; did you mean \"planar_revolute\"?");
}

static void a_different_name_is_not_found(void **state)
{
  (void)state;
  check("", "");
  check("b", ""); /* no edit is allowed in a name of one character */
  check("mxxx", "");
  check("mxxs", "");
  check("mxss", "; did you mean \"mass\"?");
  check("velocity", "");
}

static void long_names_are_compared_up_to_a_limit(void **state)
{
  (void)state;
  char given[80];
  char known[80];
  for (size_t length = 62; length <= 65; length++) {
    memset(given, 'x', length);
    given[length] = '\0';
    memcpy(known, given, length + 1);
    known[0] = 'y';
    baum_i_nearest search = baum_i_nearest_to(given);
    baum_i_nearest_offer(&search, known);
    assert_true((search.name == known) == (length <= 63));
    search = baum_i_nearest_to("xxx");
    baum_i_nearest_offer(&search, known);
    assert_null(search.name);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_misspelt_name_is_found),
    cmocka_unit_test(a_different_name_is_not_found),
    cmocka_unit_test(long_names_are_compared_up_to_a_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
