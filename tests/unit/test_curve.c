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

/* ---- curves ---- */

/* F = 0.6 x^2 - 0.5 x y + y + 0.1 y^3 + sin(0.7 x + 0.4 y). Its derivatives are all nonzero. */
static int bent(const double xy[2], double out[6], void *user)
{
  (void)user;
  double x = xy[0];
  double y = xy[1];
  double s = sin(0.7 * x + 0.4 * y);
  double c = cos(0.7 * x + 0.4 * y);
  out[0] = 0.6 * x * x - 0.5 * x * y + y + 0.1 * y * y * y + s;
  out[1] = 1.2 * x - 0.5 * y + 0.7 * c;
  out[2] = -0.5 * x + 1.0 + 0.3 * y * y + 0.4 * c;
  out[3] = 1.2 - 0.49 * s;
  out[4] = -0.5 - 0.28 * s;
  out[5] = 0.6 * y - 0.16 * s;
  return 0;
}

/* What is wrong with a curve function: an error that is added to one entry, or a return value other
 * than 0. */
typedef struct fault {
  int entry;
  double error;
  int answer;
} fault;

static int faulty(const double xy[2], double out[6], void *user)
{
  const fault *f = user;
  (void)bent(xy, out, NULL);
  out[f->entry] += f->error;
  return f->answer;
}

/* A curve function that sets nothing. The test fails unless the caller has set `out` to zero. */
static int nothing(const double xy[2], double out[6], void *user)
{
  (void)xy;
  (void)user;
  for (int i = 0; i < 6; i++) {
    if (out[i] != 0.0) {
      return -1;
    }
  }
  return 0;
}

/* The signed distance from the unit circle. It is not differentiable at the circle's centre. */
static int circle(const double xy[2], double out[6], void *user)
{
  (void)user;
  double r = hypot(xy[0], xy[1]);
  double c = xy[0] / r;
  double s = xy[1] / r;
  out[0] = r - 1.0;
  out[1] = c;
  out[2] = s;
  out[3] = s * s / r;
  out[4] = -s * c / r;
  out[5] = c * c / r;
  return 0;
}

/* ---- scenes ---- */

static bool is_particle(const planar_scene *scene, baum_body_id body)
{
  return body.index1 == scene->ball.index1 || body.index1 == scene->bead.index1;
}

/* Adds a joint that keeps a point on a curve. The curve belongs to body a. If a is a particle, the
 * curve belongs to body b. If both are particles, it belongs to the link. */
static void add_curve(planar_scene *scene, baum_body_id a, baum_body_id b)
{
  baum_planar_curve_def def = baum_planar_curve_def_default();
  if (is_particle(scene, a)) {
    baum_body_id other = is_particle(scene, b) ? scene->link : b;
    PLANAR_BETWEEN(scene, &def, other, a);
  } else {
    PLANAR_BETWEEN(scene, &def, a, b);
  }
  def.curve = bent;
  assert_int_equal(baum_mechanism_add_planar_curve(scene->mechanism, &def, NULL), BAUM_OK);
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_planar_curve(mechanism, def, NULL);
}

static baum_planar_curve_def good(const planar_scene *scene)
{
  baum_planar_curve_def def = baum_planar_curve_def_default();
  def.name = "cam";
  PLANAR_BETWEEN(scene, &def, scene->link, scene->bead);
  def.curve = bent;
  return def;
}

static baum_mechanism *make_with(baum_curve_fn *curve, void *user)
{
  planar_scene scene = planar_scene_make();
  baum_planar_curve_def def = good(&scene);
  def.curve = curve;
  def.user = user;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  return scene.mechanism;
}

/* ---- tests ---- */

static void derivatives_agree_with_differences(void **state)
{
  (void)state;
  for_each_planar_pair(add_curve, true, check_joint_derivatives);
}

static void reactions_balance(void **state)
{
  (void)state;
  for_each_planar_pair(add_curve, true, check_rows_balance);
}

static void a_circular_curve_is_equivalent_to_a_rod(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_curve_def def = good(&scene);
  def.curve = circle;
  assert_int_equal(add(scene.mechanism, &def), BAUM_OK);
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  PLANAR_BETWEEN(&scene, &rod, scene.link, scene.bead);
  rod.length = 1.0;
  assert_int_equal(baum_mechanism_add_planar_distance(scene.mechanism, &rod, NULL), BAUM_OK);
  test_point p;
  test_point_open(&p, scene.mechanism);
  /* The link is at (1, 0.5) with the angle 0.4 rad. The rod is 1 m long. The bead is therefore
   * placed 1 m from the point where the rod is joined to the link. */
  double *bead = p.q + p.mechanism->bodies[scene.bead.index1]->q;
  bead[0] = 1.0 + 0.3 * cos(0.4) + 0.2 * sin(0.4) + 0.6;
  bead[1] = 0.5 + 0.3 * sin(0.4) - 0.2 * cos(0.4) - 0.8;
  for (int i = 0; i < p.nv; i++) {
    p.v[i] = 0.3 * i - 1.0;
  }
  test_point_update(&p);
  double rows[2];
  double blocks[2 * 5];
  assert_int_equal(baum_i_mechanism_phi(&p.point, rows), BAUM_OK);
  ASSERT_NEAR(rows[0], 0.0, 0.0, 1e-15);
  ASSERT_NEAR(rows[1], 0.0, 0.0, 1e-15);
  assert_int_equal(baum_i_mechanism_jacobian(&p.point, blocks), BAUM_OK);
  for (int i = 0; i < 5; i++) {
    ASSERT_NEAR(blocks[i], blocks[5 + i], 0.0, 1e-15);
  }
  /* The rod has Phi = (r^2 - 1) / 2, and the curve has Phi = r - 1. On the circle, both have the
   * same J, but their values of gamma differ by r'^2. */
  assert_int_equal(baum_i_mechanism_gamma(&p.point, rows), BAUM_OK);
  double rate = 0.0;
  const baum_i_span *span = &p.mechanism->joints[0]->span;
  for (int i = 0; i < 5; i++) {
    rate += blocks[i] * p.v[span->columns[i]];
  }
  assert_true(fabs(rate) > 0.1);
  ASSERT_NEAR(rows[1], rows[0] - rate * rate, 1e-14, 0.0);
  test_point_close(&p);
}

