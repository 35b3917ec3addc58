/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Break times: when what acts on a mechanism is known to jump.
 */
#ifndef BAUM_BREAKS_H
#define BAUM_BREAKS_H

#include <baum/mechanism.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Declare times at which laws, loads, user forces or other functions of time jump, or change by a kink. At its
 *  break time a function has the value of after. No step of a run passes one: a step ends there, a few
 *  roundings before the time, and the next begins at it, which is where methods that carry their past along
 *  begin anew (counters.restarts). With fixed steps the step before is shorter where the break is off the
 *  grid (counters.short_steps), and the grid begins there. Backward in time likewise. Positions and velocities go on
 *  as they are: what jumps in the law of a driver is a violation, as with
 *  baum_simulation_set_driver(). Outputs are where they would be; a target nearer to a break than the rounding of time
 *  is the break.
 *  @param     mechanism  not yet frozen
 *  @param[in] times      (count) [s] finite, in any order; added to those there are. Copied. NULL when
 *                        count is 0
 *  @return    BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STATE, BAUM_ERR_MEMORY; the mechanism is unchanged
 *             on failure
 */
BAUM_API baum_status baum_mechanism_add_break_times(baum_mechanism *mechanism, const double *times,
                                                    int32_t count);

/** The break times, rising, each once; owned by the mechanism.
 *  @param[out] count  their number. May be NULL.
 *  @return     NULL for NULL, and where there are none
 */
BAUM_API const double *baum_mechanism_break_times(const baum_mechanism *mechanism, int32_t *count);

#ifdef __cplusplus
}
#endif

#endif
