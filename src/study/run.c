/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs a study. First it computes the reference. Then it runs all entries: in several threads to
 * measure errors, and one after the other to measure times. Finally, it validates those entries
 * that may be recommended. */
#include <math.h>
#include <stdio.h>

#include "base/alloc.h"
#include "base/platform.h"
#include "study/study.h"

/* [-] A run whose positions have a larger error than this has followed another motion. */
static const double OFF = 0.1;
/* Time limit of a validation run, divided by the time limit of an entry. */
static const double VALIDATED_FOR = 5.0;
/* [s] The runs that time an entry are repeated until they have taken this time in total. */
static const double TIMED_FOR = 0.2;

typedef struct workers workers;

/* A function that works on one entry. `values` is scratch memory for the samples of one run. */
typedef void entry_fn(workers *c, baum_i_entry *entry, double *values);

/* Data that the threads share. */
struct workers {
  baum_study *study;
  baum_i_study_file *file;
  baum_i_lock *lock;
  double wall_end;
  entry_fn *work;       /* what the threads do with each entry */
  baum_i_entry **order; /* (count) the entries to be measured or validated */
  int count;
  int next;
  /* Progress of the study: the number of entries that are measured, plus the number of entries that
   * are timed or need no timing. */
  int done;
  baum_status status;
  baum_i_kept_message message; /* the message that belongs to `status` */
};

/* ---- results of a run ---- */

static baum_study_state state_of(const baum_i_outcome *outcome, bool timed_out)
{
  if (!outcome->created) {
    return BAUM_STUDY_REFUSED;
  }
  if (timed_out) {
    return BAUM_STUDY_TIMED_OUT;
  }
  return outcome->status < BAUM_OK ? BAUM_STUDY_FAILED : BAUM_STUDY_DONE;
}

/* Sets two errors from two differences. An error is NaN if its difference is unknown. Otherwise it
 * is the difference or the uncertainty of the reference, whichever is larger. */
static void grade(const double difference[2], double uncertainty, double *whole, double *end)
{
  *whole = isnan(difference[0]) ? difference[0] : fmax(difference[0], uncertainty);
  *end = isnan(difference[1]) ? difference[1] : fmax(difference[1], uncertainty);
}

static void grade_all(const baum_study_reference *r, const baum_i_differences *d,
                      baum_study_entry *out)
{
  out->at_floor = d->error[0] <= r->uncertainty;
  grade(d->error, r->uncertainty, &out->error, &out->error_final);
  grade(d->error + 1, r->uncertainty, &out->error_final, &out->error_half);
  grade(d->q, r->uncertainty_q, &out->error_q, &out->error_q_final);
  grade(d->v, r->uncertainty_v, &out->error_v, &out->error_v_final);
  grade(d->lambda, r->uncertainty_lambda, &out->error_lambda, &out->error_lambda_final);
  grade(d->energy, r->uncertainty_energy, &out->energy_error, &out->energy_error_final);
}

static void take_motion(const baum_i_outcome *outcome, baum_study_entry *entry)
{
  const baum_counters *c = &outcome->counters;
  entry->steps = c->steps;
  entry->rejected = c->rejected;
  entry->nonlinear_iterations = c->nonlinear_iterations;
  entry->forced_steps = c->forced_steps;
  entry->warnings = c->warnings;
  entry->near_singular_intervals = c->near_singular_intervals;
  entry->branch_warnings = c->branch_warnings;
  entry->doubts = c->doubts;
  entry->error_estimate = c->error_estimate;
  entry->unstable = outcome->status == BAUM_ERR_UNSTABLE || c->spectral_radius >= 1.0;
  if (outcome->created) {
    entry->max_phi = c->max_phi;
    entry->max_phi_rate = c->max_phi_rate;
    entry->violation_work = outcome->account.violation;
    entry->projection_work = outcome->account.projection;
    entry->gains_work = outcome->account.gains;
    entry->alpha = c->alpha;
    entry->beta = c->beta;
  }
}

static void take_outcome(const baum_study *study, const baum_i_outcome *outcome,
                         const baum_i_deadline *deadline, const double *values, baum_i_entry *entry)
{
  baum_study_entry *out = &entry->out;
  out->state = state_of(outcome, deadline->timed_out);
  out->status = outcome->status;
  out->untrusted = !study->reference.out.trusted;
  (void)snprintf(entry->message, sizeof entry->message, "%s", outcome->message);
  take_motion(outcome, out);
  if (out->state == BAUM_STUDY_DONE && study->reference.samples.values) {
    baum_i_differences d = baum_i_study_compare(study, &study->reference.samples, values);
    grade_all(&study->reference.out, &d, out);
    out->off = d.q[0] > OFF || out->branch_warnings > 0;
  }
  entry->limit = deadline->limit;
  entry->stage = BAUM_I_MEASURED;
}

