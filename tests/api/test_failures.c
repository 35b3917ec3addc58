/* SPDX-License-Identifier: BSD-3-Clause */
/* Every failure that ends a run early must have a message. The message must contain the time, the
 * last good step, a joint or body, and advice. The last good step must stay readable, and another
 * run must be able to continue from it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "check.h"
#include "construct.h"
#include "driven.h"
#include "every_element.h"
#include "runs.h"
#include "step_mode.h"

/* ---- a pendulum with a force that can go wrong ---- */

typedef enum fault {
  FAULT_NONE,
  FAULT_STOPS,   /* the force returns "stop" */
  FAULT_RETRIES, /* at every call, the force returns "retry with a smaller step" */
  FAULT_RETRIES_ONCE,
  FAULT_NAN,
  FAULT_NOISE, /* the force is large and varies at random from place to place */
  /* The force grows without bound, so that the motion becomes infinite in finite time. */
  FAULT_GROWTH,
  FAULT_COUNT
} fault;

static const double AFTER = 0.1; /* [s] time of the first fault */

/* Returns a large pseudo-random number that depends on the bits of x. */
static double noise(double x)
{
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  bits = (bits ^ (bits >> 29)) * UINT64_C(0xbf58476d1ce4e5b9);
  return 1e20 * ((double)(bits >> 11) * 0x1p-53 - 0.5);
}

static int force(double t, const double *q, const double *v, const double *inputs, double *out,
                 void *user)
{
  fault *now = user;
  (void)inputs;
  out[0] = 0.0;
  out[1] = 0.0;
  if (t <= AFTER) {
    return 0;
  }
  switch (*now) {
  case FAULT_STOPS: return -3;
  case FAULT_RETRIES: return 2;
  case FAULT_RETRIES_ONCE: *now = FAULT_NONE; return 2;
  case FAULT_NAN: out[0] = (double)NAN; break;
  case FAULT_NOISE: out[0] = noise(q[0] + t); break;
  case FAULT_GROWTH: /* depends on the velocity, which the definition denies */
    out[0] = 1e3 * v[0] * (v[0] * v[0] + v[1] * v[1]);
    out[1] = 1e3 * v[1] * (v[0] * v[0] + v[1] * v[1]);
    break;
  case FAULT_NONE:
  case FAULT_COUNT:
  default: break;
  }
  return 0;
}

static baum_mechanism *pendulum(fault *user)
{
  baum_mechanism *m = create_mechanism();
  baum_planar_particle_def bob = baum_planar_particle_def_default();
  bob.name = "bob";
  bob.position[0] = 1.0;
  baum_body_id body;
  assert_int_equal(baum_mechanism_add_planar_particle(m, &bob, &body), BAUM_OK);
  baum_planar_distance_def rod = baum_planar_distance_def_default();
  rod.name = "rod";
  rod.body_a = BAUM_GROUND;
  rod.body_b = body;
  rod.point_a[0] = 0.0;
  rod.point_a[1] = 0.0;
  rod.point_b[0] = 0.0;
  rod.point_b[1] = 0.0;
  assert_int_equal(baum_mechanism_add_planar_distance(m, &rod, NULL), BAUM_OK);
  baum_user_force_def f = baum_user_force_def_default();
  f.depends_on_velocity = false;
  f.name = "gust";
  f.bodies = &body;
  f.body_count = 1;
  f.force = force;
  f.depends_on_velocity = false;
  f.user = user;
  assert_int_equal(baum_mechanism_add_user_force(m, &f, NULL), BAUM_OK);
  assert_int_equal(baum_mechanism_freeze(m), BAUM_OK);
  return m;
}

/* Makes a slider-crank with a driven crank. Its rod is too short for a full revolution. */
static baum_mechanism *locking_crank(void)
{
  const drive motor = {.angle = 0.4, .rate = 1.0};
  const slider_crank data = {0.3, 0.1501, 0.05, 1, motor};
  return slider_crank_make(&data);
}

/* ---- failures and their messages ---- */

enum { CONVERGENCE = 1, STEP = 2, NOT_FINITE = 4, SINGULAR = 8, CALLBACK = 16 };

