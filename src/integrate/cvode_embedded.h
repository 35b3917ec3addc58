/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's iteration of CVODE Adams on the stiffness of the stabilization. Only files of CVODE
 * include it, and only when the build has SUNDIALS. */
#ifndef BAUM_I_INTEGRATE_CVODE_EMBEDDED_H
#define BAUM_I_INTEGRATE_CVODE_EMBEDDED_H

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nonlinearsolver.h>

#include "integrate/sundials_common.h"

typedef struct baum_i_cvode_embedded {
  baum_i_sundials *sundials;
  SUNNonlinearSolver newton;
  SUNLinearSolver solver;
  N_Vector normal; /* scratch */
} baum_i_cvode_embedded;

/* After CVodeInit(); returns a flag of CVODE. `embedded` lives as long as CVODE and is closed after
 * it; a zeroed one may be closed. */
int baum_i_cvode_embedded_attach(baum_i_cvode_embedded *embedded, baum_i_sundials *sundials);
void baum_i_cvode_embedded_close(baum_i_cvode_embedded *embedded);

#endif
