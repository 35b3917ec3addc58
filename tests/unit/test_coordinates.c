/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests bodies with user coordinates. With c = cos t, the example has the mass matrix M and the
 * force g:
 *
 *   M = [ 4 + cos q1   sin q0  ]      g = ( -q0^3 + q1 v1 + c,  -sin(q0 q1) - v0^2 )
 *       [ sin q0       3 + q0^2]
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "construct.h"
#include "definitions.h"
#include "point.h"
#include "user_models.h"

/* ---- the example ---- */

/* Tells the functions of the example which value they return, and which error they add to their
 * results. */
typedef struct arm {
  int answer;
  double spoil; /* is added to mass()[0][1] and to force()[1] */
} arm;

static int arm_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  const arm *a = user;
  assert_true(out[0] == 0.0 && out[3] == 0.0);
  out[0] = 4.0 + cos(q[1]);
  out[1] = sin(q[0]) + a->spoil;
  out[2] = sin(q[0]);
  out[3] = 3.0 + q[0] * q[0];
  return a->answer;
}

static int arm_force(double t, const double *q, const double *v, const double *inputs, double *out,
                     void *user)
{
  const arm *a = user;
  assert_null(inputs);
  out[0] = -q[0] * q[0] * q[0] + q[1] * v[1] + cos(t);
  out[1] = -sin(q[0] * q[1]) - v[0] * v[0] + a->spoil;
  return a->answer;
}

static int arm_force_q(double t, const double *q, const double *v, const double *inputs,
                       double *out, void *user)
{
  (void)t;
  (void)inputs;
  (void)user;
  out[0] = -3.0 * q[0] * q[0];
  out[1] = v[1];
  out[2] = -q[1] * cos(q[0] * q[1]);
  out[3] = -q[0] * cos(q[0] * q[1]);
  return 0;
}

static int arm_force_v(double t, const double *q, const double *v, const double *inputs,
                       double *out, void *user)
{
  (void)t;
  (void)inputs;
  (void)user;
  out[1] = q[1];
  out[2] = -2.0 * v[0];
  return 0;
}

static int arm_potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[0] * q[0] * q[0] * q[0] / 4.0;
  return 0;
}

static const double design_q[2] = {0.3, -0.5};
static const double design_v[2] = {(double)NAN, 2.0};
static const double scales[2] = {1.0, 2.0};

static baum_coordinates_def good(arm *a)
{
  baum_coordinates_def def = baum_coordinates_def_default();
  def.name = "arm";
  def.size = 2;
  def.q = design_q;
  def.v = design_v;
  def.scale = scales;
  def.mass = arm_mass;
  def.force = arm_force;
  def.user = a;
  return def;
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_coordinates(mechanism, def, NULL);
}

/* Adds the body of the example after another body, so that the columns of the example do not start
 * at 0. */
static void open_arm(test_point *p, const baum_coordinates_def *def)
{
  const double elsewhere[3] = {1.0, 2.0, 3.0};
  baum_mechanism *mechanism = create_mechanism();
  (void)user_add_coordinates(mechanism, 3, elsewhere, 1.0);
  assert_int_equal(add(mechanism, def), BAUM_OK);
  test_point_open(p, mechanism);
}

static void move(test_point *p)
{
  const double q[5] = {0.0, 0.0, 0.0, 0.7, -1.1};
  const double v[5] = {0.0, 0.0, 0.0, -0.4, 1.9};
  p->t = 0.6;
  memcpy(p->q, q, sizeof q);
  memcpy(p->v, v, sizeof v);
  test_point_update(p);
}

/* ---- evaluation ---- */

static void design_values_scales_and_held_are_stored(void **state)
{
  (void)state;
  arm a = {0};
  baum_coordinates_def def = good(&a);
  def.held = true;
  test_point p;
  open_arm(&p, &def);
  const baum_mechanism *m = p.mechanism;
  assert_int_equal(m->nv, 5);
  for (int i = 0; i < 2; i++) {
    ASSERT_NEAR(m->design_q[3 + i], design_q[i], 0.0, 0.0);
    ASSERT_NEAR(m->scale[3 + i], scales[i], 0.0, 0.0);
    assert_true(m->held[3 + i]);
    assert_false(m->held[i]);
  }
  assert_true(isnan(m->design_v[0]) && isnan(m->design_v[3]));
  ASSERT_NEAR(m->design_v[4], 2.0, 0.0, 0.0);
  test_point_close(&p);
}

