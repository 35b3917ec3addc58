/* SPDX-License-Identifier: BSD-3-Clause */
/* Saves a run into memory and restores it.
 *
 * A buffer consists of words of eight bytes in the format of this machine:
 *
 *   "baumsave"       a number that shows byte order and format of doubles    version
 *   size in bytes    fingerprint of the mechanism (2)
 *   the parts of saved.h
 *   digest of all words before (base/digest.h)
 *
 * A buffer is checked completely before the run is changed. Integrator history and pivots are not
 * saved. Saving discards them just as restoring does, so the saved and the restored run continue
 * identically. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/alloc.h"
#include "base/digest.h"
#include "base/text.h"
#include "mechanism/definition.h"
#include "mechanism/fingerprint.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/general/driven.h"
#include "simulate/account.h"
#include "simulate/companion.h"
#include "simulate/crossing.h"
#include "simulate/events.h"
#include "simulate/saved.h"

enum { WORD = 8 };

static const char MAGIC[WORD + 1] = "baumsave";
static const double NUMBER = 0x1.123456789abcdp+42; /* its bytes all differ from each other */

typedef struct header {
  char magic[WORD];
  double number;
  uint64_t version;
  uint64_t size;
  baum_i_fingerprint mechanism;
} header;

/* ---- data that must agree ---- */

static const char *const FACTS[BAUM_I_SAVED_FACTS] = {
  "step",
  "rtol",
  "atol",
  "max_step",
  "tolerance_q",
  "tolerance_v",
  "tolerance_lambda",
  "the gain rule",
  "the first number of the gain rule",
  "the second number of the gain rule",
  "row_gain_count",
  "the checksum of row_gains",
  "solver",
  "energy_account",
  "error_check",
  "the rank of the constraints",
  "the use of the block solver",
  "the number of events",
  "the checksum of the events",
};

/* Return the upper 53 bits of a digest as a double, which can represent them exactly. */
static double number_of(const baum_i_digest *sum)
{
  return (double)(sum->value >> 11);
}

/* Return a digest of the events without their functions and names. */
static double sum_of_events(const baum_i_events *events)
{
  baum_i_digest sum = {0};
  for (int k = 0; events && k < events->count; k++) {
    const baum_i_event *event = &events->list[k];
    baum_i_digest_add_integer(&sum, event->joint);
    baum_i_digest_add_integer(&sum, event->def.coordinate);
    baum_i_digest_add_integer(&sum, event->def.direction);
    baum_i_digest_add_integer(&sum, event->def.terminal);
    baum_i_digest_add(&sum, &event->def.value, sizeof event->def.value);
    baum_i_digest_add(&sum, &event->def.tolerance, sizeof event->def.tolerance);
  }
  return number_of(&sum);
}

static baum_i_saved_identity identity_of(const baum_simulation *run)
{
  const baum_simulation_options *o = &run->options;
  const baum_workspace *w = run->workspace;
  const char *formulation = baum_formulation_name(o->formulation);
  baum_i_digest gains = {0};
  baum_i_digest_add(&gains, run->row_gains,
                    run->row_gains ? (size_t)w->mechanism->nc * sizeof *run->row_gains : 0);
  baum_i_saved_identity identity = {
    .facts = {o->step, o->rtol, o->atol, o->max_step, o->tolerance_q, o->tolerance_v,
              o->tolerance_lambda, o->gains.rule, o->gains.value[0], o->gains.value[1],
              o->row_gain_count, number_of(&gains), o->solver, run->account != NULL, o->error_check,
              w->rows.rank, w->path != NULL, run->events ? run->events->count : 0,
              sum_of_events(run->events)},
  };
  baum_i_print(identity.integrator, BAUM_I_SAVED_TEXT, "%s", run->integrator->name);
  baum_i_print(identity.formulation, BAUM_I_SAVED_TEXT, "%s", formulation ? formulation : "none");
  return identity;
}

/* ---- the list ---- */

