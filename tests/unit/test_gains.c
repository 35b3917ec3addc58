/* SPDX-License-Identifier: BSD-3-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "assert_near.h"
#include "methods.h"
#include "stabilization/gains.h"

static const double H = 1e-3;

static const char *const names[METHOD_COUNT] = {
  "euler", "semi_implicit_euler", "rk2", "rk3", "rk4", "ab2", "ab3", "ab4", "dp5", "rk8"};

static baum_i_gain_context fixed_step(int method)
{
  return (baum_i_gain_context){.method = &methods[method],
                               .integrator = names[method],
                               .step = H,
                               .rate = 40.0,
                               .rate_is = "a rate",
                               .rule_default =
                                 method < RK2 ? BAUM_GAINS_DEADBEAT : BAUM_GAINS_AUTO};
}

static const baum_i_method variable_method = {
  .kind = BAUM_I_METHOD_VARIABLE_STEP, .degree = 0, .coefficients = {0.0}};

static baum_i_gain_context variable_step(void)
{
  return (baum_i_gain_context){.method = &variable_method,
                               .family = BAUM_I_FAMILY_BDF,
                               .integrator = "cvode_bdf",
                               .step = (double)NAN,
                               .rate = 40.0,
                               .rate_is = "a rate",
                               .rule_default = BAUM_GAINS_AUTO};
}

static baum_i_gain_choice chosen(baum_gains gains, baum_i_gain_context context)
{
  baum_i_gain_choice choice;
  memset(&choice, 0, sizeof choice);
  baum_status status = baum_i_gains_choose(&gains, &context, &choice);
  if (status != BAUM_OK) {
    print_error("%s\n", baum_message());
  }
  assert_int_equal(status, BAUM_OK);
  assert_int_equal(choice.amplification.struct_size, sizeof(baum_amplification));
  return choice;
}

static void has(const char *text, const char *part)
{
  if (strstr(text, part) == NULL) {
    print_error("\"%s\" does not say \"%s\"\n", text, part);
  }
  assert_non_null(strstr(text, part));
}

/* Checks a refusal. The message must contain both parts, and the result must not change. */
static void refused(baum_gains gains, baum_i_gain_context context, baum_status want,
                    const char *part, const char *other_part)
{
  baum_i_gain_choice choice;
  baum_i_gain_choice before;
  memset(&choice, 0x5a, sizeof choice);
  memcpy(&before, &choice, sizeof before);
  assert_int_equal(baum_i_gains_choose(&gains, &context, &choice), want);
  assert_memory_equal(&choice, &before, sizeof choice);
  has(baum_message(), part);
  has(baum_message(), other_part);
}

/* ---- Rules ---------------------------------------------------------------- */

static void constructors_keep_rule_and_numbers(void **state)
{
  (void)state;
  const baum_gains made[] = {baum_gains_fixed(3.0, 4.0), baum_gains_scaled(3.0, 4.0),
                             baum_gains_taylor(),        baum_gains_frequency(3.0, 4.0),
                             baum_gains_deadbeat(),      baum_gains_auto(),
                             baum_gains_best_damping()};
  for (int k = 0; k < 7; k++) {
    assert_int_equal(made[k].rule, k + 1);
    bool numbers = k == 0 || k == 1 || k == 3;
    assert_true(made[k].value[0] == (numbers ? 3.0 : 0.0));
    assert_true(made[k].value[1] == (numbers ? 4.0 : 0.0));
  }
}

static void fixed_gains_are_used_unchanged(void **state)
{
  (void)state;
  baum_i_gain_choice c = chosen(baum_gains_fixed(5.0, 7.0), fixed_step(EULER));
  assert_true(c.alpha == 5.0 && c.beta == 7.0);
  assert_int_equal(c.rule, BAUM_GAINS_FIXED);
  assert_int_equal(c.amplification.stability, BAUM_STABLE);
  ASSERT_NEAR(c.amplification.spectral_radius, amplification_at(EULER, 5e-3, 49e-6).spectral_radius,
              1e-15, 0.0);
  assert_string_equal(c.why, "gains fixed: alpha = 5 1/s, beta = 7 1/s; (alpha h, beta^2 h^2) = "
                             "(0.005, 4.9e-05), spectral radius 0.995012, stable");
}

