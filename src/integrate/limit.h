/* SPDX-License-Identifier: BSD-3-Clause */
/* Accelerations in a singular configuration.
 *
 * In such a configuration the equations allow the accelerations of all branches; next to it,
 * rounding errors are divided by the smallest pivot. The smooth motion has the limit of the
 * accelerations beyond the configuration. Any smooth path that begins with its velocity gives this
 * limit. The path here consists of states q + dt v projected onto the constraints; a cubic through
 * the accelerations at four of them is extrapolated back to the configuration. */
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
