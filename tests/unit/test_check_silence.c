/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of user derivatives must not report a right derivative as wrong. It must also not
 * report a derivative that it cannot judge because of rounding or a kink. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <baum/elements.h>

#include "user_check.h"

static void right_derivatives_pass_in_any_unit_and_at_any_rate(void **state)
{
  (void)state;
  const user_kind *const kinds[] = {&user_circle, &user_loop, &user_swing};
  const double sizes[] = {1e-6, 1e-3, 1.0, 1e3, 1e6};
  const double rates[] = {1e-3, 0.1, 1.0, 30.0, 1e3};
  for (int k = 0; k < 3 * 5 * 5; k++) {
    for (int given = GIVE_NOTHING; given <= GIVE_ALL; given++) {
      user_model model = {sizes[k / 5 % 5], rates[k % 5]};
      user_check_right(user_make(kinds[k / 25], &model, given));
    }
  }
}

/* The slope of the first term of Phi changes from -1 to 1 within 1e-6 of q0 = 0.6. Both coordinates
 * have the scale 1, which is a million times too large for q0. */
static int sharp_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = sqrt(1e-12 + (q[0] - 0.6) * (q[0] - 0.6)) - 1e-6 * sin(q[1]);
  return 0;
}

static int sharp_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = (q[0] - 0.6) / sqrt(1e-12 + (q[0] - 0.6) * (q[0] - 0.6));
  out[1] = -1e-6 * cos(q[1]);
  return 0;
}

static void a_scale_that_is_wrong_by_a_million_raises_no_alarm(void **state)
{
  (void)state;
  user_check_right(user_make_constraint(sharp_phi, sharp_jacobian, NULL, NULL, 1.0));
}

/* Terms of 1e12 are added to Phi and subtracted again, so that Phi is rounded to 1e-4. Differences
 * therefore cannot determine the second entry of the Jacobian, which is 1e-3 cos q1. */
static int faint_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = (1e12 + 1e6 * q[0] + 1e-3 * sin(q[1])) - 1e12;
  return 0;
}

static int faint_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 1e6;
  out[1] = 1e-3 * cos(q[1]);
  return 0;
}

static void errors_hidden_by_rounding_raise_no_alarm(void **state)
{
  (void)state;
  user_check_right(user_make_constraint(faint_phi, faint_jacobian, NULL, NULL, 1.0));
}

/* The circle x^2 + y^2 = 1. */
static int circle_phi(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = q[0] * q[0] + q[1] * q[1] - 1.0;
  return 0;
}

static int circle_jacobian(double t, const double *q, double *out, void *user)
{
  (void)t;
  (void)user;
  out[0] = 2.0 * q[0];
  out[1] = 2.0 * q[1];
  return 0;
}

static int circle_gamma(double t, const double *q, const double *v, double *out, void *user)
{
  (void)t;
  (void)q;
  (void)user;
  out[0] = -2.0 * (v[0] * v[0] + v[1] * v[1]);
  return 0;
}

/* Projection leaves rounding errors of about 1e-16 in the velocities of a mechanism at rest. They
 * are too small to change q, whatever the time step. */
static void velocities_that_are_rounding_raise_no_alarm(void **state)
{
  (void)state;
  const double v[2] = {4e-16, -1e-16};
  baum_coordinates_def def;
  baum_mechanism *m = user_make_constraint(circle_phi, circle_jacobian, NULL, circle_gamma, 1.0);
  baum_body_id body = baum_mechanism_body_at(m, 0);
  assert_int_equal(baum_mechanism_get_coordinates(m, body, &def, sizeof def), BAUM_OK);
  def.v = v;
  assert_int_equal(baum_mechanism_set_coordinates(m, body, &def), BAUM_OK);
  user_check_right(m);
}

/* The force of a contact that just touches, and dry friction at rest. Neither is differentiable in
 * this state. */
static int kinked_force(double t, const double *q, const double *v, const double *inputs,
                        double *out, void *user)
{
  (void)t;
  (void)inputs;
  (void)user;
  out[0] = q[0] < 0.0 ? -1000.0 * q[0] : 0.0;
  out[1] = v[1] > 0.0 ? -2.0 : v[1] < 0.0 ? 2.0 : 0.0;
  return 0;
}

static int kinked_force_q(double t, const double *q, const double *v, const double *inputs,
                          double *out, void *user)
{
  (void)t;
  (void)v;
  (void)inputs;
  (void)user;
  out[0] = q[0] < 0.0 ? -1000.0 : 0.0;
  return 0;
}

static void a_kink_in_the_design_configuration_raises_no_alarm(void **state)
{
  (void)state;
  user_check_right(user_make_force(kinked_force, kinked_force_q, user_no_force, NULL));
}

/* ---- refusals ---- */

typedef enum refuse { NEVER, BEFORE_ZERO, AT_REST, AWAY, ALWAYS, STOP } refuse;

static int refusing_force(double t, const double *q, const double *v, const double *inputs,
                          double *out, void *user)
{
  (void)inputs;
  refuse refusal = *(refuse *)user;
  if (refusal == STOP) {
    return -1;
  }
  if (refusal == ALWAYS || (refusal == AWAY && fabs(q[0]) > 0.03) ||
      (refusal == BEFORE_ZERO && t < 0.0)) {
    return 1;
  }
  double speed = hypot(v[0], v[1]);
  out[0] = refusal == AT_REST ? v[0] / speed : v[0];
  return 0;
}

static int refusing_force_v(double t, const double *q, const double *v, const double *inputs,
                            double *out, void *user)
{
  (void)t;
  (void)q;
  (void)inputs;
  refuse refusal = *(refuse *)user;
  double speed = hypot(v[0], v[1]);
  out[0] = refusal == AT_REST ? v[1] * v[1] / (speed * speed * speed) : 1.0;
  out[1] = refusal == AT_REST ? -v[0] * v[1] / (speed * speed * speed) : 0.0;
  return 0;
}

static void refused_configurations_raise_no_alarm(void **state)
{
  (void)state;
  const refuse passing[] = {NEVER, BEFORE_ZERO, AT_REST, AWAY};
  for (int i = 0; i < 4; i++) {
    refuse refusal = passing[i];
    user_check_right(user_make_force(refusing_force, NULL, refusing_force_v, &refusal));
  }
}

static void a_function_that_refuses_everywhere_is_reported(void **state)
{
  (void)state;
  refuse refusal = ALWAYS;
  assert_int_equal(user_check(user_make_force(refusing_force, NULL, refusing_force_v, &refusal)),
                   BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "force 1 \"spring\": force() returned 1 (retry)");
  refusal = STOP;
  assert_int_equal(user_check(user_make_force(refusing_force, NULL, refusing_force_v, &refusal)),
                   BAUM_ERR_CALLBACK);
  assert_string_equal(baum_message(), "force 1 \"spring\": force() returned -1 (stop)");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(right_derivatives_pass_in_any_unit_and_at_any_rate),
    cmocka_unit_test(a_scale_that_is_wrong_by_a_million_raises_no_alarm),
    cmocka_unit_test(errors_hidden_by_rounding_raise_no_alarm),
    cmocka_unit_test(velocities_that_are_rounding_raise_no_alarm),
    cmocka_unit_test(a_kink_in_the_design_configuration_raises_no_alarm),
    cmocka_unit_test(refused_configurations_raise_no_alarm),
    cmocka_unit_test(a_function_that_refuses_everywhere_is_reported),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