static void a_function_that_sets_nothing_is_zero(void **state)
{
  (void)state;
  test_point p;
  test_point_open(&p, make_with(nothing, NULL));
  double row[6];
  assert_int_equal(baum_i_mechanism_phi(&p.point, row), BAUM_OK);
  ASSERT_NEAR(row[0], 0.0, 0.0, 0.0);
  assert_int_equal(baum_i_mechanism_jacobian(&p.point, row), BAUM_OK);
  for (int i = 0; i < 5; i++) {
    ASSERT_NEAR(row[i], 0.0, 0.0, 0.0);
  }
  test_point_close(&p);
}

static void a_failing_function_is_named(void **state)
{
  (void)state;
  test_point p;
  fault f = {.answer = -2};
  test_point_open(&p, make_with(faulty, &f));
  user_check_fails(&p, BAUM_ERR_CALLBACK, false, "joint 1 \"cam\": curve() returned -2 (stop)");
  f.answer = 4;
  user_check_fails(&p, BAUM_ERR_CALLBACK, true, "joint 1 \"cam\": curve() returned 4 (retry)");
  f = (fault){.entry = 4, .error = TEST_NAN};
  user_check_fails(&p, BAUM_ERR_NOT_FINITE, true, "joint 1 \"cam\": curve()[4] is nan at t = 0 s");
  f = (fault){.entry = 0, .error = -TEST_INFINITY};
  user_check_fails(&p, BAUM_ERR_NOT_FINITE, true, "joint 1 \"cam\": curve()[0] is -inf at t = 0 s");
  test_point_close(&p);
}

static void right_derivatives_raise_no_alarm(void **state)
{
  (void)state;
  user_check_right(make_with(bent, NULL));
  user_check_right(make_with(circle, NULL));
  user_check_right(make_with(nothing, NULL));
}

/* The message must name the wrong entry of curve(). */
static void wrong_derivatives_are_named(void **state)
{
  (void)state;
  for (int entry = 1; entry < 6; entry++) {
    fault f = {.entry = entry, .error = 1e-4};
    user_check_wrong_entry(make_with(faulty, &f), "joint 1 \"cam\": curve", entry);
  }
}

static void wrong_fields_are_refused(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  baum_planar_curve_def def = good(&scene);
  const bad_number numbers[] = {
    {offsetof(baum_planar_curve_def, point_b[0]), TEST_INFINITY,
     "joint 1 \"cam\": point_b[0] is inf m, must be finite"},
  };
  check_bad_numbers(scene.mechanism, add, &def, sizeof def, numbers, 1);
  def.curve = NULL;
  check_refused(scene.mechanism, add, &def, "joint 1 \"cam\": curve() is NULL, must be given");
  def = good(&scene);
  PLANAR_BETWEEN(&scene, &def, scene.ball, scene.crank);
  check_refused(scene.mechanism, add, &def,
                "joint 1 \"cam\": body_a is body 2 \"ball\", which has no angle");
  baum_mechanism_destroy(scene.mechanism);
}

static void definitions_come_back(void **state)
{
  (void)state;
  planar_scene scene = planar_scene_make();
  fault f = {0};
  baum_planar_curve_def first = good(&scene);
  baum_planar_curve_def second = first;
  second.name = "other";
  second.point_a[0] = 11.0;
  second.curve = faulty;
  second.user = &f;
  CHECK_ROUND_TRIP(joint, planar_curve, user, scene.mechanism, &first, &second);
  baum_mechanism_destroy(scene.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_agree_with_differences),
    cmocka_unit_test(reactions_balance),
    cmocka_unit_test(a_circular_curve_is_equivalent_to_a_rod),
    cmocka_unit_test(a_function_that_sets_nothing_is_zero),
    cmocka_unit_test(a_failing_function_is_named),
    cmocka_unit_test(right_derivatives_raise_no_alarm),
    cmocka_unit_test(wrong_derivatives_are_named),
    cmocka_unit_test(wrong_fields_are_refused),
    cmocka_unit_test(definitions_come_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
