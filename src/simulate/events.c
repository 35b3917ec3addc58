/* SPDX-License-Identifier: BSD-3-Clause */
/* Manages the events of a run: their definitions, their values, the start of the search, and the
 * records. The search itself is in event_search.c. */
#include "simulate/events.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/sized.h"
#include "base/text.h"
#include "dynamics/dynamics.h"
#include "mechanism/definition.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/manifold.h"

/* ---- definition ---- */

static const baum_event_def defaults = {
  .struct_size = sizeof(baum_event_def),
  .terminal = true,
  .tolerance = BAUM_I_NOT_GIVEN,
};

void baum_event_def_init(baum_event_def *def, size_t caller_size)
{
  baum_i_give_sized(def, caller_size, &defaults, sizeof defaults);
}

static baum_status check_source(const baum_mechanism *m, const baum_event_def *def,
                                const char *label)
{
  bool of_joint = def->joint.index1 != 0;
  if (of_joint == (def->function != NULL)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: %s; give one of them", label,
                       of_joint ? "function() and joint are both given"
                                : "neither function() nor joint is given");
  }
  static const baum_i_coordinate_fields fields = {"joint", "coordinate", "to pass a value"};
  return of_joint ? baum_i_check_coordinate(m, def->joint, def->coordinate, label, &fields)
                  : BAUM_OK;
}

static baum_status check_definition(const baum_mechanism *m, const baum_event_def *def,
                                    const char *label)
{
  BAUM_I_TRY(check_source(m, def, label));
  BAUM_I_TRY(baum_i_check_finite(label, "value", "rad or m", def->value));
  if (def->direction < -1 || def->direction > 1) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: direction is %d, must be -1, 0 or 1", label,
                       (int)def->direction);
  }
  return !isnan(def->tolerance) ? baum_i_check_positive(label, "tolerance", "s", def->tolerance)
                                : BAUM_OK;
}

baum_i_text baum_i_event_label(int number, const char *name)
{
  return name ? baum_i_text_of("event %d \"%.60s\"", number, name)
              : baum_i_text_of("event %d", number);
}

/* ---- life ---- */

static baum_status create_events(baum_simulation *run)
{
  const baum_mechanism *m = run->workspace->mechanism;
  baum_i_events *events = baum_i_alloc(1, sizeof *events);
  BAUM_I_TRY(baum_i_check_memory(events));
  events->memory = baum_i_alloc((size_t)m->nq + (size_t)m->nv, sizeof *events->memory);
  if (!events->memory) {
    baum_i_events_destroy(events);
    return baum_i_fail_memory();
  }
  events->look = (baum_i_state){.q = events->memory, .v = events->memory + m->nq};
  events->t = run->state.t;
  events->begin = run->state.t;
  events->from = run->state.t;
  run->events = events;
  return BAUM_OK;
}

void baum_i_events_destroy(baum_i_events *events)
{
  if (events) {
    for (int k = 0; k < events->count; k++) {
      baum_i_free(events->list[k].def.name);
    }
    baum_i_free(events->list);
    baum_i_free(events->marks);
    baum_i_free(events->memory);
    baum_i_free(events);
  }
}

/* Allocate memory for one more event and copy its name. The number of events does not change
 * yet. */
static baum_status make_room(baum_i_events *events, const baum_event_def *def)
{
  assert(events);
  size_t count = (size_t)events->count + 1;
  baum_i_event *list = baum_i_grow(events->list, count, sizeof *list);
  BAUM_I_TRY(baum_i_check_memory(list));
  events->list = list;
  baum_i_event_mark *marks = baum_i_grow(events->marks, count, sizeof *marks);
  BAUM_I_TRY(baum_i_check_memory(marks));
  events->marks = marks;
  baum_i_event *event = &list[count - 1];
  *event = (baum_i_event){.def = *def, .joint = -1, .found = (double)NAN};
  event->def.name = def->name ? baum_i_copy_text(def->name) : NULL;
  return def->name && !event->def.name ? baum_i_fail_memory() : BAUM_OK;
}

/* ---- values ---- */

