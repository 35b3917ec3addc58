/* SPDX-License-Identifier: BSD-3-Clause */
/* The smallest program of a user. It checks that the library that it loads has the same version as
 * the headers with which it was compiled. */
#include <stdio.h>
#include <string.h>

#include <baum/baum.h>

int main(void)
{
  printf("baum %s, headers %s\n", baum_version(), BAUM_VERSION);
  if (strcmp(baum_version(), BAUM_VERSION) != 0) {
    return 1;
  }
  baum_mechanism *mechanism = NULL;
  if (baum_mechanism_create(&mechanism) != BAUM_OK) {
    printf("%s\n", baum_message());
    return 1;
  }
  baum_mechanism_destroy(mechanism);
  return 0;
}