/* List the parts that have names in the enum of saved.h, in its order. */
static void list_named(baum_simulation *run, baum_i_saved *list)
{
  baum_workspace *w = run->workspace;
  const baum_mechanism *m = w->mechanism;
  baum_i_saved_add(list, &list->identity, sizeof list->identity, 0);
  baum_i_saved_add_all(list, w->rows.omitted, sizeof *w->rows.omitted, m->nc);
  baum_i_saved_add_some(list, run->parameters, sizeof *run->parameters,
                        run->parameters ? m->parameter_count : 0, m->parameter_count);
  baum_i_saved_add_some(list, run->schedule.jumps, sizeof *run->schedule.jumps, run->schedule.count,
                        INT64_MAX);
  baum_i_saved_add(list, run, offsetof(baum_simulation, options), 0);
  baum_i_saved_add_all(list, run->crossings, offsetof(baum_i_crossings, recent),
                       run->crossings != NULL);
}

static void list_knots(baum_i_saved *list, const baum_mechanism *m, baum_i_knot *knots, int count)
{
  for (int k = 0; k < count; k++) {
    baum_i_saved_add_array(list, &knots[k].t, 1);
    baum_i_saved_add_array(list, &knots[k].pivot, 1);
    baum_i_saved_add_array(list, knots[k].q, m->nq);
    baum_i_saved_add_array(list, knots[k].v, m->nv);
  }
}

static void list_crossings(baum_simulation *run, baum_i_saved *list)
{
  const baum_mechanism *m = run->workspace->mechanism;
  baum_i_crossings *p = run->crossings;
  list_knots(list, m, p->recent, BAUM_I_RECENT);
  list_knots(list, m, p->clear, BAUM_I_HERMITE_MOST);
  list_knots(list, m, &p->lowest, 1);
  baum_i_saved_add_some(list, p->kept, sizeof *p->kept, run->counters.near_singular_intervals,
                        BAUM_I_NEAR_SINGULAR_KEPT);
}

static void list_events(baum_i_events *events, baum_i_saved *list)
{
  baum_i_saved_add(list, events, offsetof(baum_i_events, list), 1);
  baum_i_saved_add_all(list, events->marks, sizeof *events->marks, events->count);
  baum_i_saved_add_some(list, events->records, sizeof *events->records, events->recorded,
                        BAUM_I_EVENT_RECORDS);
}

void baum_i_saved_list(baum_simulation *run, baum_i_saved *list)
{
  baum_workspace *w = run->workspace;
  const baum_mechanism *m = w->mechanism;
  list->count = 0;
  list->identity = identity_of(run);
  list_named(run, list);
  baum_i_saved_add(list, &run->problem, offsetof(baum_i_problem, workspace), 0);
  baum_i_saved_add(list, &run->gains.amplification, sizeof run->gains.amplification, 0);
  baum_i_saved_add(list, &w->evaluations, sizeof w->evaluations, 1);
  baum_i_saved_add(list, &w->near_singular, sizeof w->near_singular, 1);
  baum_i_saved_add(list, &w->rows.pivot_at_last_selection, sizeof w->rows.pivot_at_last_selection,
                   0);
  baum_i_saved_add(list, &w->metric_ready, sizeof w->metric_ready, 0);
  baum_i_saved_add_state(list, m, &run->state);
  baum_i_saved_add_array(list, w->inputs, m->input_count);
  baum_i_saved_add_array(list, w->metric, m->nv);
  baum_i_saved_add_array(list, w->point.angles, m->spatial ? baum_i_angles_size(m) : 0);
  baum_i_saved_add_some(list, run->warnings, sizeof *run->warnings, run->counters.warnings,
                        BAUM_I_WARNINGS);
  if (run->account) {
    baum_i_account_saved(run->account, list);
  }
  if (run->companion) {
    baum_i_companion_saved(run->companion, list);
  }
  if (run->crossings) {
    list_crossings(run, list);
  }
  if (run->events) {
    list_events(run->events, list);
  }
}

/* ---- forget ---- */

