/* SPDX-License-Identifier: BSD-3-Clause */
/* A chart of the plane (A, B) = (alpha h, beta^2 h^2), A >= 0, B >= 0, in which regions have no
 * sharp tips: m, the larger |mu|, and s in [-1, 1], which describes the relation of both mu.
 *
 *   s < 0   mu = -m, -m u,  u = 1 + s         A = m (1 + u) / 2,  B = m^2 u        overdamped
 *   s >= 0  mu = -m e^(+-i phi), phi = s pi/2 A = m cos(phi),     B = m^2
 *
 * s = -1 is B = 0, s = 0 critical damping, s = 1 is A = 0. Semi-implicit Euler, whose plane is a
 * shear of explicit Euler's, uses the chart of that method. */
#ifndef BAUM_I_STABILIZATION_CHART_H
#define BAUM_I_STABILIZATION_CHART_H

#include "stabilization/amplification.h"

/* A rectangle [s] x [m] of the chart. */
typedef struct baum_i_chart_window {
  double s[2];
  double m[2];
} baum_i_chart_window;

/* Computes point = (A, B). */
void baum_i_chart_point(const baum_i_method *method, double s, double m, double point[2]);

/* Tells whether spectral radius - 1 <= growth there. False outside of the chart. */
bool baum_i_chart_within(const baum_i_method *method, const double at[2], double growth);

/* Finds the edge of the region between a place (s, m) inside and one outside by this many
 * bisections. `inside` moves there and stays inside. */
void baum_i_chart_edge(const baum_i_method *method, double growth, int bisections,
                       const double outside[2], double inside[2]);

/* Returns a little more than the largest m where spectral radius - 1 <= growth; 0 where there is
 * none, infinite where the region is unbounded. Islands smaller than a fiftieth of the region may
 * be missed. */
double baum_i_chart_extent(const baum_i_method *method, double growth);

#endif
