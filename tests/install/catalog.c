/* SPDX-License-Identifier: BSD-3-Clause */
/* A user's program that uses the catalogue, which is a separate library. */
#include <stdio.h>

#include <baum/baum.h>
#include <baum/catalog.h>

int main(void)
{
  const baum_catalog_choice choice = {.name = "slider_crank"};
  baum_mechanism *mechanism = NULL;
  if (baum_catalog_build(&choice, &mechanism) != BAUM_OK) {
    printf("%s\n", baum_message());
    return 1;
  }
  const int bodies = baum_mechanism_body_count(mechanism);
  baum_mechanism_destroy(mechanism);
  printf("%d mechanisms\n", (int)baum_catalog_count());
  return bodies == 3 ? 0 : 1;
}
