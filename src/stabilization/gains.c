/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes gains by a rule. The table `rules` below has one entry for each rule.
 *
 *   fixed      alpha, beta                                      as given
 *   scaled     alpha = A / h,  beta = sqrt(B) / h               A and B as given
 *   taylor     alpha = 1 / h,  beta = sqrt(2) / h               A = 1, B = 2 (Flores 2008)
 *   frequency  beta = omega = 2 pi f,  alpha = zeta omega       s^2 + 2 zeta omega s + omega^2
 *   deadbeat   scaled, with the dead-beat point of the method
 *   best       scaled, with the point of least spectral radius
 *   auto       alpha = beta = c * rate, h alpha <= 0.3          this limit preserves cost and order
 *
 * A and B are stored together with alpha and beta. The stability of a rule that is relative to the
 * step is thus checked at exactly the point that the rule gives.
 *
 * About the rule `auto`: if the mechanism has degrees of freedom, stabilization disturbs the
 * motion. The disturbance is largest if alpha is close to the rate of the motion. The factor c is
 * therefore below 1. It was chosen by measurements over 12 decades of constant gains
 * (docs/theory/gain_rules.md). If drivers prescribe all degrees of freedom, the violation is the
 * only error. Then c is as large as possible without additional cost.
 *
 * Rows of velocity level have one mode, exp(-alpha t), which must be stable for the same alpha.
 *
 * About variable steps: the step of an explicit method is limited so that (alpha h, beta^2 h^2) is
 * in the region of stability. BDF of order 5 is A(51.84 degrees)-stable. The ratio alpha / beta is
 * the cosine of the angle between the roots of s^2 + 2 alpha s + beta^2 and the negative real axis.
 * Violations therefore decay for any alpha h if alpha / beta is at least cos 51.84 degrees =
 * 0.618. */
#include "stabilization/gains.h"

#include <math.h>

#include "base/text.h"
#include "stabilization/gain_text.h"

static const double PI = 3.14159265358979323846;

/* The factors c of the rule `auto`. In their names, FIXED stands for fixed steps of Runge-Kutta
 * methods, which have another factor for order 2. OTHERS stands for fixed steps of other methods,
 * MULTISTEP for CVODE and IDA, and EXPLICIT for explicit methods with variable steps. DRIVEN stands
 * for mechanisms in which drivers prescribe all degrees of freedom; then FIXED stands for fixed
 * steps of all methods. */
static const double AUTO_FIXED = 0.35;
static const double AUTO_FIXED_ORDER_2 = 0.05;
static const double AUTO_OTHERS = 0.2;
static const double AUTO_MULTISTEP = 0.25;
static const double AUTO_EXPLICIT = 0.1;
static const double AUTO_DRIVEN_FIXED = 0.6;
static const double AUTO_DRIVEN_EXPLICIT = 2.0;
static const double AUTO_DRIVEN_MULTISTEP = 40.0;
/* Up to this alpha h, order and cost of a method do not change. */
static const double AUTO_CAP = 0.3;
static const double AUTO_AT_REST = 0.01; /* alpha h that is chosen if nothing moves */
/* A mechanism is considered at rest if the rate of its motion times h is below this. */
static const double REST = 1e-9;
/* A dead-beat point has a spectral radius of at most this. */
static const double DEAD = 1e-6;
static const double WITHIN_REGION = 0.9; /* fraction of the largest stable step */
static const double OVERDAMPED = 1e9;    /* value of alpha / beta if beta is 0 */

typedef void apply_rule(const double value[2], const baum_i_gain_context *context,
                        baum_i_gain_draft *out);

typedef struct rule_type {
  const char *name;
  apply_rule *apply;
  bool needs_step;       /* whether the gains can only be computed from a step h */
  bool positive;         /* whether value[] must be > 0; otherwise it must be >= 0 */
  const char *number[2]; /* names of value[] in messages, or NULL */
  const char *unit[2];
} rule_type;

static bool has_step(const baum_i_gain_context *context)
{
  return context->method->kind != BAUM_I_METHOD_VARIABLE_STEP && !isnan(context->step);
}

