/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes a study as JSON (RFC 8259). The names of keys never change. If a key gets another meaning,
 * the number "version" increases. */
#include <math.h>

#include "study/report.h"

enum { VERSION = 2 };

/* Appends a key. A comma precedes it unless the text ends with the opening brace of the object. */
static void put_key(baum_i_buffer *out, const char *key)
{
  bool first = out->used > 0 && out->text[out->used - 1] == '{';
  baum_i_putf(out, "%s\"%s\": ", first ? "" : ", ", key);
}

static void put_text(baum_i_buffer *out, const char *key, const char *text)
{
  put_key(out, key);
  baum_i_put(out, text ? "\"" : "null");
  if (text) {
    baum_i_put_user_text(out, text, BAUM_I_JSON);
    baum_i_put(out, "\"");
  }
}

static void put_number(baum_i_buffer *out, const char *key, double x)
{
  put_key(out, key);
  baum_i_put(out, baum_i_exact(x, "null").text);
}

static void put_fields(baum_i_buffer *out, const baum_i_field *fields, const void *object)
{
  for (const baum_i_field *f = fields; f->key; f++) {
    if (f->kind <= BAUM_I_LAST_TEXT) {
      put_text(out, f->key, baum_i_field_text(f, object));
    } else if (f->kind == BAUM_I_FLAG) {
      put_key(out, f->key);
      baum_i_put(out, baum_i_field_whole(f, object) ? "true" : "false");
    } else {
      put_number(out, f->key, baum_i_field_number(f, object));
    }
  }
}

static void put_heading(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  const baum_i_environment *e = &snapshot->environment;
  baum_i_put(out, "{\"report\": \"baum study\"");
  put_number(out, "version", VERSION);
  baum_i_put(out, ",\n\"environment\": {");
  put_text(out, "baum", e->baum);
  put_text(out, "sundials", e->sundials);
  put_text(out, "compiler", e->compiler);
  put_text(out, "cpu", e->cpu);
  put_text(out, "date", e->date);
  baum_i_put(out, "},\n\"study\": {");
  put_text(out, "title", snapshot->title);
  put_number(out, "t0", snapshot->t0);
  put_number(out, "t1", snapshot->t1);
  put_text(out, "error", snapshot->error);
  put_number(out, "samples", snapshot->options.samples);
  put_number(out, "repeats", snapshot->options.repeats);
  put_number(out, "entry_limit", snapshot->options.entry_limit);
}

/* Appends an object with the unit of every key that has one. */
static void put_units(baum_i_buffer *out)
{
  const baum_i_field *const lists[] = {baum_i_entry_fields, baum_i_method_fields,
                                       baum_i_reference_fields};
  put_text(out, "t0", "s");
  put_text(out, "t1", "s");
  put_text(out, "entry_limit", "s");
  for (size_t k = 0; k < sizeof lists / sizeof lists[0]; k++) {
    for (const baum_i_field *f = lists[k]; f->key; f++) {
      if (f->unit[0]) {
        put_text(out, f->key, f->unit);
      }
    }
  }
}

/* Appends an object with the meaning of every key of an entry. */
static void put_meanings(baum_i_buffer *out)
{
  for (const baum_i_field *f = baum_i_entry_fields; f->key; f++) {
    if (f->meaning[0]) {
      put_text(out, f->key, f->meaning);
    }
  }
}

static void put_advice(const baum_i_advice *advice, baum_study_cost cost, baum_i_buffer *out)
{
  bool known = advice->status >= BAUM_OK;
  const double none = (double)NAN;
  const baum_simulation_options *o = &advice->options;
  put_text(out, "cost", cost == BAUM_STUDY_WORK ? "work" : "cpu");
  put_number(out, "error", advice->error);
  put_text(out, "status", baum_status_name(advice->status));
  put_text(out, "setting", known ? advice->setting.text : NULL);
  put_text(out, "integrator", known ? baum_integrator_name(o->integrator) : NULL);
  put_text(out, "formulation", known ? baum_formulation_name(o->formulation) : NULL);
  put_number(out, "step", known ? o->step : none);
  put_number(out, "rtol", known ? o->rtol : none);
  put_text(out, "why", advice->why);
}

static void put_front(const baum_i_snapshot *snapshot, baum_study_cost cost, baum_i_buffer *out)
{
  for (int k = 0; k < snapshot->front_count[cost]; k++) {
    baum_i_putf(out, "%s%d", k ? ", " : "", (int)snapshot->front[cost][k]);
  }
}

void baum_i_report_json(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  static const char *const ORIGINS[] = {"own", "given", "solution"};
  put_heading(snapshot, out);
  baum_i_put(out, "},\n\"reference\": {");
  put_text(out, "origin", ORIGINS[snapshot->reference.origin]);
  put_fields(out, baum_i_reference_fields, &snapshot->reference);
  baum_i_put(out, "},\n\"units\": {");
  put_units(out);
  baum_i_put(out, "},\n\"meanings\": {");
  put_meanings(out);
  baum_i_put(out, "},\n\"recommendations\": [");
  for (int k = 0; k < BAUM_I_COSTS * BAUM_I_ADVICE; k++) {
    baum_study_cost cost = (baum_study_cost)(k / BAUM_I_ADVICE);
    baum_i_put(out, k ? "},\n  {" : "\n  {");
    put_advice(&snapshot->advice[cost][k % BAUM_I_ADVICE], cost, out);
  }
  baum_i_put(out, "}],\n\"front\": {\"work\": [");
  put_front(snapshot, BAUM_STUDY_WORK, out);
  baum_i_put(out, "], \"cpu\": [");
  put_front(snapshot, BAUM_STUDY_CPU, out);
  baum_i_put(out, "]},\n\"methods\": [");
  for (int k = 0; k < snapshot->method_count; k++) {
    baum_i_put(out, k ? ",\n  {" : "\n  {");
    put_fields(out, baum_i_method_fields, &snapshot->methods[k]);
    put_text(out, "label", snapshot->methods[k].label);
    baum_i_put(out, "}");
  }
  baum_i_put(out, "],\n\"entries\": [");
  for (int k = 0; k < snapshot->entry_count; k++) {
    baum_i_put(out, k ? ",\n  {" : "\n  {");
    put_fields(out, baum_i_entry_fields, &snapshot->entries[k]);
    baum_i_put(out, "}");
  }
  baum_i_put(out, "]}\n");
}
