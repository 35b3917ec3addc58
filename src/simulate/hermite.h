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

/* Evaluate, at time t, the polynomials of degree 2 count - 1 that pass through the positions and
 * rates of `count` knots at different times, and write the result to q and v. count is at most
 * BAUM_I_HERMITE_MOST. q and v must not be the arrays of one of the knots. work (4 nq) is scratch
 * memory. */
void baum_i_hermite(const baum_mechanism *mechanism, const baum_i_knot *knots, int count, double t,
                    double *q, double *v, double *work);

#endif
