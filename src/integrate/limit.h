/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations in a singular configuration.
 *
 * There the equations allow the accelerations of all branches, and next to it rounding is divided
 * by the smallest pivot. The motion that continues smoothly has the limit of the accelerations
 * behind the configuration, on any smooth path that begins with this velocity: a cubic through four
 * states, q + dt v projected onto the constraints, is extrapolated back to the configuration. */
#ifndef BAUM_I_INTEGRATE_LIMIT_H
#define BAUM_I_INTEGRATE_LIMIT_H

#include "integrate/integrator.h"

/* Smallest pivot, relative to the usual one, below which the limit is more accurate: 0.0002 rad
 * from the configuration. */
#define BAUM_I_PIVOT_IN_POSE 4e-8

/* Find the limit (nv); room (nq + nv). Leaves other states in the workspace. false: there is no
 * limit, because hardly anything moves or an evaluation fails. */
bool baum_i_limit_acceleration(const baum_i_problem *problem, const baum_i_state *state,
                               double *room, double *limit);

#endif
