/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's iteration of IDA: its test of convergence, and the scaling of solutions with an older
 * matrix. Only ida.c includes it, and only when the build has SUNDIALS. */
#ifndef BAUM_I_INTEGRATE_IDA_NEWTON_H
#define BAUM_I_INTEGRATE_IDA_NEWTON_H

#include <sundials/sundials_nonlinearsolver.h>

#include "integrate/sundials_common.h"

typedef struct baum_i_ida_newton {
  const baum_i_sundials *sundials;
  baum_residual index;
  SUNNonlinearSolver solver;
  N_Vector displacement; /* (nc) [Phi] of each row */
  N_Vector inertia;      /* (nv) M_jj s_j */
  double energy;         /* [J] largest |lambda_i| n_i at the start of the step */
  double momentum_q;     /* [J s^2] largest M_jj s_j tolerance_q_j */
  double momentum_v;     /* [J s] largest M_jj s_j tolerance_v_j */
  double tested;         /* [J] tolerance of |lambda_i| n_i in the error test, else infinite */
  double share;          /* fraction of the tolerances of q and v that corrections may use, <= 1 */
  double action;         /* [J s] largest |mu_i| n_i at the start of the step */
  double action_q;       /* [J s^2] largest W_jj s_j tolerance_q_j */
  double first;          /* size of the first correction of the step */
} baum_i_ida_newton;

/* Make IDA use this test. Set sundials, index, displacement and inertia beforehand; `newton` lives
 * as long as IDA and is closed after it. Returns a flag of IDA. */
int baum_i_ida_newton_attach(baum_i_ida_newton *newton);
void baum_i_ida_newton_close(baum_i_ida_newton *newton);

/* Measure rows and bodies at the point of the workspace, with M and J there: at a start and with
 * each matrix. */
void baum_i_ida_newton_measure(baum_i_ida_newton *newton);

/* Measure the multipliers (lambda, for GGL mu behind them) at the start of a step. Reads the
 * weights (nq + nv), 1 / tolerance, and writes those of lambda (nc) behind them if lambda is
 * tested. */
void baum_i_ida_newton_begin_step(baum_i_ida_newton *newton, const double *multipliers,
                                  double *weights);

/* Scale the right side before, and the solution after, for a matrix made for c0, with ratio = c /
 * c0. */
void baum_i_ida_newton_scale_right(const baum_i_ida_newton *newton, double ratio, N_Vector right);
void baum_i_ida_newton_scale_solution(const baum_i_ida_newton *newton, double ratio,
                                      N_Vector solution);

#endif
