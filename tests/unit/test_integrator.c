/* SPDX-License-Identifier: BSD-3-Clause */
/* Tests the properties of integrators, and the functions that all integrators use. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include <baum/baum.h>

#include "assert_near.h"
#include "integrator_run.h"

/* ---- properties ---- */

typedef struct facts {
  const char *name;
  int order; /* 0 if the order is variable */
  baum_formulation offered[6];
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
  {"dp5",
   5,
   {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED},
   BAUM_GAINS_AUTO},
  {"rk8",
   8,
   {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED},
   BAUM_GAINS_AUTO},
  {"ab2", 2, {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED}, BAUM_GAINS_BEST_DAMPING},
  {"ab3", 3, {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED}, BAUM_GAINS_BEST_DAMPING},
  {"ab4", 4, {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED}, BAUM_GAINS_BEST_DAMPING},
  {"rattle", 2, {BAUM_FORMULATION_INDEX3}, BAUM_GAINS_DEFAULT},
  {"generalized_alpha", 2, {BAUM_FORMULATION_INDEX3}, BAUM_GAINS_DEFAULT},
  {"cvode_adams", 0, {BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED}, BAUM_GAINS_AUTO},
  {"cvode_bdf",
   0,
   {BAUM_FORMULATION_PROJECTION, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED},
   BAUM_GAINS_AUTO},
  {"ida",
   0,
   {BAUM_FORMULATION_GGL, BAUM_FORMULATION_BAUMGARTE, BAUM_FORMULATION_UNSTABILIZED,
    BAUM_FORMULATION_INDEX2, BAUM_FORMULATION_INDEX3},
   BAUM_GAINS_AUTO},
  {"kinematics", 0, {BAUM_FORMULATION_DEFAULT}, BAUM_GAINS_DEFAULT},
};

enum { COUNT = sizeof FACTS / sizeof FACTS[0] };

static void integrators_report_name_order_and_step(void **state)
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

static void embedded_pairs_and_sundials_have_variable_steps(void **state)
{
  (void)state;
  for (int k = 0; k < COUNT; k++) {
    const baum_integrator *integrator = baum_integrator_at(k);
    bool pair = integrator == baum_dp5() || integrator == baum_rk8();
    bool by_sundials = FACTS[k].order == 0 && integrator != baum_kinematics();
    bool varies = pair || (by_sundials && baum_has("sundials"));
    assert_int_equal(baum_integrator_has_variable_step(integrator), varies);
  }
  assert_false(baum_integrator_has_variable_step(NULL));
}

static void null_is_accepted_as_no_integrator(void **state)
{
  (void)state;
  assert_null(baum_integrator_name(NULL));
  assert_int_equal(baum_integrator_order(NULL), 0);
  assert_false(baum_integrator_has_fixed_step(NULL));
  assert_false(baum_integrator_offers(NULL, BAUM_FORMULATION_BAUMGARTE));
}

