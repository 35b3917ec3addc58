/* SPDX-License-Identifier: BSD-3-Clause */
/* The energy account of a run: works by class. It runs beside the motion with equations of its
 * own. */
#ifndef BAUM_I_SIMULATE_ACCOUNT_H
#define BAUM_I_SIMULATE_ACCOUNT_H

#include "simulate/run.h"

/* Works; the first BAUM_I_POWERS belong to the powers of mechanism.h. */
enum {
  BAUM_I_WORK_DRIVERS = BAUM_I_POWERS,
  BAUM_I_WORK_VIOLATION,
  BAUM_I_WORK_PROJECTION,
  BAUM_I_WORK_GAINS, /* part of two other works, for information */
  BAUM_I_WORKS
};

enum { BAUM_I_ACCOUNT_WIDTH = BAUM_I_WORKS + 3 }; /* kinetic, potential, works, residual */

/* Create the account of a run whose problem is chosen, at its trial state. BAUM_OK,
 * BAUM_ERR_MEMORY, BAUM_ERR_UNSUPPORTED. */
baum_status baum_i_account_create(baum_simulation *run);
/* The account may be NULL. */
void baum_i_account_destroy(const baum_integrator *method, baum_i_account *account);

/* The following functions need run->account. */

/* Restart at the present state: with zero works, or with the works that were read last. */
void baum_i_account_begin(baum_simulation *run);
void baum_i_account_go_on(baum_simulation *run);

/* Add the works of the step to the trial state, after its projection. If they cannot be evaluated,
 * the run warns and the account ends. */
void baum_i_account_step(baum_simulation *run);
/* Fixed step: accept that step. A variable step counts as soon as the next one begins. */
void baum_i_account_accept(baum_simulation *run);

/* Read the works up to the present state or a sample, for go_on() or the columns. */
void baum_i_account_read(baum_simulation *run, const baum_i_state *state);

/* Forget pivots; list what is saved. */
void baum_i_account_forget(baum_i_account *account);
void baum_i_account_saved(baum_i_account *account, baum_i_saved *list);

/* Columns of the channel (BAUM_I_ACCOUNT_WIDTH). */
baum_status baum_i_account_put(baum_simulation *run, const baum_i_state *state, double *out);

#endif
