/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls that must not fail. Include after cmocka.h. */
#ifndef BAUM_TEST_CHECK_H
#define BAUM_TEST_CHECK_H

#include <baum/status.h>

/* Warnings are fine. */
static inline void check(baum_status status)
{
  if (status < BAUM_OK) {
    fail_msg("%s: %s", baum_status_name(status), baum_message());
  }
}

#endif
