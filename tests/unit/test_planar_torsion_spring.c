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
#include "spring_laws.h"

static baum_planar_torsion_spring_def between(baum_body_id a, baum_body_id b)
{
  baum_planar_torsion_spring_def def = baum_planar_torsion_spring_def_default();
  def.name = "T";
  def.body_a = a;
  def.body_b = b;
  def.stiffness = 7.0;
  def.damping = 1.3;
  def.free_angle = 0.9;
  return def;
}

/* A law replaces the numbers, so they must have their defaults. */
static baum_planar_torsion_spring_def with_law(baum_planar_torsion_spring_def def,
                                               baum_spring_fn *law, spring_law *user)
{
  def.stiffness = 0.0;
  def.damping = 0.0;
  def.free_angle = NAN;
  def.law = law;
  def.user = user;
  return def;
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_torsion_spring(mechanism, def, NULL);
}

static void add_linear(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  const baum_planar_torsion_spring_def def = between(a, b);
  assert_int_equal(add(scene->mechanism, &def), BAUM_OK);
}

static void add_with_law(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  const baum_planar_torsion_spring_def def =
    with_law(between(a, b), spring_law_cubic, &spring_law_good);
  assert_int_equal(add(scene->mechanism, &def), BAUM_OK);
}

/* Opens a test point with a torsion spring between crank (body a) and link (body b). Their angles
 * and angular velocities are given, and there is no gravity. */
static void open_at(test_point *p, baum_spring_fn *law, spring_law *user, const double angles[2],
                    const double rates[2])
{
  planar_scene scene = planar_scene_make();
  baum_planar_torsion_spring_def def = between(scene.crank, scene.link);
  if (law) {
    def = with_law(def, law, user);
  }
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  assert_int_equal(baum_mechanism_set_gravity(scene.mechanism, 0.0, 0.0, 0.0), BAUM_OK);
  test_point_open(p, scene.mechanism);
  int crank = p->mechanism->bodies[scene.crank.index1]->q;
  int link = p->mechanism->bodies[scene.link.index1]->q;
  p->q[crank + 2] = angles[0];
  p->q[link + 2] = angles[1];
  p->v[crank + 2] = rates[0];
  p->v[link + 2] = rates[1];
  test_point_update(p);
}

/* Checks that the link has the torque `want`, that the crank has the opposite torque, and that all
 * other forces are zero. */
static void check_torque(test_point *p, double want)
{
  double force[TEST_SIZE_MAX];
  assert_int_equal(baum_i_mechanism_force(&p->point, force), BAUM_OK);
  for (int i = 0; i < p->nv; i++) {
    const int *columns = p->mechanism->forces[0]->span.columns;
    double there = i == columns[5] ? want : i == columns[2] ? -want : 0.0;
    ASSERT_NEAR(force[i], there, 1e-15, 0.0);
  }
}

/* ---- tests ---- */

static void check_derivatives_and_potential(test_point *p)
{
  check_force_derivatives(p);
  check_potential_gradient(p);
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_linear, false, check_derivatives_and_potential);
  for_each_planar_pair(add_with_law, false, check_force_derivatives);
}

static void a_torsion_spring_rotates_the_bodies_back_and_damps(void **state)
{
  (void)state;
  test_point p;
  /* The relative angle is more than one revolution. The spring must not subtract whole revolutions
   * from it. */
  const double angles[2] = {-2.0, 10.0};
  const double rates[2] = {3.0, -4.0};
  open_at(&p, NULL, NULL, angles, rates);
  check_torque(&p, -(7.0 * (12.0 - 0.9) + 1.3 * -7.0));
  double potential;
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  ASSERT_NEAR(potential, 0.5 * 7.0 * 11.1 * 11.1, 1e-15, 0.0);
  test_point_close(&p);
}