static void missing_design_values_are_zero_positions_free_velocities_and_scale_one(void **state)
{
  (void)state;
  arm a = {0};
  baum_coordinates_def def = good(&a);
  def.q = NULL;
  def.v = NULL;
  def.scale = NULL;
  test_point p;
  open_arm(&p, &def);
  for (int i = 3; i < 5; i++) {
    ASSERT_NEAR(p.mechanism->design_q[i], 0.0, 0.0, 0.0);
    ASSERT_NEAR(p.mechanism->scale[i], 1.0, 0.0, 0.0);
    assert_true(isnan(p.mechanism->design_v[i]));
  }
  test_point_close(&p);
}

static void mass_force_and_potential_are_those_given(void **state)
{
  (void)state;
  arm a = {0};
  baum_coordinates_def def = good(&a);
  def.potential = arm_potential;
  test_point p;
  open_arm(&p, &def);
  move(&p);
  double mass[13];
  double force[5];
  double potential;
  assert_int_equal(baum_i_mechanism_mass(&p.point, mass), BAUM_OK);
  assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  ASSERT_NEAR(mass[9], 4.0 + cos(-1.1), 0.0, 0.0);
  ASSERT_NEAR(mass[10], sin(0.7), 0.0, 0.0);
  ASSERT_NEAR(mass[12], 3.0 + 0.49, 1e-15, 0.0);
  ASSERT_NEAR(force[0], 0.0, 0.0, 0.0);
  ASSERT_NEAR(force[3], -0.343 - 1.1 * 1.9 + cos(0.6), 1e-14, 0.0);
  ASSERT_NEAR(force[4], -sin(-0.77) - 0.16, 1e-14, 0.0);
  ASSERT_NEAR(potential, 0.7 * 0.7 * 0.7 * 0.7 / 4.0, 1e-15, 0.0);
  assert_false(p.mechanism->constant_mass);
  test_point_close(&p);
}

/* ---- derivatives ---- */

static void check_blocks(const baum_coordinates_def *def, double tolerance)
{
  test_point p;
  open_arm(&p, def);
  move(&p);
  const double *q = p.q + 3;
  const double *v = p.v + 3;
  const double acceleration[5] = {9.0, 9.0, 9.0, 1.5, -0.8};
  const double want_ma[4] = {-0.8 * cos(q[0]), -1.5 * sin(q[1]), 1.5 * cos(q[0]) - 0.8 * 2.0 * q[0],
                             0.0};
  double want_q[4] = {0.0};
  double want_v[4] = {0.0};
  (void)arm_force_q(p.t, q, v, NULL, want_q, NULL);
  (void)arm_force_v(p.t, q, v, NULL, want_v, NULL);
  double ma_q[13];
  double force_q[13];
  double force_v[13];
  baum_i_body_blocks blocks = {ma_q, force_q, force_v};
  assert_int_equal(baum_i_mechanism_linearize_bodies(&p.point, acceleration, &blocks), BAUM_OK);
  for (int i = 0; i < 4; i++) {
    ASSERT_NEAR(ma_q[9 + i], want_ma[i], 0.0, 1e-11);
    ASSERT_NEAR(force_q[9 + i], want_q[i], 0.0, tolerance);
    ASSERT_NEAR(force_v[9 + i], want_v[i], 0.0, tolerance);
  }
  test_point_close(&p);
}

/* Derivatives that are not given are replaced by differences of order 6. Their measured error is
 * 1e-12. */
static void missing_derivatives_are_differenced_to_1e_11(void **state)
{
  (void)state;
  arm a = {0};
  baum_coordinates_def def = good(&a);
  check_blocks(&def, 1e-11);
}

