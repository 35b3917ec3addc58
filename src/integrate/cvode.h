/* SPDX-License-Identifier: BSD-3-Clause */
/* What tests of CVODE see of its inside. Only in builds with SUNDIALS. */
#ifndef BAUM_I_INTEGRATE_CVODE_H
#define BAUM_I_INTEGRATE_CVODE_H

#include "integrate/integrator.h"

/* The x of (I - gamma df/dy) x = r at y = (q, v), as a run of baum_cvode_bdf() solves it; all (nq +
 * nv). As an acceleration, and BAUM_ERR_SINGULAR without a message. */
baum_status baum_i_cvode_solve_newton(void *self, double t, const double *y, double gamma,
                                      const double *r, double *x);

#endif
