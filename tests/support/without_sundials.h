/* SPDX-License-Identifier: BSD-3-Clause */
/* The main() of a test that needs SUNDIALS, for builds that do not have it. Include after
 * cmocka.h. */
#ifndef BAUM_TEST_WITHOUT_SUNDIALS_H
#define BAUM_TEST_WITHOUT_SUNDIALS_H

static void there_is_nothing_to_test_without_sundials(void **state)
{
  (void)state;
  skip();
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(there_is_nothing_to_test_without_sundials)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

#endif
