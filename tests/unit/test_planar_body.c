/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "definitions.h"
#include "derivatives.h"
#include "planar_scene.h"

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_body(mechanism, def, NULL);
}

static baum_planar_body_def good(void)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = "coupler";
  def.mass = 2.5;
  def.inertia = 0.4;
  def.position[0] = 3.0;
  def.position[1] = -1.0;
  def.angle = 0.7;
  return def;
}

static void mass_gravity_and_potential_are_those_of_a_rigid_body(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_set_gravity(mechanism, 1.5, -9.0, 4.0), BAUM_OK);
  baum_planar_body_def def = good();
  assert_int_equal(add(mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, mechanism);
  double mass[9];
  double force[3];
  double potential;
  assert_int_equal(baum_i_mechanism_mass(&p.point, mass), BAUM_OK);
  assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  const double want[9] = {2.5, 0.0, 0.0, 0.0, 2.5, 0.0, 0.0, 0.0, 0.4};
  assert_memory_equal(mass, want, sizeof mass);
  ASSERT_NEAR(force[0], 2.5 * 1.5, 1e-15, 0.0);
  ASSERT_NEAR(force[1], 2.5 * -9.0, 1e-15, 0.0);
  ASSERT_NEAR(force[2], 0.0, 0.0, 0.0);
  ASSERT_NEAR(potential, -2.5 * (1.5 * 3.0 + 9.0 * 1.0), 1e-15, 0.0);
  check_potential_gradient(&p);
  test_point_close(&p);
}

static void a_second_body_has_its_own_parameters(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_body_def def = good();
  assert_int_equal(add(mechanism, &def), BAUM_OK);
  def.mass = 5.0;
  def.inertia = 0.9;
  def.position[1] = 10.0;
  assert_int_equal(add(mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, mechanism);
  double mass[18];
  double force[6];
  double potential;
  assert_int_equal(baum_i_mechanism_mass(&p.point, mass), BAUM_OK);
  assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  ASSERT_NEAR(mass[0], 2.5, 0.0, 0.0);
  ASSERT_NEAR(mass[13], 5.0, 0.0, 0.0);
  ASSERT_NEAR(mass[17], 0.9, 0.0, 0.0);
  ASSERT_NEAR(force[4], 5.0 * -9.81, 1e-15, 0.0);
  ASSERT_NEAR(potential, 9.81 * (2.5 * -1.0 + 5.0 * 10.0), 1e-15, 0.0);
  test_point_close(&p);
}

static void the_definition_sets_the_design_state(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_body_def def = good();
  assert_int_equal(add(mechanism, &def), BAUM_OK);
  def.velocity[1] = 4.0;
  def.angular_velocity = -2.0;
  def.held = true;
  assert_int_equal(add(mechanism, &def), BAUM_OK);
  assert_int_equal(baum_mechanism_set_characteristic_length(mechanism, 8.0), BAUM_OK);
  test_point p;
  test_point_open(&p, mechanism);
  const double design[3] = {3.0, -1.0, 0.7};
  const double scale[3] = {8.0, 8.0, 1.0};
  for (int i = 0; i < 3; i++) {
    ASSERT_NEAR(mechanism->design_q[3 + i], design[i], 0.0, 0.0);
    ASSERT_NEAR(mechanism->scale[3 + i], scale[i], 0.0, 0.0);
    assert_true(isnan(mechanism->design_v[i]));
    assert_false(mechanism->held[i]);
    assert_true(mechanism->held[3 + i]);
  }
  assert_true(isnan(mechanism->design_v[3]));
  ASSERT_NEAR(mechanism->design_v[4], 4.0, 0.0, 0.0);
  ASSERT_NEAR(mechanism->design_v[5], -2.0, 0.0, 0.0);
  assert_true(mechanism->constant_mass);
  test_point_close(&p);
}

/* A pin is at the centre of mass up to rounding. This tiny offset must not become the
 * characteristic length. */
static void rounding_does_not_set_the_characteristic_length(void **state)
{
  (void)state;
  double length = 0.0;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_body_def def = good();
  baum_body_id body;
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &def, &body), BAUM_OK);
  baum_planar_revolute_def pin = baum_planar_revolute_def_default();
  pin.body_a = BAUM_GROUND;
  pin.body_b = body;
  for (int i = 0; i < 2; i++) {
    pin.point_a[i] = def.position[i];
    pin.point_b[i] = i == 0 ? 0.1 + 0.2 - 0.3 : 0.0;
  }
  assert_true(pin.point_b[0] > 0.0);
  assert_int_equal(baum_mechanism_add_planar_revolute(mechanism, &pin, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(mechanism), BAUM_OK);
  assert_int_equal(baum_mechanism_get_characteristic_length(mechanism, &length), BAUM_OK);
  ASSERT_NEAR(length, hypot(3.0, 1.0), 1e-15, 0.0);
  baum_mechanism_destroy(mechanism);
}

static void wrong_numbers_are_refused(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_body_def def = good();
  const bad_number numbers[] = {
    {offsetof(baum_planar_body_def, mass), -2.0,
     "body 1 \"coupler\": mass is -2 kg, must be finite and > 0"},
    {offsetof(baum_planar_body_def, mass), 0.0,
     "body 1 \"coupler\": mass is 0 kg, must be finite and > 0"},
    {offsetof(baum_planar_body_def, mass), TEST_NAN,
     "body 1 \"coupler\": mass is nan kg, must be finite and > 0"},
    {offsetof(baum_planar_body_def, inertia), 0.0,
     "body 1 \"coupler\": inertia is 0 kg m^2, must be finite and > 0"},
    {offsetof(baum_planar_body_def, inertia), TEST_INFINITY,
     "body 1 \"coupler\": inertia is inf kg m^2, must be finite and > 0"},
    {offsetof(baum_planar_body_def, position[0]), TEST_NAN,
     "body 1 \"coupler\": position[0] is nan m, must be finite"},
    {offsetof(baum_planar_body_def, position[1]), TEST_INFINITY,
     "body 1 \"coupler\": position[1] is inf m, must be finite"},
    {offsetof(baum_planar_body_def, angle), TEST_NAN,
     "body 1 \"coupler\": angle is nan rad, must be finite"},
    {offsetof(baum_planar_body_def, velocity[0]), TEST_INFINITY,
     "body 1 \"coupler\": velocity[0] is inf m/s, must be finite, or NaN if free"},
    {offsetof(baum_planar_body_def, velocity[1]), -TEST_INFINITY,
     "body 1 \"coupler\": velocity[1] is -inf m/s, must be finite, or NaN if free"},
    {offsetof(baum_planar_body_def, angular_velocity), TEST_INFINITY,
     "body 1 \"coupler\": angular_velocity is inf rad/s, must be finite, or NaN if free"},
  };
  check_bad_numbers(mechanism, add, &def, sizeof def, numbers, 11);
  baum_mechanism_destroy(mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_body_def first = good();
  baum_planar_body_def second = first;
  second.name = "other";
  second.mass = 11.0;
  second.velocity[0] = 0.5;
  second.angular_velocity = 3.0;
  second.held = true;
  CHECK_ROUND_TRIP(body, planar_body, held, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(mass_gravity_and_potential_are_those_of_a_rigid_body),
    cmocka_unit_test(a_second_body_has_its_own_parameters),
    cmocka_unit_test(the_definition_sets_the_design_state),
    cmocka_unit_test(rounding_does_not_set_the_characteristic_length),
    cmocka_unit_test(wrong_numbers_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
