/* SPDX-License-Identifier: BSD-3-Clause */
/* The list of what is saved; see saved.h. */
#include "simulate/saved.h"

#include <assert.h>
#include <string.h>

#include "base/alloc.h"
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/crossing.h"
#include "simulate/events.h"

/* ---- parts ---- */

static baum_i_saved_part *add(baum_i_saved *list, const char *name, baum_i_saved_kind kind)
{
  assert(list->count < BAUM_I_SAVED_PARTS);
  baum_i_saved_part *part = &list->parts[list->count++];
  *part = (baum_i_saved_part){.name = name, .kind = kind};
  return part;
}

void baum_i_saved_add(baum_i_saved *list, const char *name, void *place, size_t size)
{
  baum_i_saved_part *part = add(list, name, BAUM_I_SAVED_STATE);
  part->place = place;
  part->size = size;
}

void baum_i_saved_add_bounded(baum_i_saved *list, const char *name, void *place, size_t size,
                              int64_t least, int64_t most)
{
  baum_i_saved_part *part = add(list, name, BAUM_I_SAVED_BOUNDED);
  part->place = place;
  part->size = size;
  part->least = least;
  part->most = most;
}

void baum_i_saved_add_some(baum_i_saved *list, const char *name, void *place, size_t unit,
                           int64_t count, int64_t most)
{
  baum_i_saved_part *part = add(list, name, BAUM_I_SAVED_SOME);
  part->place = place;
  part->unit = unit;
  part->size = (size_t)most * unit;
  part->used = (size_t)(count < most ? count : most) * unit;
}

static void add_array(baum_i_saved *list, const char *name, double *values, int count)
{
  baum_i_saved_add(list, name, values, (size_t)count * sizeof *values);
}

/* Those that must agree. */

static void add_number(baum_i_saved *list, const char *name, double value)
{
  baum_i_saved_part *part = add(list, name, BAUM_I_SAVED_NUMBER);
  part->number = value;
  part->size = sizeof value;
}

void baum_i_saved_compare(baum_i_saved *list, const char *name, int64_t value)
{
  baum_i_saved_part *part = add(list, name, BAUM_I_SAVED_INTEGER);
  part->integer = value;
  part->size = sizeof value;
}

static void add_text(baum_i_saved *list, const char *name, const char *text)
{
  baum_i_saved_part *part = add(list, name, BAUM_I_SAVED_TEXT_OF);
  part->place = baum_i_mutable(text);
  part->size = BAUM_I_SAVED_TEXT;
}

static void add_choice(baum_i_saved *list, const char *name, const void *bytes, size_t size)
{
  baum_i_saved_part *part = add(list, name, BAUM_I_SAVED_CHOICE);
  part->place = baum_i_mutable(bytes);
  part->size = size;
}

/* ---- what must agree ---- */

static void list_options(const baum_simulation *run, baum_i_saved *list)
{
  const baum_simulation_options *o = &run->options;
  int nc = run->row_gains ? run->workspace->mechanism->nc : 0;
  const char *formulation = baum_formulation_name(o->formulation);
  add_text(list, "the integrator", run->integrator->name);
  add_text(list, "the formulation", formulation ? formulation : "none");
  add_number(list, "step", o->step);
  add_number(list, "rtol", o->rtol);
  add_number(list, "atol", o->atol);
  add_number(list, "max_step", o->max_step);
  add_number(list, "tolerance_q", o->tolerance_q);
  add_number(list, "tolerance_v", o->tolerance_v);
  add_number(list, "tolerance_lambda", o->tolerance_lambda);
  baum_i_saved_compare(list, "the rule of the gains", o->gains.rule);
  add_number(list, "the first number of the gains", o->gains.value[0]);
  add_number(list, "the second number of the gains", o->gains.value[1]);
  add_choice(list, "row_gains", run->row_gains, (size_t)nc * sizeof *run->row_gains);
  baum_i_saved_compare(list, "solver", o->solver);
  baum_i_saved_compare(list, "energy_account", run->account != NULL);
  baum_i_saved_compare(list, "error_check", o->error_check);
}

/* Found at the start, and built into the solvers. */
static void list_structure(const baum_simulation *run, baum_i_saved *list)
{
  const baum_workspace *w = run->workspace;
  baum_i_saved_compare(list, "the rank of the constraints", w->redundancy.rank);
  baum_i_saved_part *rows = add(list, "which rows are redundant", BAUM_I_SAVED_ROWS);
  rows->place = w->redundancy.omitted;
  rows->size = (size_t)w->mechanism->nc;
  rows->integer = w->redundancy.count;
  baum_i_saved_compare(list, "whether blocks suit", w->path != NULL);
}

/* ---- what is put back ---- */

