/* SPDX-License-Identifier: BSD-3-Clause */
/* Checking the options of a run. */
#ifndef BAUM_I_SIMULATE_OPTIONS_H
#define BAUM_I_SIMULATE_OPTIONS_H

#include <baum/simulation.h>

/* Check every field but struct_size, alone and in combination. BAUM_OK, BAUM_ERR_ARGUMENT,
 * BAUM_ERR_UNSUPPORTED. On success, the default formulation is replaced by the actual one. */
baum_status baum_i_options_check(baum_simulation_options *options);

#endif
