/* SPDX-License-Identifier: BSD-3-Clause */
/* Stable and good points of the plane (A, B) = (|alpha h|, (beta h)^2).
 *
 * Along a ray alpha = zeta beta, A = zeta b, B = b^2. The roots mu grow in proportion to b, so the
 * first instability is looked for on a geometric scale and then bisected. The smallest limits are
 * those of weakly damped rays with methods that are unstable on the imaginary axis: b = 2 zeta for
 * explicit Euler, and nothing explicit is stable beyond |mu| of about twice the degree.
 *
 * Nearest good point: the good region (radius <= 0.9) is looked at from three fifths of the way to
 * the limit of critical damping, from where all of it is in sight for each of our methods (not so
 * from RK3's dead-beat point). Its edge is a polygon over directions, refined where it comes
 * closest to the point asked for. For both Eulers the region is a triangle.
 */
#include "stabilization/amplification.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static const double SCAN_RATIO = 1.01;  /* of neighbouring b */
static const double SCAN_END = 1e3;     /* |mu| beyond which nothing explicit is stable */
static const double OVERDAMPED = 1e9;   /* zeta beyond which limits no longer change */
static const double GOOD_GROWTH = -0.1; /* spectral radius 0.9 */
static const double VIEWPOINT = 0.6;    /* of the limit of critical damping */
static const double EDGE_STEP = 0.05;   /* in looking for the edge of the good region */
static const double EDGE_END = 100.0;
enum { BISECTIONS = 60, DIRECTIONS = 720, SEGMENTS = 16, REFINEMENTS = 12 };

/* ---- Limit ---------------------------------------------------------------- */

static bool ray_is_unstable(const baum_i_method *method, double damping_ratio, double b)
{
  return !baum_i_amplification_within(method, damping_ratio * b, b * b, 0.0);
}

static double bisect_ray(const baum_i_method *method, double damping_ratio, double stable,
                         double unstable)
{
  for (int k = 0; k < BISECTIONS; k++) {
    double middle = 0.5 * (stable + unstable);
    if (ray_is_unstable(method, damping_ratio, middle)) {
      unstable = middle;
    } else {
      stable = middle;
    }
  }
  return stable;
}

double baum_i_stability_limit(const baum_i_method *method, double damping_ratio)
{
  damping_ratio = fmin(damping_ratio, OVERDAMPED);
  double steepest = fmax(1.0, 2.0 * damping_ratio); /* |mu| / b, at most */
  double b = 1e-3 * fmin(damping_ratio, 1.0 / steepest);
  if (ray_is_unstable(method, damping_ratio, b)) {
    return 0.0;
  }
  double end = SCAN_END / steepest;
  while (b < end) {
    double next = b * SCAN_RATIO;
    if (ray_is_unstable(method, damping_ratio, next)) {
      return damping_ratio * bisect_ray(method, damping_ratio, b, next);
    }
    b = next;
  }
  return HUGE_VAL;
}

/* ---- Nearest good point --------------------------------------------------- */

typedef struct view {
  const baum_i_method *method;
  double from[2];   /* a point that sees all of the good region */
  double wanted[2]; /* the point asked for */
} view;

static bool is_good(const baum_i_method *method, const double point[2])
{
  return baum_i_amplification_growth(method, point[0], point[1]) <= GOOD_GROWTH;
}

static void walk(const view *v, double direction, double length, double point[2])
{
  point[0] = v->from[0] + length * cos(direction);
  point[1] = v->from[1] + length * sin(direction);
}

static bool is_good_at(const view *v, double direction, double length)
{
  double point[2];
  walk(v, direction, length, point);
  return is_good(v->method, point);
}

/* The last good point in a direction. */
static void find_edge(const view *v, double direction, double point[2])
{
  double good = 0.0;
  while (good < EDGE_END && is_good_at(v, direction, good + EDGE_STEP)) {
    good += EDGE_STEP;
  }
  double bad = good + EDGE_STEP;
  for (int k = 0; k < BISECTIONS; k++) {
    double middle = 0.5 * (good + bad);
    if (is_good_at(v, direction, middle)) {
      good = middle;
    } else {
      bad = middle;
    }
  }
  walk(v, direction, good, point);
}

/* Distance of the wanted point from the segment p to q. */
static double segment_distance(const double wanted[2], const double p[2], const double q[2])
{
  double along[2] = {q[0] - p[0], q[1] - p[1]};
  double to[2] = {wanted[0] - p[0], wanted[1] - p[1]};
  double square = along[0] * along[0] + along[1] * along[1];
  double part = square > 0.0 ? (along[0] * to[0] + along[1] * to[1]) / square : 0.0;
  part = fmin(fmax(part, 0.0), 1.0);
  return hypot(to[0] - part * along[0], to[1] - part * along[1]);
}

/* Draw the edge between two directions and narrow them to its nearest segment and the two beside
 * it. */
static void narrow(const view *v, int segments, double window[2])
{
  double width = (window[1] - window[0]) / segments;
  double best = window[0];
  double least = HUGE_VAL;
  double p[2];
  double q[2];
  find_edge(v, window[0], q);
  for (int k = 0; k < segments; k++) {
    double direction = window[0] + k * width;
    memcpy(p, q, sizeof p);
    find_edge(v, direction + width, q);
    double here = segment_distance(v->wanted, p, q);
    if (here < least) {
      least = here;
      best = direction;
    }
  }
  window[0] = best - width;
  window[1] = best + 2.0 * width;
}

/* The edge point nearest to the wanted one. */
static void find_nearest_edge(const view *v, double point[2])
{
  double window[2] = {0.0, 2.0 * PI};
  narrow(v, DIRECTIONS, window);
  for (int k = 0; k < REFINEMENTS; k++) {
    narrow(v, SEGMENTS, window);
  }
  find_edge(v, 0.5 * (window[0] + window[1]), point);
}

void baum_i_stability_nearest(const baum_i_method *method, double alpha_h, double beta2_h2,
                              double *good_alpha_h, double *good_beta2_h2)
{
  view v = {.method = method, .wanted = {alpha_h, beta2_h2}};
  double point[2] = {alpha_h, beta2_h2};
  if (!is_good(method, point)) {
    v.from[0] = VIEWPOINT * baum_i_stability_limit(method, 1.0);
    v.from[1] = v.from[0] * v.from[0];
    find_nearest_edge(&v, point);
  }
  *good_alpha_h = point[0];
  *good_beta2_h2 = point[1];
}
