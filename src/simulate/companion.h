/* SPDX-License-Identifier: BSD-3-Clause */
/* A second integration of the same motion beside a run, which estimates the error of the run. */
#ifndef BAUM_I_SIMULATE_COMPANION_H
#define BAUM_I_SIMULATE_COMPANION_H

#include "simulate/run.h"

/* Does a run whose problem is chosen need a companion? */
bool baum_i_companion_is_wanted(const baum_simulation *run);

/* Create it at the trial state. BAUM_OK, BAUM_ERR_MEMORY, BAUM_ERR_UNSUPPORTED. */
baum_status baum_i_companion_create(baum_simulation *run);
void baum_i_companion_destroy(baum_i_companion *companion);

/* The following functions do nothing if run->companion is NULL. */

/* Start at the present state, which has no error. */
void baum_i_companion_begin(baum_simulation *run);

/* Follow the run to `state`, the end of its last step, and warn if the two differ. */
void baum_i_companion_follow(baum_simulation *run, const baum_i_state *state);

/* Compare at the present state, where a call that advances the run ends. */
void baum_i_companion_end_call(baum_simulation *run);

/* For changes of inputs, laws and the like at the present state: settle() follows the run to this
 * state before the change, restart() continues from it after the change. */
void baum_i_companion_settle(baum_simulation *run);
void baum_i_companion_restart(baum_simulation *run);

/* Forget everything that is not saved. */
void baum_i_companion_forget(baum_simulation *run);

/* List what is saved. The companion must not be NULL. */
void baum_i_companion_saved(baum_i_companion *companion, baum_i_saved *list);

#endif
