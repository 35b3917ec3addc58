/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "definitions.h"
#include "derivatives.h"
#include "planar_scene.h"

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_load(mechanism, def, NULL);
}

static baum_planar_load_def good(const planar_scene *scene)
{
  baum_planar_load_def def = baum_planar_load_def_default();
  def.name = "push";
  def.body = scene->crank;
  def.point[0] = 0.4;
  def.point[1] = -0.7;
  def.force[0] = 3.0;
  def.force[1] = 5.0;
  return def;
}

/* Adds the load twice. Checks its derivatives and, if it is conservative, its potential at 20
 * random states. */
static void check_at_random(const planar_scene *scene, const baum_planar_load_def *def,
                            bool conservative)
{
  assert_int_equal(add(scene->mechanism, def), BAUM_OK);
  assert_int_equal(add(scene->mechanism, def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene->mechanism);
  uint64_t seed = 3;
  for (int k = 0; k < 20; k++) {
    test_point_random(&p, &seed);
    check_force_derivatives(&p);
    if (conservative) {
      check_potential_gradient(&p);
    }
  }
  test_point_close(&p);
}

static void derivatives_in_ground_axes_agree_with_differences(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_load_def def = good(&scene);
  check_at_random(&scene, &def, true);
}

static void derivatives_with_a_torque_agree_with_differences(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_load_def def = good(&scene);
  def.torque = -2.0;
  check_at_random(&scene, &def, false);
}

static void derivatives_following_the_body_agree_with_differences(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_load_def def = good(&scene);
  def.torque = 1.5;
  def.follows_body = true;
  check_at_random(&scene, &def, false);
}

static void derivatives_on_a_particle_agree_with_differences(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_load_def def = good(&scene);
  def.body = scene.ball;
  def.point[0] = 0.0;
  def.point[1] = 0.0;
  check_at_random(&scene, &def, true);
}

static void derivatives_with_an_input_agree_with_differences(void **state)
{
  (void)state;
  for (int follows = 0; follows <= 1; follows++) {
    planar_scene scene = planar_scene_make();
    baum_planar_load_def def = good(&scene);
    assert_int_equal(baum_mechanism_add_input(scene.mechanism, "gas", -2.5, &def.input), BAUM_OK);
    def.torque = 1.5;
    def.follows_body = follows == 1;
    check_at_random(&scene, &def, false);
  }
}

/* Computes force and potential of a load on the crank, whose angle is 90 degrees. `input` is the
 * value of the load's input, or NaN if the load has no input. */
static void evaluate_with(const baum_planar_load_def *given, double input, double force[3],
                          double *potential)
{
  planar_scene scene = planar_scene_make();
  baum_planar_load_def def = *given;
  def.body = scene.crank;
  if (!isnan(input)) {
    assert_int_equal(baum_mechanism_add_input(scene.mechanism, "gas", input, &def.input), BAUM_OK);
  }
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  assert_int_equal(baum_mechanism_set_gravity(scene.mechanism, 0.0, 0.0, 0.0), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  int crank = p.mechanism->bodies[scene.crank.index1]->q;
  p.q[crank] = 10.0;
  p.q[crank + 1] = 20.0;
  p.q[crank + 2] = acos(0.0);
  test_point_update(&p);
  double all[TEST_SIZE_MAX];
  assert_int_equal(baum_i_mechanism_force(&p.point, all), BAUM_OK);
  assert_int_equal(baum_i_mechanism_potential(&p.point, potential), BAUM_OK);
  for (int i = 0; i < 3; i++) {
    force[i] = all[crank + i];
  }
  test_point_close(&p);
}

static void evaluate(const baum_planar_load_def *given, double force[3], double *potential)
{
  evaluate_with(given, TEST_NAN, force, potential);
}

static void a_load_keeps_its_direction_or_follows_its_body(void **state)
{
  (void)state;
  baum_planar_load_def def = baum_planar_load_def_default();
  def.point[0] = 1.0;
  def.point[1] = 2.0;
  def.force[0] = 3.0;
  def.force[1] = 5.0;
  double force[3];
  double potential;
  /* The crank is at (10, 20) with an angle of 90 degrees, so its point (1, 2) is at (10 - 2,
   * 20 + 1). The tolerance allows for the rounding error of the cosine. */
  evaluate(&def, force, &potential);
  ASSERT_NEAR(force[0], 3.0, 1e-14, 0.0);
  ASSERT_NEAR(force[1], 5.0, 1e-14, 0.0);
  ASSERT_NEAR(force[2], -2.0 * 5.0 - 1.0 * 3.0, 1e-14, 0.0);
  ASSERT_NEAR(potential, -(3.0 * 8.0 + 5.0 * 21.0), 1e-14, 0.0);
  def.torque = 7.0;
  evaluate(&def, force, &potential);
  ASSERT_NEAR(force[2], -13.0 + 7.0, 1e-14, 0.0);
  ASSERT_NEAR(potential, 0.0, 0.0, 0.0);
  def.follows_body = true;
  evaluate(&def, force, &potential);
  ASSERT_NEAR(force[0], -5.0, 1e-14, 0.0);
  ASSERT_NEAR(force[1], 3.0, 1e-14, 0.0);
  ASSERT_NEAR(force[2], 1.0 * 5.0 - 2.0 * 3.0 + 7.0, 1e-14, 0.0);
  ASSERT_NEAR(potential, 0.0, 0.0, 0.0);
}

static void an_input_multiplies_force_and_torque_and_removes_the_potential(void **state)
{
  (void)state;
  static const double inputs[] = {-2.5, 0.0, 1.0};
  for (int k = 0; k < 12; k++) {
    baum_planar_load_def def = baum_planar_load_def_default();
    def.point[0] = 1.0;
    def.point[1] = 2.0;
    def.force[0] = 3.0;
    def.force[1] = 5.0;
    def.torque = k % 2 == 0 ? 0.0 : 7.0;
    def.follows_body = k % 4 >= 2;
    double input = inputs[k / 4];
    double plain[3];
    double scaled[3];
    double potential;
    evaluate(&def, plain, &potential);
    assert_true((potential != 0.0) == (k % 4 == 0));
    evaluate_with(&def, input, scaled, &potential);
    assert_true(potential == 0.0);
    for (int i = 0; i < 3; i++) {
      ASSERT_NEAR(scaled[i], input * plain[i], 1e-14, 0.0); /* rounding of the products */
    }
  }
}

static void a_wrong_input_is_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  planar_scene other = planar_scene_make();
  baum_planar_load_def def = good(&scene);
  assert_int_equal(baum_mechanism_add_input(other.mechanism, "gas", 1.0, &def.input), BAUM_OK);
  check_refused(scene.mechanism, add, &def,
                "force 1 \"push\": input is not of this mechanism; the mechanism has no inputs, "
                "baum_mechanism_add_input() adds one before freezing");
  assert_int_equal(baum_mechanism_add_input(scene.mechanism, "gas", 1.0, NULL), BAUM_OK);
  check_refused(scene.mechanism, add, &def, "force 1 \"push\": input is not of this mechanism");
  def.input.index1 = 0;
  check_refused(scene.mechanism, add, &def, "force 1 \"push\": input is none, must be given");
  baum_mechanism_destroy(scene.mechanism);
  baum_mechanism_destroy(other.mechanism);
}

static void wrong_numbers_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_load_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_load_def, point[0]), TEST_NAN,
     "force 1 \"push\": point[0] is nan m, must be finite"},
    {offsetof(baum_planar_load_def, point[1]), TEST_INFINITY,
     "force 1 \"push\": point[1] is inf m, must be finite"},
    {offsetof(baum_planar_load_def, force[0]), TEST_INFINITY,
     "force 1 \"push\": force[0] is inf N, must be finite"},
    {offsetof(baum_planar_load_def, force[1]), TEST_NAN,
     "force 1 \"push\": force[1] is nan N, must be finite"},
    {offsetof(baum_planar_load_def, torque), -TEST_INFINITY,
     "force 1 \"push\": torque is -inf N m, must be finite"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 5);
  baum_mechanism_destroy(scene.mechanism);
}

