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

static void add_spring(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_spring_def def = baum_planar_spring_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  def.stiffness = 7.0;
  def.damping = 1.3;
  def.free_length = 0.9;
  assert_int_equal(baum_mechanism_add_planar_spring(scene->mechanism, &def, NULL), BAUM_OK);
}

static void add_with_law(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_spring_def def = baum_planar_spring_def_default();
  PLANAR_BETWEEN(scene, &def, a, b);
  def.law = spring_law_cubic;
  def.user = &spring_law_good;
  assert_int_equal(baum_mechanism_add_planar_spring(scene->mechanism, &def, NULL), BAUM_OK);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_spring(mechanism, def, NULL);
}

static baum_planar_spring_def good(const planar_scene *scene)
{
  baum_planar_spring_def def = baum_planar_spring_def_default();
  def.name = "S";
  PLANAR_BETWEEN(scene, &def, scene->link, scene->crank);
  def.stiffness = 100.0;
  return def;
}

/* Returns the length of a spring. Only springs longer than 0.3 m are compared with differences. The
 * errors of differences are proportional to fifth derivatives, which grow as 1 / length^4. */
static double length_of(const test_point *p, const baum_i_force *spring)
{
  double at[2][2];
  for (int k = 0; k < 2; k++) {
    const baum_i_frame *f = &p->point.frames[spring->span.bodies[k]];
    const double *s = p->point.parameters + spring->element.parameter + 2 * (ptrdiff_t)k;
    at[k][0] = f->x + f->c * s[0] - f->s * s[1];
    at[k][1] = f->y + f->s * s[0] + f->c * s[1];
  }
  return hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]);
}

static void check_force_when_long(test_point *p)
{
  if (length_of(p, p->mechanism->forces[0]) > 0.3 && length_of(p, p->mechanism->forces[1]) > 0.3) {
    check_force_derivatives(p);
  }
}

static void check_when_long(test_point *p)
{
  if (length_of(p, p->mechanism->forces[0]) > 0.3 && length_of(p, p->mechanism->forces[1]) > 0.3) {
    check_force_derivatives(p);
    check_potential_gradient(p);
  }
}

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_spring, true, check_when_long);
  for_each_planar_pair(add_with_law, true, check_force_when_long);
}

/* Opens a test point with a spring "S" between ball and bead. The user gives its law. The bead is
 * at (3, 4) relative to the ball and moves along x. */
static void open_law(test_point *p, spring_law *user)
{
  planar_scene scene = planar_scene_make();
  baum_planar_spring_def def = baum_planar_spring_def_default();
  PLANAR_BETWEEN(&scene, &def, scene.ball, scene.bead);
  def.name = "S";
  def.law = spring_law_cubic;
  def.user = user;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  assert_int_equal(baum_mechanism_set_gravity(scene.mechanism, 0.0, 0.0, 0.0), BAUM_OK);
  test_point_open(p, scene.mechanism);
  int ball = p->mechanism->bodies[scene.ball.index1]->q;
  int bead = p->mechanism->bodies[scene.bead.index1]->q;
  p->q[ball] = 0.0;
  p->q[ball + 1] = 0.0;
  p->q[bead] = 3.0;
  p->q[bead + 1] = 4.0;
  p->v[bead] = 5.0;
  test_point_update(p);
}

static void a_law_replaces_stiffness_and_damping_and_has_no_potential(void **state)
{
  (void)state;
  test_point p;
  open_law(&p, &spring_law_good);
  double force[TEST_SIZE_MAX];
  double potential;
  double want[3];
  spring_law_cubic_at(5.0, 3.0, want);
  assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
  const int *columns = p.mechanism->forces[0]->span.columns;
  ASSERT_NEAR(force[columns[0]], 0.6 * want[0], 1e-15, 0.0);
  ASSERT_NEAR(force[columns[1]], 0.8 * want[0], 1e-15, 0.0);
  ASSERT_NEAR(force[columns[2]], -0.6 * want[0], 1e-15, 0.0);
  ASSERT_NEAR(force[columns[3]], -0.8 * want[0], 1e-15, 0.0);
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  ASSERT_NEAR(potential, 0.0, 0.0, 0.0);
  test_point_close(&p);
}

