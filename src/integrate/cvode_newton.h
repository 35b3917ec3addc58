/* SPDX-License-Identifier: BSD-3-Clause */
/* Solves the linear systems of CVODE BDF, whose matrix is the exact Jacobian. Only files of CVODE
 * include this header, and only if the build has SUNDIALS. */
#ifndef BAUM_I_INTEGRATE_CVODE_NEWTON_H
#define BAUM_I_INTEGRATE_CVODE_NEWTON_H

#include "integrate/sundials_klu.h"

typedef struct baum_i_cvode_newton {
  baum_i_sundials_klu klu;
  SUNLinearSolver solver; /* CVODE calls it, and it calls klu */
  /* [1/s] 1 / gamma for the value of CVODE's gamma with which the matrix was computed */
  double c;
  double *numbers;  /* memory of all arrays below */
  double *y;        /* (n) q, v, lambda */
  double *dy;       /* (n) q', v', 0 */
  double *mass;     /* block values of M, for which the matrix was computed */
  double *jacobian; /* block values of J, for which the matrix was computed */
} baum_i_cvode_newton;

/* The same rules as for baum_i_sundials_klu_open() and _close() apply. Attach newton->solver to
 * CVODE together with newton->klu.matrix. */
baum_status baum_i_cvode_newton_open(baum_i_cvode_newton *newton, baum_i_sundials *sundials);
void baum_i_cvode_newton_close(baum_i_cvode_newton *newton);

/* Fill the matrix at (t, y), y = (q, v). Returns the status of baum_i_problem_acceleration() or of
 * baum_i_sundials_klu_fill(). */
baum_status baum_i_cvode_newton_fill(baum_i_cvode_newton *newton, double t, const double *y,
                                     double gamma);

#endif
