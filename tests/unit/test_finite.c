/* SPDX-License-Identifier: BSD-3-Clause */
/* If a number overflows, the library must return an error. For forces, gamma and right-hand sides,
 * the message must name the joint or the body. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "construct.h"
#include "message.h"

/* A mechanism and its workspace. The mechanism has a rigid body "big", which the rod "rod" connects
 * to the origin, and a wheel that has no joint. */
typedef struct scene {
  baum_mechanism *mechanism;
  baum_workspace *workspace;
  double q[6];
  double v[6];
  double out[36];
} scene;

static scene open_scene(double mass, double length)
{
  scene s = {.mechanism = NULL};
  baum_planar_body_def wheel = baum_planar_body_def_default();
  baum_planar_body_def big = baum_planar_body_def_default();
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  wheel.name = "wheel";
  big.name = "big";
  big.mass = mass;
  big.position[0] = length;
  s.mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_body(s.mechanism, &wheel, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_add_planar_body(s.mechanism, &big, &rod.body_b), BAUM_OK);
  rod.name = "rod";
  rod.body_a = BAUM_GROUND;
  memset(rod.point_a, 0, sizeof rod.point_a);
  memset(rod.point_b, 0, sizeof rod.point_b);
  assert_int_equal(baum_mechanism_add_planar_distance(s.mechanism, &rod, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(s.mechanism), BAUM_OK);
  assert_int_equal(baum_workspace_create(s.mechanism, &s.workspace), BAUM_OK);
  assert_int_equal(baum_workspace_design(s.workspace, s.q, NULL), BAUM_OK);
  return s;
}

static void close_scene(scene *s)
{
  baum_workspace_destroy(s->workspace);
  baum_mechanism_destroy(s->mechanism);
}

/* The mass of the body is the largest finite number, so its weight and its kinetic energy
 * overflow. */
static void forces_and_energies_that_overflow_are_refused(void **state)
{
  (void)state;
  scene s = open_scene(DBL_MAX, 1.0);
  s.v[3] = 3.0;
  ASSERT_SAYS(baum_workspace_force(s.workspace, 0.5, s.q, s.v, s.out), BAUM_ERR_NOT_FINITE,
              "t = 0.5 s|the force of body 2 \"big\" is -inf");
  ASSERT_SAYS(baum_workspace_energy(s.workspace, 0.0, s.q, s.v, s.out, NULL), BAUM_ERR_NOT_FINITE,
              "kinetic energy is inf J");
  ASSERT_SAYS(baum_workspace_acceleration(s.workspace, 0.0, s.q, s.v, 0.0, 0.0, s.out, NULL),
              BAUM_ERR_NOT_FINITE, "the force of body 2 \"big\" is -inf");
  close_scene(&s);
}

/* The squares of the velocities overflow. */
static void gamma_that_overflows_is_refused(void **state)
{
  (void)state;
  scene s = open_scene(1.0, 1.0);
  s.v[4] = 1e200;
  ASSERT_SAYS(baum_workspace_gamma(s.workspace, 0.0, s.q, s.v, s.out), BAUM_ERR_NOT_FINITE,
              "the gamma of joint 1 \"rod\" is -inf");
  ASSERT_SAYS(baum_workspace_acceleration(s.workspace, 0.0, s.q, s.v, 0.0, 0.0, s.out, NULL),
              BAUM_ERR_NOT_FINITE,
              "the right-hand side of the constraints of joint 1 \"rod\" is -inf");
  close_scene(&s);
}

/* The arm is 1e200 m, and the inertia is 1e-300 kg m^2. Both are finite, but the size of the row,
 * arm / sqrt(inertia), overflows. */
static void rows_whose_size_overflows_are_refused(void **state)
{
  (void)state;
  baum_mobility mobility;
  baum_planar_body_def body = baum_planar_body_def_default();
  baum_body_id pinned;
  body.inertia = 1e-300;
  body.position[0] = 1e200;
  baum_mechanism *m = create_mechanism();
  assert_int_equal(baum_mechanism_add_planar_body(m, &body, &pinned), BAUM_OK);
  (void)add_planar_pin(m, NULL, BAUM_GROUND, pinned, 0.0, 0.0);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  ASSERT_SAYS(baum_mechanism_mobility(m, &mobility, sizeof mobility), BAUM_ERR_NOT_FINITE,
              "numbers in the equations of motion are too large for double precision");
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(forces_and_energies_that_overflow_are_refused),
    cmocka_unit_test(gamma_that_overflows_is_refused),
    cmocka_unit_test(rows_whose_size_overflows_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
