/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the derivatives of user constraints. The library uses the derivatives that the user gives,
 * and computes the others by differences.
 *
 * Tolerances are relative to the change of a quantity when the coordinates change by their scales.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "derivatives.h"
#include "point.h"
#include "user_models.h"

static const user_kind *const kinds[] = {&user_circle, &user_loop, &user_swing};
enum { KIND_COUNT = 3 };

/* ---- derivatives ---- */

/* Two copies of the same constraint. Some derivatives are missing in `got`. All derivatives are
 * given in `want`. */
typedef struct pair {
  user_model model;
  const user_kind *kind;
  test_point got;
  test_point want;
} pair;

static void open_pair(pair *s, const user_kind *kind, double length, double rate, int given)
{
  s->model = (user_model){length, rate};
  s->kind = kind;
  test_point_open(&s->got, user_make(kind, &s->model, given));
  test_point_open(&s->want, user_make(kind, &s->model, GIVE_ALL));
}

static void close_pair(pair *s)
{
  test_point_close(&s->got);
  test_point_close(&s->want);
}

/* Chooses a random state for both copies. Positions are at most twice as large as their scales.
 * Velocities are at most three times as large as the scale of the coordinate times the rate of the
 * model. */
static void move_pair(pair *s, uint64_t *seed)
{
  double size = s->kind->angles ? 1.0 : s->model.length;
  double t = test_uniform(seed, 0.0, 2.0);
  s->got.t = t;
  s->want.t = t;
  for (int i = 0; i < s->got.nv; i++) {
    s->got.q[i] = size * test_uniform(seed, -2.0, 2.0);
    s->got.v[i] = size * s->model.rate * test_uniform(seed, -3.0, 3.0);
  }
  memcpy(s->want.q, s->got.q, sizeof s->got.q);
  memcpy(s->want.v, s->got.v, sizeof s->got.v);
  test_point_update(&s->got);
  test_point_update(&s->want);
}

/* Returns the change of Phi when a coordinate changes by one scale. */
static double phi_size(const pair *s)
{
  double l = s->model.length;
  return s->kind == &user_circle ? l * l : s->kind == &user_loop ? 0.035 * l : l;
}

static void compare(const double *got, const double *want, int count, double allowed)
{
  for (int i = 0; i < count; i++) {
    ASSERT_NEAR(got[i], want[i], 0.0, allowed);
  }
}

/* Returns the rate [1/s] at which Phi changes, because of v or because the model depends on
 * time. */
static double rate_of(const pair *s)
{
  double rate = s->model.rate;
  for (int i = 0; i < s->got.nv; i++) {
    rate = fmax(rate, fabs(s->got.v[i]) / (s->kind->angles ? 1.0 : s->model.length));
  }
  return rate;
}

/* Compares J, nu and gamma. Tolerances of nu are proportional to the rate, and tolerances of gamma
 * are proportional to its square. */
static void check_pair(pair *s, double jacobian_tolerance, double nu_tolerance,
                       double gamma_tolerance)
{
  double got[TEST_SIZE_MAX];
  double want[TEST_SIZE_MAX];
  double size = s->kind->angles ? 1.0 : s->model.length;
  double unit = phi_size(s);
  double rate = rate_of(s);
  assert_int_equal(baum_i_mechanism_jacobian(&s->got.point, got), BAUM_OK);
  assert_int_equal(baum_i_mechanism_jacobian(&s->want.point, want), BAUM_OK);
  compare(got, want, s->got.nc * s->got.nv, jacobian_tolerance * unit / size);
  assert_int_equal(baum_i_mechanism_nu(&s->got.point, got), BAUM_OK);
  assert_int_equal(baum_i_mechanism_nu(&s->want.point, want), BAUM_OK);
  compare(got, want, s->got.nc, nu_tolerance * unit * rate);
  assert_int_equal(baum_i_mechanism_gamma(&s->got.point, got), BAUM_OK);
  assert_int_equal(baum_i_mechanism_gamma(&s->want.point, want), BAUM_OK);
  compare(got, want, s->got.nc, gamma_tolerance * unit * rate * rate);
}

/* Calls check_pair() for every kind of constraint with every length and every rate, at random
 * states. */
static void for_each_pair(int given, double jacobian_tolerance, double nu_tolerance,
                          double gamma_tolerance)
{
  const double lengths[] = {1e-6, 1.0, 1e6};
  const double rates[] = {1.0, 3.0, 200.0};
  uint64_t seed = 7;
  for (int k = 0; k < 9 * KIND_COUNT; k++) {
    pair s;
    open_pair(&s, kinds[k / 9], lengths[k / 3 % 3], rates[k % 3], given);
    for (int n = 0; n < 40; n++) {
      move_pair(&s, &seed);
      check_pair(&s, jacobian_tolerance, nu_tolerance, gamma_tolerance);
    }
    close_pair(&s);
  }
}

static void given_derivatives_are_used_as_they_are(void **state)
{
  (void)state;
  for_each_pair(GIVE_ALL, 0.0, 0.0, 0.0);
}

/* The second difference uses seven points with a step of 1/64. Its error was measured to be
 * 3e-11. */
