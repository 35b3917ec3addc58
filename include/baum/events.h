/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Events of a run: times at which a function of the state passes zero, or a joint coordinate
 *  passes a value.
 *
 *  Detection: the run evaluates its event functions after every step, at the quarters of the step
 *  and at outputs. After a change of sign it searches for the time of the event. The search uses
 *  the same states inside the last step as outputs do: variable-step methods interpolate the step,
 *  fixed-step methods take shorter steps from its start. The search is the same for every
 *  integrator. Two zeros between two evaluations are not detected; reduce max_step or the step.
 *
 *  Zero at the start: an event function may be zero where a run starts, after
 *  baum_simulation_set_state(), or where a run reverses. When it leaves zero there, this is not an
 *  event; its next crossing of zero is. A crossing shortly after such a start does not count,
 *  either, because the function may be zero up to rounding. Shortly means within 1e-10 T, where T
 *  is 1 over the rate that baum_simulation_explain() states, or within the tolerance of the event
 *  if that is longer. For IDA, which first moves the state onto the constraints, it means 10 rtol T
 *  instead of 1e-10 T. baum_simulation_set_input() and baum_simulation_set_driver() trigger no
 *  event: a function that jumps there continues with its new sign.
 *
 *  Events do not alter the motion, with one exception: a fixed-step run that stops at an event
 *  begins a new grid there, as at a target off the grid. */
#ifndef BAUM_EVENTS_H
#define BAUM_EVENTS_H

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/** An event: a user function that passes zero, or a joint coordinate that passes a value. */
typedef struct baum_event_def {
  size_t struct_size; /**< Set by the default. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "event<k>". */
  /** out (1); q (nq) and v (nv) are those of the whole run. It is called after a step. Therefore it
   *  cannot ask for a smaller step: any non-zero return value ends the call that advances the run.
   *  Default: NULL, the coordinate of `joint`. */
  baum_force_fn *function;
  baum_joint_id joint; /**< A joint with a coordinate, if function is NULL. Default: none. */
  double value;        /**< [rad or m] of the joint coordinate. Default: 0. */
  /** [-] 1: only rising in time, -1: only falling, 0: both. Default: 0. */
  int32_t direction;
  bool terminal;    /**< The call stops at the event with BAUM_STOP_EVENT. Default: true. */
  double tolerance; /**< [s] > 0, accuracy of the event's time. Default: NaN, its rounding. */
  void *user;       /**< Passed to function. Not owned. Default: NULL. */
  baum_joint_coordinate coordinate; /**< [-] of joint. Default: BAUM_COORDINATE_FIRST. */
} baum_event_def;

/** @copydoc baum_coordinates_def_init() */
BAUM_API void baum_event_def_init(baum_event_def *def, size_t caller_size);
/** @copydoc baum_coordinates_def_default() */
static inline baum_event_def baum_event_def_default(void)
{
  baum_event_def def;
  baum_event_def_init(&def, sizeof def);
  return def;
}

/** Add an event to a run, from the present state on. A run that stops at an event returns
 *  BAUM_STOP_EVENT, and its state is that at the event; the next call continues.
 *  baum_simulation_sample() has then filled the rows of the times before the event. Events at the
 *  same time are all recorded before the run stops. If an event happens at the time at which a call
 *  ends, that call records it, not the next one.
 *  @param      simulation  unchanged on failure
 *  @param[in]  def         copied
 *  @param[out] index       receives its number 0, 1, ... in the order of adding; not written on
 *                          failure. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK,
 *           BAUM_ERR_NOT_FINITE */
BAUM_API baum_status baum_simulation_add_event(baum_simulation *simulation,
                                               const baum_event_def *def, int32_t *index);

/** An event that has happened. */
typedef struct baum_event_record {
  size_t struct_size; /**< Set by baum_simulation_event(). */
  double t;      /**< [s] time of the event; equal for events that cannot be separated in time. */
  int32_t event; /**< [-] number of the event, from baum_simulation_add_event(). */
  int32_t direction; /**< [-] 1 rising in time, -1 falling. */
} baum_event_record;

/** Count the events that have happened since the run was created.
 *  @param simulation  may be NULL
 *  @return  0 for NULL */
BAUM_API int64_t baum_simulation_event_count(const baum_simulation *simulation);

/** Read an event that has happened. A run keeps the last 1024; read them during the run if there
 *  may be more.
 *  @param      simulation   the run
 *  @param      k            0 to baum_simulation_event_count() - 1, in the order in which they
 *                           happened
 *  @param[out] out          filled
 *  @param      caller_size  sizeof *out
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT */
BAUM_API baum_status baum_simulation_event(const baum_simulation *simulation, int64_t k,
                                           baum_event_record *out, size_t caller_size);

#ifdef __cplusplus
}
#endif

#endif
