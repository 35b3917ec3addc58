/* SPDX-License-Identifier: BSD-3-Clause */
/* Access to the multipliers of a generalized-alpha run, for tests. */
#ifndef BAUM_I_INTEGRATE_GENERALIZED_ALPHA_H
#define BAUM_I_INTEGRATE_GENERALIZED_ALPHA_H

#include "integrate/integrator.h"

/* Return the multipliers (nc) at the end of the last accepted step. */
const double *baum_i_generalized_alpha_multipliers(const void *run);

#endif
