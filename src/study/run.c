/* SPDX-License-Identifier: BSD-3-Clause */
/* Running a study: the reference, then all errors by several threads, then all times one after the other. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "study/study.h"

static const double OFF = 0.1;           /* [-] error of positions of another motion */
static const double REHEARSED_FOR = 5.0; /* row limits */
static const double TIMED_FOR = 0.2;     /* [s] a row is not repeated beyond that */

/* What the threads share. */
typedef struct crew {
  baum_study *study;
  baum_i_study_file *file;
  baum_i_lock lock;
  double deadline;
  baum_i_row **order; /* (count) rows to be measured */
  int count;
  int next;
  int done; /* rows measured, and rows timed or not to be */
  baum_status status;
  baum_i_sentence sentence; /* of the status */
} crew;

/* ---- what a run says of its row ---- */

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

/* Nothing is graded below what the reference is known to. */
static double graded(double difference, double uncertainty)
{
  return isnan(difference) ? difference : fmax(difference, uncertainty);
}

static void grade(const baum_study *study, const baum_i_differences *d, baum_study_row *row)
{
  const baum_study_reference *r = &study->reference.out;
  row->at_floor = d->error[0] <= r->uncertainty;
  row->error = graded(d->error[0], r->uncertainty);
  row->error_final = graded(d->error[1], r->uncertainty);
  row->error_half = graded(d->error[2], r->uncertainty);
  row->error_q = graded(d->q[0], r->uncertainty_q);
  row->error_q_final = graded(d->q[1], r->uncertainty_q);
  row->error_v = graded(d->v[0], r->uncertainty_v);
  row->error_v_final = graded(d->v[1], r->uncertainty_v);
  row->error_lambda = graded(d->lambda[0], r->uncertainty_lambda);
  row->error_lambda_final = graded(d->lambda[1], r->uncertainty_lambda);
  row->energy_error = graded(d->energy[0], r->uncertainty_energy);
  row->energy_error_final = graded(d->energy[1], r->uncertainty_energy);
}

static void take_motion(const baum_i_outcome *outcome, baum_study_row *row)
{
  const baum_counters *c = &outcome->counters;
  row->steps = c->steps;
  row->rejected = c->rejected;
  row->nonlinear_iterations = c->nonlinear_iterations;
  row->forced_steps = c->forced_steps;
  row->warnings = c->warnings;
  row->near_singular_intervals = c->near_singular_intervals;
  row->branch_warnings = c->branch_warnings;
  row->doubts = c->doubts;
  row->error_estimate = c->error_estimate;
  row->unstable = outcome->status == BAUM_ERR_UNSTABLE || c->spectral_radius >= 1.0;
  if (outcome->created) {
    row->max_phi = c->max_phi;
    row->max_phi_rate = c->max_phi_rate;
    row->violation_work = outcome->account.violation;
    row->projection_work = outcome->account.projection;
    row->gains_work = outcome->account.gains;
    row->alpha = c->alpha;
    row->beta = c->beta;
  }
}

static void take_outcome(const baum_study *study, const baum_i_outcome *outcome,
                         const baum_i_watch *watch, const double *samples, baum_i_row *row)
{
  baum_study_row *out = &row->out;
  out->state = state_of(outcome, watch->timed_out);
  out->status = outcome->status;
  out->untrusted = !study->reference.out.trusted;
  (void)snprintf(row->message, sizeof row->message, "%s", outcome->message);
  take_motion(outcome, out);
  if (out->state == BAUM_STUDY_DONE && study->reference.course.rows) {
    baum_i_differences d = baum_i_study_compare(study, &study->reference.course, samples);
    grade(study, &d, out);
    out->off = d.q[0] > OFF || out->branch_warnings > 0;
  }
  row->limit = watch->limit;
  row->measured = true;
}

/* ---- the crew ---- */

static void give_up(crew *c, baum_status status)
{
  if (c->status == BAUM_OK) {
    c->status = status;
    baum_i_message_keep(&c->sentence);
  }
}

/* For runs that take so many row limits at most. */
static baum_i_watch watch_of(const crew *c, double limits)
{
  return (baum_i_watch){
    .study = c->study, .limit = limits * c->study->options.row_limit, .deadline = c->deadline};
}

/* As many threads as there are rows, or as the options say. */
static void run_crew(crew *c, void (*work)(void *user, int k))
{
  int threads = c->study->options.threads < c->count ? c->study->options.threads : c->count;
  if (threads > 0) {
    baum_i_threads_run(threads, work, c);
  }
}