static void gamma_from_phi_alone_is_good_to_1e_10(void **state)
{
  (void)state;
  for_each_pair(GIVE_NOTHING, 1e-11, 1e-11, 1e-10);
}

static void gamma_from_a_jacobian_and_nu_is_good_to_1e_11(void **state)
{
  (void)state;
  for_each_pair(GIVE_JACOBIAN | GIVE_NU, 0.0, 0.0, 1e-11);
}

static void scleronomic_gamma_from_a_jacobian_is_good_to_1e_11(void **state)
{
  (void)state;
  uint64_t seed = 8;
  for (int k = 0; k < 2; k++) {
    pair s;
    open_pair(&s, kinds[k], 1.0, 1.0, GIVE_JACOBIAN);
    for (int n = 0; n < 40; n++) {
      move_pair(&s, &seed);
      check_pair(&s, 0.0, 0.0, 1e-11);
    }
    close_pair(&s);
  }
}

static void given_derivatives_are_used_for_missing_ones(void **state)
{
  (void)state;
  for_each_pair(GIVE_JACOBIAN, 0.0, 1e-11, 1e-10);
  for_each_pair(GIVE_NU, 1e-11, 0.0, 1e-10);
  for_each_pair(GIVE_GAMMA, 1e-11, 1e-11, 0.0);
}

static void scleronomic_gamma_at_rest_is_exactly_zero(void **state)
{
  (void)state;
  const int given[] = {GIVE_NOTHING, GIVE_JACOBIAN, GIVE_NU};
  for (int k = 0; k < 3; k++) {
    user_model model = {1.0, 1.0};
    test_point p;
    test_point_open(&p, user_make(&user_loop, &model, given[k]));
    double gamma[2] = {(double)NAN, (double)NAN};
    assert_int_equal(baum_i_mechanism_gamma(&p.point, gamma), BAUM_OK);
    ASSERT_NEAR(gamma[0], 0.0, 0.0, 0.0);
    ASSERT_NEAR(gamma[1], 0.0, 0.0, 0.0);
    test_point_close(&p);
  }
}

/* Normally, v shows the time scale of a motion. If the mechanism is at rest, the search for the
 * step of the difference has to find the rate of 300 1/s. The search may end too early if the
 * differences of two orders agree by chance. This causes errors of up to 1e-8. */
static void a_fast_drive_is_also_differenced_at_rest(void **state)
{
  (void)state;
  uint64_t seed = 9;
  pair s;
  open_pair(&s, &user_swing, 1.0, 300.0, GIVE_NOTHING);
  for (int n = 0; n < 40; n++) {
    move_pair(&s, &seed);
    memset(s.got.v, 0, sizeof s.got.v);
    memset(s.want.v, 0, sizeof s.want.v);
    check_pair(&s, 1e-11, 1e-11, 1e-8);
  }
  close_pair(&s);
}

/* The time scales of these motions are 1e-8 s and years. In both cases v shows the time scale. */
static void slow_and_fast_motions_are_differenced_equally_well(void **state)
{
  (void)state;
  const double rates[] = {1e-8, 1e8};
  uint64_t seed = 10;
  for (int k = 0; k < 4; k++) {
    pair s;
    open_pair(&s, kinds[k / 2], 1.0, rates[k % 2], GIVE_NOTHING);
    for (int n = 0; n < 40; n++) {
      move_pair(&s, &seed);
      check_pair(&s, 1e-11, 0.0, 1e-10);
    }
    close_pair(&s);
  }
}

/* ---- second derivatives ---- */

static void blocks_from_given_derivatives_agree_with_differences(void **state)
{
  (void)state;
  uint64_t seed = 11;
  for (int k = 0; k < KIND_COUNT; k++) {
    user_model model = {1.0, 1.5};
    test_point p;
    test_point_open(&p, user_make(kinds[k], &model, GIVE_ALL));
    for (int n = 0; n < 20; n++) {
      test_point_random(&p, &seed);
      check_joint_derivatives(&p);
    }
    test_point_close(&p);
  }
}

static void check_blocks(pair *s, double tolerance)
{
  const double w[3] = {1.3, -0.4, 0.7};
  const double lambda[2] = {2.0, -3.0};
  user_blocks got;
  user_blocks want;
  baum_i_joint_blocks blocks = {got.jw_q, got.jtl_q, got.gamma_q, got.gamma_v, got.nu_q};
  assert_int_equal(baum_i_mechanism_linearize_joints(&s->got.point, w, lambda, &blocks), BAUM_OK);
  s->kind->blocks(&s->model, s->got.t, s->got.q, s->got.v, w, lambda, &want);
  int rows = s->got.nc * s->got.nv;
  compare(got.jw_q, want.jw_q, rows, tolerance);
  compare(got.jtl_q, want.jtl_q, s->got.nv * s->got.nv, tolerance);
  compare(got.gamma_v, want.gamma_v, rows, 10.0 * tolerance);
  compare(got.nu_q, want.nu_q, rows, tolerance);
  /* The tolerance is larger, because gamma_q contains third derivatives of Phi. */
  compare(got.gamma_q, want.gamma_q, rows, 100.0 * tolerance);
}

