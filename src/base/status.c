/* SPDX-License-Identifier: BSD-3-Clause */
/* Names and texts of statuses, generated from the list of statuses in status.h. */
#include <baum/status.h>

const char *baum_status_name(baum_status status)
{
  switch (status) {
#define BAUM_X(name, value, text) \
  case name: return #name;
    BAUM_STATUS_LIST(BAUM_X)
#undef BAUM_X
  default: return "BAUM_?";
  }
}

const char *baum_status_text(baum_status status)
{
  switch (status) {
#define BAUM_X(name, value, text) \
  case name: return text;
    BAUM_STATUS_LIST(BAUM_X)
#undef BAUM_X
  default: return "no status of this library";
  }
}
