/* SPDX-License-Identifier: BSD-3-Clause */
/* From a gain rule to numbers. One row of the table `rules` per rule.
 *
 *   fixed      alpha, beta                                      as given
 *   scaled     alpha = A / h,  beta = sqrt(B) / h               as given, of the step
 *   taylor     alpha = 1 / h,  beta = sqrt(2) / h               (10, 11): A = 1, B = 2
 *   frequency  beta = 2 pi f,  alpha = zeta beta                s^2 + 2 zeta omega s + omega^2
 *   deadbeat   scaled, with the dead-beat point of the method
 *   auto       alpha = beta = 2 x rate, h alpha <= 0.3          cost and order are kept up to there
 *
 * A, B are carried beside alpha, beta, so that a rule of the step is judged exactly where it was
 * meant.
 *
 * Variable steps: an error control keeps explicit methods inside their region. BDF of order 5 is
 * A(51.84 degrees) stable: it damps any alpha h when alpha / beta, the cosine of the angle of s, is
 * at least cos 51.84 = 0.618.
 */
#include "stabilization/gains.h"

#include <math.h>
#include <stdio.h>

#include "base/message.h"

static const double PI = 3.14159265358979323846;

static const double AUTO_FACTOR = 2.0;   /* of the fastest rate */
static const double AUTO_CAP = 0.3;      /* alpha h up to which nothing is lost */
static const double AUTO_AT_REST = 0.01; /* alpha h when nothing moves */
static const double REST = 1e-9;         /* rate h below this is rounding, not motion */
static const double BDF_DAMPING_RATIO = 0.618;

enum { RADIUS_SIZE = 32, REGION_SIZE = 96, NOTE_SIZE = 56, CLAUSE_SIZE = 136 };

/* Gains in both scales, and what is worth saying about them. */
typedef struct draft {
  double alpha;
  double beta;
  double alpha_h; /* NaN without a step, like the next */
  double beta2_h2;
  char note[NOTE_SIZE];
} draft;

typedef void apply_rule(const double value[2], const baum_i_gain_context *context, draft *out);

typedef struct rule_type {
  const char *name;
  apply_rule *apply;
  bool needs_step;       /* h itself, not only to judge by */
  bool positive;         /* value[] > 0, else >= 0 */
  const char *number[2]; /* what value[] is, NULL where there is none */
  const char *unit[2];
} rule_type;

static bool has_step(const baum_i_gain_context *context)
{
  return context->method->kind != BAUM_I_METHOD_VARIABLE_STEP && !isnan(context->step);
}

/* ---- Rules ---------------------------------------------------------------- */

static void from_rates(double alpha, double beta, const baum_i_gain_context *context, draft *out)
{
  double h = has_step(context) ? context->step : (double)NAN;
  out->alpha = alpha;
  out->beta = beta;
  out->alpha_h = alpha * h;
  out->beta2_h2 = (beta * h) * (beta * h);
}

static void from_scaled(double alpha_h, double beta2_h2, const baum_i_gain_context *context,
                        draft *out)
{
  out->alpha = alpha_h / context->step;
  out->beta = sqrt(beta2_h2) / context->step;
  out->alpha_h = alpha_h;
  out->beta2_h2 = beta2_h2;
}

static void apply_fixed(const double value[2], const baum_i_gain_context *context, draft *out)
{
  from_rates(value[0], value[1], context, out);
}

static void apply_scaled(const double value[2], const baum_i_gain_context *context, draft *out)
{
  from_scaled(value[0], value[1], context, out);
}

static void apply_taylor(const double value[2], const baum_i_gain_context *context, draft *out)
{
  (void)value;
  from_scaled(1.0, 2.0, context, out);
}

static void apply_frequency(const double value[2], const baum_i_gain_context *context, draft *out)
{
  double omega = 2.0 * PI * value[0];
  from_rates(value[1] * omega, omega, context, out);
}

static void apply_deadbeat(const double value[2], const baum_i_gain_context *context, draft *out)
{
  (void)value;
  double alpha_h;
  double beta2_h2;
  baum_i_stability_deadbeat(context->method, &alpha_h, &beta2_h2);
  from_scaled(alpha_h, beta2_h2, context, out);
}

