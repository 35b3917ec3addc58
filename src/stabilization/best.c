/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the points at which violations decay fastest.
 *
 * The symbols are those of docs/theory/stabilization.md: A = alpha h, B = (beta h)^2, and z = R(mu)
 * is the factor of one step. At a dead-beat point, all z are 0. A zero mu of R and its conjugate
 * give the dead-beat point A = -Re mu, B = |mu|^2.
 *   explicit Euler   R = 1 + mu            mu = -1, double      (1, 1), two steps
 *   RK2              R = 1 + mu + mu^2/2   mu = -1 +- i         (1, 2), as by the rule taylor
 *   RK3, RK4, ...    Newton's method       (0.702, 3.76) and (1.729, 3.78)
 *   semi-implicit Euler: explicit Euler's point, transformed back: (1 - 1/2, 1)
 * If the two zeros differ, one step removes the whole violation. If they are a double zero, two
 * steps are needed. For RK3, the pair of complex zeros is therefore chosen, and not the real zero
 * at (1.596, 2.547). If there are several pairs, the one with the smallest |mu| is chosen, because
 * its gains are the smallest. Only zeros with negative Re mu are possible, because alpha must be
 * positive.
 *
 * Adams-Bashforth methods use past steps. They therefore have no dead-beat point. Their spectral
 * radius is smallest at a pair of complex mu or at a double mu, for the following reason. If the
 * two mu are real and different, one of them has the larger |z|, which is the spectral radius. If
 * this mu is moved onto the other one, the spectral radius does not become larger.
 * baum_i_stability_best() searches for the point with the smallest spectral radius on a lattice in
 * the chart (chart.h). The lattice is refined around the best point found so far, which at first is
 * the best point with critical damping. The largest of several |z| is, as a function of the point,
 * a surface with sharp valleys. A descent method would stop in such a valley. A search on a lattice
 * does not stop there. */
#include <math.h>
#include <stdbool.h>

#include "stabilization/chart.h"

static const double PI = 3.14159265358979323846;
/* A zero has |R| below this, and a real zero has |Im mu| below this. */
static const double ZERO = 1e-10;
/* Radii that differ by less than this are considered equal, because the radius of AB2 has a
 * plateau. */
static const double EQUAL = 1e-12;
static const double CLOSE_IN = 0.6; /* size of each search window relative to the one before */
static const double FARTHEST = 1e3; /* how far the lattice extends if the region is unbounded */
enum { NEWTON_STEPS = 60, STARTS = 16, LATTICE = 48, FINE_LATTICE = 16, LEVELS = 30 };

/* ---- Dead-beat ------------------------------------------------------------ */

/* Makes one step of Newton's method for complex mu: mu := mu - R(mu) / R'(mu). Returns |R| at the
 * point where the step begins. */
static double newton_step(const baum_i_method *method, double mu[2])
{
  double r[2] = {0.0, 0.0};
  double d[2] = {0.0, 0.0};
  for (int k = method->degree; k >= 0; k--) {
    double next[2] = {d[0] * mu[0] - d[1] * mu[1] + r[0], d[0] * mu[1] + d[1] * mu[0] + r[1]};
    d[0] = next[0];
    d[1] = next[1];
    double real = r[0] * mu[0] - r[1] * mu[1] + method->coefficients[k];
    r[1] = r[0] * mu[1] + r[1] * mu[0];
    r[0] = real;
  }
  double square = d[0] * d[0] + d[1] * d[1];
  if (square > 0.0) {
    mu[0] -= (r[0] * d[0] + r[1] * d[1]) / square;
    mu[1] -= (r[1] * d[0] - r[0] * d[1]) / square;
  }
  return hypot(r[0], r[1]);
}

static bool is_better_zero(const double mu[2], const double best[2])
{
  bool pair = fabs(mu[1]) > ZERO;
  bool best_is_pair = fabs(best[1]) > ZERO;
  double size = hypot(mu[0], mu[1]);
  double best_size = hypot(best[0], best[1]);
  return pair != best_is_pair ? pair : size < best_size * (1.0 - 1e-6);
}

/* Finds the best zero of R that has Re mu < 0. Returns false if there is none. Newton's method
 * starts from many points at distances from 1 to (degree + 1) / 2 from 0. For all methods of this
 * library, the best zero is not farther from 0 than the last of these points. */
