/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations and multipliers in quadruple precision (long double where there is none), from M,
 * J, g and gamma in double precision as they are:
 *
 *   [ M  J^T ] [ a      ]   [ g     ]
 *   [ J   0  ] [ lambda ] = [ gamma ]
 *
 * Unknowns are ordered so that the matrix of a chain is a narrow band, whatever its length; a
 * matrix that is no band is eliminated like a dense one. Partial pivoting. No part of the library
 * solves anything here.
 */
#ifndef BAUM_TEST_QUAD_SADDLE_H
#define BAUM_TEST_QUAD_SADDLE_H

#include <stdbool.h>

#include "dynamics/dynamics.h"

/* (a, lambda) rounded to double. false: singular, or no memory. */

/* Through the public functions of a workspace, with J and M dense: for some hundred coordinates.
 * Rows marked in `left_out` (nc), which may be NULL, are not taken; their lambda is 0. */
bool quad_acceleration(baum_workspace *workspace, double t, const double *q, const double *v,
                       const unsigned char *left_out, double *a, double *lambda);

/* From the blocks that the workspace keeps, for long chains. */
bool quad_acceleration_of_blocks(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double *a, double *lambda);

/* Largest |x_i - want_i| over the largest |want_i|. */
double quad_error(int count, const double *x, const double *want);

#endif
