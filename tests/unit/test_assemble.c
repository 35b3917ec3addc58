/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests assembly and projection. Both must satisfy the constraints, keep held bodies in place, and
 * change the other bodies as little as possible. Changes are measured with the mass matrix M. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "dynamics/dynamics.h"
#include "message.h"
#include "models.h"
#include "user_models.h"

enum { NV = 9, NC = 8 };

typedef struct scene {
  model m;
  baum_workspace *w;
  double q[NV];
  double v[NV];
} scene;

/* The slider-crank without a driver. Its design configuration is only roughly assembled. The
 * definition of its crank sets `held` and gives the angular velocity 150 rad/s. */
static scene open_scene(void)
{
  scene s;
  assert_int_equal(model_slider_crank_build((model_slider_crank){.rough = true}, &s.m), BAUM_OK);
  assert_int_equal(baum_workspace_create(s.m.mechanism, &s.w), BAUM_OK);
  assert_int_equal(baum_workspace_design(s.w, s.q, s.v), BAUM_OK);
  return s;
}

static void close_scene(scene *s)
{
  baum_workspace_destroy(s->w);
  model_destroy(&s->m);
}

/* Checks that Phi and Phi' are zero up to rounding. Lengths are about 0.5 m, and speeds about 25
 * m/s. */
static void check_consistent(const scene *s)
{
  double phi[NC];
  double nu[NC];
  double jacobian[NC * NV];
  assert_int_equal(baum_workspace_phi(s->w, 0.0, s->q, phi), BAUM_OK);
  assert_int_equal(baum_workspace_nu(s->w, 0.0, s->q, nu), BAUM_OK);
  assert_int_equal(baum_workspace_jacobian(s->w, 0.0, s->q, jacobian), BAUM_OK);
  for (int i = 0; i < NC; i++) {
    double rate = -nu[i];
    for (int j = 0; j < NV; j++) {
      rate += jacobian[i * NV + j] * s->v[j];
    }
    ASSERT_NEAR(phi[i], 0.0, 0.0, 1e-15);
    ASSERT_NEAR(rate, 0.0, 0.0, 1e-13);
  }
}

static void a_rough_design_is_assembled_and_held_bodies_stay_exactly(void **state)
{
  (void)state;
  scene s = open_scene();
  double design[3];
  memcpy(design, s.q, sizeof design);
  assert_int_equal(baum_workspace_assemble(s.w, 0.0, s.q, s.v, NULL, 0), BAUM_OK);
  check_consistent(&s);
  for (int i = 0; i < 3; i++) {
    assert_true(s.q[i] == design[i]);
  }
  assert_true(s.v[2] == 150.0);
  /* In closed form, the angle of the rod is asin(offset / rod length), and the slider is at x =
   * crank length + rod length cos(angle). */
  double angle = asin(0.05 / 0.306);
  ASSERT_NEAR(s.q[5], angle, 1e-14, 0.0);
  ASSERT_NEAR(s.q[6], 0.153 + 0.306 * cos(angle), 1e-14, 0.0);
  close_scene(&s);
}

static void velocities_that_nothing_determines_are_zero(void **state)
{
  (void)state;
  scene s = open_scene();
  for (int i = 0; i < NV; i++) {
    s.v[i] = NAN;
  }
  assert_int_equal(baum_workspace_assemble(s.w, 0.0, s.q, s.v, NULL, 0), BAUM_OK);
  for (int i = 0; i < NV; i++) {
    assert_true(s.v[i] == 0.0);
  }
  close_scene(&s);
}

static void contradictory_velocities_are_refused_and_the_joint_is_named(void **state)
{
  (void)state;
  scene s = open_scene();
  double q[NV];
  memcpy(q, s.q, sizeof q);
  s.v[0] = 3.0; /* the crank's centre cannot move along the crank */
  assert_int_equal(baum_workspace_assemble(s.w, 0.0, s.q, s.v, NULL, 0), BAUM_ERR_INCONSISTENT);
  assert_non_null(strstr(baum_message(), "velocities"));
  assert_non_null(
    strstr(baum_message(), baum_mechanism_joint_name(s.m.mechanism, s.m.joints[MODEL_PIN_GROUND])));
  assert_memory_equal(q, s.q, sizeof q);
  assert_true(s.v[0] == 3.0);
  close_scene(&s);
}

/* Velocities that a program computes for a mechanism at rest can be rounding errors. The library
 * must not refuse them as contradictory. */
