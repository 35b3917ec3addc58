/* SPDX-License-Identifier: BSD-3-Clause */
/* The nearest good point. The edge of the good region (spectral radius <= 0.9) is crossed by the lines
 * of a lattice in the chart, where the region has no tips that a lattice would miss. Around the
 * crossing that is nearest in the plane the lattice closes in. The region may have any shape and any
 * number of parts.
 */
#include <math.h>
#include <stdbool.h>

#include "stabilization/chart.h"

static const double GOOD_GROWTH = -0.1; /* spectral radius 0.9 */
static const double FARTHEST = 1e3;     /* of the lattice for a region without end */
static const double AROUND = 2.0;       /* cells that the next lattice reaches */
enum { CELLS = 96, FINE_CELLS = 16, LEVELS = 14 };

typedef struct lattice {
  const baum_i_method *method;
  double wanted[2];
  double origin[2]; /* (s, m) */
  double step[2];
  int cells;
  double least;    /* distance of the nearest crossing so far */
  double place[2]; /* (s, m) of it */
  bool found;
} lattice;

static void node(const lattice *l, int i, int j, double at[2])
{
  at[0] = l->origin[0] + i * l->step[0];
  at[1] = l->origin[1] + j * l->step[1];
}

static void try_crossing(lattice *l, const double inside[2], const double outside[2])
{
  double at[2] = {inside[0], inside[1]};
  double point[2];
  baum_i_chart_edge(l->method, GOOD_GROWTH, outside, at);
  baum_i_chart_point(l->method, at[0], at[1], point);
  double distance = hypot(point[0] - l->wanted[0], point[1] - l->wanted[1]);
  if (!l->found || distance < l->least) {
    l->found = true;
    l->least = distance;
    l->place[0] = at[0];
    l->place[1] = at[1];
  }
}

static void try_pair(lattice *l, int i, int j, int di, int dj)
{
  double here[2];
  double there[2];
  node(l, i, j, here);
  node(l, i + di, j + dj, there);
  bool good = baum_i_chart_within(l->method, here, GOOD_GROWTH);
  if (good != baum_i_chart_within(l->method, there, GOOD_GROWTH)) {
    try_crossing(l, good ? here : there, good ? there : here);
  }
}

/* From one node beyond the lattice on, so that the border of the chart is an edge too. */
static void cross_all(lattice *l)
{
  for (int i = -1; i <= l->cells; i++) {
    for (int j = -1; j <= l->cells; j++) {
      try_pair(l, i, j, 1, 0);
      try_pair(l, i, j, 0, 1);
    }
  }
}

static void close_in(lattice *l)
{
  l->cells = FINE_CELLS;
  for (int k = 0; k < LEVELS; k++) {
    for (int d = 0; d < 2; d++) {
      l->origin[d] = l->place[d] - AROUND * l->step[d];
      l->step[d] *= 2.0 * AROUND / FINE_CELLS;
    }
    cross_all(l);
  }
}

void baum_i_stability_nearest(const baum_i_method *method, double alpha_h, double beta2_h2,
                              double *good_alpha_h, double *good_beta2_h2)
{
  *good_alpha_h = alpha_h;
  *good_beta2_h2 = beta2_h2;
  if (baum_i_amplification_within(method, alpha_h, beta2_h2, GOOD_GROWTH)) {
    return;
  }
  double extent = fmin(baum_i_chart_extent(method, GOOD_GROWTH), FARTHEST);
  lattice l = {.method = method,
               .wanted = {alpha_h, beta2_h2},
               .origin = {-1.0, 0.0},
               .step = {2.0 / CELLS, extent / CELLS},
               .cells = CELLS};
  cross_all(&l);
  if (!l.found) {
    baum_i_stability_best(method, good_alpha_h, good_beta2_h2);
    return;
  }
  close_in(&l);
  double point[2];
  baum_i_chart_point(method, l.place[0], l.place[1], point);
  *good_alpha_h = point[0];
  *good_beta2_h2 = point[1];
}
