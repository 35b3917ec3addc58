/* SPDX-License-Identifier: BSD-3-Clause */
/* Creates runs, saves them and reads their counters. If such a call fails, the test fails. This
 * file also has a check that wrong options are refused. */
#ifndef BAUM_TEST_RUNS_H
#define BAUM_TEST_RUNS_H

#include <stddef.h>

#include <baum/simulation.h>

baum_simulation *create_run(const baum_mechanism *mechanism,
                            const baum_simulation_options *options);
baum_counters counters_of(baum_simulation *run);

/* Saves a run. The caller frees the buffer. */
unsigned char *save_run(baum_simulation *run, size_t *size);

/* Checks that a run cannot be created, and that NULL replaces the caller's pointer. In `parts`, the
 * character '|' separates parts of the message. */
void check_run_refused(const baum_mechanism *mechanism, const baum_simulation_options *options,
                       baum_status want, const char *parts);

#endif
