/* SPDX-License-Identifier: BSD-3-Clause */
/* A chart of the plane (A, B) = (alpha h, beta^2 h^2), A >= 0, B >= 0, with coordinates in which
 * regions of stability have no sharp tips. m is the larger |mu|, and s in [-1, 1] describes the
 * ratio of the two mu.
 *
 *   s < 0   mu = -m, -m u,  u = 1 + s         A = m (1 + u) / 2,  B = m^2 u        overdamped
 *   s >= 0  mu = -m e^(+-i phi), phi = s pi/2 A = m cos(phi),     B = m^2
 *
 * s = -1 means B = 0, s = 0 critical damping, and s = 1 means A = 0. For semi-implicit Euler, m and
 * s are those of explicit Euler at (A + B/2, B). */
#ifndef BAUM_I_STABILIZATION_CHART_H
#define BAUM_I_STABILIZATION_CHART_H

#include "stabilization/amplification.h"

/* A rectangle [s] x [m] of the chart. */
typedef struct baum_i_chart_window {
  double s[2];
  double m[2];
} baum_i_chart_window;

/* Computes point = (A, B) of (s, m). */
void baum_i_chart_point(const baum_i_method *method, double s, double m, double point[2]);

/* Tells whether spectral radius - 1 <= growth at a place (s, m). False outside of the chart. */
bool baum_i_chart_within(const baum_i_method *method, const double at[2], double growth);

/* Finds the edge of the region spectral radius - 1 <= growth between a place (s, m) inside and one
 * outside by bisections. `inside` is moved to the edge and remains inside. */
void baum_i_chart_edge(const baum_i_method *method, double growth, int bisections,
                       const double outside[2], double inside[2]);

/* Returns a little more than the largest m with spectral radius - 1 <= growth; 0 if there is none,
 * infinity if the region is unbounded. Separate parts smaller than a fiftieth of the region may be
 * missed. */
double baum_i_chart_extent(const baum_i_method *method, double growth);

#endif
