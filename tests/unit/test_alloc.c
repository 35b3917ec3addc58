/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests allocation. A request for zero bytes gives a valid block, and a request for too many bytes
 * gives NULL. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/alloc.h"

static void requests_for_too_many_bytes_give_null(void **state)
{
  (void)state;
  double *old = baum_i_alloc(1, sizeof *old);
  assert_non_null(old);
  *old = 3.0;
  /* The first size overflows when it is rounded up to a power of two. */
  assert_null(baum_i_grow(old, SIZE_MAX, 1));
  assert_null(baum_i_grow(old, SIZE_MAX / 4, sizeof *old));
  assert_true(*old == 3.0); /* a failure keeps the old block */
  baum_i_free(old);
}

static void a_request_for_zero_bytes_gives_a_block(void **state)
{
  (void)state;
  void *blocks[] = {baum_i_alloc(0, 8), baum_i_alloc(8, 0), baum_i_grow(NULL, 0, 8),
                    baum_i_copy(NULL, 0, 8)};
  for (int k = 0; k < 4; k++) {
    assert_non_null(blocks[k]);
    baum_i_free(blocks[k]);
  }
  baum_i_free(NULL);
}

static void an_array_that_grows_one_by_one_keeps_its_elements(void **state)
{
  (void)state;
  int *numbers = NULL;
  for (int k = 0; k < 100; k++) {
    numbers = baum_i_grow_by_one(numbers, (size_t)k + 1, sizeof *numbers);
    assert_non_null(numbers);
    numbers[k] = k;
  }
  for (int k = 0; k < 100; k++) {
    assert_int_equal(numbers[k], k);
  }
  baum_i_free(numbers);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(requests_for_too_many_bytes_give_null),
    cmocka_unit_test(a_request_for_zero_bytes_gives_a_block),
    cmocka_unit_test(an_array_that_grows_one_by_one_keeps_its_elements),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