static void for_each_block(int given, double tolerance)
{
  uint64_t seed = 12;
  for (int k = 0; k < KIND_COUNT; k++) {
    pair s;
    open_pair(&s, kinds[k], 1.0, 1.0, given);
    for (int n = 0; n < 40; n++) {
      move_pair(&s, &seed);
      check_blocks(&s, tolerance);
    }
    close_pair(&s);
  }
}

static void blocks_from_phi_alone_are_good_to_1e_9(void **state)
{
  (void)state;
  for_each_block(GIVE_NOTHING, 1e-9);
}

static void blocks_from_a_jacobian_and_nu_are_good_to_1e_10(void **state)
{
  (void)state;
  for_each_block(GIVE_JACOBIAN | GIVE_NU, 1e-10);
}

static void blocks_from_all_derivatives_are_good_to_1e_11(void **state)
{
  (void)state;
  for_each_block(GIVE_ALL, 1e-11);
}

static void blocks_that_are_not_requested_are_not_written(void **state)
{
  (void)state;
  pair s;
  open_pair(&s, &user_loop, 1.0, 1.0, GIVE_NOTHING);
  uint64_t seed = 13;
  move_pair(&s, &seed);
  const double lambda[2] = {2.0, -3.0};
  double jtl_q[9];
  assert_int_equal(baum_i_mechanism_linearize_joints(&s.got.point, NULL, lambda,
                                                     &(baum_i_joint_blocks){.jtl_q = jtl_q}),
                   BAUM_OK);
  assert_int_equal(
    baum_i_mechanism_linearize_joints(&s.got.point, NULL, NULL, &(baum_i_joint_blocks){0}),
    BAUM_OK);
  close_pair(&s);
}

/* ---- size ---- */

enum { WIDE = 12 };

/* Every row is the sine of a sum of all coordinates. `user` points to the number of rows. */
static int wide_phi(double t, const double *q, double *out, void *user)
{
  int rows = *(int *)user;
  for (int i = 0; i < rows; i++) {
    double sum = 0.1 * i * t;
    for (int j = 0; j < WIDE; j++) {
      sum += q[j] / (1.0 + i + j);
    }
    out[i] = sin(sum);
  }
  return 0;
}

/* Assertions in the library check that the scratch memory is large enough. Constraints without
 * given derivatives need the most scratch memory. */
static void scratch_memory_is_enough_for_wide_and_for_tall_constraints(void **state)
{
  (void)state;
  const double q[3] = {0.1, 0.2, 0.3};
  for (int rows = 1; rows <= TEST_SIZE_MAX; rows += TEST_SIZE_MAX - 1) {
    baum_mechanism *mechanism = create_mechanism();
    baum_body_id bodies[4];
    for (int i = 0; i < 4; i++) {
      bodies[i] = user_add_coordinates(mechanism, 3, q, 1.0);
    }
    baum_user_constraint_def def = baum_user_constraint_def_default();
    def.bodies = bodies;
    def.body_count = 4;
    def.row_count = rows;
    def.phi = wide_phi;
    def.user = &rows;
    assert_int_equal(baum_mechanism_add_user_constraint(mechanism, &def, NULL), BAUM_OK);
    test_point p;
    test_point_open(&p, mechanism);
    uint64_t seed = 14;
    test_point_random(&p, &seed);
    double blocks[5][TEST_SIZE_MAX * TEST_SIZE_MAX];
    baum_i_joint_blocks all = {blocks[0], blocks[1], blocks[2], blocks[3], blocks[4]};
    assert_int_equal(baum_i_mechanism_linearize_joints(&p.point, p.v, p.v, &all), BAUM_OK);
    assert_int_equal(baum_mechanism_check_derivatives(mechanism), BAUM_OK);
    test_point_close(&p);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(given_derivatives_are_used_as_they_are),
    cmocka_unit_test(gamma_from_phi_alone_is_good_to_1e_10),
    cmocka_unit_test(gamma_from_a_jacobian_and_nu_is_good_to_1e_11),
    cmocka_unit_test(scleronomic_gamma_from_a_jacobian_is_good_to_1e_11),
    cmocka_unit_test(given_derivatives_are_used_for_missing_ones),
    cmocka_unit_test(scleronomic_gamma_at_rest_is_exactly_zero),
    cmocka_unit_test(a_fast_drive_is_also_differenced_at_rest),
    cmocka_unit_test(slow_and_fast_motions_are_differenced_equally_well),
    cmocka_unit_test(blocks_from_given_derivatives_agree_with_differences),
    cmocka_unit_test(blocks_from_phi_alone_are_good_to_1e_9),
    cmocka_unit_test(blocks_from_a_jacobian_and_nu_are_good_to_1e_10),
    cmocka_unit_test(blocks_from_all_derivatives_are_good_to_1e_11),
    cmocka_unit_test(blocks_that_are_not_requested_are_not_written),
    cmocka_unit_test(scratch_memory_is_enough_for_wide_and_for_tall_constraints),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
