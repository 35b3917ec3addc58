/* SPDX-License-Identifier: BSD-3-Clause */
/* Which redundant rows a run leaves out (dynamics/row_set.c), and all in it that hangs on them. */
#ifndef BAUM_I_SIMULATE_ROWS_H
#define BAUM_I_SIMULATE_ROWS_H

#include "simulate/run.h"

/* At the present state, where the next step begins: leave out others where those that are kept have
 * become poor; then methods restart. Statuses of baum_i_run_restart(). Nothing for kinematics. */
baum_status baum_i_run_choose_rows(baum_simulation *run);

/* Likewise for a state that comes from outside of the motion, with which all restarts in any
 * case. */
void baum_i_run_choose_rows_anew(baum_simulation *run, const baum_i_state *state);

/* Leave out these (nc). Statuses of baum_i_omit_rows(); then all stays as it is. */
baum_status baum_i_run_omit_rows(baum_simulation *run, const unsigned char *omitted);

#endif
