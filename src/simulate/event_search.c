/* SPDX-License-Identifier: BSD-3-Clause */
/* Searches for events. The search is the same for all integrators (docs/theory/events.md). The
 * value of an event at time t is g(t). It is computed from the state that outputs would show at
 * this time. With variable steps, this state is the interpolant of the last step. If the
 * formulation includes projection, the interpolated state is projected. With fixed steps, this
 * state is the end of a shorter step from the same start.
 *
 * The sign of g is compared at the quarters of each step, at outputs, and at the end of the step.
 * At a quarter, g is first computed for an approximate state that costs little: the interpolant
 * without projection, or the cubic polynomial through both ends of the step. The accurate state is
 * computed only if g has changed its sign at the approximate state. Interpolants of successive
 * steps do not meet exactly. Therefore, the run stores on which side of zero the value of each
 * event is, from one check to the next and from one step to the next. Because of this, no event is
 * found twice, and none is lost.
 *
 * A joint coordinate may pass zero and return between two checks. Its rates are known at both
 * checks. If the cubic polynomial through both values and rates comes near zero, the search also
 * evaluates the value at the minimum of this polynomial.
 *
 * When g has different signs at two times, the secant method finds the zero between them. It uses
 * the weights of Dowell and Jarratt (BIT 11, 1971; "Illinois"). Every third iteration bisects the
 * interval instead. New times keep a distance of half the tolerance from both ends of the interval.
 * The search stops when the ends are one tolerance apart. The time of the event is the later end,
 * where g has already passed zero. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "mechanism/definition.h"
#include "simulate/events.h"
#include "simulate/hermite.h"

enum { QUARTERS = 4, MOST_TRIES = 300, MOST_LOOKS = 8 };

/* Two times count as equal if they differ by less than ROUNDINGS rounding errors, or by less
 * than SAME_TIME / rate, where rate is the rate of the motion [1/s]. */
static const double ROUNDINGS = 4.0;
static const double SAME_TIME = 1e-12;

/* An interval of time in which the value of an event passes zero. */
typedef struct bracket {
  double a, b; /* the ends of the interval: the run reaches a first, then b */
  /* The values at a and b, which have opposite signs. fa is 0 if a is a start at zero. The interval
   * is then bisected, because values near a may still be zero. */
  double fa, fb;
  enum { NOT_MOVED, BEFORE, AFTER } last_moved;
} bracket;

static bool is_before(const baum_simulation *run, double a, double b)
{
  return run->problem.direction * (b - a) > 0.0;
}

/* ---- states inside the step ---- */

/* Evaluate the cubic polynomial through both ends of a fixed step. */
static void follow_cubic(const baum_simulation *run, double t, baum_i_state *out)
{
  const baum_i_state *p = &run->state;
  const baum_i_state *n = &run->ahead;
  const baum_i_knot ends[2] = {{.t = p->t, .q = p->q, .v = p->v},
                               {.t = n->t, .q = n->q, .v = n->v}};
  baum_i_hermite(run->workspace->mechanism, ends, 2, t, out->q, out->v, run->workspace->work_q);
}

/* If a time is closer to the start of a step than this fraction of the step, the cubic polynomial
 * equals the motion up to rounding. It then replaces a step to this time, because some methods
 * divide by the length of the step. */
static const double SHORTEST = 1e-9;

static baum_status find_state_by_step(baum_simulation *run, double t)
{
  if (t == run->trial.t) {
    return BAUM_OK;
  }
  if (fabs(t - run->state.t) > SHORTEST * fabs(run->ahead.t - run->state.t)) {
    return baum_i_run_try_step(run, t, false);
  }
  follow_cubic(run, t, &run->trial);
  run->trial.t = t;
  return BAUM_OK;
}

/* Set the trial state to the state that outputs would show at time t. */
static baum_status find_state(baum_simulation *run, double t)
{
  if (baum_i_run_has_fixed_step(run)) {
    return find_state_by_step(run, t);
  }
  if (t == run->ahead.t) {
    baum_i_run_copy(run, &run->ahead, &run->trial);
    return BAUM_OK;
  }
  return baum_i_run_inside(run, t);
}

/* Set events->look to an approximation of the state at time t. This costs less than
 * find_state(). */
static baum_status glance(baum_simulation *run, double t)
{
  baum_i_state *look = &run->events->look;
  look->t = t;
  if (baum_i_run_has_fixed_step(run)) {
    follow_cubic(run, t, look);
    return BAUM_OK;
  }
  return run->integrator->interpolate(run->self, &run->problem, t, look->q, look->v);
}