static void scaled_gains_are_divided_by_the_step(void **state)
{
  (void)state;
  baum_i_gain_choice c = chosen(baum_gains_scaled(0.5, 0.25), fixed_step(EULER));
  ASSERT_NEAR(c.alpha, 500.0, 1e-15, 0.0);
  ASSERT_NEAR(c.beta, 500.0, 1e-15, 0.0);
  assert_true(c.amplification.spectral_radius == 0.5);
}

static void taylor_gains_follow_equations_10_and_11(void **state)
{
  (void)state;
  baum_i_gain_choice c = chosen(baum_gains_taylor(), fixed_step(EULER));
  ASSERT_NEAR(c.alpha, 1.0 / H, 1e-15, 0.0);
  ASSERT_NEAR(c.beta, sqrt(2.0) / H, 1e-15, 0.0);
  assert_int_equal(c.amplification.stability, BAUM_MARGINAL);
  assert_true(c.amplification.spectral_radius == 1.0);
  has(c.why, "spectral radius 1, marginal");
}

static void a_frequency_gives_beta_and_a_damping_ratio_gives_alpha(void **state)
{
  (void)state;
  baum_i_gain_choice c = chosen(baum_gains_frequency(10.0, 0.7), variable_step());
  ASSERT_NEAR(c.beta, 62.831853071795862, 1e-15, 0.0);
  ASSERT_NEAR(c.alpha, 0.7 * 62.831853071795862, 1e-15, 0.0);
}

static void deadbeat_uses_the_point_of_the_method(void **state)
{
  (void)state;
  for (int m = 0; m < ONE_STEP_COUNT; m++) {
    double A = 0.0;
    double B = 0.0;
    assert_true(baum_i_stability_deadbeat(&methods[m], &A, &B));
    baum_i_gain_choice c = chosen(baum_gains_deadbeat(), fixed_step(m));
    ASSERT_NEAR(c.alpha * H, A, 1e-14, 0.0);
    ASSERT_NEAR(c.beta * H, sqrt(B), 1e-14, 0.0);
    ASSERT_NEAR(c.amplification.spectral_radius, 0.0, 0.0, 1e-14);
  }
}

static void best_damping_is_nowhere_worse_than_its_neighbours(void **state)
{
  (void)state;
  static const double off[4][2] = {{0.01, 0.0}, {-0.01, 0.0}, {0.0, 0.01}, {0.0, -0.01}};
  for (int m = 0; m < METHOD_COUNT; m++) {
    baum_i_gain_choice c = chosen(baum_gains_best_damping(), fixed_step(m));
    assert_int_equal(c.rule, BAUM_GAINS_BEST_DAMPING);
    assert_int_equal(c.amplification.stability, BAUM_STABLE);
    double A = c.alpha * H;
    double B = (c.beta * H) * (c.beta * H);
    for (int k = 0; k < 4; k++) {
      double nearby = amplification_at(m, A + off[k][0], B + off[k][1]).spectral_radius;
      /* AB2 has a line of equally good points. Along this line, only B changes. */
      assert_true(nearby > c.amplification.spectral_radius - 1e-9);
    }
  }
}

static void methods_without_a_dead_beat_point_offer_their_best_point(void **state)
{
  (void)state;
  for (int m = AB2; m <= AB4; m++) {
    char best[256];
    baum_i_gain_choice c = chosen(baum_gains_best_damping(), fixed_step(m));
    (void)snprintf(best, sizeof best,
                   "its best point is (alpha h, beta^2 h^2) = (%.4g, %.4g) with spectral radius "
                   "%.4g, that is alpha = %.4g 1/s, beta = %.4g 1/s: take best_damping",
                   c.alpha * H, (c.beta * H) * (c.beta * H), c.amplification.spectral_radius,
                   c.alpha, c.beta);
    refused(baum_gains_deadbeat(), fixed_step(m), BAUM_ERR_UNSUPPORTED,
            "has no dead-beat point, because its past steps keep violations", best);
    has(baum_message(), names[m]);
  }
}

