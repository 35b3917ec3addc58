/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the KLU backend alone, without the checks that the solver of the whole system adds to
 * it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "assert_near.h"
#include "linear/backend.h"
#include "linear/scale.h"
#include "saddle.h"

#define PI 3.14159265358979323846

enum { MOST_UNKNOWNS = 200 };

typedef struct backend {
  void *self;
  double scale[MOST_UNKNOWNS];
} backend;

static void open_backend(backend *klu, const saddle *system)
{
  assert_true(system->structure.nv + system->structure.nc <= MOST_UNKNOWNS);
  assert_int_equal(baum_i_klu_ops.create(&system->structure, &klu->self), BAUM_OK);
}

static baum_status factor(backend *klu, const saddle *system, baum_i_kkt_effort effort)
{
  baum_i_scale_compute(&system->structure, &system->values, klu->scale);
  return baum_i_klu_ops.factor(klu->self, &system->values, klu->scale, effort);
}

static double rcond(const backend *klu)
{
  return baum_i_klu_ops.rcond(klu->self);
}

/* Solves without refinement and returns the backward error. */
static double solve(backend *klu, saddle *system)
{
  double x[MOST_UNKNOWNS];
  size_t nv = (size_t)system->structure.nv;
  size_t nc = (size_t)system->structure.nc;
  memcpy(x, system->f, nv * sizeof *x);
  memcpy(x + nv, system->r, nc * sizeof *x);
  assert_int_equal(baum_i_klu_ops.solve(klu->self, x), BAUM_OK);
  memcpy(system->a, x, nv * sizeof *x);
  memcpy(system->lambda, x + nv, nc * sizeof *x);
  return saddle_backward_error(system);
}

static void set_rotation(saddle *system, double angle)
{
  system->jacobian[0] = system->jacobian[3] = cos(angle);
  system->jacobian[1] = sin(angle);
  system->jacobian[2] = -sin(angle);
}

static void rcond_shows_that_kept_pivots_give_wrong_solutions(void **state)
{
  (void)state;
  saddle system = saddle_make_dense(2, 2);
  system.r[0] = 1.0;
  system.r[1] = 2.0;
  backend klu;
  open_backend(&klu, &system);
  set_rotation(&system, 0.0);
  assert_int_equal(factor(&klu, &system, BAUM_I_EFFORT_CHOOSE), BAUM_OK);
  assert_true(rcond(&klu) > 0.1);
  assert_true(solve(&klu, &system) < 1e-15);
  set_rotation(&system, PI / 2.0); /* the pivots that are kept, cos(angle), are now 6e-17 */
  assert_int_equal(factor(&klu, &system, BAUM_I_EFFORT_KEEP), BAUM_OK);
  assert_true(solve(&klu, &system) > 0.1);
  assert_true(rcond(&klu) < 1e-10);
  assert_int_equal(factor(&klu, &system, BAUM_I_EFFORT_CHOOSE), BAUM_OK);
  assert_true(solve(&klu, &system) < 1e-15);
  baum_i_klu_ops.destroy(klu.self);
  saddle_free(&system);
}

static void a_zero_pivot_is_singular_whether_kept_or_chosen(void **state)
{
  (void)state;
  const baum_i_kkt_effort efforts[] = {BAUM_I_EFFORT_KEEP, BAUM_I_EFFORT_CHOOSE,
                                       BAUM_I_EFFORT_CAREFUL};
  saddle system = saddle_make_dense(2, 2);
  backend klu;
  open_backend(&klu, &system);
  for (int k = 0; k < 3; k++) {
    set_rotation(&system, 0.0);
    assert_int_equal(factor(&klu, &system, BAUM_I_EFFORT_CHOOSE), BAUM_OK);
    memset(system.jacobian, 0, 4 * sizeof *system.jacobian);
    assert_int_equal(factor(&klu, &system, efforts[k]), BAUM_ERR_SINGULAR);
    assert_true(rcond(&klu) == 0.0);
  }
  baum_i_klu_ops.destroy(klu.self);
  saddle_free(&system);
}

static void careful_pivots_are_accurate_near_a_singularity(void **state)
{
  (void)state;
  /* A four-bar at a distance of 1e-9 rad from its flat configuration. With ordinary pivots, the
   * error grows as 1 / distance^2. With carefully chosen pivots, it grows as 1 / distance. */
  saddle system = saddle_make_four_bar(1);
  saddle_pose_four_bar(&system, 1e-9);
  saddle_make_consistent(&system, 1);
  for (int j = 0; j < system.structure.nv; j++) {
    system.f[j] = 1.0 + j;
  }
  double want[MOST_UNKNOWNS];
  saddle_solve(&system, want);
  backend klu;
  open_backend(&klu, &system);
  assert_int_equal(factor(&klu, &system, BAUM_I_EFFORT_CAREFUL), BAUM_OK);
  assert_true(solve(&klu, &system) < 1e-12);
  for (int j = 0; j < system.structure.nv; j++) {
    /* The limit is 1e-14 divided by the distance. Relative rounding errors are about 2e-16. */
    ASSERT_NEAR(system.a[j], want[j], 0.0, 1e-5);
  }
  baum_i_klu_ops.destroy(klu.self);
  saddle_free(&system);
}

static void kept_careful_pivots_have_the_same_rcond(void **state)
{
  (void)state;
  saddle system = saddle_make_random(8, 10);
  backend klu;
  open_backend(&klu, &system);
  assert_int_equal(factor(&klu, &system, BAUM_I_EFFORT_CAREFUL), BAUM_OK);
  double first = rcond(&klu);
  assert_int_equal(factor(&klu, &system, BAUM_I_EFFORT_KEEP), BAUM_OK);
  ASSERT_NEAR(rcond(&klu), first, 1e-12, 0.0);
  assert_true(solve(&klu, &system) < 1e-10);
  baum_i_klu_ops.destroy(klu.self);
  saddle_free(&system);
}

static void destroying_null_does_nothing(void **state)
{
  (void)state;
  baum_i_klu_ops.destroy(NULL);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(rcond_shows_that_kept_pivots_give_wrong_solutions),
    cmocka_unit_test(a_zero_pivot_is_singular_whether_kept_or_chosen),
    cmocka_unit_test(careful_pivots_are_accurate_near_a_singularity),
    cmocka_unit_test(kept_careful_pivots_have_the_same_rcond),
    cmocka_unit_test(destroying_null_does_nothing),
  };
  return cmocka_run_group_tests_name("klu", tests, NULL, NULL);
}
