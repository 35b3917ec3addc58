/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests user forces. The tested force acts on two bodies with user coordinates, which are (x, y)
 * and (b, th, ga). The definition of the force lists these bodies in the opposite order, so its
 * function receives (b, th, ga, x, y). The force consists of a spring f = k (y - sin b) between y
 * and b, and of a cubic damper on x. */
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
#include "derivatives.h"
#include "point.h"
#include "user_models.h"

enum { B, TH, GA, X, Y, COUNT };

typedef struct spring {
  double k;
  double d;
  int answer;
  const char *says; /* the message that explains the return value */
} spring;

static int spring_force(double t, const double *q, const double *v, const double *inputs,
                        double *out, void *user)
{
  (void)t;
  const spring *s = user;
  assert_null(inputs);
  assert_true(out[TH] == 0.0);
  double f = s->k * (q[Y] - sin(q[B]));
  out[B] = f * cos(q[B]);
  out[Y] = -f;
  out[X] = -s->d * v[X] * v[X] * v[X];
  if (s->says) {
    (void)baum_fail(BAUM_ERR_CALLBACK, s->says);
  }
  return s->answer;
}

static int spring_force_q(double t, const double *q, const double *v, const double *inputs,
                          double *out, void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  const spring *s = user;
  double c = cos(q[B]);
  out[B * COUNT + B] = -s->k * (c * c + (q[Y] - sin(q[B])) * sin(q[B]));
  out[B * COUNT + Y] = s->k * c;
  out[Y * COUNT + B] = s->k * c;
  out[Y * COUNT + Y] = -s->k;
  return 0;
}

static int spring_force_v(double t, const double *q, const double *v, const double *inputs,
                          double *out, void *user)
{
  (void)t;
  (void)q;
  (void)inputs;
  const spring *s = user;
  out[X * COUNT + X] = -3.0 * s->d * v[X] * v[X];
  return 0;
}

static int spring_potential(double t, const double *q, double *out, void *user)
{
  (void)t;
  const spring *s = user;
  double x = q[Y] - sin(q[B]);
  out[0] = 0.5 * s->k * x * x;
  return s->answer;
}

/* ---- mechanism ---- */

typedef struct fixture {
  baum_mechanism *mechanism;
  baum_body_id bodies[2];
  spring spring;
  baum_user_force_def good;
} fixture;

static void open_fixture(fixture *f)
{
  const double q[3] = {0.2, 0.4, 0.6};
  f->mechanism = create_mechanism();
  f->bodies[1] = user_add_coordinates(f->mechanism, 2, q, 1.0);
  f->bodies[0] = user_add_coordinates(f->mechanism, 3, q, 1.0);
  f->spring = (spring){.k = 3.0, .d = 0.5};
  f->good = baum_user_force_def_default();
  f->good.name = "spring";
  f->good.bodies = f->bodies;
  f->good.body_count = 2;
  f->good.force = spring_force;
  f->good.user = &f->spring;
}

static baum_status add(baum_mechanism *mechanism, const void *def)
{
  return baum_mechanism_add_user_force(mechanism, def, NULL);
}

static void open_point(fixture *f, test_point *p)
{
  assert_int_equal(add(f->mechanism, &f->good), BAUM_OK);
  test_point_open(p, f->mechanism);
}

/* ---- evaluation ---- */

static void a_force_is_added_to_its_bodies(void **state)
{
  (void)state;
  fixture f;
  test_point p;
  open_fixture(&f);
  assert_int_equal(add(f.mechanism, &f.good), BAUM_OK); /* the same force a second time */
  open_point(&f, &p);
  p.v[0] = 2.0;
  test_point_update(&p);
  double force[5];
  assert_int_equal(baum_i_mechanism_force(&p.point, force), BAUM_OK);
  double pull = 3.0 * (0.4 - sin(0.2));
  const double want[5] = {-0.5 * 8.0, -pull, pull * cos(0.2), 0.0, 0.0};
  for (int i = 0; i < 5; i++) {
    ASSERT_NEAR(force[i], 2.0 * want[i], 1e-15, 0.0);
  }
  test_point_close(&p);
}

