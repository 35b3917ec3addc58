/* SPDX-License-Identifier: BSD-3-Clause */
/* Gives tests access to a run of generalized_alpha. */
#ifndef BAUM_I_INTEGRATE_GENERALIZED_ALPHA_H
#define BAUM_I_INTEGRATE_GENERALIZED_ALPHA_H

#include "integrate/integrator.h"

/* Return the multipliers (nc) at the end of the last accepted step. */
const double *baum_i_generalized_alpha_multipliers(const void *run);

#endif