static baum_status fail_value(const baum_simulation *run, int number, int answer, double value,
                              double t)
{
  const baum_event_def *def = &run->events->list[number].def;
  const baum_i_text label = baum_i_event_label(number, def->name);
  if (answer != 0) {
    return baum_i_fail(BAUM_ERR_CALLBACK, "t = %.9g s: %s: function() returned %d (%s)", t,
                       label.text, answer,
                       answer > 0 ? "retry, but events cannot ask for a smaller step" : "stop");
  }
  return baum_i_fail(BAUM_ERR_NOT_FINITE, "t = %.9g s: %s: its value is %g", t, label.text, value);
}

static baum_status evaluate_one(baum_simulation *run, int number, const baum_i_state *state)
{
  baum_workspace *w = run->workspace;
  baum_i_event *event = &run->events->list[number];
  const baum_event_def *def = &event->def;
  int answer = 0;
  event->next = 0.0;
  if (event->joint >= 0) {
    const baum_i_joint_coordinate of =
      baum_i_joint_coordinate_of(w->mechanism, def->joint, def->coordinate);
    baum_i_coordinate coordinate;
    baum_i_coordinate_at(&of, &w->point, &coordinate);
    event->next = coordinate.value - def->value;
    event->rate = coordinate.rate;
  } else {
    w->point.asking = true;
    answer = def->function(state->t, state->q, state->v, w->point.inputs, &event->next, def->user);
    w->point.asking = false;
  }
  bool fine = answer == 0 && isfinite(event->next);
  return fine ? BAUM_OK : fail_value(run, number, answer, event->next, state->t);
}

baum_status baum_i_events_evaluate(baum_simulation *run, const baum_i_state *state)
{
  baum_i_point_set(&run->workspace->point, state->t, state->q, state->v);
  for (int k = 0; k < run->events->count; k++) {
    BAUM_I_TRY(evaluate_one(run, k, state));
  }
  return BAUM_OK;
}

/* ---- start of the search ---- */

/* Times count as equal if they differ by less than this fraction of 1/rate. This applies to methods
 * that start exactly at the given state. */
static const double NO_TIME = 1e-10;
/* Values of joint coordinates are rounded by less than this fraction. */
static const double ROUNDING = 16.0 * DBL_EPSILON;

double baum_i_event_window(const baum_simulation *run, const baum_i_event *event, double t)
{
  const baum_i_problem *p = &run->problem;
  double share = run->integrator->solves_residuals && p->rtol > 0.0 ? 10.0 * p->rtol : NO_TIME;
  double window = fmax(share / p->rate, 16.0 * DBL_EPSILON * fabs(t));
  return event->def.tolerance > window ? event->def.tolerance : window;
}

bool baum_i_event_was_recorded(const baum_simulation *run, int k)
{
  double since = fabs(run->state.t - run->events->marks[k].last);
  return since <= baum_i_event_window(run, &run->events->list[k], run->state.t);
}

/* The rate of an event function is a difference over this fraction of 1/rate. */
static const double APART = 1e-5;

/* Evaluate an event function at the state that a motion with constant velocities reaches after a
 * time h. */
static baum_status look_ahead(baum_simulation *run, int number, const baum_i_state *state, double h)
{
  const baum_mechanism *m = run->workspace->mechanism;
  baum_i_state *look = &run->events->look;
  look->t = state->t + h;
  memcpy(look->q, state->q, (size_t)m->nq * sizeof *look->q);
  memcpy(look->v, state->v, (size_t)m->nv * sizeof *look->v);
  baum_i_move(m, h, state->v, look->q);
  return evaluate_one(run, number, look);
}

/* Tell whether the value of an event function changes if the velocities are varied. Velocities that
 * are not 0 do not become 0, because the function may divide by a velocity. */
static baum_status vary_velocities(baum_simulation *run, int number, const baum_i_state *state,
                                   bool *matter)
{
  const baum_mechanism *m = run->workspace->mechanism;
  baum_i_event *event = &run->events->list[number];
  baum_i_state *look = &run->events->look;
  double value = event->next;
  look->t = state->t;
  memcpy(look->q, state->q, (size_t)m->nq * sizeof *look->q);
  for (int i = 0; i < m->nv; i++) {
    look->v[i] = state->v[i] * (1.0 - 0.5 * (i + 1) / (m->nv + 1));
  }
  BAUM_I_TRY(evaluate_one(run, number, look));
  *matter = event->next != value;
  return BAUM_OK;
}