/* Half of the limit keeps well inside also where 0.3 would not. */
static double auto_with_step(const baum_i_gain_context *context, char note[NOTE_SIZE])
{
  double h = context->step;
  double wanted = AUTO_FACTOR * context->rate;
  double cap = fmin(AUTO_CAP, 0.5 * baum_i_stability_limit(context->method, 1.0));
  if (context->rate * h < REST) {
    (void)snprintf(note, NOTE_SIZE, " (nothing moves at start: alpha h = %g)", AUTO_AT_REST);
    return AUTO_AT_REST / h;
  }
  if (wanted * h > cap) {
    (void)snprintf(note, NOTE_SIZE, " (capped; 2 x the fastest rate is %.6g 1/s)", wanted);
    return cap / h;
  }
  (void)snprintf(note, NOTE_SIZE, " (2 x the fastest rate)");
  return wanted;
}

static double auto_without_step(const baum_i_gain_context *context, char note[NOTE_SIZE])
{
  if (context->rate > 0.0) {
    (void)snprintf(note, NOTE_SIZE, " (2 x the fastest rate)");
    return AUTO_FACTOR * context->rate;
  }
  (void)snprintf(note, NOTE_SIZE, " (nothing moves at start: 1 1/s for want of a rate)");
  return 1.0;
}

static void apply_auto(const double value[2], const baum_i_gain_context *context, draft *out)
{
  (void)value;
  double alpha =
    has_step(context) ? auto_with_step(context, out->note) : auto_without_step(context, out->note);
  from_rates(alpha, alpha, context, out);
}

static const rule_type rules[] = {
  [BAUM_GAINS_FIXED] = {"fixed", apply_fixed, false, false, {"alpha", "beta"}, {"1/s", "1/s"}},
  [BAUM_GAINS_SCALED] =
    {"scaled", apply_scaled, true, false, {"alpha h", "beta^2 h^2"}, {"[-]", "[-]"}},
  [BAUM_GAINS_TAYLOR] = {"taylor", apply_taylor, true, false, {NULL, NULL}, {NULL, NULL}},
  [BAUM_GAINS_FREQUENCY] =
    {"frequency", apply_frequency, false, true, {"frequency", "damping ratio"}, {"Hz", "[-]"}},
  [BAUM_GAINS_DEADBEAT] = {"deadbeat", apply_deadbeat, true, false, {NULL, NULL}, {NULL, NULL}},
  [BAUM_GAINS_AUTO] = {"auto", apply_auto, false, false, {NULL, NULL}, {NULL, NULL}},
};
enum { RULE_COUNT = sizeof rules / sizeof rules[0] };

/* ---- Checks --------------------------------------------------------------- */

static baum_status check_step(const baum_i_gain_context *context)
{
  if (has_step(context) && !(context->step > 0.0 && isfinite(context->step))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "step is %g s, must be finite and > 0", context->step);
  }
  return BAUM_OK;
}

/* NULL with a sentence when there is no such rule. */
static const rule_type *find_rule(int32_t number)
{
  if (number > BAUM_GAINS_DEFAULT && number < RULE_COUNT) {
    return &rules[number];
  }
  (void)baum_i_fail(BAUM_ERR_ARGUMENT,
                    "gains: rule %d is unknown; make gains with baum_gains_fixed(), _scaled(), "
                    "_taylor(), _frequency(), _deadbeat() or _auto()",
                    (int)number);
  return NULL;
}

static baum_status check_numbers(const rule_type *rule, const double value[2])
{
  for (int k = 0; k < 2; k++) {
    bool in_range = rule->positive ? value[k] > 0.0 : value[k] >= 0.0;
    if (rule->number[k] != NULL && !(in_range && isfinite(value[k]))) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "gains %s: %s is %g %s, must be finite and %s 0",
                         rule->name, rule->number[k], value[k], rule->unit[k],
                         rule->positive ? ">" : ">=");
    }
  }
  return BAUM_OK;
}

