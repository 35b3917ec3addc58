/* SPDX-License-Identifier: BSD-3-Clause */
/* The companion of a run is a second integration of the same motion, from which the error of the
 * run is estimated. */
#ifndef BAUM_I_SIMULATE_COMPANION_H
#define BAUM_I_SIMULATE_COMPANION_H

#include "simulate/run.h"

/* Tell whether a run needs a companion. run->problem must already be set. */
bool baum_i_companion_is_wanted(const baum_simulation *run);

/* Create the companion. It starts at the trial state of the run. Returns BAUM_OK, BAUM_ERR_MEMORY
 * or BAUM_ERR_UNSUPPORTED. */
baum_status baum_i_companion_create(baum_simulation *run);
void baum_i_companion_destroy(baum_i_companion *companion);

/* The following functions do nothing if run->companion is NULL. */

/* Start the companion at the present state of the run. This state is assumed to be exact. */
void baum_i_companion_begin(baum_simulation *run);

/* The run has finished a step, which ends at `state`. Let the companion follow to this state, and
 * warn if run and companion differ. */
void baum_i_companion_follow(baum_simulation *run, const baum_i_state *state);

/* The user receives `state`, which may be inside the last step. Compare run and companion there. */
void baum_i_companion_output(baum_simulation *run, const baum_i_state *state);

/* Call these functions when the equations change at the present state, for example because an input
 * changes. Call settle() before the change: the companion follows the run to this state. Call
 * restart() after the change: the companion continues from this state. */
void baum_i_companion_settle(baum_simulation *run);
void baum_i_companion_restart(baum_simulation *run);

/* Discard everything that is not part of a saved run. */
void baum_i_companion_forget(baum_simulation *run);

/* List which data of the companion are saved. The companion must not be NULL. */
void baum_i_companion_saved(baum_i_companion *companion, baum_i_saved *list);

#endif