static void the_default_rule_is_that_of_the_integrator(void **state)
{
  (void)state;
  const baum_gains zero = {0};
  assert_int_equal(chosen(zero, fixed_step(EULER)).rule, BAUM_GAINS_DEADBEAT);
  assert_int_equal(chosen(zero, fixed_step(RK4)).rule, BAUM_GAINS_AUTO);
  assert_int_equal(chosen(zero, variable_step()).rule, BAUM_GAINS_AUTO);
}

static void zero_gains_are_marginal_and_allowed(void **state)
{
  (void)state;
  baum_i_gain_choice c = chosen(baum_gains_fixed(0.0, 0.0), fixed_step(RK4));
  assert_int_equal(c.amplification.stability, BAUM_MARGINAL);
  assert_true(c.alpha == 0.0 && c.beta == 0.0);
  c = chosen(baum_gains_fixed(0.0, 0.0), variable_step());
  assert_null(strstr(c.why, "warning"));
}

static void gains_without_damping_cause_a_warning(void **state)
{
  (void)state;
  baum_i_gain_choice c = chosen(baum_gains_fixed(0.0, 100.0), fixed_step(RK4));
  assert_int_equal(c.amplification.stability, BAUM_STABLE);
  assert_true(c.doubtful);
  has(c.why, "warning: with alpha = 0, only the error of the method damps violations");
}

/* ---- Auto ----------------------------------------------------------------- */

static void auto_is_a_fraction_of_the_rate(void **state)
{
  (void)state;
  baum_i_gain_choice c = chosen(baum_gains_auto(), fixed_step(RK4));
  assert_true(c.alpha == 14.0 && c.beta == 14.0);
  has(c.why, "alpha = 14 1/s, beta = 14 1/s (0.35 x 40 1/s, a rate); ");
  c = chosen(baum_gains_auto(), variable_step());
  assert_true(c.alpha == 10.0 && c.beta == 10.0);
  has(c.why, "(0.25 x 40 1/s, a rate); variable step");
  baum_i_gain_context context = fixed_step(RK4);
  context.step = (double)NAN;
  c = chosen(baum_gains_auto(), context);
  assert_true(c.alpha == 4.0 && c.beta == 4.0);
  has(c.why, "(0.1 x 40 1/s, a rate); variable step");
}

static void auto_is_larger_if_drivers_take_all_degrees_of_freedom(void **state)
{
  (void)state;
  baum_i_gain_context context = fixed_step(RK4);
  context.driven = true;
  baum_i_gain_choice c = chosen(baum_gains_auto(), context);
  assert_true(c.alpha == 24.0 && c.beta == 24.0);
  has(c.why, "(0.6 x 40 1/s, a rate; no degree of freedom is left); ");
  context.step = (double)NAN;
  c = chosen(baum_gains_auto(), context);
  assert_true(c.alpha == 80.0 && c.beta == 80.0);
  has(c.why, "(2 x 40 1/s, a rate; no degree of freedom is left); variable step");
  context = variable_step();
  context.driven = true;
  c = chosen(baum_gains_auto(), context);
  assert_true(c.alpha == 1600.0 && c.beta == 1600.0);
  has(c.why, "(40 x 40 1/s, a rate; no degree of freedom is left); variable step");
}

/* Returns the ratio alpha / rate that the rule `auto` chooses for a fixed step. */
static double share_of(const baum_i_method *method)
{
  if (method->kind != BAUM_I_METHOD_ONE_STEP || method->degree == 1) {
    return 0.2;
  }
  return method->degree == 2 ? 0.05 : 0.35;
}