/* Difference an event function along v, to second order. The difference is so wide that the
 * rounding of q does not matter. */
static baum_status difference(baum_simulation *run, int number, const baum_i_state *state)
{
  baum_i_event *event = &run->events->list[number];
  double speed = baum_i_scaled_size(run->workspace->mechanism, state->v);
  double h = run->problem.direction *
             (APART / fmax(run->problem.rate, speed) + DBL_EPSILON / APART * fabs(state->t));
  double value = event->next;
  bool depends_on_v = false;
  BAUM_I_TRY(vary_velocities(run, number, state, &depends_on_v));
  BAUM_I_TRY(look_ahead(run, number, state, h));
  double first = event->next - value;
  BAUM_I_TRY(look_ahead(run, number, state, 2.0 * h));
  double second = event->next - value;
  event->rate = depends_on_v ? 0.0 : (4.0 * first - second) / (2.0 * h);
  return BAUM_OK;
}

/* The value was finite at the present state. If it is not finite near this state, the rate counts
 * as unknown, because the run may never get there. */
baum_status baum_i_events_find_rate(baum_simulation *run, int number, const baum_i_state *state)
{
  baum_i_event *event = &run->events->list[number];
  if (event->joint >= 0) {
    return BAUM_OK;
  }
  double value = event->next;
  event->rate = 0.0;
  baum_i_kept_message kept = baum_i_message_keep();
  baum_status status = difference(run, number, state);
  event->next = value;
  return baum_i_message_settle(status == BAUM_ERR_NOT_FINITE ? BAUM_OK : status, &kept);
}

baum_status baum_i_events_evaluate_start(baum_simulation *run, const baum_i_state *state)
{
  BAUM_I_TRY(baum_i_events_evaluate(run, state));
  for (int k = 0; k < run->events->count; k++) {
    BAUM_I_TRY(baum_i_events_find_rate(run, k, state));
  }
  return BAUM_OK;
}

/* Tell whether nothing has moved since the search for event k started. */
static bool is_at_start(const baum_i_events *events, int k)
{
  return events->marks[k].fresh && events->t == events->begin;
}

baum_status baum_i_events_evaluate_again(baum_simulation *run)
{
  BAUM_I_TRY(baum_i_events_evaluate(run, &run->state));
  for (int k = 0; k < run->events->count; k++) {
    BAUM_I_TRY(is_at_start(run->events, k) ? baum_i_events_find_rate(run, k, &run->state)
                                           : BAUM_OK);
  }
  return BAUM_OK;
}

/* If the value of an event is zero at a start, except for rounding, the side of the event is the
 * side to which the value moves. The run then also finds the event if the value returns to zero
 * within the first part of a step, for example because a body bounces off a stop. `recorded` is the
 * value at which this event has just been recorded, or NaN. */
static void take_side_of_motion(baum_simulation *run, int number, double recorded)
{
  baum_i_event_mark *mark = &run->events->marks[number];
  const baum_i_event *event = &run->events->list[number];
  double h = run->problem.direction * baum_i_event_window(run, event, run->state.t);
  double change = event->rate * h;
  double rounding = 2.0 * fabs(recorded) + ROUNDING * fabs(event->def.value);
  if (fabs(mark->value) <= fmax(fabs(change), rounding)) {
    mark->side = baum_i_sign(change);
    mark->fresh = mark->side != 0 && !isnan(recorded) ? BAUM_I_BOUNCES : mark->fresh;
  }
}

/* Start the search for event k at the present state, with its value there. */
static void take_value(baum_simulation *run, int k, bool is_start)
{
  baum_i_event_mark *mark = &run->events->marks[k];
  bool recorded = baum_i_event_was_recorded(run, k);
  double value_then = recorded ? mark->value : (double)NAN;
  baum_i_event_keep(&run->events->list[k], mark);
  mark->side = mark->value == 0.0 && !is_start ? mark->side : baum_i_sign(mark->value);
  mark->fresh = is_start || recorded;
  if (is_start) {
    take_side_of_motion(run, k, value_then);
  }
}

