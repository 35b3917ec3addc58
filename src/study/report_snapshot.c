/* SPDX-License-Identifier: BSD-3-Clause */
/* Reading a study for a report, through its public interface. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "base/text.h"
#include "study/report.h"
#include "study/study.h"

static const double WANTED[BAUM_I_ADVICE] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10};

static const char *rule_name(const baum_gains *gains)
{
  static const char *const NAMES[] = {"default",   "fixed",     "scaled", "taylor",
                                      "frequency", "dead_beat", "auto",   "best_damping"};
  int count = (int)(sizeof NAMES / sizeof NAMES[0]);
  return gains->rule >= 0 && gains->rule < count ? NAMES[gains->rule] : NULL;
}

static bool has_numbers(int32_t rule)
{
  return rule == BAUM_GAINS_FIXED || rule == BAUM_GAINS_SCALED || rule == BAUM_GAINS_FREQUENCY;
}

static void describe(baum_i_report_entry *entry)
{
  bool has_gains = entry->entry.formulation == BAUM_FORMULATION_BAUMGARTE;
  entry->integrator = baum_integrator_name(entry->entry.integrator);
  entry->formulation = baum_formulation_name(entry->entry.formulation);
  entry->gains = has_gains ? rule_name(&entry->entry.gains) : NULL;
  for (int k = 0; k < 2; k++) {
    bool known = has_gains && has_numbers(entry->entry.gains.rule);
    entry->gain[k] = known ? entry->entry.gains.value[k] : (double)NAN;
  }
  entry->state = baum_study_state_name(entry->entry.state);
  bool is_run = entry->entry.state != BAUM_STUDY_WAITING;
  entry->status = is_run ? baum_status_name(entry->entry.status) : NULL;
  entry->message = entry->entry.message && entry->entry.message[0] ? entry->entry.message : NULL;
}

static baum_status read_entries(baum_i_snapshot *out)
{
  out->entry_count = baum_study_entry_count(out->study);
  out->entries = baum_i_alloc((size_t)out->entry_count, sizeof *out->entries);
  if (!out->entries) {
    return baum_i_fail_memory();
  }
  baum_status status = BAUM_OK;
  for (int k = 0; k < out->entry_count && status == BAUM_OK; k++) {
    baum_study_entry *entry = &out->entries[k].entry;
    status = baum_study_entry_at(out->study, k, entry, sizeof *entry);
    describe(&out->entries[k]);
  }
  return status;
}

static const baum_i_report_entry *row_of(const void *entry)
{
  return *(const baum_i_report_entry *const *)entry;
}

/* A method has entries of steps alone or of tolerances alone. */
static int by_method(const void *a, const void *b)
{
  const baum_study_entry *x = &row_of(a)->entry;
  const baum_study_entry *y = &row_of(b)->entry;
  if (x->method != y->method) {
    return x->method < y->method ? -1 : 1;
  }
  double coarse = isnan(x->step) ? x->rtol : x->step;
  double fine = isnan(y->step) ? y->rtol : y->step;
  return (coarse < fine) - (coarse > fine);
}

static baum_status order_entries(baum_i_snapshot *out)
{
  out->order = baum_i_alloc((size_t)out->entry_count, sizeof(const baum_i_report_entry *));
  if (!out->order) {
    return baum_i_fail_memory();
  }
  for (int k = 0; k < out->entry_count; k++) {
    out->order[k] = &out->entries[k];
  }
  qsort(out->order, (size_t)out->entry_count, sizeof(const baum_i_report_entry *), by_method);
  return BAUM_OK;
}

static baum_status read_methods(baum_i_snapshot *out)
{
  out->method_count = baum_study_method_count(out->study);
  out->methods = baum_i_alloc((size_t)out->method_count, sizeof *out->methods);
  if (!out->methods) {
    return baum_i_fail_memory();
  }
  baum_status status = BAUM_OK;
  for (int k = 0; k < out->method_count && status == BAUM_OK; k++) {
    status = baum_study_method_at(out->study, k, &out->methods[k], sizeof out->methods[k]);
  }
  return status;
}

static baum_status read_front(baum_i_snapshot *out, baum_study_cost cost)
{
  int32_t *count = &out->front_count[cost];
  out->front[cost] = baum_i_alloc((size_t)out->entry_count, sizeof *out->front[cost]);
  if (!out->front[cost]) {
    return baum_i_fail_memory();
  }
  baum_status status =
    baum_study_front(out->study, cost, out->entry_count, out->front[cost], count);
  for (int k = 0; k < *count && status == BAUM_OK; k++) {
    out->entries[out->front[cost][k]].front[cost] = true;
  }
  return status;
}

static void read_advice(const baum_study *study, baum_study_cost cost, baum_i_advice *out)
{
  out->status = baum_study_recommend(study, out->error, cost, &out->options, sizeof out->options,
                                     out->why, sizeof out->why);
  if (out->status < BAUM_OK) {
    (void)snprintf(out->why, sizeof out->why, "%s", baum_message());
    return;
  }
  baum_i_name_method(&out->options, out->setting, sizeof out->setting);
  baum_i_name_setting(&out->options, out->setting, sizeof out->setting);
}

static baum_status read_answers(baum_i_snapshot *out)
{
  baum_status status = BAUM_OK;
  baum_i_sentence kept;
  baum_i_message_keep(&kept);
  for (int c = 0; c < BAUM_I_COSTS && status == BAUM_OK; c++) {
    status = read_front(out, (baum_study_cost)c);
    for (int k = 0; k < BAUM_I_ADVICE; k++) {
      out->advice[c][k].error = WANTED[k];
      read_advice(out->study, (baum_study_cost)c, &out->advice[c][k]);
    }
  }
  return baum_i_message_settle(status, &kept);
}

baum_status baum_i_snapshot_read(const baum_study *study, const char *title, baum_i_snapshot *out)
{
  *out = (baum_i_snapshot){.study = study, .title = title ? title : "Study"};
  out->error = baum_study_error_text(study);
  baum_i_environment_read(&out->environment);
  baum_status status =
    baum_study_settings(study, &out->t0, &out->t1, &out->options, sizeof out->options);
  if (status == BAUM_OK) {
    status = baum_study_reference_read(study, &out->reference, sizeof out->reference);
  }
  if (status == BAUM_OK) {
    status = read_entries(out);
  }
  if (status == BAUM_OK) {
    status = order_entries(out);
  }
  if (status == BAUM_OK) {
    status = read_methods(out);
  }
  return status == BAUM_OK ? read_answers(out) : status;
}

void baum_i_snapshot_clear(baum_i_snapshot *snapshot)
{
  baum_i_free(snapshot->entries);
  baum_i_free(snapshot->order);
  baum_i_free(snapshot->methods);
  baum_i_free(snapshot->front[0]);
  baum_i_free(snapshot->front[1]);
}

int baum_i_snapshot_count(const baum_i_snapshot *snapshot, baum_study_state state)
{
  int count = 0;
  for (int k = 0; k < snapshot->entry_count; k++) {
    count += snapshot->entries[k].entry.state == state;
  }
  return count;
}

const char *baum_i_way(const baum_study_method *method)
{
  const baum_integrator *integrator = method->integrator;
  bool either =
    baum_integrator_has_fixed_step(integrator) && baum_integrator_has_variable_step(integrator);
  return !either ? "" : method->fixed_step ? ", by step" : ", by rtol";
}
