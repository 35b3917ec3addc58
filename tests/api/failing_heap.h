/* SPDX-License-Identifier: BSD-3-Clause */
/* Lets allocations of a scenario fail, and checks that the scenario reports this and loses no
 * memory. The rules for including heap.h also apply to this file. */
#ifndef BAUM_TEST_FAILING_HEAP_H
#define BAUM_TEST_FAILING_HEAP_H

#include <baum/status.h>

#include "heap.h"

/* A function that is tested. It cleans up after itself and returns the first failure of its
 * calls. */
typedef baum_status scenario(void *context);

static inline void fail_once(scenario *run, void *context, long n, bool for_good)
{
  long before = heap_blocks();
  heap_fail(n, for_good);
  baum_status status = run(context);
  (void)heap_stop();
  if (status != BAUM_OK && status != BAUM_ERR_MEMORY) {
    fail_msg("allocation %ld%s: %s: %s", n, for_good ? " and all after it" : "",
             baum_status_name(status), baum_message());
  }
  if (heap_blocks() != before) {
    fail_msg("allocation %ld%s: %ld blocks are lost", n, for_good ? " and all after it" : "",
             heap_blocks() - before);
  }
}

/* Runs the scenario once before counting, because libraries that are used for the first time
 * allocate memory that they never free. */
static inline long count_allocations(scenario *run, void *context)
{
  assert_int_equal(run(context), BAUM_OK);
  long before = heap_blocks();
  heap_watch();
  assert_int_equal(run(context), BAUM_OK);
  long allocations = heap_stop();
  assert_int_equal(heap_blocks(), before);
  return allocations;
}

/* Lets single allocations fail, one in each run of the scenario. To save time, only the allocations
 * with the numbers 0, stride, 2 stride and so on are tested. The scenario has to return BAUM_OK or
 * BAUM_ERR_MEMORY, and it must not lose memory. */
static inline void fail_allocations(scenario *run, void *context, long stride)
{
  long allocations = count_allocations(run, context);
  for (long n = 0; n < allocations; n += stride) {
    fail_once(run, context, n, false);
  }
}

/* Lets each allocation fail in turn: first only this one, and then this one together with all later
 * ones. */
static inline void fail_every_allocation(scenario *run, void *context)
{
  long allocations = count_allocations(run, context);
  for (long n = 0; n < allocations; n++) {
    fail_once(run, context, n, false);
    fail_once(run, context, n, true);
  }
}

#endif
