/* SPDX-License-Identifier: BSD-3-Clause */
/* What tests of IDA see of its inside. Only in builds with SUNDIALS. */
#ifndef BAUM_I_INTEGRATE_IDA_H
#define BAUM_I_INTEGRATE_IDA_H

#include "integrate/integrator.h"

/* As baum_ida()->create(), but dense and by IDA's own differences. */
baum_status baum_i_ida_create_with_differences(const baum_i_problem *problem,
                                               const baum_i_state *start, void **out);

/* Its own multipliers at the end of the last step (nc), which nobody is told. */
const double *baum_i_ida_multipliers(const void *run);

#endif