/* ---- the workers ---- */

static void note_failure(workers *c, baum_status status)
{
  if (status != BAUM_OK && c->status == BAUM_OK) {
    c->status = status;
    c->message = baum_i_message_keep();
  }
}

/* Returns the deadline of a run. The time limit is `limits` times the time limit of an entry. */
static baum_i_deadline deadline_of(const workers *c, double limits)
{
  return (baum_i_deadline){
    .study = c->study, .limit = limits * c->study->options.entry_limit, .wall_end = c->wall_end};
}

/* Reports that one more entry is finished. Only one thread calls this function at a time. */
static void report_progress(workers *c)
{
  c->done++;
  const baum_study_options *o = &c->study->options;
  if (o->progress && o->progress(c->study, c->done, 2 * c->study->entry_count, o->user) != 0) {
    baum_study_cancel(c->study);
  }
}

/* Tells whether an entry is skipped because a coarser setting of its method has already reached the
 * time limit. */
static bool is_too_fine(const workers *c, const baum_i_entry *entry)
{
  double setting = baum_i_setting(&entry->options);
  return setting > 0.0 && setting < c->study->methods[entry->out.method].too_fine;
}

static void mark_too_fine(const workers *c, baum_i_entry *entry)
{
  entry->out.state = BAUM_STUDY_TIMED_OUT;
  entry->out.status = BAUM_STOP_CANCELLED;
  entry->out.untrusted = !c->study->reference.out.trusted;
  entry->limit = c->study->options.entry_limit;
  baum_i_say_too_long(entry->limit, entry->message, sizeof entry->message);
  entry->stage = BAUM_I_MEASURED;
}

/* Returns the next entry to be run. Returns NULL if there is none, or if the study must stop. */
static baum_i_entry *next_entry(workers *c)
{
  const baum_i_deadline deadline = deadline_of(c, 1.0);
  baum_i_entry *entry = NULL;
  baum_i_lock_take(c->lock);
  if (c->next < c->count && c->status == BAUM_OK && !baum_i_deadline_stops(&deadline)) {
    entry = c->order[c->next++];
  }
  baum_i_lock_give(c->lock);
  return entry;
}

static void finish_entry(workers *c, baum_i_entry *entry)
{
  if (entry->out.state == BAUM_STUDY_TIMED_OUT) {
    double *too_fine = &c->study->methods[entry->out.method].too_fine;
    *too_fine = fmax(*too_fine, baum_i_setting(&entry->options));
  }
  note_failure(c, baum_i_study_file_entry(c->file, entry));
  report_progress(c);
}

static void measure_entry(workers *c, baum_i_entry *entry, double *values)
{
  baum_i_deadline deadline = deadline_of(c, 1.0);
  baum_i_lock_take(c->lock);
  bool passed = is_too_fine(c, entry);
  baum_i_lock_give(c->lock);
  baum_i_outcome outcome = {0};
  if (!passed) {
    const baum_i_task task = {c->study, &entry->options, &c->study->reference.samples, true};
    baum_i_study_run_one(&task, &deadline, values, &outcome);
  }
  bool stopped = outcome.status == BAUM_STOP_CANCELLED && !deadline.timed_out;
  baum_i_lock_take(c->lock);
  if (outcome.status == BAUM_ERR_MEMORY) {
    note_failure(c, baum_i_fail_memory());
  } else if (!stopped) {
    if (passed) {
      mark_too_fine(c, entry);
    } else {
      take_outcome(c->study, &outcome, &deadline, values, entry);
    }
    finish_entry(c, entry);
  }
  baum_i_lock_give(c->lock);
}

/* Works on entries until there are no more. The threads execute this function. */
static void run_entries(void *shared, int thread)
{
  workers *c = shared;
  (void)thread;
  size_t size = (size_t)c->study->reference.samples.n * (size_t)baum_i_study_layout(c->study).width;
  double *values = baum_i_alloc(size, sizeof *values);
  if (!values) {
    baum_i_lock_take(c->lock);
    note_failure(c, baum_i_fail_memory());
    baum_i_lock_give(c->lock);
    return;
  }
  baum_i_entry *entry = NULL;
  while ((entry = next_entry(c)) != NULL) {
    c->work(c, entry, values);
  }
  baum_i_free(values);
}

/* Calls work() for all entries in c->order, in as many threads as the options give, but in no more
 * threads than there are entries. */
static void run_workers(workers *c, entry_fn *work)
{
  int threads = c->study->options.threads < c->count ? c->study->options.threads : c->count;
  c->work = work;
  if (threads > 0) {
    baum_i_threads_run(threads, run_entries, c);
  }
}

/* ---- validations ---- */