static void wrong_bodies_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_load_def def = good(&scene);
  def.body = BAUM_GROUND;
  check_refused(scene.mechanism, add, &def,
                "force 1 \"push\": body is ground, which does not move");
  def.body = (baum_body_id){0};
  check_refused(scene.mechanism, add, &def, "force 1 \"push\": body is none, must be given");
  def.body = scene.ball;
  check_refused(scene.mechanism, add, &def,
                "force 1 \"push\": point is (0.4, -0.7) m, must be (0, 0) on a particle");
  def.point[0] = 0.0;
  check_refused(scene.mechanism, add, &def,
                "force 1 \"push\": point is (0, -0.7) m, must be (0, 0) on a particle");
  def.point[0] = 0.4;
  def.point[1] = 0.0;
  check_refused(scene.mechanism, add, &def,
                "force 1 \"push\": point is (0.4, 0) m, must be (0, 0) on a particle");
  def.point[0] = 0.0;
  def.torque = 3.0;
  check_refused(scene.mechanism, add, &def,
                "force 1 \"push\": torque is 3 N m, must be 0 on a particle");
  def.torque = 0.0;
  def.follows_body = true;
  check_refused(scene.mechanism, add, &def,
                "force 1 \"push\": follows_body is true, but the body is a particle and does not "
                "rotate");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_load_def first = good(&scene);
  baum_planar_load_def second = first;
  second.name = "other";
  second.point[1] = -6.0;
  second.force[0] = 2.5;
  second.torque = 9.0;
  second.follows_body = true;
  assert_int_equal(baum_mechanism_add_input(scene.mechanism, "gas", 1.0, &second.input), BAUM_OK);
  /* This compares only the fields before `input`, because padding bytes follow them. `input` is
   * compared below. */
  CHECK_ROUND_TRIP(force, planar_load, follows_body, scene.mechanism, &first, &second);
  baum_force_id load;
  baum_planar_load_def got;
  assert_int_equal(baum_mechanism_add_planar_load(scene.mechanism, &second, &load), BAUM_OK);
  assert_int_equal(baum_mechanism_get_planar_load(scene.mechanism, load, &got, sizeof got),
                   BAUM_OK);
  assert_int_equal(got.input.index1, second.input.index1);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_in_ground_axes_agree_with_differences),
    cmocka_unit_test(derivatives_with_a_torque_agree_with_differences),
    cmocka_unit_test(derivatives_following_the_body_agree_with_differences),
    cmocka_unit_test(derivatives_on_a_particle_agree_with_differences),
    cmocka_unit_test(a_load_keeps_its_direction_or_follows_its_body),
    cmocka_unit_test(derivatives_with_an_input_agree_with_differences),
    cmocka_unit_test(an_input_multiplies_force_and_torque_and_removes_the_potential),
    cmocka_unit_test(a_wrong_input_is_refused),
    cmocka_unit_test(wrong_numbers_are_refused),
    cmocka_unit_test(wrong_bodies_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