/* Evaluate all events at time t, either exactly or for the state of glance(). */
static baum_status look(baum_simulation *run, double t, bool exact)
{
  BAUM_I_TRY(exact ? find_state(run, t) : glance(run, t));
  return baum_i_events_evaluate(run, exact ? &run->trial : &run->events->look);
}

static baum_status value_at(baum_simulation *run, double t)
{
  return look(run, t, true);
}

/* ---- one event ---- */

/* Tell whether the value of event k has not reached its side yet, but does not move away from it
 * either. This happens after a start at zero, because of rounding, or because the time at which the
 * event was last recorded is only as accurate as the tolerance of the event. It also happens while
 * a value stays exactly zero. */
static bool is_on_the_way(const baum_i_events *events, int k)
{
  const baum_i_event_mark *mark = &events->marks[k];
  double away = mark->fresh ? fabs(mark->value) : 0.0;
  return baum_i_sign(mark->value) != mark->side && fabs(events->list[k].next) <= away;
}

static bool has_passed(const baum_i_events *events, int k)
{
  int32_t side = events->marks[k].side;
  return side != 0 && baum_i_sign(events->list[k].next) != side && !is_on_the_way(events, k);
}

/* Return the direction in which the value of event k passes zero as time increases. The direction
 * refers to increasing time even if the run goes backward. */
static int32_t direction_of(const baum_simulation *run, int k)
{
  return run->events->marks[k].side * run->problem.direction < 0.0 ? 1 : -1;
}

static bool is_wanted(const baum_simulation *run, int k)
{
  int32_t wanted = run->events->list[k].def.direction;
  return wanted == 0 || wanted == direction_of(run, k);
}

static double tolerance_of(const baum_i_event *event, double t)
{
  double rounding = ROUNDINGS * DBL_EPSILON * fabs(t);
  return event->def.tolerance > rounding ? event->def.tolerance : rounding;
}

/* Choose the next time at which the value is evaluated. */
static double choose_time(const bracket *is, double tolerance, int try)
{
  double width = is->b - is->a;
  double x = is->a + width * is->fa / (is->fa - is->fb);
  double edge = copysign(0.5 * tolerance, width);
  if (try % 3 == 2 || is->fa == 0.0 || !(fabs(width) > 2.0 * fabs(edge))) {
    return is->a + 0.5 * width;
  }
  if ((x - is->a) * width < edge * width) {
    return is->a + edge;
  }
  return (is->b - x) * width < edge * width ? is->b - edge : x;
}

/* Replace one end of the interval by x. If x is before the event, it replaces a, otherwise b. If
 * the same end was also replaced in the last iteration, halve the value at the other end. This is
 * the Illinois method. */
static void narrow_bracket(bracket *is, double x, double value, bool before)
{
  double *moved[2] = {before ? &is->a : &is->b, before ? &is->fa : &is->fb};
  double *stays = before ? &is->fb : &is->fa;
  *moved[0] = x;
  *moved[1] = value;
  if (is->last_moved == (before ? BEFORE : AFTER)) {
    *stays *= 0.5;
  }
  is->last_moved = before ? BEFORE : AFTER;
}

/* Return the interval from events->t to t as a bracket. The value of event k passes zero in it. */
static bracket bracket_of(const baum_simulation *run, int k, double t)
{
  const baum_i_event_mark *mark = &run->events->marks[k];
  bool agrees = baum_i_sign(mark->value) == mark->side;
  return (bracket){
    .a = run->events->t, .b = t, .fa = agrees ? mark->value : 0.0, .fb = run->events->list[k].next};
}

/* Locate event k, which has passed zero between events->t and t. This changes `next` of all
 * events. */
static baum_status locate(baum_simulation *run, int k, double t)
{
  baum_i_event *event = &run->events->list[k];
  int32_t side = run->events->marks[k].side;
  bracket is = bracket_of(run, k, t);
  double tolerance = tolerance_of(event, fmax(fabs(is.a), fabs(is.b)));
  for (int try = 0; try < MOST_TRIES && fabs(is.b - is.a) > tolerance; try++) {
    double x = choose_time(&is, tolerance, try);
    if (x == is.a || x == is.b) {
      break;
    }
    BAUM_I_TRY(value_at(run, x));
    narrow_bracket(&is, x, event->next, baum_i_sign(event->next) == side);
  }
  event->found = is.b;
  return BAUM_OK;
}

/* ---- records ---- */

