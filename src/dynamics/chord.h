/* SPDX-License-Identifier: BSD-3-Clause */
/* Corrections for methods that enforce Phi = 0 and J v = nu. Each correction is the effect of
 * constraint forces: -M^-1 J^T lambda, with J of one configuration.
 */
#ifndef BAUM_I_DYNAMICS_CHORD_H
#define BAUM_I_DYNAMICS_CHORD_H

#include "dynamics/dynamics.h"

/* Factors of the matrix of M and J at one configuration. Any other solution with the workspace
 * overwrites them. */
typedef struct baum_i_chord {
  baum_i_block_path *path; /* contains the factors; NULL: workspace->kkt contains them */
} baum_i_chord;

/* Factor the matrix at a configuration. May fail with BAUM_ERR_SINGULAR or BAUM_ERR_MEMORY. */
baum_status baum_i_chord_begin(baum_workspace *workspace, double t, const double *q,
                               baum_i_chord *out);

/* Set workspace->a to the change dq = -M^-1 J^T lambda with J dq = -Phi(t, q), for the factored M
 * and J. May fail with BAUM_ERR_SINGULAR or BAUM_ERR_MEMORY. */
baum_status baum_i_chord_change(baum_workspace *workspace, const baum_i_chord *chord, double t,
                                const double *q);

/* Set a and lambda to the solution of M a + J^T lambda = g with J a = -rate Phi', at (t, q, v).
 * Unless NULL, `moments` (nv) replaces the gyroscopic moments of rigid bodies. May fail with
 * BAUM_ERR_SINGULAR or BAUM_ERR_MEMORY. */
baum_status baum_i_hold_velocities(baum_workspace *workspace, double t, const double *q,
                                   const double *v, const double *moments, double rate);

#endif
