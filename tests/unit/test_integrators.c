/* SPDX-License-Identifier: BSD-3-Clause */
/* The same battery for every integrator of this build, and the facts that they tell about themselves. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "integrator_run.h"

/* ---- facts ---- */

typedef struct facts {
  const char *name;
  int order; /* 0: variable */
  baum_formulation offered[4];
  baum_gain_rule gains;
} facts;

static const facts FACTS[] = {
  {"euler",
   1,
   {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED, BAUM_FORMULATION_PROJECTION},
   BAUM_GAINS_DEADBEAT},
  {"semi_implicit_euler",
   1,
   {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED, BAUM_FORMULATION_PROJECTION},
   BAUM_GAINS_DEADBEAT},
  {"rk2",
   2,
   {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED},
   BAUM_GAINS_AUTO},
  {"rk3",
   3,
   {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED},
   BAUM_GAINS_AUTO},
  {"rk4",
   4,
   {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED},
   BAUM_GAINS_AUTO},
  {"cvode_adams", 0, {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED}, BAUM_GAINS_AUTO},
  {"cvode_bdf", 0, {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED}, BAUM_GAINS_AUTO},
  {"ida",
   0,
   {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED, BAUM_FORMULATION_INDEX3},
   BAUM_GAINS_AUTO},
};

enum { COUNT = sizeof FACTS / sizeof FACTS[0] };

static void integrators_tell_name_order_and_step(void **state)
{
  (void)state;
  for (int k = 0; k < COUNT; k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    assert_string_equal(baum_integrator_name(integrator), FACTS[k].name);
    assert_int_equal(baum_integrator_order(integrator), FACTS[k].order);
    assert_int_equal(baum_integrator_has_fixed_step(integrator), FACTS[k].order > 0);
    assert_int_equal(integrator->gains, FACTS[k].gains);
    assert_int_equal(integrator->predicts_violation, k < 2);
  }
  assert_null(baum_integrator_at(COUNT));
  assert_null(baum_integrator_at(-1));
}

static void no_integrator_has_no_facts(void **state)
{
  (void)state;
  assert_null(baum_integrator_name(NULL));
  assert_int_equal(baum_integrator_order(NULL), 0);
  assert_false(baum_integrator_has_fixed_step(NULL));
  assert_false(baum_integrator_offers(NULL, BAUM_FORMULATION_BAUMGARTE));
}

static bool is_listed(const facts *fact, baum_formulation formulation)
{
  for (int i = 0; i < 4 && fact->offered[i]; i++) {
    if (fact->offered[i] == formulation) {
      return true;
    }
  }
  return formulation == BAUM_FORMULATION_DEFAULT;
}

static void integrators_offer_their_formulations_default_first(void **state)
{
  (void)state;
  for (int k = 0; k < COUNT; k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    for (int f = -1; f <= 8; f++) {
      baum_formulation formulation = (baum_formulation)f;
      assert_int_equal(baum_integrator_offers(integrator, formulation),
                       is_listed(&FACTS[k], formulation));
    }
    assert_int_equal(integrator->formulations[0], FACTS[k].offered[0]);
  }
}

static void formulations_have_names(void **state)
{
  (void)state;
  static const char *const NAMES[] = {"default", "unstabilized", "baumgarte", "projection",
                                      "index2",  "ggl",          "index3"};
  for (int f = 0; f < 7; f++) {
    assert_string_equal(baum_formulation_name((baum_formulation)f), NAMES[f]);
  }
  assert_null(baum_formulation_name((baum_formulation)7));
  assert_null(baum_formulation_name((baum_formulation)-1));
}

/* ---- what they work with ---- */

static void tolerances_grow_with_scale_and_speed_only(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_pendulum();
  double scale[2] = {mechanism->scale[0], mechanism->scale[1]};
  baum_workspace workspace = {.mechanism = mechanism};
  baum_i_problem problem = {.workspace = &workspace, .rtol = 1e-3, .atol = 1e-5, .rate = 2.0};
  double slow[2] = {0.5 * scale[0], 0.0};
  double fast[2] = {0.5 * scale[0], -7.0 * scale[1]};
  double q[2];
  double v[2];
  baum_i_problem_tolerances(&problem, slow, q, v);
  for (int i = 0; i < 2; i++) {
    ASSERT_NEAR(q[i], 1e-3 * scale[i] + 1e-5, 1e-15, 0.0);
    ASSERT_NEAR(v[i], 2e-3 * scale[i] + 1e-5, 1e-15, 0.0);
  }
  baum_i_problem_tolerances(&problem, fast, q, v);
  ASSERT_NEAR(v[0], 7e-3 * scale[0] + 1e-5, 1e-15, 0.0);
  baum_mechanism_destroy(mechanism);
}

