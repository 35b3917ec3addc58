/* SPDX-License-Identifier: BSD-3-Clause */
/* The driver along a spline in a build without GSL: it has its defaults, and is refused. */
#include <baum/spline.h>

#if !BAUM_HAVE_GSL

#include "base/message.h"
#include "mechanism/definition.h"

static const baum_spline_driver_def defaults = {.struct_size = sizeof(baum_spline_driver_def)};

static baum_status check(const baum_mechanism *mechanism, const void *def, const char *label)
{
  (void)mechanism;
  (void)def;
  return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                     "%s: a spline driver needs GSL, which this build does not have", label);
}

static const baum_i_joint_type type = {
  .definition = {.kind = "spline driver",
                 .size = sizeof(baum_spline_driver_def),
                 .defaults = &defaults,
                 .check = check},
};

BAUM_I_DEFINE(joint, spline_driver, type)

#endif