/* Whether the rule finds what it depends on. */
static baum_status check_needs(const rule_type *rule, const baum_i_gain_context *context)
{
  if (rule->needs_step && !has_step(context)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "gains %s: the rule needs a fixed step, and %s chooses its own; use fixed, "
                       "frequency or auto",
                       rule->name, context->integrator);
  }
  if (rule->apply == apply_auto && !(context->rate >= 0.0 && isfinite(context->rate))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "gains auto: the fastest rate of the start state is %g 1/s, must be finite "
                       "and >= 0",
                       context->rate);
  }
  return BAUM_OK;
}

static baum_status check_draft(const rule_type *rule, const draft *gains)
{
  if (isfinite(gains->alpha) && isfinite(gains->beta)) {
    return BAUM_OK;
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT,
                     "gains %s: alpha = %g 1/s, beta = %g 1/s is beyond the numbers of double",
                     rule->name, gains->alpha, gains->beta);
}

/* ---- Sentences ------------------------------------------------------------ */

/* A radius that is not mistaken for 1. */
static void print_radius(double radius, char text[RADIUS_SIZE])
{
  double growth = radius - 1.0;
  if (fabs(growth) > 1e-12 && fabs(growth) < 1e-4) {
    (void)snprintf(text, RADIUS_SIZE, "1 %c %.2g", growth > 0.0 ? '+' : '-', fabs(growth));
  } else {
    (void)snprintf(text, RADIUS_SIZE, "%.6g", radius);
  }
}

static void print_region(const baum_i_method *method, char text[REGION_SIZE])
{
  if (method->kind == BAUM_I_METHOD_SEMI_IMPLICIT) {
    (void)snprintf(text, REGION_SIZE, "0 < alpha h < 1 and 0 < beta^2 h^2 < 4 - 4 alpha h");
  } else if (method->degree == 1) {
    (void)snprintf(text, REGION_SIZE, "0 < beta^2 h^2 < 2 alpha h and beta^2 h^2 > 4 alpha h - 4");
  } else {
    (void)snprintf(text, REGION_SIZE, "alpha = beta up to alpha h = %.6g",
                   baum_i_stability_limit(method, 1.0));
  }
}

static baum_status refuse(const baum_i_gain_context *context, const draft *gains, double radius)
{
  char radius_text[RADIUS_SIZE];
  char region[REGION_SIZE];
  double good[2];
  double h = context->step;
  print_radius(radius, radius_text);
  print_region(context->method, region);
  baum_i_stability_nearest(context->method, gains->alpha_h, gains->beta2_h2, &good[0], &good[1]);
  return baum_i_fail(BAUM_ERR_UNSTABLE,
                     "gains alpha = %.6g 1/s, beta = %.6g 1/s with %s and h = %.6g s: "
                     "(alpha h, beta^2 h^2) = (%.6g, %.6g) has spectral radius %s > 1, violations "
                     "grow; stable with this integrator is %s; nearest good pair: (%.4g, %.4g), "
                     "that is alpha = %.4g 1/s, beta = %.4g 1/s",
                     gains->alpha, gains->beta, context->integrator, h, gains->alpha_h,
                     gains->beta2_h2, radius_text, region, good[0], good[1], good[0] / h,
                     sqrt(good[1]) / h);
}

static const char *const class_text[] = {
  [BAUM_STABLE] = "stable",
  [BAUM_MARGINAL] = "marginal: some violations stay",
  [BAUM_UNSTABLE] = "UNSTABLE, violations grow",
};

static void print_fixed_step(const draft *gains, const baum_amplification *amplification,
                             char text[CLAUSE_SIZE])
{
  char radius[RADIUS_SIZE];
  print_radius(amplification->spectral_radius, radius);
  (void)snprintf(text, CLAUSE_SIZE, "(alpha h, beta^2 h^2) = (%.6g, %.6g), spectral radius %s, %s",
                 gains->alpha_h, gains->beta2_h2, radius, class_text[amplification->stability]);
}

