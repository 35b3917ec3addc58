/* SPDX-License-Identifier: BSD-3-Clause */
/* Several threads use one mechanism and make variants of it. This test also runs under the thread
 * sanitizer.
 *
 * Only the main thread may use the assertions of cmocka. The other threads return their results to
 * the main thread.
 */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "every_element.h"
#include "step_mode.h"

enum { THREADS = 8 };

static const double END = 0.2;

/* ---- the work of a thread ---- */

/* The work of one thread, which is a run up to the time END, and the result of this run. */
typedef struct job {
  const baum_mechanism *mechanism;
  const baum_integrator *integrator;
  bool variable; /* use variable steps even if the method supports fixed steps */
  baum_status status;
  double q[EVERY_NQ];
  double v[EVERY_NV];
  double max_phi;
  const every_element *parts; /* for threads that make a variant of the mechanism */
  double mass;                /* the mass in the variant */
} job;

static baum_simulation_options options_for(const baum_integrator *integrator, bool variable)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  if (baum_integrator_has_fixed_step(integrator) && !variable) {
    o.step = 1e-3;
  } else {
    o.rtol = 1e-6;
  }
  return o;
}

static void simulate(job *j)
{
  baum_simulation_options o = options_for(j->integrator, j->variable);
  baum_simulation *run = NULL;
  baum_counters counters = {.max_phi = -1.0};
  j->status = baum_simulation_create(j->mechanism, &o, &run);
  if (j->status == BAUM_OK) {
    j->status = baum_simulation_advance_to(run, END);
    memcpy(j->q, baum_simulation_q(run), sizeof j->q);
    memcpy(j->v, baum_simulation_v(run), sizeof j->v);
    (void)baum_simulation_counters(run, &counters, sizeof counters);
    j->max_phi = counters.max_phi;
  }
  baum_simulation_destroy(run);
}

static void *run_simulate(void *argument)
{
  simulate(argument);
  return NULL;
}

/* Runs each job in its own thread and waits for all of them. */
static void in_threads(void *(*function)(void *), job jobs[THREADS])
{
  pthread_t threads[THREADS];
  for (int k = 0; k < THREADS; k++) {
    assert_int_equal(pthread_create(&threads[k], NULL, function, &jobs[k]), 0);
  }
  for (int k = 0; k < THREADS; k++) {
    assert_int_equal(pthread_join(threads[k], NULL), 0);
  }
}

/* Returns integrator number k (modulo the number of integrators) if this integrator can run the
 * mechanism in this build. Otherwise returns rk4. */
static const baum_integrator *choose_integrator(int k)
{
  int count = 0;
  while (baum_integrator_at(count) != NULL) {
    count++;
  }
  const baum_integrator *integrator = baum_integrator_at(k % count);
  bool absent = !baum_integrator_has_fixed_step(integrator) && !baum_has("sundials");
  bool suits = !absent && integrator != baum_kinematics() && every_element_suits(integrator);
  return suits ? integrator : baum_rk4();
}

static void check_same(const job *got, const job *want)
{
  assert_true(got->status >= BAUM_OK);
  assert_int_equal(got->status, want->status);
  assert_memory_equal(got->q, want->q, sizeof got->q);
  assert_memory_equal(got->v, want->v, sizeof got->v);
  assert_true(got->max_phi == want->max_phi);
}

/* ---- one mechanism ---- */

