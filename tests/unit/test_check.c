/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the check of derivatives that user functions return. Its message must name the wrong
 * derivative. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/planar.h>

#include "construct.h"
#include "user_check.h"

/* A model in which one entry of one derivative has a relative error of 1e-4. */
typedef struct spoiled {
  /* Must be the first member, because the model's functions receive a pointer to it. */
  user_model model;
  const user_kind *kind;
  int entry;
} spoiled;

static int spoiled_jacobian(double t, const double *q, double *out, void *user)
{
  const spoiled *s = user;
  int answer = s->kind->jacobian(t, q, out, user);
  out[s->entry] *= 1.0001;
  return answer;
}

static int spoiled_nu(double t, const double *q, double *out, void *user)
{
  const spoiled *s = user;
  int answer = s->kind->nu(t, q, out, user);
  out[s->entry] *= 1.0001;
  return answer;
}

static int spoiled_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  const spoiled *s = user;
  int answer = s->kind->gamma(t, q, v, out, user);
  out[s->entry] *= 1.0001;
  return answer;
}

static void check_spoiled(spoiled *s, int which, int given, const char *place)
{
  user_kind wrong = *s->kind;
  wrong.jacobian = which == GIVE_JACOBIAN ? spoiled_jacobian : wrong.jacobian;
  wrong.nu = which == GIVE_NU ? spoiled_nu : wrong.nu;
  wrong.gamma = which == GIVE_GAMMA ? spoiled_gamma : wrong.gamma;
  assert_int_equal(user_check(user_make(&wrong, &s->model, which | given)), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), place));
}

static void every_entry_that_is_wrong_by_a_ten_thousandth_is_named_in_any_unit(void **state)
{
  (void)state;
  const user_kind *const kinds[] = {&user_circle, &user_loop, &user_swing};
  const double sizes[] = {1e-6, 1e-3, 1.0, 1e3, 1e6};
  char place[64];
  for (int k = 0; k < 3 * 5; k++) {
    spoiled s = {.model = {sizes[k % 5], 2.0}, .kind = kinds[k / 5]};
    int columns = s.kind->size;
    for (s.entry = 0; s.entry < s.kind->rows * columns; s.entry++) {
      (void)snprintf(place, sizeof place, ": jacobian()[%d][%d] is ", s.entry / columns,
                     s.entry % columns);
      check_spoiled(&s, GIVE_JACOBIAN, GIVE_NOTHING, place);
    }
    for (s.entry = 0; s.entry < s.kind->rows; s.entry++) {
      (void)snprintf(place, sizeof place, ": gamma()[%d] is ", s.entry);
      check_spoiled(&s, GIVE_GAMMA, GIVE_NOTHING, place);
      check_spoiled(&s, GIVE_GAMMA, GIVE_JACOBIAN | GIVE_NU, place);
    }
  }
  spoiled s = {.model = {1.0, 2.0}, .kind = &user_swing};
  check_spoiled(&s, GIVE_NU, GIVE_NOTHING, ": nu()[0] is ");
}

static int half_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 2.0 * q[0];
  out[1] = q[1];
  return 0;
}

/* A Jacobian of the unit circle with a wrong second entry, -1.6 instead of 2 y. This entry is right
 * only in the design configuration, where y = -0.8. */
static int frozen_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 2.0 * q[0];
  out[1] = -1.6;
  return 0;
}

static int slightly_wrong_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 2.0 * q[0];
  out[1] = 2.0 * q[1] * (1.0 + 1e-5);
  return 0;
}

/* The circle of radius 1. */
static int unit_circle_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[0] * q[0] + q[1] * q[1] - 1.0;
  return 0;
}

static void a_wrong_entry_of_the_jacobian_is_named(void **state)
{
  (void)state;
  user_check_wrong(
    user_make_constraint(unit_circle_phi, half_jacobian, NULL, NULL, 1.0),
    "joint 1 \"circle\": jacobian()[0][1] is -0.8 but finite differences of phi give -1.6");
}

static void an_entry_that_is_right_in_the_design_configuration_only_is_found(void **state)
{
  (void)state;
  baum_mechanism *mechanism =
    user_make_constraint(unit_circle_phi, frozen_jacobian, NULL, NULL, 1.0);
  assert_int_equal(user_check(mechanism), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(
    baum_message(), "joint 1 \"circle\": jacobian()[0][1] is -1.6 but finite differences of phi"));
}

