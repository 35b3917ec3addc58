/* SPDX-License-Identifier: BSD-3-Clause */
/* The smallest program of a user: is the library that runs the one that was compiled against? And
 * is all of it there? A spline driver brings GSL, if there is any. */
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
  const baum_spline_driver_def empty = baum_spline_driver_def_default();
  baum_status refused = baum_mechanism_add_spline_driver(mechanism, &empty, NULL);
  baum_mechanism_destroy(mechanism);
  if (refused != (baum_has("gsl") ? BAUM_ERR_ARGUMENT : BAUM_ERR_UNSUPPORTED)) {
    printf("%s\n", baum_message());
    return 1;
  }
  return 0;
}