static void runs_that_share_a_mechanism_equal_runs_in_one_thread(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  static job alone[THREADS];
  static job together[THREADS];
  for (int k = 0; k < THREADS; k++) {
    alone[k] = (job){.mechanism = parts.mechanism, .integrator = choose_integrator(k)};
    together[k] = alone[k];
    simulate(&alone[k]);
  }
  in_threads(run_simulate, together);
  for (int k = 0; k < THREADS; k++) {
    check_same(&together[k], &alone[k]);
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* All threads use the same method and the same kind of step. They must not share any data. */
static void runs_of_one_method_do_not_disturb_each_other(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    static job jobs[THREADS];
    step_mode mode = step_mode_at(i);
    if (!every_element_suits(mode.integrator)) {
      continue;
    }
    for (int k = 0; k < THREADS; k++) {
      jobs[k] =
        (job){.mechanism = parts.mechanism, .integrator = mode.integrator, .variable = !mode.fixed};
    }
    job alone = jobs[0];
    simulate(&alone);
    in_threads(run_simulate, jobs);
    for (int k = 0; k < THREADS; k++) {
      check_same(&jobs[k], &alone);
    }
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* Makes a run with a copy of the mechanism and destroys the copy. Other threads do the same with
 * their copies. */
static void *share_and_destroy(void *argument)
{
  job *j = argument;
  baum_mechanism *own = (baum_mechanism *)(uintptr_t)j->mechanism;
  simulate(j);
  baum_mechanism_destroy(own);
  return NULL;
}

static void each_thread_may_destroy_its_own_mechanism(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  static job jobs[THREADS];
  for (int k = 0; k < THREADS; k++) {
    baum_mechanism *copy = NULL;
    assert_int_equal(baum_mechanism_copy(parts.mechanism, &copy), BAUM_OK);
    assert_int_equal(baum_mechanism_freeze(copy), BAUM_OK);
    jobs[k] = (job){.mechanism = copy, .integrator = baum_rk2()};
  }
  job alone = {.mechanism = parts.mechanism, .integrator = baum_rk2()};
  simulate(&alone);
  in_threads(share_and_destroy, jobs);
  for (int k = 0; k < THREADS; k++) {
    check_same(&jobs[k], &alone);
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- variants ---- */

static void vary(job *j)
{
  baum_mechanism *variant = NULL;
  baum_planar_body_def tool;
  j->status = baum_mechanism_copy(j->parts->mechanism, &variant);
  if (j->status == BAUM_OK) {
    j->status = baum_mechanism_get_planar_body(variant, j->parts->tool, &tool, sizeof tool);
  }
  if (j->status == BAUM_OK) {
    tool.mass = j->mass;
    j->status = baum_mechanism_set_planar_body(variant, j->parts->tool, &tool);
  }
  if (j->status == BAUM_OK) {
    j->status = baum_mechanism_freeze(variant);
  }
  if (j->status == BAUM_OK) {
    j->mechanism = variant;
    simulate(j);
  }
  baum_mechanism_destroy(variant);
}

static void *run_vary(void *argument)
{
  vary(argument);
  return NULL;
}

static void variants_of_one_mechanism_are_made_in_threads(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  static job alone[THREADS];
  static job together[THREADS];
  for (int k = 0; k < THREADS; k++) {
    alone[k] = (job){.parts = &parts, .mass = 0.5 + 0.1 * k, .integrator = baum_rk4()};
    together[k] = alone[k];
    vary(&alone[k]);
  }
  in_threads(run_vary, together);
  for (int k = 0; k < THREADS; k++) {
    check_same(&together[k], &alone[k]);
  }
  baum_planar_body_def tool;
  assert_int_equal(baum_mechanism_get_planar_body(parts.mechanism, parts.tool, &tool, sizeof tool),
                   BAUM_OK);
  assert_true(tool.mass == 0.7);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- messages ---- */

static void *fail_repeatedly(void *argument)
{
  job *j = argument;
  baum_planar_body_def def = baum_planar_body_def_default();
  def.mass = j->mass;
  for (int k = 0; k < 200 && j->status != BAUM_ERR_INTEGRATOR; k++) {
    char want[64];
    baum_mechanism *mechanism = NULL;
    (void)baum_mechanism_create(&mechanism);
    j->status = baum_mechanism_add_planar_body(mechanism, &def, NULL);
    baum_mechanism_destroy(mechanism);
    (void)snprintf(want, sizeof want, "mass is %g kg", j->mass);
    if (strstr(baum_message(), want) == NULL) {
      j->status = BAUM_ERR_INTEGRATOR; /* the message comes from another thread */
    }
  }
  return NULL;
}

static void each_thread_has_its_own_message(void **state)
{
  (void)state;
  static job jobs[THREADS];
  for (int k = 0; k < THREADS; k++) {
    jobs[k] = (job){.mass = -1.0 - k};
  }
  in_threads(fail_repeatedly, jobs);
  for (int k = 0; k < THREADS; k++) {
    assert_int_equal(jobs[k].status, BAUM_ERR_ARGUMENT);
  }
}

/* ---- cancelling ---- */

/* A run that never ends. It tells the main thread when it has started. */
typedef struct endless {
  baum_simulation *run;
  atomic_bool begun;
  baum_status status;
  double t;
} endless;

static int report_begin(const baum_simulation *run, double t, void *user)
{
  (void)run;
  (void)t;
  endless *e = user;
  atomic_store(&e->begun, true);
  return 0;
}

static void *run_endless(void *argument)
{
  endless *e = argument;
  e->status = baum_simulation_advance_to(e->run, 1e9);
  e->t = baum_simulation_time(e->run);
  return NULL;
}

static void check_cancel(const baum_mechanism *mechanism, const baum_integrator *integrator)
{
  endless e = {.status = BAUM_OK};
  baum_simulation_options o = options_for(integrator, false);
  o.progress = report_begin;
  o.progress_interval = 0.0;
  o.user = &e;
  atomic_init(&e.begun, false);
  assert_int_equal(baum_simulation_create(mechanism, &o, &e.run), BAUM_OK);
  pthread_t thread;
  assert_int_equal(pthread_create(&thread, NULL, run_endless, &e), 0);
  while (!atomic_load(&e.begun)) {
    (void)nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
  }
  baum_simulation_cancel(e.run);
  assert_int_equal(pthread_join(thread, NULL), 0);
  assert_int_equal(e.status, BAUM_STOP_CANCELLED);
  assert_true(e.t >= 0.0 && e.t < 1e9);
  assert_int_equal(baum_simulation_step(e.run, 1), BAUM_OK);
  assert_true(baum_simulation_time(e.run) > e.t);
  baum_simulation_destroy(e.run);
}

static void a_run_is_cancelled_from_another_thread(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  check_cancel(parts.mechanism, baum_rk4());
  if (baum_has("sundials")) {
    check_cancel(parts.mechanism, baum_cvode_bdf());
  }
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(runs_that_share_a_mechanism_equal_runs_in_one_thread),
    cmocka_unit_test(runs_of_one_method_do_not_disturb_each_other),
    cmocka_unit_test(each_thread_may_destroy_its_own_mechanism),
    cmocka_unit_test(variants_of_one_mechanism_are_made_in_threads),
    cmocka_unit_test(each_thread_has_its_own_message),
    cmocka_unit_test(a_run_is_cancelled_from_another_thread),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
