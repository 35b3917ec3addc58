/* SPDX-License-Identifier: BSD-3-Clause */
/* A second integration of the same motion beside a run, which estimates the error of the run. */
#ifndef BAUM_I_SIMULATE_COMPANION_H
#define BAUM_I_SIMULATE_COMPANION_H

#include "simulate/run.h"

/* Tell whether a run needs a companion. run->problem must be set. */
bool baum_i_companion_is_wanted(const baum_simulation *run);

/* Create the companion at the trial state. Returns BAUM_OK, BAUM_ERR_MEMORY or
 * BAUM_ERR_UNSUPPORTED. */
baum_status baum_i_companion_create(baum_simulation *run);
void baum_i_companion_destroy(baum_i_companion *companion);

/* The following functions do nothing if run->companion is NULL. */

/* Start at the present state, which is assumed to be exact. */
void baum_i_companion_begin(baum_simulation *run);

/* Follow the run to `state`, the end of its last step, and warn if run and companion differ. */
void baum_i_companion_follow(baum_simulation *run, const baum_i_state *state);

/* Compare at the present state, where a call that advances the run ends. */
void baum_i_companion_end_call(baum_simulation *run);

/* Call these functions when equations change at the present state, for example because an input
 * changes. settle(), before the change, follows the run to this state. restart(), after the change,
 * continues from this state. */
void baum_i_companion_settle(baum_simulation *run);
void baum_i_companion_restart(baum_simulation *run);

/* Forget everything that is not saved. */
void baum_i_companion_forget(baum_simulation *run);

/* List what is saved. The companion must not be NULL. */
void baum_i_companion_saved(baum_i_companion *companion, baum_i_saved *list);

#endif
