/* SPDX-License-Identifier: BSD-3-Clause */
/* Symmetric scaling of the saddle-point matrix K to D K D by powers of two, which causes no
 * rounding errors.
 *
 *   d_j = 1 / sqrt(M_jj)          for velocities,   so that M has a diagonal of about 1,
 *   e_i = 1 / max_j |J_ij| d_j    for constraints,  so that rows of J have entries of about 1,
 *
 * all rounded up to a power of two. After scaling, the diagonal of M is therefore between 1 and 4,
 * and the largest entry of a row of J is between 1 and 2. If S_ii is not zero, the maximum in e_i
 * includes sqrt(S_ii). A change of units multiplies K by a diagonal matrix from both sides, and D
 * by the inverse of this matrix. D K D therefore does not depend on units, except for the rounding
 * to powers of two. The d_j of a velocity without mass is computed from the rows in which it
 * occurs. */
#ifndef BAUM_I_LINEAR_SCALE_H
#define BAUM_I_LINEAR_SCALE_H

#include "linear/kkt.h"

/* Sets scale (nv + nc) = (d, e). If row i is omitted, e_i = 0, which removes the row from D K D and
 * D b. */
void baum_i_scale_compute(const baum_i_kkt_structure *structure, const baum_i_kkt_values *values,
                          double *scale);

/* Sets weighted (nv + nc) = (root d, e / root). D K D then contains M times root^2, J unchanged,
 * and S divided by root^2. In a row in which S would be 4 or more, a smaller factor than e / root
 * keeps S between 1 and 4. root is a power of two, at most 1. */
void baum_i_scale_weigh(const baum_i_kkt_structure *structure, const baum_i_kkt_values *values,
                        const double *scale, double root, double *weighted);

#endif