static void an_entry_that_is_wrong_by_a_hundred_thousandth_is_found(void **state)
{
  (void)state;
  const double scales[] = {1e-3, 1.0, 1e3, 1e6};
  for (int i = 0; i < 4; i++) {
    user_check_wrong(
      user_make_constraint(unit_circle_phi, slightly_wrong_jacobian, NULL, NULL, scales[i]),
      "joint 1 \"circle\": jacobian()[0][1] is -1.600016 but finite differences of phi give -1.6");
  }
}

/* The constraint x = 2 sin(3 t). */
static int driven_phi(double t, const double *q, double *out, void *user)
{
  (void)user;
  out[0] = q[0] - 2.0 * sin(3.0 * t);
  return 0;
}

static int driven_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[0] = 1.0;
  return 0;
}

static int opposite_nu(double t, const double *q, double *out, void *user)
{
  (void)q;
  (void)user;
  out[0] = -6.0 * cos(3.0 * t);
  return 0;
}

static int right_nu(double t, const double *q, double *out, void *user)
{
  (void)q;
  (void)user;
  out[0] = 6.0 * cos(3.0 * t);
  return 0;
}

static void nu_of_the_wrong_sign_is_named(void **state)
{
  (void)state;
  user_check_wrong(user_make_constraint(driven_phi, NULL, opposite_nu, NULL, 1.0),
                   "joint 1 \"circle\": nu()[0] is -6 but finite differences of phi in t give 6");
}

static int no_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)out;
  (void)user;
  return 0;
}

static int right_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)q;
  (void)v;
  (void)user;
  out[0] = -18.0 * sin(3.0 * t);
  return 0;
}

/* A gamma of zero is right at t = 0. The check finds the error because it also evaluates gamma at
 * other times. */
static void a_forgotten_gamma_is_found_at_another_time(void **state)
{
  (void)state;
  char message[128];
  (void)snprintf(message, sizeof message,
                 "joint 1 \"circle\": gamma()[0] is 0 but finite differences of %s give %.9g",
                 "phi", -18.0 * sin(3.0 * 0.37));
  baum_mechanism *mechanism = user_make_constraint(driven_phi, NULL, NULL, no_gamma, 1.0);
  /* The number in the message is a second difference, which has only seven correct digits. The test
   * therefore does not compare the last three digits of this number. */
  assert_int_equal(user_check(mechanism), BAUM_ERR_ARGUMENT);
  assert_memory_equal(baum_message(), message, strlen(message) - 3);
  (void)snprintf(message, sizeof message,
                 "joint 1 \"circle\": gamma()[0] is 0 but finite differences of %s give %.9g",
                 "jacobian and nu", -18.0 * sin(3.0 * 0.37));
  user_check_wrong(user_make_constraint(driven_phi, driven_jacobian, right_nu, no_gamma, 1.0),
                   message);
  user_check_right(user_make_constraint(driven_phi, driven_jacobian, right_nu, right_gamma, 1.0));
}

static int cubic_force(double t, const double *q, const double *v, const double *inputs,
                       double *out, void *user)
{
  (void)t;
  (void)inputs;
  (void)user;
  out[0] = -5.0 * q[0] - 7.0 * v[1];
  out[1] = -4.0 * q[1] * q[1] * q[1];
  return 0;
}

static int cubic_force_q(double t, const double *q, const double *v, const double *inputs,
                         double *out, void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = -5.0;
  out[3] = -12.0 * q[1] * q[1];
  return 0;
}

static int wrong_force_q(double t, const double *q, const double *v, const double *inputs,
                         double *out, void *user)
{
  (void)cubic_force_q(t, q, v, inputs, out, user);
  out[0] = 5.0;
  return 0;
}

static int cubic_force_v(double t, const double *q, const double *v, const double *inputs,
                         double *out, void *user)
{
  (void)t;
  (void)q;
  (void)v;
  (void)inputs;
  (void)user;
  out[1] = -7.0;
  return 0;
}

