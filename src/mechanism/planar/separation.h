/* SPDX-License-Identifier: BSD-3-Clause */
/* This file computes the line between two markers, and half of its squared length with first and
 * second derivatives. The distance joint and the spring use it.
 *
 * Let P_a and P_b be the markers, p_a and p_b their arms, k the unit vector along z, and d = P_b -
 * P_a. With the columns x_a y_a angle_a x_b y_b angle_b:
 *
 *   F = d . d / 2,   d' = G v,   G = [ -I   -k x p_a   I   k x p_b ]         (2 x 6)
 *   F_q  = G^T d                                                             (6 columns)
 *   F_qq = G^T G + diag(0 0 d . p_a 0 0 -d . p_b)                            (6 x 6), symmetric
 */
#ifndef BAUM_I_MECHANISM_PLANAR_SEPARATION_H
#define BAUM_I_MECHANISM_PLANAR_SEPARATION_H

#include <math.h>

#include "mechanism/planar/planar.h"

typedef struct baum_i_separation {
  double d[2];
  double rate[2];    /* d' */
  double g_angle[4]; /* columns of G: -k x p_a, k x p_b */
} baum_i_separation;

static inline baum_i_separation baum_i_separation_of(const baum_i_marker *a, const baum_i_marker *b)
{
  return (baum_i_separation){
    .d = {b->r[0] - a->r[0], b->r[1] - a->r[1]},
    .rate = {b->dr[0] - a->dr[0], b->dr[1] - a->dr[1]},
    .g_angle = {a->arm[1], -a->arm[0], -b->arm[1], b->arm[0]},
  };
}

/* Return the length of the vector (x, y). The function hypot() is slower than sqrt(), so it is
 * called only if squares could overflow or become zero. */
static inline double baum_i_length_of(double x, double y)
{
  double square = x * x + y * y;
  return square > 1e-280 && square < 1e280 ? sqrt(square) : hypot(x, y);
}

/* Return the length |d|. */
static inline double baum_i_separation_length(const baum_i_separation *s)
{
  return baum_i_length_of(s->d[0], s->d[1]);
}

/* Set out = G^T x (6). */
static inline void baum_i_separation_spread(const baum_i_separation *s, const double x[2],
                                            double out[6])
{
  out[0] = -x[0];
  out[1] = -x[1];
  out[2] = s->g_angle[0] * x[0] + s->g_angle[1] * x[1];
  out[3] = x[0];
  out[4] = x[1];
  out[5] = s->g_angle[2] * x[0] + s->g_angle[3] * x[1];
}

/* Compute F_qq (6 x 6), row-major. */
void baum_i_separation_hessian(const baum_i_separation *s, double hessian[36]);

/* Return the distance between two points, one on each of the two bodies of a span, in the design
 * configuration. `points` contains first the point on body_a and then the point on body_b, in body
 * axes. */
double baum_i_separation_in_design(const baum_mechanism *mechanism, const baum_i_span *span,
                                   const double points[4]);

#endif
