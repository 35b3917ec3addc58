/* SPDX-License-Identifier: BSD-3-Clause */
#include "runs.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "check.h"
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
  check(baum_simulation_counters(run, &counters, sizeof counters));
  return counters;
}

unsigned char *save_run(baum_simulation *run, size_t *size)
{
  size_t most = 0; /* an upper bound, because schedules differ in size */
  check(baum_simulation_save(run, NULL, 0, &most));
  unsigned char *buffer = malloc(most);
  assert_non_null(buffer);
  check(baum_simulation_save(run, buffer, most, size));
  assert_in_range(*size, 64, most);
  return buffer;
}

void check_run_refused(const baum_mechanism *mechanism, const baum_simulation_options *options,
                       baum_status want, const char *parts)
{
  baum_simulation *run = (void *)(uintptr_t)16; /* the call must replace this invalid pointer */
  ASSERT_SAYS(baum_simulation_create(mechanism, options, &run), want, parts);
  assert_null(run);
}
