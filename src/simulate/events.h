/* SPDX-License-Identifier: BSD-3-Clause */
/* Events of a run: on which side of zero the value of each event is, and the search for the times
 * at which it passes zero. */
#ifndef BAUM_I_SIMULATE_EVENTS_H
#define BAUM_I_SIMULATE_EVENTS_H

#include <baum/events.h>

#include "simulate/run.h"

enum { BAUM_I_EVENT_RECORDS = 1024 };

/* State of an event at the time up to which the run has been searched. */
typedef struct baum_i_event_mark {
  double value;
  double last;   /* [s] time of its last record; NaN: none */
  int32_t side;  /* side of zero: -1, 1, or 0 while the value is exactly zero */
  int32_t fresh; /* 1: value has not passed zero since the start, so leaving zero is not an event */
} baum_i_event_mark;

typedef struct baum_i_event {
  baum_event_def def; /* owns its `name` */
  int joint;          /* joint whose coordinate is the value, or -1 */
  double next;        /* value at the state evaluated last */
  double found;       /* time at which it passes zero in the present interval; NaN: none */
} baum_i_event;

struct baum_i_events {
  /* The members before `list` are plain numbers, which are saved. */
  int64_t recorded;
  double t;     /* the motion has been searched up to t */
  double begin; /* time of the last start of the search */
  double from;  /* variable step: start of the last step */

  baum_i_event *list;       /* (count) */
  baum_i_event_mark *marks; /* (count) */
  int count;
  double *memory;                                  /* memory of `look` */
  baum_i_state look;                               /* a state inside the present step */
  baum_event_record records[BAUM_I_EVENT_RECORDS]; /* the last records; record k is at k mod size */
};

void baum_i_events_destroy(baum_i_events *events);

/* Call the following functions only if run->events is not NULL. */

/* Evaluate all events at a state and write the values to `next`. Returns BAUM_OK, BAUM_ERR_CALLBACK
 * or BAUM_ERR_NOT_FINITE. */
baum_status baum_i_events_evaluate(baum_simulation *run, const baum_i_state *state);

/* Start the search at the present state, whose values have just been evaluated. begin() is for a
 * new start, go_on() for a motion that continues after a change of equations or direction. */
void baum_i_events_begin(baum_simulation *run);
void baum_i_events_go_on(baum_simulation *run);

/* Search the motion up to time `to`. Fixed step: the trial state is the end of a step to `to`; if
 * the search has used the trial state, the step is repeated. Returns BAUM_OK, BAUM_STOP_EVENT with
 * the trial state at the event, or a failure. */
baum_status baum_i_events_watch(baum_simulation *run, double to);

/* [s] Return the time after a start of the search, or after the last record of the event, within
 * which the event may leave zero without being recorded again. */
double baum_i_event_window(const baum_simulation *run, const baum_i_event *event, double t);

static inline int32_t baum_i_sign(double x)
{
  return x > 0.0 ? 1 : (x < 0.0 ? -1 : 0);
}

#endif
