/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds how far a region of stability extends. The region consists of points mu, with m = |mu|. The
 * search starts at a bound that m certainly does not exceed. This bound is too wide for drawings,
 * so the search goes inwards from it. The bound follows from these facts:
 *
 *   one step         |R(mu)| >= |c_n| m^n - sum_(k<n) |c_k| m^k. Once the right-hand side is
 *                    positive, it grows with m.
 *   Adams-Bashforth  The product of the k roots is mu b_(k-1), and no root exceeds the permitted
 *                    spectral radius rho. Therefore m |b_(k-1)| <= rho^k
 *                    (for k = 1 the root is 1 + mu b_0) */
#include "stabilization/chart.h"

#include <math.h>

static const double PI = 3.14159265358979323846;
static const double FARTHEST = 1e6; /* regions that extend farther are considered unbounded */
enum { COLUMNS = 48, ROWS = 512 };

void baum_i_chart_point(const baum_i_method *method, double s, double m, double point[2])
{
  if (s < 0.0) {
    double u = 1.0 + s;
    point[0] = 0.5 * m * (1.0 + u);
    point[1] = m * m * u;
  } else {
    point[0] = s < 1.0 ? m * cos(0.5 * PI * s) : 0.0;
    point[1] = m * m;
  }
  if (method->kind == BAUM_I_METHOD_SEMI_IMPLICIT) {
    point[0] -= 0.5 * point[1];
  }
}

bool baum_i_chart_within(const baum_i_method *method, const double at[2], double growth)
{
  double point[2];
  if (!(fabs(at[0]) <= 1.0) || at[1] < 0.0) {
    return false;
  }
  baum_i_chart_point(method, at[0], at[1], point);
  return baum_i_amplification_within(method, point[0], point[1], growth);
}

void baum_i_chart_edge(const baum_i_method *method, double growth, int bisections,
                       const double outside[2], double inside[2])
{
  double far[2] = {outside[0], outside[1]};
  for (int k = 0; k < bisections; k++) {
    double middle[2] = {0.5 * (inside[0] + far[0]), 0.5 * (inside[1] + far[1])};
    double *end = baum_i_chart_within(method, middle, growth) ? inside : far;
    end[0] = middle[0];
    end[1] = middle[1];
  }
}

/* Tells whether |R| > radius at m and for all larger m. */
static bool polynomial_is_beyond(const baum_i_method *method, double m, double radius)
{
  double power = 1.0;
  double sum = radius;
  for (int k = 0; k < method->degree; k++) {
    sum += fabs(method->coefficients[k]) * power;
    power *= m;
  }
  return fabs(method->coefficients[method->degree]) * power > sum;
}

static double bound(const baum_i_method *method, double radius)
{
  const int k = method->degree;
  if (method->kind == BAUM_I_METHOD_ADAMS_BASHFORTH) {
    return (pow(radius, k) + (k == 1 ? 1.0 : 0.0)) / fabs(method->coefficients[k - 1]);
  }
  if (method->kind == BAUM_I_METHOD_SEMI_IMPLICIT) {
    return 1.0 + radius;
  }
  double m = 1.0;
  while (m < FARTHEST && !polynomial_is_beyond(method, m, radius)) {
    m *= 1.1;
  }
  return m;
}

static bool reaches(const baum_i_method *method, double m, double growth)
{
  for (int k = 0; k <= COLUMNS; k++) {
    if (baum_i_chart_within(method, (const double[2]){2.0 * k / COLUMNS - 1.0, m}, growth)) {
      return true;
    }
  }
  return false;
}

double baum_i_chart_extent(const baum_i_method *method, double growth)
{
  double most = bound(method, 1.0 + growth);
  if (!(most < FARTHEST)) {
    return HUGE_VAL;
  }
  for (int k = ROWS; k > 0; k--) {
    if (reaches(method, most * k / ROWS, growth)) {
      /* The result includes a few more rows, because a maximum may be between two columns. */
      return most * (k + 3) / ROWS;
    }
  }
  return 0.0;
}
