/* SPDX-License-Identifier: BSD-3-Clause */
/* Inputs of a run that follow a schedule: jumps at times known before. Runs are at breaks there,
 * see breaks.h. */
#ifndef BAUM_I_SIMULATE_SCHEDULE_H
#define BAUM_I_SIMULATE_SCHEDULE_H

#include "simulate/run.h"

/* Time goes from one to another: inputs that jump between have the values of there. Goes back as
 * well. */
void baum_i_schedule_move(baum_simulation *run, double from, double to);

/* The input has no schedule any more, and keeps its value. */
void baum_i_schedule_end(baum_simulation *run, int64_t input);

/* Room for so many jumps. BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_schedule_reserve(baum_i_schedule *schedule, int count);

/* Into an empty one. BAUM_OK or BAUM_ERR_MEMORY. */
baum_status baum_i_schedule_copy(const baum_i_schedule *from, baum_i_schedule *to);

/* Are these bytes, of any alignment, `count` jumps of a run with so many inputs? */
bool baum_i_schedule_is_sound(const void *bytes, int64_t count, int64_t input_count);

#endif
