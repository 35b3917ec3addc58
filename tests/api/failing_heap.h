/* SPDX-License-Identifier: BSD-3-Clause */
/* Every allocation of something may fail. Include as heap.h. */
#ifndef BAUM_TEST_FAILING_HEAP_H
#define BAUM_TEST_FAILING_HEAP_H

#include <baum/status.h>

#include "heap.h"

/* Something that cleans up after itself and returns its first failure. */
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

/* First once without failure, which also lets libraries make what they keep for good. */
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

/* Every stride-th of its allocations fails alone; nothing but BAUM_ERR_MEMORY comes of it, and no
 * block is lost. */
static inline void fail_allocations(scenario *run, void *context, long stride)
{
  long allocations = count_allocations(run, context);
  for (long n = 0; n < allocations; n += stride) {
    fail_once(run, context, n, false);
  }
}

/* Likewise, alone and with all after it. */
static inline void fail_every_allocation(scenario *run, void *context)
{
  long allocations = count_allocations(run, context);
  for (long n = 0; n < allocations; n++) {
    fail_once(run, context, n, false);
    fail_once(run, context, n, true);
  }
}

#endif
