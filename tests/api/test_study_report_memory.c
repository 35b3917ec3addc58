/* SPDX-License-Identifier: BSD-3-Clause */
/* If there is not enough memory for a report, the call must return a status, and no memory may be
 * lost. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "heap.h"
#include "report_scene.h"

/* Lets single allocations of a report fail. The call must return BAUM_ERR_MEMORY and lose no
 * memory. It may return BAUM_OK if only the memory for reading the processor's name is missing. */
static void check_form(const baum_study *study, baum_report_form form)
{
  int failures = 0;
  size_t size = 0;
  /* In the first call, the C library allocates memory that it keeps. */
  assert_int_equal(baum_study_print(study, form, NULL, NULL, 0, &size), BAUM_OK);
  long asked = 1;
  for (long n = 0; n < asked; n++) {
    long before = heap_blocks();
    heap_fail(n, false);
    baum_status status = baum_study_print(study, form, NULL, NULL, 0, &size);
    asked = heap_stop();
    assert_int_equal(heap_blocks(), before);
    assert_true(status == BAUM_OK || status == BAUM_ERR_MEMORY);
    failures += status == BAUM_ERR_MEMORY;
    asked = status == BAUM_ERR_MEMORY ? n + 2 : asked;
  }
  assert_true(failures >= 6); /* for entries, their order, methods, two fronts, and the text */
}

static void every_allocation_of_a_report_may_fail(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  report_scene scene = report_scene_make();
  assert_non_null(scene.study);
  assert_int_equal(baum_study_run(scene.study), BAUM_OK);
  for (int form = BAUM_REPORT_TEXT; form <= BAUM_REPORT_PAGE; form++) {
    check_form(scene.study, (baum_report_form)form);
  }
  report_scene_end(&scene);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_of_a_report_may_fail)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
