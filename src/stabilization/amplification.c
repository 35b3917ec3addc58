/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes by which factor one step amplifies a constraint violation. The numbers of equations are
 * those of Flores et al. 2008 (see docs/theory/stabilization.md).
 *
 *   Phi'' + 2 alpha Phi' + beta^2 Phi = 0                                            (6)
 *   s^2 + 2 alpha s + beta^2 = 0                                                     (17)
 *   mu = h s,  A = |alpha h|,  B = (beta h)^2:  mu^2 + 2 A mu + B = 0,  mu = -A +- sqrt(A^2 - B)
 *
 * Rows of velocity level: J a = gamma - alpha Phi' gives (Phi')' + alpha Phi' = 0, and the single
 * mode mu = -A.
 *
 * One-step methods:     z = R(mu), R: stability polynomial (Hairer, Wanner 1996, section IV.2).
 *                       Explicit Euler has R = 1 + mu, which gives
 *                       z^2 + (2 A - 2) z + (B - 2 A + 1) = 0                        (19)
 * Semi-implicit Euler:  v+ = v + h a(x, v),  x+ = x + h v+  has
 *                       z^2 + (B + 2 A - 2) z + (1 - 2 A) = 0,
 *                       with w = z - 1:  w^2 + 2 (A + B/2) w + B = 0,
 *                       which is explicit Euler at (A + B/2, B). The region of stability is
 *                       therefore the triangle of explicit Euler, sheared.
 * Adams-Bashforth:      z^k = z^(k-1) + mu sum_j b_j z^(k-1-j) for each mu: k roots, one of which
 *                       is close to exp(mu) and the others to 0. The test of Schur and Cohn tells
 *                       whether all are inside a circle. Bisection gives the largest |z|, and
 *                       Newton's method in w = z - 1 its last digits.
 *
 * Rounding: everything is computed with w = z - 1, because |z| - 1 = (2 Re w + |w|^2) / (|z| + 1)
 * is accurate even if the gains are small and |z| is close to 1. If A^2 - B is zero up to the
 * rounding errors of alpha h and beta h, it is set to zero. Otherwise rounding would split a double
 * root on the unit circle, such as that of explicit Euler at (2, 4), into two roots at a distance
 * of 1e-8, and one of them would be unstable. */
#include "stabilization/amplification.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "stabilization/schur_cohn.h"

/* If | |z| - 1 | is at most this, the root z is considered to be on the unit circle. The value is
 * about a hundred times the rounding errors of gains and step. */
static const double MARGIN = 1e-12;

/* If |A^2 - B| is below this multiple of A^2, it is considered zero. The value allows for the
 * rounding errors of alpha h and beta h. */
static const double ROUNDING = 16.0 * DBL_EPSILON;

static const double PI = 3.14159265358979323846;

/* A root counts as lying on a circle if its distance from the circle is below this fraction of the
 * radius. If the largest root is double, the radius is accurate only to about 1e-16^(1/3), see
 * schur_cohn.h. */
static const double ROOT_TOLERANCE = 1e-4;

/* If the test of Schur and Cohn gives a margin below this, its result is not used. */
static const double UNDECIDED = 1e-12;

enum { DIRECTIONS = 48, NEWTON_STEPS = 30 };

static const baum_i_method explicit_euler = {
  .kind = BAUM_I_METHOD_ONE_STEP, .degree = 1, .coefficients = {1.0, 1.0}};

typedef struct number {
  double re;
  double im;
} number;

/* Computes the roots of mu^2 + 2 A mu + B = 0. The smaller of two real roots is computed from the
 * product of both, which avoids cancellation. */
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