static bool find_zero(const baum_i_method *method, double best[2])
{
  bool found = false;
  for (int k = 0; k < STARTS * method->degree; k++) {
    double angle = PI * (0.5 + (k % STARTS + 0.5) / (2 * STARTS));
    int ring = k / STARTS;
    double size = 1.0 + 0.5 * ring;
    double mu[2] = {size * cos(angle), size * sin(angle)};
    double rest = 1.0;
    for (int n = 0; n < NEWTON_STEPS; n++) {
      rest = newton_step(method, mu);
    }
    if (rest < ZERO && mu[0] < 0.0 && (!found || is_better_zero(mu, best))) {
      best[0] = mu[0];
      best[1] = mu[1];
      found = true;
    }
  }
  return found;
}

/* ---- Least spectral radius ----------------------------------------------- */

typedef struct search {
  const baum_i_method *method;
  double growth; /* the smallest growth found so far */
  double s;      /* the best point (s, m) in the chart */
  double m;
  double point[2];
} search;

/* Stores a point if it is better than the best one so far. A cheap test rejects most points before
 * their radius is computed. */
static void try_point(search *best, double s, double m)
{
  double point[2];
  baum_i_chart_point(best->method, s, m, point);
  if (!(point[0] > 0.0) ||
      !baum_i_amplification_within(best->method, point[0], point[1], best->growth)) {
    return;
  }
  double growth = baum_i_amplification_growth(best->method, point[0], point[1]);
  if (growth < best->growth - EQUAL) {
    best->growth = growth;
    best->s = s;
    best->m = m;
    best->point[0] = point[0];
    best->point[1] = point[1];
  }
}

static void search_window(search *best, const baum_i_chart_window *w, int cells)
{
  for (int i = 0; i <= cells; i++) {
    for (int j = 0; j <= cells; j++) {
      double s = w->s[0] + (w->s[1] - w->s[0]) * i / cells;
      double m = w->m[0] + (w->m[1] - w->m[0]) * j / cells;
      if (s >= -1.0 && s <= 1.0 && m > 0.0) {
        try_point(best, s, m);
      }
    }
  }
}

/* Searches a window, and then LEVELS smaller and smaller windows around the best point. */
static void close_in(search *best, baum_i_chart_window window)
{
  search_window(best, &window, LATTICE);
  double half_s = 0.5 * (window.s[1] - window.s[0]);
  double half_m = 0.5 * (window.m[1] - window.m[0]);
  for (int k = 0; k < LEVELS; k++) {
    half_s *= CLOSE_IN;
    half_m *= CLOSE_IN;
    window = (baum_i_chart_window){{best->s - half_s, best->s + half_s},
                                   {best->m - half_m, best->m + half_m}};
    search_window(best, &window, FINE_LATTICE);
  }
}

bool baum_i_stability_deadbeat(const baum_i_method *method, double *alpha_h, double *beta2_h2)
{
  double mu[2] = {0.0, 0.0};
  if (method->kind == BAUM_I_METHOD_SEMI_IMPLICIT) {
    *alpha_h = 0.5;
    *beta2_h2 = 1.0;
    return true;
  }
  if (method->kind != BAUM_I_METHOD_ONE_STEP || !find_zero(method, mu)) {
    return false;
  }
  *alpha_h = -mu[0];
  *beta2_h2 = mu[0] * mu[0] + mu[1] * mu[1];
  return true;
}

void baum_i_stability_best(const baum_i_method *method, double *alpha_h, double *beta2_h2)
{
  if (baum_i_stability_deadbeat(method, alpha_h, beta2_h2)) {
    return;
  }
  if (method->best[0] > 0.0) {
    *alpha_h = method->best[0];
    *beta2_h2 = method->best[1];
    return;
  }
  search best = {.method = method};
  double extent = fmin(baum_i_chart_extent(method, 0.0), FARTHEST);
  /* The best point with critical damping is often the best point of all. */
  try_point(&best, 0.0, baum_i_stability_best_on_ray(method, 1.0));
  close_in(&best, (baum_i_chart_window){{0.0, 1.0}, {0.0, extent}});
  *alpha_h = best.point[0];
  *beta2_h2 = best.point[1];
}
