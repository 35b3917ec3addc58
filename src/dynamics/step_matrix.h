/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's matrix of a step at index 3, for methods of Newmark type. In these methods, the changes
 * of velocities and accelerations are multiples of the changes of positions:
 *
 *   dv = by_v dq,  dv' = by_a dq,  dlambda = z / scale
 *
 *   [ scale A   J^T ] [ dq ]     [ scale (M v' + J^T lambda - g) ]
 *   [ J         0   ] [ z  ] = - [ Phi                           ]
 *   [ K         0   ]            [ Phi' of rows of velocity level ]
 *
 *   A = by_a M - by_v g_v + (M v')_q + (J^T lambda)_q - g_q,   K = by_v J + (J v)_q - nu_q
 *
 * If the product of scale and by_a is about 1, no entry of the matrix grows as the step becomes
 * shorter (C. Bottasso, O. Bauchau, A. Cardona, 2007; M. Arnold, O. Bruels, 2007). The multiplier
 * lambda_i of an omitted row i stays 0. A subscript q or v, as in g_q, denotes a partial
 * derivative.
 */
#ifndef BAUM_I_DYNAMICS_STEP_MATRIX_H
#define BAUM_I_DYNAMICS_STEP_MATRIX_H

#include "dynamics/dynamics.h"
#include "linear/sparse_lu.h"

/* The factors by_v, by_a and scale of the equations above. by_v must not be 0. */
typedef struct baum_i_step_ratios {
  double by_v;  /* [1/s] */
  double by_a;  /* [1/s^2] */
  double scale; /* [s^2] */
} baum_i_step_ratios;

typedef struct baum_i_step_matrix baum_i_step_matrix;

/* Returns BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_step_matrix_create(const baum_workspace *workspace, baum_i_step_matrix **out);
void baum_i_step_matrix_destroy(baum_i_step_matrix *matrix); /* NULL is allowed */

/* Evaluate and factor the matrix at (t, y, y'), where y = (q, v, lambda). May fail with
 * BAUM_ERR_MEMORY, or with BAUM_ERR_SINGULAR without a message. */
baum_status baum_i_step_matrix_factor(baum_i_step_matrix *matrix, baum_workspace *workspace,
                                      const baum_i_step_ratios *ratios, double t, const double *y,
                                      const double *dy);

/* Choose new pivots at the next factorization. */
void baum_i_step_matrix_forget(baum_i_step_matrix *matrix);

/* Solve the equations above. On entry, x (nv + nc) contains the right-hand side. On return, x
 * contains dq, followed by z. */
void baum_i_step_matrix_solve(baum_i_step_matrix *matrix, double *x);

baum_i_sparse_lu_work baum_i_step_matrix_work(const baum_i_step_matrix *matrix);

#endif