/* If nothing has moved since the last start, the present state also counts as a start. */
static void take_values(baum_simulation *run, bool is_start)
{
  baum_i_events *events = run->events;
  for (int k = 0; k < events->count; k++) {
    take_value(run, k, is_start || is_at_start(events, k));
  }
  events->t = events->begin = events->from = run->state.t;
}

void baum_i_events_begin(baum_simulation *run)
{
  take_values(run, true);
}

/* An event that has just been recorded may seem to happen again at once. This is so if a method
 * restarts from a slightly different state, or if the run changes its direction. It then counts as
 * an event that leaves zero, which is not recorded. */
void baum_i_events_go_on(baum_simulation *run)
{
  take_values(run, false);
}

static baum_status begin_last(baum_simulation *run)
{
  baum_i_events *events = run->events;
  assert(events);
  int k = events->count;
  baum_i_event *event = &events->list[k];
  const baum_mechanism *m = run->workspace->mechanism;
  event->joint = event->def.joint.index1 != 0 ? baum_i_joint_index(m, event->def.joint) : -1;
  baum_i_point_set(&run->workspace->point, run->state.t, run->state.q, run->state.v);
  baum_status status = evaluate_one(run, k, &run->state);
  status = status == BAUM_OK ? baum_i_events_find_rate(run, k, &run->state) : status;
  if (status != BAUM_OK) {
    baum_i_free(event->def.name);
    return status;
  }
  events->marks[k] =
    (baum_i_event_mark){.last = (double)NAN, .side = baum_i_sign(event->next), .fresh = 1};
  baum_i_event_keep(event, &events->marks[k]);
  events->count++;
  take_side_of_motion(run, k, (double)NAN);
  return BAUM_OK;
}

/* ---- public ---- */

baum_status baum_simulation_add_event(baum_simulation *simulation, const baum_event_def *def,
                                      int32_t *index)
{
  const char *call = "baum_simulation_add_event";
  BAUM_I_TRY(baum_i_run_may_be_changed(simulation, call));
  BAUM_I_TRY(baum_i_check_given(call, "the definition", def != NULL));
  baum_event_def given = baum_event_def_default();
  BAUM_I_TRY(baum_i_take_sized(&given, sizeof given, def, call, " of the definition",
                               "baum_event_def_default()"));
  int number = simulation->events ? simulation->events->count : 0;
  BAUM_I_TRY(baum_i_check_name("event", number, given.name));
  BAUM_I_TRY(check_definition(simulation->workspace->mechanism, &given,
                              baum_i_event_label(number, given.name).text));
  if (!simulation->events) {
    BAUM_I_TRY(create_events(simulation));
  }
  baum_status status = make_room(simulation->events, &given);
  if (status == BAUM_OK) {
    status = begin_last(simulation);
  }
  if (status != BAUM_OK && number == 0) { /* a run without events needs no memory for events */
    baum_i_events_destroy(simulation->events);
    simulation->events = NULL;
  }
  if (status == BAUM_OK && index) {
    *index = number;
  }
  return status;
}

int64_t baum_simulation_event_count(const baum_simulation *simulation)
{
  return simulation && simulation->events ? simulation->events->recorded : 0;
}

baum_status baum_simulation_event(const baum_simulation *simulation, int64_t k,
                                  baum_event_record *out, size_t caller_size)
{
  const char *call = "baum_simulation_event";
  BAUM_I_TRY(baum_i_run_check_out(simulation, out, caller_size, call));
  int64_t count = baum_simulation_event_count(simulation);
  int64_t first = count > BAUM_I_EVENT_RECORDS ? count - BAUM_I_EVENT_RECORDS : 0;
  BAUM_I_TRY(baum_i_check_entry(k, first, count, call));
  const baum_event_record *record = &simulation->events->records[k % BAUM_I_EVENT_RECORDS];
  baum_i_give_sized(out, caller_size, record, sizeof *record);
  return BAUM_OK;
}
