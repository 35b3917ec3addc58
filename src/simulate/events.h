/* SPDX-License-Identifier: BSD-3-Clause */
/* Events of a run: which side of zero each is on, and the search for the times at which they pass
 * it. */
#ifndef BAUM_I_SIMULATE_EVENTS_H
#define BAUM_I_SIMULATE_EVENTS_H

#include <baum/events.h>

#include "simulate/run.h"

enum { BAUM_I_EVENT_RECORDS = 1024 };

/* State of an event at the time up to which the run has been searched. */
typedef struct baum_i_event_mark {
  double value;
  double last;   /* [s] time of its last record, NaN: none */
  int32_t side;  /* side of zero: -1, 1, or 0 if the value has always been zero */
  int32_t fresh; /* 1: has not passed zero since the start, so leaving zero is no event yet */
} baum_i_event_mark;

typedef struct baum_i_event {
  baum_event_def def; /* with a copy of its name */
  int joint;          /* of its coordinate, or -1 */
  double next;        /* value at the state evaluated last */
  double found;       /* time at which it passes zero in the present interval; NaN: it does not */
} baum_i_event;

struct baum_i_events {
  /* Plain numbers up to `list`, which are saved. */
  int64_t recorded;
  double t;     /* searched up to here */
  double begin; /* time at which new events began */
  double from;  /* variable step: start of the last step */

  baum_i_event *list;       /* (count) */
  baum_i_event_mark *marks; /* (count) */
  int count;
  double *memory;                                  /* memory of `look` */
  baum_i_state look;                               /* a state between */
  baum_event_record records[BAUM_I_EVENT_RECORDS]; /* the last ones, number k at k mod its size */
};

void baum_i_events_destroy(baum_i_events *events);

/* Call the following functions only if run->events is not NULL. */

/* Evaluate all events at a state, into next. BAUM_OK, BAUM_ERR_CALLBACK, BAUM_ERR_NOT_FINITE. */
baum_status baum_i_events_evaluate(baum_simulation *run, const baum_i_state *state);

/* Start at the present state, whose values have just been evaluated: begin() for a start, which may
 * be at the present place with other velocities, go_on() for a motion that continues in another
 * way. */
void baum_i_events_begin(baum_simulation *run);
void baum_i_events_go_on(baum_simulation *run);

/* Search the motion up to time `to`. Fixed step: the trial state is the end of a step to there,
 * which is repeated if the trial state was needed for other times. BAUM_OK; BAUM_STOP_EVENT, and
 * the trial state is at the event; or a failure. */
baum_status baum_i_events_watch(baum_simulation *run, double to);

/* [s] Closer times count as equal, when an event leaves zero and at the start. */
double baum_i_event_window(const baum_simulation *run, const baum_i_event *event, double t);

static inline int32_t baum_i_sign(double x)
{
  return x > 0.0 ? 1 : (x < 0.0 ? -1 : 0);
}

#endif
