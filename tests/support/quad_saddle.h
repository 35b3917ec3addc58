/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations and multipliers in quadruple precision (or long double), from M, J, g and gamma of
 * the library in double precision:
 *
 *   [ M  J^T ] [ a      ]   [ g     ]
 *   [ J   0  ] [ lambda ] = [ gamma ]
 *
 * The order of the unknowns gives the matrix of a chain a narrow band, whatever the length of the
 * chain; other matrices are eliminated like dense ones. Elimination uses partial pivoting, and no
 * solver of the library.
 */
#ifndef BAUM_TEST_QUAD_SADDLE_H
#define BAUM_TEST_QUAD_SADDLE_H

#include <stdbool.h>

#include "dynamics/dynamics.h"

/* Both functions round (a, lambda) to double. They return false if the matrix is singular or if
 * memory is missing. */

/* Reads J and M as dense matrices from a workspace, for up to several hundred coordinates. Omits
 * the rows that left_out (nc) marks, so their lambda is 0. left_out may be NULL. */
bool quad_acceleration(baum_workspace *workspace, double t, const double *q, const double *v,
                       const unsigned char *left_out, double *a, double *lambda);

/* The same with r = gamma - 2 gain Phi' - gain^2 Phi in place of gamma; gain [1/s]. */
bool quad_acceleration_with_gain(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double gain, const unsigned char *left_out,
                                 double *a, double *lambda);

/* Reads the blocks of the workspace instead, for long chains. */
bool quad_acceleration_of_blocks(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double *a, double *lambda);

/* Returns the largest |x_i - want_i|, relative to the largest |want_i|. */
double quad_error(int count, const double *x, const double *want);

#endif
