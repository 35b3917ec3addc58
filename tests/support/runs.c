/* SPDX-License-Identifier: BSD-3-Clause */
#include "runs.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

baum_simulation *create_run(const baum_mechanism *mechanism,
                            const baum_simulation_options *options)
{
  baum_simulation *run = NULL;
  if (baum_simulation_create(mechanism, options, &run) != BAUM_OK) {
    fail_msg("%s: %s", baum_integrator_name(options->integrator), baum_message());
  }
  return run;
}

baum_counters counters_of(baum_simulation *run)
{
  baum_counters counters;
  if (baum_simulation_counters(run, &counters, sizeof counters) != BAUM_OK) {
    fail_msg("%s", baum_message());
  }
  return counters;
}