/* A row has come a stage further. Called by one thread at a time. */
static void report(crew *c)
{
  c->done++;
  const baum_study_options *o = &c->study->options;
  if (o->progress && o->progress(c->study, c->done, 2 * c->study->row_count, o->user) != 0) {
    baum_study_cancel(c->study);
  }
}

/* A coarser setting of the method has reached the limit. */
static bool is_too_fine(const crew *c, const baum_i_row *row)
{
  double setting = baum_i_setting(&row->options);
  return setting > 0.0 && setting < c->study->methods[row->out.method].too_fine;
}

static void pass_over(const crew *c, baum_i_row *row)
{
  row->out.state = BAUM_STUDY_TIMED_OUT;
  row->out.status = BAUM_STOP_CANCELLED;
  row->out.untrusted = !c->study->reference.out.trusted;
  row->limit = c->study->options.row_limit;
  baum_i_say_too_long(row->limit, row->message, sizeof row->message);
  row->measured = true;
}

/* The next row, or NULL. */
static baum_i_row *next_row(crew *c)
{
  const baum_i_watch watch = watch_of(c, 1.0);
  baum_i_row *row = NULL;
  baum_i_lock_take(&c->lock);
  if (c->next < c->count && c->status == BAUM_OK && !baum_i_watch_stops(&watch)) {
    row = c->order[c->next++];
  }
  baum_i_lock_give(&c->lock);
  return row;
}

static void finish_row(crew *c, baum_i_row *row)
{
  if (row->out.state == BAUM_STUDY_TIMED_OUT) {
    double *too_fine = &c->study->methods[row->out.method].too_fine;
    *too_fine = fmax(*too_fine, baum_i_setting(&row->options));
  }
  baum_status status = baum_i_study_file_measured(c->file, row);
  if (status != BAUM_OK) {
    give_up(c, status);
  }
  report(c);
}

static void measure_row(crew *c, baum_i_row *row, double *samples)
{
  baum_i_watch watch = watch_of(c, 1.0);
  baum_i_lock_take(&c->lock);
  bool passed = is_too_fine(c, row);
  baum_i_lock_give(&c->lock);
  baum_i_outcome outcome = {0};
  if (!passed) {
    const baum_i_task task = {c->study, &row->options, &c->study->reference.course, true};
    baum_i_study_run_one(&task, &watch, samples, &outcome);
  }
  bool stopped = outcome.status == BAUM_STOP_CANCELLED && !watch.timed_out;
  baum_i_lock_take(&c->lock);
  if (outcome.status == BAUM_ERR_MEMORY) {
    give_up(c, baum_i_fail_memory());
  } else if (!stopped) {
    if (passed) {
      pass_over(c, row);
    } else {
      take_outcome(c->study, &outcome, &watch, samples, row);
    }
    finish_row(c, row);
  }
  baum_i_lock_give(&c->lock);
}

/* Memory for the samples of one run, or NULL. */
static double *samples_of(crew *c)
{
  size_t size = (size_t)c->study->reference.course.n * (size_t)baum_i_study_layout(c->study).width;
  double *samples = baum_i_alloc(size, sizeof *samples);
  if (!samples) {
    baum_i_lock_take(&c->lock);
    give_up(c, baum_i_fail_memory());
    baum_i_lock_give(&c->lock);
  }
  return samples;
}

static void measure(void *self, int k)
{
  (void)k;
  crew *c = self;
  double *samples = samples_of(c);
  if (!samples) {
    return;
  }
  baum_i_row *row = NULL;
  while ((row = next_row(c)) != NULL) {
    measure_row(c, row, samples);
  }
  baum_i_free(samples);
}

/* ---- rehearsals ---- */

static void rehearse(void *self, int k)
{
  (void)k;
  crew *c = self;
  double *samples = samples_of(c);
  baum_i_row *row = NULL;
  while (samples && (row = next_row(c)) != NULL) {
    baum_i_watch watch = watch_of(c, REHEARSED_FOR);
    double error = (double)NAN;
    baum_status status = baum_i_study_rehearse(c->study, row, &watch, samples, &error);
    baum_i_lock_take(&c->lock);
    if (status == BAUM_OK && !baum_i_watch_stops(&watch)) {
      row->out.error_rehearsed = error;
      row->rehearsed = true;
      status = baum_i_study_file_rehearsed(c->file, row);
    }
    if (status != BAUM_OK) {
      give_up(c, status);
    }
    baum_i_lock_give(&c->lock);
  }
  baum_i_free(samples);
}

