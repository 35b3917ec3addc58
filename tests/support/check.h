/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks what a test assumes: that calls do not fail, or that the build contains SUNDIALS. Include
 * after cmocka.h. */
#ifndef BAUM_TEST_CHECK_H
#define BAUM_TEST_CHECK_H

#include <baum/status.h>
#include <baum/version.h>

/* Fails the test if the status is neither BAUM_OK nor a warning. */
static inline void check(baum_status status)
{
  if (status < BAUM_OK) {
    fail_msg("%s: %s", baum_status_name(status), baum_message());
  }
}

/* Skips the test in a build without SUNDIALS. */
static inline void need_sundials(void)
{
  if (!baum_has("sundials")) {
    skip();
  }
}

#endif