/* True when the clause warns. */
static bool print_variable_step(const draft *gains, char text[CLAUSE_SIZE])
{
  if (gains->beta == 0.0 && gains->alpha > 0.0) {
    (void)snprintf(text, CLAUSE_SIZE,
                   "variable step; warning: beta = 0 leaves violations of position");
    return true;
  }
  if (gains->alpha < BDF_DAMPING_RATIO * gains->beta) {
    (void)snprintf(text, CLAUSE_SIZE,
                   "variable step; warning: alpha / beta = %.3g < %g, BDF and IDA may not damp",
                   gains->alpha / gains->beta, BDF_DAMPING_RATIO);
    return true;
  }
  (void)snprintf(text, CLAUSE_SIZE, "variable step");
  return false;
}

static void explain(const rule_type *rule, const draft *gains, baum_i_gain_choice *choice)
{
  char clause[CLAUSE_SIZE];
  if (choice->amplification.stability == BAUM_VARIABLE_STEP) {
    choice->doubtful = print_variable_step(gains, clause);
  } else {
    choice->doubtful = choice->amplification.stability != BAUM_STABLE;
    print_fixed_step(gains, &choice->amplification, clause);
  }
  (void)snprintf(choice->why, sizeof choice->why,
                 "gains %s: alpha = %.6g 1/s, beta = %.6g 1/s%s; %s", rule->name, gains->alpha,
                 gains->beta, gains->note, clause);
}

/* ---- Choice --------------------------------------------------------------- */

static baum_status make_draft(const rule_type *rule, const double value[2],
                              const baum_i_gain_context *context, draft *out)
{
  baum_status status = check_numbers(rule, value);
  if (status == BAUM_OK) {
    status = check_needs(rule, context);
  }
  if (status == BAUM_OK) {
    rule->apply(value, context, out);
    status = check_draft(rule, out);
  }
  return status;
}

static void amplify(const baum_i_gain_context *context, const draft *gains, baum_amplification *out)
{
  static const baum_i_method variable_step = {BAUM_I_METHOD_VARIABLE_STEP, 0, {0.0}};
  const baum_i_method *method = has_step(context) ? context->method : &variable_step;
  out->struct_size = sizeof *out;
  baum_i_amplification(method, gains->alpha_h, gains->beta2_h2, out);
}

baum_status baum_i_gains_choose(const baum_gains *gains, const baum_i_gain_context *context,
                                baum_i_gain_choice *out)
{
  bool is_default = gains->rule == BAUM_GAINS_DEFAULT;
  const rule_type *rule = find_rule(is_default ? (int32_t)context->rule_default : gains->rule);
  if (rule == NULL || check_step(context) != BAUM_OK) {
    return BAUM_ERR_ARGUMENT;
  }
  draft numbers = {.note = ""};
  baum_status status = make_draft(rule, gains->value, context, &numbers);
  if (status != BAUM_OK) {
    return status;
  }
  baum_i_gain_choice choice = {.alpha = numbers.alpha, .beta = numbers.beta};
  amplify(context, &numbers, &choice.amplification);
  if (choice.amplification.stability == BAUM_UNSTABLE && !context->allow_unstable) {
    return refuse(context, &numbers, choice.amplification.spectral_radius);
  }
  choice.rule = (baum_gain_rule)(rule - rules);
  explain(rule, &numbers, &choice);
  *out = choice;
  return BAUM_OK;
}

/* ---- Constructors --------------------------------------------------------- */

static baum_gains make(baum_gain_rule rule, double first, double second)
{
  return (baum_gains){(int32_t)rule, {first, second}};
}

baum_gains baum_gains_fixed(double alpha, double beta)
{
  return make(BAUM_GAINS_FIXED, alpha, beta);
}

baum_gains baum_gains_scaled(double alpha_h, double beta2_h2)
{
  return make(BAUM_GAINS_SCALED, alpha_h, beta2_h2);
}

baum_gains baum_gains_taylor(void)
{
  return make(BAUM_GAINS_TAYLOR, 0.0, 0.0);
}

baum_gains baum_gains_frequency(double hertz, double damping_ratio)
{
  return make(BAUM_GAINS_FREQUENCY, hertz, damping_ratio);
}

baum_gains baum_gains_deadbeat(void)
{
  return make(BAUM_GAINS_DEADBEAT, 0.0, 0.0);
}

baum_gains baum_gains_auto(void)
{
  return make(BAUM_GAINS_AUTO, 0.0, 0.0);
}
