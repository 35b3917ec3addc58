/* SPDX-License-Identifier: BSD-3-Clause */
/* Access for tests to a run of generalized-alpha. */
#ifndef BAUM_I_INTEGRATE_GENERALIZED_ALPHA_H
#define BAUM_I_INTEGRATE_GENERALIZED_ALPHA_H

#include "integrate/integrator.h"

/* (nc) at the end of the last step that was accepted. */
const double *baum_i_generalized_alpha_multipliers(const void *run);

#endif
