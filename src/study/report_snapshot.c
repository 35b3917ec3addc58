/* SPDX-License-Identifier: BSD-3-Clause */
/* Reads all data of a report from a study, through its public interface. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "study/report.h"
#include "study/study.h"

static const double WANTED[BAUM_I_ADVICE] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10};

const char *baum_i_gain_rule_name(int rule)
{
  static const char *const NAMES[] = {"default",   "fixed",     "scaled", "taylor",
                                      "frequency", "dead_beat", "auto",   "best_damping"};
  int count = (int)(sizeof NAMES / sizeof NAMES[0]);
  return rule >= 0 && rule < count ? NAMES[rule] : NULL;
}

static bool has_numbers(int32_t rule)
{
  return rule == BAUM_GAINS_FIXED || rule == BAUM_GAINS_SCALED || rule == BAUM_GAINS_FREQUENCY;
}

static baum_status read_entries(baum_i_snapshot *out)
{
  out->entry_count = baum_study_entry_count(out->study);
  out->entries = baum_i_alloc((size_t)out->entry_count, sizeof *out->entries);
  BAUM_I_TRY(baum_i_check_memory(out->entries));
  for (int k = 0; k < out->entry_count; k++) {
    baum_i_report_entry *entry = &out->entries[k];
    BAUM_I_TRY(baum_study_entry_at(out->study, k, &entry->entry, sizeof entry->entry));
    const baum_gains *gains = &entry->entry.gains;
    bool has_gains = entry->entry.formulation == BAUM_FORMULATION_BAUMGARTE;
    bool is_known = has_gains && has_numbers(gains->rule);
    entry->gains = has_gains ? baum_i_gain_rule_name(gains->rule) : NULL;
    entry->gain[0] = is_known ? gains->value[0] : (double)NAN;
    entry->gain[1] = is_known ? gains->value[1] : (double)NAN;
  }
  return BAUM_OK;
}

static baum_status read_methods(baum_i_snapshot *out)
{
  out->method_count = baum_study_method_count(out->study);
  out->methods = baum_i_alloc((size_t)out->method_count, sizeof *out->methods);
  BAUM_I_TRY(baum_i_check_memory(out->methods));
  for (int k = 0; k < out->method_count; k++) {
    baum_i_report_method *m = &out->methods[k];
    BAUM_I_TRY(baum_study_method_at(out->study, k, &m->method, sizeof m->method));
    const baum_integrator *integrator = m->method.integrator;
    bool either =
      baum_integrator_has_fixed_step(integrator) && baum_integrator_has_variable_step(integrator);
    (void)snprintf(m->label, sizeof m->label, "%s%s", m->method.name,
                   !either                ? ""
                   : m->method.fixed_step ? ", by step"
                                          : ", by rtol");
  }
  return BAUM_OK;
}

static baum_status read_front(baum_i_snapshot *out, baum_study_cost cost)
{
  int32_t *count = &out->front_count[cost];
  out->front[cost] = baum_i_alloc((size_t)out->entry_count, sizeof *out->front[cost]);
  BAUM_I_TRY(baum_i_check_memory(out->front[cost]));
  BAUM_I_TRY(baum_study_front(out->study, cost, out->entry_count, out->front[cost], count));
  for (int k = 0; k < *count; k++) {
    out->entries[out->front[cost][k]].front[cost] = true;
  }
  return BAUM_OK;
}

/* The name of the function at the start of a message does not help the reader of a report. */
static const char *without_call(const char *message)
{
  const char *colon = strstr(message, ": ");
  return colon ? colon + 2 : message;
}

static void read_advice(const baum_study *study, baum_study_cost cost, baum_i_advice *out)
{
  out->status = baum_study_recommend(study, out->error, cost, &out->options, sizeof out->options,
                                     out->why, sizeof out->why);
  if (out->status < BAUM_OK) {
    (void)snprintf(out->why, sizeof out->why, "%s", without_call(baum_message()));
    return;
  }
  out->setting = baum_i_options_name(&out->options);
}

static baum_status read_answers(baum_i_snapshot *out)
{
  baum_status status = BAUM_OK;
  baum_i_kept_message kept = baum_i_message_keep();
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
  BAUM_I_TRY(baum_study_settings(study, &out->t0, &out->t1, &out->options, sizeof out->options));
  BAUM_I_TRY(baum_study_reference_read(study, &out->reference, sizeof out->reference));
  BAUM_I_TRY(read_entries(out));
  BAUM_I_TRY(read_methods(out));
  return read_answers(out);
}

void baum_i_snapshot_clear(baum_i_snapshot *snapshot)
{
  baum_i_free(snapshot->entries);
  baum_i_free(snapshot->methods);
  baum_i_free(snapshot->front[0]);
  baum_i_free(snapshot->front[1]);
}