/* ---- Rules ---------------------------------------------------------------- */

static void from_rates(double alpha, double beta, const baum_i_gain_context *context,
                       baum_i_gain_draft *out)
{
  double h = has_step(context) ? context->step : (double)NAN;
  out->alpha = alpha;
  out->beta = beta;
  out->alpha_h = alpha * h;
  out->beta2_h2 = (beta * h) * (beta * h);
}

static void from_scaled(double alpha_h, double beta2_h2, const baum_i_gain_context *context,
                        baum_i_gain_draft *out)
{
  out->alpha = alpha_h / context->step;
  out->beta = sqrt(beta2_h2) / context->step;
  out->alpha_h = alpha_h;
  out->beta2_h2 = beta2_h2;
}

static void apply_fixed(const double value[2], const baum_i_gain_context *context,
                        baum_i_gain_draft *out)
{
  from_rates(value[0], value[1], context, out);
}

static void apply_scaled(const double value[2], const baum_i_gain_context *context,
                         baum_i_gain_draft *out)
{
  from_scaled(value[0], value[1], context, out);
}

static void apply_taylor(const double value[2], const baum_i_gain_context *context,
                         baum_i_gain_draft *out)
{
  (void)value;
  from_scaled(1.0, 2.0, context, out);
}

static void apply_frequency(const double value[2], const baum_i_gain_context *context,
                            baum_i_gain_draft *out)
{
  double omega = 2.0 * PI * value[0];
  from_rates(value[1] * omega, omega, context, out);
}

static void apply_best(const double value[2], const baum_i_gain_context *context,
                       baum_i_gain_draft *out)
{
  (void)value;
  double alpha_h;
  double beta2_h2;
  baum_i_stability_best(context->method, &alpha_h, &beta2_h2);
  from_scaled(alpha_h, beta2_h2, context, out);
}

static double auto_factor_with_step(const baum_i_gain_context *context)
{
  const baum_i_method *method = context->method;
  if (context->driven) {
    return AUTO_DRIVEN_FIXED;
  }
  if (method->kind != BAUM_I_METHOD_ONE_STEP || method->degree < 2) {
    return AUTO_OTHERS;
  }
  return method->degree == 2 ? AUTO_FIXED_ORDER_2 : AUTO_FIXED;
}

static double auto_factor(const baum_i_gain_context *context)
{
  if (has_step(context)) {
    return auto_factor_with_step(context);
  }
  if (context->method->kind == BAUM_I_METHOD_VARIABLE_STEP) {
    return context->driven ? AUTO_DRIVEN_MULTISTEP : AUTO_MULTISTEP;
  }
  return context->driven ? AUTO_DRIVEN_EXPLICIT : AUTO_EXPLICIT;
}

static void print_note(baum_i_gain_draft *out, const baum_i_gain_context *context,
                       const char *capped)
{
  baum_i_print(out->note, sizeof out->note, " (%s%g x %.6g 1/s, %s%s)", capped,
               auto_factor(context), context->rate, context->rate_is,
               context->driven ? "; no degree of freedom is left" : "");
}

/* Returns the wanted alpha, reduced so that alpha h is at most AUTO_CAP and at most half of the
 * stability limit. If nothing moves, alpha h is AUTO_AT_REST. */
static double auto_with_step(const baum_i_gain_context *context, double wanted,
                             baum_i_gain_draft *out)
{
  double h = context->step;
  double cap = fmin(AUTO_CAP, 0.5 * baum_i_stability_limit(context->method, 1.0));
  if (context->rate * h < REST) {
    baum_i_print(out->note, sizeof out->note, " (nothing moves at start: alpha h = %g)",
                 AUTO_AT_REST);
    return AUTO_AT_REST / h;
  }
  bool capped = wanted * h > cap;
  print_note(out, context, capped ? "capped; " : "");
  return capped ? cap / h : wanted;
}

