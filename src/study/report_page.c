/* SPDX-License-Identifier: BSD-3-Clause */
/* A study as one HTML page, which holds all it needs and may load nothing. */
#include <math.h>

#include "study/report.h"

static void put_head(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  baum_i_put(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                  "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
                  "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
                  "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                  "<meta name=\"color-scheme\" content=\"light dark\">\n<title>");
  baum_i_put_html(out, snapshot->title);
  baum_i_put(out, "</title>\n");
  baum_i_put_style(out);
  baum_i_put(out, "</head>\n<body>\n");
}

static void put_counts(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  baum_i_putf(out, "%d settings of %d methods", snapshot->entry_count, snapshot->method_count);
  for (int s = BAUM_STUDY_WAITING; s <= BAUM_STUDY_TIMED_OUT; s++) {
    int count = baum_i_snapshot_count(snapshot, (baum_study_state)s);
    const char *name =
      s == BAUM_STUDY_TIMED_OUT ? "timed out" : baum_study_state_name((baum_study_state)s);
    if (count > 0) {
      baum_i_putf(out, ", %d %s", count, name);
    }
  }
}

static void put_item(baum_i_buffer *out, const char *name, const char *text)
{
  baum_i_putf(out, "<dt>%s</dt><dd>", name);
  baum_i_put_html(out, text);
  baum_i_put(out, "</dd>\n");
}

static void put_header(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  const baum_study_reference *r = &snapshot->reference;
  baum_i_put(out, "<header>\n<h1>");
  baum_i_put_html(out, snapshot->title);
  baum_i_put(out, "</h1>\n<p>Speed against accuracy from ");
  baum_i_putf(out, "%s s to %s s: ", baum_i_short(snapshot->t0, 6).text,
              baum_i_short(snapshot->t1, 6).text);
  put_counts(snapshot, out);
  baum_i_put(out, ".</p>\n<dl>\n");
  put_item(out, "error", snapshot->error);
  baum_i_putf(out, "<dt>reference</dt><dd>%s%s digits",
              r->trusted ? "" : "<strong class=\"bad\">not to be trusted</strong>, ",
              baum_i_short(r->digits, 3).text);
  baum_i_put(out, r->text && r->text[0] ? ": " : "");
  baum_i_put_html(out, r->text ? r->text : "");
  baum_i_put(out, "</dd>\n</dl>\n</header>\n");
}

static void put_environment(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  const baum_i_environment *e = &snapshot->environment;
  baum_i_put(out, "<section>\n<h2>Where it was measured</h2>\n<dl>\n");
  put_item(out, "baum", e->baum);
  put_item(out, "SUNDIALS", e->sundials);
  put_item(out, "compiler", e->compiler);
  put_item(out, "processor", e->cpu);
  put_item(out, "date", e->date);
  baum_i_putf(
    out,
    "<dt>method</dt><dd>Errors at %d samples. CPU time is the least of up to %d runs, one "
    "after the other; runs end after %s s.</dd>\n",
    (int)(snapshot->reference.samples ? snapshot->reference.samples : snapshot->options.samples),
    (int)snapshot->options.repeats, baum_i_short(snapshot->options.entry_limit, 3).text);
  baum_i_put(out, "</dl>\n</section>\n");
}

void baum_i_report_page(const baum_i_snapshot *snapshot, baum_i_buffer *out)
{
  baum_i_highlights highlights = baum_i_choose_highlights(snapshot);
  put_head(snapshot, out);
  put_header(snapshot, out);
  baum_i_put(out, "<main>\n");
  baum_i_put_advice_table(snapshot, out);
  baum_i_put(out, "<section>\n<h2>What an error costs</h2>\n"
                  "<p>A line is a method, a mark one of its settings. Further left is more exact, "
                  "further down is cheaper. Left of the dashed line the reference cannot tell "
                  "errors apart. Point at a mark to see its figures.</p>\n");
  baum_i_put_charts(snapshot, &highlights, out);
  baum_i_put(out, "</section>\n");
  baum_i_put_stability_maps(snapshot, out);
  baum_i_put_method_table(snapshot, &highlights, out);
  baum_i_put_entry_table(snapshot, out);
  baum_i_put_messages(snapshot, out);
  put_environment(snapshot, out);
  baum_i_put(out, "</main>\n");
  baum_i_put_script(out);
  baum_i_put(out, "</body>\n</html>\n");
}
