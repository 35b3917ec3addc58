/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests RATTLE, which does not support the mechanism of test_allocation.c. Its steps and outputs,
 * both in the plane and in space, must allocate no memory. If an allocation of another call fails,
 * this call must return BAUM_ERR_MEMORY, or succeed without the memory. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "heap.h"
#include "models.h"
#include "spatial_scenes.h"

enum { REDUNDANT, PLAIN, SPACE, KINDS };

static baum_status go(baum_simulation *run, double from, double to)
{
  const baum_channel channels[2] = {baum_channel_of(BAUM_Q), baum_channel_of(BAUM_A)};
  double times[9];
  double rows[9][SPATIAL_RSSR_NQ + SPATIAL_RSSR_NV];
  for (int k = 0; k < 9; k++) {
    times[k] = from + (k + 1) * (to - from) / 9.0;
  }
  return baum_simulation_sample(run, times, 9, channels, 2, rows[0], NULL);
}

static baum_status create(const baum_mechanism *mechanism, baum_solver solver,
                          baum_simulation **run)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rattle();
  o.step = 1e-4;
  o.solver = solver;
  return baum_simulation_create(mechanism, &o, run);
}

/* Makes a spatial four-bar, or a slider-crank with or without redundant rows. */
static model make(int kind)
{
  model m = {0};
  if (kind == SPACE) {
    m.mechanism = spatial_make_rssr();
    return m;
  }
  assert_int_equal(
    model_slider_crank_build((model_slider_crank){.doubled_guide = kind == REDUNDANT}, &m),
    BAUM_OK);
  return m;
}

/* In 0.04 s, the crank makes one revolution. By this time, KLU has chosen its pivots, and the block
 * solver has chosen which rows it omits. KLU checks its pivots repeatedly. */
static void steps_and_outputs_allocate_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  for (int k = 0; k < KINDS; k++) {
    model m = make(k);
    baum_simulation *run = NULL;
    assert_int_equal(create(m.mechanism, k == PLAIN ? BAUM_SOLVER_KLU : BAUM_SOLVER_AUTO, &run),
                     BAUM_OK);
    assert_true(go(run, 0.0, 0.1) >= BAUM_OK);
    heap_watch();
    assert_int_equal(go(run, 0.1, 0.3), BAUM_OK);
    assert_int_equal(baum_simulation_advance_to(run, 0.25), BAUM_OK);
    assert_int_equal(heap_stop(), 0);
    baum_simulation_destroy(run);
    model_destroy(&m);
  }
}

static baum_status simulate(const baum_mechanism *mechanism)
{
  baum_simulation *run = NULL;
  baum_status status = create(mechanism, BAUM_SOLVER_AUTO, &run);
  if (status != BAUM_OK) {
    assert_null(run);
    return status;
  }
  status = go(run, 0.0, 0.01);
  baum_simulation_destroy(run);
  return status == BAUM_WARNED ? BAUM_OK : status;
}

static void fail_every_allocation(int kind)
{
  model m = make(kind);
  assert_int_equal(simulate(m.mechanism), BAUM_OK);
  long before = heap_blocks();
  heap_watch();
  assert_int_equal(simulate(m.mechanism), BAUM_OK);
  long allocations = heap_stop();
  for (long n = 0; n < allocations; n++) {
    heap_fail(n, false);
    baum_status status = simulate(m.mechanism);
    (void)heap_stop();
    if ((status != BAUM_OK && status != BAUM_ERR_MEMORY) || heap_blocks() != before) {
      fail_msg("allocation %ld: %s: %s; %ld blocks are lost", n, baum_status_name(status),
               baum_message(), heap_blocks() - before);
    }
  }
  model_destroy(&m);
}

static void a_run_survives_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  fail_every_allocation(REDUNDANT);
  fail_every_allocation(SPACE);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(steps_and_outputs_allocate_nothing),
    cmocka_unit_test(a_run_survives_every_failing_allocation),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
