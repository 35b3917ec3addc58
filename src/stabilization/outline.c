/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the curves of constant spectral radius. The search follows each curve through the squares
 * of a lattice in the chart (Lorensen, Cline 1987, here in two dimensions). In the chart, the
 * region of smaller radius is to the left of a curve. The plane (A, B) is a mirror image of the
 * chart. In the plane, this region is therefore to the right of a curve. The border of the chart,
 * A = 0 and B = 0, is an edge of every region.
 *
 *   3 --2-- 2     edge k is between corners k and k + 1
 *   |       |     a curve enters through k if corner k is inside and k + 1 is not,
 *   3       1     and leaves through k if corner k + 1 is inside and k is not
 *   |       |
 *   0 --0-- 1     s to the right, m upwards
 */
#include <math.h>
#include <string.h>

#include "stabilization/chart.h"

/* This number of bisections reduces the width 1/160 of a cell to a few rounding errors. */
enum { BISECTIONS = 42 };
/* The lattice has one node beyond the chart on every side. */
enum { CELLS = 160, NODES = CELLS + 3 };
/* ENTERED: a curve has already entered the square through its edge 0. */
enum { INSIDE = 1, ENTERED = 2 };

typedef struct march {
  const baum_i_method *method;
  double growth;
  double extent;
  unsigned char node[NODES][NODES]; /* sum of INSIDE and ENTERED, as far as they apply */
  baum_i_outline *out;
} march;

static const int CORNER[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

static void place(const march *m, double i, double j, double at[2])
{
  at[0] = 2.0 * (i - 1.0) / CELLS - 1.0;
  at[1] = m->extent * (j - 1.0) / CELLS;
}

static void fill(march *m)
{
  for (int i = 0; i < NODES; i++) {
    for (int j = 0; j < NODES; j++) {
      double at[2];
      place(m, i, j, at);
      bool beyond = j == NODES - 1; /* treated as outside, so that every curve closes */
      m->node[i][j] = !beyond && baum_i_chart_within(m->method, at, m->growth) ? INSIDE : 0;
    }
  }
}

static bool is_inside(const march *m, const int square[2], int corner)
{
  const int *c = CORNER[corner & 3];
  return m->node[square[0] + c[0]][square[1] + c[1]] & INSIDE;
}

/* ---- Points --------------------------------------------------------------- */

static void put(baum_i_outline *out, const double point[2])
{
  if (out->count < out->capacity) {
    out->alpha_h[out->count] = point[0];
    out->beta2_h2[out->count] = point[1];
  }
  out->count++;
}

/* Finds the point where a curve enters a square through one of its edges. */
static void cross(const march *m, const int square[2], int edge, double point[2])
{
  double inside[2];
  double outside[2];
  const int *c = CORNER[edge];
  place(m, square[0] + c[0], square[1] + c[1], inside);
  c = CORNER[(edge + 1) & 3];
  place(m, square[0] + c[0], square[1] + c[1], outside);
  baum_i_chart_edge(m->method, m->growth, BISECTIONS, outside, inside);
  baum_i_chart_point(m->method, inside[0], inside[1], point);
}

/* ---- Curves --------------------------------------------------------------- */

/* Returns the edge through which a curve leaves a square. If only two opposite corners are inside,
 * the middle of the square decides whether the region connects these corners. */
static int leave(const march *m, const int square[2], int edge)
{
  bool opposite = is_inside(m, square, edge + 2);
  bool beside = is_inside(m, square, edge + 3);
  if (opposite && !beside) {
    double middle[2];
    place(m, square[0] + 0.5, square[1] + 0.5, middle);
    opposite = baum_i_chart_within(m->method, middle, m->growth);
  }
  int turn = opposite ? 1 : beside ? 2 : 3;
  return (edge + turn) & 3;
}

static void follow_curve(march *m, const int start[2])
{
  static const int ACROSS[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  int square[2] = {start[0], start[1]};
  int edge = 0;
  double first[2];
  double last[2];
  cross(m, square, edge, first);
  put(m->out, first);
  memcpy(last, first, sizeof last);
  do {
    if (edge == 0) {
      m->node[square[0]][square[1]] |= ENTERED;
    }
    int exit = leave(m, square, edge);
    square[0] += ACROSS[exit][0];
    square[1] += ACROSS[exit][1];
    edge = (exit + 2) & 3;
    double point[2];
    cross(m, square, edge, point);
    /* A point that equals the last one is skipped. All places (s, 0) of the chart, for example, are
     * the same point A = B = 0. */
    if (point[0] != last[0] || point[1] != last[1]) {
      put(m->out, point);
      memcpy(last, point, sizeof last);
    }
  } while (square[0] != start[0] || square[1] != start[1] || edge != 0);
}

void baum_i_stability_outline(const baum_i_method *method, double growth, baum_i_outline *out)
{
  march m = {.method = method, .growth = growth, .out = out};
  m.extent = baum_i_chart_extent(method, growth);
  out->count = 0;
  if (!(m.extent > 0.0 && m.extent < HUGE_VAL)) {
    return;
  }
  fill(&m);
  for (int i = 0; i < NODES - 1; i++) {
    for (int j = 0; j < NODES - 1; j++) {
      const int square[2] = {i, j};
      if (is_inside(&m, square, 0) && !is_inside(&m, square, 1) && !(m.node[i][j] & ENTERED)) {
        if (out->count > 0) {
          put(out, (const double[2]){(double)NAN, (double)NAN});
        }
        follow_curve(&m, square);
      }
    }
  }
}