/* On the rod's line, away from the circle: Phi and Phi' are not zero, and lambda tells the gains. */
static void gains_follow_formulation_and_direction(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_pendulum();
  baum_workspace *w = NULL;
  assert_int_equal(baum_workspace_create(mechanism, &w), BAUM_OK);
  double q[2] = {1.1, 0.0};
  double v[2] = {0.3, 1.0};
  static const baum_formulation FORMS[] = {BAUM_FORMULATION_UNSTABILIZED,
                                           BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_INDEX3,
                                           BAUM_FORMULATION_BAUMGARTE};
  for (int k = 0; k < 4; k++) {
    for (int sign = -1; sign <= 1; sign += 2) {
      baum_i_problem problem = {
        .workspace = w, .formulation = FORMS[k], .alpha = 3.0, .beta = 5.0, .direction = sign};
      double alpha = k == 3 ? 3.0 * sign : 0.0;
      double beta = k == 3 ? 5.0 : 0.0;
      assert_int_equal(baum_i_problem_acceleration(&problem, 0.0, q, v), BAUM_OK);
      double a = w->a[0];
      assert_int_equal(baum_i_acceleration(w, 0.0, q, v, alpha, beta), BAUM_OK);
      ASSERT_NEAR(a, w->a[0], 0.0, 0.0);
    }
  }
  baum_workspace_destroy(w);
  baum_mechanism_destroy(mechanism);
}

/* ---- stability from outside ---- */

static void stability_comes_from_the_integrators_own_description(void **state)
{
  (void)state;
  baum_amplification out;
  /* The Taylor choice with explicit Euler: z^2 + 1 = 0; with semi-implicit Euler z^2 + 2 z - 1. */
  assert_int_equal(baum_stability_at(baum_euler(), 1.0, 2.0, &out, sizeof out), BAUM_OK);
  assert_int_equal(out.stability, BAUM_MARGINAL);
  ASSERT_NEAR(out.spectral_radius, 1.0, 1e-15, 0.0);
  assert_int_equal(out.struct_size, sizeof out);
  assert_int_equal(baum_stability_at(baum_semi_implicit_euler(), 1.0, 2.0, &out, sizeof out),
                   BAUM_OK);
  assert_int_equal(out.stability, BAUM_UNSTABLE);
  ASSERT_NEAR(out.spectral_radius, 1.0 + sqrt(2.0), 1e-15, 0.0);
  assert_int_equal(baum_stability_at(baum_ida(), 1.0, 2.0, &out, sizeof out), BAUM_OK);
  assert_int_equal(out.stability, BAUM_VARIABLE_STEP);
  assert_true(isnan(out.spectral_radius));
  double limit = 0.0;
  assert_int_equal(baum_stability_limit(baum_rk4(), 1.0, &limit), BAUM_OK);
  ASSERT_NEAR(limit, 2.785293563405282, 1e-12, 0.0); /* real limit of the classical method */
  double good[2];
  assert_int_equal(baum_stability_deadbeat(baum_semi_implicit_euler(), &good[0], &good[1]),
                   BAUM_OK);
  ASSERT_NEAR(good[0], 0.5, 1e-15, 0.0);
  ASSERT_NEAR(good[1], 1.0, 1e-15, 0.0);
  assert_int_equal(baum_stability_nearest(baum_euler(), 1.0, 1.0, &good[0], &good[1]), BAUM_OK);
  ASSERT_NEAR(good[0], 1.0, 0.0, 0.0);
  ASSERT_NEAR(good[1], 1.0, 0.0, 0.0);
}

static void amplification_is_cut_to_the_callers_size(void **state)
{
  (void)state;
  unsigned char bytes[sizeof(baum_amplification) + 8];
  baum_amplification *out = (baum_amplification *)(void *)bytes;
  for (size_t size = sizeof(size_t); size <= sizeof bytes; size++) {
    memset(bytes, 0x5a, sizeof bytes);
    assert_int_equal(baum_stability_at(baum_euler(), 1.0, 1.0, out, size), BAUM_OK);
    size_t written = size < sizeof *out ? size : sizeof *out;
    assert_int_equal(out->struct_size, written);
    for (size_t i = written; i < sizeof bytes; i++) {
      assert_int_equal(bytes[i], 0x5a);
    }
  }
}

