/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "assert_near.h"
#include "balance.h"
#include "definitions.h"
#include "derivatives.h"
#include "planar_scene.h"
#include "user_check.h"

/* ---- laws ---- */

static int cam(double x, double f[3], void *user)
{
  (void)user;
  f[0] = 0.3 * x + 0.2 * sin(1.3 * x);
  f[1] = 0.3 + 0.26 * cos(1.3 * x);
  f[2] = -0.338 * sin(1.3 * x);
  return 0;
}

/* What is wrong with a law: an error that is added to one entry, or a return value other than 0. */
typedef struct fault {
  int entry;
  double error;
  int answer;
} fault;

static int faulty(double x, double f[3], void *user)
{
  const fault *wrong = user;
  (void)cam(x, f, NULL);
  f[wrong->entry] += wrong->error;
  return wrong->answer;
}

/* A law that sets nothing. The test fails unless the caller has set `f` to zero. */
static int nothing(double x, double f[3], void *user)
{
  (void)x;
  (void)user;
  return f[0] != 0.0 || f[1] != 0.0 || f[2] != 0.0;
}

/* ---- scenes ---- */

static baum_joint_id add_pin(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_revolute_def def = baum_planar_revolute_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  def.name = "pin";
  baum_joint_id id;
  assert_int_equal(baum_mechanism_add_planar_revolute(scene->mechanism, &def, &id), BAUM_OK);
  return id;
}

static baum_joint_id add_slot(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_pin_in_slot_def def = baum_planar_pin_in_slot_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  def.name = "slot";
  def.axis[1] = -0.4;
  baum_joint_id id;
  assert_int_equal(baum_mechanism_add_planar_pin_in_slot(scene->mechanism, &def, &id), BAUM_OK);
  return id;
}

static void couple(planar_scene *scene, baum_joint_id a, baum_joint_id b, baum_coupling_fn *law)
{
  baum_coupling_def def = baum_coupling_def_default();
  def.joint_a = a;
  def.joint_b = b;
  if (!law) {
    def.ratio = -1.7;
    def.offset = 0.3;
  }
  def.law = law;
  assert_int_equal(baum_mechanism_add_coupling(scene->mechanism, &def, NULL), BAUM_OK);
}

/* Couples two joints between the same two bodies. */
static void add_on_same_bodies(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_joint_id pin = add_pin(scene, a, b);
  baum_joint_id slot = add_slot(scene, b, a);
  couple(scene, pin, slot, NULL);
  couple(scene, pin, slot, cam);
  couple(scene, slot, pin, cam);
}

static baum_body_id add_arm(planar_scene *scene)
{
  baum_planar_body_def def = baum_planar_body_def_default();
  def.name = "arm";
  def.angle = 0.2;
  baum_body_id id;
  assert_int_equal(baum_mechanism_add_planar_body(scene->mechanism, &def, &id), BAUM_OK);
  return id;
}

/* Couples two joints that have no body in common. One of the bodies is a particle. */
static void add_on_other_bodies(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_joint_id pin = add_pin(scene, a, b);
  baum_joint_id slot = add_slot(scene, add_arm(scene), scene->bead);
  couple(scene, pin, slot, cam);
  couple(scene, slot, pin, NULL);
}

/* Couples two joints that share one body. This body is body_b of the pin and body_a of the slot. */
static void add_on_a_chain(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_joint_id pin = add_pin(scene, a, b);
  baum_joint_id slot = add_slot(scene, b, scene->ball);
  couple(scene, slot, pin, cam);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_coupling(mechanism, def, NULL);
}

/* Adds a pin as joint 1 and a slot as joint 2, both between link and crank. Returns a definition
 * that couples these two joints. */
static baum_coupling_def good(planar_scene *scene)
{
  baum_coupling_def def = baum_coupling_def_default();
  def.name = "C";
  def.joint_a = add_pin(scene, scene->link, scene->crank);
  def.joint_b = add_slot(scene, scene->link, scene->crank);
  return def;
}