static int flag_of(baum_status status)
{
  switch ((int)status) {
  case BAUM_ERR_CONVERGENCE: return CONVERGENCE;
  case BAUM_ERR_STEP: return STEP;
  case BAUM_ERR_NOT_FINITE: return NOT_FINITE;
  case BAUM_ERR_SINGULAR: return SINGULAR;
  case BAUM_ERR_CALLBACK: return CALLBACK;
  default: return 0;
  }
}

typedef struct expectation {
  fault fault;         /* FAULT_COUNT stands for the crank that locks */
  int statuses;        /* flags of statuses; one of these statuses must occur */
  const char *element; /* the part of the message that names an element */
  const char *words;   /* another part of the message */
} expectation;

static const expectation EXPECTED[] = {
  {FAULT_STOPS, CALLBACK, "\"gust\"", "returned -3 (stop)"},
  {FAULT_RETRIES, CALLBACK, "\"gust\"", "returned 2 (retry)"},
  {FAULT_NAN, NOT_FINITE, "\"gust\"", "is nan at t = "},
  {FAULT_NOISE, NOT_FINITE | CONVERGENCE | STEP, "\"rod\"", "at the last good step, t = "},
  /* With a fixed step, the force may become infinite instead. The message then names the force. */
  {FAULT_GROWTH, NOT_FINITE | CONVERGENCE | STEP, "\"rod\"", "at the last good step, t = "},
  {FAULT_COUNT, NOT_FINITE | CONVERGENCE | STEP | SINGULAR, "joint ",
   "at the last good step, t = "},
};
enum { EXPECTATIONS = sizeof EXPECTED / sizeof *EXPECTED };

/* Tells whether a message names a singular configuration as a possible cause. */
static bool tells_of_locking(const char *message)
{
  return strstr(message, "locks up") || strstr(message, "lock up") || strstr(message, "singular");
}

/* Checks that the message has the time, the last good step, an element and advice. */
static void check_sentence(const baum_simulation *run, const expectation *e, const char *name)
{
  const char *message = baum_simulation_message(run);
  bool fine = strstr(message, "t = ") && strstr(message, e->element) && strstr(message, e->words) &&
              strlen(message) < 1000;
  bool advises = strstr(message, "take ") || strstr(message, "look at") ||
                 strstr(message, "another step") || strstr(message, "correct a user function") ||
                 e->statuses == CALLBACK;
  advises = advises && (e->fault != FAULT_COUNT || tells_of_locking(message));
  if (!fine || !advises) {
    fail_msg("%s, fault %d: %s", name, e->fault, message);
  }
}

static bool reached(baum_status status)
{
  return status == BAUM_OK || status == BAUM_WARNED;
}

/* Tells whether the state is still near the constraint and slow. In a run that fails with fixed
 * steps, the pendulum may have left the constraint, or it may move too fast for any step. */
static bool is_still_a_pendulum(const baum_simulation *run)
{
  const double *q = baum_simulation_q(run);
  const double *v = baum_simulation_v(run);
  return fabs(hypot(q[0], q[1]) - 1.0) < 0.1 && hypot(v[0], v[1]) < 10.0;
}

/* When the fault is over, another method must be able to continue from the state of the run. The
 * run itself must also continue. */
static void check_goes_on(baum_simulation *run, const baum_mechanism *mechanism)
{
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  baum_simulation *next = create_run(mechanism, &o);
  check(baum_simulation_continue(next, run));
  double t = baum_simulation_time(run);
  assert_true(baum_simulation_time(next) == t);
  assert_true(fabs(baum_simulation_q(next)[0] - baum_simulation_q(run)[0]) < 0.1);
  assert_true(reached(baum_simulation_advance_to(next, t + 0.01)));
  assert_true(reached(baum_simulation_advance_to(run, t + 0.01)));
  /* Both runs have advanced by 10 ms without a fault. Their states differ by the error of the less
   * accurate method. */
  assert_true(fabs(baum_simulation_q(next)[0] - baum_simulation_q(run)[0]) < 0.1);
  baum_simulation_destroy(next);
}