static void the_potential_agrees_with_the_force(void **state)
{
  (void)state;
  fixture f;
  test_point p;
  uint64_t seed = 3;
  open_fixture(&f);
  f.spring.d = 0.0;
  f.good.potential = spring_potential;
  open_point(&f, &p);
  test_point_random(&p, &seed);
  check_potential_gradient(&p);
  test_point_close(&p);
}

static void a_force_without_a_potential_has_potential_zero(void **state)
{
  (void)state;
  fixture f;
  test_point p;
  open_fixture(&f);
  open_point(&f, &p);
  double potential = (double)NAN;
  assert_int_equal(baum_i_mechanism_potential(&p.point, &potential), BAUM_OK);
  ASSERT_NEAR(potential, 0.0, 0.0, 0.0);
  test_point_close(&p);
}

/* ---- derivatives ---- */

static void check_blocks(bool given, double tolerance)
{
  fixture f;
  test_point p;
  uint64_t seed = 4;
  open_fixture(&f);
  f.good.force_q = given ? spring_force_q : NULL;
  f.good.force_v = given ? spring_force_v : NULL;
  open_point(&f, &p);
  for (int n = 0; n < 20; n++) {
    test_point_random(&p, &seed);
    const double q[COUNT] = {p.q[2], p.q[3], p.q[4], p.q[0], p.q[1]};
    const double v[COUNT] = {p.v[2], p.v[3], p.v[4], p.v[0], p.v[1]};
    double want_q[COUNT * COUNT] = {0.0};
    double want_v[COUNT * COUNT] = {0.0};
    double force_q[COUNT * COUNT];
    double force_v[COUNT * COUNT];
    (void)spring_force_q(p.t, q, v, NULL, want_q, &f.spring);
    (void)spring_force_v(p.t, q, v, NULL, want_v, &f.spring);
    baum_i_force_blocks blocks = {force_q, force_v};
    assert_int_equal(baum_i_mechanism_linearize_forces(&p.point, &blocks), BAUM_OK);
    for (int i = 0; i < COUNT * COUNT; i++) {
      ASSERT_NEAR(force_q[i], want_q[i], 0.0, tolerance);
      ASSERT_NEAR(force_v[i], want_v[i], 0.0, tolerance);
    }
    check_force_derivatives(&p);
  }
  test_point_close(&p);
}

/* Differences of order 6 replace derivatives that are not given. The error of these differences was
 * measured to be 2e-12 for values of up to 20. */
static void missing_derivatives_are_differenced_to_1e_11(void **state)
{
  (void)state;
  check_blocks(false, 1e-11);
}

static void given_derivatives_are_used_as_they_are(void **state)
{
  (void)state;
  check_blocks(true, 0.0);
}

/* ---- functions that fail ---- */