static void given_derivatives_are_used_as_they_are(void **state)
{
  (void)state;
  arm a = {0};
  baum_coordinates_def def = good(&a);
  def.force_q = arm_force_q;
  def.force_v = arm_force_v;
  check_blocks(&def, 0.0);
}

static void a_constant_mass_has_no_derivative(void **state)
{
  (void)state;
  arm a = {0};
  baum_coordinates_def def = good(&a);
  def.constant_mass = true;
  test_point p;
  open_arm(&p, &def);
  const double acceleration[5] = {1.0, 1.0, 1.0, 1.0, 1.0};
  double ma_q[13];
  assert_int_equal(
    baum_i_mechanism_linearize_bodies(&p.point, acceleration, &(baum_i_body_blocks){.ma_q = ma_q}),
    BAUM_OK);
  for (int i = 9; i < 13; i++) {
    ASSERT_NEAR(ma_q[i], 0.0, 0.0, 0.0);
  }
  test_point_close(&p);
}

/* ---- functions that fail ---- */

static void failing_functions_are_named(void **state)
{
  (void)state;
  arm a = {.answer = 2};
  baum_coordinates_def def = good(&a);
  test_point p;
  open_arm(&p, &def);
  double out[13];
  assert_int_equal(baum_i_mechanism_mass(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "body 2 \"arm\": mass() returned 2 (retry)");
  assert_true(p.point.retry);
  a = (arm){.answer = -3};
  assert_int_equal(baum_i_mechanism_force(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "body 2 \"arm\": force() returned -3 (stop)");
  assert_false(p.point.retry);
  a = (arm){.spoil = (double)NAN};
  assert_int_equal(baum_i_mechanism_mass(&p.point, out), BAUM_ERR_NOT_FINITE);
  assert_string_equal(baum_message(), "body 2 \"arm\": mass()[0][1] is nan at t = 0 s");
  assert_int_equal(baum_i_mechanism_force(&p.point, out), BAUM_ERR_NOT_FINITE);
  assert_string_equal(baum_message(), "body 2 \"arm\": force()[1] is nan at t = 0 s");
  test_point_close(&p);
}

static void every_derivative_reports_a_failing_function(void **state)
{
  (void)state;
  arm a = {.answer = -1};
  baum_coordinates_def def = good(&a);
  test_point p;
  open_arm(&p, &def);
  double out[13];
  const baum_i_body_blocks blocks[] = {{.ma_q = out}, {.force_q = out}, {.force_v = out}};
  for (int i = 0; i < 3; i++) {
    assert_int_equal(baum_i_mechanism_linearize_bodies(&p.point, p.v, &blocks[i]),
                     BAUM_ERR_CALLBACK);
  }
  test_point_close(&p);
}

/* ---- definitions ---- */

static void defaults_are_those_documented(void **state)
{
  (void)state;
  baum_coordinates_def def;
  memset(&def, 0x55, sizeof def);
  def = baum_coordinates_def_default();
  assert_int_equal(def.struct_size, sizeof def);
  assert_int_equal(def.size, 0);
  assert_true(!def.name && !def.q && !def.v && !def.scale && !def.user);
  assert_true(!def.mass && !def.force && !def.force_q && !def.force_v && !def.potential);
  assert_false(def.constant_mass);
  assert_false(def.held);
}

static void a_bad_definition_is_refused_by_name(void **state)
{
  (void)state;
  arm a = {0};
  baum_mechanism *mechanism = create_mechanism();
  baum_coordinates_def bad = good(&a);
  bad.mass = NULL;
  check_refused(mechanism, add, &bad, "body 1 \"arm\": mass() is NULL, must be given");
  bad = good(&a);
  bad.force = NULL;
  check_refused(mechanism, add, &bad, "body 1 \"arm\": force() is NULL, must be given");
  bad = good(&a);
  bad.size = 0;
  check_refused(mechanism, add, &bad, "body 1 \"arm\": size is 0, must be > 0");
  bad.size = -4;
  bad.name = NULL;
  check_refused(mechanism, add, &bad, "body 1 \"body1\": size is -4, must be > 0");
  baum_mechanism_destroy(mechanism);
}

static void bad_numbers_are_refused_with_their_index(void **state)
{
  (void)state;
  arm a = {0};
  baum_mechanism *mechanism = create_mechanism();
  const double q[2] = {0.0, (double)NAN};
  const double v[2] = {(double)INFINITY, 0.0};
  const double zero[2] = {1.0, 0.0};
  const double infinite[2] = {(double)INFINITY, 1.0};
  baum_coordinates_def bad = good(&a);
  bad.q = q;
  check_refused(mechanism, add, &bad, "body 1 \"arm\": q[1] is nan, must be finite");
  bad = good(&a);
  bad.v = v;
  check_refused(mechanism, add, &bad,
                "body 1 \"arm\": v[0] is inf, must be finite, or NaN if free");
  bad = good(&a);
  bad.scale = zero;
  check_refused(mechanism, add, &bad, "body 1 \"arm\": scale[1] is 0, must be finite and > 0");
  bad.scale = infinite;
  check_refused(mechanism, add, &bad, "body 1 \"arm\": scale[0] is inf, must be finite and > 0");
  baum_mechanism_destroy(mechanism);
}

static void check_same_array(const double *got, const double *want, int count)
{
  assert_true((got == NULL) == (want == NULL));
  if (want) {
    assert_ptr_not_equal(got, want);
    assert_memory_equal(got, want, (size_t)count * sizeof *want);
  }
}

static void check_same(const baum_coordinates_def *got, const baum_coordinates_def *want)
{
  assert_string_equal(got->name, want->name);
  assert_int_equal(got->size, want->size);
  check_same_array(got->q, want->q, want->size);
  check_same_array(got->v, want->v, want->size);
  check_same_array(got->scale, want->scale, want->size);
  assert_true(got->mass == want->mass && got->force == want->force &&
              got->force_q == want->force_q && got->force_v == want->force_v &&
              got->potential == want->potential && got->user == want->user);
  assert_int_equal(got->constant_mass, want->constant_mass);
  assert_int_equal(got->held, want->held);
}

static void a_definition_comes_back_as_it_was_given(void **state)
{
  (void)state;
  arm a = {0};
  baum_mechanism *mechanism = create_mechanism();
  baum_coordinates_def first = good(&a);
  baum_coordinates_def second = good(NULL);
  baum_coordinates_def got;
  baum_body_id id;
  second.name = "leg";
  second.q = NULL;
  second.scale = NULL;
  second.force_q = arm_force_q;
  second.potential = arm_potential;
  second.constant_mass = true;
  second.held = true;
  assert_int_equal(baum_mechanism_add_coordinates(mechanism, &first, &id), BAUM_OK);
  assert_int_equal(baum_mechanism_get_coordinates(mechanism, id, &got, sizeof got), BAUM_OK);
  check_same(&got, &first);
  assert_int_equal(baum_mechanism_set_coordinates(mechanism, id, &second), BAUM_OK);
  assert_int_equal(baum_mechanism_get_coordinates(mechanism, id, &got, sizeof got), BAUM_OK);
  check_same(&got, &second);
  first.size = 1;
  assert_int_equal(baum_mechanism_set_coordinates(mechanism, id, &first), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), "body 1 \"leg\": its size is 2 and cannot change");
  baum_mechanism_destroy(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(design_values_scales_and_held_are_stored),
    cmocka_unit_test(missing_design_values_are_zero_positions_free_velocities_and_scale_one),
    cmocka_unit_test(mass_force_and_potential_are_those_given),
    cmocka_unit_test(missing_derivatives_are_differenced_to_1e_11),
    cmocka_unit_test(given_derivatives_are_used_as_they_are),
    cmocka_unit_test(a_constant_mass_has_no_derivative),
    cmocka_unit_test(failing_functions_are_named),
    cmocka_unit_test(every_derivative_reports_a_failing_function),
    cmocka_unit_test(defaults_are_those_documented),
    cmocka_unit_test(a_bad_definition_is_refused_by_name),
    cmocka_unit_test(bad_numbers_are_refused_with_their_index),
    cmocka_unit_test(a_definition_comes_back_as_it_was_given),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