static void auto_is_capped_and_always_stable(void **state)
{
  (void)state;
  for (int m = 0; m < METHOD_COUNT; m++) {
    for (double rate = 1e-5; rate < 1e9; rate *= 10.0) {
      baum_i_gain_context context = fixed_step(m);
      context.rate = rate;
      double cap = fmin(0.3, 0.5 * baum_i_stability_limit(&methods[m], 1.0));
      baum_i_gain_choice c = chosen(baum_gains_auto(), context);
      assert_int_equal(c.amplification.stability, BAUM_STABLE);
      ASSERT_NEAR(c.alpha, fmin(share_of(&methods[m]) * rate, cap / H), 1e-14, 0.0);
      assert_true(c.alpha == c.beta);
    }
  }
}

/* `small` is explicit Euler with a fivefold step. It is stable up to alpha h = beta h = 0.4. */
static void auto_stays_inside_a_small_region(void **state)
{
  (void)state;
  static const baum_i_method small = {
    .kind = BAUM_I_METHOD_ONE_STEP, .degree = 1, .coefficients = {1.0, 5.0}};
  baum_i_gain_context context = fixed_step(EULER);
  context.method = &small;
  context.rate = 1e6;
  baum_i_gain_choice c = chosen(baum_gains_auto(), context);
  ASSERT_NEAR(c.alpha * H, 0.2, 1e-12, 0.0);
  has(c.why, "(capped; 0.2 x 1e+06 1/s, a rate)");
}

static void auto_falls_back_when_nothing_moves(void **state)
{
  (void)state;
  static const double nothing[] = {0.0, 1e-8}; /* 1e-8 1/s counts as rounding */
  for (int k = 0; k < 2; k++) {
    baum_i_gain_context context = fixed_step(SEMI_IMPLICIT_EULER);
    context.rate = nothing[k];
    baum_i_gain_choice c = chosen(baum_gains_auto(), context);
    ASSERT_NEAR(c.alpha, 0.01 / H, 1e-14, 0.0);
    has(c.why, "(nothing moves at start: alpha h = 0.01)");
  }
  baum_i_gain_context context = variable_step();
  context.rate = 0.0;
  baum_i_gain_choice c = chosen(baum_gains_auto(), context);
  assert_true(c.alpha == 1.0 && c.beta == 1.0);
  has(c.why, "(nothing moves at start: the rate is taken as 1 1/s); variable step");
}

static void auto_refuses_a_negative_or_infinite_rate(void **state)
{
  (void)state;
  static const double bad[] = {-1.0, HUGE_VAL, (double)NAN};
  for (int k = 0; k < 3; k++) {
    baum_i_gain_context context = fixed_step(RK4);
    context.rate = bad[k];
    refused(baum_gains_auto(), context, BAUM_ERR_ARGUMENT, "gains auto", "rate");
    (void)chosen(baum_gains_fixed(1.0, 1.0), context);
  }
}

/* ---- Near the edge of the stability region --------------------------------- */

static void stable_gains_near_the_edge_cause_a_warning(void **state)
{
  (void)state;
  static const double near[][3] = {{EULER, 1.99, 1.99 * 1.99}, /* stable up to alpha h = 2 */
                                   {EULER, 1e-3, 1.9e-3},      /* stable up to beta^2 h^2 = 2e-3 */
                                   {RK2, 1.97, 1.97 * 1.97},   {RK4, 2.77, 2.77 * 2.77},
                                   {AB2, 0.99, 0.99 * 0.99},   {AB3, 0.54, 0.54 * 0.54},
                                   {AB4, 0.298, 0.298 * 0.298}};
  for (size_t k = 0; k < sizeof near / sizeof near[0]; k++) {
    baum_i_gain_choice c =
      chosen(baum_gains_scaled(near[k][1], near[k][2]), fixed_step((int)near[k][0]));
    assert_int_equal(c.amplification.stability, BAUM_STABLE);
    assert_true(c.doubtful);
    has(c.why, "stable; warning: near the edge of the region, a step leaves ");
  }
}

