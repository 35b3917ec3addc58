/* SPDX-License-Identifier: BSD-3-Clause */
/* Changes along the constraint forces of one configuration, as methods need them that keep Phi = 0
 * and J v = nu by forces -J^T lambda of that pose.
 */
#ifndef BAUM_I_DYNAMICS_CHORD_H
#define BAUM_I_DYNAMICS_CHORD_H

#include "dynamics/dynamics.h"

/* Factors of M and J of one configuration, good until something else is solved for. */
typedef struct baum_i_chord {
  baum_i_block_path *path; /* that has them; NULL: kkt */
} baum_i_chord;

/* Factor at a pose. Also BAUM_ERR_SINGULAR, BAUM_ERR_MEMORY. */
baum_status baum_i_chord_begin(baum_workspace *workspace, double t, const double *q,
                               baum_i_chord *out);

/* workspace->a becomes the change dq = -M^-1 J^T lambda with J dq = -Phi(t, q), M and J those of
 * the factors. Likewise. */
baum_status baum_i_chord_change(baum_workspace *workspace, const baum_i_chord *chord, double t,
                                const double *q);

/* a and lambda of M a + J^T lambda = g with J a = -rate Phi', at (t, q, v). Likewise. */
baum_status baum_i_hold_velocities(baum_workspace *workspace, double t, const double *q,
                                   const double *v, double rate);

#endif
