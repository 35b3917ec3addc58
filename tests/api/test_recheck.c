/* SPDX-License-Identifier: BSD-3-Clause */
/* The library checks the derivatives of user functions at the start of a run, and again at states
 * that the run reaches. In these tests, the functions are right wherever the check at the start
 * evaluates them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "check.h"
#include "construct.h"
#include "runs.h"
#include "step_mode.h"

/* A rod of length l = 1 + 0.1 sin t. From the time `late` on, J is multiplied by `jacobian`, and
 * gamma by `gamma`. If `profile` is true, the length is instead constant until t = 1 and has a
 * constant acceleration afterwards. */
typedef struct rod {
  double late;
  double jacobian;
  double gamma;
  bool profile;
  long calls;
} rod;

static void length(const rod *r, double t, double l[3])
{
  double late = t > 1.0 ? t - 1.0 : 0.0;
  l[0] = r->profile ? 1.0 + 0.5 * late * late : 1.0 + 0.1 * sin(t);
  l[1] = r->profile ? late : 0.1 * cos(t);
  l[2] = r->profile ? (t >= 1.0 ? 1.0 : 0.0) : -0.1 * sin(t);
}

static int phi(double t, const double *q, double *out, void *user)
{
  rod *r = user;
  double l[3];
  length(r, t, l);
  r->calls++;
  out[0] = 0.5 * (q[0] * q[0] + q[1] * q[1] - l[0] * l[0]);
  return 0;
}

static int jacobian(double t, const double *q, double *out, void *user)
{
  const rod *r = user;
  out[0] = q[0];
  out[1] = q[1] * (t > r->late ? r->jacobian : 1.0);
  return 0;
}

static int gamma_of(double t, const double *q, const double *v, double *out, void *user)
{
  const rod *r = user;
  double l[3];
  (void)q;
  length(r, t, l);
  out[0] = -v[0] * v[0] - v[1] * v[1] + l[1] * l[1] + l[0] * l[2];
  out[0] *= t > r->late ? r->gamma : 1.0;
  return 0;
}

static baum_mechanism *make_rod(rod *r, bool with_jacobian)
{
  baum_body_id bob;
  baum_planar_particle_def particle = baum_planar_particle_def_default();
  baum_user_constraint_def def = baum_user_constraint_def_default();
  baum_mechanism *m = create_mechanism();
  particle.position[0] = 1.0;
  assert_int_equal(baum_mechanism_add_planar_particle(m, &particle, &bob), BAUM_OK);
  def.name = "rod";
  def.bodies = &bob;
  def.body_count = 1;
  def.row_count = 1;
  def.phi = phi;
  def.jacobian = with_jacobian ? jacobian : NULL;
  def.gamma = gamma_of;
  def.user = r;
  assert_int_equal(baum_mechanism_add_user_constraint(m, &def, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

static baum_simulation *start(const baum_mechanism *m, const baum_integrator *integrator,
                              bool fixed, bool checks)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = integrator;
  o.check_derivatives = checks;
  if (fixed) {
    o.step = 0.01;
  } else {
    o.rtol = 1e-8;
  }
  return create_run(m, &o);
}

static void require_warning(const baum_simulation *run, const char *what)
{
  baum_warning warning;
  assert_int_equal(baum_simulation_warning(run, 0, &warning, sizeof warning), BAUM_OK);
  assert_int_equal(warning.code, BAUM_WARNING_WRONG_DERIVATIVE);
  assert_true(warning.doubts_motion);
  assert_true(warning.joint.index1 == 1 && warning.first > 2.0 && warning.count == 1);
  assert_non_null(strstr(warning.text, what));
}

static void a_derivative_that_is_wrong_late_in_the_run_is_a_warning(void **state)
{
  (void)state;
  const baum_integrator *const methods[] = {baum_rk8(), baum_dp5(), baum_rk4(), baum_ab2()};
  for (int k = 0; k < 8; k++) {
    rod r = {.late = 2.0, .jacobian = 1.0, .gamma = 2.0};
    baum_mechanism *m = make_rod(&r, k < 4);
    baum_simulation *run = start(m, methods[k % 4], k % 4 >= 2, true);
    assert_int_equal(baum_simulation_advance_to(run, 2.0), BAUM_OK);
    assert_int_equal(baum_simulation_advance_to(run, 4.0), BAUM_WARNED);
    require_warning(run, "joint 1 \"rod\": gamma()[0] is ");
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

/* A call ends at t = 1, where the second derivative of the length jumps. */
static void a_jump_of_a_second_derivative_is_no_warning(void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++) {
    rod r = {.late = 9.0, .jacobian = 1.0, .gamma = 1.0, .profile = true};
    baum_mechanism *m = make_rod(&r, k == 1);
    baum_simulation *run = start(m, baum_rk4(), true, true);
    for (int n = 1; n <= 3; n++) {
      assert_int_equal(baum_simulation_advance_to(run, n), BAUM_OK);
    }
    assert_int_equal(counters_of(run).warnings, 0);
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

static void the_checks_do_not_change_the_motion_and_cost_little(void **state)
{
  (void)state;
  for (int k = 0; step_mode_at(k).integrator; k++) {
    step_mode mode = step_mode_at(k);
    double end[2][4];
    long calls[2];
    baum_counters counters[2];
    for (int checks = 0; checks < 2; checks++) {
      rod r = {.late = 99.0, .jacobian = 1.0, .gamma = 1.0};
      baum_mechanism *m = make_rod(&r, true);
      baum_simulation *run = start(m, mode.integrator, mode.fixed, checks == 1);
      r.calls = 0;
      (void)baum_simulation_advance_to(run, 6.0); /* the Euler method diverges after 7 s */
      calls[checks] = r.calls;
      memcpy(end[checks], baum_simulation_q(run), 2 * sizeof(double));
      memcpy(end[checks] + 2, baum_simulation_v(run), 2 * sizeof(double));
      counters[checks] = counters_of(run);
      counters[checks].wall = 0.0;
      baum_simulation_destroy(run);
      baum_mechanism_destroy(m);
    }
    assert_memory_equal(end[0], end[1], sizeof end[0]);
    assert_true(counters[0].evaluations == counters[1].evaluations);
    assert_true(counters[0].steps == counters[1].steps && counters[0].steps > 30);
    assert_true(calls[1] > calls[0]);
    assert_true(calls[1] - calls[0] < 100);
  }
}

static void the_message_of_a_failure_names_a_wrong_derivative(void **state)
{
  (void)state;
  rod r = {.late = -1.0, .jacobian = -1.0, .gamma = 1.0};
  baum_mechanism *m = make_rod(&r, true);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_generalized_alpha();
  o.step = 0.2;
  o.check_derivatives = false;
  baum_simulation *run = create_run(m, &o);
  assert_int_equal(baum_simulation_advance_to(run, 9.0), BAUM_ERR_CONVERGENCE);
  assert_non_null(strstr(baum_message(), "; correct a user function: joint 1 \"rod\": jacobian()"));
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_derivative_that_is_wrong_late_in_the_run_is_a_warning),
    cmocka_unit_test(a_jump_of_a_second_derivative_is_no_warning),
    cmocka_unit_test(the_checks_do_not_change_the_motion_and_cost_little),
    cmocka_unit_test(the_message_of_a_failure_names_a_wrong_derivative),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