static void validate_entry(workers *c, baum_i_entry *entry, double *values)
{
  baum_i_deadline deadline = deadline_of(c, VALIDATED_FOR);
  double error = (double)NAN;
  baum_status status = baum_i_study_validate(c->study, entry, &deadline, values, &error);
  baum_i_lock_take(c->lock);
  if (status == BAUM_OK && !baum_i_deadline_stops(&deadline)) {
    entry->out.error_validated = error;
    entry->stage = BAUM_I_VALIDATED;
    status = baum_i_study_file_entry(c->file, entry);
  }
  note_failure(c, status);
  baum_i_lock_give(c->lock);
}

/* Makes the list of the entries that need validation. Returns false if the list is empty. */
static bool order_validations(workers *c)
{
  const baum_study *study = c->study;
  c->count = c->next = 0;
  for (int k = 0; study->options.validate && k < study->entry_count; k++) {
    if (baum_i_study_wants_validation(study, study->entries[k])) {
      c->order[c->count++] = study->entries[k];
    }
  }
  return c->count > 0;
}

static void validate_all(workers *c)
{
  bool known = c->study->reference.samples.values != NULL;
  if (!known || c->status != BAUM_OK || !order_validations(c)) {
    return;
  }
  baum_i_deadline deadline = deadline_of(c, VALIDATED_FOR);
  if (!c->study->validated) {
    note_failure(c, baum_i_study_make_validations(c->study, &deadline));
  }
  if (c->status == BAUM_OK) {
    run_workers(c, validate_entry);
  }
}

/* ---- order of the runs ---- */

/* Counts how many entries of the same method are coarser. */
static int rank_of(const baum_study *study, const baum_i_entry *entry)
{
  int rank = 0;
  for (int k = 0; k < study->entry_count; k++) {
    const baum_i_entry *other = study->entries[k];
    rank += other->out.method == entry->out.method &&
            baum_i_setting(&other->options) > baum_i_setting(&entry->options);
  }
  return rank;
}

/* Lists the entries to be measured. Coarse settings come first, so that every method has results
 * when the time budget is used up. Entries of the same rank stay in the order of adding. */
static void set_order(workers *c)
{
  const baum_study *study = c->study;
  c->count = 0;
  for (int k = 0; k < study->entry_count; k++) {
    baum_i_entry *entry = study->entries[k];
    if (entry->stage != BAUM_I_ADDED) {
      c->done++;
      continue;
    }
    entry->rank = rank_of(study, entry);
    int at = c->count++;
    for (; at > 0 && c->order[at - 1]->rank > entry->rank; at--) {
      c->order[at] = c->order[at - 1];
    }
    c->order[at] = entry;
  }
}

/* ---- times ---- */

/* Returns the work of a run, a cost that does not depend on the machine. The work is the number of
 * evaluations of right-hand sides or residuals, plus the number of factorizations, plus the number
 * of iterations of implicit methods. An explicit method thus has a work of 2 for each stage, and
 * CVODE's Adams method has a work of 3 for each iteration. IDA and BDF factorize larger matrices,
 * and SUNDIALS does other work between evaluations. Only the CPU time shows these costs. */
static double work_of(const baum_study_entry *r)
{
  return (double)(r->evaluations + r->factorizations + r->nonlinear_iterations);
}

static void take_times(const baum_i_outcome *first, const double least[2], int repeats,
                       baum_i_entry *entry)
{
  entry->out.evaluations = first->counters.evaluations;
  entry->out.factorizations = first->counters.factorizations;
  entry->out.work = work_of(&entry->out);
  entry->out.cpu = least[0];
  entry->out.cpu_spread = repeats > 1 ? least[1] - least[0] : (double)NAN;
  entry->out.repeats = repeats;
  entry->stage = BAUM_I_TIMED;
}

static baum_status time_entry(workers *c, baum_i_entry *entry)
{
  baum_i_deadline deadline = deadline_of(c, (double)INFINITY);
  const baum_i_task task = {c->study, &entry->options, &c->study->reference.samples, false};
  baum_i_outcome first = {0};
  double least[2] = {(double)INFINITY, (double)INFINITY};
  double sum = 0.0;
  int repeats = 0;
  while (repeats < c->study->options.repeats && sum < TIMED_FOR) {
    baum_i_outcome outcome;
    baum_i_study_run_one(&task, &deadline, NULL, &outcome);
    if (outcome.status < BAUM_OK) {
      return baum_i_fail(outcome.status, "study: timing of %s failed: %s", entry->name.text,
                         outcome.message);
    }
    if (outcome.status == BAUM_STOP_CANCELLED) {
      return BAUM_OK;
    }
    first = repeats == 0 ? outcome : first;
    sum += outcome.cpu;
    least[1] = fmin(least[1], fmax(least[0], outcome.cpu));
    least[0] = fmin(least[0], outcome.cpu);
    repeats++;
  }
  take_times(&first, least, repeats, entry);
  return baum_i_study_file_entry(c->file, entry);
}

