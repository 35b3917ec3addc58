/* SPDX-License-Identifier: BSD-3-Clause */
/* Integrates by extrapolation of the linearly implicit midpoint rule (G. Bader, P. Deuflhard,
 * Numerische Mathematik 41 (1983) 373). The error of this rule is a series in h^2, where h is the
 * step, even if the Jacobian is inaccurate. A Jacobian by differences is therefore sufficient. If
 * the Jacobian is zero, the method is that of Gragg, Bulirsch and Stoer.
 */
#include "oracle.h"

#include <math.h>

enum { COLUMNS = 8, MOST_STEPS = 4000 };

static const int PARTS[COLUMNS] = {2, 6, 10, 14, 22, 34, 50, 70};
/* The largest permitted error of x in a step. Extrapolation enlarges the rounding error of long
 * double, 5e-20, about ten times. */
static const long double TOLERANCE = 1e-17L;

typedef struct slopes {
  long double x;
  long double v;
} slopes;

/* Computes the Jacobian by central differences. Its accuracy only affects how fast the
 * extrapolation converges. */
static slopes slopes_at(const oracle *o, oracle_state y, long double span)
{
  long double dx = 1e-6L;
  long double dv = 1e-6L * (fabsl(y.v) + 1.0L / fabsl(span));
  return (slopes){
    (o->acceleration(o->scene, y.x + dx, y.v) - o->acceleration(o->scene, y.x - dx, y.v)) /
      (2 * dx),
    (o->acceleration(o->scene, y.x, y.v + dv) - o->acceleration(o->scene, y.x, y.v - dv)) /
      (2 * dv),
  };
}

/* Returns (1 - h J)^-1 r. */
static oracle_state solve(slopes j, long double h, oracle_state r)
{
  long double det = 1 - h * j.v - h * h * j.x;
  return (oracle_state){((1 - h * j.v) * r.x + h * r.v) / det, (h * j.x * r.x + r.v) / det};
}

static oracle_state residual(const oracle *o, long double h, oracle_state y, oracle_state d)
{
  return (oracle_state){h * y.v - d.x, h * o->acceleration(o->scene, y.x, y.v) - d.v};
}

static oracle_state midpoints(const oracle *o, slopes j, long double span, int parts,
                              oracle_state y)
{
  long double h = span / parts;
  oracle_state d = solve(j, h, residual(o, h, y, (oracle_state){0}));
  y = (oracle_state){y.x + d.x, y.v + d.v};
  for (int k = 1; k < parts; k++) {
    oracle_state c = solve(j, h, residual(o, h, y, d));
    d = (oracle_state){d.x + 2 * c.x, d.v + 2 * c.v};
    y = (oracle_state){y.x + d.x, y.v + d.v};
  }
  d = solve(j, h, residual(o, h, y, d));
  return (oracle_state){y.x + d.x, y.v + d.v};
}

/* Extrapolates a step by Neville's scheme. Returns the difference of the last two columns. */
static long double step(const oracle *o, long double span, oracle_state from, oracle_state *to)
{
  slopes j = slopes_at(o, from, span);
  oracle_state table[COLUMNS];
  oracle_state change = {0};
  for (int k = 0; k < COLUMNS; k++) {
    table[k] = midpoints(o, j, span, PARTS[k], from);
    for (int i = k - 1; i >= 0; i--) {
      long double ratio = (long double)PARTS[k] / PARTS[i];
      long double weight = 1 / (ratio * ratio - 1);
      change = (oracle_state){(table[i + 1].x - table[i].x) * weight,
                              (table[i + 1].v - table[i].v) * weight};
      table[i] = (oracle_state){table[i + 1].x + change.x, table[i + 1].v + change.v};
    }
  }
  *to = table[0];
  return fmaxl(fabsl(change.x), fabsl(change.v * span));
}

bool oracle_advance(const oracle *o, long double span, oracle_state *state)
{
  long double done = 0;
  long double h = span;
  for (int k = 0; k < MOST_STEPS && done != span; k++) {
    oracle_state next;
    bool last = fabsl(span - done) <= fabsl(h);
    h = last ? span - done : h;
    long double error = step(o, h, *state, &next);
    /* The step is also shortened if the error is NaN. */
    if (!(error <= TOLERANCE * (1 + fabsl(state->x)))) {
      h /= 2;
      continue;
    }
    *state = next;
    done = last ? span : done + h;
    h *= error < 1e-3L * TOLERANCE ? 2.0L : 1.2L;
  }
  return done == span;
}
