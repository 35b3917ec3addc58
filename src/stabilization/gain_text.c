/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes messages about gains.
 *
 * A message contains a warning if the gains are near the edge of the region of stability. In the
 * exact solution of equation (6) in amplification.c, the slower mode decays by the factor exp(-p)
 * per step, with p = Re(A - sqrt(A^2 - B)). The damping of a method differs from p only by terms of
 * order p^2, so small gains never cause this warning. A point is considered near the edge if its
 * spectral radius is above 0.95 and its damping is less than a quarter of p. */
#include "stabilization/gain_text.h"

#include <math.h>

#include "base/text.h"

static const double BDF_DAMPING_RATIO = 0.618;
/* A spectral radius of 0.95; messages about refused gains propose points with 0.9. */
static const double EDGE_GROWTH = -0.05;
static const double EDGE_SHARE = 0.25; /* fraction of p, the damping that equation (6) promises */

/* ---- numbers ---- */

/* Formats a spectral radius with enough digits to distinguish it from 1. */
static baum_i_text radius_text(double radius)
{
  double growth = radius - 1.0;
  bool close = fabs(growth) > 1e-12 && fabs(growth) < 1e-4;
  return close ? baum_i_text_of("1 %c %.2g", growth > 0.0 ? '+' : '-', fabs(growth))
               : baum_i_text_of("%.6g", radius);
}

/* Returns the alpha h up to which gains with the same ratio alpha / beta are stable. Returns NaN if
 * alpha or beta is 0. Also returns NaN if alpha = beta, because messages always state the limit for
 * this ratio. */
static double limit_on_ray(const baum_i_method *method, const baum_i_gain_draft *gains)
{
  double ratio = gains->alpha_h / sqrt(gains->beta2_h2);
  bool is_own = ratio > 0.0 && isfinite(ratio) && fabs(ratio - 1.0) > 1e-6;
  return is_own ? baum_i_stability_limit(method, ratio) : (double)NAN;
}

static baum_i_text region_text(const baum_i_method *method, const baum_i_gain_draft *gains)
{
  if (method->kind == BAUM_I_METHOD_SEMI_IMPLICIT) {
    return (baum_i_text){"0 < alpha h < 1 and 0 < beta^2 h^2 < 4 - 4 alpha h"};
  }
  if (method->kind == BAUM_I_METHOD_ONE_STEP && method->degree == 1) {
    return (baum_i_text){"0 < beta^2 h^2 < 2 alpha h and beta^2 h^2 > 4 alpha h - 4"};
  }
  double on_ray = limit_on_ray(method, gains);
  double limit = baum_i_stability_limit(method, 1.0);
  return isnan(on_ray)
           ? baum_i_text_of("alpha = beta up to alpha h = %.6g", limit)
           : baum_i_text_of("alpha = beta up to alpha h = %.6g and alpha = %.4g beta up to "
                            "alpha h = %.6g",
                            limit, gains->alpha_h / sqrt(gains->beta2_h2), on_ray);
}

/* ---- refused gains ---- */

baum_status baum_i_gain_refuse(const baum_i_gain_context *context, const baum_i_gain_draft *gains,
                               double radius)
{
  double good[2];
  double h = context->step;
  baum_i_stability_nearest(context->method, gains->alpha_h, gains->beta2_h2, &good[0], &good[1]);
  return baum_i_fail(BAUM_ERR_UNSTABLE,
                     "gains alpha = %.6g 1/s, beta = %.6g 1/s with %s and h = %.6g s: "
                     "(alpha h, beta^2 h^2) = (%.6g, %.6g) has spectral radius %s > 1, violations "
                     "grow; this integrator is stable for %s; nearest good pair: (%.4g, %.4g), "
                     "that is alpha = %.4g 1/s, beta = %.4g 1/s",
                     gains->alpha, gains->beta, context->integrator, h, gains->alpha_h,
                     gains->beta2_h2, radius_text(radius).text,
                     region_text(context->method, gains).text, good[0], good[1], good[0] / h,
                     sqrt(good[1]) / h);
}

baum_status baum_i_gain_refuse_velocities(const baum_i_gain_context *context,
                                          const baum_i_gain_draft *gains,
                                          const baum_amplification *velocities)
{
  double limit = baum_i_velocity_limit(context->method);
  return baum_i_fail(BAUM_ERR_UNSTABLE,
                     "gains alpha = %.6g 1/s with %s and h = %.6g s: for rows of velocity level "
                     "alpha h = %.6g has spectral radius %s > 1, violations of velocities grow; "
                     "this integrator is stable for alpha h < %.6g, that is alpha < %.4g 1/s",
                     gains->alpha, context->integrator, context->step, gains->alpha_h,
                     radius_text(velocities->spectral_radius).text, limit, limit / context->step);
}

baum_status baum_i_gain_refuse_deadbeat(const baum_i_gain_context *context, double alpha_h,
                                        double beta2_h2, double radius)
{
  bool remembers = context->method->kind == BAUM_I_METHOD_ADAMS_BASHFORTH;
  double h = context->step;
  return baum_i_fail(BAUM_ERR_UNSUPPORTED,
                     "gains deadbeat: %s has no dead-beat point, %s; its best point is (alpha h, "
                     "beta^2 h^2) = (%.4g, %.4g) with spectral radius %.4g, that is alpha = %.4g "
                     "1/s, beta = %.4g 1/s: take best_damping",
                     context->integrator,
                     remembers ? "because its past steps keep violations, whatever the gains"
                               : "because no gains bring both roots to zero",
                     alpha_h, beta2_h2, radius, alpha_h / h, sqrt(beta2_h2) / h);
}

