/* SPDX-License-Identifier: BSD-3-Clause */
/* Lets every allocation fail while the omitted rows change, either during a run or because a run is
 * restored. Calls must then return BAUM_ERR_MEMORY, or succeed without the memory. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "failing_heap.h"
#include "locked_pair.h"

static unsigned char buffer[1 << 16];

/* Saves a run, continues it until the omitted rows change, and restores it. */
static baum_status simulate(void *mechanism)
{
  baum_simulation_options o = baum_simulation_options_default();
  baum_simulation *run = NULL;
  size_t size = 0;
  o.integrator = baum_rk4();
  o.step = 1e-3;
  o.energy_account = true;
  baum_status status = baum_simulation_create(mechanism, &o, &run);
  if (status >= BAUM_OK) {
    status = baum_simulation_save(run, buffer, sizeof buffer, &size);
  }
  if (status >= BAUM_OK) {
    status = baum_simulation_advance_to(run, 0.2);
  }
  if (status >= BAUM_OK) {
    status = baum_simulation_restore(run, buffer, size);
  }
  baum_simulation_destroy(run);
  return status < BAUM_OK ? status : BAUM_OK;
}

static void every_allocation_may_fail(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  baum_mechanism *m = locked_pair_make(10.0, false);
  fail_every_allocation(simulate, m);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
