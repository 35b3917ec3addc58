/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations and multipliers in quadruple precision (or long double), from M, J, g and gamma of
 * the library in double precision:
 *
 *   [ M  J^T ] [ a      ]   [ g     ]
 *   [ J   0  ] [ lambda ] = [ gamma ]
 *
 * The unknowns are ordered so that the matrix of a chain has a narrow band, whatever its length;
 * other matrices are eliminated like dense ones. Partial pivoting. No solver of the library is
 * used.
 */
#ifndef BAUM_TEST_QUAD_SADDLE_H
#define BAUM_TEST_QUAD_SADDLE_H

#include <stdbool.h>

#include "dynamics/dynamics.h"

/* Both functions round (a, lambda) to double. They return false if the matrix is singular or memory
 * is missing. */

/* Reads dense J and M from a workspace: for some hundred coordinates. Omits the rows marked in
 * left_out (nc), which may be NULL; their lambda is 0. */
bool quad_acceleration(baum_workspace *workspace, double t, const double *q, const double *v,
                       const unsigned char *left_out, double *a, double *lambda);

/* Reads the blocks of the workspace: for long chains. */
bool quad_acceleration_of_blocks(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double *a, double *lambda);

/* Largest |x_i - want_i| over the largest |want_i|. */
double quad_error(int count, const double *x, const double *want);

#endif