static baum_mechanism *make_with(baum_coupling_fn *law, void *user)
{
  planar_scene scene = planar_scene_make();
  baum_coupling_def def = good(&scene);
  def.law = law;
  def.user = user;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  return scene.mechanism;
}

/* ---- tests ---- */

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_on_same_bodies, false, check_joint_derivatives);
  for_each_planar_pair(add_on_other_bodies, false, check_joint_derivatives);
  for_each_planar_pair(add_on_a_chain, false, check_joint_derivatives);
}

static void reactions_balance(void **state)
{
  (void)state;
  for_each_planar_pair(add_on_same_bodies, false, check_rows_balance);
  for_each_planar_pair(add_on_other_bodies, false, check_rows_balance);
  for_each_planar_pair(add_on_a_chain, false, check_rows_balance);
}

/* Checks that no column of J occurs twice in the rows of a joint. The sparse matrices rely on
 * this. */
static void check_columns(test_point *p)
{
  for (int k = 0; k < p->mechanism->joint_count; k++) {
    const baum_i_span *span = &p->mechanism->joints[k]->span;
    for (int i = 0; i < span->nl; i++) {
      for (int j = 0; j < i; j++) {
        assert_int_not_equal(span->columns[i], span->columns[j]);
      }
    }
  }
}

static void no_column_occurs_twice(void **state)
{
  (void)state;
  for_each_planar_pair(add_on_same_bodies, false, check_columns);
  for_each_planar_pair(add_on_other_bodies, false, check_columns);
  for_each_planar_pair(add_on_a_chain, false, check_columns);
}

static double coordinate_of(const test_point *p, int joint)
{
  const baum_i_joint *j = p->mechanism->joints[joint];
  baum_i_coordinate c;
  j->type->coordinate(j, 0, &p->point, &c);
  return c.value;
}

static void phi_is_coordinate_b_minus_the_law_of_coordinate_a(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_coupling_def def = good(&scene);
  couple(&scene, def.joint_a, def.joint_b, NULL);
  couple(&scene, def.joint_a, def.joint_b, cam);
  test_point p;
  test_point_open(&p, scene.mechanism);
  uint64_t seed = 3;
  double phi[5];
  double f[3];
  test_point_random(&p, &seed);
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  double a = coordinate_of(&p, 0);
  double b = coordinate_of(&p, 1);
  (void)cam(a, f, NULL);
  ASSERT_NEAR(phi[3], b - (-1.7 * a + 0.3), 1e-15, 0.0);
  ASSERT_NEAR(phi[4], b - f[0], 1e-15, 0.0);
  test_point_close(&p);
}

static void the_offset_follows_from_the_design_unless_given(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_coupling_def def = good(&scene);
  def.ratio = 2.5;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double phi[4];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  ASSERT_NEAR(phi[3], 0.0, 0.0, 1e-15);
  assert_true(fabs(coordinate_of(&p, 1) - 2.5 * coordinate_of(&p, 0)) > 0.1);
  test_point_close(&p);
}

static void a_failing_law_is_named(void **state)
{
  (void)state;
  test_point p;
  fault f = {.answer = -2};
  test_point_open(&p, make_with(faulty, &f));
  user_check_fails(&p, BAUM_ERR_CALLBACK, false, "joint 3 \"C\": law() returned -2 (stop)");
  f.answer = 4;
  user_check_fails(&p, BAUM_ERR_CALLBACK, true, "joint 3 \"C\": law() returned 4 (retry)");
  f = (fault){.entry = 2, .error = TEST_NAN};
  user_check_fails(&p, BAUM_ERR_NOT_FINITE, true, "joint 3 \"C\": law()[2] is nan at t = 0 s");
  test_point_close(&p);
}

