/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares doubles. cmocka cannot be used for this, because it compares floats. Include after
 * cmocka.h. */
#ifndef BAUM_TEST_ASSERT_NEAR_H
#define BAUM_TEST_ASSERT_NEAR_H

#include <math.h>

/* Asserts that |got - want| <= atol + rtol |want|. If this is not true, prints both values. NaN
 * fails, and infinities pass if they are equal. */
#define ASSERT_NEAR(got, want, rtol, atol) \
  assert_near_((got), (want), (rtol), (atol), #got, __FILE__, __LINE__)

static inline void assert_near_(double got, double want, double rtol, double atol, const char *text,
                                const char *file, int line)
{
  if (got == want || fabs(got - want) <= atol + rtol * fabs(want)) {
    return;
  }
  print_error("%s = %.17g, want %.17g, off by %.3g, allowed %.3g\n", text, got, want, got - want,
              atol + rtol * fabs(want));
  _fail(file, line);
}

#endif
