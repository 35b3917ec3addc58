/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "assert_near.h"
#include "definitions.h"
#include "derivatives.h"
#include "planar_scene.h"

/* ---- laws ---- */

static int swing(double t, double s[3], void *user)
{
  double rate = *(const double *)user;
  s[0] = sin(rate * t);
  s[1] = rate * cos(rate * t);
  s[2] = -rate * rate * sin(rate * t);
  return 0;
}

static double fast = 1.7;

/* Returns the number that `user` points to. */
static int answer(double t, double s[3], void *user)
{
  (void)t;
  (void)s;
  return *(const int *)user;
}

typedef struct three {
  double s[3];
} three;

static int copy(double t, double s[3], void *user)
{
  (void)t;
  memcpy(s, ((const three *)user)->s, sizeof(three));
  return 0;
}

/* A law that sets nothing. The test fails unless the caller has set `s` to zero. */
static int nothing(double t, double s[3], void *user)
{
  (void)t;
  (void)user;
  return s[0] != 0.0 || s[1] != 0.0 || s[2] != 0.0;
}

/* ---- scenes ---- */

static baum_joint_id pin_between(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  baum_joint_id id;
  assert_int_equal(baum_mechanism_add_planar_revolute(scene->mechanism, &def, &id), BAUM_OK);
  return id;
}

static baum_joint_id slider_between(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_translational_def def = baum_planar_translational_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  def.axis[1] = -0.4;
  baum_joint_id id;
  assert_int_equal(baum_mechanism_add_planar_translational(scene->mechanism, &def, &id), BAUM_OK);
  return id;
}

static void drive(planar_scene *scene, baum_joint_id joint, baum_law_fn *law)
{
  baum_driver_def def = baum_driver_def_default();
  def.joint = joint;
  if (!law) {
    def.value = 0.3;
    def.rate = -2.0;
    def.acceleration = 5.0;
  }
  def.law = law;
  def.user = &fast;
  assert_int_equal(baum_mechanism_add_driver(scene->mechanism, &def, NULL), BAUM_OK);
}

static void add_driven_pin(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  drive(scene, pin_between(scene, a, b), NULL);
}

static void add_driven_slider(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_joint_id slider = slider_between(scene, a, b);
  drive(scene, slider, NULL);
  drive(scene, slider, swing);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_driver(mechanism, def, NULL);
}

/* Makes a pin or a slider, and its driver "motor", which is joint 2. Opens a test point at the
 * design configuration. */
static void open_motor(test_point *p, baum_law_fn *law, void *user, bool slider)
{
  planar_scene scene = planar_scene_make();
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = slider ? slider_between(&scene, scene.link, scene.crank)
                     : pin_between(&scene, scene.link, scene.crank);
  def.law = law;
  def.user = user;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point_open(p, scene.mechanism);
}

/* ---- tests ---- */

static void derivatives_on_a_pin_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_driven_pin, false, check_joint_derivatives);
}

static void derivatives_on_a_slider_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_driven_slider, false, check_joint_derivatives);
}

static void phi_is_the_coordinate_minus_the_law(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  add_driven_pin(&scene, scene.link, scene.crank);
  test_point p;
  test_point_open(&p, scene.mechanism);
  p.t = 2.0;
  test_point_update(&p);
  double phi[3];
  double nu[3];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  assert_int_equal(baum_i_mechanism_nu(&p.point, nu), BAUM_OK);
  ASSERT_NEAR(phi[2], -1.1 - 0.4 - (0.3 - 2.0 * 2.0 + 0.5 * 5.0 * 4.0), 1e-15, 0.0);
  ASSERT_NEAR(nu[2], -2.0 + 5.0 * 2.0, 1e-15, 0.0);
  test_point_close(&p);
}

static void the_driver_is_at_the_place_of_its_joint(void **state)
{
  (void)state;
  test_point p;
  open_motor(&p, nothing, NULL, true);
  double at[3];
  double want[3];
  const baum_i_joint *slider = p.mechanism->joints[0];
  const baum_i_joint *motor = p.mechanism->joints[1];
  slider->type->place(slider, &p.point, want);
  motor->type->place(motor, &p.point, at);
  assert_memory_equal(at, want, sizeof at);
  test_point_close(&p);
}

static void a_law_that_sets_nothing_is_zero(void **state)
{
  (void)state;
  test_point p;
  open_motor(&p, nothing, NULL, false);
  double rows[3];
  assert_int_equal(baum_i_mechanism_phi(&p.point, rows), BAUM_OK);
  ASSERT_NEAR(rows[2], -1.1 - 0.4, 1e-15, 0.0);
  assert_int_equal(baum_i_mechanism_nu(&p.point, rows), BAUM_OK);
  ASSERT_NEAR(rows[2], 0.0, 0.0, 0.0);
  assert_int_equal(baum_i_mechanism_gamma(&p.point, rows), BAUM_OK);
  ASSERT_NEAR(rows[2], 0.0, 0.0, 0.0);
  test_point_close(&p);
}

/* Checks that all three functions that call the law fail with the same status and the same
 * message. */
static void check_law_fails(test_point *p, baum_status status, bool retry, const char *message)
{
  double rows[4];
  baum_status (*const functions[])(baum_i_point *, double *) = {
    baum_i_mechanism_phi, baum_i_mechanism_nu, baum_i_mechanism_gamma};
  for (int i = 0; i < 3; i++) {
    test_point_update(p);
    assert_int_equal(functions[i](&p->point, rows), status);
    assert_string_equal(baum_message(), message);
    assert_int_equal(p->point.retry, retry);
  }
}

