/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps of fixed length that begin or end in a singular configuration (docs/theory/singular.md). */
#ifndef BAUM_I_SIMULATE_SINGULAR_STEP_H
#define BAUM_I_SIMULATE_SINGULAR_STEP_H

#include "simulate/run.h"

/* A step begins whose acceleration is in run->acceleration: in a singular configuration its limit
 * takes that place. Uses the trial state. Statuses of an evaluation at the present state, which is
 * made again. */
baum_status baum_i_run_limit_acceleration(baum_simulation *run);

/* Project the trial state, the end of a step, onto the constraints at t; but so close to a singular
 * configuration that rounding would move it by more than the error of the step it stays. Statuses
 * of baum_i_project(). */
baum_status baum_i_run_project(baum_simulation *run, double t);

#endif
