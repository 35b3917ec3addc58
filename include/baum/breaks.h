/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Break times: times at which the loads on a mechanism or its laws jump. Schedules: inputs that
 *  change at given times.
 */
#ifndef BAUM_BREAKS_H
#define BAUM_BREAKS_H

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Declare times at which laws, loads, user forces or other functions of time are discontinuous or
 *  have a kink. At its break time a function must return the value after the break.
 *
 *  No step crosses a break, forward or backward in time. Forward in time, a step ends a few
 *  rounding errors before the break, and the next step begins at the break. Methods that use past
 *  steps restart there (counters.restarts). A fixed-step method shortens the step before a break
 *  that is off its grid (counters.short_steps) and begins a new grid at the break. Breaks do not
 *  change the times of outputs. A requested time that differs from a break only by rounding is
 *  moved to the break.
 *
 *  Positions and velocities stay continuous. After a jump in the law of a driver, the state
 *  therefore violates the constraint of the driver, as after baum_simulation_set_driver(). Only
 *  baum_kinematics() takes the new velocities from the law.
 *  @param     mechanism  not frozen; unchanged on failure
 *  @param[in] times      (count) [s] finite, in any order, in addition to earlier ones. Copied.
 *                        NULL if count is 0.
 *  @param     count      [-] >= 0
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (frozen), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_add_break_times(baum_mechanism *mechanism, const double *times,
                                                    int32_t count);

/** Read the break times.
 *  @param      mechanism  may be NULL
 *  @param[out] count      [-] their number. May be NULL.
 *  @return (count) [s] rising, without repetition, owned by the mechanism; NULL if there are
 *  none */
BAUM_API const double *baum_mechanism_break_times(const baum_mechanism *mechanism, int32_t *count);

/** Schedule the values of an input: values[k] holds from times[k] to times[k + 1]. The last value
 *  holds from the last time on. Before times[0] the input has its value at the time of this call.
 *  The schedule is a function of time: it also holds backward in time, at past times, and after
 *  baum_simulation_set_state().
 *
 *  Each time at which the value changes is a break time of this run, see
 *  baum_mechanism_add_break_times(). Methods that use past steps restart there and at this call.
 *  The schedule replaces an earlier one of this input. baum_simulation_set_input(), or a count of
 *  0, ends it; a count of 0 keeps the present value. baum_simulation_save() includes schedules, and
 *  baum_simulation_continue() copies them.
 *  @param     simulation  unchanged on failure
 *  @param     input       one of the mechanism
 *  @param[in] times       (count) [s] finite, rising; may be in the past. Copied. NULL if count is
 *                         0.
 *  @param[in] values      (count) finite. Copied. NULL if count is 0.
 *  @param     count       [-] >= 0
 *  @return  as baum_simulation_set_input() */
BAUM_API baum_status baum_simulation_schedule_input(baum_simulation *simulation,
                                                    baum_input_id input, const double *times,
                                                    const double *values, int32_t count);

#ifdef __cplusplus
}
#endif

#endif