static void a_failing_law_is_named(void **state)
{
  (void)state;
  test_point p;
  spring_law law = {.answer = -1};
  open_law(&p, &law);
  check_spring_law_fails(&p, BAUM_ERR_CALLBACK, false, "force 1 \"S\": law() returned -1 (stop)");
  law = (spring_law){.answer = 5};
  check_spring_law_fails(&p, BAUM_ERR_CALLBACK, true, "force 1 \"S\": law() returned 5 (retry)");
  law = (spring_law){.spoil = 3};
  check_spring_law_fails(&p, BAUM_ERR_NOT_FINITE, true,
                         "force 1 \"S\": law()[2] is nan at t = 0 s");
  test_point_close(&p);
}

static void wrong_derivatives_are_found(void **state)
{
  (void)state;
  for (int entry = 0; entry <= 2; entry++) {
    planar_scene scene = planar_scene_make();
    spring_law law = {.wrong = entry};
    baum_planar_spring_def def = baum_planar_spring_def_default();
    PLANAR_BETWEEN(&scene, &def, scene.crank, scene.bead);
    def.name = "S";
    def.law = spring_law_cubic;
    def.user = &law;
    assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
    assert_int_equal(baum_mechanism_freeze(scene.mechanism), BAUM_OK);
    check_spring_law_verdict(scene.mechanism, "S", entry);
  }
}

