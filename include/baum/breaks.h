/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Break times and schedules. A break time is a time at which a load or a law of the mechanism
 *  jumps or has a kink. A schedule lists the times at which an input changes, and the value of the
 *  input from each of these times on.
 */
#ifndef BAUM_BREAKS_H
#define BAUM_BREAKS_H

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Declare times at which laws, loads, user forces or other functions of time are discontinuous or
 *  have a kink. When such a function is called exactly at its break time, it must return the value
 *  that it has after the break.
 *
 *  No step crosses a break time (in short, a break), whether the run goes forward or backward in
 *  time. In a forward run, one step ends just before the break (a few rounding errors earlier), and
 *  the next step begins at the break. In a backward run, one step ends at the break, and the next
 *  step begins at a slightly smaller time. Methods that use past steps restart at the break
 *  (baum_counters.restarts counts these restarts). If a break is not on the grid of a fixed-step
 *  method, the method shortens the step before the break (baum_counters.short_steps counts such
 *  steps) and begins a new grid at the break. Breaks do not change the times of outputs, with one
 *  exception: if the requested time of an output differs from a break only by rounding, the output
 *  is moved to the time of the break.
 *
 *  Positions and velocities stay continuous at a break. If the law of a driver jumps, the state
 *  therefore violates the constraint of this driver after the break. baum_simulation_set_driver()
 *  describes how each formulation handles such a violation. With baum_kinematics(), however, the
 *  velocities do not stay continuous: they jump to the values that the law prescribes.
 *  @param     mechanism  not frozen; unchanged on failure
 *  @param[in] times      (count) [s] new break times, finite, in any order. They are added to the
 *                        break times of earlier calls. Copied. May be NULL if count is 0.
 *  @param     count      [-] >= 0
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE (frozen), BAUM_ERR_MEMORY */
BAUM_API baum_status baum_mechanism_add_break_times(baum_mechanism *mechanism, const double *times,
                                                    int32_t count);

/** Read the break times.
 *  @param      mechanism  may be NULL
 *  @param[out] count      [-] number of break times. May be NULL.
 *  @return (count) [s] the break times in rising order, without duplicates; owned by the mechanism.
 *          NULL if there are none */
BAUM_API const double *baum_mechanism_break_times(const baum_mechanism *mechanism, int32_t *count);

/** Schedule the values of an input. The input has the value values[k] from times[k] to times[k +
 *  1]. After the last time, it keeps the last value. Before times[0], the input keeps the value
 *  that it has when this function is called. The schedule makes the input a function of time:
 *  the input also follows the schedule when the run goes backward in time, and after
 *  baum_simulation_set_state() has moved the run to another time.
 *
 *  Each time at which the value changes is a break time of this run, see
 *  baum_mechanism_add_break_times(). Methods that use past steps restart at these times, and also
 *  when this function is called. The new schedule replaces an earlier schedule of the same input.
 *  baum_simulation_set_input() ends the schedule. A call of this function with a count of 0 ends
 *  the schedule, too, and the input keeps its present value. baum_simulation_save() saves
 *  schedules, and baum_simulation_continue() copies them.
 *  @param     simulation  unchanged on failure
 *  @param     input       an input of the mechanism
 *  @param[in] times       (count) [s] finite, rising; times before the present time are allowed.
 *                         Copied. May be NULL if count is 0.
 *  @param[in] values      (count) values of the input, finite. Copied. May be NULL if count is 0.
 *  @param     count       [-] >= 0
 *  @return  as baum_simulation_set_input() */
BAUM_API baum_status baum_simulation_schedule_input(baum_simulation *simulation,
                                                    baum_input_id input, const double *times,
                                                    const double *values, int32_t count);

#ifdef __cplusplus
}
#endif

#endif