#define ASSERT_REFUSED(call, want, sentence)         \
  do {                                               \
    assert_int_equal((call), (want));                \
    assert_string_equal(baum_message(), (sentence)); \
  } while (0)

static void wrong_arguments_are_refused_with_the_argument(void **state)
{
  (void)state;
  baum_amplification out;
  double x = 7.0;
  double y = 7.0;
  const baum_integrator *e = baum_euler();
  ASSERT_REFUSED(baum_stability_at(NULL, 1.0, 1.0, &out, sizeof out), BAUM_ERR_ARGUMENT,
                 "integrator is NULL, must be one such as baum_euler()");
  ASSERT_REFUSED(baum_stability_at(e, (double)NAN, 1.0, &out, sizeof out), BAUM_ERR_ARGUMENT,
                 "alpha_h is nan, must be finite");
  ASSERT_REFUSED(baum_stability_at(e, 1.0, (double)INFINITY, &out, sizeof out), BAUM_ERR_ARGUMENT,
                 "beta2_h2 is inf, must be finite");
  ASSERT_REFUSED(baum_stability_at(e, 1.0, 1.0, NULL, sizeof out), BAUM_ERR_ARGUMENT,
                 "out is NULL");
  ASSERT_REFUSED(baum_stability_at(e, 1.0, 1.0, &out, 3), BAUM_ERR_ARGUMENT,
                 "caller_size is 3, must be sizeof *out");
  ASSERT_REFUSED(baum_stability_limit(NULL, 1.0, &x), BAUM_ERR_ARGUMENT,
                 "integrator is NULL, must be one such as baum_euler()");
  ASSERT_REFUSED(baum_stability_limit(e, 0.0, &x), BAUM_ERR_ARGUMENT,
                 "damping_ratio is 0, must be > 0 and finite");
  ASSERT_REFUSED(baum_stability_limit(e, (double)INFINITY, &x), BAUM_ERR_ARGUMENT,
                 "damping_ratio is inf, must be > 0 and finite");
  ASSERT_REFUSED(baum_stability_limit(e, 1.0, NULL), BAUM_ERR_ARGUMENT, "alpha_h is NULL");
  ASSERT_REFUSED(baum_stability_deadbeat(e, NULL, &y), BAUM_ERR_ARGUMENT, "alpha_h is NULL");
  ASSERT_REFUSED(baum_stability_deadbeat(e, &x, NULL), BAUM_ERR_ARGUMENT, "beta2_h2 is NULL");
  ASSERT_REFUSED(baum_stability_nearest(e, (double)NAN, 1.0, &x, &y), BAUM_ERR_ARGUMENT,
                 "alpha_h is nan, must be finite");
  ASSERT_REFUSED(baum_stability_nearest(e, 1.0, 1.0, NULL, &y), BAUM_ERR_ARGUMENT,
                 "good_alpha_h is NULL");
  ASSERT_REFUSED(baum_stability_nearest(e, 1.0, 1.0, &x, NULL), BAUM_ERR_ARGUMENT,
                 "good_beta2_h2 is NULL");
  const char *why = "cvode_bdf chooses its step, so it has no fixed region of stability";
  ASSERT_REFUSED(baum_stability_limit(baum_cvode_bdf(), 1.0, &x), BAUM_ERR_UNSUPPORTED, why);
  ASSERT_REFUSED(baum_stability_deadbeat(baum_cvode_bdf(), &x, &y), BAUM_ERR_UNSUPPORTED, why);
  ASSERT_REFUSED(baum_stability_nearest(baum_cvode_bdf(), 1.0, 1.0, &x, &y), BAUM_ERR_UNSUPPORTED,
                 why);
  assert_true(x == 7.0 && y == 7.0);
}

/* ---- the battery ---- */

typedef void battery_fn(const baum_integrator *integrator, baum_formulation formulation);

/* Every integrator of this build with each of its formulations. */
static void for_each(battery_fn *test)
{
  for (int k = 0; k < COUNT; k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    if (!integrator->step && !integrator->advance) {
      continue;
    }
    for (int f = 0; f < 4 && FACTS[k].offered[f]; f++) {
      test(integrator, FACTS[k].offered[f]);
    }
  }
}

