/* SPDX-License-Identifier: BSD-3-Clause */
/* Performs the test of Schur (1917) and Cohn (1922), which tells whether all roots of a polynomial
 * are inside a circle.
 *
 *   p(z) = c_0 + ... + c_n z^n,   p*(z) = z^n conj(p(1 / conj z)) with coefficients conj(c_(n-k))
 *   Tp   = (conj(c_n) p - c_0 p*) / z,   of degree n - 1
 *
 * On the unit circle, |p| = |p*|. If |c_0| < |c_n|, the term with p is therefore larger there than
 * the term with p*. By Rouche's theorem, Tp then has one root fewer inside the circle than p. Hence
 * all n roots of p are inside if and only if |c_0| < |c_n| and all n - 1 roots of Tp are inside. If
 * |c_0| >= |c_n|, at least one root is not inside, because |c_0 / c_n| is the product of the
 * magnitudes of all roots. For a circle of radius r, each c_k is replaced by c_k r^k.
 *
 * A bisection of r gives the largest |z|.
 */
#include "stabilization/schur_cohn.h"

#include <math.h>

static const double RADIUS_TOLERANCE = 1e-10;
enum { MOST_BISECTIONS = 400 };

static double square(const double c[2])
{
  return c[0] * c[0] + c[1] * c[1];
}

/* Scales the polynomial so that the circle has radius 1 and the largest coefficient is 1. This is
 * allowed because only ratios of coefficients matter. */
static void scale(baum_i_polynomial *p, double radius)
{
  double power = 1.0;
  double most = 0.0;
  for (int k = 0; k <= p->degree; k++) {
    p->c[k][0] *= power;
    p->c[k][1] *= power;
    most = fmax(most, fmax(fabs(p->c[k][0]), fabs(p->c[k][1])));
    power *= radius;
  }
  for (int k = 0; k <= p->degree; k++) {
    p->c[k][0] /= most;
    p->c[k][1] /= most;
  }
}

/* Replace p by Tp / |c_n|^2. */
static void reduce(baum_i_polynomial *p)
{
  const int n = p->degree;
  const double first[2] = {p->c[0][0], p->c[0][1]};
  const double last[2] = {p->c[n][0], p->c[n][1]};
  const double size = square(last);
  double next[BAUM_I_SCHUR_COHN_DEGREE][2];
  for (int k = 0; k < n; k++) {
    const double *up = p->c[k + 1];
    const double *mirror = p->c[n - 1 - k];
    next[k][0] = last[0] * up[0] + last[1] * up[1] - first[0] * mirror[0] - first[1] * mirror[1];
    next[k][1] = last[0] * up[1] - last[1] * up[0] - first[1] * mirror[0] + first[0] * mirror[1];
  }
  for (int k = 0; k < n; k++) {
    p->c[k][0] = next[k][0] / size;
    p->c[k][1] = next[k][1] / size;
  }
  p->degree = n - 1;
}

double baum_i_schur_cohn_margin(const baum_i_polynomial *p, double radius)
{
  baum_i_polynomial rest = *p;
  double least = 1.0;
  scale(&rest, radius);
  while (rest.degree > 0) {
    double first = square(rest.c[0]);
    double last = square(rest.c[rest.degree]);
    if (!(first < last)) {
      return last > 0.0 ? fmax(1.0 - first / last, -1.0) : -1.0;
    }
    least = fmin(least, 1.0 - first / last);
    reduce(&rest);
  }
  return least;
}

double baum_i_schur_cohn_radius(const baum_i_polynomial *p)
{
  double inside = 0.0;
  double outside = 1.0; /* 1 + the sum of |c_k|, which is larger than all |z| */
  for (int k = 0; k < p->degree; k++) {
    outside += hypot(p->c[k][0], p->c[k][1]);
  }
  if (!(pow(outside, p->degree) < HUGE_VAL)) { /* the condition also holds if the power is NaN */
    return HUGE_VAL;
  }
  for (int k = 0; k < MOST_BISECTIONS && outside - inside > RADIUS_TOLERANCE * outside; k++) {
    double middle = 0.5 * (inside + outside);
    if (baum_i_schur_cohn_margin(p, middle) > 0.0) {
      outside = middle;
    } else {
      inside = middle;
    }
  }
  return 0.5 * (inside + outside);
}
