/* SPDX-License-Identifier: BSD-3-Clause */
/* Saving and restoring must allocate no memory. If a run factors only the matrices of the block
 * solver, its later steps must also allocate no memory. If there is not enough memory, continuing
 * from another run may fail, but then it must change nothing. */
#define _GNU_SOURCE /* needed by heap.h */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "heap.h"
#include "saved_scenes.h"

static unsigned char buffer[1 << 17];

/* Tells whether steps after restoring may have to choose pivots again. */
static bool chooses_pivots(const saved_scene *scene)
{
  const baum_simulation_options *o = &scene->options;
  bool by_blocks = o->solver == BAUM_SOLVER_AUTO || o->solver == BAUM_SOLVER_BLOCK;
  /* Explicit methods with a fixed step factor only the matrices of the block solver. All other
   * methods factor matrices of their own. */
  bool explicit = isnan(o->rtol) && baum_integrator_has_fixed_step(o->integrator) &&
                  o->integrator != baum_generalized_alpha() && o->integrator != baum_rattle();
  return !(by_blocks && explicit);
}

static void check_scene(const saved_scene *scene)
{
  size_t size = 0;
  baum_simulation *run = saved_scene_start(scene);
  assert_true(saved_reached(baum_simulation_advance_to(run, 2.5 * scene->span)));
  if (scene->law) {
    assert_int_equal(scene->law(run, scene), BAUM_OK);
  }
  heap_watch();
  for (int k = 0; k < 5; k++) {
    assert_int_equal(baum_simulation_save(run, buffer, sizeof buffer, &size), BAUM_OK);
    if (!chooses_pivots(scene)) {
      assert_true(saved_reached(baum_simulation_step(run, 3)));
    }
    assert_int_equal(baum_simulation_restore(run, buffer, size), BAUM_OK);
  }
  long allocations = heap_stop();
  if (allocations != 0) {
    fail_msg("%s: %ld allocations", scene->name, allocations);
  }
  baum_simulation_destroy(run);
}

static void saving_and_restoring_allocate_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  saved_scene scene;
  for (int number = 0; saved_scene_open(&scene, number); number++) {
    check_scene(&scene);
    saved_scene_close(&scene);
  }
}

/* ---- calls that need memory ---- */

static void schedule(baum_simulation *run, const saved_scene *scene)
{
  const double times[2] = {6e-3, 8e-3};
  const double values[2] = {0.9, 1.1};
  assert_int_equal(baum_simulation_schedule_input(run, scene->input, times, values, 2), BAUM_OK);
}

static void continuing_from_another_run_without_memory_changes_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  saved_scene scene;
  long before = heap_blocks();
  assert_true(saved_scene_open(&scene, 0));
  baum_simulation *from = saved_scene_start(&scene);
  baum_simulation *to = saved_scene_start(&scene);
  assert_true(saved_reached(baum_simulation_advance_to(from, 5e-3)));
  assert_int_equal(scene.law(from, &scene), BAUM_OK);
  schedule(from, &scene);
  baum_status status = BAUM_ERR_MEMORY;
  long failures = 0;
  for (; status == BAUM_ERR_MEMORY; failures++) {
    assert_true(baum_simulation_time(to) == 0.0);
    heap_fail(failures, false);
    status = baum_simulation_continue(to, from);
    (void)heap_stop();
  }
  assert_int_equal(status, BAUM_OK);
  /* The allocations for q, v, inputs, numbers of drivers, and schedules have failed. */
  assert_true(failures > 4);
  assert_true(baum_simulation_time(to) == baum_simulation_time(from));
  baum_simulation_destroy(from);
  baum_simulation_destroy(to);
  saved_scene_close(&scene);
  assert_int_equal(heap_blocks(), before); /* memory that a solver keeps must also be freed */
}

/* The run has no law and no schedule when it is restored. */
static void restoring_without_memory_changes_nothing(void **state)
{
  (void)state;
  if (!heap_is_ours()) {
    skip();
  }
  saved_scene scene;
  size_t size = 0;
  assert_true(saved_scene_open(&scene, 0));
  baum_simulation *from = saved_scene_start(&scene);
  baum_simulation *to = saved_scene_start(&scene);
  assert_int_equal(scene.law(from, &scene), BAUM_OK);
  schedule(from, &scene);
  assert_true(saved_reached(baum_simulation_step(from, 2)));
  assert_int_equal(baum_simulation_save(from, buffer, sizeof buffer, &size), BAUM_OK);
  for (int k = 0; k < 2; k++) {
    heap_fail(k, false);
    baum_status status = baum_simulation_restore(to, buffer, size);
    (void)heap_stop();
    assert_int_equal(status, BAUM_ERR_MEMORY);
    assert_true(baum_simulation_time(to) == 0.0);
  }
  assert_int_equal(baum_simulation_restore(to, buffer, size), BAUM_OK);
  assert_true(baum_simulation_time(to) == baum_simulation_time(from));
  baum_simulation_destroy(from);
  baum_simulation_destroy(to);
  saved_scene_close(&scene);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(saving_and_restoring_allocate_nothing),
    cmocka_unit_test(continuing_from_another_run_without_memory_changes_nothing),
    cmocka_unit_test(restoring_without_memory_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
