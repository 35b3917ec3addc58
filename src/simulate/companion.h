/* SPDX-License-Identifier: BSD-3-Clause */
/* A second integration of the same motion beside a run, by which the run's error is known. */
#ifndef BAUM_I_SIMULATE_COMPANION_H
#define BAUM_I_SIMULATE_COMPANION_H

#include "simulate/run.h"

/* Of a run whose problem is chosen. */
bool baum_i_companion_is_wanted(const baum_simulation *run);

/* For such a run, at its trial state. BAUM_OK, BAUM_ERR_MEMORY, BAUM_ERR_UNSUPPORTED. */
baum_status baum_i_companion_create(baum_simulation *run);
void baum_i_companion_destroy(baum_i_companion *companion);

/* What follows does nothing where run->companion is NULL. */

/* The present state is a start: it has no error. */
void baum_i_companion_begin(baum_simulation *run);

/* A step goes on from `state`, where the last one has ended. Warns where the two differ. */
void baum_i_companion_follow(baum_simulation *run, const baum_i_state *state);

/* A call that advances the run ends at the present state. */
void baum_i_companion_end_call(baum_simulation *run);

/* What acts on the mechanism changes at the present state: come there before it does, and go on
 * from there after. */
void baum_i_companion_settle(baum_simulation *run);
void baum_i_companion_restart(baum_simulation *run);

/* Keep nothing that is not saved. */
void baum_i_companion_forget(baum_simulation *run);

/* What is saved of it; NULL is not fine. */
void baum_i_companion_saved(baum_i_companion *companion, baum_i_saved *list);

#endif