static bool is_untimed(const baum_i_entry *entry)
{
  return entry->out.state == BAUM_STUDY_DONE && entry->stage < BAUM_I_TIMED;
}

static void time_entries(workers *c)
{
  const baum_i_deadline deadline = deadline_of(c, 1.0);
  for (int k = 0; k < c->study->entry_count && c->status == BAUM_OK; k++) {
    baum_i_entry *entry = c->study->entries[k];
    if (baum_i_deadline_stops(&deadline)) {
      return;
    }
    if (is_untimed(entry)) {
      note_failure(c, time_entry(c, entry));
    }
    report_progress(c);
  }
}

/* ---- the whole study ---- */

/* Counts the entries that must still be measured or timed. */
static int waiting(const baum_study *study)
{
  int count = 0;
  for (int k = 0; k < study->entry_count; k++) {
    const baum_i_entry *entry = study->entries[k];
    count += entry->stage == BAUM_I_ADDED || is_untimed(entry);
  }
  return count;
}

/* Tells whether any entry will be compared with the reference: it must be measured, needs
 * validation, or may need validation after it is timed. */
static bool needs_reference(workers *c)
{
  const baum_study *study = c->study;
  for (int k = 0; k < study->entry_count; k++) {
    const baum_i_entry *entry = study->entries[k];
    if (entry->stage == BAUM_I_ADDED || (study->options.validate && is_untimed(entry))) {
      return true;
    }
  }
  return order_validations(c);
}

static bool wants_check(const baum_study *study)
{
  for (int k = 0; k < study->entry_count; k++) {
    if (study->entries[k]->options.check_derivatives) {
      return true;
    }
  }
  return false;
}

static baum_status prepare(workers *c)
{
  baum_study *study = c->study;
  bool was_known = study->reference.known;
  if (was_known && !needs_reference(c)) {
    return BAUM_OK;
  }
  if (wants_check(study) && !was_known) {
    BAUM_I_TRY(baum_mechanism_check_derivatives(study->mechanism));
  }
  baum_i_deadline deadline = deadline_of(c, 1.0);
  BAUM_I_TRY(baum_i_study_make_reference(study, &deadline));
  return was_known ? BAUM_OK : baum_i_study_file_reference(c->file, study);
}

static void run_all(workers *c)
{
  c->lock = baum_i_lock_create();
  if (!c->lock) {
    note_failure(c, baum_i_fail_memory());
    return;
  }
  run_workers(c, measure_entry);
  time_entries(c);
  validate_all(c);
  baum_i_lock_destroy(c->lock);
}

static baum_status conclude(workers *c)
{
  const baum_study *study = c->study;
  if (c->status != BAUM_OK) {
    return baum_i_fail(c->status, "%s", c->message.text);
  }
  int left = waiting(study);
  if (left > 0) {
    bool cancelled = atomic_load(&study->cancelled) != 0;
    return baum_i_fail(BAUM_STOP_CANCELLED, "study: %s; %d of %d entries are not finished",
                       cancelled ? "cancelled" : "the time budget is spent", left,
                       study->entry_count);
  }
  return study->reference.out.trusted
           ? BAUM_OK
           : baum_i_fail(BAUM_WARNED, "study: the reference: %s", study->reference.text);
}

/* Prepares the memory, the samples, the study file, the reference and the order of the runs. */
static baum_status begin_study(workers *c)
{
  baum_study *study = c->study;
  c->order = baum_i_alloc((size_t)study->entry_count, sizeof(baum_i_entry *));
  BAUM_I_TRY(baum_i_check_memory(c->order));
  BAUM_I_TRY(baum_i_study_set_times(study));
  BAUM_I_TRY(baum_i_study_file_open(study, &c->file));
  study->begun = true;
  BAUM_I_TRY(prepare(c));
  set_order(c);
  return BAUM_OK;
}

baum_status baum_study_run(baum_study *study)
{
  BAUM_I_TRY(baum_i_study_check(study, "baum_study_run"));
  if (study->entry_count == 0) {
    return baum_i_fail(BAUM_ERR_STATE,
                       "baum_study_run: the study has no entries; add settings first");
  }
  BAUM_I_TRY(baum_i_study_check_idle(study, "baum_study_run"));
  study->running = true;
  workers c = {.study = study, .wall_end = baum_i_wall_seconds() + study->options.time_budget};
  baum_status status = begin_study(&c);
  if (status == BAUM_OK) {
    run_all(&c);
  }
  status = status == BAUM_OK || status == BAUM_STOP_CANCELLED ? conclude(&c) : status;
  baum_status closed = baum_i_study_file_close(c.file);
  baum_i_free(c.order);
  atomic_store(&study->cancelled, 0);
  study->running = false;
  return closed != BAUM_OK && (status == BAUM_OK || status == BAUM_WARNED) ? closed : status;
}
