/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's iteration of IDA: its convergence test, and the scaling of solutions with an older
 * matrix. Only ida.c includes this header, and only if the build has SUNDIALS. */
#ifndef BAUM_I_INTEGRATE_IDA_NEWTON_H
#define BAUM_I_INTEGRATE_IDA_NEWTON_H

#include <sundials/sundials_nonlinearsolver.h>

#include "integrate/sundials_common.h"

typedef struct baum_i_ida_newton {
  const baum_i_sundials *sundials;
  baum_residual index;
  SUNNonlinearSolver solver;
  N_Vector displacement; /* (nc) n_i of each row, see ida_newton.c; in units of Phi */
  N_Vector inertia;      /* (nv) M_jj s_j */
  double energy;         /* [J] largest |lambda_i| n_i at the start of the step */
  double momentum_q;     /* [J s^2] largest M_jj s_j tolerance_q_j */
  double momentum_v;     /* [J s] largest M_jj s_j tolerance_v_j */
  double tested;         /* [J] tolerance of |lambda_i| n_i in the error test; INFINITY: none */
  double share;          /* factor on the tolerances of q and v in the Newton test, <= 1 */
  double action;         /* [J s] largest |mu_i| n_i at the start of the step */
  double action_q;       /* [J s^2] largest W_jj s_j tolerance_q_j; W: see ida_newton.c */
  double first;          /* size of the first correction of the step */
} baum_i_ida_newton;

/* Make IDA use the convergence test of ida_newton.c. Set the members sundials, index, displacement
 * and inertia beforehand. Close `newton` after the memory of IDA has been freed. Returns a flag of
 * IDA. */
int baum_i_ida_newton_attach(baum_i_ida_newton *newton);
void baum_i_ida_newton_close(baum_i_ida_newton *newton);

/* Set displacement and inertia from J and M of the workspace. Call this at a start and whenever the
 * matrix is computed. */
void baum_i_ida_newton_measure(baum_i_ida_newton *newton);

/* Compute `energy` and `action` at the start of a step from the multipliers, which are lambda,
 * followed by mu for GGL. `weights` contains 1 / tolerance of q and v (nq + nv). If the error test
 * includes lambda, the function writes the weights of lambda (nc) after those of q and v. */
void baum_i_ida_newton_begin_step(baum_i_ida_newton *newton, const double *multipliers,
                                  double *weights);

/* Correct a solution for a matrix that was computed for a coefficient c0 instead of the present c.
 * The first function scales the right-hand side before the solution, and the second one scales the
 * solution. ratio is c / c0. */
void baum_i_ida_newton_scale_right(const baum_i_ida_newton *newton, double ratio, N_Vector right);
void baum_i_ida_newton_scale_solution(const baum_i_ida_newton *newton, double ratio,
                                      N_Vector solution);

#endif