/* Error at t, forward or backward. */
static double error_at(baum_mechanism *mechanism, const integrator_setup *setup, double t,
                       motion_fn *motion, double rate)
{
  integrator_run run;
  double q[2];
  double v[2];
  (void)mechanism;
  if (integrator_run_open(&run, setup) != BAUM_OK ||
      integrator_run_to(&run, setup->direction * t) != BAUM_OK) {
    fail_msg("%s: %s", setup->integrator->name, baum_message());
  }
  motion(setup->direction * t, q, v);
  double error = motion_error(2, run.q, run.v, q, v, rate);
  integrator_run_close(&run);
  return error;
}

/* What an integrator may be off after some time with rtol = 1e-6 or h = 1e-3; the motions here have rates of 2 to 6
 * 1/s, and index 3 is known to be far off. */
static double allowed(const integrator_setup *setup)
{
  static const double BY_ORDER[] = {2e-4, 5e-2, 3e-5, 3e-7, 3e-9};
  return setup->formulation == BAUM_FORMULATION_INDEX3
           ? 3e-2
           : BY_ORDER[baum_integrator_order(setup->integrator)];
}

static void check_motion(baum_mechanism *mechanism, const baum_integrator *integrator,
                         baum_formulation formulation, motion_fn *motion, double rate)
{
  integrator_setup setup = integrator_setup_make(mechanism, integrator, formulation);
  for (int sign = -1; sign <= 1; sign += 2) {
    setup.direction = sign;
    double error = error_at(mechanism, &setup, 2.0, motion, rate);
    if (!(error <= allowed(&setup))) {
      fail_msg("%s, %s, direction %d: error %.3g, allowed %.3g", integrator->name,
               baum_formulation_name(formulation), sign, error, allowed(&setup));
    }
  }
  baum_mechanism_destroy(mechanism);
}

static void throw_it(const baum_integrator *integrator, baum_formulation formulation)
{
  check_motion(make_throw(), integrator, formulation, throw_motion, 10.0);
}

static void oscillate(const baum_integrator *integrator, baum_formulation formulation)
{
  check_motion(make_oscillator(), integrator, formulation, oscillator_motion, 2.0);
}

static void swing(const baum_integrator *integrator, baum_formulation formulation)
{
  check_motion(make_pendulum(), integrator, formulation, pendulum_motion, 4.43);
}

static void a_thrown_point_falls_as_galileo_says(void **state)
{
  (void)state;
  for_each(throw_it);
}

static void an_oscillator_keeps_time(void **state)
{
  (void)state;
  for_each(oscillate);
}

static void a_pendulum_swings_both_ways_in_time(void **state)
{
  (void)state;
  for_each(swing);
}

/* Stops at once, or asks for smaller steps for ever; the state is that of the last good step. */
static void meet_fault(const baum_integrator *integrator, baum_formulation formulation)
{
  for (int answer = -1; answer <= 1; answer += 2) {
    force_fault fault = {.after = 0.7, .answer = answer};
    baum_mechanism *mechanism = make_faulty_pendulum(&fault);
    integrator_setup setup = integrator_setup_make(mechanism, integrator, formulation);
    integrator_run run;
    double q[2];
    double v[2];
    assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
    baum_status status = integrator_run_to(&run, 1.0);
    if (status != BAUM_ERR_CALLBACK || !strstr(baum_message(), "faulty")) {
      fail_msg("%s, %s, answer %d: %s: %s", integrator->name, baum_formulation_name(formulation),
               answer, baum_status_name(status), baum_message());
    }
    assert_true(run.state.t > 0.5 && run.state.t <= 0.7 + 1.001e-3);
    pendulum_motion(run.state.t, q, v);
    assert_true(motion_error(2, run.state_q, run.state_v, q, v, 4.43) <= allowed(&setup));
    integrator_run_close(&run);
    baum_mechanism_destroy(mechanism);
  }
}

static void a_failing_function_leaves_the_last_good_step(void **state)
{
  (void)state;
  for_each(meet_fault);
}

