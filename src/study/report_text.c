/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes a study as text: the recommendations, the Pareto front, the cost of accuracy, all entries,
 * and messages. */
#include <math.h>
#include <string.h>

#include "study/report.h"

/* Returns the width of the column of names, which fits the longest name and the title of the
 * column. */
static int name_width(const baum_i_snapshot *snapshot)
{
  int width = baum_i_length("setting");
  for (int k = 0; k < snapshot->entry_count; k++) {
    int length = baum_i_length(snapshot->entries[k].entry.name);
    width = length > width ? length : width;
  }
  return width;
}

/* Counts the entries that are in a given state. */
static int count_in(const baum_i_snapshot *snapshot, baum_study_state state)
{
  int count = 0;
  for (int k = 0; k < snapshot->entry_count; k++) {
    count += snapshot->entries[k].entry.state == state;
  }
  return count;
}

static void put_heading(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  const baum_i_environment *e = &snapshot->environment;
  const baum_study_reference *r = &snapshot->reference;
  baum_i_put_user_text(out, snapshot->title, BAUM_I_PLAIN);
  baum_i_putf(out, "\nspan       %s s to %s s, %d samples\n", baum_i_short(snapshot->t0, 6).text,
              baum_i_short(snapshot->t1, 6).text,
              (int)(r->samples ? r->samples : snapshot->options.samples));
  baum_i_putf(out, "settings   %d", snapshot->entry_count);
  for (int s = BAUM_STUDY_WAITING; s <= BAUM_STUDY_TIMED_OUT; s++) {
    int count = count_in(snapshot, (baum_study_state)s);
    if (count > 0) {
      baum_i_putf(out, ", %d %s", count, baum_study_state_name((baum_study_state)s));
    }
  }
  baum_i_putf(out, "\nerror      %s\n", snapshot->error);
  baum_i_putf(out, "reference  %s digits%s; %s\n",
              baum_i_short(r->digits < 0.0 ? 0.0 : r->digits, 3).text,
              r->trusted ? "" : ", NOT TRUSTED", r->text ? r->text : "not made");
  baum_i_putf(out, "made by    baum %s, SUNDIALS %s, %s, %s, %s\n", e->baum, e->sundials,
              e->compiler, e->cpu, e->date);
}

static void put_advice(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  baum_i_put(out, "\nRecommended settings by error, cheapest by work\n");
  for (int k = 0; k < BAUM_I_ADVICE; k++) {
    const baum_i_advice *advice = &snapshot->advice[BAUM_STUDY_WORK][k];
    baum_i_putf(out, "%7.0e  ", advice->error);
    baum_i_put_user_text(out, advice->why, BAUM_I_PLAIN);
    baum_i_put(out, "\n");
  }
}

/* Appends a number with `digits` digits, in a column of `width` characters. */
static void put_figure(baum_i_buffer *out, double x, int digits, int width)
{
  baum_i_putf(out, "  %*s", width, baum_i_short(x, digits).text);
}

/* One column in the tables of entries. */
typedef struct text_column {
  const char *key;
  const char *title;
  int width;
  int digits;
  double times;
} text_column;

static const text_column COLUMNS[] = {
  {"error", "error", 7, 2, 1.0},
  {"work", "work", 8, 4, 1.0},
  {"cpu", "CPU [ms]", 8, 3, 1e3},
  {"error_v", "error v", 7, 2, 1.0},
  {"max_phi", "|Phi|", 7, 2, 1.0},
  {"max_phi_rate", "|Phi'|", 7, 2, 1.0},
  {"energy_error", "energy [J]", 10, 2, 1.0},
  {"steps", "steps", 9, 9, 1.0},
  {"rejected", "rejected", 8, 8, 1.0},
  {"evaluations", "evals", 9, 9, 1.0},
  {"factorizations", "factor.", 9, 9, 1.0},
};
enum { COLUMN_COUNT = sizeof COLUMNS / sizeof COLUMNS[0] };

static void put_titles(int width, baum_i_buffer *out)
{
  baum_i_put_left(out, "setting", width);
  for (int c = 0; c < COLUMN_COUNT; c++) {
    baum_i_putf(out, "  %*s", COLUMNS[c].width, COLUMNS[c].title);
  }
  baum_i_put(out, "  remarks\n");
}