static void record_event(baum_simulation *run, int k, double t)
{
  baum_i_events *events = run->events;
  events->marks[k].last = t;
  events->records[events->recorded % BAUM_I_EVENT_RECORDS] =
    (baum_event_record){.t = t, .event = k, .direction = direction_of(run, k)};
  events->recorded++;
}

/* Tell whether the value of event k was zero when the search started and only leaves zero now. This
 * does not count as an event. */
static bool leaves_zero(const baum_simulation *run, int k)
{
  const baum_i_events *events = run->events;
  double since = fabs(events->list[k].found - events->begin);
  return events->marks[k].fresh &&
         since <= baum_i_event_window(run, &events->list[k], events->begin);
}

static void forget_found(baum_i_events *events)
{
  for (int k = 0; k < events->count; k++) {
    events->list[k].found = (double)NAN;
  }
}

static int first_found(const baum_simulation *run)
{
  const baum_i_events *events = run->events;
  int first = -1;
  for (int k = 0; k < events->count; k++) {
    double found = events->list[k].found;
    if (!isnan(found) && (first < 0 || is_before(run, found, events->list[first].found))) {
      first = k;
    }
  }
  return first;
}

/* Some events may happen at times that count as equal to the time of event `first`. Return the last
 * of these times. */
static double end_of_group(const baum_simulation *run, int first)
{
  const baum_i_events *events = run->events;
  double t = events->list[first].found;
  double same = fmax(SAME_TIME / run->problem.rate, 16.0 * DBL_EPSILON * fabs(t));
  double end = t;
  for (int k = 0; k < events->count; k++) {
    const baum_i_event *event = &events->list[k];
    double apart = fmax(same, fmin(tolerance_of(event, t), tolerance_of(&events->list[first], t)));
    if (fabs(event->found - t) <= apart && is_before(run, end, event->found)) {
      end = event->found;
    }
  }
  return end;
}

/* Record all events that happen up to the time `end`. Each is recorded with the time `end`. If a
 * terminal event is among them, return its index, otherwise -1. */
static int record_group(baum_simulation *run, double end)
{
  baum_i_events *events = run->events;
  int terminal = -1;
  for (int k = 0; k < events->count; k++) {
    baum_i_event *event = &events->list[k];
    if (isnan(event->found) || is_before(run, end, event->found)) {
      continue;
    }
    if (!leaves_zero(run, k)) {
      record_event(run, k, end);
      terminal = event->def.terminal && terminal < 0 ? k : terminal;
    }
    events->marks[k].side = -events->marks[k].side;
    events->marks[k].fresh = 0;
    event->found = (double)NAN;
  }
  return terminal;
}

/* ---- a part of a step ---- */

/* Keep the values at the time t, at which the run stops. A value may have passed zero before t
 * although its event has not been recorded. Either the event is not wanted, or it was located later
 * than t because of its tolerance. In the second case, record the event now. */
static void keep_values_at_stop(baum_simulation *run, double t)
{
  baum_i_events *events = run->events;
  events->t = t;
  for (int k = 0; k < events->count; k++) {
    baum_i_event_mark *mark = &events->marks[k];
    bool waits = !isnan(events->list[k].found);
    if (has_passed(events, k) && (waits || !is_wanted(run, k))) {
      if (waits && !leaves_zero(run, k)) {
        record_event(run, k, t);
      }
      mark->side = -mark->side;
      mark->fresh = 0;
    }
    baum_i_event_keep(&events->list[k], mark);
  }
}

static baum_status stop_at(baum_simulation *run, int terminal, double t)
{
  baum_i_events *events = run->events;
  BAUM_I_TRY(value_at(run, t));
  keep_values_at_stop(run, t);
  const char *name = events->list[terminal].def.name;
  bool rises = events->marks[terminal].side * run->problem.direction > 0.0;
  return baum_i_fail(BAUM_STOP_EVENT, "t = %.9g s: %s, %s", t,
                     baum_i_event_label(terminal, name).text, rises ? "rising" : "falling");
}

static baum_status fail_bounce(const baum_simulation *run, int k, bool soon)
{
  const char *name = run->events->list[k].def.name;
  const char *when = soon ? "so soon that the computed velocities have the wrong sign" : "at once";
  return baum_i_fail(BAUM_ERR_STEP,
                     "t = %.9g s: %s happens again %s; if a body bounces off a stop, let it rest "
                     "there once it is slow",
                     run->events->begin, baum_i_event_label(k, name).text, when);
}

