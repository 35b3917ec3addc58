/* SPDX-License-Identifier: BSD-3-Clause */
/* Times of a run at which what acts on the mechanism jumps. */
#ifndef BAUM_I_SIMULATE_BREAKS_H
#define BAUM_I_SIMULATE_BREAKS_H

#include "simulate/run.h"

/* The two sides of a break, in the order in which the run meets them. */
typedef struct baum_i_break {
  double near; /* [s] where steps end */
  double far;  /* where the next begins */
} baum_i_break;

/* The next break on the way of the run from the end of its last step; both sides infinite when
 * there is none. */
baum_i_break baum_i_run_next_break(const baum_simulation *run);

/* Does the last step end at its near side? */
bool baum_i_run_is_at(const baum_simulation *run, baum_i_break next);

/* restart.c: from the present state, which is at the near side, to the far one: methods that carry
 * their past along restart, as the grid does. As baum_i_run_restart(). */
baum_status baum_i_run_pass(baum_simulation *run, baum_i_break next);

#endif