static number times(number a, number b)
{
  return (number){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

/* Computes w = R(mu) - 1 by Horner's rule. */
static number polynomial_increment(const baum_i_method *method, number mu)
{
  number w = {0.0, 0.0};
  for (int k = method->degree; k > 0; k--) {
    double c = w.re + method->coefficients[k];
    w = (number){c * mu.re - w.im * mu.im, c * mu.im + w.im * mu.re};
  }
  w.re += method->coefficients[0] - 1.0;
  return w;
}

/* Computes w = R(mu) - 1 for real mu. */
static double real_increment(const baum_i_method *method, double mu)
{
  double w = 0.0;
  for (int k = method->degree; k > 0; k--) {
    w = (w + method->coefficients[k]) * mu;
  }
  return w + (method->coefficients[0] - 1.0);
}

/* ---- Adams-Bashforth ------------------------------------------------------ */

/* Returns the polynomial z^k - z^(k-1) - mu sum_j b_j z^(k-1-j). */
static baum_i_polynomial characteristic(const baum_i_method *method, number mu)
{
  baum_i_polynomial p = {.degree = method->degree};
  const int k = method->degree;
  p.c[k][0] = 1.0;
  p.c[k - 1][0] = -1.0;
  for (int j = 0; j < k; j++) {
    p.c[k - 1 - j][0] -= mu.re * method->coefficients[j];
    p.c[k - 1 - j][1] -= mu.im * method->coefficients[j];
  }
  return p;
}

/* Evaluates z^(k-1) w - mu sum_j b_j z^(k-1-j) and its derivative at z = 1 + w. */
static number evaluate(const baum_i_method *method, number mu, number w, number *slope)
{
  const number z = {1.0 + w.re, w.im};
  number power = {1.0, 0.0}; /* z^(k-1) */
  number power_slope = {0.0, 0.0};
  number sum = {method->coefficients[0], 0.0};
  number sum_slope = {0.0, 0.0};
  for (int j = 1; j < method->degree; j++) {
    number next = times(power_slope, z);
    power_slope = (number){next.re + power.re, next.im + power.im};
    power = times(power, z);
    next = times(sum_slope, z);
    sum_slope = (number){next.re + sum.re, next.im + sum.im};
    sum = times(sum, z);
    sum.re += method->coefficients[j];
  }
  number a = times(power_slope, w);
  number b = times(mu, sum_slope);
  *slope = (number){a.re + power.re - b.re, a.im + power.im - b.im};
  a = times(power, w);
  b = times(mu, sum);
  return (number){a.re - b.re, a.im - b.im};
}

static void newton_step(const baum_i_method *method, number mu, number *w)
{
  number slope;
  number value = evaluate(method, mu, *w, &slope);
  double square = slope.re * slope.re + slope.im * slope.im;
  if (square > 0.0) {
    w->re -= (value.re * slope.re + value.im * slope.im) / square;
    w->im -= (value.im * slope.re - value.re * slope.im) / square;
  }
}

/* Returns |p|, where p is the characteristic polynomial, at point number k of the circle about 0
 * with the given radius. */
static double size_on_circle(const baum_i_method *method, number mu, double radius, int k)
{
  double angle = 2.0 * PI * k / DIRECTIONS;
  number slope;
  number value =
    evaluate(method, mu, (number){radius * cos(angle) - 1.0, radius * sin(angle)}, &slope);
  return hypot(value.re, value.im);
}

/* Starts Newton's method at point number k of the circle about 0 with the given radius, and returns
 * the root to which it converges. */
static number polish(const baum_i_method *method, number mu, double radius, int k)
{
  double angle = 2.0 * PI * k / DIRECTIONS;
  number w = {radius * cos(angle) - 1.0, radius * sin(angle)};
  for (int n = 0; n < NEWTON_STEPS; n++) {
    newton_step(method, mu, &w);
  }
  return w;
}

/* Finds w for the root with the largest |z|. The test of Schur and Cohn gives the circle on which
 * this root lies. Newton's method starts at those points of the circle where |p| has a local
 * minimum. It may also converge to roots inside of the circle. The function returns the root that
 * is on the circle. */
static number largest_root(const baum_i_method *method, number mu)
{
  baum_i_polynomial p = characteristic(method, mu);
  double radius = baum_i_schur_cohn_radius(&p);
  number best = {radius - 1.0, 0.0};
  if (!(radius < HUGE_VAL)) {
    return best;
  }
  double least = ROOT_TOLERANCE * radius;
  double before = size_on_circle(method, mu, radius, DIRECTIONS - 1);
  double here = size_on_circle(method, mu, radius, 0);
  for (int k = 0; k < DIRECTIONS; k++) {
    double after = size_on_circle(method, mu, radius, k + 1);
    if (here <= before && here <= after) {
      number w = polish(method, mu, radius, k);
      double off = fabs(hypot(1.0 + w.re, w.im) - radius);
      best = off < least ? w : best;
      least = fmin(off, least);
    }
    before = here;
    here = after;
  }
  return best;
}

static number increment(const baum_i_method *method, number mu)
{
  bool several = method->kind == BAUM_I_METHOD_ADAMS_BASHFORTH;
  return several ? largest_root(method, mu) : polynomial_increment(method, mu);
}

/* ---- Both modes: the two roots mu ---------------------------------------- */

/* Returns |1 + w| - 1. If this overflows, returns infinity. */
static double excess(number w)
{
  double size = hypot(1.0 + w.re, w.im);
  if (size < 2.0) {
    return (2.0 * w.re + w.re * w.re + w.im * w.im) / (size + 1.0);
  }
  return isnan(size) ? HUGE_VAL : size - 1.0;
}

static void find_modes(const baum_i_method *method, double A, double B, number mu[2])
{
  bool sheared = method->kind == BAUM_I_METHOD_SEMI_IMPLICIT;
  characteristic_roots(sheared ? A + 0.5 * B : A, B, mu);
}

/* Computes w for both roots mu. The w with the larger |1 + w| comes first. */
static void increments(const baum_i_method *method, double A, double B, number w[2])
{
  bool sheared = method->kind == BAUM_I_METHOD_SEMI_IMPLICIT;
  const baum_i_method *polynomial = sheared ? &explicit_euler : method;
  number mu[2];
  find_modes(method, A, B, mu);
  w[0] = increment(polynomial, mu[0]);
  w[1] = mu[0].im != 0.0 ? (number){w[0].re, -w[0].im} : increment(polynomial, mu[1]);
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

static void fill_without_region(baum_stability stability, baum_amplification *out)
{
  out->stability = stability;
  const double none = (double)NAN;
  out->spectral_radius = none;
  out->damping = none;
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

/* Tells whether |R(mu)| <= 1 for both mu of a one-step method. Conjugate and equal mu are evaluated
 * once. */
static bool is_one_step_stable(const baum_i_method *method, double A, double B)
{
  number mu[2];
  bool stable = true;
  characteristic_roots(A, B, mu);
  for (int k = 0; k < (mu[0].re == mu[1].re ? 1 : 2) && stable; k++) {
    const number w = mu[k].im == 0.0 ? (number){real_increment(method, mu[k].re), 0.0}
                                     : polynomial_increment(method, mu[k]);
    stable = 2.0 * w.re + w.re * w.re + w.im * w.im <= 0.0;
  }
  return stable;
}

bool baum_i_amplification_within(const baum_i_method *method, double alpha_h, double beta2_h2,
                                 double growth)
{
  if (method->kind == BAUM_I_METHOD_ONE_STEP && growth == 0.0) {
    return is_one_step_stable(method, alpha_h, beta2_h2);
  }
  if (method->kind != BAUM_I_METHOD_ADAMS_BASHFORTH || !(growth > -1.0)) {
    return baum_i_amplification_growth(method, alpha_h, beta2_h2) <= growth;
  }
  number mu[2];
  find_modes(method, alpha_h, beta2_h2, mu);
  double least = 1.0;
  for (int k = 0; k < (mu[0].im != 0.0 ? 1 : 2); k++) {
    baum_i_polynomial p = characteristic(method, mu[k]);
    least = fmin(least, baum_i_schur_cohn_margin(&p, 1.0 + growth));
  }
  if (fabs(least) < UNDECIDED) {
    return baum_i_amplification_growth(method, alpha_h, beta2_h2) <= growth;
  }
  return least > 0.0;
}

void baum_i_amplification(const baum_i_method *method, double alpha_h, double beta2_h2,
                          baum_amplification *out)
{
  if (method->kind == BAUM_I_METHOD_VARIABLE_STEP) {
    fill_without_region(BAUM_VARIABLE_STEP, out);
    return;
  }
  if (method->kind == BAUM_I_METHOD_WITHOUT_GAINS) {
    fill_without_region(BAUM_WITHOUT_GAINS, out);
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
  out->damping = -excess(w[0]);
  out->stability = classify(excess(w[0]));
}

/* ---- Rows of velocity level ------------------------------------------------ */

static const baum_i_method *method_of_velocities(const baum_i_method *method)
{
  return method->kind == BAUM_I_METHOD_SEMI_IMPLICIT ? &explicit_euler : method;
}

double baum_i_velocity_limit(const baum_i_method *method)
{
  /* A row of position level with the damping ratio 1 has the root -alpha h of this row twice. */
  return baum_i_stability_limit(method_of_velocities(method), 1.0);
}

void baum_i_velocity_amplification(const baum_i_method *method, double alpha_h,
                                   baum_amplification *out)
{
  bool has_region =
    method->kind != BAUM_I_METHOD_VARIABLE_STEP && method->kind != BAUM_I_METHOD_WITHOUT_GAINS;
  baum_i_amplification(method, 0.0, 0.0, out);
  if (!has_region) {
    return;
  }
  number w = increment(method_of_velocities(method), (number){-alpha_h, 0.0});
  double growth = excess(w);
  bool finite = growth < HUGE_VAL;
  out->z[0][0] = finite ? 1.0 + w.re : HUGE_VAL;
  out->z[0][1] = finite ? w.im : 0.0;
  out->z[1][0] = out->z[1][1] = (double)NAN;
  out->spectral_radius = hypot(out->z[0][0], out->z[0][1]);
  out->damping = -growth;
  out->stability = classify(growth);
}