static void a_spring_pulls_both_ends_together_and_damps_along_its_line(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  add_spring(&scene, scene.ball, scene.bead);
  assert_int_equal(baum_mechanism_set_gravity(scene.mechanism, 0.0, 0.0, 0.0), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  int ball = p.mechanism->bodies[scene.ball.index1]->q;
  int bead = p.mechanism->bodies[scene.bead.index1]->q;
  p.q[ball] = 0.0;
  p.q[ball + 1] = 0.0;
  p.q[bead] = 3.0;
  p.q[bead + 1] = 4.0;
  p.v[bead] = 5.0;
  p.v[ball + 1] = -10.0;
  test_point_update(&p);
  double force[TEST_SIZE_MAX];
  assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
  double tension = 7.0 * (5.0 - 0.9) + 1.3 * (5.0 * 0.6 + 10.0 * 0.8);
  ASSERT_NEAR(force[ball], 0.6 * tension, 1e-15, 0.0);
  ASSERT_NEAR(force[ball + 1], 0.8 * tension, 1e-15, 0.0);
  ASSERT_NEAR(force[bead], -0.6 * tension, 1e-15, 0.0);
  ASSERT_NEAR(force[bead + 1], -0.8 * tension, 1e-15, 0.0);
  double potential;
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  ASSERT_NEAR(potential, 0.5 * 7.0 * 4.1 * 4.1, 1e-15, 0.0);
  test_point_close(&p);
}

static void a_spring_without_length_has_no_force(void **state)
{
  (void)state;
  const double lengths[] = {0.0, 5e-324, 1e-310};
  for (int k = 0; k < 3; k++) {
    planar_scene scene = planar_scene_make();
    add_spring(&scene, scene.ball, BAUM_GROUND);
    baum_planar_spring_def def = baum_planar_spring_def_default();
    test_point p;
    PLANAR_BETWEEN(&scene, &def, scene.ball, scene.bead);
    def.stiffness = 1e6;
    def.damping = 1e3;
    assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
    assert_int_equal(baum_mechanism_set_gravity(scene.mechanism, 0.0, 0.0, 0.0), BAUM_OK);
    test_point_open(&p, scene.mechanism);
    int ball = p.mechanism->bodies[scene.ball.index1]->q;
    int bead = p.mechanism->bodies[scene.bead.index1]->q;
    p.q[ball] = 0.0;
    p.q[ball + 1] = 0.0;
    p.q[bead] = lengths[k];
    p.q[bead + 1] = 0.0;
    p.v[bead] = 1.0;
    test_point_update(&p);
    double force[TEST_SIZE_MAX];
    double force_q[TEST_SIZE_MAX * TEST_SIZE_MAX];
    double force_v[TEST_SIZE_MAX * TEST_SIZE_MAX];
    assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
    ASSERT_NEAR(force[bead], 0.0, 0.0, 0.0);
    ASSERT_NEAR(force[bead + 1], 0.0, 0.0, 0.0);
    const baum_i_force_blocks blocks = {force_q, force_v};
    assert_int_equal(baum_i_mechanism_linearize_forces(&p.point, &blocks), BAUM_OK);
    const baum_i_force *between = p.mechanism->forces[1];
    for (int i = 0; i < between->span.nl * between->span.nl; i++) {
      ASSERT_NEAR(force_q[between->square + i], 0.0, 0.0, 0.0);
      ASSERT_NEAR(force_v[between->square + i], 0.0, 0.0, 0.0);
    }
    test_point_close(&p);
  }
}

static void the_free_length_follows_from_the_design_unless_given(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_spring_def def = good(&scene);
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  assert_int_equal(baum_mechanism_set_gravity(scene.mechanism, 0.0, 0.0, 0.0), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  double force[TEST_SIZE_MAX];
  assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
  for (int i = 0; i < p.nv; i++) {
    /* The tolerance is the stiffness, 100 N/m, times the rounding error of the length. */
    ASSERT_NEAR(force[i], 0.0, 0.0, 1e-13);
  }
  test_point_close(&p);
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_spring_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_spring_def, stiffness), -1.0,
     "force 1 \"S\": stiffness is -1 N/m, must be finite and >= 0"},
    {offsetof(baum_planar_spring_def, stiffness), TEST_NAN,
     "force 1 \"S\": stiffness is nan N/m, must be finite and >= 0"},
    {offsetof(baum_planar_spring_def, damping), TEST_INFINITY,
     "force 1 \"S\": damping is inf N s/m, must be finite and >= 0"},
    {offsetof(baum_planar_spring_def, free_length), -0.5,
     "force 1 \"S\": free_length is -0.5 m, must be finite and >= 0"},
    {offsetof(baum_planar_spring_def, point_a[0]), TEST_NAN,
     "force 1 \"S\": point_a[0] is nan m, must be finite"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 5);
  def.point[0] = 1.0;
  def.point[1] = 1.0;
  check_refused(
    scene.mechanism, add, &def,
    "force 1 \"S\": point is given, but the length would be zero; give point_a and point_b "
    "instead");
  def = baum_planar_spring_def_default();
  def.body_a = scene.link;
  def.body_b = scene.crank;
  check_refused(scene.mechanism, add, &def,
                "force 1 \"force1\": no point is given; give point_a and point_b");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_spring_def first = good(&scene);
  baum_planar_spring_def second = first;
  first.damping = 0.5;
  first.free_length = 0.0;
  second.name = "other";
  second.point_b[1] = -6.0;
  second.stiffness = 0.0;
  second.law = spring_law_cubic;
  second.user = &spring_law_good;
  CHECK_ROUND_TRIP(force, planar_spring, user, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(a_spring_pulls_both_ends_together_and_damps_along_its_line),
    cmocka_unit_test(a_law_replaces_stiffness_and_damping_and_has_no_potential),
    cmocka_unit_test(a_failing_law_is_named),
    cmocka_unit_test(wrong_derivatives_are_found),
    cmocka_unit_test(a_spring_without_length_has_no_force),
    cmocka_unit_test(the_free_length_follows_from_the_design_unless_given),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