static double auto_without_step(const baum_i_gain_context *context, double wanted,
                                baum_i_gain_draft *out)
{
  if (context->rate > 0.0) {
    print_note(out, context, "");
    return wanted;
  }
  baum_i_print(out->note, sizeof out->note,
               " (nothing moves at start: the rate is taken as 1 1/s)");
  return 1.0;
}

static void apply_auto(const double value[2], const baum_i_gain_context *context,
                       baum_i_gain_draft *out)
{
  (void)value;
  double wanted = auto_factor(context) * context->rate;
  double alpha = has_step(context) ? auto_with_step(context, wanted, out)
                                   : auto_without_step(context, wanted, out);
  from_rates(alpha, alpha, context, out);
}

static const rule_type rules[] = {
  [BAUM_GAINS_FIXED] = {"fixed", apply_fixed, false, false, {"alpha", "beta"}, {"1/s", "1/s"}},
  [BAUM_GAINS_SCALED] =
    {"scaled", apply_scaled, true, false, {"alpha h", "beta^2 h^2"}, {"[-]", "[-]"}},
  [BAUM_GAINS_TAYLOR] = {"taylor", apply_taylor, true, false, {NULL, NULL}, {NULL, NULL}},
  [BAUM_GAINS_FREQUENCY] =
    {"frequency", apply_frequency, false, true, {"frequency", "damping ratio"}, {"Hz", "[-]"}},
  [BAUM_GAINS_DEADBEAT] = {"deadbeat", apply_best, true, false, {NULL, NULL}, {NULL, NULL}},
  [BAUM_GAINS_AUTO] = {"auto", apply_auto, false, false, {NULL, NULL}, {NULL, NULL}},
  [BAUM_GAINS_BEST_DAMPING] = {"best_damping", apply_best, true, false, {NULL, NULL}, {NULL, NULL}},
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

/* Returns a rule of the table. If there is no such rule, returns NULL and sets a message. */
static const rule_type *find_rule(int32_t number)
{
  if (number > BAUM_GAINS_DEFAULT && number < RULE_COUNT) {
    return &rules[number];
  }
  (void)baum_i_fail(BAUM_ERR_ARGUMENT,
                    "gains: rule %d is unknown; make gains with baum_gains_fixed(), _scaled(), "
                    "_taylor(), _frequency(), _deadbeat(), _auto() or _best_damping()",
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

/* Checks that the context has the data that the rule requires. */
static baum_status check_needs(const rule_type *rule, const baum_i_gain_context *context)
{
  if (rule->needs_step && !has_step(context)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "gains %s: the rule needs a fixed step, and %s chooses its own steps; use "
                       "fixed, frequency or auto",
                       rule->name, context->integrator);
  }
  if (rule->apply == apply_auto && !(context->rate >= 0.0 && isfinite(context->rate))) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "gains auto: the rate of the motion is %g 1/s, must be finite and >= 0",
                       context->rate);
  }
  return BAUM_OK;
}

/* ---- Choice --------------------------------------------------------------- */

static baum_status make_draft(const rule_type *rule, const double value[2],
                              const baum_i_gain_context *context, baum_i_gain_draft *out)
{
  BAUM_I_TRY(check_numbers(rule, value));
  BAUM_I_TRY(check_needs(rule, context));
  rule->apply(value, context, out);
  if (!isfinite(out->alpha) || !isfinite(out->beta)) {
    return baum_i_fail(
      BAUM_ERR_ARGUMENT,
      "gains %s: alpha = %g 1/s or beta = %g 1/s is too large for double precision", rule->name,
      out->alpha, out->beta);
  }
  return BAUM_OK;
}

static bool is_without_step(const baum_i_gain_context *context)
{
  return context->method->kind == BAUM_I_METHOD_ONE_STEP && !has_step(context);
}

/* Returns the limit of the step of an explicit method with variable steps, and infinity for other
 * methods. */
static double largest_step(const baum_i_gain_context *context, const baum_i_gain_draft *gains)
{
  if (!is_without_step(context) || !(gains->alpha > 0.0)) {
    return (double)INFINITY;
  }
  double ratio = gains->beta > 0.0 ? gains->alpha / gains->beta : OVERDAMPED;
  double positions =
    context->no_position_rows ? (double)INFINITY : baum_i_stability_limit(context->method, ratio);
  double velocities =
    context->velocity_rows ? baum_i_velocity_limit(context->method) : (double)INFINITY;
  return WITHIN_REGION * fmin(positions, velocities) / gains->alpha;
}

