/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls to runs that must not fail. If one fails, the test fails with its message. */
#ifndef BAUM_TEST_RUNS_H
#define BAUM_TEST_RUNS_H

#include <baum/simulation.h>

baum_simulation *create_run(const baum_mechanism *mechanism,
                            const baum_simulation_options *options);
baum_counters counters_of(baum_simulation *run);

#endif
