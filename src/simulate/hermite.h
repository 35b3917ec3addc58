/* SPDX-License-Identifier: BSD-3-Clause */
/* Polynomial through the positions and velocities at several times. */
#ifndef BAUM_I_SIMULATE_HERMITE_H
#define BAUM_I_SIMULATE_HERMITE_H

#include "mechanism/manifold.h"

enum { BAUM_I_HERMITE_MOST = 4 };

/* q and v at a time of a motion. */
typedef struct baum_i_knot {
  double t;     /* [s] */
  double pivot; /* [-] smallest pivot there, relative to the largest so far */
  double *q;    /* (nq) */
  double *v;    /* (nv) */
} baum_i_knot;

/* q and v at t of the polynomials of degree 2 count - 1 through positions and rates of `count`
 * knots, from 1 to BAUM_I_HERMITE_MOST, at different times; q and v must not be arrays of knots.
 * work (4 nq). */
void baum_i_hermite(const baum_mechanism *mechanism, const baum_i_knot *knots, int count, double t,
                    double *q, double *v, double *work);

#endif
