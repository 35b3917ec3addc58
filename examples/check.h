/* SPDX-License-Identifier: BSD-3-Clause */
/* CHECK(call) checks the status that a call returns. If the status is a warning, it prints the
 * message. If the call has failed, it prints the message and ends the program. */
#ifndef CHECK_H
#define CHECK_H

#include <stdio.h>
#include <stdlib.h>

#include <baum/baum.h>

#define CHECK(call) check_status((call), #call, __FILE__, __LINE__)

static inline void check_status(baum_status status, const char *call, const char *file, int line)
{
  if (status >= BAUM_WARNED) {
    printf("note   %s\n", baum_message());
  } else if (status != BAUM_OK) {
    (void)fprintf(stderr, "%s:%d: %s\n%s: %s\n", file, line, call, baum_status_name(status),
                  baum_message());
    exit(EXIT_FAILURE);
  }
}

#endif