/* Fail in two cases. First, a terminal event that happens again at once cannot be distinguished
 * from rounding errors. If it were ignored, a body that bounces faster and faster would fall
 * through its stop. Second, if the flight between two bounces is too short for the method, the
 * computed velocity at its end may point away from the stop. A program that reverses this velocity
 * would then push the body through the stop. */
static baum_status check_bounce(baum_simulation *run, int k)
{
  const baum_i_event *event = &run->events->list[k];
  const baum_i_event_mark *mark = &run->events->marks[k];
  if (!event->def.terminal || mark->fresh != BAUM_I_BOUNCES) {
    return BAUM_OK;
  }
  if (leaves_zero(run, k)) {
    return fail_bounce(run, k, false);
  }
  BAUM_I_TRY(value_at(run, event->found));
  BAUM_I_TRY(baum_i_events_find_rate(run, k, &run->trial));
  return event->rate * run->problem.direction * mark->side < 0.0 ? BAUM_OK
                                                                 : fail_bounce(run, k, true);
}

/* Record the events that were found, in the order of their times. At the first terminal event, stop
 * the run. */
static baum_status deliver_events(baum_simulation *run)
{
  for (int first = first_found(run); first >= 0; first = first_found(run)) {
    BAUM_I_TRY(check_bounce(run, first));
    double end = end_of_group(run, first);
    int terminal = record_group(run, end);
    if (terminal >= 0) {
      return stop_at(run, terminal, end);
    }
  }
  return BAUM_OK;
}

/* Tell whether the value of any event has passed to the other side of zero. If `leaving` is true, a
 * value that leaves zero also counts. */
static bool any_has_passed(const baum_i_events *events, bool leaving)
{
  bool any = false;
  for (int k = 0; k < events->count; k++) {
    any = any || has_passed(events, k) ||
          (leaving && events->marks[k].side == 0 && events->list[k].next != 0.0);
  }
  return any;
}

/* The values at time t are known. Locate all events whose value has passed zero before t.
 * Afterwards `next` again contains the values at time t. */
static baum_status locate_all(baum_simulation *run, double t)
{
  baum_i_events *events = run->events;
  forget_found(events);
  for (int k = 0; k < events->count; k++) {
    if (has_passed(events, k) && is_wanted(run, k)) {
      BAUM_I_TRY(locate(run, k, t));
      BAUM_I_TRY(value_at(run, t));
    }
  }
  return BAUM_OK;
}

/* Store the values and the sides of zero at time t. */
static void keep_values(baum_i_events *events, double t)
{
  events->t = t;
  for (int k = 0; k < events->count; k++) {
    baum_i_event_mark *mark = &events->marks[k];
    bool stays = mark->fresh && is_on_the_way(events, k);
    mark->fresh = has_passed(events, k) ? 0 : mark->fresh;
    baum_i_event_keep(&events->list[k], mark);
    mark->side = stays ? mark->side : baum_i_sign(mark->value);
  }
}

/* Search for events between events->t and t, where the values are known. `exact` tells whether they
 * are the values of the motion and not of an approximation. */
static baum_status settle(baum_simulation *run, double t, bool exact)
{
  baum_i_events *events = run->events;
  if (!exact && any_has_passed(events, true)) {
    BAUM_I_TRY(value_at(run, t));
  }
  if (any_has_passed(events, false)) {
    BAUM_I_TRY(locate_all(run, t));
    BAUM_I_TRY(deliver_events(run));
  }
  keep_values(events, t);
  return BAUM_OK;
}

/* ---- dips ---- */

/* One end of an interval in which the value of an event may dip through zero. The value and its
 * rate are multiplied by the side, so that the value is positive before it passes zero. */
typedef struct dip_end {
  double t, value, rate;
} dip_end;

static dip_end dip_end_of(double t, double value, double rate, int32_t side)
{
  return (dip_end){.t = t, .value = side * value, .rate = side * rate};
}

/* Find the minimum of the cubic polynomial through the values and rates of both ends. Return false
 * if there is none between them, or if it is far from zero: from the lower end, the polynomial
 * would have to fall at least twice as far to reach zero. */
static bool find_lowest(const dip_end *a, const dip_end *b, double *t)
{
  double width = b->t - a->t;
  double first = a->rate * width;
  double last = b->rate * width;
  double lower = fmin(a->value, b->value);
  if (!(lower > 0.0 && first < 0.0 && last > 0.0)) {
    return false;
  }
  /* a->value + first x + m x^2 + n/3 x^3, where x is 0 at a and 1 at b */
  double rise = b->value - a->value;
  double m = 3.0 * rise - 2.0 * first - last;
  double n = 3.0 * (first + last - 2.0 * rise);
  double root = sqrt(fmax(m * m - n * first, 0.0));
  double x = m > 0.0 ? -first / (m + root) : (root - m) / n;
  double lowest = a->value + x * (first + x * (m + x * n / 3.0));
  double found = a->t + x * width;
  if (!(lowest < lower - lowest) || found == a->t || found == b->t) {
    return false;
  }
  *t = found;
  return true;
}

