/* SPDX-License-Identifier: BSD-3-Clause */
/* A study for programs (RFC 8259). Keys stay as they are; "version" counts changes of meaning. */
#include <math.h>

#include "study/report.h"

enum { VERSION = 1 };

/* The beginning of a member, which comes after others or is the first. */
static void put_key(baum_i_buffer *out, const char *key, bool first)
{
  baum_i_putf(out, "%s\"%s\": ", first ? "" : ", ", key);
}

static void put_text(baum_i_buffer *out, const char *key, const char *text, bool first)
{
  put_key(out, key, first);
  if (text) {
    baum_i_put(out, "\"");
    baum_i_put_json(out, text);
    baum_i_put(out, "\"");
  } else {
    baum_i_put(out, "null");
  }
}

static void put_number(baum_i_buffer *out, const char *key, double x, bool first)
{
  put_key(out, key, first);
  baum_i_put(out, baum_i_exact(x, "null").text);
}

static void put_flag(baum_i_buffer *out, const char *key, bool flag)
{
  put_key(out, key, false);
  baum_i_put(out, flag ? "true" : "false");
}

static void put_heading(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  const baum_i_environment *e = &snapshot->environment;
  baum_i_put(out, "{\"report\": \"baum study\"");
  put_number(out, "version", VERSION, false);
  baum_i_put(out, ",\n\"environment\": {");
  put_text(out, "baum", e->baum, true);
  put_text(out, "sundials", e->sundials, false);
  put_text(out, "compiler", e->compiler, false);
  put_text(out, "cpu", e->cpu, false);
  put_text(out, "date", e->date, false);
  baum_i_put(out, "},\n\"study\": {");
  put_text(out, "title", snapshot->title, true);
  put_number(out, "t0", snapshot->t0, false);
  put_number(out, "t1", snapshot->t1, false);
  put_text(out, "error", snapshot->error, false);
  put_number(out, "samples", snapshot->options.samples, false);
  put_number(out, "repeats", snapshot->options.repeats, false);
  put_number(out, "entry_limit", snapshot->options.entry_limit, false);
}

static void put_reference(const baum_study_reference *r, baum_i_buffer *out)
{
  static const char *const ORIGINS[] = {"own", "given", "solution"};
  baum_i_put(out, "},\n\"reference\": {");
  put_text(out, "origin", ORIGINS[r->origin], true);
  put_flag(out, "trusted", r->trusted);
  put_number(out, "digits", r->digits, false);
  put_number(out, "samples", r->samples, false);
  put_number(out, "uncertainty", r->uncertainty, false);
  put_number(out, "uncertainty_q", r->uncertainty_q, false);
  put_number(out, "uncertainty_v", r->uncertainty_v, false);
  put_number(out, "uncertainty_lambda", r->uncertainty_lambda, false);
  put_number(out, "uncertainty_energy", r->uncertainty_energy, false);
  put_text(out, "text", r->text, false);
}

/* Of every key whose value has one; what is no number of entries is named here. */
static void put_units(baum_i_buffer *out)
{
  static const char *const OTHERS[][2] = {
    {"t0", "s"},           {"t1", "s"},          {"entry_limit", "s"},
    {"digits", "1"},       {"uncertainty", "1"}, {"uncertainty_energy", "J"},
    {"least_error", "1"},  {"slope", "1"},       {"work_per_digit", "1"},
    {"cpu_per_digit", "1"}};
  baum_i_put(out, "},\n\"units\": {");
  bool first = true;
  for (int c = 0; c < baum_i_column_count; c++) {
    if (baum_i_columns[c].unit[0]) {
      put_text(out, baum_i_columns[c].key, baum_i_columns[c].unit, first);
      first = false;
    }
  }
  for (size_t k = 0; k < sizeof OTHERS / sizeof OTHERS[0]; k++) {
    put_text(out, OTHERS[k][0], OTHERS[k][1], false);
  }
}

