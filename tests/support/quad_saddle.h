/* SPDX-License-Identifier: BSD-3-Clause */
/* Computes accelerations and multipliers in quadruple precision (or in long double). M, J, g and
 * gamma come from the library in double precision:
 *
 *   [ M  J^T ] [ a      ]   [ g     ]
 *   [ J   0  ] [ lambda ] = [ gamma ]
 *
 * The unknowns are sorted. For a chain of bodies, the sorted matrix has a narrow band, whatever the
 * length of the chain. Other matrices are eliminated like dense ones. The elimination uses partial
 * pivoting. It does not use any solver of the library.
 */
#ifndef BAUM_TEST_QUAD_SADDLE_H
#define BAUM_TEST_QUAD_SADDLE_H

#include <stdbool.h>

#include "dynamics/dynamics.h"

/* The first three functions below compute (a, lambda) and round the results to double. They return
 * false if the matrix is singular, or if there is not enough memory. */

/* Reads J and M from a workspace as dense matrices. This is suitable for up to several hundred
 * coordinates. The array `omitted` (nc), which may be NULL, marks rows that are omitted. Their
 * lambda is 0. */
bool quad_acceleration(baum_workspace *workspace, double t, const double *q, const double *v,
                       const unsigned char *omitted, double *a, double *lambda);

/* Computes the same with gamma replaced by gamma - 2 gain Phi' - gain^2 Phi. The unit of `gain` is
 * 1/s. */
bool quad_acceleration_with_gain(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double gain, const unsigned char *omitted,
                                 double *a, double *lambda);

/* Computes the same accelerations and multipliers for long chains. It reads the blocks of the
 * workspace instead of dense matrices. */
bool quad_acceleration_of_blocks(baum_workspace *workspace, double t, const double *q,
                                 const double *v, double *a, double *lambda);

/* Returns the largest |x_i - want_i|, divided by the largest |want_i|. */
double quad_error(int count, const double *x, const double *want);

#endif
