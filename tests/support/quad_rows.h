/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes accelerations in quadruple precision, even if rows are dependent. Also computes how
 * close the rows are to dependence, and how much dependent rows contradict the others. M, J, g and
 * gamma are computed by the library in double precision, but none of its solvers is used. Let M = L
 * L^T and y = L^T a. The rows of J L^-T, scaled to length 1, are the columns of W. The constraints
 * are then W^T y = c. Of all y that satisfy them, the solution is nearest to L^-1 g. A QR
 * factorization of W with pivoting gives this y. */
#ifndef BAUM_TEST_QUAD_ROWS_H
#define BAUM_TEST_QUAD_ROWS_H

#include <stdbool.h>

#include <baum/dynamics.h>

#include "quad.h"

typedef struct quad_rows {
  /* Number of independent rows. In pivot order, the distance of each of them from the span of the
   * previous rows is at least QUAD_DEPENDENT. */
  int rank;
  /* If all rows are independent, this is the smallest singular value of W. Otherwise it is the
   * distance of the first dependent row from the span of the independent rows. */
  double distance;
  double kept; /* smallest singular value of the independent rows */
  /* Largest |W^T y - c| of the dependent rows, relative to |c|, |y| and |L^-1 g|. */
  double conflict;
  double size; /* max |a| or max |M^-1 g|, whichever is larger */
} quad_rows;

static const double QUAD_DEPENDENT = 1e-10;

/* The equations that an oracle solves. The caller sets mass, jacobian, force and gamma, and then
 * calls quad_equations_solve(). */
typedef struct quad_equations {
  int nv;
  int nc;
  wide *mass;     /* (nv x nv) */
  wide *jacobian; /* (nc x nv) */
  wide *force;    /* (nv) */
  wide *gamma;    /* (nc) */
  int rank;       /* this member and all members below are results */
  int *order;     /* (nc) rows in pivot order */
  wide *factor;   /* (nv x nv) the factor L of M = L L^T */
  wide *w;        /* (nc x nv) columns of W and later of Q; column k starts at k nv */
  wide *r;        /* (nc x nc) R in pivot order */
  wide *c;        /* (nc) right sides in pivot order */
  wide *length;   /* (nc) lengths of the rows of J L^-T */
  wide *y;        /* (nv) */
  wide *work;     /* (nv + nc) */
} quad_equations;

/* Returns false if there is not enough memory. The equations must be destroyed even then. */
bool quad_equations_create(quad_equations *s, int nv, int nc);
void quad_equations_destroy(quad_equations *s);

/* Solves the equations for the accelerations a (nv). Returns false if M is not positive
 * definite. */
bool quad_equations_solve(quad_equations *s, wide *a, quad_rows *out);

/* These functions are called after solving. The first one computes the multipliers (nc), which are
 * 0 for dependent rows. The second one computes the coefficients (nc) of the k-th linear
 * combination of the rows of J that is zero. */
void quad_equations_multipliers(const quad_equations *s, wide *lambda);
void quad_equations_null(const quad_equations *s, int k, wide *lambda);

/* Reads M, J, g and gamma from a workspace and computes a (nv). Returns false if a call fails, if M
 * is not positive definite, or if there is not enough memory. */
bool quad_rows_accelerate(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                          const double *v, double *a, quad_rows *out);

/* Computes only the rank and the distances in *out for the rows whose entries in `skipped` (nc) are
 * false. */
bool quad_rows_rank(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                    const bool *skipped, quad_rows *out);

/* Computes the velocities nearest to v, in the metric of M, that satisfy constraints which do not
 * depend on time. These velocities are the solution a of the equations above with gamma = 0 and the
 * force g = M v. */
bool quad_rows_project(baum_workspace *workspace, int nv, int nc, double t, const double *q,
                       const double *v, double *projected, quad_rows *out);

#endif
