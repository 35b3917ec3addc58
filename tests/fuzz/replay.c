/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs the target of a fuzzer on stored inputs, without the fuzzer. Usage: replay FILE... */
#include <stdio.h>
#include <stdlib.h>

#include "parts/bytes.h"

static unsigned char *read_file(const char *path, size_t *size)
{
  enum { MOST = 1 << 20 };
  FILE *file = fopen(path, "rb");
  unsigned char *bytes = malloc(MOST);
  if (!file || !bytes) {
    (void)fprintf(stderr, "%s cannot be read\n", path);
    exit(EXIT_FAILURE);
  }
  *size = fread(bytes, 1, MOST, file);
  (void)fclose(file);
  return bytes;
}

int main(int count, char **paths)
{
  for (int k = 1; k < count; k++) {
    size_t size = 0;
    unsigned char *bytes = read_file(paths[k], &size);
    /* If the program crashes, the last name in its output is the name of the input that caused
     * it. */
    (void)printf("%s\n", paths[k]);
    (void)fflush(stdout);
    (void)LLVMFuzzerTestOneInput(bytes, size);
    free(bytes);
  }
  return count > 1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
