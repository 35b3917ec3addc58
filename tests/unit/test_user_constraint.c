/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests user constraints: their bodies, functions that fail, and definitions.
 * test_user_constraint_derivatives.c tests their derivatives. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <baum/planar.h>

#include "assert_near.h"
#include "construct.h"
#include "definitions.h"
#include "point.h"
#include "user_models.h"

/* ---- bodies ---- */

/* Phi is the sum of (i + 1) q_i over the coordinates that the function receives. The Jacobian
 * therefore shows their order. */
static int weights_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  int count = *(int *)user;
  for (int i = 0; i < count; i++) {
    out[0] += (i + 1) * q[i];
  }
  return 0;
}

static void coordinates_are_in_the_order_of_the_listed_bodies(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  const double q[3] = {0.1, 0.2, 0.3};
  baum_body_id bodies[3];
  baum_planar_body_def link = baum_planar_body_def_default();
  baum_body_id extra = user_add_coordinates(mechanism, 2, q, 1.0);
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &link, &bodies[1]), BAUM_OK);
  bodies[2] = user_add_coordinates(mechanism, 2, q, 1.0);
  bodies[0] = user_add_coordinates(mechanism, 3, q, 1.0);
  int count = 8;
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.bodies = bodies;
  def.body_count = 3;
  def.row_count = 1;
  def.phi = weights_phi;
  def.user = &count;
  assert_int_equal(baum_mechanism_add_user_constraint(mechanism, &def, NULL), BAUM_OK);
  memset(bodies, 0, sizeof bodies); /* the mechanism must have copied them */
  (void)extra;

  test_point p;
  test_point_open(&p, mechanism);
  double phi;
  double jacobian[8];
  assert_int_equal(baum_i_mechanism_phi(&p.point, &phi), BAUM_OK);
  ASSERT_NEAR(phi, 1.0 * 0.1 + 2.0 * 0.2 + 3.0 * 0.3 + 7.0 * 0.1 + 8.0 * 0.2, 1e-15, 0.0);
  assert_int_equal(baum_i_mechanism_jacobian(&p.point, jacobian), BAUM_OK);
  const int columns[8] = {7, 8, 9, 2, 3, 4, 5, 6};
  for (int i = 0; i < 8; i++) {
    assert_int_equal(mechanism->joints[0]->span.columns[i], columns[i]);
    ASSERT_NEAR(jacobian[i], i + 1.0, 1e-12, 0.0);
  }
  test_point_close(&p);
}

/* ---- functions that fail ---- */

typedef struct failure {
  int answer;
  double value;
  int calls;
} failure;

static int failing_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  failure *f = user;
  f->calls++;
  assert_true(out[0] == 0.0 && out[1] == 0.0);
  out[0] = 3.0;
  out[1] = f->value;
  return f->answer;
}

static int failing_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  failure *f = user;
  out[3] = f->value;
  return 0;
}

static int failing_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)out;
  failure *f = user;
  return f->answer;
}

static void open_failing(test_point *p, failure *f, bool given)
{
  const double q[2] = {0.1, 0.2};
  baum_mechanism *mechanism = create_mechanism();
  baum_body_id body = user_add_coordinates(mechanism, 2, q, 1.0);
  baum_user_constraint_def def = baum_user_constraint_def_default();
  def.name = "circle";
  def.bodies = &body;
  def.body_count = 1;
  def.row_count = 2;
  def.phi = failing_phi;
  def.jacobian = given ? failing_jacobian : NULL;
  def.gamma = given ? failing_gamma : NULL;
  def.user = f;
  assert_int_equal(baum_mechanism_add_user_constraint(mechanism, &def, NULL), BAUM_OK);
  test_point_open(p, mechanism);
  p->t = 1.2;
  test_point_update(p);
}

