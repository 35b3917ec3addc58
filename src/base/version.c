/* SPDX-License-Identifier: BSD-3-Clause */
/* Version and optional features of the library. */
#include <baum/version.h>

#include <string.h>

const char *baum_version(void)
{
  return BAUM_VERSION;
}

bool baum_has(const char *feature)
{
  if (!feature) {
    return false;
  }
  return BAUM_HAVE_SUNDIALS && strcmp(feature, "sundials") == 0;
}