/* Those that are to be rehearsed into the order; returns whether there are some. */
static bool order_rehearsals(crew *c)
{
  const baum_study *study = c->study;
  c->count = c->next = 0;
  for (int k = 0; study->options.rehearse && k < study->row_count; k++) {
    if (baum_i_study_wants_rehearsal(study, study->rows[k])) {
      c->order[c->count++] = study->rows[k];
    }
  }
  return c->count > 0;
}

static void rehearse_all(crew *c)
{
  bool known = c->study->reference.course.rows != NULL;
  if (!known || c->status != BAUM_OK || !order_rehearsals(c)) {
    return;
  }
  baum_i_watch watch = watch_of(c, REHEARSED_FOR);
  baum_status status =
    c->study->rehearsed ? BAUM_OK : baum_i_study_make_rehearsals(c->study, &watch);
  if (status != BAUM_OK) {
    give_up(c, status);
    return;
  }
  run_crew(c, rehearse);
}

/* ---- order ---- */

/* How many rows of its method are coarser. */
static int rank_of(const baum_study *study, const baum_i_row *row)
{
  int rank = 0;
  for (int k = 0; k < study->row_count; k++) {
    const baum_i_row *other = study->rows[k];
    rank += other->out.method == row->out.method &&
            baum_i_setting(&other->options) > baum_i_setting(&row->options);
  }
  return rank;
}

/* A row and its place. */
typedef struct place {
  baum_i_row *row;
  int rank;
  int k;
} place;

static int by_rank(const void *a, const void *b)
{
  const place *x = a;
  const place *y = b;
  return x->rank != y->rank ? (x->rank > y->rank) - (x->rank < y->rank)
                            : (x->k > y->k) - (x->k < y->k);
}

/* Coarse settings first, so that what is known when time is over is something of all methods. */
static baum_status set_order(crew *c)
{
  const baum_study *study = c->study;
  place *places = baum_i_alloc((size_t)study->row_count, sizeof *places);
  if (!places) {
    return baum_i_fail_memory();
  }
  c->count = 0;
  for (int k = 0; k < study->row_count; k++) {
    baum_i_row *row = study->rows[k];
    if (!row->measured) {
      places[c->count++] = (place){row, rank_of(study, row), k};
    } else {
      c->done++;
    }
  }
  qsort(places, (size_t)c->count, sizeof *places, by_rank);
  for (int k = 0; k < c->count; k++) {
    c->order[k] = places[k].row;
  }
  baum_i_free(places);
  return BAUM_OK;
}

/* ---- times ---- */

static void take_times(const baum_i_outcome *first, const double least[2], int repeats,
                       baum_i_row *row)
{
  row->out.evaluations = first->counters.evaluations;
  row->out.factorizations = first->counters.factorizations;
  row->out.work = baum_i_study_work(row);
  row->out.cpu = least[0];
  row->out.cpu_spread = repeats > 1 ? least[1] - least[0] : (double)NAN;
  row->out.repeats = repeats;
  row->timed = true;
}

