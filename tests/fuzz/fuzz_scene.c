/* SPDX-License-Identifier: BSD-3-Clause */
/* Reads scenes from arbitrary bytes. If the library accepts a scene, writing it and reading it back
 * must give an equal mechanism. Freezing this mechanism may fail, but it must not crash. */
#include <stdlib.h>
#include <string.h>

#include "drawn.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  baum_mechanism *first = NULL;
  baum_mechanism *second = NULL;
  if (baum_mechanism_parse((const char *)data, size, NULL, 0, &first) != BAUM_OK) {
    FUZZ_CHECK(!first && baum_message()[0]);
    return 0;
  }
  size_t length = 0;
  if (baum_mechanism_print(first, NULL, 0, NULL, 0, &length) == BAUM_OK) {
    char *text = malloc(length + 1);
    bool equal = false;
    FUZZ_CHECK(text);
    FUZZ_CHECK(baum_mechanism_print(first, NULL, 0, text, length + 1, NULL) == BAUM_OK);
    FUZZ_CHECK(baum_mechanism_parse(text, length, NULL, 0, &second) == BAUM_OK);
    FUZZ_CHECK(baum_mechanism_compare(first, second, &equal) == BAUM_OK && equal);
    free(text);
  }
  (void)baum_mechanism_freeze(first);
  baum_mechanism_destroy(first);
  baum_mechanism_destroy(second);
  return 0;
}
