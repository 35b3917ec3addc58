/* SPDX-License-Identifier: BSD-3-Clause */
/* Tables of the page. A cell with a number has it in data-v, by which the script sorts; empty: not known. */
#include <math.h>
#include <string.h>

#include "study/report.h"

enum { DIGITS = 3, NAMED = 3 /* settings that are named beside what was said of them */ };

/* Numbers have their titles at the right. */
static void put_heading(baum_i_buffer *out, const char *title, const char *meaning, bool of_text)
{
  baum_i_putf(out, "<th scope=\"col\"%s><button type=\"button\" title=\"%s\">%s</button></th>",
              of_text ? " class=\"text\"" : "", meaning, title);
}

static void put_text_cell(baum_i_buffer *out, const char *text)
{
  baum_i_put(out, "<td>");
  baum_i_put_html(out, text ? text : "");
  baum_i_put(out, "</td>");
}

/* Whole numbers as they are. */
static void put_number_cell(baum_i_buffer *out, double x, int digits)
{
  baum_i_putf(out, "<td data-v=\"%s\">%s</td>", baum_i_exact(x, "").text,
              isnan(x) ? "–" : baum_i_short(x, digits).text);
}

/* ---- recommendations ---- */

static void put_choice(const baum_i_advice *advice, baum_i_buffer *out)
{
  if (advice->status < BAUM_OK) {
    baum_i_put(out, "<td class=\"none\">none</td>");
  } else {
    put_text_cell(out, advice->setting);
  }
}

void baum_i_put_advice_table(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  baum_i_put(out, "<section>\n<h2>What to take</h2>\n<p>Work is what was counted, evaluations and "
                  "factorizations together: the same on every machine. CPU time is that of the "
                  "machine named below.</p>\n<div class=\"scroll\" tabindex=\"0\" "
                  "role=\"region\" aria-label=\"recommendations\">\n<table class=\"advice\">\n"
                  "<thead><tr><th scope=\"col\">error</th><th scope=\"col\">cheapest by work</th>"
                  "<th scope=\"col\">by CPU time</th></tr></thead>\n");
  for (int k = 0; k < BAUM_I_ADVICE; k++) {
    const baum_i_advice *work = &snapshot->advice[BAUM_STUDY_WORK][k];
    baum_i_putf(out, "<tbody><tr><th scope=\"rowgroup\" rowspan=\"2\">10<sup>%.0f</sup></th>",
                log10(work->error));
    put_choice(work, out);
    put_choice(&snapshot->advice[BAUM_STUDY_CPU][k], out);
    baum_i_put(out, "</tr>\n<tr><td colspan=\"2\" class=\"why\">");
    baum_i_put_html(out, work->why);
    baum_i_put(out, "</td></tr></tbody>\n");
  }
  baum_i_put(out, "</table></div>\n</section>\n");
}

/* ---- methods ---- */

static void put_method(const baum_study_method *m, int number, int colour, baum_i_buffer *out)
{
  baum_i_putf(out, "<tr data-m=\"%d\"><th scope=\"entry\">", number);
  if (colour >= 0) {
    baum_i_putf(out,
                "<svg viewBox=\"-8 -8 16 16\" aria-hidden=\"true\" class=\"line c%d\">"
                "<use href=\"#k%d\"/></svg>",
                colour, colour);
  }
  baum_i_put_html(out, m->name);
  baum_i_putf(out, "%s</th>", baum_i_way(m));
  put_number_cell(out, m->entries, DIGITS);
  put_number_cell(out, m->usable, DIGITS);
  put_number_cell(out, m->least_error, 2);
  put_number_cell(out, m->slope, 2);
  put_number_cell(out, m->work_per_digit, DIGITS);
  put_number_cell(out, m->cpu_per_digit, DIGITS);
  put_number_cell(out, m->growth, 2);
  baum_i_put(out, "</tr>\n");
}

void baum_i_put_method_table(const baum_i_snapshot *snapshot, const baum_i_highlights *highlights,
                             baum_i_buffer *out)
{
  baum_i_put(out,
             "<section>\n<h2>The price of accuracy</h2>\n<p>How an error falls with step or rtol, "
             "and the factor on the cost of one more digit.</p>\n"
             "<div class=\"scroll tall\" tabindex=\"0\" role=\"region\" aria-label=\"methods\">\n"
             "<table class=\"sortable\" id=\"methods\">\n<thead><tr>");
  put_heading(out, "method", "integrator, formulation and gains", true);
  put_heading(out, "settings", "in the study", false);
  put_heading(out, "usable", "done, and of the same motion", false);
  put_heading(out, "least error", "that it reaches", false);
  put_heading(out, "slope", "d log error / d log step or rtol", false);
  put_heading(out, "× work", "for one more digit", false);
  put_heading(out, "× CPU", "for one more digit", false);
  put_heading(out, "growth",
              "of the error over twice the span and from starts nearby; infinite: it fails there",
              false);
  baum_i_put(out, "</tr></thead>\n<tbody>\n");
  for (int k = 0; k < snapshot->method_count; k++) {
    put_method(&snapshot->methods[k], k, baum_i_highlight_of(highlights, k), out);
  }
  baum_i_put(out, "</tbody></table></div>\n</section>\n");
}

/* ---- entries ---- */

