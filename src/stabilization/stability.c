/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds where a method is stable if the damping ratio zeta = alpha / beta is fixed. Stability is
 * then a function of b = |beta h|. In the plane (A, B) = (|alpha h|, (beta h)^2), the points A =
 * zeta b, B = b^2 are called a ray.
 *
 * Along a ray, mu is proportional to b. The search steps through b in equal ratios until the
 * stability changes, and locates the change by bisection. The smallest limits occur on weakly
 * damped rays of methods that are unstable on the imaginary axis. For explicit Euler, the limit is
 * b = 2 zeta. No explicit method is stable if |mu| exceeds about twice its degree.
 *
 * One-step methods are stable where |mu| is small, and the search skips this part. With
 * R = 1 + c_1 mu + ..., c_1 > 0, and Q = sum |c_k| |mu|^k over k >= 2,
 *
 *   |R|^2 <= 1 + 2 c_1 Re mu + 2 Q + (c_1 |mu| + Q)^2
 *         <= 1   if   2 Q + (c_1 |mu| + Q)^2 <= -2 c_1 Re mu.
 *
 * -Re mu / |mu| is at least min(zeta, 1), and Q / |mu| grows with |mu|. If the condition holds for
 * one |mu|, it therefore holds for all smaller ones. */
#include "stabilization/amplification.h"

#include <math.h>
#include <stdbool.h>

static const double SCAN_RATIO = 1.01; /* ratio of each b to the one before */
static const double SCAN_END = 1e3;    /* no explicit method is stable for larger |mu| */
static const double OVERDAMPED = 1e9;  /* the limits do not change for larger zeta */
/* A ray that is stable only for b below this is considered unstable. */
static const double LEAST = 1e-18;
static const double EQUAL = 1e-13; /* radii that differ by less are considered equal */
enum { BISECTIONS = 60, CLOSER = 40, FINE = 8 };

static bool is_stable(const baum_i_method *method, double damping_ratio, double b)
{
  return baum_i_amplification_within(method, damping_ratio * b, b * b, 0.0);
}

/* Returns the b between `from` and `to` at which the stability changes. The method has the same
 * stability at this b as at `from`. */
static double bisect(const baum_i_method *method, double damping_ratio, double from, double to)
{
  bool stable = !is_stable(method, damping_ratio, to);
  for (int k = 0; k < BISECTIONS; k++) {
    double middle = 0.5 * (from + to);
    if (is_stable(method, damping_ratio, middle) == stable) {
      from = middle;
    } else {
      to = middle;
    }
  }
  return from;
}

typedef struct ray {
  double damping_ratio;
  double begin; /* first b of the search; if it is stable, all smaller b are stable, too */
  double end;
} ray;

/* Tells whether the condition at the top of this file proves that a one-step method is stable for
 * all mu of this size or smaller. */
static bool is_surely_stable(const baum_i_method *method, double damping_ratio, double size)
{
  double first = method->coefficients[1]; /* c_1 */
  double rest = 0.0;                      /* Q / |mu| */
  for (int k = method->degree; k > 1; k--) {
    rest = (rest + fabs(method->coefficients[k])) * size;
  }
  double growth = 2.0 * rest + size * (first + rest) * (first + rest);
  return growth <= 2.0 * first * fmin(damping_ratio, 1.0);
}

static ray make_ray(double damping_ratio)
{
  damping_ratio = fmin(damping_ratio, OVERDAMPED);
  double steepest = fmax(1.0, 2.0 * damping_ratio); /* the largest |mu| / b on the ray */
  double begin = fmax(1e-3 * fmin(damping_ratio, 1.0 / steepest), LEAST);
  return (ray){damping_ratio, begin, SCAN_END / steepest};
}

/* Skips the part of a ray that is surely stable. */
static void begin_later(const baum_i_method *method, ray *r)
{
  double steepest = SCAN_END / r->end;
  bool one_step = method->kind == BAUM_I_METHOD_ONE_STEP;
  while (one_step && is_surely_stable(method, r->damping_ratio, 2.0 * r->begin * steepest)) {
    r->begin *= 2.0;
  }
}

/* Returns the next b at which the stability changes, or infinity. `stable` is the stability at
 * b. */
static double next_change(const baum_i_method *method, const ray *r, double b, bool stable)
{
  while (b < r->end) {
    double next = b * SCAN_RATIO;
    if (is_stable(method, r->damping_ratio, next) != stable) {
      return bisect(method, r->damping_ratio, b, next);
    }
    b = next;
  }
  return HUGE_VAL;
}

double baum_i_stability_limit(const baum_i_method *method, double damping_ratio)
{
  ray r = make_ray(damping_ratio);
  begin_later(method, &r);
  if (!is_stable(method, r.damping_ratio, r.begin)) {
    return 0.0;
  }
  return r.damping_ratio * next_change(method, &r, r.begin, true);
}

int baum_i_stability_intervals(const baum_i_method *method, double damping_ratio, int capacity,
                               double *from, double *to)
{
  ray r = make_ray(damping_ratio);
  begin_later(method, &r);
  int count = 0;
  double b = r.begin;
  double low = 0.0;
  bool stable = is_stable(method, r.damping_ratio, b);
  while (b < HUGE_VAL) {
    double change = next_change(method, &r, b, stable);
    if (stable && count < capacity) {
      from[count] = r.damping_ratio * low;
      to[count] = r.damping_ratio * change;
    }
    count += stable;
    stable = !stable;
    low = change;
    b = change;
  }
  return count;
}

/* ---- Best ----------------------------------------------------------------- */

typedef struct lowest {
  double growth;
  double b;
} lowest;

/* Stores a point if it is better than the best one so far. A cheap test rejects most points before
 * their radius is computed. */
static void try_point(const baum_i_method *method, double damping_ratio, double b, lowest *best)
{
  if (baum_i_amplification_within(method, damping_ratio * b, b * b, best->growth)) {
    double growth = baum_i_amplification_growth(method, damping_ratio * b, b * b);
    if (growth < best->growth - EQUAL) {
      *best = (lowest){growth, b};
    }
  }
}

double baum_i_stability_best_on_ray(const baum_i_method *method, double damping_ratio)
{
  ray r = make_ray(damping_ratio);
  lowest best = {0.0, 0.0};
  double b = r.begin;
  while (b < r.end) {
    try_point(method, r.damping_ratio, b, &best);
    b *= SCAN_RATIO;
  }
  double half = best.b * (SCAN_RATIO - 1.0);
  for (int k = 0; k < CLOSER; k++) {
    double middle = best.b;
    for (int i = -FINE; i <= FINE; i++) {
      try_point(method, r.damping_ratio, middle + half * i / FINE, &best);
    }
    half *= 0.5;
  }
  return r.damping_ratio * best.b;
}
