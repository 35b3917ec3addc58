/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests mechanisms with redundant rows and very different masses. Reactions must balance the
 * forces, and warnings must name the joints that share forces. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"
#include "redundant_mechanism.h"
#include "runs.h"

enum { MECHANISMS = 60, RATIOS = 15, HARD = 2 };

/* Seeds of mechanisms in which multipliers of least norm are difficult to compute. Rounding errors
 * of large forces could remain on light bodies. */
static const uint64_t HARD_SEEDS[HARD] = {7379, 9183};

static baum_simulation *run_bracket(const baum_mechanism *m)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  return create_run(m, &o);
}

/* Checks that the reaction of the joint balances the weight of the heavy body, 9.81 N, and its
 * moment about the joint. The joint is at a horizontal distance of 0.4 m from the centre of this
 * body. */
static void check_hold(const double reaction[3])
{
  assert_true(fabs(reaction[0]) <= 9.81e-9);
  assert_true(fabs(reaction[1] - 9.81) <= 9.81e-9);
  assert_true(fabs(reaction[2] - 0.4 * 9.81) <= 9.81e-9);
}

static void a_light_bracket_carries_a_heavy_body(void **state)
{
  (void)state;
  for (int k = 0; k < RATIOS; k++) {
    double q[6];
    double v[6] = {0.0};
    double lambda[8];
    double reaction[3];
    baum_channel channel = baum_channel_of(BAUM_JOINT_REACTION);
    baum_workspace *w = NULL;
    baum_mechanism *m = redundant_bracket(pow(10.0, k), &channel.joint);
    baum_simulation *run = run_bracket(m);
    check(baum_simulation_get(run, &channel, 1, reaction));
    check_hold(reaction);
    check(baum_workspace_create(m, &w));
    check(baum_workspace_design(w, q, NULL));
    check(baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, NULL, lambda));
    check(baum_workspace_reaction(w, 0.0, q, lambda, channel.joint, reaction));
    check_hold(reaction);
    baum_workspace_destroy(w);
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

static void only_joints_that_share_forces_are_named(void **state)
{
  (void)state;
  for (int k = 0; k < RATIOS; k++) {
    baum_joint_id hold;
    baum_warning warning;
    bool unique[8];
    baum_mechanism *m = redundant_bracket(pow(10.0, k), &hold);
    baum_simulation *run = run_bracket(m);
    check(baum_simulation_warning(run, 0, &warning, sizeof warning));
    assert_int_equal(warning.code, BAUM_WARNING_REDUNDANT_ROWS);
    assert_non_null(strstr(warning.text, "among \"joint1\", \"joint2\":"));
    check(baum_simulation_unique_multipliers(run, unique));
    /* The pin and the first weld share the force. The moment of this weld is unique, and so are all
     * multipliers of the second weld. */
    for (int i = 0; i < 8; i++) {
      assert_true(unique[i] == (i >= 4));
    }
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

/* The multipliers are those of least norm. For this norm, each row is scaled with the mass matrix
 * M. Two joints on the same body therefore each take half of the force, whatever the mass of the
 * body. */
static void a_pin_and_a_weld_each_carry_half_at_any_mass(void **state)
{
  (void)state;
  for (int k = 0; k < RATIOS; k++) {
    double ratio = pow(10.0, k);
    baum_joint_id hold;
    double lambda[8];
    const baum_channel channel = baum_channel_of(BAUM_LAMBDA);
    baum_mechanism *m = redundant_bracket(ratio, &hold);
    baum_simulation *run = run_bracket(m);
    check(baum_simulation_get(run, &channel, 1, lambda));
    double want = 0.5 * 9.81 * (1.0 + 1.0 / ratio);
    assert_true(fabs(fabs(lambda[1]) - want) <= 1e-9 * want);
    assert_true(fabs(fabs(lambda[3]) - want) <= 1e-9 * want);
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

static void random_redundant_mechanisms_are_in_balance(void **state)
{
  (void)state;
  redundant_tally tally = {.worst = 0.0};
  for (uint64_t k = 0; k < MECHANISMS; k++) {
    redundant_judge(k, &tally);
  }
  for (int k = 0; k < HARD; k++) {
    redundant_judge(HARD_SEEDS[k], &tally);
  }
  printf("largest imbalance %.2g\n", tally.worst);
  for (int k = 0; k < REDUNDANT_STATES; k++) { /* all results are right, and no call was refused */
    assert_int_equal(tally.workspace[k][REDUNDANT_MET], MECHANISMS + HARD);
    assert_int_equal(tally.run[k][REDUNDANT_MET], MECHANISMS + HARD);
  }
  assert_int_equal(tally.wrong_unique, 0);
}

/* A spatial body of 2 kg is welded to a planar body. The planar body cannot leave its plane, so it
 * has no velocity normal to this plane. The reaction of the weld must nevertheless contain the
 * component of the weight in this direction. */
static void planar_bodies_carry_forces_normal_to_their_plane(void **state)
{
  (void)state;
  baum_body_id planar;
  baum_body_id load;
  baum_joint_id joint;
  baum_workspace *w = NULL;
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_set_gravity(m, 0.0, 0.0, -10.0));
  baum_planar_body_def flat = baum_planar_body_def_default();
  check(baum_mechanism_add_planar_body(m, &flat, &planar));
  baum_spatial_body_def body = baum_spatial_body_def_default();
  body.mass = 2.0;
  body.position[0] = 0.5;
  check(baum_mechanism_add_spatial_body(m, &body, &load));
  baum_spatial_fixed_def weld = baum_spatial_fixed_def_default();
  weld.body_a = load;
  weld.body_b = planar;
  memset(weld.point, 0, sizeof weld.point);
  check(baum_mechanism_add_spatial_fixed(m, &weld, &joint));
  check(baum_mechanism_freeze(m));
  check(baum_workspace_create(m, &w));
  static const double want[6] = {0.0, 0.0, -20.0, 0.0, 10.0, 0.0};
  const double v[9] = {0.0};
  double q[10];
  double lambda[6];
  double reaction[6];
  check(baum_workspace_design(w, q, NULL));
  check(baum_workspace_acceleration(w, 0.0, q, v, 0.0, 0.0, NULL, lambda));
  check(baum_workspace_reaction(w, 0.0, q, lambda, joint, reaction));
  for (int i = 0; i < 6; i++) {
    assert_true(fabs(reaction[i] - want[i]) <= 1e-13 * 20.0); /* rounding */
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(planar_bodies_carry_forces_normal_to_their_plane),
    cmocka_unit_test(a_light_bracket_carries_a_heavy_body),
    cmocka_unit_test(only_joints_that_share_forces_are_named),
    cmocka_unit_test(a_pin_and_a_weld_each_carry_half_at_any_mass),
    cmocka_unit_test(random_redundant_mechanisms_are_in_balance),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
