/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations in a singular configuration.
 *
 * There the equations allow those of all branches, and next to it they are rounding over the
 * smallest pivot. Those of the motion that goes on as its velocity says are the limit of what is
 * behind the configuration, on any smooth way that begins with this velocity: a cubic through four
 * states, q + dt v projected onto the constraints, is taken back to the pose.
 */
#ifndef BAUM_I_INTEGRATE_LIMIT_H
#define BAUM_I_INTEGRATE_LIMIT_H

#include "integrate/integrator.h"

/* Smallest pivot, of the usual one, below which the limit is closer: 0.0002 rad from the pose. */
#define BAUM_I_PIVOT_IN_POSE 4e-8

/* Into limit (nv); room (nq + nv). Leaves other states in the workspace. false: there is none, for
 * nothing moves to speak of or an evaluation fails. */
bool baum_i_limit_acceleration(const baum_i_problem *problem, const baum_i_state *state,
                               double *room, double *limit);

#endif
