/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks the status and the message of a refused call. Include after cmocka.h. */
#ifndef BAUM_TEST_SENTENCE_H
#define BAUM_TEST_SENTENCE_H

#include <string.h>

#include <baum/status.h>

/* Asserts that the status is `want`, and that the message of this thread contains all parts. In
 * `parts`, the character '|' separates one part from the next. */
#define ASSERT_SAYS(status, want, parts) \
  assert_says_((status), (want), (parts), baum_message(), #status, __FILE__, __LINE__)

static inline void assert_says_(baum_status status, baum_status want, const char *parts,
                                const char *message, const char *text, const char *file, int line)
{
  if (status != want) {
    print_error("%s is %s, want %s; the last message is: %s\n", text, baum_status_name(status),
                baum_status_name(want), message);
    _fail(file, line);
  }
  while (*parts) {
    size_t length = strcspn(parts, "|");
    const char *found = message;
    while (*found && strncmp(found, parts, length) != 0) {
      found++;
    }
    if (!*found) {
      print_error("\"%.*s\" is not in: %s\n", (int)length, parts, message);
      _fail(file, line);
    }
    parts += length + (parts[length] == '|' ? 1 : 0);
  }
}

#endif
