/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes accelerations in quadruple precision, also with dependent rows, and measures of their
 * dependence. M, J, g and gamma come from the library in double precision, but none of its solvers
 * is used. With M = L L^T and y = L^T a, and with the rows of J L^-T scaled to length 1, the
 * constraints are W^T y = c. A QR factorization of W with pivoting gives the y nearest to L^-1
 * g. */
#ifndef BAUM_TEST_QUAD_ROWS_H
#define BAUM_TEST_QUAD_ROWS_H

#include <stdbool.h>

#include <baum/dynamics.h>

#include "quad.h"

typedef struct quad_rows {
  /* number of rows whose distance from the span of the earlier rows, in pivot order, is at least
   * QUAD_DEPENDENT */
  int rank;
  /* smallest singular value of W; if rows are dependent, the distance of the first of them from the
   * span of the independent rows */
  double distance;
  double kept;     /* smallest singular value of the independent rows */
  double conflict; /* largest |W^T y - c| of dependent rows, relative to |c|, |y| and |L^-1 g| */
  double size;     /* the larger of max |a| and max |M^-1 g| */
} quad_rows;

static const double QUAD_DEPENDENT = 1e-10;

/* The equations of an oracle. The caller sets mass, jacobian, force and gamma, then solves. */
typedef struct quad_equations {
  int nv;
  int nc;
  wide *mass;     /* (nv x nv) */
  wide *jacobian; /* (nc x nv) */
  wide *force;    /* (nv) */
  wide *gamma;    /* (nc) */
  int rank;       /* this and all below: results */
  int *order;     /* (nc) rows in pivot order */
  wide *factor;   /* (nv x nv) L */
  wide *w;        /* (nc x nv) columns of W, then of Q; column k starts at k nv */
  wide *r;        /* (nc x nc) R in pivot order */
  wide *c;        /* (nc) right sides in pivot order */
  wide *length;   /* (nc) lengths of the rows of J L^-T */
  wide *y;        /* (nv) */
  wide *work;     /* (nv + nc) */
} quad_equations;

/* Returns false if memory is missing. Destroy the equations also in that case. */
bool quad_equations_create(quad_equations *s, int nv, int nc);
void quad_equations_destroy(quad_equations *s);

/* Computes a (nv). Returns false if M is not positive definite. */
bool quad_equations_solve(quad_equations *s, wide *a, quad_rows *out);

/* After solving: the first function computes the multipliers (nc), which are 0 for dependent rows;
 * the second computes the k-th linear combination of the rows of J that is zero. */
void quad_equations_multipliers(const quad_equations *s, wide *lambda);
void quad_equations_null(const quad_equations *s, int k, wide *lambda);

/* Reads M, J, g and gamma from a workspace and computes a (nv). Returns false if a call fails, M is
 * not positive definite, or memory is missing. */
bool quad_rows_accelerate(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                          const double *v, double *a, quad_rows *out);

/* Computes the velocities that fulfil time-independent constraints and are nearest to v in the
 * metric of M. These solve the same equations with gamma = 0 and the force M v. */
bool quad_rows_project(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                       const double *v, double *projected, quad_rows *out);

#endif