static void failing_functions_are_named(void **state)
{
  (void)state;
  fixture f;
  test_point p;
  open_fixture(&f);
  f.good.potential = spring_potential;
  open_point(&f, &p);
  double out[COUNT * COUNT];
  f.spring.answer = 1;
  assert_int_equal(baum_i_mechanism_force(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "force 1 \"spring\": force() returned 1 (retry)");
  assert_true(p.point.retry);
  assert_int_equal(baum_i_mechanism_potential(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "force 1 \"spring\": potential() returned 1 (retry)");
  f.spring.answer = -1;
  assert_int_equal(baum_i_mechanism_force(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "force 1 \"spring\": force() returned -1 (stop)");
  assert_false(p.point.retry);
  f.spring.says = "the table ends at 3 m";
  assert_int_equal(baum_i_mechanism_force(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(),
                      "force 1 \"spring\": force() returned -1 (stop): the table ends at 3 m");
  f.spring.says = NULL; /* the next message must not repeat the last explanation */
  assert_int_equal(baum_i_mechanism_force(&p.point, out), BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "force 1 \"spring\": force() returned -1 (stop)");
  const baum_i_force_blocks blocks[] = {{.force_q = out}, {.force_v = out}};
  for (int i = 0; i < 2; i++) {
    assert_int_equal(baum_i_mechanism_linearize_forces(&p.point, &blocks[i]), BAUM_ERR_CALLBACK);
  }
  f.spring.answer = 0;
  f.spring.k = (double)NAN;
  assert_int_equal(baum_i_mechanism_force(&p.point, out), BAUM_ERR_NOT_FINITE);
  assert_string_equal(baum_message(), "force 1 \"spring\": force()[0] is nan at t = 0 s");
  test_point_close(&p);
}

/* ---- definitions ---- */

static void defaults_are_those_documented(void **state)
{
  (void)state;
  baum_user_force_def def;
  memset(&def, 0x55, sizeof def);
  def = baum_user_force_def_default();
  assert_int_equal(def.struct_size, sizeof def);
  assert_int_equal(def.body_count, 0);
  assert_true(!def.name && !def.bodies && !def.force && !def.force_q && !def.force_v &&
              !def.potential && !def.user);
}

static void a_bad_definition_is_refused_by_name(void **state)
{
  (void)state;
  fixture f;
  open_fixture(&f);
  baum_user_force_def bad = f.good;
  bad.force = NULL;
  check_refused(f.mechanism, add, &bad, "force 1 \"spring\": force() is NULL, must be given");
  bad = f.good;
  bad.body_count = 0;
  check_refused(f.mechanism, add, &bad, "force 1 \"spring\": body_count is 0, must be > 0");
  bad = f.good;
  bad.bodies = NULL;
  check_refused(f.mechanism, add, &bad, "force 1 \"spring\": bodies is NULL, must be given");
  bad = f.good;
  f.bodies[1] = BAUM_GROUND;
  check_refused(f.mechanism, add, &bad,
                "force 1 \"spring\": bodies[1] is ground, which has no coordinates");
  f.bodies[1] = f.bodies[0];
  check_refused(f.mechanism, add, &bad,
                "force 1 \"spring\": bodies[0] and bodies[1] are the same body");
  baum_mechanism_destroy(f.mechanism);
}

static void check_same(const baum_user_force_def *got, const baum_user_force_def *want)
{
  assert_string_equal(got->name, want->name);
  assert_int_equal(got->body_count, want->body_count);
  assert_ptr_not_equal(got->bodies, want->bodies);
  assert_memory_equal(got->bodies, want->bodies, (size_t)want->body_count * sizeof *want->bodies);
  assert_true(got->force == want->force && got->force_q == want->force_q &&
              got->force_v == want->force_v && got->potential == want->potential &&
              got->user == want->user);
}

static void a_definition_is_returned_as_it_was_given(void **state)
{
  (void)state;
  fixture f;
  open_fixture(&f);
  baum_user_force_def next = f.good;
  baum_user_force_def got;
  baum_force_id id;
  next.name = "damper";
  next.force_q = spring_force_q;
  next.force_v = spring_force_v;
  next.potential = spring_potential;
  next.user = NULL;
  assert_int_equal(baum_mechanism_add_user_force(f.mechanism, &f.good, &id), BAUM_OK);
  assert_int_equal(baum_mechanism_get_user_force(f.mechanism, id, &got, sizeof got), BAUM_OK);
  check_same(&got, &f.good);
  assert_int_equal(baum_mechanism_set_user_force(f.mechanism, id, &next), BAUM_OK);
  assert_int_equal(baum_mechanism_get_user_force(f.mechanism, id, &got, sizeof got), BAUM_OK);
  check_same(&got, &next);
  next.body_count = 1;
  assert_int_equal(baum_mechanism_set_user_force(f.mechanism, id, &next), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), "force 1 \"damper\": its bodies cannot change");
  baum_mechanism_destroy(f.mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_force_is_added_to_its_bodies),
    cmocka_unit_test(the_potential_agrees_with_the_force),
    cmocka_unit_test(a_force_without_a_potential_has_potential_zero),
    cmocka_unit_test(missing_derivatives_are_differenced_to_1e_11),
    cmocka_unit_test(given_derivatives_are_used_as_they_are),
    cmocka_unit_test(failing_functions_are_named),
    cmocka_unit_test(defaults_are_those_documented),
    cmocka_unit_test(a_bad_definition_is_refused_by_name),
    cmocka_unit_test(a_definition_is_returned_as_it_was_given),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