static void a_law_replaces_stiffness_and_damping_and_has_no_potential(void **state)
{
  (void)state;
  test_point p;
  const double angles[2] = {-0.5, 1.0};
  const double rates[2] = {3.0, -4.0};
  open_at(&p, spring_law_cubic, &spring_law_good, angles, rates);
  double want[3];
  spring_law_cubic_at(1.5, -7.0, want);
  check_torque(&p, -want[0]);
  double potential;
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  ASSERT_NEAR(potential, 0.0, 0.0, 0.0);
  test_point_close(&p);
}

static void a_failing_law_is_named(void **state)
{
  (void)state;
  test_point p;
  const double angles[2] = {0.0, 1.0};
  const double rates[2] = {0.0, 0.0};
  spring_law law = {.answer = -2};
  open_at(&p, spring_law_cubic, &law, angles, rates);
  check_spring_law_fails(&p, BAUM_ERR_CALLBACK, false, "force 1 \"T\": law() returned -2 (stop)");
  law = (spring_law){.answer = 1};
  check_spring_law_fails(&p, BAUM_ERR_CALLBACK, true, "force 1 \"T\": law() returned 1 (retry)");
  law = (spring_law){.spoil = 2};
  check_spring_law_fails(&p, BAUM_ERR_NOT_FINITE, true,
                         "force 1 \"T\": law()[1] is nan at t = 0 s");
  test_point_close(&p);
}

static void wrong_derivatives_are_found(void **state)
{
  (void)state;
  for (int entry = 0; entry <= 2; entry++) {
    planar_scene scene = planar_scene_make();
    spring_law law = {.wrong = entry};
    const baum_planar_torsion_spring_def def =
      with_law(between(scene.crank, scene.link), spring_law_cubic, &law);
    assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
    assert_int_equal(baum_mechanism_freeze(scene.mechanism), BAUM_OK);
    check_spring_law_verdict(scene.mechanism, "T", entry);
  }
}

static void the_free_angle_follows_from_the_design_unless_given(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_torsion_spring_def def = between(scene.link, scene.crank);
  def.free_angle = TEST_NAN;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  def = between(BAUM_GROUND, scene.crank);
  def.free_angle = TEST_NAN;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  ASSERT_NEAR(p.mechanism->parameters[p.mechanism->forces[0]->element.parameter + 2], -1.1 - 0.4,
              1e-15, 0.0);
  ASSERT_NEAR(p.mechanism->parameters[p.mechanism->forces[1]->element.parameter + 2], -1.1, 1e-15,
              0.0);
  test_point_close(&p);
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_torsion_spring_def def = between(scene.link, scene.crank);
  const bad_number numbers[] = {
    {offsetof(baum_planar_torsion_spring_def, stiffness), -1.0,
     "force 1 \"T\": stiffness is -1 N m/rad, must be finite and >= 0"},
    {offsetof(baum_planar_torsion_spring_def, damping), TEST_INFINITY,
     "force 1 \"T\": damping is inf N m s/rad, must be finite and >= 0"},
    {offsetof(baum_planar_torsion_spring_def, free_angle), -TEST_INFINITY,
     "force 1 \"T\": free_angle is -inf rad, must be finite, or NaN if not given"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 3);
  def.body_b = scene.ball;
  check_refused(scene.mechanism, add, &def,
                "force 1 \"T\": body_b is body 2 \"ball\", which has no angle");
  def.body_b = scene.link;
  check_refused(scene.mechanism, add, &def,
                "force 1 \"T\": body_a and body_b are both body 1 \"link\"");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  const baum_planar_torsion_spring_def first = between(scene.link, scene.crank);
  baum_planar_torsion_spring_def second = with_law(first, spring_law_cubic, &spring_law_good);
  second.name = "other";
  CHECK_ROUND_TRIP(force, planar_torsion_spring, user, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(a_torsion_spring_rotates_the_bodies_back_and_damps),
    cmocka_unit_test(a_law_replaces_stiffness_and_damping_and_has_no_potential),
    cmocka_unit_test(a_failing_law_is_named),
    cmocka_unit_test(wrong_derivatives_are_found),
    cmocka_unit_test(the_free_angle_follows_from_the_design_unless_given),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
