/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps and outputs of kinematics must allocate no memory. If an allocation of another call fails,
 * this call must return BAUM_ERR_MEMORY, or succeed without the memory. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "driven.h"
#include "failing_heap.h"

static baum_status go(baum_simulation *run, double from, double to)
{
  const baum_channel channels[3] = {baum_channel_of(BAUM_Q), baum_channel_of(BAUM_A),
                                    baum_channel_of(BAUM_LAMBDA)};
  double times[9];
  double rows[9][3 * PARALLELOGRAM_NV + 1]; /* lambda has PARALLELOGRAM_NV + 1 rows */
  for (int k = 0; k < 9; k++) {
    times[k] = from + (k + 1) * (to - from) / 9.0;
  }
  return baum_simulation_sample(run, times, 9, channels, 3, rows[0], NULL);
}

static baum_status create(const baum_mechanism *mechanism, baum_simulation **run)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_kinematics();
  return baum_simulation_create(mechanism, &o, run);
}

static void steps_and_outputs_allocate_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  const drive motor = {.angle = 0.4, .rate = 1.0};
  slider_crank data = {0.1, 0.1501, 0.05, 1, motor};
  baum_mechanism *mechanisms[3] = {four_bar_make(&motor), slider_crank_make(&data),
                                   parallelogram_make(&motor)};
  for (int k = 0; k < 3; k++) {
    double end = k == 2 ? 2.0 : 20.0; /* before 2.7 s, when the parallelogram becomes flat */
    baum_simulation *run = NULL;
    assert_int_equal(create(mechanisms[k], &run), BAUM_OK);
    assert_true(go(run, 0.0, 0.5 * end) >= BAUM_OK);
    heap_watch();
    assert_int_equal(go(run, 0.5 * end, end), BAUM_OK);
    assert_int_equal(baum_simulation_advance_to(run, 0.0), BAUM_OK);
    assert_int_equal(heap_stop(), 0);
    baum_simulation_destroy(run);
    baum_mechanism_destroy(mechanisms[k]);
  }
}

static baum_status simulate(void *mechanism)
{
  baum_simulation *run = NULL;
  baum_status status = create(mechanism, &run);
  if (status != BAUM_OK) {
    assert_null(run);
    return status;
  }
  status = go(run, 0.0, 1.0);
  baum_simulation_destroy(run);
  return status == BAUM_WARNED ? BAUM_OK : status;
}

static void a_run_survives_every_failing_allocation(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  const drive motor = {.angle = 0.4, .rate = 6.0};
  baum_mechanism *mechanism = parallelogram_make_of(&motor, 1.5, 0.1); /* exchanges rows */
  fail_every_allocation(simulate, mechanism);
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(steps_and_outputs_allocate_nothing),
    cmocka_unit_test(a_run_survives_every_failing_allocation),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
