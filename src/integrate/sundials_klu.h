/* SPDX-License-Identifier: BSD-3-Clause */
/* The matrix dF/dy + c dF/dy' of a residual form, factored by KLU, with which the Newton iterations
 * of IDA and CVODE BDF solve. Only their files include it, and only when the build has SUNDIALS.
 *
 * KLU keeps its pivots as long as solutions are accurate. SUNDIALS would choose new pivots, and
 * allocate, in every step: its criterion, the condition number, is always bad here because entries
 * of size c = O(1/h) and of size 1 occur together. */
#ifndef BAUM_I_INTEGRATE_SUNDIALS_KLU_H
#define BAUM_I_INTEGRATE_SUNDIALS_KLU_H

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include "integrate/sundials_common.h"

typedef struct baum_i_sundials_klu {
  baum_i_sundials *sundials;
  baum_i_residual_matrix *form; /* where the numbers come from */
  SUNMatrix matrix;             /* (n x n) as the form has it, for displacements of velocity size */
  SUNLinearSolver solver;
  double *numbers;   /* behind all below */
  double *defect;    /* (n) b - A x */
  double *size;      /* (n) |b| + |A| |x| */
  double *entry;     /* (n) largest of each row of A */
  N_Vector right;    /* (n) for the caller */
  N_Vector solution; /* (n) likewise */
  bool fresh;        /* pivots were chosen at the present matrix */
} baum_i_sundials_klu;

/* Call this after sundials->problem is set. BAUM_OK or BAUM_ERR_MEMORY. In any case, close it after
 * everything that calls it, and before the run of SUNDIALS; closing accepts zeroes. */
baum_status baum_i_sundials_klu_open(baum_i_sundials_klu *klu, baum_i_sundials *sundials,
                                     baum_residual index);
void baum_i_sundials_klu_close(baum_i_sundials_klu *klu);

/* The matrix at y and dy (n), into klu->matrix. As baum_i_residual_matrix_fill(). */
baum_status baum_i_sundials_klu_fill(baum_i_sundials_klu *klu, const baum_dae *dae, double c,
                                     double t, const double *y, const double *dy);

/* Return values of a linear solver: 0, > 0 if another matrix may help, < 0. x and b are two
 * vectors. */
int baum_i_sundials_klu_factor(baum_i_sundials_klu *klu);
int baum_i_sundials_klu_solve(baum_i_sundials_klu *klu, N_Vector x, N_Vector b);
/* Likewise with dq in x and q' - N v in b, for the c of the matrix. */
int baum_i_sundials_klu_solve_positions(baum_i_sundials_klu *klu, double c, N_Vector x, N_Vector b);

/* A linear solver of SUNDIALS that calls these with `content`; free it with SUNLinSolFree(). NULL:
 * no memory. */
SUNLinearSolver baum_i_sundials_front(const baum_i_sundials *sundials, void *content,
                                      int (*factor)(SUNLinearSolver, SUNMatrix),
                                      int (*solve)(SUNLinearSolver, SUNMatrix, N_Vector, N_Vector,
                                                   sunrealtype));

#endif
