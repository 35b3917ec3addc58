/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs studies that use many threads on one mechanism, and several such studies at once. Their
 * entries must be equal, to the last bit, to the entries of a study that uses one thread. This test
 * also runs under the thread sanitizer.
 *
 * Only the main thread may use the checks of cmocka. The other threads return their results to
 * it.
 */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "every_element.h"
#include "step_mode.h"
#include "study_entries.h"

enum { THREADS = 8, STUDIES = 3 };

/* What the progress function of a study counts. No call of this function may begin while another
 * call is running. */
typedef struct seen {
  atomic_int inside;
  atomic_int together; /* number of calls that began while another call was running */
  int calls;
  int cancel_at; /* number of the call that cancels the study; 0 if none does */
} seen;

static int look(const baum_study *study, int32_t done, int32_t total, void *user)
{
  seen *s = user;
  (void)study;
  (void)done;
  (void)total;
  s->together += atomic_fetch_add(&s->inside, 1) != 0;
  s->calls++;
  atomic_fetch_sub(&s->inside, 1);
  return s->calls == s->cancel_at;
}

/* Makes a study that has two entries for every integrator with a fixed step, and two with a
 * variable step. */
static baum_study *make(const baum_mechanism *m, int threads, seen *s)
{
  baum_study *study = NULL;
  baum_study_options o = small_study_options();
  o.threads = threads;
  o.samples = 4;
  o.validate = false;
  o.progress = look;
  o.user = s;
  check(baum_study_create(m, 0.0, 0.02, &study));
  check(baum_study_set_options(study, &o));
  for (int i = 0; step_mode_at(i).integrator; i++) {
    for (int k = 1; k <= 2; k++) {
      const baum_simulation_options run = step_mode_options(step_mode_at(i), 2e-3 * k, 1e-4 * k);
      check(baum_study_add(study, &run));
    }
  }
  return study;
}

/* ---- one study ---- */

static void many_threads_give_the_same_entries_as_one(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  seen alone = {.calls = 0};
  seen many = {.calls = 0};
  baum_study *want = make(parts.mechanism, 1, &alone);
  baum_study *got = make(parts.mechanism, THREADS, &many);
  check(baum_study_run(want));
  check(baum_study_run(got));
  assert_same_entries(got, want);
  assert_int_equal(many.together, 0);
  assert_int_equal(many.calls, alone.calls);
  baum_study_destroy(got);
  baum_study_destroy(want);
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- several studies at once ---- */

typedef struct job {
  baum_study *study;
  seen seen;
  baum_status status;
  atomic_bool ended;
} job;

static void *run(void *user)
{
  job *j = user;
  j->status = baum_study_run(j->study);
  atomic_store(&j->ended, true);
  return NULL;
}

static void studies_of_one_mechanism_do_not_disturb_each_other(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  job jobs[STUDIES];
  pthread_t threads[STUDIES];
  memset(jobs, 0, sizeof jobs);
  for (int k = 0; k < STUDIES; k++) {
    jobs[k].study = make(parts.mechanism, k + 1, &jobs[k].seen);
  }
  for (int k = 0; k < STUDIES; k++) {
    assert_int_equal(pthread_create(&threads[k], NULL, run, &jobs[k]), 0);
  }
  for (int k = 0; k < STUDIES; k++) {
    assert_int_equal(pthread_join(threads[k], NULL), 0);
    check(jobs[k].status);
    assert_int_equal(jobs[k].seen.together, 0);
  }
  for (int k = 1; k < STUDIES; k++) {
    assert_same_entries(jobs[k].study, jobs[0].study);
  }
  for (int k = 0; k < STUDIES; k++) {
    baum_study_destroy(jobs[k].study);
  }
  baum_mechanism_destroy(parts.mechanism);
}

/* ---- cancelling ---- */

/* Another thread cancels the study several times while it runs. Afterwards, the study is run to its
 * end. */
static void a_study_of_many_threads_can_be_cancelled_from_another_thread(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  seen alone = {.calls = 0};
  baum_study *want = make(parts.mechanism, 1, &alone);
  check(baum_study_run(want));
  job j;
  pthread_t thread;
  memset(&j, 0, sizeof j);
  j.study = make(parts.mechanism, THREADS, &j.seen);
  assert_int_equal(pthread_create(&thread, NULL, run, &j), 0);
  while (!atomic_load(&j.ended)) {
    baum_study_cancel(j.study);
  }
  assert_int_equal(pthread_join(thread, NULL), 0);
  check(j.status);
  for (int k = 1; k <= 3; k++) { /* the progress function cancels in its call 3, 6 or 9 */
    j.seen.calls = 0;
    j.seen.cancel_at = 3 * k;
    check(baum_study_run(j.study));
  }
  j.seen.cancel_at = 0;
  check(baum_study_run(j.study));
  assert_same_entries(j.study, want);
  baum_study_destroy(j.study);
  baum_study_destroy(want);
  baum_mechanism_destroy(parts.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(many_threads_give_the_same_entries_as_one),
    cmocka_unit_test(studies_of_one_mechanism_do_not_disturb_each_other),
    cmocka_unit_test(a_study_of_many_threads_can_be_cancelled_from_another_thread),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
