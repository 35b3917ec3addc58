/* SPDX-License-Identifier: BSD-3-Clause */
/* The energy account of a run: works by class. It is evaluated along the motion in a separate
 * workspace. */
#ifndef BAUM_I_SIMULATE_ACCOUNT_H
#define BAUM_I_SIMULATE_ACCOUNT_H

#include "simulate/run.h"

/* Classes of work. The first BAUM_I_POWERS are the integrals of the powers of mechanism.h. */
enum {
  BAUM_I_WORK_DRIVERS = BAUM_I_POWERS,
  BAUM_I_WORK_VIOLATION,
  BAUM_I_WORK_PROJECTION,
  BAUM_I_WORK_GAINS, /* included in the works of drivers and violation */
  BAUM_I_WORKS
};

enum { BAUM_I_ACCOUNT_WIDTH = BAUM_I_WORKS + 3 }; /* kinetic, potential, works, residual */

/* Create the account of a run at its trial state. run->problem must be set. Returns BAUM_OK,
 * BAUM_ERR_MEMORY or BAUM_ERR_UNSUPPORTED. */
baum_status baum_i_account_create(baum_simulation *run);
/* The account may be NULL. */
void baum_i_account_destroy(const baum_integrator *method, baum_i_account *account);

/* The following functions require that run->account is not NULL. */

/* Restart at the present state: begin() with zero works, go_on() with the works that were read
 * last. */
void baum_i_account_begin(baum_simulation *run);
void baum_i_account_go_on(baum_simulation *run);

/* Add the works of the step to the trial state. Call this after the projection. If the works cannot
 * be evaluated, the run warns and the account ends. */
void baum_i_account_step(baum_simulation *run);
/* Fixed step: accept the step of the last baum_i_account_step(). A variable step is accepted when
 * the next one begins. */
void baum_i_account_accept(baum_simulation *run);

/* Compute the works up to the present state or a sample, for go_on() or baum_i_account_put(). */
void baum_i_account_read(baum_simulation *run, const baum_i_state *state);

/* The first function discards pivots, the second lists what is saved. */
void baum_i_account_forget(baum_i_account *account);
void baum_i_account_saved(baum_i_account *account, baum_i_saved *list);

/* Write the columns of the channel (BAUM_I_ACCOUNT_WIDTH). */
baum_status baum_i_account_put(baum_simulation *run, const baum_i_state *state, double *out);

#endif
