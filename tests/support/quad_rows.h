/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations in quadruple precision where rows may depend on each other, and how far from it
 * they are, from M, J, g and gamma in double precision as they are. With M = L L^T, y = L^T a and
 * the rows of J L^-T scaled to length 1, the constraints are W^T y = c, and of all such y the one
 * nearest to L^-1 g is wanted: by a QR factorization of W with pivoting. No part of the library
 * solves anything here.
 */
#ifndef BAUM_TEST_QUAD_ROWS_H
#define BAUM_TEST_QUAD_ROWS_H

#include <stdbool.h>

#include <baum/dynamics.h>

#include "quad.h"

typedef struct quad_rows {
  int rank;        /* rows that are at least QUAD_DEPENDENT apart from those before them */
  double distance; /* smallest singular value of W; with dependent rows, how far the first is from
                      the others */
  double kept;     /* smallest singular value of the rows of the rank */
  double conflict; /* largest |W^T y - c| of dependent rows, of |c|, |y| and |L^-1 g| */
  double size;     /* largest |a| or |M^-1 g| */
} quad_rows;

static const double QUAD_DEPENDENT = 1e-10;

/* Equations of an oracle's own: fill mass to gamma, then solve. */
typedef struct quad_equations {
  int nv;
  int nc;
  wide *mass;     /* (nv x nv) */
  wide *jacobian; /* (nc x nv) */
  wide *force;    /* (nv) */
  wide *gamma;    /* (nc) */
  int rank;       /* what follows is found */
  int *order;     /* (nc) rows in the order of the pivots */
  wide *factor;   /* (nv x nv) L */
  wide *w;        /* (nc x nv) columns of W, then of Q: column k from k nv on */
  wide *r;        /* (nc x nc) R in the order of the pivots */
  wide *c;        /* (nc) right sides in that order */
  wide *length;   /* (nc) of the rows of J L^-T */
  wide *y;        /* (nv) */
  wide *work;     /* (nv + nc) */
} quad_equations;

/* false: no memory; destroy it all the same. */
bool quad_equations_create(quad_equations *s, int nv, int nc);
void quad_equations_destroy(quad_equations *s);

/* a is (nv). false: M is not positive definite. */
bool quad_equations_solve(quad_equations *s, wide *a, quad_rows *out);

/* After it: multipliers (nc), 0 of dependent rows; the k-th combination of rows that is zero. */
void quad_equations_multipliers(const quad_equations *s, wide *lambda);
void quad_equations_null(const quad_equations *s, int k, wide *lambda);

/* Through the public functions of a workspace; a is (nv). false: they fail, M is not positive
 * definite, or there is no memory. */
bool quad_rows_accelerate(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                          const double *v, double *a, quad_rows *out);

/* Likewise the velocities nearest to v, in the metric of M, that fulfil constraints which do not
 * depend on time; as accelerations without bending, M v for forces. */
bool quad_rows_project(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                       const double *v, double *projected, quad_rows *out);

#endif