static void a_failing_law_is_named(void **state)
{
  (void)state;
  test_point p;
  int code = -1;
  open_motor(&p, answer, &code, false);
  check_law_fails(&p, BAUM_ERR_CALLBACK, false, "joint 2 \"motor\": law() returned -1 (stop)");
  code = 3;
  check_law_fails(&p, BAUM_ERR_CALLBACK, true, "joint 2 \"motor\": law() returned 3 (retry)");
  test_point_close(&p);
}

static void a_law_that_is_not_finite_is_named(void **state)
{
  (void)state;
  test_point p;
  three s = {{TEST_NAN, 0.0, 0.0}};
  open_motor(&p, copy, &s, true);
  check_law_fails(&p, BAUM_ERR_NOT_FINITE, true,
                  "joint 2 \"motor\": law() gave nan for the value [m]");
  s = (three){{0.0, 0.0, -TEST_INFINITY}};
  check_law_fails(&p, BAUM_ERR_NOT_FINITE, true,
                  "joint 2 \"motor\": law() gave -inf for the acceleration [m/s^2]");
  test_point_close(&p);
  s = (three){{0.0, TEST_NAN, 0.0}};
  open_motor(&p, copy, &s, false);
  check_law_fails(&p, BAUM_ERR_NOT_FINITE, true,
                  "joint 2 \"motor\": law() gave nan for the rate [rad/s]");
  test_point_close(&p);
}

static void wrong_numbers_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = pin_between(&scene, scene.link, scene.crank);
  const bad_number numbers[] = {
    {offsetof(baum_driver_def, value), TEST_NAN,
     "joint 2 \"motor\": value is nan rad or m, must be finite"},
    {offsetof(baum_driver_def, rate), TEST_INFINITY,
     "joint 2 \"motor\": rate is inf rad/s or m/s, must be finite"},
    {offsetof(baum_driver_def, acceleration), -TEST_INFINITY,
     "joint 2 \"motor\": acceleration is -inf rad/s^2 or m/s^2, must be finite"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 3);
  baum_mechanism_destroy(scene.mechanism);
}

static void joints_that_cannot_be_driven_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  check_refused(scene.mechanism, add, &def, "joint 1 \"motor\": joint is none, must be given");

  baum_planar_distance_def rod = baum_planar_distance_def_default();
  PLANAR_BETWEEN(&scene, &rod, scene.link, scene.crank);
  rod.name = "rod";
  assert_int_equal(baum_mechanism_add_planar_distance(scene.mechanism, &rod, &def.joint), BAUM_OK);
  check_refused(
    scene.mechanism, add, &def,
    "joint 2 \"motor\": joint is joint 1 \"rod\", a planar distance joint, which has no "
    "coordinate to drive");

  def.joint = pin_between(&scene, scene.link, scene.ball);
  check_refused(scene.mechanism, add, &def,
                "joint 3 \"motor\": body_b is body 2 \"ball\", which has no angle");

  def.joint = pin_between(&scene, scene.link, scene.crank);
  assert_int_equal(baum_mechanism_add_driver(scene.mechanism, &def, &def.joint), BAUM_OK);
  check_refused(
    scene.mechanism, add, &def,
    "joint 5 \"motor\": joint is joint 4 \"motor\", a driver, which has no coordinate to "
    "drive");

  planar_scene other = planar_scene_make();
  def.joint = pin_between(&other, other.link, other.crank);
  check_refused(scene.mechanism, add, &def, "joint 5 \"motor\": joint is not of this mechanism");
  baum_mechanism_destroy(other.mechanism);
  baum_mechanism_destroy(scene.mechanism);
}

static void the_joint_cannot_be_replaced(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_driver_def def = baum_driver_def_default();
  def.name = "motor";
  def.joint = pin_between(&scene, scene.link, scene.crank);
  baum_joint_id motor;
  assert_int_equal(baum_mechanism_add_driver(scene.mechanism, &def, &motor), BAUM_OK);
  def.joint = pin_between(&scene, scene.link, scene.crank);
  assert_int_equal(baum_mechanism_set_driver(scene.mechanism, motor, &def), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), "joint 2 \"motor\": its joint cannot change");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_driver_def first = baum_driver_def_default();
  first.name = "motor";
  first.joint = pin_between(&scene, scene.link, scene.crank);
  baum_driver_def second = first;
  first.value = 1.0;
  first.rate = 4.0;
  first.acceleration = -2.0;
  second.name = "other";
  second.law = swing;
  second.user = &fast;
  CHECK_ROUND_TRIP(joint, driver, user, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_on_a_pin_agree_with_differences),
    cmocka_unit_test(derivatives_on_a_slider_agree_with_differences),
    cmocka_unit_test(phi_is_the_coordinate_minus_the_law),
    cmocka_unit_test(the_driver_is_at_the_place_of_its_joint),
    cmocka_unit_test(a_law_that_sets_nothing_is_zero),
    cmocka_unit_test(a_failing_law_is_named),
    cmocka_unit_test(a_law_that_is_not_finite_is_named),
    cmocka_unit_test(wrong_numbers_are_refused),
    cmocka_unit_test(joints_that_cannot_be_driven_are_refused),
    cmocka_unit_test(the_joint_cannot_be_replaced),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