/* Small gains also damp weakly. Weak damping causes a warning only near the edge of the region. */
static void small_and_usual_gains_cause_no_warning(void **state)
{
  (void)state;
  static const double ratios[] = {0.8, 1.0, 2.0}; /* alpha / beta */
  for (int m = 0; m < METHOD_COUNT; m++) {
    for (int k = 0; k < 3; k++) {
      double limit = baum_i_stability_limit(&methods[m], ratios[k]);
      for (double A = 1e-10; A < 0.8 * limit; A *= 1.3) {
        double b = A / ratios[k];
        assert_false(chosen(baum_gains_scaled(A, b * b), fixed_step(m)).doubtful);
      }
    }
    assert_false(chosen(baum_gains_best_damping(), fixed_step(m)).doubtful);
  }
}

/* ---- Explicit methods with variable steps ------------------------------- */

static void the_longest_step_keeps_the_gains_stable(void **state)
{
  (void)state;
  static const double pairs[][2] = {{100.0, 100.0}, {50.0, 500.0}, {400.0, 20.0}, {7.0, 0.0}};
  baum_i_gain_context rk4 = fixed_step(RK4);
  rk4.step = (double)NAN;
  for (int k = 0; k < 4; k++) {
    double alpha = pairs[k][0];
    double beta = pairs[k][1];
    double h = chosen(baum_gains_fixed(alpha, beta), rk4).max_step;
    /* The step h is 0.9 of the stability limit. It is therefore stable, but h / 0.89 is not. */
    double in = amplification_at(RK4, alpha * h, beta * h * beta * h).spectral_radius;
    double out =
      amplification_at(RK4, alpha * h / 0.89, beta * h * beta * h / (0.89 * 0.89)).spectral_radius;
    assert_true(beta > 0.0 ? in < 1.0 : in <= 1.0);
    assert_true(out > 1.0);
  }
  assert_true(isinf(chosen(baum_gains_fixed(0.0, 0.0), rk4).max_step));
  assert_true(isinf(chosen(baum_gains_fixed(9.0, 9.0), variable_step()).max_step));
  assert_true(isinf(chosen(baum_gains_fixed(9.0, 9.0), fixed_step(RK4)).max_step));
  has(chosen(baum_gains_fixed(100.0, 100.0), rk4).why,
      "variable step, at most 0.02507 s, because violations would grow with longer steps");
}

/* ---- Variable steps --------------------------------------------------------- */

static void rules_that_need_a_fixed_step_are_refused_without_one(void **state)
{
  (void)state;
  refused(baum_gains_scaled(0.5, 0.25), variable_step(), BAUM_ERR_ARGUMENT, "gains scaled",
          "cvode_bdf");
  refused(baum_gains_taylor(), variable_step(), BAUM_ERR_ARGUMENT, "gains taylor", "fixed step");
  refused(baum_gains_deadbeat(), variable_step(), BAUM_ERR_ARGUMENT, "gains deadbeat",
          "frequency or auto");
  baum_i_gain_context rk4 = fixed_step(RK4);
  rk4.step = (double)NAN;
  refused(baum_gains_taylor(), rk4, BAUM_ERR_ARGUMENT, "gains taylor", "rk4");
}

static void variable_steps_have_no_radius(void **state)
{
  (void)state;
  baum_i_gain_context rk4 = fixed_step(RK4);
  rk4.step = (double)NAN;
  const baum_i_gain_context contexts[] = {variable_step(), rk4};
  for (int k = 0; k < 2; k++) {
    baum_i_gain_choice c = chosen(baum_gains_fixed(1e6, 1e6), contexts[k]);
    assert_int_equal(c.amplification.stability, BAUM_VARIABLE_STEP);
    assert_true(isnan(c.amplification.spectral_radius));
    has(c.why, "gains fixed: alpha = 1e+06 1/s, beta = 1e+06 1/s; variable step");
  }
}

