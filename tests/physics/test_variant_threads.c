/* SPDX-License-Identifier: BSD-3-Clause */
/* Several threads at once make a thousand variants of one mechanism. Each variant is a copy, which
 * is changed and frozen. This test also runs under the thread sanitizer.
 *
 * The variants have different slider masses m. The crank is driven, so that accelerations do not
 * depend on m. The multipliers are a linear function of m, lambda_0 + m lambda_1.
 *
 * Only the main thread may use the checks of cmocka. The other threads return their results to
 * it.
 */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "variants.h"

enum { VARIANTS = 1000, MOST_THREADS = 8, ROWS = 9, COLUMNS = 9 };

static double mass_of(int k)
{
  return 0.05 + 1e-3 * k;
}

/* The work of one thread. It makes the variants first, first + threads, first + 2 threads, and so
 * on. */
typedef struct share {
  const variant_plan *plan;
  int first;
  int threads;
  variant_result *results; /* (VARIANTS) */
  baum_status status;      /* the first failure in this thread */
} share;

static void *make_share(void *argument)
{
  share *s = argument;
  for (int k = s->first; k < VARIANTS && s->status == BAUM_OK; k += s->threads) {
    s->status = variant_make(s->plan, mass_of(k), &s->results[k]);
  }
  return NULL;
}

/* Makes all variants and returns the wall time [s]. */
static double make_in_threads(const variant_plan *plan, int threads, variant_result *results)
{
  share shares[MOST_THREADS];
  pthread_t thread[MOST_THREADS];
  struct timespec start;
  struct timespec end;
  (void)clock_gettime(CLOCK_MONOTONIC, &start);
  for (int k = 0; k < threads; k++) {
    shares[k] = (share){.plan = plan, .first = k, .threads = threads, .results = results};
    assert_int_equal(pthread_create(&thread[k], NULL, make_share, &shares[k]), 0);
  }
  for (int k = 0; k < threads; k++) {
    assert_int_equal(pthread_join(thread[k], NULL), 0);
    assert_int_equal(shares[k].status, BAUM_OK);
  }
  (void)clock_gettime(CLOCK_MONOTONIC, &end);
  return (double)(end.tv_sec - start.tv_sec) + 1e-9 * (double)(end.tv_nsec - start.tv_nsec);
}

/* A plan, and the variants that one thread makes of it. */
typedef struct fixture {
  variant_plan plan;
  variant_result *serial;
} fixture;

static int set_up(void **state)
{
  static fixture f;
  f.serial = calloc(VARIANTS, sizeof *f.serial);
  if (!f.serial || variant_plan_make(&f.plan) != BAUM_OK) {
    return -1;
  }
  share all = {.plan = &f.plan, .threads = 1, .results = f.serial};
  (void)make_share(&all);
  *state = &f;
  return all.status == BAUM_OK ? 0 : -1;
}

static int tear_down(void **state)
{
  fixture *f = *state;
  variant_plan_clear(&f->plan);
  free(f->serial);
  return 0;
}

static double largest(const double *x, int count)
{
  double out = 0.0;
  for (int i = 0; i < count; i++) {
    out = fmax(out, fabs(x[i]));
  }
  return out;
}

/* The limits of 1e-12 allow for the rounding errors of the two solutions that are compared, in an
 * ordinary configuration. */
static void each_variant_has_its_own_mass(void **state)
{
  const fixture *f = *state;
  const variant_result *first = &f->serial[0];
  const variant_result *last = &f->serial[VARIANTS - 1];
  double a_size = largest(first->a, COLUMNS);
  double lambda_size = largest(last->lambda, ROWS);
  assert_true(a_size > 0.0);
  /* The largest mass is 20 times the smallest. The multipliers therefore differ clearly. */
  assert_true(lambda_size > 2.0 * largest(first->lambda, ROWS));
  for (int k = 0; k < VARIANTS; k++) {
    double part = (mass_of(k) - mass_of(0)) / (mass_of(VARIANTS - 1) - mass_of(0));
    for (int i = 0; i < COLUMNS; i++) {
      assert_true(fabs(f->serial[k].a[i] - first->a[i]) <= 1e-12 * a_size);
    }
    for (int i = 0; i < ROWS; i++) {
      double want = (1.0 - part) * first->lambda[i] + part * last->lambda[i];
      assert_true(fabs(f->serial[k].lambda[i] - want) <= 1e-12 * lambda_size);
    }
  }
}

static void many_threads_make_the_same_variants_as_one(void **state)
{
  const fixture *f = *state;
  static const int threads[] = {1, 2, 4, MOST_THREADS};
  variant_result *results = calloc(VARIANTS, sizeof *results);
  assert_non_null(results);
  for (size_t k = 0; k < sizeof threads / sizeof threads[0]; k++) {
    memset(results, 0, VARIANTS * sizeof *results);
    double wall = make_in_threads(&f->plan, threads[k], results);
    assert_memory_equal(results, f->serial, VARIANTS * sizeof *results);
    printf("%d variants in %d threads: %.1f us each\n", VARIANTS, threads[k],
           1e6 * wall / VARIANTS);
  }
  free(results);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(each_variant_has_its_own_mass),
    cmocka_unit_test(many_threads_make_the_same_variants_as_one),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