static void a_positive_return_value_requests_a_smaller_step(void **state)
{
  (void)state;
  failure f = {.answer = 1};
  test_point p;
  open_failing(&p, &f, true);
  double out[2];
  assert_int_equal(baum_i_mechanism_phi(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "joint 1 \"circle\": phi() returned 1 (retry)");
  assert_true(p.point.retry);
  assert_int_equal(baum_i_mechanism_gamma(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "joint 1 \"circle\": gamma() returned 1 (retry)");
  test_point_close(&p);
}

static void a_negative_return_value_stops_the_run(void **state)
{
  (void)state;
  failure f = {.answer = -1};
  test_point p;
  open_failing(&p, &f, false);
  double out[4];
  p.point.retry = true;
  assert_int_equal(baum_i_mechanism_phi(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "joint 1 \"circle\": phi() returned -1 (stop)");
  assert_false(p.point.retry);
  f.calls = 0;
  assert_int_equal(baum_i_mechanism_jacobian(&p.point, out), BAUM_ERR_CALLBACK);
  assert_int_equal(f.calls, 1);
  assert_false(p.point.retry);
  test_point_close(&p);
}

static void values_that_are_not_finite_are_named(void **state)
{
  (void)state;
  failure f = {.value = -(double)NAN};
  test_point p;
  open_failing(&p, &f, true);
  double out[4];
  assert_int_equal(baum_i_mechanism_phi(&p.point, out), BAUM_ERR_NOT_FINITE);
  assert_string_equal(baum_message(), "joint 1 \"circle\": phi()[1] is nan at t = 1.2 s");
  assert_true(p.point.retry);
  f.value = (double)INFINITY;
  assert_int_equal(baum_i_mechanism_jacobian(&p.point, out), BAUM_ERR_NOT_FINITE);
  assert_string_equal(baum_message(), "joint 1 \"circle\": jacobian()[1][1] is inf at t = 1.2 s");
  f.value = -(double)INFINITY;
  assert_int_equal(baum_i_mechanism_phi(&p.point, out), BAUM_ERR_NOT_FINITE);
  assert_string_equal(baum_message(), "joint 1 \"circle\": phi()[1] is -inf at t = 1.2 s");
  test_point_close(&p);
}

static void every_difference_reports_a_failure(void **state)
{
  (void)state;
  const int answers[] = {1, -1};
  for (int k = 0; k < 2; k++) {
    failure f = {.answer = answers[k]};
    test_point p;
    open_failing(&p, &f, false);
    double out[4];
    p.v[0] = 1.0;
    test_point_update(&p);
    assert_int_equal(baum_i_mechanism_jacobian(&p.point, out), BAUM_ERR_CALLBACK);
    assert_int_equal(baum_i_mechanism_nu(&p.point, out), BAUM_ERR_CALLBACK);
    assert_int_equal(baum_i_mechanism_gamma(&p.point, out), BAUM_ERR_CALLBACK);
    p.v[0] = 0.1; /* if v is small, gamma first tests whether Phi changes with t at constant q */
    test_point_update(&p);
    f.calls = 0;
    assert_int_equal(baum_i_mechanism_gamma(&p.point, out), BAUM_ERR_CALLBACK);
    assert_int_equal(f.calls, 1);
    const baum_i_joint_blocks blocks[] = {
      {.jw_q = out}, {.jtl_q = out}, {.gamma_q = out}, {.gamma_v = out}, {.nu_q = out}};
    for (int b = 0; b < 5; b++) {
      assert_int_equal(baum_i_mechanism_linearize_joints(&p.point, p.v, p.v, &blocks[b]),
                       BAUM_ERR_CALLBACK);
      assert_true(p.point.retry == (answers[k] > 0));
    }
    test_point_close(&p);
  }
}

/* ---- definitions ---- */

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_user_constraint(mechanism, def, NULL);
}

typedef struct fixture {
  baum_mechanism *mechanism;
  baum_body_id bodies[3];
  baum_user_constraint_def good;
} fixture;

static void open_fixture(fixture *f)
{
  const double q[3] = {0.0};
  f->mechanism = create_mechanism();
  for (int i = 0; i < 3; i++) {
    f->bodies[i] = user_add_coordinates(f->mechanism, 2, q, 1.0);
  }
  f->good = baum_user_constraint_def_default();
  f->good.name = "circle";
  f->good.bodies = f->bodies;
  f->good.body_count = 2;
  f->good.row_count = 1;
  f->good.phi = user_circle.phi;
}

static void defaults_are_those_documented(void **state)
{
  (void)state;
  baum_user_constraint_def def;
  memset(&def, 0x55, sizeof def);
  def = baum_user_constraint_def_default();
  assert_int_equal(def.struct_size, sizeof def);
  assert_null(def.name);
  assert_null(def.bodies);
  assert_int_equal(def.body_count, 0);
  assert_int_equal(def.row_count, 0);
  assert_true(!def.phi && !def.jacobian && !def.nu && !def.gamma && !def.user);
}

static void a_bad_definition_is_refused_by_name(void **state)
{
  (void)state;
  fixture f;
  open_fixture(&f);
  baum_user_constraint_def bad = f.good;
  bad.phi = NULL;
  check_refused(f.mechanism, add, &bad, "joint 1 \"circle\": phi() is NULL, must be given");
  bad = f.good;
  bad.row_count = 0;
  check_refused(f.mechanism, add, &bad, "joint 1 \"circle\": row_count is 0, must be > 0");
  bad.row_count = 10001;
  check_refused(f.mechanism, add, &bad,
                "joint 1 \"circle\": row_count is 10001, must be at most 10000");
  bad = f.good;
  bad.name = NULL;
  bad.body_count = -1;
  check_refused(f.mechanism, add, &bad, "joint 1 \"joint1\": body_count is -1, must be > 0");
  bad = f.good;
  bad.bodies = NULL;
  check_refused(f.mechanism, add, &bad, "joint 1 \"circle\": bodies is NULL, must be given");
  baum_mechanism_destroy(f.mechanism);
}

static void bad_bodies_are_refused_with_their_index(void **state)
{
  (void)state;
  fixture f;
  open_fixture(&f);
  baum_user_constraint_def bad = f.good;
  bad.body_count = 3;
  f.bodies[2] = f.bodies[0];
  check_refused(f.mechanism, add, &bad,
                "joint 1 \"circle\": bodies[0] and bodies[2] are the same body");
  f.bodies[2] = BAUM_GROUND;
  check_refused(f.mechanism, add, &bad,
                "joint 1 \"circle\": bodies[2] is ground, which has no coordinates");
  f.bodies[2] = (baum_body_id){0};
  check_refused(f.mechanism, add, &bad, "joint 1 \"circle\": bodies[2] is none, must be given");
  f.bodies[2] = (baum_body_id){f.bodies[0].index1, f.bodies[0].tag + 1};
  check_refused(f.mechanism, add, &bad, "joint 1 \"circle\": bodies[2] is not of this mechanism");
  baum_mechanism_destroy(f.mechanism);
}

static void check_same(const baum_user_constraint_def *got, const baum_user_constraint_def *want)
{
  assert_string_equal(got->name, want->name);
  assert_ptr_not_equal(got->bodies, want->bodies);
  assert_int_equal(got->body_count, want->body_count);
  assert_memory_equal(got->bodies, want->bodies, (size_t)want->body_count * sizeof *want->bodies);
  assert_int_equal(got->row_count, want->row_count);
  assert_true(got->phi == want->phi && got->jacobian == want->jacobian && got->nu == want->nu &&
              got->gamma == want->gamma && got->user == want->user);
}

static void a_definition_is_returned_as_it_was_given(void **state)
{
  (void)state;
  fixture f;
  open_fixture(&f);
  baum_user_constraint_def next = f.good;
  baum_user_constraint_def got;
  baum_joint_id id;
  next.name = "again";
  next.jacobian = user_circle.jacobian;
  next.nu = user_circle.nu;
  next.gamma = user_circle.gamma;
  next.user = &f;
  assert_int_equal(baum_mechanism_add_user_constraint(f.mechanism, &f.good, &id), BAUM_OK);
  assert_int_equal(baum_mechanism_get_user_constraint(f.mechanism, id, &got, sizeof got), BAUM_OK);
  check_same(&got, &f.good);
  assert_int_equal(baum_mechanism_set_user_constraint(f.mechanism, id, &next), BAUM_OK);
  assert_int_equal(baum_mechanism_get_user_constraint(f.mechanism, id, &got, sizeof got), BAUM_OK);
  check_same(&got, &next);
  /* A definition that was read from the mechanism may be set again, with the pointers that it
   * contains. */
  assert_int_equal(baum_mechanism_set_user_constraint(f.mechanism, id, &got), BAUM_OK);
  baum_mechanism_destroy(f.mechanism);
}

static void rows_and_bodies_cannot_change(void **state)
{
  (void)state;
  fixture f;
  open_fixture(&f);
  baum_user_constraint_def next = f.good;
  baum_joint_id id;
  assert_int_equal(baum_mechanism_add_user_constraint(f.mechanism, &f.good, &id), BAUM_OK);
  next.row_count = 2;
  assert_int_equal(baum_mechanism_set_user_constraint(f.mechanism, id, &next), BAUM_ERR_ARGUMENT);
  next = f.good;
  next.body_count = 1;
  assert_int_equal(baum_mechanism_set_user_constraint(f.mechanism, id, &next), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), "joint 1 \"circle\": its bodies cannot change");
  baum_mechanism_destroy(f.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(coordinates_are_in_the_order_of_the_listed_bodies),
    cmocka_unit_test(a_positive_return_value_requests_a_smaller_step),
    cmocka_unit_test(a_negative_return_value_stops_the_run),
    cmocka_unit_test(values_that_are_not_finite_are_named),
    cmocka_unit_test(every_difference_reports_a_failure),
    cmocka_unit_test(defaults_are_those_documented),
    cmocka_unit_test(a_bad_definition_is_refused_by_name),
    cmocka_unit_test(bad_bodies_are_refused_with_their_index),
    cmocka_unit_test(a_definition_is_returned_as_it_was_given),
    cmocka_unit_test(rows_and_bodies_cannot_change),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