static void weak_damping_causes_a_warning_with_variable_steps(void **state)
{
  (void)state;
  has(chosen(baum_gains_fixed(2.0, 10.0), variable_step()).why,
      "warning: alpha / beta = 0.2 < 0.618");
  has(chosen(baum_gains_frequency(1.0, 0.617), variable_step()).why, "warning");
  assert_null(strstr(chosen(baum_gains_frequency(1.0, 0.619), variable_step()).why, "warning"));
  has(chosen(baum_gains_fixed(2.0, 0.0), variable_step()).why, "warning: beta = 0");
}

/* Only BDF needs this warning. With other methods, the error test makes violations decay. */
static void weak_damping_causes_a_warning_only_with_bdf(void **state)
{
  (void)state;
  baum_i_gain_context adams = variable_step();
  baum_i_gain_context rk4 = fixed_step(RK4);
  adams.family = BAUM_I_FAMILY_ADAMS;
  rk4.step = (double)NAN;
  assert_false(chosen(baum_gains_fixed(2.0, 10.0), adams).doubtful);
  assert_false(chosen(baum_gains_fixed(2.0, 10.0), rk4).doubtful);
  has(chosen(baum_gains_fixed(0.0, 10.0), adams).why, "variable step; warning: with alpha = 0");
  has(chosen(baum_gains_fixed(0.0, 10.0), rk4).why, "variable step; warning: with alpha = 0");
}

/* ---- Refusals ------------------------------------------------------------- */

static void numbers_out_of_range_are_refused_by_name_and_unit(void **state)
{
  (void)state;
  static const double bad[] = {-3.0, HUGE_VAL, -HUGE_VAL, (double)NAN};
  for (int k = 0; k < 4; k++) {
    double x = bad[k];
    refused(baum_gains_fixed(x, 1.0), fixed_step(EULER), BAUM_ERR_ARGUMENT, "gains fixed: alpha is",
            "1/s, must be finite and >= 0");
    refused(baum_gains_fixed(1.0, x), fixed_step(EULER), BAUM_ERR_ARGUMENT, "gains fixed: beta is",
            "1/s, must be finite and >= 0");
    refused(baum_gains_scaled(x, 1.0), fixed_step(EULER), BAUM_ERR_ARGUMENT,
            "gains scaled: alpha h is", "must be finite and >= 0");
    refused(baum_gains_scaled(1.0, x), fixed_step(EULER), BAUM_ERR_ARGUMENT,
            "gains scaled: beta^2 h^2 is", "must be finite and >= 0");
    refused(baum_gains_frequency(x, 1.0), fixed_step(EULER), BAUM_ERR_ARGUMENT,
            "gains frequency: frequency is", "Hz, must be finite and > 0");
    refused(baum_gains_frequency(1.0, x), fixed_step(EULER), BAUM_ERR_ARGUMENT,
            "gains frequency: damping ratio is", "must be finite and > 0");
  }
  refused(baum_gains_fixed(-3.0, 1.0), fixed_step(EULER), BAUM_ERR_ARGUMENT, "alpha is -3 1/s",
          "must be finite and >= 0");
  refused(baum_gains_frequency(0.0, 1.0), fixed_step(EULER), BAUM_ERR_ARGUMENT, "frequency is 0 Hz",
          "> 0");
}

static void numbers_that_overflow_are_refused(void **state)
{
  (void)state;
  refused(baum_gains_frequency(1e308, 1.0), variable_step(), BAUM_ERR_ARGUMENT, "gains frequency",
          "inf");
  refused(baum_gains_fixed(1e308, 1e308), fixed_step(EULER), BAUM_ERR_UNSTABLE, "inf", "nearest");
}

