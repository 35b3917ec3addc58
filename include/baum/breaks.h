/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Break times: when what acts on a mechanism is known to jump; inputs that jump by a schedule.
 */
#ifndef BAUM_BREAKS_H
#define BAUM_BREAKS_H

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Declare times at which laws, loads, user forces or other functions of time jump, or change by a
 *  kink. At its break time a function has the value of after. No step of a run passes one: a step
 *  ends there, a few roundings before the time, and the next begins at it, which is where methods
 *  that carry their past along restart (counters.restarts). With fixed steps the step before is
 *  shorter where the break is off the grid (counters.short_steps), and the grid begins there.
 *  Backward in time likewise. Positions and velocities go on as they are: what jumps in the law of
 *  a driver is a violation, as with baum_simulation_set_driver(). Only kinematics have the
 *  velocities of the law. Outputs are where they would be; a target nearer to a break than the
 *  rounding of time is the break.
 *  @param     mechanism  not yet frozen
 *  @param[in] times      (count) [s] finite, in any order; added to those there are. Copied. NULL
 *                        when count is 0
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the mechanism is
 *             unchanged on failure
 */
BAUM_API baum_status baum_mechanism_add_break_times(baum_mechanism *mechanism, const double *times,
                                                    int32_t count);

/** The break times, rising, each once; owned by the mechanism.
 *  @param[out] count  their number. May be NULL.
 *  @return     NULL for NULL, and where there are none
 */
BAUM_API const double *baum_mechanism_break_times(const baum_mechanism *mechanism, int32_t *count);

/** Give an input of a run values from times on: values[k] from times[k] to times[k + 1], the last
 *  one for good, and before times[0] the value that it has at the call. It is a function of time
 *  then, also backward, past times, and where baum_simulation_set_state() goes. Every time at which
 *  the value changes is a break time of this run, as of baum_mechanism_add_break_times(): steps end
 *  there and methods that carry their past along restart, as they do at this call. It replaces a
 *  schedule that the input has, and ends with baum_simulation_set_input() or a count of 0, which
 *  keep what is set and the present value. baum_simulation_save() has schedules, and
 *  baum_simulation_continue() takes them over.
 *  @param     input   of the mechanism of the run
 *  @param[in] times   (count) [s] finite, rising, also before the present one. Copied. NULL when
 *                     count is 0
 *  @param[in] values  (count) finite. Copied. NULL when count is 0
 *  @param     count   [-] >= 0
 *  @return    as baum_simulation_set_input(); the run is unchanged on failure
 */
BAUM_API baum_status baum_simulation_schedule_input(baum_simulation *simulation,
                                                    baum_input_id input, const double *times,
                                                    const double *values, int32_t count);

#ifdef __cplusplus
}
#endif

#endif