static void list_motion(baum_simulation *run, baum_i_saved *list)
{
  baum_workspace *w = run->workspace;
  const baum_mechanism *m = w->mechanism;
  BAUM_I_SAVED_ADD(list, "t", run->state.t);
  add_array(list, "q", run->state.q, m->nq);
  add_array(list, "v", run->state.v, m->nv);
  BAUM_I_SAVED_ADD(list, "grid", run->grid);
  BAUM_I_SAVED_ADD(list, "origin", run->origin);
  add_array(list, "inputs", w->inputs, m->input_count);
  baum_i_saved_part *numbers = add(list, "parameters", BAUM_I_SAVED_NUMBERS);
  numbers->place = run->parameters;
  numbers->size = (size_t)m->parameter_count * sizeof *run->parameters;
  baum_i_saved_part *jumps = add(list, "scheduled inputs", BAUM_I_SAVED_JUMPS);
  jumps->place = run->schedule.jumps;
  jumps->size = (size_t)run->schedule.count * sizeof *run->schedule.jumps;
  jumps->integer = m->input_count;
}

/* Chosen at the start; of another processor it may differ in the last digits. */
static void list_choices(baum_simulation *run, baum_i_saved *list)
{
  baum_workspace *w = run->workspace;
  baum_i_problem *p = &run->problem;
  BAUM_I_SAVED_ADD(list, "pivot at which rows were tried", w->redundancy.tried);
  BAUM_I_SAVED_ADD(list, "direction", p->direction);
  BAUM_I_SAVED_ADD(list, "rate", p->rate);
  BAUM_I_SAVED_ADD(list, "longest step", p->max_step);
  BAUM_I_SAVED_ADD(list, "alpha", p->alpha);
  BAUM_I_SAVED_ADD(list, "beta", p->beta);
  BAUM_I_SAVED_ADD(list, "amplification", run->gains.amplification);
  BAUM_I_SAVED_ADD_FLAG(list, "metric chosen", w->metric_ready);
  add_array(list, "metric", w->metric, w->mechanism->nv);
}

static void list_counters(baum_counters *c, baum_i_saved *list)
{
  BAUM_I_SAVED_ADD_COUNT(list, "steps", c->steps);
  BAUM_I_SAVED_ADD_COUNT(list, "rejected", c->rejected);
  BAUM_I_SAVED_ADD_COUNT(list, "short steps", c->short_steps);
  BAUM_I_SAVED_ADD_COUNT(list, "evaluations in all", c->evaluations);
  BAUM_I_SAVED_ADD_COUNT(list, "factorizations", c->factorizations);
  BAUM_I_SAVED_ADD_COUNT(list, "full factorizations", c->full_factorizations);
  BAUM_I_SAVED_ADD_COUNT(list, "iterations", c->nonlinear_iterations);
  BAUM_I_SAVED_ADD_COUNT(list, "restarts", c->restarts);
  BAUM_I_SAVED_ADD_COUNT(list, "near singular in all", c->near_singular);
  BAUM_I_SAVED_ADD_BOUNDED(list, "number of warnings", c->warnings, 0, BAUM_I_WARNINGS);
  BAUM_I_SAVED_ADD_BOUNDED(list, "number of doubts", c->doubts, 0, BAUM_I_WARNINGS);
  BAUM_I_SAVED_ADD(list, "wall", c->wall);
  BAUM_I_SAVED_ADD(list, "largest phi", c->max_phi);
  BAUM_I_SAVED_ADD(list, "largest rate", c->max_phi_rate);
  BAUM_I_SAVED_ADD(list, "joint of largest phi", c->max_phi_joint);
  BAUM_I_SAVED_ADD(list, "joint of largest rate", c->max_phi_rate_joint);
  BAUM_I_SAVED_ADD(list, "predicted phi", c->predicted_phi);
  BAUM_I_SAVED_ADD(list, "predicted rate", c->predicted_phi_rate);
  BAUM_I_SAVED_ADD(list, "change of energy", c->energy_change);
  BAUM_I_SAVED_ADD(list, "change at the start", c->start_change);
  BAUM_I_SAVED_ADD_COUNT(list, "number of intervals", c->near_singular_intervals);
  BAUM_I_SAVED_ADD_COUNT(list, "branch warnings", c->branch_warnings);
  BAUM_I_SAVED_ADD_COUNT(list, "forced steps", c->forced_steps);
  BAUM_I_SAVED_ADD(list, "error estimate", c->error_estimate);
}