/* Discard the data that are not saved. */
static void forget_unsaved(baum_simulation *run)
{
  run->rechecked = run->counters.steps;
  baum_i_workspace_forget(run->workspace);
  baum_i_companion_forget(run);
  if (run->account) {
    baum_i_account_forget(run->account);
  }
  if (baum_i_integrator_remembers(run->integrator, &run->problem)) {
    run->integrator->forget(run->self);
  }
}

/* Make the next step start from the reported state. */
static void restart_for_save(baum_simulation *run)
{
  baum_i_run_end_before_change(run);
  if (baum_i_integrator_remembers(run->integrator, &run->problem)) {
    baum_i_run_copy(run, &run->state, &run->ahead);
    run->origin = run->state.t;
    if (run->account) {
      baum_i_account_go_on(run);
    }
    /* The values of the events have been evaluated before. If an evaluation fails now, the known
     * values are kept. */
    if (run->events && baum_i_events_evaluate_again(run) == BAUM_OK) {
      baum_i_events_go_on(run);
    }
    run->counters.restarts++;
  }
  forget_unsaved(run);
}

/* ---- save ---- */

static size_t write_all(const baum_simulation *run, const baum_i_saved *list, unsigned char *buffer)
{
  const unsigned char *end = baum_i_saved_write(list, buffer + sizeof(header));
  size_t before = (size_t)(end - buffer);
  header h = {.number = NUMBER,
              .version = BAUM_I_SAVED_VERSION,
              .size = before + WORD,
              .mechanism = run->fingerprint};
  memcpy(h.magic, MAGIC, WORD);
  memcpy(buffer, &h, sizeof h);
  baum_i_digest sum = {0};
  baum_i_digest_add(&sum, buffer, before);
  memcpy(buffer + before, &sum.value, WORD);
  return before + WORD;
}

baum_status baum_simulation_save(baum_simulation *simulation, void *buffer, size_t capacity,
                                 size_t *size)
{
  const char *call = "baum_simulation_save";
  BAUM_I_TRY(baum_i_run_may_be_changed(simulation, call)); /* saving discards pivots */
  BAUM_I_TRY(baum_i_check_given(call, "size", size != NULL));
  baum_i_saved list;
  baum_i_saved_list(simulation, &list);
  size_t most = sizeof(header) + baum_i_saved_size(&list) + WORD;
  if (!buffer) {
    *size = most;
    return BAUM_OK;
  }
  if (capacity < most) {
    return baum_i_fail(BAUM_ERR_ARGUMENT,
                       "%s: capacity is %zu bytes, must be at least %zu; a call with a NULL buffer "
                       "returns this size",
                       call, capacity, most);
  }
  baum_i_kept_message kept = baum_i_message_keep();
  restart_for_save(simulation);
  baum_i_run_count(simulation);
  baum_i_saved_list(simulation, &list); /* the sizes of the parts may have changed */
  *size = write_all(simulation, &list, buffer);
  return baum_i_run_end_call(simulation, BAUM_OK, &kept);
}

/* ---- check ---- */

/* The buffer from which a run is restored. */
typedef struct reader {
  const unsigned char *bytes;
  size_t size;
  header head;
  baum_i_saved_places parts;
} reader;

#define refuse(...) baum_i_fail(BAUM_ERR_BUFFER, "baum_simulation_restore: the buffer " __VA_ARGS__)

#define OTHER_OPTIONS "is of a run with other options: "

/* Check that the buffer is complete and was written by this version. */
static baum_status check_header(reader *r)
{
  const header *h = &r->head;
  if (r->size < sizeof *h + WORD) {
    return refuse("has %zu bytes, less than a header; it is truncated, or was not written by "
                  "baum_simulation_save()",
                  r->size);
  }
  memcpy(&r->head, r->bytes, sizeof r->head);
  if (memcmp(h->magic, MAGIC, WORD) != 0) {
    return refuse("was not written by baum_simulation_save()");
  }
  if (h->number != NUMBER) { /* also true if it is NaN */
    return refuse("was written on a machine with another byte order or another format of numbers, "
                  "or is damaged");
  }
  if (h->version != BAUM_I_SAVED_VERSION) {
    return refuse("has version %llu of the format, this library reads version %d; save and restore "
                  "with the same library version",
                  (unsigned long long)h->version, (int)BAUM_I_SAVED_VERSION);
  }
  if (h->size > r->size) {
    return refuse("has only %zu of its %llu bytes; it is truncated", r->size,
                  (unsigned long long)h->size);
  }
  if (h->size < sizeof *h + WORD || h->size % WORD != 0) {
    return refuse("is damaged: it claims to have %llu bytes", (unsigned long long)h->size);
  }
  return BAUM_OK;
}

