/* SPDX-License-Identifier: BSD-3-Clause */
/* Hermite polynomial through the positions and velocities at several times. */
#ifndef BAUM_I_SIMULATE_HERMITE_H
#define BAUM_I_SIMULATE_HERMITE_H

#include "mechanism/manifold.h"

enum { BAUM_I_HERMITE_MOST = 4 };

/* A state of a motion. */
typedef struct baum_i_knot {
  double t;     /* [s] */
  double pivot; /* [-] smallest pivot, relative to the largest so far */
  double *q;    /* (nq) */
  double *v;    /* (nv) */
} baum_i_knot;

/* Find q and v at t on the polynomials of degree 2 count - 1 through positions and rates of `count`
 * knots at different times. count is at most BAUM_I_HERMITE_MOST. q and v must not be arrays of
 * knots. work (4 nq) is scratch memory. */
void baum_i_hermite(const baum_mechanism *mechanism, const baum_i_knot *knots, int count, double t,
                    double *q, double *v, double *work);

#endif