static void a_law_that_sets_nothing_is_zero(void **state)
{
  (void)state;
  test_point p;
  test_point_open(&p, make_with(nothing, NULL));
  double phi[4];
  assert_int_equal(baum_i_mechanism_phi(&p.point, phi), BAUM_OK);
  ASSERT_NEAR(phi[3], coordinate_of(&p, 1), 0.0, 0.0);
  test_point_close(&p);
}

static void right_derivatives_raise_no_alarm(void **state)
{
  (void)state;
  user_check_right(make_with(cam, NULL));
  user_check_right(make_with(nothing, NULL));
  user_check_right(make_with(NULL, NULL));
}

static void wrong_derivatives_are_named(void **state)
{
  (void)state;
  for (int entry = 1; entry < 3; entry++) {
    fault f = {.entry = entry, .error = 1e-4};
    user_check_wrong_entry(make_with(faulty, &f), "joint 3 \"C\": law", entry);
  }
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_coupling_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_coupling_def, ratio), TEST_NAN,
     "joint 3 \"C\": ratio is nan [unit b / unit a], must be finite"},
    {offsetof(baum_coupling_def, offset), TEST_INFINITY,
     "joint 3 \"C\": offset is inf rad or m, must be finite, or NaN if not given"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 2);
  baum_mechanism_destroy(scene.mechanism);
}

static void joints_that_cannot_be_coupled_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_coupling_def def = good(&scene);
  baum_joint_id pin = def.joint_a;
  def.joint_a = def.joint_b;
  check_refused(scene.mechanism, add, &def,
                "joint 3 \"C\": joint_a and joint_b are both joint 2 \"slot\", with the same "
                "coordinate");
  def.joint_a = (baum_joint_id){0, 0};
  check_refused(scene.mechanism, add, &def, "joint 3 \"C\": joint_a is none, must be given");
  def.joint_a = add_pin(&scene, scene.link, scene.ball);
  check_refused(scene.mechanism, add, &def,
                "joint 4 \"C\": body_b is body 2 \"ball\", which has no angle");
  couple(&scene, pin, def.joint_b, NULL);
  def.joint_a = pin;
  def.joint_b.index1 = 4;
  check_refused(
    scene.mechanism, add, &def,
    "joint 5 \"C\": joint_b is joint 4 \"joint4\", a coupling, which has no coordinate to couple");
  baum_mechanism_destroy(scene.mechanism);
}

static void the_coupled_joints_cannot_be_replaced(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_coupling_def def = good(&scene);
  baum_joint_id id;
  assert_int_equal(baum_mechanism_add_coupling(scene.mechanism, &def, &id), BAUM_OK);
  baum_coupling_def other = def;
  other.joint_a = add_pin(&scene, scene.link, scene.crank);
  assert_int_equal(baum_mechanism_set_coupling(scene.mechanism, id, &other), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), "joint 3 \"C\": its joint_a cannot change");
  other = def;
  other.joint_b = add_slot(&scene, scene.link, scene.crank);
  assert_int_equal(baum_mechanism_set_coupling(scene.mechanism, id, &other), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), "joint 3 \"C\": its joint_b cannot change");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  fault f = {0};
  baum_coupling_def first = good(&scene);
  baum_coupling_def second = first;
  first.ratio = -3.0;
  first.offset = 0.5;
  second.name = "other";
  second.law = faulty;
  second.user = &f;
  CHECK_ROUND_TRIP(joint, coupling, user, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(reactions_balance),
    cmocka_unit_test(no_column_occurs_twice),
    cmocka_unit_test(phi_is_coordinate_b_minus_the_law_of_coordinate_a),
    cmocka_unit_test(the_offset_follows_from_the_design_unless_given),
    cmocka_unit_test(a_failing_law_is_named),
    cmocka_unit_test(a_law_that_sets_nothing_is_zero),
    cmocka_unit_test(right_derivatives_raise_no_alarm),
    cmocka_unit_test(wrong_derivatives_are_named),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(joints_that_cannot_be_coupled_are_refused),
    cmocka_unit_test(the_coupled_joints_cannot_be_replaced),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
