/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Events of a run: times at which a function of the state, or the coordinate of a joint, passes
 *  zero or a value.
 *
 *  A run looks at its events after every step: at the end, at the quarters of the step and at
 *  outputs. Where one has changed sign, the time is found in the motion as outputs see it: inside
 *  the last step of a variable-step method by its interpolant, inside a step of fixed length by
 *  shorter steps from its start. It is the same search for every integrator. A function that passes
 *  zero twice between two looks goes unseen: max_step, or a smaller step, helps.
 *  An event that is zero at the start, after baum_simulation_set_state() or where a run turns is
 *  not triggered by leaving zero, but by coming back. Zero is what is reached within 1e-10 of the
 *  time T that baum_simulation_explain() tells, or within the event's tolerance; for IDA, which
 *  begins on the constraints, within 10 rtol T. baum_simulation_set_input() and _set_driver()
 *  trigger nothing: a function that jumps there is seen on its new side.
 *  Events never alter the motion, but for a fixed-step run that stops: it stands at the event, and
 *  its grid begins there, as with a target off the grid.
 */
#ifndef BAUM_EVENTS_H
#define BAUM_EVENTS_H

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What an event is: a function of the user that passes zero, or a joint's coordinate that passes a
 *  value. Start from baum_event_def_default(). */
typedef struct baum_event_def {
  size_t struct_size;      /**< Set by the default. Do not write. */
  const char *name;        /**< Label in messages. Copied. Default: NULL, "event<k>". */
  baum_force_fn *function; /**< out (1); q and v are those of the whole run (nq), (nv). Asked after
                               steps, it cannot ask for smaller ones: > 0 stops the call as < 0
                               does. Default: NULL, the joint's coordinate. */
  baum_joint_id joint;     /**< With a coordinate; instead of function. Default: none. */
  double value;            /**< [rad or m] of the coordinate. Default: 0. */
  int32_t direction; /**< [-] 1: rising in time only, -1: falling only, 0: both. Default: 0. */
  bool terminal;     /**< The call stops at it with BAUM_STOP_EVENT. Default: true. */
  double tolerance;  /**< [s] > 0, of its time. Default: NaN, rounding of the time. */
  void *user;        /**< Passed to function, not owned. Default: NULL. */
} baum_event_def;

/** Set the defaults of a definition; writes at most caller_size bytes.
 *  @param[out] def          NULL is ignored
 *  @param      caller_size  sizeof *def
 */
BAUM_API void baum_event_def_init(baum_event_def *def, size_t caller_size);

/** The default definition of an event. */
static inline baum_event_def baum_event_def_default(void)
{
  baum_event_def def;
  baum_event_def_init(&def, sizeof def);
  return def;
}

/** Add an event to a run, from the present state on. A run that stops at one returns
 *  BAUM_STOP_EVENT, stands exactly at it, and the next call goes on; of baum_simulation_sample()
 *  the rows before it are done. Events at one time are all recorded before the run stops. One at
 *  the end of a call is found by that call, and the run stands there all the same.
 *  @param[in]  def    copied
 *  @param[out] index  receives its number, 0, 1, ... in the order of adding; left as it is on
 *                     failure. May be NULL.
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK,
 *              BAUM_ERR_NOT_FINITE; the run is unchanged on failure
 */
BAUM_API baum_status baum_simulation_add_event(baum_simulation *simulation,
                                               const baum_event_def *def, int32_t *index);

/** One event that has happened. */
typedef struct baum_event_record {
  size_t struct_size; /**< Set by baum_simulation_event(). */
  double t;           /**< [s] when; the same for events that cannot be told apart in time. */
  int32_t event;      /**< [-] its number, as baum_simulation_add_event() has given it. */
  int32_t direction;  /**< [-] 1 rising in time, -1 falling. */
} baum_event_record;

/** How many events have happened since the run was created; 0 for NULL. */
BAUM_API int64_t baum_simulation_event_count(const baum_simulation *simulation);

/** Read an event that has happened. The last 1024 are kept; a longer run reads them as it goes.
 *  @param      k            0 to baum_simulation_event_count() - 1, in the order in which they
 *                           happened
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return     BAUM_OK, BAUM_ERR_ARGUMENT
 */
BAUM_API baum_status baum_simulation_event(const baum_simulation *simulation, int64_t k,
                                           baum_event_record *out, size_t caller_size);

#ifdef __cplusplus
}
#endif

#endif