/* The values at time t are known. The value of event k may be on the same side of zero at events->t
 * and at t, but have passed zero in between. If so, set *dip to a time at which the value has
 * passed zero, unless *dip is already earlier. */
static baum_status follow_dip(baum_simulation *run, int k, double t, bool exact, double *dip)
{
  const baum_i_event *event = &run->events->list[k];
  const baum_i_event_mark *mark = &run->events->marks[k];
  dip_end a = dip_end_of(run->events->t, mark->value, mark->rate, mark->side);
  dip_end b = dip_end_of(t, event->next, event->rate, mark->side);
  double x = t;
  bool passed = false;
  for (int try = 0; try < MOST_LOOKS && !passed && find_lowest(&a, &b, &x); try++) {
    BAUM_I_TRY(value_at(run, x));
    dip_end found = dip_end_of(x, event->next, event->rate, mark->side);
    passed = has_passed(run->events, k);
    *(found.rate * (t - x) < 0.0 ? &a : &b) = found;
  }
  *dip = passed && is_before(run, x, *dip) ? x : *dip;
  return x == t ? BAUM_OK : look(run, t, exact);
}

/* The values at time t are known. Return in *dip the earliest time at which the value of an event
 * is found to dip through zero between events->t and t, or t if there is none. Only joint
 * coordinates have known rates. */
static baum_status find_dip(baum_simulation *run, double t, bool exact, double *dip)
{
  *dip = t;
  for (int k = 0; k < run->events->count; k++) {
    const baum_i_event *event = &run->events->list[k];
    if (event->joint >= 0 && event->rate * run->events->marks[k].rate < 0.0) {
      BAUM_I_TRY(follow_dip(run, k, t, exact, dip));
    }
  }
  return BAUM_OK;
}

/* ---- the whole ---- */

/* Search for events between events->t and t. First search up to each dip before t, because the
 * values at t do not show a dip. */
static baum_status search_until(baum_simulation *run, double t, bool exact)
{
  exact = exact || t == (baum_i_run_has_fixed_step(run) ? run->trial.t : run->ahead.t);
  for (;;) {
    double dip = t;
    BAUM_I_TRY(look(run, t, exact));
    BAUM_I_TRY(find_dip(run, t, exact, &dip));
    if (dip == t) {
      return settle(run, t, exact);
    }
    BAUM_I_TRY(value_at(run, dip));
    BAUM_I_TRY(settle(run, dip, true));
  }
}

baum_status baum_i_events_watch(baum_simulation *run, double to)
{
  baum_i_events *events = run->events;
  bool fixed = baum_i_run_has_fixed_step(run);
  double from = fixed ? run->state.t : events->from;
  double end = fixed ? to : run->ahead.t;
  if (fixed) {
    baum_i_run_copy(run, &run->trial, &run->ahead);
  }
  for (int k = 1; k < QUARTERS; k++) {
    double t = from + k * (end - from) / QUARTERS;
    if (is_before(run, events->t, t) && is_before(run, t, to)) {
      BAUM_I_TRY(search_until(run, t, false));
    }
  }
  if (is_before(run, events->t, to)) {
    BAUM_I_TRY(search_until(run, to, true));
  }
  return fixed ? find_state(run, to) : BAUM_OK;
}

baum_status baum_i_events_pass_break(baum_simulation *run)
{
  baum_i_events *events = run->events;
  events->t = events->from = run->state.t;
  baum_i_run_copy(run, &run->state, &run->trial);
  baum_i_run_copy(run, &run->state, &run->ahead);
  baum_status status = search_until(run, run->state.t, true);
  /* An event that has just been recorded may seem to happen again; see baum_i_events_go_on(). */
  bool any = false;
  for (int k = 0; k < events->count; k++) {
    any = any || (!events->marks[k].fresh && baum_i_event_was_recorded(run, k));
  }
  for (int k = 0; k < events->count && any; k++) {
    events->marks[k].fresh = baum_i_event_was_recorded(run, k);
  }
  events->begin = any ? run->state.t : events->begin;
  return status;
}
