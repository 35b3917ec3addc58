/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations in a singular configuration.
 *
 * In a singular configuration the equations allow the accelerations of all branches. Near a
 * singular configuration, rounding errors are amplified, because they are divided by the smallest
 * pivot. The acceleration of the smooth motion is the limit of the accelerations along the motion
 * that leaves the configuration. Any smooth path with the same initial velocity has the same limit.
 * The path used here consists of states q + dt v projected onto the constraints. A cubic through
 * the accelerations at four of these states is extrapolated back to the configuration. */
#ifndef BAUM_I_INTEGRATE_LIMIT_H
#define BAUM_I_INTEGRATE_LIMIT_H

#include "integrate/integrator.h"

/* If the smallest pivot, relative to its usual value, is below this number, the limit is more
 * accurate than the solution of the equations. The pivot has this value about 0.0002 rad from the
 * singular configuration. */
#define BAUM_I_PIVOT_IN_POSE 4e-8

/* Compute the limit of the accelerations (nv) at a state. room (nq + nv) is scratch memory.
 * Afterwards the workspace contains the evaluation of another state. Returns false if the limit
 * cannot be computed, because the mechanism hardly moves or an evaluation fails. */
bool baum_i_limit_acceleration(const baum_i_problem *problem, const baum_i_state *state,
                               double *room, double *limit);

#endif