/* A function that stops is not called again in that step. */
static void stop_at_once(const baum_integrator *integrator, baum_formulation formulation)
{
  force_fault fault = {.after = 0.7, .answer = -1};
  baum_mechanism *mechanism = make_faulty_pendulum(&fault);
  integrator_setup setup = integrator_setup_make(mechanism, integrator, formulation);
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  while (integrator_run_step(&run) == BAUM_OK) {
    fault.calls = 0;
  }
  assert_true(fault.calls <= 16); /* of the failing step, most of them before the fault */
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void a_function_that_stops_is_left_alone(void **state)
{
  (void)state;
  for_each(stop_at_once);
}

/* Beginning anew after a failure, elsewhere in time, and turning round. */
static void begin_anew(const baum_integrator *integrator, baum_formulation formulation)
{
  if (!integrator->restart) {
    return;
  }
  force_fault fault = {.after = 0.7, .answer = -1};
  baum_mechanism *mechanism = make_faulty_pendulum(&fault);
  integrator_setup setup = integrator_setup_make(mechanism, integrator, formulation);
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  assert_int_equal(integrator_run_to(&run, 1.0), BAUM_ERR_CALLBACK);
  baum_i_statistics before;
  integrator->statistics(run.self, &before);
  fault.after = (double)INFINITY;
  double q[2];
  double v[2];
  pendulum_motion(0.0, q, v);
  assert_int_equal(integrator_run_restart(&run, 100.0, q, v, 1.0), BAUM_OK);
  assert_int_equal(integrator_run_to(&run, 101.0), BAUM_OK);
  pendulum_motion(1.0, q, v);
  assert_true(motion_error(2, run.q, run.v, q, v, 4.43) <= allowed(&setup));
  assert_int_equal(integrator_run_restart(&run, 1.0, q, v, -1.0), BAUM_OK);
  assert_int_equal(integrator_run_to(&run, 0.0), BAUM_OK);
  pendulum_motion(0.0, q, v);
  assert_true(motion_error(2, run.q, run.v, q, v, 4.43) <= allowed(&setup));
  baum_i_statistics after;
  integrator->statistics(run.self, &after);
  assert_true(after.nonlinear_iterations > before.nonlinear_iterations);
  assert_true(after.rejected >= before.rejected);
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void a_restart_begins_anew_after_a_failure_and_backwards(void **state)
{
  (void)state;
  for_each(begin_anew);
}

/* The next step after a failure goes on from the last good one. */
static void go_on(const baum_integrator *integrator, baum_formulation formulation)
{
  force_fault fault = {.after = 0.7, .answer = -1};
  baum_mechanism *mechanism = make_faulty_pendulum(&fault);
  integrator_setup setup = integrator_setup_make(mechanism, integrator, formulation);
  integrator_run run;
  double q[2];
  double v[2];
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  assert_int_equal(integrator_run_to(&run, 1.0), BAUM_ERR_CALLBACK);
  assert_int_equal(integrator_run_to(&run, 1.0), BAUM_ERR_CALLBACK);
  fault.after = (double)INFINITY;
  assert_int_equal(integrator_run_to(&run, 1.0), BAUM_OK);
  pendulum_motion(1.0, q, v);
  assert_true(motion_error(2, run.q, run.v, q, v, 4.43) <= allowed(&setup));
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void a_run_goes_on_when_what_failed_is_mended(void **state)
{
  (void)state;
  for_each(go_on);
}

/* Inside the last step and at its ends; outside it is refused. */
static void look_inside(const baum_integrator *integrator, baum_formulation formulation)
{
  if (!integrator->interpolate) {
    return;
  }
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup = integrator_setup_make(mechanism, integrator, formulation);
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  double begin = 0.0;
  while (run.state.t < 0.8) {
    begin = run.state.t;
    assert_int_equal(integrator_run_step(&run), BAUM_OK);
  }
  for (int k = 0; k <= 4; k++) {
    double t = begin + 0.25 * k * (run.state.t - begin);
    double q[2];
    double v[2];
    assert_int_equal(integrator->interpolate(run.self, &run.problem, t, run.q, run.v), BAUM_OK);
    pendulum_motion(t, q, v);
    assert_true(motion_error(2, run.q, run.v, q, v, 4.43) <= allowed(&setup));
  }
  ASSERT_NEAR(run.q[0], run.state_q[0], 0.0, 1e-14);
  assert_int_equal(integrator->interpolate(run.self, &run.problem, 3.0, run.q, run.v),
                   BAUM_ERR_INTEGRATOR);
  assert_non_null(strstr(baum_message(), integrator->name));
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void positions_inside_the_last_step_are_interpolated(void **state)
{
  (void)state;
  for_each(look_inside);
}

/* More digits than there are: refused as a matter of step size, at the start, with the advice. */
static void ask_too_much(const baum_integrator *integrator, baum_formulation formulation)
{
  if (!integrator->advance) {
    return;
  }
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup = integrator_setup_make(mechanism, integrator, formulation);
  setup.rtol = 1e-18;
  integrator_run run;
  assert_int_equal(integrator_run_open(&run, &setup), BAUM_OK);
  assert_int_equal(integrator_run_step(&run), BAUM_ERR_STEP);
  assert_non_null(strstr(baum_message(), "raise rtol"));
  assert_true(run.state.t == 0.0 && run.state_q[0] == 1.0);
  integrator_run_close(&run);
  baum_mechanism_destroy(mechanism);
}

static void too_small_tolerances_are_an_error_of_the_step(void **state)
{
  (void)state;
  for_each(ask_too_much);
}

/* ---- order ---- */

static double error_with_step(const baum_integrator *integrator, baum_formulation formulation,
                              double step)
{
  baum_mechanism *mechanism = make_pendulum();
  integrator_setup setup = integrator_setup_make(mechanism, integrator, formulation);
  setup.step = step;
  if (integrator->gains == BAUM_GAINS_DEADBEAT) {
    setup.gain = 0.5 / step; /* stable with both Eulers */
  }
  double error = error_at(mechanism, &setup, 1.6, pendulum_motion, 4.43);
  baum_mechanism_destroy(mechanism);
  return error;
}

/* Halving the step three times; coarse enough that rounding (1e-13) is far, fine enough for the leading term. */
static void observe_order(const baum_integrator *integrator, baum_formulation formulation)
{
  if (!integrator->step) {
    return;
  }
  double coarse = integrator->order == 1 ? 4e-4 : 4e-3;
  double first = error_with_step(integrator, formulation, coarse);
  double last = error_with_step(integrator, formulation, coarse / 8.0);
  double order = log2(first / last) / 3.0;
  if (!(fabs(order - integrator->order) <= 0.2)) {
    fail_msg("%s, %s: order %.3f observed, errors %.3g and %.3g", integrator->name,
             baum_formulation_name(formulation), order, first, last);
  }
}

static void fixed_step_methods_have_their_order(void **state)
{
  (void)state;
  for_each(observe_order);
}

/* ---- builds ---- */

static void without_sundials_its_integrators_refuse_by_name(void **state)
{
  (void)state;
  if (baum_has("sundials")) {
    skip();
  }
  for (int k = 5; k < COUNT; k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    int unwanted = 0;
    void *self = &unwanted;
    char sentence[128];
    (void)snprintf(sentence, sizeof sentence, "%s needs SUNDIALS, which this build does not have",
                   FACTS[k].name);
    ASSERT_REFUSED(integrator->create(NULL, NULL, &self), BAUM_ERR_UNSUPPORTED, sentence);
    assert_null(self);
    integrator->destroy(NULL);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(integrators_tell_name_order_and_step),
    cmocka_unit_test(no_integrator_has_no_facts),
    cmocka_unit_test(integrators_offer_their_formulations_default_first),
    cmocka_unit_test(formulations_have_names),
    cmocka_unit_test(tolerances_grow_with_scale_and_speed_only),
    cmocka_unit_test(gains_follow_formulation_and_direction),
    cmocka_unit_test(stability_comes_from_the_integrators_own_description),
    cmocka_unit_test(amplification_is_cut_to_the_callers_size),
    cmocka_unit_test(wrong_arguments_are_refused_with_the_argument),
    cmocka_unit_test(a_thrown_point_falls_as_galileo_says),
    cmocka_unit_test(an_oscillator_keeps_time),
    cmocka_unit_test(a_pendulum_swings_both_ways_in_time),
    cmocka_unit_test(a_failing_function_leaves_the_last_good_step),
    cmocka_unit_test(a_function_that_stops_is_left_alone),
    cmocka_unit_test(a_restart_begins_anew_after_a_failure_and_backwards),
    cmocka_unit_test(a_run_goes_on_when_what_failed_is_mended),
    cmocka_unit_test(positions_inside_the_last_step_are_interpolated),
    cmocka_unit_test(too_small_tolerances_are_an_error_of_the_step),
    cmocka_unit_test(fixed_step_methods_have_their_order),
    cmocka_unit_test(without_sundials_its_integrators_refuse_by_name),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
