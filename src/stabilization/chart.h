/* SPDX-License-Identifier: BSD-3-Clause */
/* A chart of the plane (A, B) = (alpha h, beta^2 h^2) with A >= 0 and B >= 0. In the coordinates of
 * the chart, regions of stability have no sharp tips. Let mu be the two roots of mu^2 + 2 A mu + B
 * = 0. The coordinate m is the larger |mu|. The coordinate s, from -1 to 1, gives the ratio of the
 * roots if they are real, or their phase if they are complex:
 *
 *   s < 0   mu = -m, -m u,  u = 1 + s         A = m (1 + u) / 2,  B = m^2 u        overdamped
 *   s >= 0  mu = -m e^(+-i phi), phi = s pi/2 A = m cos(phi),     B = m^2
 *
 * The edge s = -1 is B = 0, the line s = 0 is critical damping, and the edge s = 1 is A = 0. For
 * semi-implicit Euler, m and s are those of explicit Euler at (A + B/2, B). */
#ifndef BAUM_I_STABILIZATION_CHART_H
#define BAUM_I_STABILIZATION_CHART_H

#include "stabilization/amplification.h"

/* A rectangle of the chart: the smallest and largest s, and the smallest and largest m. */
typedef struct baum_i_chart_window {
  double s[2];
  double m[2];
} baum_i_chart_window;

/* Computes the point (A, B) that has the coordinates (s, m). */
void baum_i_chart_point(const baum_i_method *method, double s, double m, double point[2]);

/* Tells whether the spectral radius minus 1 is at most `growth` at the place `at` = (s, m). Returns
 * false outside of the chart. */
bool baum_i_chart_within(const baum_i_method *method, const double at[2], double growth);

/* Finds the edge of the region in which the spectral radius minus 1 is at most `growth`. The edge
 * is located by bisections between a place (s, m) inside of the region and a place outside.
 * `inside` is moved to the edge, but it stays inside. */
void baum_i_chart_edge(const baum_i_method *method, double growth, int bisections,
                       const double outside[2], double inside[2]);

/* Returns a little more than the largest m for which the spectral radius minus 1 is at most
 * `growth`. Returns 0 if there is no such m, and infinity if the region is unbounded. A separate
 * part of the region may be missed if it is smaller than a fiftieth of the region. */
double baum_i_chart_extent(const baum_i_method *method, double growth);

#endif
