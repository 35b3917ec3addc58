/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Events of a run: times at which a function of the state passes zero, or a joint coordinate
 *  passes a value.
 *
 *  Detection: after every step, the run evaluates its event functions at the end of the step, and
 *  at a quarter, a half and three quarters of it. It also evaluates them at the times of outputs.
 *  If the sign of a function has changed, the run searches for the time of the event. The search
 *  needs states inside the step. The run computes these states in the same way as outputs:
 *  variable-step methods interpolate the step, and fixed-step methods take shorter steps from the
 *  start of the step. A joint coordinate may pass the value of its event and return between two
 *  evaluations. The run usually detects both of these events, because it also knows the rate of the
 *  coordinate. A user function may also pass zero twice between two evaluations, but then the run
 *  detects neither of these events. To avoid this, reduce max_step for variable-step methods, or
 *  the step for fixed-step methods.
 *
 *  Breaks: an event function may jump through zero at a declared break time or where a scheduled
 *  input changes (baum/breaks.h). This jump is an event at the time of the break. In a backward
 *  run, the time of the event is smaller than that of the break by a few rounding errors.
 *
 *  Zero at the start: an event function may be zero at the start of a run, after
 *  baum_simulation_set_state(), or where a run reverses its direction in time. When the function
 *  then leaves zero, this is not an event. If it returns to zero shortly afterwards, this is not an
 *  event, either, because rounding errors of the starting state may be the cause. Every later zero
 *  is an event. "Shortly" means within 1e-10 T, or within the tolerance of the event if that is
 *  longer. T is 1/r, where r is the rate of the motion, which baum_simulation_explain() states. For
 *  the method IDA, "shortly" means 10 rtol T instead of 1e-10 T, because IDA first moves the state
 *  onto the constraints. To find the sign that an event function takes when the motion starts, the
 *  run also evaluates the function for other velocities than those of the state, and at times up to
 *  2e-5 T after the start, with q moved along v.
 *
 *  Impacts: a program may model the impacts of a body on a stop by a terminal event, and reverse
 *  the velocities at each impact. The impacts may follow each other ever faster. In the end, one of
 *  two cases occurs: the event happens again shortly after the previous impact, although the
 *  reversed velocities move the event function away from zero; or the method computes velocities
 *  with the wrong sign at the next impact. In both cases the run fails with BAUM_ERR_STEP, because
 *  the body would otherwise fall through the stop. Let such a body rest once it is slow; the page
 *  "docs/cookbook/stop.md" shows how.
 *
 *  Changes by the program: baum_simulation_set_input() and baum_simulation_set_driver() trigger no
 *  event. If such a call changes the sign of an event function, the run continues with the new
 *  sign.
 *
 *  Events do not alter the motion, with one exception: if a fixed-step run stops at an event, it
 *  begins a new grid of steps at the time of the event. */
#ifndef BAUM_EVENTS_H
#define BAUM_EVENTS_H

#include <baum/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/** An event: a user function that passes zero, or a joint coordinate that passes a value. */
typedef struct baum_event_def {
  size_t struct_size; /**< Set by the default function. Do not write. */
  const char *name;   /**< Label in messages. Copied. Default: NULL, "event<k>". */
  /** The event function. It writes one number to its argument `out`; its arguments q (nq) and v
   *  (nv) are those of the whole mechanism. The run calls it when a step is complete, so the
   *  function cannot ask for a smaller step: if its return value is not 0, the call that advances
   *  the run fails. Default: NULL, the coordinate of `joint` is used. */
  baum_force_fn *function;
  /** A joint with a coordinate. Must be set if function is NULL, and only then. Default: none. */
  baum_joint_id joint;
  double value; /**< [rad or m] value of the joint coordinate at the event. Default: 0. */
  /** [-] which zeros of the event function are events, or which passes of the joint coordinate
   *  through `value`. 1: only those where the function or the coordinate rises in time; -1: only
   *  those where it falls; 0: all of them. Default: 0. */
  int32_t direction;
  bool terminal; /**< True if the run stops at the event (BAUM_STOP_EVENT). Default: true. */
  /** [s] > 0, accuracy of the time of the event. Default: NaN, 4 rounding errors of the time. */
  double tolerance;
  void *user; /**< Passed to `function`. Not owned. Default: NULL. */
  /** [-] coordinate of `joint` that the event observes. Default: BAUM_COORDINATE_FIRST. */
  baum_joint_coordinate coordinate;
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

/** Add an event to a run. The run looks for the event from the present state on. When a run stops
 *  at an event, the call that advances the run returns BAUM_STOP_EVENT, and the state of the run is
 *  the state at the event. The next call continues the run. If baum_simulation_sample() returns
 *  BAUM_STOP_EVENT, it has written the samples of the times before the event. If several events
 *  happen at the same time, the run records all of them before it stops. If an event happens
 *  exactly at the time at which a call ends, that call records it.
 *  @param      simulation  unchanged on failure
 *  @param[in]  def         copied
 *  @param[out] index       receives the number of the event; events are numbered 0, 1, ... in the
 *                          order of adding. Not written on failure. May be NULL.
 *  @return  BAUM_OK, BAUM_ERR_ARGUMENT, BAUM_ERR_STRUCT, BAUM_ERR_MEMORY, BAUM_ERR_CALLBACK,
 *           BAUM_ERR_NOT_FINITE */
BAUM_API baum_status baum_simulation_add_event(baum_simulation *simulation,
                                               const baum_event_def *def, int32_t *index);

/** An event that has happened. */
typedef struct baum_event_record {
  size_t struct_size; /**< Set by baum_simulation_event(). */
  double t;      /**< [s] time of the event; equal for events that cannot be separated in time. */
  int32_t event; /**< [-] number of the event, from baum_simulation_add_event(). */
  /** [-] 1: the event function or the joint coordinate rises in time; -1: it falls. */
  int32_t direction;
} baum_event_record;

/** Count the events that have happened since the run was created.
 *  @param simulation  may be NULL
 *  @return  0 for NULL */
BAUM_API int64_t baum_simulation_event_count(const baum_simulation *simulation);

/** Read an event that has happened. A run keeps the last 1024 events. If a run may have more
 *  events, read them while it is in progress.
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
