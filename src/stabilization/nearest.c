/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the nearest good point. A point is good if its spectral radius is at most 0.9. The search
 * finds the points at which the lines of a lattice cross the edge of the good region. It is
 * repeated with finer lattices around the crossing that is nearest in the plane (A, B). The
 * lattices are in the chart (chart.h), where regions have no sharp tips that could lie between
 * lines. The region may have any shape and consist of any number of parts. */
#include <math.h>
#include <stdbool.h>

#include "stabilization/chart.h"

static const double GOOD_GROWTH = -0.1; /* a spectral radius of 0.9 */
static const double FARTHEST = 1e3;     /* how far the lattice extends if the region is unbounded */
/* Half the extent of the next lattice, in cells of the present lattice. */
static const double AROUND = 2.0;
enum { CELLS = 96, FINE_CELLS = 16, LEVELS = 16, BISECTIONS = 8 };

typedef struct lattice {
  const baum_i_method *method;
  double wanted[2];
  double origin[2]; /* first node (s, m) */
  double step[2];
  int cells;
  double least;    /* distance of the nearest crossing so far */
  double place[2]; /* the place (s, m) of this crossing */
  bool found;
} lattice;

/* Locates the crossing between a node and the preceding node in direction d. Exactly one of these
 * two nodes is good. Stores the crossing if it is nearer than all others so far. */
static void try_crossing(lattice *l, const double node[2], bool good, int d)
{
  double before[2] = {node[0], node[1]};
  before[d] -= l->step[d];
  const double *inside = good ? node : before;
  const double *outside = good ? before : node;
  double at[2] = {inside[0], inside[1]};
  double point[2];
  baum_i_chart_edge(l->method, GOOD_GROWTH, BISECTIONS, outside, at);
  baum_i_chart_point(l->method, at[0], at[1], point);
  double distance = hypot(point[0] - l->wanted[0], point[1] - l->wanted[1]);
  if (!l->found || distance < l->least) {
    l->found = true;
    l->least = distance;
    l->place[0] = at[0];
    l->place[1] = at[1];
  }
}

static bool is_good_node(const lattice *l, int i, int j, double at[2])
{
  at[0] = l->origin[0] + i * l->step[0];
  at[1] = l->origin[1] + j * l->step[1];
  return baum_i_chart_within(l->method, at, GOOD_GROWTH);
}

/* Examines all lines of the lattice, and also one node beyond both ends of each line. Nodes outside
 * the chart are not good, so the border of the chart counts as an edge of the region. */
static void cross_all(lattice *l)
{
  bool column[CELLS + 3] = {false}; /* whether each node of the previous column is good */
  for (int i = -1; i <= l->cells + 1; i++) {
    bool below = false;
    for (int j = -1; j <= l->cells + 1; j++) {
      double at[2];
      bool good = is_good_node(l, i, j, at);
      if (i >= 0 && good != column[j + 1]) {
        try_crossing(l, at, good, 0);
      }
      if (j >= 0 && good != below) {
        try_crossing(l, at, good, 1);
      }
      below = column[j + 1] = good;
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
