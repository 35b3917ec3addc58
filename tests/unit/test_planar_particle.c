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
  return baum_mechanism_add_planar_particle(mechanism, def, NULL);
}

static baum_planar_particle_def good(void)
{
  baum_planar_particle_def def = baum_planar_particle_def_default();
  def.name = "bob";
  def.mass = 2.5;
  def.position[0] = 3.0;
  def.position[1] = -1.0;
  return def;
}

static void mass_gravity_and_potential_are_those_of_a_point(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_particle_def def = good();
  assert_int_equal(add(mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, mechanism);
  double mass[4];
  double force[2];
  double potential;
  assert_int_equal(baum_i_mechanism_mass(&p.point, mass), BAUM_OK);
  assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  const double want[4] = {2.5, 0.0, 0.0, 2.5};
  assert_memory_equal(mass, want, sizeof mass);
  ASSERT_NEAR(force[0], 0.0, 0.0, 0.0);
  ASSERT_NEAR(force[1], 2.5 * -9.81, 1e-15, 0.0);
  ASSERT_NEAR(potential, -2.5 * 9.81, 1e-15, 0.0);
  check_potential_gradient(&p);
  test_point_close(&p);
}

static void a_second_particle_has_its_own_parameters(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_particle_def def = good();
  assert_int_equal(add(mechanism, &def), BAUM_OK);
  def.mass = 5.0;
  def.position[1] = 10.0;
  assert_int_equal(add(mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, mechanism);
  double mass[8];
  double force[4];
  double potential;
  assert_int_equal(baum_i_mechanism_mass(&p.point, mass), BAUM_OK);
  assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  ASSERT_NEAR(mass[0], 2.5, 0.0, 0.0);
  ASSERT_NEAR(mass[4], 5.0, 0.0, 0.0);
  ASSERT_NEAR(mass[7], 5.0, 0.0, 0.0);
  ASSERT_NEAR(force[3], 5.0 * -9.81, 1e-15, 0.0);
  ASSERT_NEAR(potential, 9.81 * (2.5 * -1.0 + 5.0 * 10.0), 1e-15, 0.0);
  test_point_close(&p);
}

static void the_definition_sets_the_design_state(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_particle_def def = good();
  def.velocity[0] = 4.0;
  def.held = true;
  assert_int_equal(add(mechanism, &def), BAUM_OK);
  assert_int_equal(baum_mechanism_set_characteristic_length(mechanism, 8.0), BAUM_OK);
  test_point p;
  test_point_open(&p, mechanism);
  ASSERT_NEAR(mechanism->design_q[0], 3.0, 0.0, 0.0);
  ASSERT_NEAR(mechanism->design_q[1], -1.0, 0.0, 0.0);
  ASSERT_NEAR(mechanism->design_v[0], 4.0, 0.0, 0.0);
  assert_true(isnan(mechanism->design_v[1]));
  assert_true(mechanism->held[0] && mechanism->held[1]);
  ASSERT_NEAR(mechanism->scale[0], 8.0, 0.0, 0.0);
  ASSERT_NEAR(mechanism->scale[1], 8.0, 0.0, 0.0);
  assert_true(mechanism->constant_mass);
  test_point_close(&p);
}

static void wrong_numbers_are_refused(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_particle_def def = good();
  const bad_number numbers[] = {
    {offsetof(baum_planar_particle_def, mass), 0.0,
     "body 1 \"bob\": mass is 0 kg, must be finite and > 0"},
    {offsetof(baum_planar_particle_def, mass), TEST_INFINITY,
     "body 1 \"bob\": mass is inf kg, must be finite and > 0"},
    {offsetof(baum_planar_particle_def, position[0]), TEST_NAN,
     "body 1 \"bob\": position[0] is nan m, must be finite"},
    {offsetof(baum_planar_particle_def, position[1]), TEST_INFINITY,
     "body 1 \"bob\": position[1] is inf m, must be finite"},
    {offsetof(baum_planar_particle_def, velocity[0]), TEST_INFINITY,
     "body 1 \"bob\": velocity[0] is inf m/s, must be finite, or NaN if free"},
    {offsetof(baum_planar_particle_def, velocity[1]), -TEST_INFINITY,
     "body 1 \"bob\": velocity[1] is -inf m/s, must be finite, or NaN if free"},
  };
  check_bad_numbers(mechanism, add, &def, sizeof def, numbers, 6);
  baum_mechanism_destroy(mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_particle_def first = good();
  baum_planar_particle_def second = first;
  second.name = "other";
  second.mass = 11.0;
  second.velocity[0] = 0.5;
  second.held = true;
  CHECK_ROUND_TRIP(body, planar_particle, held, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(mass_gravity_and_potential_are_those_of_a_point),
    cmocka_unit_test(a_second_particle_has_its_own_parameters),
    cmocka_unit_test(the_definition_sets_the_design_state),
    cmocka_unit_test(wrong_numbers_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