static baum_status check_sum(reader *r)
{
  size_t before = (size_t)r->head.size - WORD;
  baum_i_digest sum = {0};
  baum_i_digest_add(&sum, r->bytes, before);
  if (memcmp(&sum.value, r->bytes + before, WORD) != 0) {
    return refuse("is damaged: its checksum is wrong");
  }
  return BAUM_OK;
}

static baum_status check_mechanism(const reader *r, const baum_simulation *run)
{
  const baum_i_fingerprint *there = &r->head.mechanism;
  const baum_i_fingerprint *here = &run->fingerprint;
  if (there->structure != here->structure) {
    return refuse("is of another mechanism: kinds, number or connections of elements "
                  "differ");
  }
  if (there->numbers != here->numbers) {
    return refuse("is of another mechanism: the elements are the same, but masses, lengths or "
                  "other parameters differ");
  }
  return BAUM_OK;
}

static baum_status check_text(const char *name, const char *there, const char *here)
{
  if (memcmp(there, here, BAUM_I_SAVED_TEXT) == 0) {
    return BAUM_OK;
  }
  return refuse(OTHER_OPTIONS "the %s is %.31s in the buffer and %s in this run", name, there,
                here);
}

/* Check that the options agree. NaN means "not given" and equals NaN. */
static baum_status check_identity(const reader *r, const baum_i_saved_identity *here)
{
  baum_i_saved_identity there = {0};
  if (r->head.size < sizeof(header) + WORD + sizeof there + WORD) {
    return BAUM_OK; /* check_parts() will report the missing parts */
  }
  memcpy(&there, r->bytes + sizeof(header) + WORD, sizeof there);
  BAUM_I_TRY(check_text("integrator", there.integrator, here->integrator));
  BAUM_I_TRY(check_text("formulation", there.formulation, here->formulation));
  for (int k = 0; k < BAUM_I_SAVED_FACTS; k++) {
    double a = there.facts[k];
    double b = here->facts[k];
    if (a != b && !(isnan(a) && isnan(b))) {
      return refuse(OTHER_OPTIONS "%s is %.9g in the buffer and %.9g in this run", FACTS[k], a, b);
    }
  }
  return BAUM_OK;
}

/* Check that the saved run omits as many rows as this run. If this run omits no rows, the number is
 * not checked. */
static baum_status check_omitted(const reader *r, const baum_i_row_set *here)
{
  const unsigned char *omitted = r->parts.at[BAUM_I_SAVED_OMITTED];
  int64_t count = 0;
  bool sound = true;
  for (int64_t i = 0; i < r->parts.count[BAUM_I_SAVED_OMITTED]; i++) {
    sound = sound && omitted[i] <= 1;
    count += omitted[i];
  }
  return sound && (count == here->count || here->count == 0)
           ? BAUM_OK
           : refuse(
               "does not fit: this run cannot omit the redundant rows that the saved run omits");
}

/* A driver whose definition gives a polynomial (general/driven.h) has no other law. Check that the
 * buffer contains a polynomial for each of these drivers. */
static baum_status check_laws(const reader *r, const baum_mechanism *m)
{
  const unsigned char *numbers = r->parts.at[BAUM_I_SAVED_PARAMETERS];
  int64_t count = r->parts.count[BAUM_I_SAVED_PARAMETERS];
  if (count != 0 && count != m->parameter_count) {
    return refuse("is damaged: its number of parameters is %lld, must be %d", (long long)count,
                  m->parameter_count);
  }
  for (int k = 0; k < m->joint_count && count > 0; k++) {
    int at = m->joints[k]->element.parameter + BAUM_I_DRIVER_POLYNOMIAL;
    double polynomial = 0.0;
    memcpy(&polynomial, numbers + (size_t)at * sizeof polynomial, sizeof polynomial);
    if (m->joints[k]->type->driven && m->parameters[at] != 0.0 && polynomial == 0.0) {
      return refuse("is damaged: it has no law for joint %d", k + 1);
    }
  }
  return BAUM_OK;
}

