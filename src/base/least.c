/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the minimum of a function of one variable by Brent's method. A step goes to the vertex of
 * the parabola through the three lowest points found so far. If this step is longer than half of
 * the step before the last one, the search instead goes from the lowest point towards the end that
 * is farther away, by 0.38 of the distance to this end (golden section).
 *
 * R. P. Brent, Algorithms for Minimization Without Derivatives, 1973, section 5.8. If the function
 * resembles a parabola near its minimum, about eight evaluations locate the minimum to a millionth
 * of the interval; steps by golden section alone need thirty evaluations.
 */
#include "base/least.h"

#include <math.h>
#include <stdbool.h>

static const double SECTION = 0.3819660112501051; /* 2 - golden ratio */

typedef struct place {
  double t;
  double value;
} place;

typedef struct search {
  double ends[2];   /* the ends of the interval that contains the minimum */
  place least[3];   /* the three lowest points, the lowest first; some may coincide */
  double tolerance; /* allowed error of the position of the minimum */
  double step;      /* the last step */
  double before;    /* the step before the last one */
} search;

/* Return the step from the lowest point to the vertex of the parabola through the three points. The
 * step is NaN or infinite if the points are collinear. */
static double to_vertex(const place p[3])
{
  double u = p[0].t - p[1].t;
  double w = p[0].t - p[2].t;
  double r = u * (p[0].value - p[2].value);
  double q = w * (p[0].value - p[1].value);
  return -0.5 * (w * q - u * r) / (q - r);
}

/* Return whether t is so far from both ends that the value of the function at t gives new
 * information. */
static bool is_inside(const search *s, double t)
{
  return t - s->ends[0] >= 2.0 * s->tolerance && s->ends[1] - t >= 2.0 * s->tolerance;
}

static double next_place(search *s)
{
  double t = s->least[0].t;
  double middle = 0.5 * (s->ends[0] + s->ends[1]);
  double step = to_vertex(s->least);
  double larger = t < middle ? s->ends[1] - t : s->ends[0] - t;
  bool halves = fabs(s->before) > s->tolerance && fabs(step) < 0.5 * fabs(s->before);
  s->before = s->step;
  if (!halves || t + step <= s->ends[0] || t + step >= s->ends[1]) {
    s->before = larger;
    step = SECTION * larger;
  } else if (!is_inside(s, t + step)) {
    step = copysign(s->tolerance, middle - t);
  }
  s->step = fabs(step) < s->tolerance ? copysign(s->tolerance, step) : step;
  return t + s->step;
}

static void include_value(search *s, place new)
{
  place *p = s->least;
  if (new.value <= p[0].value) {
    s->ends[new.t < p[0].t] = p[0].t;
    p[2] = p[1];
    p[1] = p[0];
    p[0] = new;
    return;
  }
  s->ends[new.t >= p[0].t] = new.t;
  if (new.value <= p[1].value || p[1].t == p[0].t) {
    p[2] = p[1];
    p[1] = new;
  } else if (new.value <= p[2].value || p[2].t == p[0].t || p[2].t == p[1].t) {
    p[2] = new;
  }
}

static bool is_known(const search *s)
{
  double middle = 0.5 * (s->ends[0] + s->ends[1]);
  return fabs(s->least[0].t - middle) <= 2.0 * s->tolerance - 0.5 * (s->ends[1] - s->ends[0]);
}

double baum_i_least(baum_i_function *function, void *user, const double ends[2], double tolerance,
                    int most, double *at)
{
  search s = {.ends = {ends[0], ends[1]}, .tolerance = tolerance};
  double t = ends[0] + SECTION * (ends[1] - ends[0]);
  place first = {t, function(user, t)};
  for (int k = 0; k < 3; k++) {
    s.least[k] = first;
  }
  for (int k = 1; k < most && !is_known(&s); k++) {
    t = next_place(&s);
    include_value(&s, (place){t, function(user, t)});
  }
  *at = s.least[0].t;
  return s.least[0].value;
}
