/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations in quadruple precision, also with dependent rows, and measures of dependence, from
 * M, J, g and gamma of the library in double precision. With M = L L^T, y = L^T a and the rows of J
 * L^-T scaled to length 1, the constraints are W^T y = c. The y nearest to L^-1 g is found by a QR
 * factorization of W with pivoting. No solver of the library is used. */
#ifndef BAUM_TEST_QUAD_ROWS_H
#define BAUM_TEST_QUAD_ROWS_H

#include <stdbool.h>

#include <baum/dynamics.h>

#include "quad.h"

typedef struct quad_rows {
  int rank;        /* number of rows that are at least QUAD_DEPENDENT from the span of those before
                    * them */
  double distance; /* smallest singular value of W; with dependent rows, the distance of the first
                    * from the span of the others */
  double kept;     /* smallest singular value of the independent rows */
  double conflict; /* largest |W^T y - c| of dependent rows, relative to |c|, |y| and |L^-1 g| */
  double size;     /* the larger of max |a| and max |M^-1 g| */
} quad_rows;

static const double QUAD_DEPENDENT = 1e-10;

/* Equations of an oracle: fill mass, jacobian, force and gamma, then solve. */
typedef struct quad_equations {
  int nv;
  int nc;
  wide *mass;     /* (nv x nv) */
  wide *jacobian; /* (nc x nv) */
  wide *force;    /* (nv) */
  wide *gamma;    /* (nc) */
  int rank;       /* from here on: results */
  int *order;     /* (nc) rows in pivot order */
  wide *factor;   /* (nv x nv) L */
  wide *w;        /* (nc x nv) columns of W, then of Q; column k begins at k nv */
  wide *r;        /* (nc x nc) R in pivot order */
  wide *c;        /* (nc) right sides in pivot order */
  wide *length;   /* (nc) lengths of the rows of J L^-T */
  wide *y;        /* (nv) */
  wide *work;     /* (nv + nc) */
} quad_equations;

/* Returns false without memory; destroy it also then. */
bool quad_equations_create(quad_equations *s, int nv, int nc);
void quad_equations_destroy(quad_equations *s);

/* Computes a (nv). Returns false if M is not positive definite. */
bool quad_equations_solve(quad_equations *s, wide *a, quad_rows *out);

/* After solving: multipliers (nc), 0 for dependent rows; and the k-th combination of rows that is
 * zero. */
void quad_equations_multipliers(const quad_equations *s, wide *lambda);
void quad_equations_null(const quad_equations *s, int k, wide *lambda);

/* Reads M, J, g and gamma from a workspace and computes a (nv). Returns false if a call fails, M is
 * not positive definite, or there is no memory. */
bool quad_rows_accelerate(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                          const double *v, double *a, quad_rows *out);

/* Likewise the velocities nearest to v in the metric of M that fulfil time-independent constraints:
 * the same equations with gamma = 0 and the force M v. */
bool quad_rows_project(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                       const double *v, double *projected, quad_rows *out);

#endif
