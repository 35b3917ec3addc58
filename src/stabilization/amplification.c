/* SPDX-License-Identifier: BSD-3-Clause */
/* What one step makes of a violation.
 *
 *   Phi'' + 2 alpha Phi' + beta^2 Phi = 0                                            (6)
 *   s^2 + 2 alpha s + beta^2 = 0                                                     (17)
 *   mu = h s,  A = |alpha h|,  B = (beta h)^2:  mu^2 + 2 A mu + B = 0,  mu = -A +- sqrt(A^2 - B)
 *
 * One-step methods:     z = R(mu), R the stability polynomial (Hairer, Wanner 1996, section IV.2).
 *                       Explicit Euler has R = 1 + mu, which gives
 *                       z^2 + (2 A - 2) z + (B - 2 A + 1) = 0                        (19)
 * Semi-implicit Euler:  v+ = v + h a(x, v),  x+ = x + h v+  has
 *                       z^2 + (B + 2 A - 2) z + (1 - 2 A) = 0,
 *                       with w = z - 1:  w^2 + 2 (A + B/2) w + B = 0,
 *                       which is explicit Euler at (A + B/2, B): the same triangle, sheared.
 *
 * Numbers: everything is computed in w = z - 1, because |z| - 1 = (2 Re w + |w|^2) / (|z| + 1)
 * keeps its digits where gains are small and |z| is close to 1. Where A^2 - B is zero up to the
 * rounding of alpha h and beta h it is taken as zero, else a double root on the circle, as explicit
 * Euler has at (2, 4), would be torn apart by 1e-8 and called unstable.
 */
#include "stabilization/amplification.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* | |z| - 1 | up to this is the circle itself: rounding of gains and step, some hundred times
 * over. */
static const double MARGIN = 1e-12;

/* Of A^2 - B, relative to A^2: some roundings of alpha h and beta h, squared. */
static const double ROUNDING = 16.0 * DBL_EPSILON;

static const baum_i_method explicit_euler = {BAUM_I_METHOD_ONE_STEP, 1, {1.0, 1.0}};

typedef struct number {
  double re;
  double im;
} number;

/* Roots of mu^2 + 2 A mu + B = 0; the smaller real one from the product, free of cancellation. */
static void characteristic_roots(double A, double B, number mu[2])
{
  double square = A * A - B;
  if (fabs(square) <= ROUNDING * A * A) {
    square = 0.0;
  }
  double d = sqrt(fabs(square));
  if (square < 0.0) {
    mu[0] = (number){-A, d};
    mu[1] = (number){-A, -d};
    return;
  }
  double larger = -(A + copysign(d, A));
  mu[0] = (number){larger, 0.0};
  mu[1] = (number){d == 0.0 ? larger : B / larger, 0.0};
}

/* w = R(mu) - 1, by Horner's rule. */
static number increment(const baum_i_method *method, number mu)
{
  number w = {0.0, 0.0};
  for (int k = method->degree; k > 0; k--) {
    double c = w.re + method->coefficients[k];
    w = (number){c * mu.re - w.im * mu.im, c * mu.im + w.im * mu.re};
  }
  w.re += method->coefficients[0] - 1.0;
  return w;
}

/* |1 + w| - 1; infinite when it is beyond double. */
static double excess(number w)
{
  double size = hypot(1.0 + w.re, w.im);
  if (size < 2.0) {
    return (2.0 * w.re + w.re * w.re + w.im * w.im) / (size + 1.0);
  }
  return isnan(size) ? HUGE_VAL : size - 1.0;
}

/* Both w, the one of larger |1 + w| first. */
static void increments(const baum_i_method *method, double A, double B, number w[2])
{
  bool sheared = method->kind == BAUM_I_METHOD_SEMI_IMPLICIT;
  const baum_i_method *polynomial = sheared ? &explicit_euler : method;
  number mu[2];
  characteristic_roots(sheared ? A + 0.5 * B : A, B, mu);
  w[0] = increment(polynomial, mu[0]);
  w[1] = increment(polynomial, mu[1]);
  if (excess(w[1]) > excess(w[0])) {
    number swap = w[0];
    w[0] = w[1];
    w[1] = swap;
  }
}

static baum_stability classify(double growth)
{
  if (growth > MARGIN) {
    return BAUM_UNSTABLE;
  }
  return growth < -MARGIN ? BAUM_STABLE : BAUM_MARGINAL;
}

static void fill_variable_step(baum_amplification *out)
{
  out->stability = BAUM_VARIABLE_STEP;
  const double none = (double)NAN;
  out->spectral_radius = none;
  for (int k = 0; k < 2; k++) {
    out->z[k][0] = none;
    out->z[k][1] = none;
  }
}

double baum_i_amplification_growth(const baum_i_method *method, double alpha_h, double beta2_h2)
{
  number w[2];
  increments(method, alpha_h, beta2_h2, w);
  return excess(w[0]);
}

void baum_i_amplification(const baum_i_method *method, double alpha_h, double beta2_h2,
                          baum_amplification *out)
{
  if (method->kind == BAUM_I_METHOD_VARIABLE_STEP) {
    fill_variable_step(out);
    return;
  }
  number w[2];
  increments(method, alpha_h, beta2_h2, w);
  for (int k = 0; k < 2; k++) {
    bool finite = excess(w[k]) < HUGE_VAL;
    out->z[k][0] = finite ? 1.0 + w[k].re : HUGE_VAL;
    out->z[k][1] = finite ? w[k].im : 0.0;
  }
  out->spectral_radius = hypot(out->z[0][0], out->z[0][1]);
  out->stability = classify(excess(w[0]));
}