static void put_entry(const baum_i_report_entry *entry, baum_i_buffer *out)
{
  for (int c = 0; c < baum_i_column_count; c++) {
    const baum_i_column *column = &baum_i_columns[c];
    if (column->kind == BAUM_I_COLUMN_TEXT) {
      put_text(out, column->key, baum_i_column_text(column, entry), c == 0);
    } else if (column->kind == BAUM_I_COLUMN_FLAG) {
      put_flag(out, column->key, baum_i_column_number(column, entry) != 0.0);
    } else {
      put_number(out, column->key, baum_i_column_number(column, entry), c == 0);
    }
  }
}

static void put_method(const baum_study_method *method, baum_i_buffer *out)
{
  put_text(out, "name", method->name, true);
  put_text(out, "integrator", baum_integrator_name(method->integrator), false);
  put_text(out, "formulation", baum_formulation_name(method->formulation), false);
  put_flag(out, "fixed_step", method->fixed_step);
  put_number(out, "entries", method->entries, false);
  put_number(out, "usable", method->usable, false);
  put_number(out, "least_error", method->least_error, false);
  put_number(out, "slope", method->slope, false);
  put_number(out, "work_per_digit", method->work_per_digit, false);
  put_number(out, "cpu_per_digit", method->cpu_per_digit, false);
  put_number(out, "growth", method->growth, false);
}

static void put_advice(const baum_i_advice *advice, baum_study_cost cost, baum_i_buffer *out)
{
  bool known = advice->status >= BAUM_OK;
  const double none = (double)NAN;
  const baum_simulation_options *o = &advice->options;
  put_text(out, "cost", cost == BAUM_STUDY_WORK ? "work" : "cpu", true);
  put_number(out, "error", advice->error, false);
  put_text(out, "status", baum_status_name(advice->status), false);
  put_text(out, "setting", known ? advice->setting : NULL, false);
  put_text(out, "integrator", known ? baum_integrator_name(o->integrator) : NULL, false);
  put_text(out, "formulation", known ? baum_formulation_name(o->formulation) : NULL, false);
  put_number(out, "step", known ? o->step : none, false);
  put_number(out, "rtol", known ? o->rtol : none, false);
  put_text(out, "why", advice->why, false);
}

static void put_front(const baum_i_snapshot *snapshot, baum_study_cost cost, baum_i_buffer *out)
{
  for (int k = 0; k < snapshot->front_count[cost]; k++) {
    baum_i_putf(out, "%s%d", k ? ", " : "", (int)snapshot->front[cost][k]);
  }
}

void baum_i_report_json(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  put_heading(snapshot, out);
  put_reference(&snapshot->reference, out);
  put_units(out);
  baum_i_put(out, "},\n\"recommendations\": [");
  for (int k = 0; k < BAUM_I_COSTS * BAUM_I_ADVICE; k++) {
    baum_study_cost cost = (baum_study_cost)(k / BAUM_I_ADVICE);
    baum_i_putf(out, "%s{", k ? "},\n  " : "\n  ");
    put_advice(&snapshot->advice[cost][k % BAUM_I_ADVICE], cost, out);
  }
  baum_i_put(out, "}],\n\"front\": {\"work\": [");
  put_front(snapshot, BAUM_STUDY_WORK, out);
  baum_i_put(out, "], \"cpu\": [");
  put_front(snapshot, BAUM_STUDY_CPU, out);
  baum_i_put(out, "]},\n\"methods\": [");
  for (int k = 0; k < snapshot->method_count; k++) {
    baum_i_put(out, k ? ",\n  {" : "\n  {");
    put_method(&snapshot->methods[k], out);
    baum_i_put(out, "}");
  }
  baum_i_put(out, "],\n\"entries\": [");
  for (int k = 0; k < snapshot->entry_count; k++) {
    baum_i_put(out, k ? ",\n  {" : "\n  {");
    put_entry(&snapshot->entries[k], out);
    baum_i_put(out, "}");
  }
  baum_i_put(out, "]}\n");
}
