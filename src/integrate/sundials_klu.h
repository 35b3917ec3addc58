/* SPDX-License-Identifier: BSD-3-Clause */
/* Factors the matrix dF/dy + c dF/dy' of a residual form by KLU, for the Newton iterations of IDA
 * and CVODE BDF. Only their files include this header, and only if the build has SUNDIALS.
 *
 * KLU keeps its pivots as long as solutions are accurate. SUNDIALS itself would choose new pivots,
 * and allocate, in every step. Its criterion is the condition number, which is always large here
 * because entries of size c = O(1/h) and of size 1 occur together. */
#ifndef BAUM_I_INTEGRATE_SUNDIALS_KLU_H
#define BAUM_I_INTEGRATE_SUNDIALS_KLU_H

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include "integrate/sundials_common.h"

typedef struct baum_i_sundials_klu {
  baum_i_sundials *sundials;
  baum_i_residual_matrix *form; /* computes the entries */
  SUNMatrix matrix;             /* (n x n) with displacements of length nv in place of q */
  SUNLinearSolver solver;
  double *numbers;   /* memory of the arrays below */
  double *defect;    /* (n) b - A x */
  double *size;      /* (n) |b| + |A| |x| */
  double *entry;     /* (n) largest entry of each row of A */
  N_Vector right;    /* (n) scratch for the caller */
  N_Vector solution; /* (n) scratch for the caller */
  bool fresh;        /* true if pivots were chosen for the present matrix, not for an earlier one */
} baum_i_sundials_klu;

/* Call this after sundials->problem is set. Returns BAUM_OK or BAUM_ERR_MEMORY. Close `klu` even
 * after a failure. Close it after everything that calls it, and before the baum_i_sundials. A
 * zeroed struct may be closed. */
baum_status baum_i_sundials_klu_open(baum_i_sundials_klu *klu, baum_i_sundials *sundials,
                                     baum_residual index);
void baum_i_sundials_klu_close(baum_i_sundials_klu *klu);

/* Compute klu->matrix at y and dy (n). Returns the status of baum_i_residual_matrix_fill(). */
baum_status baum_i_sundials_klu_fill(baum_i_sundials_klu *klu, const baum_dae *dae, double c,
                                     double t, const double *y, const double *dy);

/* The return values are those of a linear solver of SUNDIALS: 0 for success, > 0 if another matrix
 * may help, otherwise < 0. x and b must be different vectors. */
int baum_i_sundials_klu_factor(baum_i_sundials_klu *klu);
int baum_i_sundials_klu_solve(baum_i_sundials_klu *klu, N_Vector x, N_Vector b);
/* Solve as baum_i_sundials_klu_solve() does, but for vectors of another form: x begins with dq
 * (nq), and b begins with the residual of q' - N v (nq), while the unknowns of the matrix are
 * displacements (nv). c is the coefficient of the matrix. */
int baum_i_sundials_klu_solve_positions(baum_i_sundials_klu *klu, double c, N_Vector x, N_Vector b);

/* Create a linear solver of SUNDIALS that consists of the functions `factor` and `solve`. Its
 * member `content` is set to the argument `content`, so that these functions find it there. Free it
 * with SUNLinSolFree(). Returns NULL if out of memory. */
SUNLinearSolver baum_i_sundials_front(const baum_i_sundials *sundials, void *content,
                                      int (*factor)(SUNLinearSolver, SUNMatrix),
                                      int (*solve)(SUNLinearSolver, SUNMatrix, N_Vector, N_Vector,
                                                   sunrealtype));

#endif
