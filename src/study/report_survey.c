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

static void describe(baum_i_report_row *row)
{
  bool has_gains = row->row.formulation == BAUM_FORMULATION_BAUMGARTE;
  row->integrator = baum_integrator_name(row->row.integrator);
  row->formulation = baum_formulation_name(row->row.formulation);
  row->gains = has_gains ? rule_name(&row->row.gains) : NULL;
  for (int k = 0; k < 2; k++) {
    bool known = has_gains && has_numbers(row->row.gains.rule);
    row->gain[k] = known ? row->row.gains.value[k] : (double)NAN;
  }
  row->state = baum_study_state_name(row->row.state);
  bool is_run = row->row.state != BAUM_STUDY_WAITING;
  row->status = is_run ? baum_status_name(row->row.status) : NULL;
  row->message = row->row.message && row->row.message[0] ? row->row.message : NULL;
}

static baum_status read_rows(baum_i_snapshot *out)
{
  out->row_count = baum_study_row_count(out->study);
  out->rows = baum_i_alloc((size_t)out->row_count, sizeof *out->rows);
  if (!out->rows) {
    return baum_i_fail_memory();
  }
  baum_status status = BAUM_OK;
  for (int k = 0; k < out->row_count && status == BAUM_OK; k++) {
    baum_study_row *row = &out->rows[k].row;
    status = baum_study_row_at(out->study, k, row, sizeof *row);
    describe(&out->rows[k]);
  }
  return status;
}

static const baum_i_report_row *row_of(const void *entry)
{
  return *(const baum_i_report_row *const *)entry;
}

/* A method has rows of steps alone or of tolerances alone. */
static int by_method(const void *a, const void *b)
{
  const baum_study_row *x = &row_of(a)->row;
  const baum_study_row *y = &row_of(b)->row;
  if (x->method != y->method) {
    return x->method < y->method ? -1 : 1;
  }
  double coarse = isnan(x->step) ? x->rtol : x->step;
  double fine = isnan(y->step) ? y->rtol : y->step;
  return (coarse < fine) - (coarse > fine);
}

static baum_status order_rows(baum_i_snapshot *out)
{
  out->order = baum_i_alloc((size_t)out->row_count, sizeof(const baum_i_report_row *));
  if (!out->order) {
    return baum_i_fail_memory();
  }
  for (int k = 0; k < out->row_count; k++) {
    out->order[k] = &out->rows[k];
  }
  qsort(out->order, (size_t)out->row_count, sizeof(const baum_i_report_row *), by_method);
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
  out->front[cost] = baum_i_alloc((size_t)out->row_count, sizeof *out->front[cost]);
  if (!out->front[cost]) {
    return baum_i_fail_memory();
  }
  baum_status status = baum_study_front(out->study, cost, out->row_count, out->front[cost], count);
  for (int k = 0; k < *count && status == BAUM_OK; k++) {
    out->rows[out->front[cost][k]].front[cost] = true;
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
    status = read_rows(out);
  }
  if (status == BAUM_OK) {
    status = order_rows(out);
  }
  if (status == BAUM_OK) {
    status = read_methods(out);
  }
  return status == BAUM_OK ? read_answers(out) : status;
}

void baum_i_snapshot_clear(baum_i_snapshot *survey)
{
  baum_i_free(survey->rows);
  baum_i_free(survey->order);
  baum_i_free(survey->methods);
  baum_i_free(survey->front[0]);
  baum_i_free(survey->front[1]);
}

int baum_i_snapshot_count(const baum_i_snapshot *survey, baum_study_state state)
{
  int count = 0;
  for (int k = 0; k < survey->row_count; k++) {
    count += survey->rows[k].row.state == state;
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