static baum_status time_row(crew *c, baum_i_row *row)
{
  baum_i_watch watch = watch_of(c, (double)INFINITY);
  const baum_i_task task = {c->study, &row->options, &c->study->reference.course, false};
  baum_i_outcome first = {0};
  double least[2] = {(double)INFINITY, (double)INFINITY};
  double sum = 0.0;
  int repeats = 0;
  while (repeats < c->study->options.repeats && sum < TIMED_FOR) {
    baum_i_outcome outcome;
    baum_i_study_run_one(&task, &watch, NULL, &outcome);
    if (outcome.status < BAUM_OK) {
      return baum_i_fail(outcome.status, "study: %s, when it was timed: %s", row->name,
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
  take_times(&first, least, repeats, row);
  return baum_i_study_file_timed(c->file, row);
}

static void time_rows(crew *c)
{
  const baum_i_watch watch = watch_of(c, 1.0);
  for (int k = 0; k < c->study->row_count && c->status == BAUM_OK; k++) {
    baum_i_row *row = c->study->rows[k];
    if (baum_i_watch_stops(&watch)) {
      return;
    }
    if (row->out.state == BAUM_STUDY_DONE && !row->timed) {
      baum_status status = time_row(c, row);
      if (status != BAUM_OK) {
        give_up(c, status);
      }
    }
    report(c);
  }
}

/* ---- all of it ---- */

/* Rows without a result, or without the time of one. */
static int waiting(const baum_study *study)
{
  int count = 0;
  for (int k = 0; k < study->row_count; k++) {
    const baum_i_row *row = study->rows[k];
    count += !row->measured || (row->out.state == BAUM_STUDY_DONE && !row->timed);
  }
  return count;
}

/* Rows to be measured, or that may have to be rehearsed once they are timed, are compared with it. */
static bool needs_reference(crew *c)
{
  const baum_study *study = c->study;
  for (int k = 0; k < study->row_count; k++) {
    const baum_i_row *row = study->rows[k];
    bool is_timed_first = row->out.state == BAUM_STUDY_DONE && !row->timed && !row->rehearsed;
    if (!row->measured || (study->options.rehearse && is_timed_first)) {
      return true;
    }
  }
  return order_rehearsals(c);
}

static bool wants_check(const baum_study *study)
{
  for (int k = 0; k < study->row_count; k++) {
    if (study->rows[k]->options.check_derivatives) {
      return true;
    }
  }
  return false;
}

static baum_status prepare(crew *c)
{
  baum_study *study = c->study;
  baum_status status = BAUM_OK;
  if (study->reference.known && !needs_reference(c)) {
    return BAUM_OK;
  }
  if (wants_check(study) && !study->reference.known) {
    status = baum_mechanism_check_derivatives(study->mechanism);
  }
  bool was_known = study->reference.known;
  baum_i_watch watch = watch_of(c, 1.0);
  if (status == BAUM_OK) {
    status = baum_i_study_make_reference(study, &watch);
  }
  return status == BAUM_OK && !was_known ? baum_i_study_file_reference(c->file, study) : status;
}

static void run_rows(crew *c)
{
  if (!baum_i_lock_make(&c->lock)) {
    give_up(c, baum_i_fail_memory());
    return;
  }
  run_crew(c, measure);
  time_rows(c);
  rehearse_all(c);
  baum_i_lock_end(&c->lock);
}

static baum_status conclude(crew *c)
{
  const baum_study *study = c->study;
  if (c->status != BAUM_OK) {
    return baum_i_fail(c->status, "%s", c->sentence.text);
  }
  int left = waiting(study);
  if (left > 0) {
    bool cancelled = atomic_load(&study->cancelled) != 0;
    return baum_i_fail(BAUM_STOP_CANCELLED, "study: %s with %d of %d rows not done and timed",
                       cancelled ? "cancelled" : "the time budget is spent", left,
                       study->row_count);
  }
  return study->reference.out.trusted
           ? BAUM_OK
           : baum_i_fail(BAUM_WARNED, "study: the reference: %s", study->reference.text);
}

/* Memory, samples, file and reference, then all rows. */
static baum_status run_all(crew *c)
{
  baum_study *study = c->study;
  c->order = baum_i_alloc((size_t)study->row_count, sizeof(baum_i_row *));
  baum_status status = c->order ? baum_i_study_set_times(study) : baum_i_fail_memory();
  if (status == BAUM_OK) {
    status = baum_i_study_file_open(study, &c->file);
  }
  if (status == BAUM_OK) {
    study->begun = true;
    status = prepare(c);
  }
  if (status == BAUM_OK) {
    status = set_order(c);
  }
  if (status == BAUM_OK) {
    run_rows(c);
  }
  return status == BAUM_OK || status == BAUM_STOP_CANCELLED ? conclude(c) : status;
}

baum_status baum_study_run(baum_study *study)
{
  if (!study) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "baum_study_run: the study is NULL");
  }
  if (study->row_count == 0) {
    return baum_i_fail(BAUM_ERR_STATE, "baum_study_run: there are no rows; add settings");
  }
  baum_status status = baum_i_study_check_idle(study, "baum_study_run");
  if (status != BAUM_OK) {
    return status;
  }
  study->running = true;
  crew c = {.study = study, .deadline = baum_i_wall_seconds() + study->options.time_budget};
  status = run_all(&c);
  baum_status closed = baum_i_study_file_close(c.file);
  baum_i_free(c.order);
  atomic_store(&study->cancelled, 0);
  study->running = false;
  return closed != BAUM_OK && (status == BAUM_OK || status == BAUM_WARNED) ? closed : status;
}