static void velocities_that_are_rounding_errors_are_accepted(void **state)
{
  (void)state;
  scene s = open_scene();
  for (int i = 0; i < NV; i++) {
    s.v[i] = i % 2 == 0 ? 3e-14 : -1e-14;
  }
  assert_int_equal(baum_workspace_assemble(s.w, 0.0, s.q, s.v, NULL, 0), BAUM_OK);
  close_scene(&s);
}

static void contradictory_held_bodies_are_refused_and_nothing_changes(void **state)
{
  (void)state;
  scene s = open_scene();
  double q[NV];
  memcpy(q, s.q, sizeof q);
  assert_int_equal(baum_workspace_assemble(s.w, 0.0, s.q, s.v, s.m.bodies, 3),
                   BAUM_ERR_INCONSISTENT);
  assert_memory_equal(q, s.q, sizeof q);
  close_scene(&s);
}

static void assembly_finds_the_nearest_configuration_in_the_mass_metric(void **state)
{
  (void)state;
  /* A rod of length 1 m connects particles of 1 kg and 3 kg, which are 1.3 m apart in the design.
   * Assembly moves each particle in proportion to the mass of the other one. */
  baum_body_id ids[2];
  baum_workspace *w = NULL;
  baum_mechanism *m = create_mechanism();
  for (int k = 0; k < 2; k++) {
    baum_planar_particle_def def = baum_planar_particle_def_default();
    def.mass = k == 0 ? 1.0 : 3.0;
    def.position[0] = 1.3 * k;
    assert_int_equal(baum_mechanism_add_planar_particle(m, &def, &ids[k]), BAUM_OK);
  }
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.body_a = ids[0];
  rod.body_b = ids[1];
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  rod.length = 1.0;
  assert_int_equal(baum_mechanism_add_planar_distance(m, &rod, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  double q[4];
  double v[4];
  assert_int_equal(baum_workspace_design(w, q, v), BAUM_OK);
  assert_int_equal(baum_workspace_assemble(w, 0.0, q, v, NULL, 0), BAUM_OK);
  ASSERT_NEAR(q[0], 0.3 * 0.75, 1e-12, 0.0);
  ASSERT_NEAR(q[2], 1.3 - 0.3 * 0.25, 1e-12, 0.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

static int first_is_three(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[0] - 3.0;
  return 0;
}

/* The second coordinate has no mass and no constraint. KLU cannot determine how this coordinate
 * changes, and reports a singular system. The least-squares solver leaves the coordinate
 * unchanged. */
static void a_coordinate_without_mass_and_constraint_stays_or_is_refused(void **state)
{
  (void)state;
  static const baum_i_kkt_choice choices[] = {BAUM_I_KKT_AUTO, BAUM_I_KKT_QR, BAUM_I_KKT_KLU};
  static const double design[2] = {2.9, 0.7};
  baum_body_id body;
  baum_coordinates_def def = baum_coordinates_def_default();
  def.size = 2;
  def.q = design;
  def.mass = user_mass_of_first;
  def.force = user_no_force;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_coordinates(m, &def, &body), BAUM_OK);
  baum_user_constraint_def row = baum_user_constraint_def_default();
  row.bodies = &body;
  row.body_count = 1;
  row.row_count = 1;
  row.phi = first_is_three;
  assert_int_equal(baum_mechanism_add_user_constraint(m, &row, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  for (int k = 0; k < 3; k++) {
    baum_workspace *w = NULL;
    double q[2] = {design[0], design[1]};
    double v[2] = {0.0, 0.0};
    assert_int_equal(baum_i_workspace_create(m, choices[k], &w), BAUM_OK);
    baum_status status = baum_workspace_assemble(w, 0.5, q, v, NULL, 0);
    if (choices[k] == BAUM_I_KKT_KLU) {
      ASSERT_SAYS(status, BAUM_ERR_SINGULAR, "t = 0.5 s: assembly: the equations are singular");
    }
    ASSERT_NEAR(q[0], status == BAUM_OK ? 3.0 : design[0], 1e-14, 0.0);
    assert_true(q[1] == design[1]);
    baum_workspace_destroy(w);
  }
  baum_mechanism_destroy(m);
}

static void projection_returns_to_the_constraints_from_nearby(void **state)
{
  (void)state;
  scene s = open_scene();
  assert_int_equal(baum_workspace_assemble(s.w, 0.0, s.q, s.v, NULL, 0), BAUM_OK);
  for (int i = 0; i < NV; i++) {
    s.q[i] += 1e-3 * sin(7.0 * i + 1.0);
    s.v[i] += 0.3 * cos(5.0 * i);
  }
  assert_int_equal(baum_workspace_project(s.w, 0.0, s.q, s.v), BAUM_OK);
  check_consistent(&s);
  close_scene(&s);
}

static void projection_moves_a_consistent_state_by_rounding_only(void **state)
{
  (void)state;
  scene s = open_scene();
  double q[NV];
  double v[NV];
  assert_int_equal(baum_workspace_assemble(s.w, 0.0, s.q, s.v, NULL, 0), BAUM_OK);
  memcpy(q, s.q, sizeof q);
  memcpy(v, s.v, sizeof v);
  assert_int_equal(baum_workspace_project(s.w, 0.0, s.q, s.v), BAUM_OK);
  for (int i = 0; i < NV; i++) {
    ASSERT_NEAR(s.q[i], q[i], 0.0, 1e-14);
    ASSERT_NEAR(s.v[i], v[i], 0.0, 1e-11); /* rounding, at speeds of 150 rad/s */
  }
  close_scene(&s);
}

static void projection_changes_velocities_least_in_the_mass_metric(void **state)
{
  (void)state;
  scene s = open_scene();
  double before[NV];
  double mass[NV * NV];
  double exact[NV];
  assert_int_equal(baum_workspace_assemble(s.w, 0.0, s.q, s.v, NULL, 0), BAUM_OK);
  memcpy(exact, s.v, sizeof exact);
  for (int i = 0; i < NV; i++) {
    s.v[i] += cos(3.0 * i);
    before[i] = s.v[i];
  }
  assert_int_equal(baum_workspace_project(s.w, 0.0, s.q, s.v), BAUM_OK);
  assert_int_equal(baum_workspace_mass(s.w, 0.0, s.q, mass), BAUM_OK);
  /* The change must be M-orthogonal to every velocity v with J v = 0, such as `exact`. */
  double product = 0.0;
  double size = 0.0;
  for (int i = 0; i < NV; i++) {
    double term = (s.v[i] - before[i]) * mass[i * NV + i] * exact[i];
    product += term;
    size += fabs(term);
  }
  ASSERT_NEAR(product, 0.0, 0.0, 1e-12 * size);
  close_scene(&s);
}

static void contradicting_constraints_are_not_projected_and_the_state_stays(void **state)
{
  (void)state;
  baum_workspace *w = NULL;
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  baum_body_id body;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_particle(m, &bob, &body), BAUM_OK);
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.body_a = BAUM_GROUND;
  rod.body_b = body;
  memset(rod.point_b, 0, sizeof rod.point_b);
  /* Two rods of 1 m join one body to ground points that are 5 m apart. No position of the body
   * satisfies both constraints. */
  for (int k = 0; k < 2; k++) {
    rod.length = 1.0;
    rod.point_a[0] = 5.0 * k;
    rod.point_a[1] = 0.0;
    assert_int_equal(baum_mechanism_add_planar_distance(m, &rod, NULL), BAUM_OK);
  }
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  assert_int_equal(baum_workspace_create(m, &w), BAUM_OK);
  double q[2] = {2.0, 1.0};
  double v[2] = {1.0, 0.0};
  baum_status status = baum_workspace_project(w, 0.0, q, v);
  assert_true(status == BAUM_ERR_CONVERGENCE || status == BAUM_ERR_SINGULAR);
  assert_true(q[0] == 2.0 && q[1] == 1.0 && v[0] == 1.0 && v[1] == 0.0);
  baum_workspace_destroy(w);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_rough_design_is_assembled_and_held_bodies_stay_exactly),
    cmocka_unit_test(velocities_that_nothing_determines_are_zero),
    cmocka_unit_test(contradictory_velocities_are_refused_and_the_joint_is_named),
    cmocka_unit_test(velocities_that_are_rounding_errors_are_accepted),
    cmocka_unit_test(contradictory_held_bodies_are_refused_and_nothing_changes),
    cmocka_unit_test(assembly_finds_the_nearest_configuration_in_the_mass_metric),
    cmocka_unit_test(a_coordinate_without_mass_and_constraint_stays_or_is_refused),
    cmocka_unit_test(projection_returns_to_the_constraints_from_nearby),
    cmocka_unit_test(projection_moves_a_consistent_state_by_rounding_only),
    cmocka_unit_test(projection_changes_velocities_least_in_the_mass_metric),
    cmocka_unit_test(contradicting_constraints_are_not_projected_and_the_state_stays),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