static void check_failure(const baum_simulation_options *o, const expectation *e)
{
  fault now = FAULT_NONE;
  char name[80];
  (void)snprintf(name, sizeof name, "%s %s %s", baum_integrator_name(o->integrator),
                 isnan(o->step) ? "variable" : "fixed", baum_formulation_name(o->formulation));
  baum_mechanism *m = e->fault == FAULT_COUNT ? locking_crank() : pendulum(&now);
  baum_simulation *run = create_run(m, o);
  now = e->fault;
  baum_status status = baum_simulation_advance_to(run, 2.0);
  double t = baum_simulation_time(run);
  if ((flag_of(status) & e->statuses) == 0) {
    fail_msg("%s, fault %d: %s at %g s: %s", name, e->fault, baum_status_name(status), t,
             baum_simulation_message(run));
  }
  bool infinite = strstr(baum_simulation_message(run), "inf at t = ");
  if (!(e->fault == FAULT_GROWTH && infinite)) {
    check_sentence(run, e, name);
  }
  assert_in_range(1e6 * t, 1, 1999999);
  assert_true(isfinite(baum_simulation_q(run)[0]) && isfinite(baum_simulation_v(run)[0]));
  now = FAULT_NONE;
  if (e->fault != FAULT_COUNT && is_still_a_pendulum(run)) {
    check_goes_on(run, m);
  }
  baum_simulation_destroy(run);
  baum_mechanism_destroy(m);
}

/* Tells whether a method may pass the fault without a failure. */
static bool gets_over(const baum_simulation_options *o, fault f)
{
  bool drifts =
    o->formulation == BAUM_FORMULATION_UNSTABILIZED || o->formulation == BAUM_FORMULATION_BAUMGARTE;
  if (!isnan(o->step)) {
    /* A run with fixed steps and without projection may leave the constraints and pass the dead
     * centre. */
    return drifts && (f == FAULT_NOISE || f == FAULT_COUNT);
  }
  /* IDA at index 3 does not test velocities. It therefore does not notice large forces. */
  return o->formulation == BAUM_FORMULATION_INDEX3 && (f == FAULT_NOISE || f == FAULT_GROWTH);
}

static void every_failure_names_time_place_and_remedy(void **state)
{
  (void)state;
  int checked = 0;
  for (int i = 0; step_mode_at(i).integrator; i++) {
    step_mode mode = step_mode_at(i);
    for (int f = BAUM_FORMULATION_UNSTABILIZED; f <= BAUM_FORMULATION_INDEX3; f++) {
      baum_formulation formulation = (baum_formulation)f;
      if (!baum_integrator_offers(mode.integrator, formulation)) {
        continue;
      }
      double rtol = formulation == BAUM_FORMULATION_INDEX3 ? 1e-4 : 1e-6;
      baum_simulation_options o = step_mode_options(mode, 1e-3, rtol);
      o.formulation = formulation;
      for (int k = 0; k < EXPECTATIONS; k++) {
        if (!gets_over(&o, EXPECTED[k].fault)) {
          check_failure(&o, &EXPECTED[k]);
          checked++;
        }
      }
    }
  }
  assert_true(checked > 100);
}

static void a_failure_that_a_method_overcomes_leaves_no_message(void **state)
{
  (void)state;
  for (int i = 0; step_mode_at(i).integrator; i++) {
    step_mode mode = step_mode_at(i);
    fault now = FAULT_NONE;
    baum_mechanism *m = pendulum(&now);
    baum_simulation_options o = step_mode_options(mode, 1e-3, 1e-6);
    baum_simulation *run = create_run(m, &o);
    now = FAULT_RETRIES_ONCE;
    assert_int_equal(baum_simulation_advance_to(NULL, 0.2), BAUM_ERR_ARGUMENT);
    if (baum_simulation_advance_to(run, 0.2) == BAUM_OK) {
      assert_int_equal(now, FAULT_NONE);
      assert_non_null(strstr(baum_message(), "the simulation is NULL"));
    } else {
      assert_true(mode.fixed);
    }
    baum_simulation_destroy(run);
    baum_mechanism_destroy(m);
  }
}

