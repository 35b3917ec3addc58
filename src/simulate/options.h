/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks the options of a run. */
#ifndef BAUM_I_SIMULATE_OPTIONS_H
#define BAUM_I_SIMULATE_OPTIONS_H

#include <baum/simulation.h>

/* Check all fields except struct_size, and check that the fields are compatible. Returns BAUM_OK,
 * BAUM_ERR_ARGUMENT or BAUM_ERR_UNSUPPORTED. If the formulation is the default, it is replaced by
 * the formulation that is actually used. */
baum_status baum_i_options_check(baum_simulation_options *options);

#endif