static void wrong_derivatives_of_a_force_are_named(void **state)
{
  (void)state;
  user_check_right(user_make_force(cubic_force, cubic_force_q, cubic_force_v, NULL));
  user_check_wrong(
    user_make_force(cubic_force, wrong_force_q, NULL, NULL),
    "force 1 \"spring\": force_q()[0][0] is 5 but finite differences of force give -5");
  user_check_wrong(
    user_make_force(cubic_force, cubic_force_q, user_no_force, NULL),
    "force 1 \"spring\": force_v()[0][1] is 0 but finite differences of force give -7");
}

/* ---- bodies ---- */

static int mass_of(double t, const double *q, double *out, void *user)
{
  (void)t;
  const double *wrong = user;
  out[0] = 2.0 + cos(q[0]);
  out[1] = 0.5 + wrong[0];
  out[2] = 0.5;
  out[3] = 1.0;
  return 0;
}

static baum_mechanism *make_body(double wrong[1], bool constant_mass, baum_force_fn *force_q,
                                 baum_force_fn *force_v)
{
  baum_mechanism *mechanism = create_mechanism();
  baum_coordinates_def def = baum_coordinates_def_default();
  def.name = "arm";
  def.size = 2;
  def.mass = mass_of;
  def.force = cubic_force;
  def.force_q = force_q;
  def.force_v = force_v;
  def.constant_mass = constant_mass;
  def.user = wrong;
  assert_int_equal(baum_mechanism_add_coordinates(mechanism, &def, NULL), BAUM_OK);
  return mechanism;
}

static void wrong_functions_of_a_body_are_named(void **state)
{
  (void)state;
  double wrong[1] = {0.0};
  user_check_right(make_body(wrong, false, cubic_force_q, cubic_force_v));
  user_check_wrong(make_body(wrong, false, wrong_force_q, NULL),
                   "body 1 \"arm\": force_q()[0][0] is 5 but finite differences of force give -5");
  user_check_wrong(make_body(wrong, false, NULL, user_no_force),
                   "body 1 \"arm\": force_v()[0][1] is 0 but finite differences of force give -7");
  wrong[0] = 1e-3;
  user_check_wrong(make_body(wrong, false, NULL, NULL),
                   "body 1 \"arm\": mass()[1][0] is 0.5 but mass()[0][1] is 0.501; the mass matrix "
                   "must be symmetric");
}

static void a_varying_mass_that_is_declared_constant_is_found(void **state)
{
  (void)state;
  double wrong[1] = {0.0};
  assert_int_equal(user_check(make_body(wrong, true, NULL, NULL)), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(),
                         "body 1 \"arm\": mass()[0][0] is 3 in the design configuration and 2.9"));
  assert_non_null(strstr(baum_message(), " near it, but constant_mass is true"));
}

/* Returns the mass q + *user. If *user is -2, the mass is negative in the design configuration, and
 * the check refuses it. If *user is 0.01, the mass is negative only for q < -0.01, and the check
 * accepts it. */
static int linear_mass(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = q[0] + *(const double *)user;
  return 0;
}

static void a_negative_mass_in_the_design_configuration_is_refused(void **state)
{
  (void)state;
  double at_zero[] = {-2.0, 0.01};
  for (int i = 0; i < 2; i++) {
    baum_mechanism *mechanism = create_mechanism();
    baum_coordinates_def def = baum_coordinates_def_default();
    def.name = "arm";
    def.size = 1;
    def.mass = linear_mass;
    def.force = user_no_force;
    def.user = at_zero + i;
    assert_int_equal(baum_mechanism_add_coordinates(mechanism, &def, NULL), BAUM_OK);
    if (i == 0) {
      user_check_wrong(
        mechanism, "body 1 \"arm\": mass()[0][0] is -2 in the design configuration, must be >= 0");
    } else {
      user_check_right(mechanism);
    }
  }
}

/* A constraint that is defined only for t >= 0. The check thus cannot use central differences at
 * t = 0. */
static int late_phi(double t, const double *q, double *out, void *user)
{
  (void)driven_phi(t, q, out, user);
  return t < 0.0 ? -1 : 0;
}