static bool is_listed(const facts *fact, baum_formulation formulation)
{
  for (int i = 0; i < 6 && fact->offered[i]; i++) {
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

/* ---- common parts ---- */

static void tolerances_grow_with_scale_and_speed_only(void **state)
{
  (void)state;
  baum_mechanism *mechanism = make_pendulum();
  double scale[2] = {mechanism->scale[0], mechanism->scale[1]};
  baum_workspace workspace = {.mechanism = mechanism};
  baum_i_problem problem = {.workspace = &workspace,
                            .rtol = 1e-3,
                            .atol = 1e-5,
                            .rate = 2.0,
                            .tolerance_q = 1.0,
                            .tolerance_v = 1.0};
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

/* The state violates Phi = 0 and Phi' = 0. The acceleration along the rod therefore depends on the
 * gains. Only Baumgarte's formulation may use the gains. If the run goes backwards in time, the
 * sign of alpha is reversed. */
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

/* ---- stability through the public interface ---- */

static void stability_is_reported_for_each_integrator(void **state)
{
  (void)state;
  baum_amplification out;
  /* At the Taylor gains A = 1, B = 2, the roots satisfy z^2 + 1 = 0 with explicit Euler, and
   * z^2 + 2 z - 1 = 0 with semi-implicit Euler. */
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
  ASSERT_NEAR(limit, 2.785293563405282, 1e-12, 0.0); /* for alpha = beta */
  double good[2];
  assert_int_equal(baum_stability_deadbeat(baum_semi_implicit_euler(), &good[0], &good[1]),
                   BAUM_OK);
  ASSERT_NEAR(good[0], 0.5, 1e-15, 0.0);
  ASSERT_NEAR(good[1], 1.0, 1e-15, 0.0);
  assert_int_equal(baum_stability_nearest(baum_euler(), 1.0, 1.0, &good[0], &good[1]), BAUM_OK);
  ASSERT_NEAR(good[0], 1.0, 0.0, 0.0);
  ASSERT_NEAR(good[1], 1.0, 0.0, 0.0);
}

static void amplification_is_truncated_to_the_callers_size(void **state)
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

#define ASSERT_REFUSED(call, want, message)         \
  do {                                              \
    assert_int_equal((call), (want));               \
    assert_string_equal(baum_message(), (message)); \
  } while (0)

static void wrong_arguments_are_refused_by_name(void **state)
{
  (void)state;
  baum_amplification out;
  double x = 7.0;
  double y = 7.0;
  const baum_integrator *e = baum_euler();
  ASSERT_REFUSED(baum_stability_at(NULL, 1.0, 1.0, &out, sizeof out), BAUM_ERR_ARGUMENT,
                 "stability: integrator is NULL, must be one such as baum_euler()");
  ASSERT_REFUSED(baum_stability_at(e, (double)NAN, 1.0, &out, sizeof out), BAUM_ERR_ARGUMENT,
                 "stability: alpha_h is nan, must be finite");
  ASSERT_REFUSED(baum_stability_at(e, 1.0, (double)INFINITY, &out, sizeof out), BAUM_ERR_ARGUMENT,
                 "stability: beta2_h2 is inf, must be finite");
  ASSERT_REFUSED(baum_stability_at(e, 1.0, 1.0, NULL, sizeof out), BAUM_ERR_ARGUMENT,
                 "baum_stability_at: out is NULL or caller_size is too small");
  ASSERT_REFUSED(baum_stability_at(e, 1.0, 1.0, &out, 3), BAUM_ERR_ARGUMENT,
                 "baum_stability_at: out is NULL or caller_size is too small");
  ASSERT_REFUSED(baum_stability_limit(NULL, 1.0, &x), BAUM_ERR_ARGUMENT,
                 "stability: integrator is NULL, must be one such as baum_euler()");
  ASSERT_REFUSED(baum_stability_limit(e, 0.0, &x), BAUM_ERR_ARGUMENT,
                 "stability: damping_ratio is 0, must be finite and > 0");
  ASSERT_REFUSED(baum_stability_limit(e, (double)INFINITY, &x), BAUM_ERR_ARGUMENT,
                 "stability: damping_ratio is inf, must be finite and > 0");
  ASSERT_REFUSED(baum_stability_limit(e, 1.0, NULL), BAUM_ERR_ARGUMENT,
                 "stability: alpha_h is NULL, must be given");
  ASSERT_REFUSED(baum_stability_deadbeat(e, NULL, &y), BAUM_ERR_ARGUMENT,
                 "stability: alpha_h is NULL, must be given");
  ASSERT_REFUSED(baum_stability_deadbeat(e, &x, NULL), BAUM_ERR_ARGUMENT,
                 "stability: beta2_h2 is NULL, must be given");
  ASSERT_REFUSED(baum_stability_nearest(e, (double)NAN, 1.0, &x, &y), BAUM_ERR_ARGUMENT,
                 "stability: alpha_h is nan, must be finite");
  ASSERT_REFUSED(baum_stability_nearest(e, 1.0, 1.0, NULL, &y), BAUM_ERR_ARGUMENT,
                 "stability: good_alpha_h is NULL, must be given");
  ASSERT_REFUSED(baum_stability_nearest(e, 1.0, 1.0, &x, NULL), BAUM_ERR_ARGUMENT,
                 "stability: good_beta2_h2 is NULL, must be given");
  const char *why = "cvode_bdf chooses its step, so it has no fixed region of stability";
  ASSERT_REFUSED(baum_stability_limit(baum_cvode_bdf(), 1.0, &x), BAUM_ERR_UNSUPPORTED, why);
  ASSERT_REFUSED(baum_stability_deadbeat(baum_cvode_bdf(), &x, &y), BAUM_ERR_UNSUPPORTED, why);
  ASSERT_REFUSED(baum_stability_nearest(baum_cvode_bdf(), 1.0, 1.0, &x, &y), BAUM_ERR_UNSUPPORTED,
                 why);
  assert_true(x == 7.0 && y == 7.0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(integrators_report_name_order_and_step),
    cmocka_unit_test(embedded_pairs_and_sundials_have_variable_steps),
    cmocka_unit_test(null_is_accepted_as_no_integrator),
    cmocka_unit_test(integrators_offer_their_formulations_default_first),
    cmocka_unit_test(formulations_have_names),
    cmocka_unit_test(tolerances_grow_with_scale_and_speed_only),
    cmocka_unit_test(gains_follow_formulation_and_direction),
    cmocka_unit_test(stability_is_reported_for_each_integrator),
    cmocka_unit_test(amplification_is_truncated_to_the_callers_size),
    cmocka_unit_test(wrong_arguments_are_refused_by_name),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
