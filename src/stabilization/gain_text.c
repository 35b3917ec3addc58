/* SPDX-License-Identifier: BSD-3-Clause */
/* Messages about gains.
 *
 * The text warns if a choice is near the edge of the region of stability. In (6) the slower mode
 * decays by exp(-p) per step, where p = Re(A - sqrt(A^2 - B)). The damping of a method agrees with
 * p up to O(p^2), so small gains never cause this warning. If the spectral radius is above 0.95 and
 * the damping is less than a quarter of p, the point is near the edge. */
#include "stabilization/gain_text.h"

#include <math.h>

#include "base/text.h"

static const double BDF_DAMPING_RATIO = 0.618;
static const double EDGE_GROWTH = -0.05; /* spectral radius 0.95; refusals propose 0.9 */
static const double EDGE_SHARE = 0.25;   /* fraction of the damping of (6) */

enum { RADIUS_SIZE = 32, REGION_SIZE = 160, CLAUSE_SIZE = 208 };

/* ---- numbers ---- */

/* Prints a radius with enough digits to differ from 1. */
static void print_radius(double radius, char text[RADIUS_SIZE])
{
  double growth = radius - 1.0;
  if (fabs(growth) > 1e-12 && fabs(growth) < 1e-4) {
    baum_i_print(text, RADIUS_SIZE, "1 %c %.2g", growth > 0.0 ? '+' : '-', fabs(growth));
  } else {
    baum_i_print(text, RADIUS_SIZE, "%.6g", radius);
  }
}

/* Returns alpha h up to which the ray from 0 through a point is stable, or NaN if the point does
 * not define a ray. */
static double limit_on_ray(const baum_i_method *method, const baum_i_gain_draft *gains)
{
  double ratio = gains->alpha_h / sqrt(gains->beta2_h2);
  bool is_own = ratio > 0.0 && isfinite(ratio) && fabs(ratio - 1.0) > 1e-6;
  return is_own ? baum_i_stability_limit(method, ratio) : (double)NAN;
}

static void print_region(const baum_i_method *method, const baum_i_gain_draft *gains,
                         char text[REGION_SIZE])
{
  if (method->kind == BAUM_I_METHOD_SEMI_IMPLICIT) {
    baum_i_print(text, REGION_SIZE, "0 < alpha h < 1 and 0 < beta^2 h^2 < 4 - 4 alpha h");
    return;
  }
  if (method->kind == BAUM_I_METHOD_ONE_STEP && method->degree == 1) {
    baum_i_print(text, REGION_SIZE, "0 < beta^2 h^2 < 2 alpha h and beta^2 h^2 > 4 alpha h - 4");
    return;
  }
  double on_ray = limit_on_ray(method, gains);
  int length = baum_i_print(text, REGION_SIZE, "alpha = beta up to alpha h = %.6g",
                            baum_i_stability_limit(method, 1.0));
  if (!isnan(on_ray)) {
    baum_i_print(text + length, REGION_SIZE - (size_t)length,
                 " and alpha = %.4g beta up to alpha h = %.6g",
                 gains->alpha_h / sqrt(gains->beta2_h2), on_ray);
  }
}

/* ---- refusals ---- */

baum_status baum_i_gain_refuse(const baum_i_gain_context *context, const baum_i_gain_draft *gains,
                               double radius)
{
  char radius_text[RADIUS_SIZE];
  char region[REGION_SIZE];
  double good[2];
  double h = context->step;
  print_radius(radius, radius_text);
  print_region(context->method, gains, region);
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

/* ---- why ---- */

static const char *const class_text[] = {
  [BAUM_STABLE] = "stable",
  [BAUM_MARGINAL] = "marginal: some violations stay",
  [BAUM_UNSTABLE] = "UNSTABLE, violations grow",
};

static const char UNDAMPED[] = "warning: alpha = 0 damps nothing but by the error of the method";

/* Returns the damping p per step of the slower mode of (6). */
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

/* Writes the clause on stability. Returns true if it is a warning. */
static bool print_fixed_step(const baum_i_gain_context *context, const baum_i_gain_draft *gains,
                             const baum_amplification *amplification, char text[CLAUSE_SIZE])
{
  char radius[RADIUS_SIZE];
  bool stable = amplification->stability == BAUM_STABLE;
  bool undamped = stable && gains->alpha_h == 0.0;
  bool near_edge = stable && !undamped && is_near_edge(context, gains);
  print_radius(amplification->spectral_radius, radius);
  int length =
    baum_i_print(text, CLAUSE_SIZE, "(alpha h, beta^2 h^2) = (%.6g, %.6g), spectral radius %s, %s",
                 gains->alpha_h, gains->beta2_h2, radius, class_text[amplification->stability]);
  if (near_edge) {
    baum_i_print(text + length, CLAUSE_SIZE - (size_t)length,
                 "; warning: near the edge of the region, a step leaves %s of a violation and "
                 "not %.3g",
                 radius, exp(-promised_damping(gains)));
  }
  if (undamped) {
    baum_i_print(text + length, CLAUSE_SIZE - (size_t)length, "; %s", UNDAMPED);
  }
  return !stable || undamped || near_edge;
}

/* Writes the clause on stability. Returns true if it is a warning. With explicit and Adams methods,
 * the error test ensures that violations decay. BDF may use orders and steps with which they grow
 * (statement.c). */
static bool print_variable_step(baum_i_method_family family, const baum_i_gain_draft *gains,
                                double max_step, char text[CLAUSE_SIZE])
{
  if (gains->beta == 0.0 && gains->alpha > 0.0) {
    baum_i_print(text, CLAUSE_SIZE,
                 "variable step; warning: beta = 0 leaves violations of position");
    return true;
  }
  if (gains->beta > 0.0 && gains->alpha == 0.0) {
    baum_i_print(text, CLAUSE_SIZE, "variable step; %s", UNDAMPED);
    return true;
  }
  if (isfinite(max_step)) {
    baum_i_print(text, CLAUSE_SIZE,
                 "variable step, at most %.4g s, for beyond is where violations would grow",
                 max_step);
    return false;
  }
  if (family == BAUM_I_FAMILY_BDF && gains->alpha < BDF_DAMPING_RATIO * gains->beta) {
    baum_i_print(text, CLAUSE_SIZE,
                 "variable step; warning: alpha / beta = %.3g < %g, where BDF may not damp",
                 gains->alpha / gains->beta, BDF_DAMPING_RATIO);
    return true;
  }
  baum_i_print(text, CLAUSE_SIZE, "variable step");
  return false;
}

void baum_i_gain_explain(const char *rule, const baum_i_gain_context *context,
                         const baum_i_gain_draft *gains, baum_i_gain_choice *choice)
{
  char clause[CLAUSE_SIZE];
  if (choice->amplification.stability == BAUM_VARIABLE_STEP) {
    choice->doubtful = print_variable_step(context->family, gains, choice->max_step, clause);
  } else {
    choice->doubtful = print_fixed_step(context, gains, &choice->amplification, clause);
  }
  baum_i_print(choice->why, sizeof choice->why, "gains %s: alpha = %.6g 1/s, beta = %.6g 1/s%s; %s",
               rule, gains->alpha, gains->beta, gains->note, clause);
}
