/* SPDX-License-Identifier: BSD-3-Clause */
/* The energy account of a run contains the works of the different classes of forces. It is
 * evaluated along the motion, in a separate workspace. */
#ifndef BAUM_I_SIMULATE_ACCOUNT_H
#define BAUM_I_SIMULATE_ACCOUNT_H

#include "simulate/run.h"

/* Classes of work. The works of the first BAUM_I_POWERS classes are the time integrals of the
 * powers in mechanism.h. */
enum {
  BAUM_I_WORK_DRIVERS = BAUM_I_POWERS,
  BAUM_I_WORK_VIOLATION,
  BAUM_I_WORK_PROJECTION,
  BAUM_I_WORK_GAINS, /* also included in the works of drivers and violation */
  BAUM_I_WORKS
};

/* Number of columns of the account: kinetic energy, potential energy, the works and the
 * residual. */
enum { BAUM_I_ACCOUNT_WIDTH = BAUM_I_WORKS + 3 };

/* Create the account of a run. The account starts at the trial state of the run. run->problem must
 * already be set. Returns BAUM_OK, BAUM_ERR_MEMORY or BAUM_ERR_UNSUPPORTED. */
baum_status baum_i_account_create(baum_simulation *run);
/* Destroy the account, which may be NULL. */
void baum_i_account_destroy(const baum_integrator *method, baum_i_account *account);

/* The following functions may be called only if run->account is not NULL. */

/* Restart the account at the present state. begin() starts with zero works. go_on() starts with the
 * works that baum_i_account_read() computed last. */
void baum_i_account_begin(baum_simulation *run);
void baum_i_account_go_on(baum_simulation *run);

/* Add the works of the step that ends at the trial state. This must be called after the projection.
 * If the works cannot be evaluated, the run gives a warning and the account ends. */
void baum_i_account_step(baum_simulation *run);
/* With fixed steps, call this when the last step is accepted: its works become part of the account.
 * With variable steps, this happens when the next step begins. */
void baum_i_account_accept(baum_simulation *run);

/* Compute the works up to the present state or up to a sample. go_on() and baum_i_account_put() use
 * the result. */
void baum_i_account_read(baum_simulation *run, const baum_i_state *state);

/* The first function discards the pivots of the account's solver. The second function lists which
 * data of the account are saved. */
void baum_i_account_forget(baum_i_account *account);
void baum_i_account_saved(baum_i_account *account, baum_i_saved *list);

/* Write the BAUM_I_ACCOUNT_WIDTH columns of the account at `state` to `out`. */
baum_status baum_i_account_put(baum_simulation *run, const baum_i_state *state, double *out);

#endif
