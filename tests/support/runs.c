/* SPDX-License-Identifier: BSD-3-Clause */
#include "runs.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "message.h"

baum_simulation *create_run(const baum_mechanism *mechanism, const baum_simulation_options *options)
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

void check_run_refused(const baum_mechanism *mechanism, const baum_simulation_options *options,
                       baum_status want, const char *parts)
{
  baum_simulation *run = (void *)(uintptr_t)16; /* garbage that must not stay */
  ASSERT_SAYS(baum_simulation_create(mechanism, options, &run), want, parts);
  assert_null(run);
}
