/* SPDX-License-Identifier: BSD-3-Clause */
/* Compares doubles, because cmocka compares floats. Include after cmocka.h. */
#ifndef BAUM_TEST_ASSERT_NEAR_H
#define BAUM_TEST_ASSERT_NEAR_H

#include <math.h>

/* Asserts |got - want| <= atol + rtol |want|, and prints both values otherwise. NaN fails; equal
 * infinities pass. */
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