static void a_constraint_that_begins_at_zero_is_checked(void **state)
{
  (void)state;
  user_check_right(user_make_constraint(late_phi, driven_jacobian, right_nu, right_gamma, 1.0));
  char message[128];
  double nu = 6.0 * cos(3.0 * 0.37);
  (void)snprintf(message, sizeof message,
                 "joint 1 \"circle\": nu()[0] is %.9g but finite differences of phi in t give %.9g",
                 -nu, nu);
  user_check_wrong(user_make_constraint(late_phi, driven_jacobian, opposite_nu, right_gamma, 1.0),
                   message);
}

/* Law 0 is right. Law 1 has a wrong s', law 2 has a wrong s'', and law 3 always fails. */
static int driver_law(double t, double s[3], void *user)
{
  int which = *(const int *)user;
  s[0] = sin(3.0 * t);
  s[1] = 3.0 * cos(3.0 * t) + (which == 1 ? 0.5 : 0.0);
  s[2] = -9.0 * sin(3.0 * t) + (which == 2 ? 0.5 : 0.0);
  return which == 3 ? -1 : 0;
}

static baum_mechanism *make_driven(int *which)
{
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_body_def arm = baum_planar_body_def_default();
  baum_body_id body;
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &arm, &body), BAUM_OK);
  baum_driver_def motor = baum_driver_def_default();
  motor.name = "motor";
  motor.law = driver_law;
  motor.user = which;
  motor.joint = add_planar_pin(mechanism, NULL, BAUM_GROUND, body, 0.0, 0.0);
  assert_int_equal(baum_mechanism_add_driver(mechanism, &motor, NULL), BAUM_OK);
  return mechanism;
}

static void wrong_derivatives_of_a_driver_law_are_named(void **state)
{
  (void)state;
  int which[] = {0, 1, 2, 3};
  user_check_right(make_driven(which));
  user_check_wrong(make_driven(which + 1),
                   "joint 2 \"motor\": law()[1] is 3.5 but finite differences of law in t give 3");
  assert_int_equal(user_check(make_driven(which + 2)), BAUM_ERR_ARGUMENT);
  assert_non_null(
    strstr(baum_message(), "law()[2] is 0.5 but finite differences of law in t give"));
  user_check_right(make_driven(which + 3));
}

/* ---- how the check may be called ---- */

static void the_mechanism_must_be_given_and_frozen(void **state)
{
  (void)state;
  assert_int_equal(baum_mechanism_check_derivatives(NULL), BAUM_ERR_ARGUMENT);
  assert_string_equal(baum_message(), "baum_mechanism_check_derivatives: the mechanism is NULL");
  baum_mechanism *mechanism = create_mechanism();
  assert_int_equal(baum_mechanism_check_derivatives(mechanism), BAUM_ERR_STATE);
  assert_string_equal(baum_message(),
                      "baum_mechanism_check_derivatives: the mechanism is not frozen; call "
                      "baum_mechanism_freeze() first");
  baum_mechanism_destroy(mechanism);
}

static void a_mechanism_without_user_functions_passes(void **state)
{
  (void)state;
  baum_mechanism *mechanism = create_mechanism();
  baum_planar_body_def def = baum_planar_body_def_default();
  assert_int_equal(baum_mechanism_add_planar_body(mechanism, &def, NULL), BAUM_OK);
  user_check_right(mechanism);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_entry_that_is_wrong_by_a_ten_thousandth_is_named_in_any_unit),
    cmocka_unit_test(a_wrong_entry_of_the_jacobian_is_named),
    cmocka_unit_test(an_entry_that_is_right_in_the_design_configuration_only_is_found),
    cmocka_unit_test(an_entry_that_is_wrong_by_a_hundred_thousandth_is_found),
    cmocka_unit_test(nu_of_the_wrong_sign_is_named),
    cmocka_unit_test(a_forgotten_gamma_is_found_at_another_time),
    cmocka_unit_test(wrong_derivatives_of_a_force_are_named),
    cmocka_unit_test(wrong_functions_of_a_body_are_named),
    cmocka_unit_test(a_varying_mass_that_is_declared_constant_is_found),
    cmocka_unit_test(a_negative_mass_in_the_design_configuration_is_refused),
    cmocka_unit_test(a_constraint_that_begins_at_zero_is_checked),
    cmocka_unit_test(wrong_derivatives_of_a_driver_law_are_named),
    cmocka_unit_test(the_mechanism_must_be_given_and_frozen),
    cmocka_unit_test(a_mechanism_without_user_functions_passes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