static double value_of(const baum_i_report_entry *entry, const char *key)
{
  const baum_i_field *field = baum_i_entry_fields;
  while (strcmp(field->key, key) != 0) {
    field++;
  }
  return baum_i_field_number(field, entry);
}

static void put_remarks(const baum_i_report_entry *entry, baum_i_buffer *out)
{
  const baum_study_entry *e = &entry->entry;
  const struct {
    bool holds;
    const char *text;
  } remarks[] = {
    {e->state != BAUM_STUDY_DONE, baum_study_state_name(e->state)},
    {entry->front[BAUM_STUDY_WORK], "front"},
    {entry->front[BAUM_STUDY_CPU], "front by CPU"},
    {e->at_floor, "floor"},
    {e->off, "off"},
    {e->unstable, "unstable"},
    {e->untrusted, "untrusted"},
  };
  const char *gap = "  ";
  for (size_t k = 0; k < sizeof remarks / sizeof remarks[0]; k++) {
    if (remarks[k].holds) {
      baum_i_putf(out, "%s%s", gap, remarks[k].text);
      gap = ", ";
    }
  }
}

static void put_entry(const baum_i_report_entry *entry, int width, baum_i_buffer *out)
{
  baum_i_put_left(out, entry->entry.name, width);
  for (int c = 0; c < COLUMN_COUNT; c++) {
    double x = COLUMNS[c].times * value_of(entry, COLUMNS[c].key);
    put_figure(out, x, COLUMNS[c].digits, COLUMNS[c].width);
  }
  put_remarks(entry, out);
  baum_i_put(out, "\n");
}

static void put_front(const baum_i_snapshot *snapshot, int width, baum_i_buffer *out)
{
  baum_i_put(out, "\nThe Pareto front by work, from cheap to exact\n");
  put_titles(width, out);
  for (int k = 0; k < snapshot->front_count[BAUM_STUDY_WORK]; k++) {
    put_entry(&snapshot->entries[snapshot->front[BAUM_STUDY_WORK][k]], width, out);
  }
}

static void put_methods(const baum_i_snapshot *snapshot, int width, baum_i_buffer *out)
{
  baum_i_put(out, "\nMethods, with the factors by which one more digit increases their cost\n");
  baum_i_put_left(out, "method", width);
  baum_i_put(out, "  settings  usable  least error   slope     work      CPU  growth\n");
  for (int k = 0; k < snapshot->method_count; k++) {
    const baum_study_method *m = &snapshot->methods[k].method;
    baum_i_put_left(out, snapshot->methods[k].label, width);
    put_figure(out, m->entries, 8, 8);
    put_figure(out, m->usable, 6, 6);
    put_figure(out, m->least_error, 2, 11);
    put_figure(out, m->slope, 2, 6);
    put_figure(out, m->work_per_digit, 3, 7);
    put_figure(out, m->cpu_per_digit, 3, 7);
    put_figure(out, m->growth, 2, 6);
    baum_i_put(out, "\n");
  }
}

static void put_messages(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  baum_i_put(out, "\nFailures and warnings\n");
  for (int k = 0; k < snapshot->entry_count; k++) {
    const baum_study_entry *entry = &snapshot->entries[k].entry;
    if (entry->message[0]) {
      baum_i_putf(out, "%s: %s: ", entry->name, baum_study_state_name(entry->state));
      baum_i_put_user_text(out, entry->message, BAUM_I_PLAIN);
      baum_i_put(out, "\n");
    }
  }
}

void baum_i_report_text(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  int width = name_width(snapshot);
  put_heading(snapshot, out);
  put_advice(snapshot, out);
  put_front(snapshot, width, out);
  put_methods(snapshot, width, out);
  baum_i_put(out, "\nAll settings, in the order of adding\n");
  put_titles(width, out);
  for (int k = 0; k < snapshot->entry_count; k++) {
    put_entry(&snapshot->entries[k], width, out);
  }
  put_messages(snapshot, out);
  baum_i_put(
    out, "\nfront: no setting is both cheaper and more exact.  floor: its error is at the "
         "uncertainty of the reference.\noff: it followed another motion, with an error above 0.1 "
         "of the scale or on another branch.  unstable: its gains do not damp violations with this "
         "step.\n");
}