static void unknown_rules_are_refused(void **state)
{
  (void)state;
  static const int32_t unknown[] = {-1, 8, 1000000, INT32_MIN};
  for (int k = 0; k < 4; k++) {
    baum_gains gains = {unknown[k], {0.0, 0.0}};
    refused(gains, fixed_step(EULER), BAUM_ERR_ARGUMENT, "is unknown", "baum_gains_fixed()");
  }
  baum_i_gain_context circular = fixed_step(EULER);
  circular.rule_default = BAUM_GAINS_DEFAULT;
  refused((baum_gains){0}, circular, BAUM_ERR_ARGUMENT, "rule 0", "is unknown");
}

static void a_step_that_is_not_positive_and_finite_is_refused(void **state)
{
  (void)state;
  static const double bad[] = {0.0, -1e-3, HUGE_VAL};
  for (int k = 0; k < 3; k++) {
    baum_i_gain_context context = fixed_step(EULER);
    context.step = bad[k];
    refused(baum_gains_fixed(1.0, 1.0), context, BAUM_ERR_ARGUMENT, "step is", "> 0");
  }
}

static void unstable_gains_are_refused_with_numbers_and_a_remedy(void **state)
{
  (void)state;
  refused(baum_gains_taylor(), fixed_step(SEMI_IMPLICIT_EULER), BAUM_ERR_UNSTABLE,
          "gains alpha = 1000 1/s, beta = 1414.21 1/s with semi_implicit_euler and h = 0.001 s: "
          "(alpha h, beta^2 h^2) = (1, 2) has spectral radius 2.41421 > 1, violations grow; "
          "this integrator is stable for 0 < alpha h < 1 and 0 < beta^2 h^2 < 4 - 4 alpha h; "
          "nearest good pair: (",
          "), that is alpha = ");
  refused(baum_gains_fixed(2100.0, 2100.0), fixed_step(EULER), BAUM_ERR_UNSTABLE,
          "0 < beta^2 h^2 < 2 alpha h and beta^2 h^2 > 4 alpha h - 4", "radius 1.1 > 1");
  refused(baum_gains_fixed(3000.0, 3000.0), fixed_step(RK4), BAUM_ERR_UNSTABLE,
          "alpha = beta up to alpha h = 2.78529", "radius 1.375 > 1");
  refused(baum_gains_taylor(), fixed_step(AB2), BAUM_ERR_UNSTABLE,
          "gains alpha = 1000 1/s, beta = 1414.21 1/s with ab2 and h = 0.001 s: (alpha h, beta^2 "
          "h^2) = (1, 2) has spectral radius ",
          "this integrator is stable for alpha = beta up to alpha h = 1 and alpha = 0.7071 beta "
          "up to alpha h = ");
  refused(baum_gains_taylor(), fixed_step(AB3), BAUM_ERR_UNSTABLE,
          "with ab3 and h = 0.001 s: (alpha h, beta^2 h^2) = (1, 2) has spectral radius ",
          "for alpha = beta up to alpha h = 0.545455 and ");
  refused(baum_gains_fixed(1.0 / H, 1.0 / H), fixed_step(SEMI_IMPLICIT_EULER), BAUM_ERR_UNSTABLE,
          "(alpha h, beta^2 h^2) = (1, 1) has spectral radius 1.61803 > 1, violations grow; this "
          "integrator is stable for 0 < alpha h < 1 and 0 < beta^2 h^2 < 4 - 4 alpha h",
          "nearest good pair: (");
  refused(baum_gains_scaled(1.0, 2.0000001), fixed_step(EULER), BAUM_ERR_UNSTABLE,
          "radius 1 + 5e-08 > 1", "nearest");
}

static void the_pair_that_a_refusal_offers_is_accepted(void **state)
{
  (void)state;
  for (int m = 0; m < METHOD_COUNT; m++) {
    refused(baum_gains_fixed(5000.0, 4000.0), fixed_step(m), BAUM_ERR_UNSTABLE, "nearest",
            "that is");
    double alpha = 0.0;
    double beta = 0.0;
    assert_int_equal(sscanf(strstr(baum_message(), "that is"),
                            "that is alpha = %lf 1/s, beta = %lf 1/s", &alpha, &beta),
                     2);
    baum_i_gain_choice c = chosen(baum_gains_fixed(alpha, beta), fixed_step(m));
    ASSERT_NEAR(c.amplification.spectral_radius, 0.9, 0.0, 5e-3); /* four digits are printed */
  }
}

