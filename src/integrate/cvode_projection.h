/* SPDX-License-Identifier: BSD-3-Clause */
/* Projection within CVODE BDF. Only files of CVODE include it, and only when the build has
 * SUNDIALS. */
#ifndef BAUM_I_INTEGRATE_CVODE_PROJECTION_H
#define BAUM_I_INTEGRATE_CVODE_PROJECTION_H

#include "integrate/sundials_common.h"

/* What CVODE's projection asks for at y = (q, v): the correction that leads onto the constraints,
 * and the error that is left, in place; error may be NULL. work (nq + nv) is scratch. Answers as a
 * callback: 0, +1 where a smaller step may help, else -1. */
int baum_i_cvode_project(baum_i_sundials *sundials, double t, N_Vector y, N_Vector correction,
                         N_Vector error, N_Vector work);

#endif
