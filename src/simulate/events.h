/* SPDX-License-Identifier: BSD-3-Clause */
/* The events of a run. A run stores on which side of zero the value of each event is, and searches
 * for the times at which a value passes zero. */
#ifndef BAUM_I_SIMULATE_EVENTS_H
#define BAUM_I_SIMULATE_EVENTS_H

#include <baum/events.h>

#include "simulate/run.h"

enum { BAUM_I_EVENT_RECORDS = 1024 };

/* The state of one event at the time up to which the run has been searched. */
typedef struct baum_i_event_mark {
  double value; /* at a start its sign may still differ from `side`, because of rounding */
  double rate;  /* [1/s] rate of the value; used only if the value is a joint coordinate */
  double last;  /* [s] time at which the event was last recorded, or NaN if it never was */
  int32_t side; /* side of zero on which the value is: -1, 1, or 0 while it is exactly zero */
  /* Not 0: the value has not passed zero since the search started. If the value was zero when the
   * search started and leaves zero now, this is not an event. BAUM_I_BOUNCES: the search started at
   * a record of this event, with velocities that moved the value away from zero. */
  int32_t fresh;
} baum_i_event_mark;

enum { BAUM_I_BOUNCES = 2 };

typedef struct baum_i_event {
  baum_event_def def; /* this struct owns the string `name` of the definition */
  int joint;          /* the joint whose coordinate is the value of the event, or -1 */
  double next;        /* value in the state that was evaluated last */
  /* [1/s] rate of the value in the state for which it was last found; 0 if it is unknown, because
   * an event function depends on v or is not finite nearby */
  double rate;
  /* [s] time at which the value passes zero in the present interval, or NaN if it does not. */
  double found;
} baum_i_event;

struct baum_i_events {
  /* The members before `list` are plain numbers. They are part of a saved run. */
  int64_t recorded;
  double t;     /* [s] time up to which the motion has been searched */
  double begin; /* [s] time at which the search was last started */
  double from;  /* [s] start of the last step, for variable steps */

  baum_i_event *list;       /* (count) */
  baum_i_event_mark *marks; /* (count) */
  int count;
  double *memory;    /* memory of `look` */
  baum_i_state look; /* a state inside the present step */
  /* The last records: record k is stored at index k modulo the size of the array. */
  baum_event_record records[BAUM_I_EVENT_RECORDS];
};

void baum_i_events_destroy(baum_i_events *events);

/* How messages name an event. `name` may be NULL. */
baum_i_text baum_i_event_label(int number, const char *name);

/* The following functions may be called only if run->events is not NULL. */

/* Evaluate all events in a state and write their values to `next`. Returns BAUM_OK,
 * BAUM_ERR_CALLBACK or BAUM_ERR_NOT_FINITE. */
baum_status baum_i_events_evaluate(baum_simulation *run, const baum_i_state *state);

/* Set the rate of the value of event `number`, which has been evaluated in this state. */
baum_status baum_i_events_find_rate(baum_simulation *run, int number, const baum_i_state *state);

/* Evaluate all events in the state of a new start. Also finds the rates of the values. */
baum_status baum_i_events_evaluate_start(baum_simulation *run, const baum_i_state *state);

/* The same for the present state, from which the motion continues after its equations or its
 * direction have changed. Also finds the rates if nothing has moved since the last start. */
baum_status baum_i_events_evaluate_again(baum_simulation *run);

/* Start the search at the present state. begin() is for a new start, after
 * baum_i_events_evaluate_start(). go_on() is for a motion that continues, after
 * baum_i_events_evaluate_again(). */
void baum_i_events_begin(baum_simulation *run);
void baum_i_events_go_on(baum_simulation *run);

/* Continue the search at the present state, which is the far side of a break. Events whose value
 * has jumped through zero are recorded there. Overwrites the trial state. Returns the same as
 * baum_i_events_watch(). */
baum_status baum_i_events_pass_break(baum_simulation *run);

/* Search the motion for events up to the time `to`. With fixed steps, the trial state must be the
 * end of a step to `to`. If the search overwrites the trial state, it repeats this step at the end.
 * Returns BAUM_STOP_EVENT if an event has stopped the run, with the trial state at the event.
 * Otherwise returns BAUM_OK or a failure. */
baum_status baum_i_events_watch(baum_simulation *run, double to);

/* Tell whether event k was recorded a moment before the present state. */
bool baum_i_event_was_recorded(const baum_simulation *run, int k);

/* Store the value and the rate that were evaluated last. */
static inline void baum_i_event_keep(const baum_i_event *event, baum_i_event_mark *mark)
{
  mark->value = event->next;
  mark->rate = event->rate;
}

/* [s] After a start of the search or after the last record of the event, the value may still leave
 * zero. Return the time within which this is not recorded as another event. */
double baum_i_event_window(const baum_simulation *run, const baum_i_event *event, double t);

static inline int32_t baum_i_sign(double x)
{
  return x > 0.0 ? 1 : (x < 0.0 ? -1 : 0);
}

#endif