/* Finds the amplification of both kinds of rows, and which kind determines the result. This is the
 * kind with the larger spectral radius, or the only kind that the mechanism has. */
static void amplify(const baum_i_gain_context *context, const baum_i_gain_draft *gains,
                    baum_i_two_amplifications *out)
{
  static const baum_i_method variable_step = {.kind = BAUM_I_METHOD_VARIABLE_STEP};
  const baum_i_method *method = has_step(context) ? context->method : &variable_step;
  out->positions.struct_size = out->velocities.struct_size = sizeof out->positions;
  baum_i_amplification(method, gains->alpha_h, gains->beta2_h2, &out->positions);
  baum_i_velocity_amplification(method, gains->alpha_h, &out->velocities);
  bool slower = out->velocities.spectral_radius > out->positions.spectral_radius;
  out->by_velocities = context->no_position_rows || (context->velocity_rows && slower);
}

baum_status baum_i_gains_choose(const baum_gains *gains, const baum_i_gain_context *context,
                                baum_i_gain_choice *out)
{
  bool is_default = gains->rule == BAUM_GAINS_DEFAULT;
  const rule_type *rule = find_rule(is_default ? (int32_t)context->rule_default : gains->rule);
  if (rule == NULL || check_step(context) != BAUM_OK) {
    return BAUM_ERR_ARGUMENT;
  }
  baum_i_gain_draft numbers = {.note = ""};
  BAUM_I_TRY(make_draft(rule, gains->value, context, &numbers));
  baum_i_gain_choice choice = {.alpha = numbers.alpha, .beta = numbers.beta};
  baum_i_two_amplifications two;
  amplify(context, &numbers, &two);
  choice.amplification = two.by_velocities ? two.velocities : two.positions;
  choice.rule = (baum_gain_rule)(rule - rules);
  choice.max_step = largest_step(context, &numbers);
  if (choice.rule == BAUM_GAINS_DEADBEAT && !(two.positions.spectral_radius <= DEAD)) {
    return baum_i_gain_refuse_deadbeat(context, numbers.alpha_h, numbers.beta2_h2,
                                       two.positions.spectral_radius);
  }
  if (choice.amplification.stability == BAUM_UNSTABLE && !context->allow_unstable) {
    return two.by_velocities ? baum_i_gain_refuse_velocities(context, &numbers, &two.velocities)
                             : baum_i_gain_refuse(context, &numbers, two.positions.spectral_radius);
  }
  baum_i_gain_explain(rule->name, context, &numbers, &two, &choice);
  *out = choice;
  return BAUM_OK;
}

/* ---- Constructors --------------------------------------------------------- */

baum_gains baum_gains_fixed(double alpha, double beta)
{
  return (baum_gains){BAUM_GAINS_FIXED, {alpha, beta}};
}

baum_gains baum_gains_scaled(double alpha_h, double beta2_h2)
{
  return (baum_gains){BAUM_GAINS_SCALED, {alpha_h, beta2_h2}};
}

baum_gains baum_gains_taylor(void)
{
  return (baum_gains){BAUM_GAINS_TAYLOR, {0.0, 0.0}};
}

baum_gains baum_gains_frequency(double hertz, double damping_ratio)
{
  return (baum_gains){BAUM_GAINS_FREQUENCY, {hertz, damping_ratio}};
}

baum_gains baum_gains_deadbeat(void)
{
  return (baum_gains){BAUM_GAINS_DEADBEAT, {0.0, 0.0}};
}

baum_gains baum_gains_auto(void)
{
  return (baum_gains){BAUM_GAINS_AUTO, {0.0, 0.0}};
}

baum_gains baum_gains_best_damping(void)
{
  return (baum_gains){BAUM_GAINS_BEST_DAMPING, {0.0, 0.0}};
}
