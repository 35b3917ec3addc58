/* SPDX-License-Identifier: BSD-3-Clause */
/* A study for a screen: what to take, the front, the price of accuracy, all rows, what was said of them. */
#include <math.h>

#include "study/report.h"

/* Widest name, at least that of a title. */
static int name_width(const baum_i_snapshot *survey)
{
  int width = baum_i_length("setting");
  for (int k = 0; k < survey->row_count; k++) {
    int length = baum_i_length(survey->rows[k].row.name);
    width = length > width ? length : width;
  }
  return width;
}

static void put_heading(const baum_i_snapshot *survey, baum_i_buffer *out)
{
  const baum_i_environment *e = &survey->environment;
  const baum_study_reference *r = &survey->reference;
  baum_i_put_plain(out, survey->title);
  baum_i_putf(out, "\nspan       %s s to %s s, %d samples\n", baum_i_short(survey->t0, 6).text,
              baum_i_short(survey->t1, 6).text,
              (int)(r->samples ? r->samples : survey->options.samples));
  baum_i_putf(out, "settings   %d", survey->row_count);
  for (int s = BAUM_STUDY_WAITING; s <= BAUM_STUDY_TIMED_OUT; s++) {
    int count = baum_i_snapshot_count(survey, (baum_study_state)s);
    if (count > 0) {
      baum_i_putf(out, ", %d %s", count, baum_study_state_name((baum_study_state)s));
    }
  }
  baum_i_putf(out, "\nerror      %s\n", survey->error);
  baum_i_putf(out, "reference  %s digits%s; %s\n", baum_i_short(r->digits, 3).text,
              r->trusted ? "" : ", NOT TO BE TRUSTED", r->text ? r->text : "not made");
  baum_i_putf(out, "made by    baum %s, SUNDIALS %s, %s, %s, %s\n", e->baum, e->sundials,
              e->compiler, e->cpu, e->date);
}

static void put_advice(const baum_i_snapshot *survey, baum_i_buffer *out)
{
  baum_i_put(out, "\nWhat to take for an error, cheapest by work\n");
  for (int k = 0; k < BAUM_I_ADVICE; k++) {
    const baum_i_advice *advice = &survey->advice[BAUM_STUDY_WORK][k];
    baum_i_putf(out, "%7.0e  ", advice->error);
    baum_i_put_plain(out, advice->why);
    baum_i_put(out, "\n");
  }
}

/* A figure of so many digits in a column. */
static void put_figure(baum_i_buffer *out, double x, int digits, int width)
{
  baum_i_putf(out, "  %*s", width, baum_i_short(x, digits).text);
}

/* One column of the tables of rows. */
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

static void put_row(const baum_i_report_row *row, int width, baum_i_buffer *out)
{
  baum_i_put_left(out, row->row.name, width);
  for (int c = 0; c < COLUMN_COUNT; c++) {
    double x = baum_i_column_number(baum_i_column_by_key(COLUMNS[c].key), row);
    put_figure(out, COLUMNS[c].times * x, COLUMNS[c].digits, COLUMNS[c].width);
  }
  const char *gap = "  ";
  if (row->row.state != BAUM_STUDY_DONE) {
    baum_i_putf(out, "%s%s", gap, row->state);
    gap = ", ";
  }
  for (int k = 0; k < BAUM_I_REMARKS; k++) {
    const char *remark = baum_i_remark(row, k);
    if (remark) {
      baum_i_putf(out, "%s%s", gap, remark);
      gap = ", ";
    }
  }
  baum_i_put(out, "\n");
}

static void put_front(const baum_i_snapshot *survey, int width, baum_i_buffer *out)
{
  baum_i_put(out, "\nThe front by work, from cheap to exact\n");
  put_titles(width, out);
  for (int k = 0; k < survey->front_count[BAUM_STUDY_WORK]; k++) {
    put_row(&survey->rows[survey->front[BAUM_STUDY_WORK][k]], width, out);
  }
}

static void put_methods(const baum_i_snapshot *survey, int width, baum_i_buffer *out)
{
  baum_i_put(out, "\nThe price of accuracy: factors on the cost for one more digit\n");
  baum_i_put_left(out, "method", width);
  baum_i_put(out, "  settings  usable  least error   slope     work      CPU  growth\n");
  for (int k = 0; k < survey->method_count; k++) {
    const baum_study_method *m = &survey->methods[k];
    baum_i_put(out, m->name);
    baum_i_put_left(out, baum_i_way(m), width - baum_i_length(m->name));
    put_figure(out, m->rows, 8, 8);
    put_figure(out, m->usable, 6, 6);
    put_figure(out, m->least_error, 2, 11);
    put_figure(out, m->slope, 2, 6);
    put_figure(out, m->work_per_digit, 3, 7);
    put_figure(out, m->cpu_per_digit, 3, 7);
    put_figure(out, m->growth, 2, 6);
    baum_i_put(out, "\n");
  }
}

static void put_messages(const baum_i_snapshot *survey, baum_i_buffer *out)
{
  baum_i_put(out, "\nWhat was said\n");
  for (int k = 0; k < survey->row_count; k++) {
    const baum_i_report_row *row = &survey->rows[k];
    if (row->message) {
      baum_i_putf(out, "%s: %s: ", row->row.name, row->state);
      baum_i_put_plain(out, row->message);
      baum_i_put(out, "\n");
    }
  }
}

void baum_i_report_text(const baum_i_snapshot *survey, baum_i_buffer *out)
{
  int width = name_width(survey);
  put_heading(survey, out);
  put_advice(survey, out);
  put_front(survey, width, out);
  put_methods(survey, width, out);
  baum_i_put(out, "\nAll settings, in the order of adding\n");
  put_titles(width, out);
  for (int k = 0; k < survey->row_count; k++) {
    put_row(&survey->rows[k], width, out);
  }
  put_messages(survey, out);
  baum_i_put(out,
             "\nfront: no setting is both cheaper and more exact.  floor: as good as the reference "
             "can tell.\noff: another motion, an error above 0.1 of the scale or another branch.  "
             "unstable: its gains do not damp with this step.\n");
}