static void list_monitors(baum_simulation *run, baum_i_saved *list)
{
  baum_workspace *w = run->workspace;
  list_counters(&run->counters, list);
  BAUM_I_SAVED_ADD_COUNT(list, "evaluations", w->evaluations);
  BAUM_I_SAVED_ADD_COUNT(list, "near singular", w->near_singular);
  BAUM_I_SAVED_ADD(list, "start energy", run->start_energy);
  BAUM_I_SAVED_ADD(list, "largest gamma", run->largest_gamma);
  BAUM_I_SAVED_ADD_COUNT(list, "near singular seen", run->near_singular_seen);
  BAUM_I_SAVED_ADD(list, "rows looked at", run->rows_looked_at);
  BAUM_I_SAVED_ADD(list, "judged phi", run->judged_phi);
  BAUM_I_SAVED_ADD(list, "announced", run->announced);
  baum_i_saved_add_some(list, "warnings", run->warnings, sizeof *run->warnings,
                        run->counters.warnings, BAUM_I_WARNINGS);
}

static void list_knots(baum_i_saved *list, const char *name, baum_i_knot *knots, int count,
                       const baum_mechanism *m)
{
  for (int k = 0; k < count; k++) {
    baum_i_saved_add(list, name, &knots[k].t, sizeof knots[k].t);
    baum_i_saved_add(list, name, &knots[k].pivot, sizeof knots[k].pivot);
    add_array(list, name, knots[k].q, m->nq);
    add_array(list, name, knots[k].v, m->nv);
  }
}

static void list_passages(baum_simulation *run, baum_i_saved *list)
{
  baum_i_crossings *p = run->crossings;
  int joints = run->workspace->mechanism->joint_count;
  BAUM_I_SAVED_ADD(list, "usual pivot", p->usual);
  BAUM_I_SAVED_ADD_BOUNDED(list, "recent count", p->recent_count, 0, BAUM_I_RECENT);
  list_knots(list, "recent states", p->recent, BAUM_I_RECENT, run->workspace->mechanism);
  BAUM_I_SAVED_ADD_BOUNDED(list, "clear count", p->clear_count, 0, BAUM_I_HERMITE_MOST);
  list_knots(list, "clear states", p->clear, BAUM_I_HERMITE_MOST, run->workspace->mechanism);
  BAUM_I_SAVED_ADD_FLAG(list, "state not looked at", p->unseen);
  BAUM_I_SAVED_ADD_BOUNDED(list, "joint noted", p->joint_noted, -1, joints - 1);
  BAUM_I_SAVED_ADD_FLAG(list, "passage open", p->open);
  BAUM_I_SAVED_ADD(list, "passage from", p->present.from);
  list_knots(list, "passage lowest", &p->lowest, 1, run->workspace->mechanism);
  BAUM_I_SAVED_ADD_FLAG(list, "passage gap", p->present.gap);
  BAUM_I_SAVED_ADD(list, "passage largest turn", p->present.largest_turn);
  BAUM_I_SAVED_ADD_BOUNDED(list, "passage joint", p->present.joint, -1, joints - 1);
  baum_i_saved_add_some(list, "near-singular intervals", p->kept, sizeof *p->kept,
                        run->counters.near_singular_intervals, BAUM_I_PASSAGES);
}

static void add_event(const baum_i_event *event, baum_i_digest *sum)
{
  baum_i_digest_add_integer(sum, event->joint);
  baum_i_digest_add_integer(sum, event->def.direction);
  baum_i_digest_add_integer(sum, event->def.terminal);
  baum_i_digest_add(sum, &event->def.value, sizeof event->def.value);
  baum_i_digest_add(sum, &event->def.tolerance, sizeof event->def.tolerance);
}

/* What the events are must agree, but for functions and names. */
static void list_events(baum_i_events *events, baum_i_saved *list)
{
  baum_i_digest sum = {0};
  for (int k = 0; k < events->count; k++) {
    add_event(&events->list[k], &sum);
  }
  int64_t what = (int64_t)(sum.value >> 1);
  baum_i_saved_compare(list, "the sum over what the events are", what);
  baum_i_saved_add(list, "events", events->marks, (size_t)events->count * sizeof *events->marks);
  BAUM_I_SAVED_ADD(list, "events looked at", events->t);
  BAUM_I_SAVED_ADD(list, "events begun", events->begin);
  BAUM_I_SAVED_ADD(list, "events from", events->from);
  BAUM_I_SAVED_ADD_COUNT(list, "events recorded", events->recorded);
  baum_i_saved_add_some(list, "records of events", events->records, sizeof *events->records,
                        events->recorded, BAUM_I_EVENT_RECORDS);
}

void baum_i_saved_list(baum_simulation *run, baum_i_saved *list)
{
  list->count = 0;
  list_options(run, list);
  list_structure(run, list);
  list_motion(run, list);
  list_choices(run, list);
  list_monitors(run, list);
  if (run->account) {
    baum_i_account_saved(run->account, list);
  }
  if (run->companion) {
    baum_i_companion_saved(run->companion, list);
  }
  if (run->crossings) {
    list_passages(run, list);
  }
  baum_i_saved_compare(list, "the number of events", run->events ? run->events->count : 0);
  if (run->events) {
    list_events(run->events, list);
  }
}