static void tolerances_below_rounding_end_the_run(void **state)
{
  (void)state;
  fault none = FAULT_NONE;
  baum_mechanism *m = pendulum(&none);
  for (int i = 0; step_mode_at(i).integrator; i++) {
    step_mode mode = step_mode_at(i);
    if (mode.fixed) {
      continue;
    }
    baum_simulation_options o = step_mode_options(mode, 1e-3, 1e-18);
    baum_simulation *run = NULL;
    baum_status status = baum_simulation_create(m, &o, &run);
    status = status >= BAUM_OK ? baum_simulation_advance_to(run, 1.0) : status;
    assert_int_equal(status, BAUM_ERR_STEP);
    assert_non_null(strstr(baum_message(), "more digits than double precision has; raise rtol"));
    assert_non_null(strstr(baum_message(), "t = 0 s"));
    baum_simulation_destroy(run);
  }
  baum_mechanism_destroy(m);
}

/* ---- continuing from another run ---- */

static void inputs_and_laws_continue_after_a_failure(void **state)
{
  (void)state;
  every_element parts = every_element_make(NULL);
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  baum_simulation *runs[2] = {NULL, NULL};
  for (int k = 0; k < 2; k++) {
    assert_int_equal(baum_simulation_create(parts.mechanism, &o, &runs[k]), BAUM_OK);
  }
  assert_true(reached(baum_simulation_advance_to(runs[0], 0.02)));
  assert_int_equal(baum_simulation_set_input(runs[0], parts.throttle, 0.25), BAUM_OK);
  assert_int_equal(baum_simulation_set_driver(runs[0], parts.motor, 0.5403, 2.006, 5.0), BAUM_OK);
  check(baum_simulation_continue(runs[1], runs[0]));
  assert_true(baum_simulation_input(runs[1], parts.throttle) == 0.25);
  for (int k = 0; k < 2; k++) {
    assert_true(reached(baum_simulation_advance_to(runs[k], 0.05)));
  }
  /* The continued run is assembled, which changes the state by rounding errors. */
  assert_true(fabs(baum_simulation_q(runs[1])[2] - baum_simulation_q(runs[0])[2]) < 1e-9);
  double driven = 0.5403 + 0.03 * (2.006 + 0.03 * 2.5);
  const baum_channel angle = baum_channel_of_joint(BAUM_JOINT_COORDINATE, parts.pin);
  double coordinate[2];
  assert_int_equal(baum_simulation_get(runs[1], &angle, 1, coordinate), BAUM_OK);
  /* The state is projected, so that only rounding errors remain. */
  assert_true(fabs(coordinate[0] - driven) < 1e-9);
  for (int k = 0; k < 2; k++) {
    baum_simulation_destroy(runs[k]);
  }
  baum_mechanism_destroy(parts.mechanism);
}

static void only_runs_of_the_same_mechanism_go_on(void **state)
{
  (void)state;
  fault none = FAULT_NONE;
  baum_mechanism *m[2] = {pendulum(&none), locking_crank()};
  baum_simulation_options o = baum_simulation_options_default();
  o.integrator = baum_rk4();
  o.step = 1e-3;
  baum_simulation *runs[2] = {NULL, NULL};
  for (int k = 0; k < 2; k++) {
    assert_int_equal(baum_simulation_create(m[k], &o, &runs[k]), BAUM_OK);
  }
  assert_int_equal(baum_simulation_continue(NULL, runs[0]), BAUM_ERR_ARGUMENT);
  assert_int_equal(baum_simulation_continue(runs[0], NULL), BAUM_ERR_ARGUMENT);
  assert_true(reached(baum_simulation_advance_to(runs[1], 0.1)));
  assert_int_equal(baum_simulation_continue(runs[0], runs[1]), BAUM_ERR_ARGUMENT);
  assert_non_null(strstr(baum_message(), "different mechanisms; baum_workspace_project()"));
  assert_true(baum_simulation_time(runs[0]) == 0.0);
  for (int k = 0; k < 2; k++) {
    baum_simulation_destroy(runs[k]);
    baum_mechanism_destroy(m[k]);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_failure_names_time_place_and_remedy),
    cmocka_unit_test(a_failure_that_a_method_overcomes_leaves_no_message),
    cmocka_unit_test(tolerances_below_rounding_end_the_run),
    cmocka_unit_test(inputs_and_laws_continue_after_a_failure),
    cmocka_unit_test(only_runs_of_the_same_mechanism_go_on),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
