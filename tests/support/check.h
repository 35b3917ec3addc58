/* SPDX-License-Identifier: BSD-3-Clause */
/* What a test takes for granted: calls that do not fail, a build with SUNDIALS. Include after
 * cmocka.h. */
#ifndef BAUM_TEST_CHECK_H
#define BAUM_TEST_CHECK_H

#include <baum/status.h>
#include <baum/version.h>

/* Warnings are fine. */
static inline void check(baum_status status)
{
  if (status < BAUM_OK) {
    fail_msg("%s: %s", baum_status_name(status), baum_message());
  }
}

/* The test is skipped in a build without. */
static inline void need_sundials(void)
{
  if (!baum_has("sundials")) {
    skip();
  }
}

#endif