/* ---- why gains were chosen ---- */

static const char *const class_text[] = {
  [BAUM_STABLE] = "stable",
  [BAUM_MARGINAL] = "marginal: some violations do not decay",
  [BAUM_UNSTABLE] = "UNSTABLE, violations grow",
};

static const char UNDAMPED[] =
  "warning: with alpha = 0, only the error of the method damps violations";

/* Returns the damping p per step of the slower mode of (6), see the top of this file. */
static double promised_damping(const baum_i_gain_draft *gains)
{
  double A = gains->alpha_h;
  double under_root = A * A - gains->beta2_h2;
  return under_root > 0.0 ? gains->beta2_h2 / (A + sqrt(under_root)) : A;
}

static bool is_near_edge(const baum_i_gain_context *context, const baum_i_gain_draft *gains)
{
  double growth = baum_i_amplification_growth(context->method, gains->alpha_h, gains->beta2_h2);
  return growth > EDGE_GROWTH && -log1p(growth) < EDGE_SHARE * promised_damping(gains);
}

/* A part of a message, which describes stability. */
typedef struct clause {
  baum_i_text text;
  bool warns;
} clause;

/* Writes the clause about rows of velocity level at a fixed step. */
static clause velocity_clause(const baum_i_gain_draft *gains, const baum_amplification *velocities)
{
  bool undamped = gains->alpha_h == 0.0;
  return (clause){
    baum_i_text_of("rows of velocity level: alpha h = %.6g, spectral radius %s, %s%s%s",
                   gains->alpha_h, radius_text(velocities->spectral_radius).text,
                   class_text[velocities->stability], undamped ? "; " : "",
                   undamped ? UNDAMPED : ""),
    velocities->stability != BAUM_STABLE};
}

static clause fixed_step_clause(const baum_i_gain_context *context, const baum_i_gain_draft *gains,
                                const baum_amplification *amplification)
{
  const baum_i_text radius = radius_text(amplification->spectral_radius);
  bool stable = amplification->stability == BAUM_STABLE;
  bool undamped = stable && gains->alpha_h == 0.0;
  bool near_edge = stable && !undamped && is_near_edge(context, gains);
  baum_i_text remark = {""};
  if (near_edge) {
    remark = baum_i_text_of("; warning: near the edge of the region, a step leaves %s of a "
                            "violation instead of %.3g",
                            radius.text, exp(-promised_damping(gains)));
  } else if (undamped) {
    remark = baum_i_text_of("; %s", UNDAMPED);
  }
  return (clause){baum_i_text_of("(alpha h, beta^2 h^2) = (%.6g, %.6g), spectral radius %s, %s%s",
                                 gains->alpha_h, gains->beta2_h2, radius.text,
                                 class_text[amplification->stability], remark.text),
                  !stable || undamped || near_edge};
}

/* With explicit methods, the limit of the step ensures that violations decay; with Adams methods,
 * the error test does. BDF methods may use orders and steps with which violations grow
 * (statement.c). */
static clause variable_step_clause(const baum_i_gain_context *context,
                                   const baum_i_gain_draft *gains, double max_step)
{
  baum_i_method_family family = context->family;
  if (context->no_position_rows && !isfinite(max_step)) {
    return gains->alpha > 0.0 ? (clause){{"variable step"}, false}
                              : (clause){baum_i_text_of("variable step; %s", UNDAMPED), true};
  }
  if (gains->beta == 0.0 && gains->alpha > 0.0) {
    return (clause){{"variable step; warning: beta = 0 leaves violations of position"}, true};
  }
  if (gains->beta > 0.0 && gains->alpha == 0.0) {
    return (clause){baum_i_text_of("variable step; %s", UNDAMPED), true};
  }
  if (isfinite(max_step)) {
    return (clause){baum_i_text_of("variable step, at most %.4g s, because violations would grow "
                                   "with longer steps",
                                   max_step),
                    false};
  }
  if (family == BAUM_I_FAMILY_BDF && gains->alpha < BDF_DAMPING_RATIO * gains->beta) {
    return (clause){baum_i_text_of("variable step; warning: alpha / beta = %.3g < %g, where BDF "
                                   "may not damp violations",
                                   gains->alpha / gains->beta, BDF_DAMPING_RATIO),
                    true};
  }
  return (clause){{"variable step"}, false};
}

void baum_i_gain_explain(const char *rule, const baum_i_gain_context *context,
                         const baum_i_gain_draft *gains, const baum_i_two_amplifications *two,
                         baum_i_gain_choice *choice)
{
  clause about[2] = {{.warns = false}, {.warns = false}};
  int count = 0;
  if (choice->amplification.stability == BAUM_VARIABLE_STEP) {
    about[count++] = variable_step_clause(context, gains, choice->max_step);
  } else {
    if (!context->no_position_rows) {
      about[count++] = fixed_step_clause(context, gains, &two->positions);
    }
    if (context->velocity_rows) {
      about[count++] = velocity_clause(gains, &two->velocities);
    }
  }
  choice->doubtful = about[0].warns || about[1].warns;
  baum_i_print(choice->why, sizeof choice->why,
               "gains %s: alpha = %.6g 1/s, beta = %.6g 1/s%s; %s%s%s", rule, gains->alpha,
               gains->beta, gains->note, about[0].text.text, count > 1 ? "; " : "",
               about[1].text.text);
}