static baum_status check_counters(const reader *r)
{
  baum_counters c;
  memcpy(&c, r->parts.at[BAUM_I_SAVED_PROGRESS] + offsetof(baum_simulation, counters), sizeof c);
  const int64_t counts[] = {c.steps,           c.rejected,
                            c.short_steps,     c.evaluations,
                            c.restarts,        c.factorizations,
                            c.forced_steps,    c.full_factorizations,
                            c.near_singular,   c.near_singular_intervals,
                            c.branch_warnings, c.nonlinear_iterations};
  bool sound = c.warnings >= 0 && c.warnings <= BAUM_I_WARNINGS && c.doubts >= 0 &&
               c.doubts <= BAUM_I_WARNINGS;
  for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
    sound = sound && counts[k] >= 0 && counts[k] <= INT64_MAX / 2;
  }
  return sound ? BAUM_OK : refuse("is damaged: a counter is out of range");
}

/* Check numbers that are used as indices. */
static baum_status check_crossings(const reader *r, int joints)
{
  const struct {
    size_t at;
    int least;
    int most;
  } indices[] = {
    {offsetof(baum_i_crossings, recent_count), 0, BAUM_I_RECENT},
    {offsetof(baum_i_crossings, clear_count), 0, BAUM_I_HERMITE_MOST},
    {offsetof(baum_i_crossings, joint_noted), -1, joints - 1},
    {offsetof(baum_i_crossings, present.joint), -1, joints - 1},
  };
  for (size_t k = 0; k < 4 && r->parts.count[BAUM_I_SAVED_CROSSINGS] > 0; k++) {
    int32_t index = 0;
    memcpy(&index, r->parts.at[BAUM_I_SAVED_CROSSINGS] + indices[k].at, sizeof index);
    if (index < indices[k].least || index > indices[k].most) {
      return refuse("is damaged: an index of singularity crossings is %d", (int)index);
    }
  }
  return BAUM_OK;
}

static baum_status check_parts(reader *r, const baum_simulation *run, const baum_i_saved *list)
{
  const baum_mechanism *m = run->workspace->mechanism;
  size_t size = (size_t)r->head.size - sizeof(header) - WORD;
  const char *wrong = baum_i_saved_find(list, r->bytes + sizeof(header), size, &r->parts);
  if (wrong) {
    return refuse("%s", wrong);
  }
  BAUM_I_TRY(check_omitted(r, &run->workspace->rows));
  BAUM_I_TRY(check_laws(r, m));
  if (!baum_i_schedule_is_sound(r->parts.at[BAUM_I_SAVED_JUMPS], r->parts.count[BAUM_I_SAVED_JUMPS],
                                m->input_count)) {
    return refuse("is damaged: scheduled inputs are not in order");
  }
  BAUM_I_TRY(check_counters(r));
  return check_crossings(r, m->joint_count);
}

static baum_status check_buffer(reader *r, const baum_simulation *run, const baum_i_saved *list)
{
  BAUM_I_TRY(check_header(r));
  BAUM_I_TRY(check_sum(r));
  BAUM_I_TRY(check_mechanism(r, run));
  BAUM_I_TRY(check_identity(r, &list->identity));
  return check_parts(r, run, list);
}

/* ---- restore ---- */

/* Do the part of restoring that may fail: allocate memory for parameters and scheduled jumps, and
 * omit the rows that the saved run omits. */