static void put_entry(const baum_i_report_entry *entry, baum_i_buffer *out)
{
  baum_i_putf(
    out, "<tr data-m=\"%d\" data-i=\"%s\" data-front=\"%d\" data-done=\"%d\"><th scope=\"entry\">",
    (int)entry->entry.method, entry->integrator, entry->front[0] || entry->front[1],
    entry->entry.state == BAUM_STUDY_DONE);
  baum_i_put_html(out, entry->entry.name);
  baum_i_put(out, "</th>");
  for (int c = 1; c < baum_i_column_count; c++) {
    const baum_i_column *column = &baum_i_columns[c];
    if (!column->title) {
      continue;
    }
    if (column->kind == BAUM_I_COLUMN_TEXT) {
      put_text_cell(out, baum_i_column_text(column, entry));
    } else {
      int digits = column->kind == BAUM_I_COLUMN_NUMBER ? DIGITS : 15;
      put_number_cell(out, column->times * baum_i_column_number(column, entry), digits);
    }
  }
  baum_i_put(out, "<td>");
  for (int k = 0; k < BAUM_I_REMARKS; k++) {
    if (baum_i_remark(entry, k)) {
      baum_i_putf(out, "<span class=\"remark r%d\">%s</span> ", k, baum_i_remark(entry, k));
    }
  }
  baum_i_put(out, "</td></tr>\n");
}

void baum_i_put_entry_table(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  baum_i_put(out,
             "<section>\n<h2>All settings</h2>\n"
             "<form class=\"filters\"><label>name has <input type=\"search\" id=\"name\"></label>"
             "<label><input type=\"checkbox\" id=\"front\"> on a front</label>"
             "<label><input type=\"checkbox\" id=\"done\"> done</label>"
             "<output id=\"shown\"></output></form>\n"
             "<div class=\"scroll tall\" tabindex=\"0\" role=\"region\" aria-label=\"settings\">\n"
             "<table class=\"sortable\" id=\"entries\">\n<thead><tr>");
  for (int c = 0; c < baum_i_column_count; c++) {
    if (baum_i_columns[c].title) {
      put_heading(out, baum_i_columns[c].title, baum_i_columns[c].meaning,
                  baum_i_columns[c].kind == BAUM_I_COLUMN_TEXT);
    }
  }
  put_heading(out, "remarks", "see below", true);
  baum_i_put(out, "</tr></thead>\n<tbody>\n");
  for (int k = 0; k < snapshot->entry_count; k++) {
    put_entry(&snapshot->entries[k], out);
  }
  baum_i_put(
    out, "</tbody></table></div>\n<p class=\"key\"><span class=\"remark r0\">front</span> no "
         "setting is both cheaper and more exact. <span class=\"remark r2\">floor</span> as good "
         "as the reference can tell. <span class=\"remark r3\">off</span> another motion: an "
         "error of positions above 0.1 of the scale, or another branch behind a singular pose. "
         "<span class=\"remark r4\">unstable</span> its gains do not damp a violation with this "
         "step. <span class=\"remark r5\">untrusted</span> the reference is not to be trusted, "
         "so neither is the error. A dash: not known.</p>\n</section>\n");
}

/* ---- what was said ---- */

/* The first entry of which this was said. */
static bool is_first(const baum_i_snapshot *snapshot, int k)
{
  for (int j = 0; j < k; j++) {
    const char *message = snapshot->entries[j].message;
    if (message && strcmp(message, snapshot->entries[k].message) == 0) {
      return false;
    }
  }
  return true;
}

/* What was said of entry k, and of which settings it was. */
static void put_message(const baum_i_snapshot *snapshot, int k, baum_i_buffer *out)
{
  const char *message = snapshot->entries[k].message;
  int count = 0;
  baum_i_putf(out, "<tr><td>%s</td><td>", snapshot->entries[k].state);
  baum_i_put_html(out, message);
  baum_i_put(out, "</td><td>");
  for (int j = k; j < snapshot->entry_count; j++) {
    const char *other = snapshot->entries[j].message;
    if (!other || strcmp(message, other) != 0) {
      continue;
    }
    if (count < NAMED) {
      baum_i_put(out, count ? "; " : "");
      baum_i_put_html(out, snapshot->entries[j].entry.name);
    }
    count++;
  }
  if (count > NAMED) {
    baum_i_putf(out, " and %d more", count - NAMED);
  }
  baum_i_put(out, "</td></tr>\n");
}

void baum_i_put_messages(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  bool begun = false;
  for (int k = 0; k < snapshot->entry_count; k++) {
    if (snapshot->entries[k].message && is_first(snapshot, k)) {
      baum_i_put(out, begun
                        ? ""
                        : "<section>\n<h2>What was said</h2>\n"
                          "<div class=\"scroll tall\" tabindex=\"0\" role=\"region\" "
                          "aria-label=\"warnings and refusals\">\n<table class=\"said\">\n"
                          "<thead><tr><th scope=\"col\">state</th><th scope=\"col\">sentence</th>"
                          "<th scope=\"col\">of</th></tr></thead>\n<tbody>\n");
      begun = true;
      put_message(snapshot, k, out);
    }
  }
  baum_i_put(out, begun ? "</tbody></table></div>\n</section>\n" : "");
}
