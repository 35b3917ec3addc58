/* SPDX-License-Identifier: BSD-3-Clause */
/* The list of what is saved; see saved.h. */
#include "simulate/saved.h"

#include <assert.h>
#include <string.h>

#include "base/alloc.h"
#include "dynamics/immobile.h"
#include "simulate/account.h"
#include "simulate/passage.h"

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

static void add_integer(baum_i_saved *list, const char *name, int64_t value)
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
  add_integer(list, "the rule of the gains", o->gains.rule);
  add_number(list, "the first number of the gains", o->gains.value[0]);
  add_number(list, "the second number of the gains", o->gains.value[1]);
  add_choice(list, "row_gains", run->row_gains, (size_t)nc * sizeof *run->row_gains);
  add_integer(list, "solver", o->solver);
  add_integer(list, "energy_account", run->account != NULL);
}

/* Found at the start, and built into the solvers. */
static void list_structure(const baum_simulation *run, baum_i_saved *list)
{
  const baum_workspace *w = run->workspace;
  const baum_i_immobile *immobile = w->immobile;
  size_t still = immobile ? (size_t)immobile->count : 0;
  add_integer(list, "the rank of the constraints", w->redundancy.rank);
  add_choice(list, "which rows are redundant", w->redundancy.dropped, (size_t)w->mechanism->nc);
  add_integer(list, "whether blocks suit", w->path != NULL);
  add_choice(list, "which bodies cannot move", immobile ? immobile->velocity : NULL,
             still * sizeof *immobile->velocity);
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
  add_array(list, "inputs", w->inputs, m->input_count);
  baum_i_saved_part *numbers = add(list, "parameters", BAUM_I_SAVED_NUMBERS);
  numbers->place = run->parameters;
  numbers->size = (size_t)m->parameter_count * sizeof *run->parameters;
}

/* Chosen at the start; of another processor it may differ in the last digits. */
static void list_choices(baum_simulation *run, baum_i_saved *list)
{
  baum_workspace *w = run->workspace;
  baum_i_problem *p = &run->problem;
  BAUM_I_SAVED_ADD(list, "direction", p->direction);
  BAUM_I_SAVED_ADD(list, "rate", p->rate);
  BAUM_I_SAVED_ADD(list, "longest step", p->max_step);
  BAUM_I_SAVED_ADD(list, "alpha", p->alpha);
  BAUM_I_SAVED_ADD(list, "beta", p->beta);
  BAUM_I_SAVED_ADD(list, "amplification", run->gains.amplification);
  BAUM_I_SAVED_ADD(list, "metric chosen", w->metric_ready);
  add_array(list, "metric", w->metric, w->mechanism->nv);
  if (w->immobile) {
    BAUM_I_SAVED_ADD(list, "immobile", w->immobile->rests);
    add_array(list, "immobile position", w->immobile->position, w->immobile->count);
    add_array(list, "immobile phi", w->immobile->phi, w->immobile->row_count);
  }
}

static void list_monitors(baum_simulation *run, baum_i_saved *list)
{
  baum_workspace *w = run->workspace;
  BAUM_I_SAVED_ADD(list, "counters", run->counters);
  BAUM_I_SAVED_ADD(list, "evaluations", w->evaluations);
  BAUM_I_SAVED_ADD(list, "near singular", w->near_singular);
  BAUM_I_SAVED_ADD(list, "start energy", run->start_energy);
  BAUM_I_SAVED_ADD(list, "largest gamma", run->largest_gamma);
  BAUM_I_SAVED_ADD(list, "near singular seen", run->near_singular_seen);
  BAUM_I_SAVED_ADD(list, "redundant seen", run->redundant_seen);
  BAUM_I_SAVED_ADD(list, "large seen", run->large_seen);
  BAUM_I_SAVED_ADD(list, "judged phi", run->judged_phi);
  BAUM_I_SAVED_ADD(list, "signalled", run->signalled);
  if (run->passages) {
    BAUM_I_SAVED_ADD(list, "usual pivot", run->passages->usual);
    BAUM_I_SAVED_ADD(list, "near-singular intervals", run->passages->kept);
  }
  baum_i_saved_part *warnings = add(list, "warnings", BAUM_I_SAVED_WARNINGS);
  warnings->place = run->warnings;
  warnings->size = sizeof run->warnings;
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
}