static baum_status make_room(baum_simulation *run, const reader *r)
{
  if (r->parts.count[BAUM_I_SAVED_PARAMETERS] > 0) {
    BAUM_I_TRY(baum_i_run_own_parameters(run));
  }
  BAUM_I_TRY(baum_i_schedule_reserve(&run->schedule, (int)r->parts.count[BAUM_I_SAVED_JUMPS]));
  if (run->workspace->rows.count == 0) {
    return BAUM_OK;
  }
  baum_status status = baum_i_run_omit_rows(run, r->parts.at[BAUM_I_SAVED_OMITTED]);
  return status == BAUM_OK || status == BAUM_ERR_MEMORY
           ? status
           : refuse("is damaged: it omits rows that are not redundant");
}

static void put_inputs_back(baum_simulation *run, const reader *r)
{
  const baum_mechanism *m = run->workspace->mechanism;
  bool has_own = r->parts.count[BAUM_I_SAVED_PARAMETERS] > 0;
  if (run->parameters) {
    memcpy(run->parameters,
           has_own ? (const void *)r->parts.at[BAUM_I_SAVED_PARAMETERS] : m->parameters,
           (size_t)m->parameter_count * sizeof *run->parameters);
  }
  run->schedule.count = (int)r->parts.count[BAUM_I_SAVED_JUMPS];
  if (run->schedule.count > 0) {
    memcpy(run->schedule.jumps, r->parts.at[BAUM_I_SAVED_JUMPS],
           (size_t)run->schedule.count * sizeof *run->schedule.jumps);
  }
}

/* Give the id of a joint the tag of this mechanism. */
static void own_id(const baum_simulation *run, baum_joint_id *id)
{
  const baum_mechanism *m = run->workspace->mechanism;
  bool is_joint = id->index1 > 0 && id->index1 <= m->joint_count;
  *id = baum_i_joint_id(m, is_joint ? id->index1 - 1 : -1);
}

static void own_ids(baum_simulation *run)
{
  own_id(run, &run->counters.max_phi_joint);
  own_id(run, &run->counters.max_phi_rate_joint);
  for (int k = 0; run->crossings && k < BAUM_I_NEAR_SINGULAR_KEPT; k++) {
    own_id(run, &run->crossings->kept[k].joint);
  }
}

/* Make all entries for events and warnings valid, even if the buffer contained arbitrary bytes. */
static void own_entries(baum_simulation *run)
{
  for (int k = 0; run->events && k < run->events->count; k++) {
    run->events->marks[k].side = baum_i_sign(run->events->marks[k].side);
  }
  for (int64_t k = 0; k < run->counters.warnings; k++) {
    baum_warning *warning = &run->warnings[k];
    own_id(run, &warning->joint);
    warning->doubts_motion = baum_i_doubts_motion(warning->code);
    warning->text[sizeof warning->text - 1] = '\0';
  }
}

static void restore_parts(baum_simulation *run, const reader *r, const baum_i_saved *list)
{
  put_inputs_back(run, r);
  for (int k = BAUM_I_SAVED_PROGRESS; k < list->count; k++) {
    if (r->parts.count[k] > 0) {
      memcpy(list->parts[k].place, r->parts.at[k], (size_t)r->parts.count[k] * list->parts[k].unit);
    }
  }
  own_ids(run);
  own_entries(run);
  baum_i_run_count_from_here(run);
  baum_i_run_copy(run, &run->state, &run->ahead);
  forget_unsaved(run);
}

baum_status baum_simulation_restore(baum_simulation *simulation, const void *buffer, size_t size)
{
  const char *call = "baum_simulation_restore";
  BAUM_I_TRY(baum_i_run_may_be_changed(simulation, call));
  BAUM_I_TRY(baum_i_check_given(call, "the buffer", buffer != NULL));
  baum_i_kept_message kept = baum_i_message_keep();
  baum_i_saved list;
  baum_i_saved_list(simulation, &list);
  reader r = {.bytes = buffer, .size = size};
  baum_status status = check_buffer(&r, simulation, &list);
  if (status == BAUM_OK) {
    status = make_room(simulation, &r);
  }
  if (status == BAUM_OK) {
    restore_parts(simulation, &r, &list);
  }
  return baum_i_run_end_call(simulation, status, &kept);
}