static void allowed_unstable_gains_are_reported(void **state)
{
  (void)state;
  baum_i_gain_context context = fixed_step(SEMI_IMPLICIT_EULER);
  context.allow_unstable = true;
  baum_i_gain_choice c = chosen(baum_gains_taylor(), context);
  assert_int_equal(c.amplification.stability, BAUM_UNSTABLE);
  has(c.why, "spectral radius 2.41421, UNSTABLE, violations grow");
}

static void the_longest_explanations_are_complete(void **state)
{
  (void)state;
  baum_i_gain_context context = fixed_step(SEMI_IMPLICIT_EULER);
  context.step = 1.23456789e-105;
  context.allow_unstable = true;
  has(chosen(baum_gains_scaled(1.23456789e105, 1.23456789e105), context).why, "violations grow");
  context.rate = 1.23456789e107;
  has(chosen(baum_gains_auto(), context).why, ", stable");
  context = variable_step();
  has(chosen(baum_gains_fixed(1.23456789e-105, 1.23456789e105), context).why, "may not damp");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(constructors_keep_rule_and_numbers),
    cmocka_unit_test(fixed_gains_are_used_unchanged),
    cmocka_unit_test(scaled_gains_are_divided_by_the_step),
    cmocka_unit_test(taylor_gains_follow_equations_10_and_11),
    cmocka_unit_test(a_frequency_gives_beta_and_a_damping_ratio_gives_alpha),
    cmocka_unit_test(deadbeat_uses_the_point_of_the_method),
    cmocka_unit_test(best_damping_is_nowhere_worse_than_its_neighbours),
    cmocka_unit_test(methods_without_a_dead_beat_point_offer_their_best_point),
    cmocka_unit_test(the_default_rule_is_that_of_the_integrator),
    cmocka_unit_test(zero_gains_are_marginal_and_allowed),
    cmocka_unit_test(gains_without_damping_cause_a_warning),
    cmocka_unit_test(auto_is_a_fraction_of_the_rate),
    cmocka_unit_test(auto_is_larger_if_drivers_take_all_degrees_of_freedom),
    cmocka_unit_test(auto_is_capped_and_always_stable),
    cmocka_unit_test(auto_stays_inside_a_small_region),
    cmocka_unit_test(auto_falls_back_when_nothing_moves),
    cmocka_unit_test(auto_refuses_a_negative_or_infinite_rate),
    cmocka_unit_test(stable_gains_near_the_edge_cause_a_warning),
    cmocka_unit_test(small_and_usual_gains_cause_no_warning),
    cmocka_unit_test(the_longest_step_keeps_the_gains_stable),
    cmocka_unit_test(rules_that_need_a_fixed_step_are_refused_without_one),
    cmocka_unit_test(variable_steps_have_no_radius),
    cmocka_unit_test(weak_damping_causes_a_warning_with_variable_steps),
    cmocka_unit_test(weak_damping_causes_a_warning_only_with_bdf),
    cmocka_unit_test(numbers_out_of_range_are_refused_by_name_and_unit),
    cmocka_unit_test(numbers_that_overflow_are_refused),
    cmocka_unit_test(unknown_rules_are_refused),
    cmocka_unit_test(a_step_that_is_not_positive_and_finite_is_refused),
    cmocka_unit_test(unstable_gains_are_refused_with_numbers_and_a_remedy),
    cmocka_unit_test(the_pair_that_a_refusal_offers_is_accepted),
    cmocka_unit_test(allowed_unstable_gains_are_reported),
    cmocka_unit_test(the_longest_explanations_are_complete),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
