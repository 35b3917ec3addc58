/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's iteration for CVODE's Adams method. Its matrix contains only the derivatives of the
 * stabilization terms. Only files of CVODE include this header, and only if the build has
 * SUNDIALS. */
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

/* Call this after CVodeInit(). Returns a flag of CVODE. Close `embedded` after the memory of CVODE
 * has been freed. A zeroed `embedded` may be closed. */
int baum_i_cvode_embedded_attach(baum_i_cvode_embedded *embedded, baum_i_sundials *sundials);
void baum_i_cvode_embedded_close(baum_i_cvode_embedded *embedded);

#endif
