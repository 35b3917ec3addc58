/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests chord iterations. They correct q with a factorization that was made in another
 * configuration, instead of factoring again. The tests cover every solver and the calls that
 * fail. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <baum/planar.h>
#include <baum/planar_joints.h>

#include "assert_near.h"
#include "check.h"
#include "construct.h"
#include "dynamics/chord.h"
#include "message.h"

static const baum_i_kkt_choice CHOICES[] = {BAUM_I_KKT_AUTO, BAUM_I_KKT_KLU, BAUM_I_KKT_QR};

/* Makes a bob of 2 kg at (1, 0) on one or two rods of 1 m. The first rod starts at (0, 0), and the
 * second at (2, 0). */
static baum_workspace *bob_on_rods(int rods, baum_i_kkt_choice choice)
{
  baum_workspace *w = NULL;
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  bob.mass = 2.0;
  bob.position[0] = 1.0;
  rod.name = "rod";
  rod.body_a = BAUM_GROUND;
  rod.length = 1.0;
  memset(rod.point_b, 0, sizeof rod.point_b);
  baum_mechanism *m = create_mechanism();
  check(baum_mechanism_add_planar_particle(m, &bob, &rod.body_b));
  for (int k = 0; k < rods; k++) {
    rod.point_a[0] = 2.0 * k;
    rod.point_a[1] = 0.0;
    check(baum_mechanism_add_planar_distance(m, &rod, NULL));
  }
  check(baum_mechanism_freeze(m));
  check(baum_i_workspace_create(m, choice, &w));
  baum_mechanism_destroy(m);
  return w;
}

/* The change of q must be -J^T Phi. Here J = (0.6, 0.8) belongs to the configuration `from`, and
 * Phi = (|q|^2 - 1) / 2 = 0.15 belongs to q. */
static void phi_is_corrected_with_the_jacobian_of_another_configuration(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    baum_workspace *w = bob_on_rods(1, CHOICES[k]);
    const double from[2] = {0.6, 0.8};
    const double q[2] = {0.7, 0.9};
    baum_i_chord chord;
    check(baum_i_chord_begin(w, 0.0, from, &chord));
    check(baum_i_chord_change(w, &chord, 0.1, q));
    for (int i = 0; i < 2; i++) {
      ASSERT_NEAR(w->a[i], -0.15 * from[i], 1e-14, 0.0);
    }
    baum_workspace_destroy(w);
  }
}

/* The acceleration along the rod is the velocity along the rod, multiplied by minus the gain. The
 * acceleration across the rod comes from the weight alone. */
static void velocities_along_the_rod_are_held_and_others_are_free(void **state)
{
  (void)state;
  for (int k = 0; k < 3; k++) {
    baum_workspace *w = bob_on_rods(1, CHOICES[k]);
    const double q[2] = {0.6, 0.8};
    const double v[2] = {0.3, 0.5};
    check(baum_i_hold_velocities(w, 0.0, q, v, NULL, 10.0));
    ASSERT_NEAR(0.6 * w->a[0] + 0.8 * w->a[1], -10.0 * (0.6 * 0.3 + 0.8 * 0.5), 1e-14, 0.0);
    ASSERT_NEAR(-0.8 * w->a[0] + 0.6 * w->a[1], -0.6 * 9.81, 1e-14, 0.0);
    baum_workspace_destroy(w);
  }
}

/* If both rods are in line, constraint forces cannot move the bob across their line. A position
 * beside the line can therefore not be corrected. */
static void rods_in_line_are_singular(void **state)
{
  (void)state;
  const double in_line[2] = {1.0, 0.0};
  const double beside[2] = {1.1, 0.3};
  for (int k = 0; k < 3; k++) {
    baum_workspace *w = bob_on_rods(2, CHOICES[k]);
    baum_i_chord chord;
    baum_status status = baum_i_chord_begin(w, 0.25, in_line, &chord);
    if (CHOICES[k] != BAUM_I_KKT_KLU) { /* only KLU already fails here */
      check(status);
      status = baum_i_chord_change(w, &chord, 0.25, beside);
    }
    ASSERT_SAYS(status, BAUM_ERR_SINGULAR,
                "t = 0.25 s: the constraints are singular in this configuration");
    baum_workspace_destroy(w);
  }
}

static void overflow_is_reported_with_its_joint(void **state)
{
  (void)state;
  const double from[2] = {1.0, 0.0};
  const double far_off[2] = {1e200, 0.0};
  for (int k = 0; k < 3; k++) {
    baum_workspace *w = bob_on_rods(1, CHOICES[k]);
    baum_i_chord chord;
    check(baum_i_chord_begin(w, 0.25, from, &chord));
    ASSERT_SAYS(baum_i_chord_change(w, &chord, 0.25, far_off), BAUM_ERR_NOT_FINITE,
                "t = 0.25 s: the right-hand side of the constraints of joint 1 \"rod\" is -inf");
    baum_workspace_destroy(w);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(phi_is_corrected_with_the_jacobian_of_another_configuration),
    cmocka_unit_test(velocities_along_the_rod_are_held_and_others_are_free),
    cmocka_unit_test(rods_in_line_are_singular),
    cmocka_unit_test(overflow_is_reported_with_its_joint),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
