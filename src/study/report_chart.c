/* SPDX-License-Identifier: BSD-3-Clause */
/* Charts of a study as SVG: what errors cost and what goes with them, on logarithmic axes. A line is a method, a mark one
 * of its settings. Coordinates are those of the drawing, whose y points down. */
#include <math.h>

#include "study/report.h"

enum { WIDTH = 480, HEIGHT = 350, LEFT = 58, RIGHT = 14, TOP = 14, BOTTOM = 46, TICKS = 7 };

/* Beyond it a motion has nothing to do with the reference any more, and further is not worse. */
static const double LARGEST_ERROR = 10.0;

typedef struct axis {
  const baum_i_column *column;
  double times; /* from the column to what is shown */
  int from;     /* decades */
  int to;
  double begin; /* place of from, of to */
  double end;
} axis;

typedef struct chart {
  const char *title;
  const char *key; /* of the column that is drawn upwards */
  const char *label;
  double times;
  int front; /* a baum_study_cost whose front is drawn; -1: none */
} chart;

static const chart CHARTS[] = {
  {"What an error costs, in work", "work", "work [evaluations]", 1.0, BAUM_STUDY_WORK},
  {"What an error costs, in time", "cpu", "CPU time [ms]", 1e3, BAUM_STUDY_CPU},
  {"Violation beside the error", "max_phi", "largest |Φ| [m, rad]", 1.0, -1},
  {"Drift of energy beside the error", "energy_error", "energy error [J]", 1.0, -1},
};

/* NaN: not to be drawn. */
static double value(const axis *a, const baum_i_report_entry *entry)
{
  double x = a->times * baum_i_column_number(a->column, entry);
  return isfinite(x) && x > 0.0 ? log10(x) : (double)NAN;
}

static bool is_drawn(const baum_i_report_entry *entry, const axis *x, const axis *y)
{
  return entry->entry.error <= LARGEST_ERROR && !isnan(value(x, entry)) && !isnan(value(y, entry));
}

static double place(const axis *a, double decades)
{
  return a->begin + (a->end - a->begin) * (decades - a->from) / (a->to - a->from);
}

/* Whole decades around what is drawn. */
static void span(const baum_i_snapshot *snapshot, axis *a, const axis *x, const axis *y)
{
  double least = INFINITY;
  double largest = -INFINITY;
  for (int k = 0; k < snapshot->entry_count; k++) {
    if (is_drawn(&snapshot->entries[k], x, y)) {
      least = fmin(least, value(a, &snapshot->entries[k]));
      largest = fmax(largest, value(a, &snapshot->entries[k]));
    }
  }
  bool any = least <= largest;
  a->from = any ? (int)floor(least) : -1;
  a->to = any ? (int)ceil(largest) : 1;
  if (a->to == a->from) {
    a->to++;
  }
}

/* A power of ten with its exponent raised. */
static void put_decade(baum_i_buffer *out, int decade)
{
  baum_i_putf(out, "10<tspan dy=\"-5\" class=\"up\">%d</tspan></text>", decade);
}

static void put_ticks_upwards(baum_i_buffer *out, const axis *a, int stride)
{
  for (int d = a->from; d <= a->to; d += stride) {
    baum_i_number y = baum_i_fixed(place(a, d), 1);
    baum_i_putf(out, "<path class=\"grid\" d=\"M%d %sH%d\"/>", LEFT, y.text, WIDTH - RIGHT);
    baum_i_putf(out, "<text class=\"end\" x=\"%d\" y=\"%s\" dy=\"5\">", LEFT - 6, y.text);
    put_decade(out, d);
  }
}

static void put_ticks_across(baum_i_buffer *out, const axis *a, int stride)
{
  for (int d = a->from; d <= a->to; d += stride) {
    baum_i_number x = baum_i_fixed(place(a, d), 1);
    baum_i_putf(out, "<path class=\"grid\" d=\"M%s %dV%d\"/>", x.text, TOP, HEIGHT - BOTTOM);
    baum_i_putf(out, "<text class=\"mid\" x=\"%s\" y=\"%d\">", x.text, HEIGHT - BOTTOM + 19);
    put_decade(out, d);
  }
}

static int stride(const axis *a)
{
  return (a->to - a->from + TICKS - 1) / TICKS;
}

static void put_axes(baum_i_buffer *out, const axis *x, const axis *y, const char *label)
{
  put_ticks_across(out, x, stride(x));
  put_ticks_upwards(out, y, stride(y));
  baum_i_putf(out, "<text class=\"mid\" x=\"%d\" y=\"%d\">largest error [-]</text>",
              (LEFT + WIDTH - RIGHT) / 2, HEIGHT - 6);
  baum_i_putf(out, "<text class=\"mid\" transform=\"translate(14 %d) rotate(-90)\">%s</text>",
              (TOP + HEIGHT - BOTTOM) / 2, label);
}

/* The next point of a path. */
static void put_point(baum_i_buffer *out, const axis *x, const axis *y,
                      const baum_i_report_entry *entry, bool first)
{
  baum_i_putf(out, "%s%s %s", first ? "M" : "L", baum_i_fixed(place(x, value(x, entry)), 1).text,
              baum_i_fixed(place(y, value(y, entry)), 1).text);
}

/* A mark whose title, which browsers show above it, has the figures. */
static void put_mark(baum_i_buffer *out, const axis *x, const axis *y,
                     const baum_i_report_entry *entry, int mark)
{
  const baum_study_entry *r = &entry->entry;
  baum_i_putf(out, "<use href=\"#k%d\" x=\"%s\" y=\"%s\"><title>", mark,
              baum_i_fixed(place(x, value(x, entry)), 1).text,
              baum_i_fixed(place(y, value(y, entry)), 1).text);
  baum_i_put_html(out, r->name);
  baum_i_putf(out, "\nerror %s, work %s, %s ms, |Φ| %s</title></use>",
              baum_i_short(r->error, 2).text, baum_i_short(r->work, 3).text,
              baum_i_short(1e3 * r->cpu, 3).text, baum_i_short(r->max_phi, 2).text);
}

/* The entries of a method from snapshot->order[first] on; returns the first behind them. */
static int put_line(const baum_i_snapshot *snapshot, int first, int colour, const axis *x,
                    const axis *y, baum_i_buffer *out)
{
  int method = snapshot->order[first]->entry.method;
  int end = first;
  bool begun = false;
  baum_i_putf(out, "<g class=\"line %s%d\" data-m=\"%d\" data-i=\"%s\"><path d=\"",
              colour < 0 ? "grey" : "c", colour < 0 ? 0 : colour, method,
              snapshot->order[first]->integrator);
  for (; end < snapshot->entry_count && snapshot->order[end]->entry.method == method; end++) {
    if (is_drawn(snapshot->order[end], x, y)) {
      put_point(out, x, y, snapshot->order[end], !begun);
      begun = true;
    }
  }
  baum_i_put(out, begun ? "\"/>" : "M0 0\"/>");
  for (int k = first; k < end; k++) {
    if (is_drawn(snapshot->order[k], x, y)) {
      put_mark(out, x, y, snapshot->order[k], colour < 0 ? BAUM_I_HIGHLIGHTS : colour);
    }
  }
  baum_i_put(out, "</g>\n");
  return end;
}

/* First the grey ones, so that the others lie above them. */
static void put_lines(const baum_i_snapshot *snapshot, const baum_i_highlights *highlights,
                      const axis *x, const axis *y, baum_i_buffer *out)
{
  for (int above = 0; above < 2; above++) {
    int k = 0;
    while (k < snapshot->entry_count) {
      int colour = baum_i_highlight_of(highlights, snapshot->order[k]->entry.method);
      if ((colour >= 0) == (above == 1)) {
        k = put_line(snapshot, k, colour, x, y, out);
      } else {
        int method = snapshot->order[k]->entry.method;
        while (k < snapshot->entry_count && snapshot->order[k]->entry.method == method) {
          k++;
        }
      }
    }
  }
}

static void put_front(const baum_i_snapshot *snapshot, baum_study_cost cost, const axis *x,
                      const axis *y, baum_i_buffer *out)
{
  bool begun = false;
  baum_i_put(out, "<path class=\"front\" d=\"");
  for (int k = 0; k < snapshot->front_count[cost]; k++) {
    const baum_i_report_entry *entry = &snapshot->entries[snapshot->front[cost][k]];
    if (is_drawn(entry, x, y)) {
      put_point(out, x, y, entry, !begun);
      begun = true;
    }
  }
  baum_i_put(out, begun ? "\"/>\n" : "M0 0\"/>\n");
}

/* Left of it errors are not told apart. */
static void put_floor(const baum_i_snapshot *snapshot, const axis *x, baum_i_buffer *out)
{
  double floor = log10(snapshot->reference.uncertainty);
  if (floor >= x->from && floor <= x->to) {
    baum_i_putf(
      out,
      "<path class=\"floor\" d=\"M%s %dV%d\"><title>what the reference can tell</title></path>\n",
      baum_i_fixed(place(x, floor), 1).text, TOP, HEIGHT - BOTTOM);
  }
}

static void put_chart(const baum_i_snapshot *snapshot, const baum_i_highlights *highlights,
                      const chart *c, baum_i_buffer *out)
{
  axis x = {.column = baum_i_column_by_key("error"), .times = 1.0};
  axis y = {.column = baum_i_column_by_key(c->key), .times = c->times};
  span(snapshot, &x, &x, &y);
  span(snapshot, &y, &x, &y);
  x.begin = LEFT;
  x.end = WIDTH - RIGHT;
  y.begin = HEIGHT - BOTTOM;
  y.end = TOP;
  baum_i_putf(out,
              "<figure><figcaption>%s</figcaption><svg class=\"chart\" viewBox=\"0 0 %d %d\" "
              "role=\"img\" aria-label=\"%s against the largest error, both logarithmic\">\n",
              c->title, WIDTH, HEIGHT, c->label);
  put_axes(out, &x, &y, c->label);
  put_floor(snapshot, &x, out);
  if (c->front >= 0) {
    put_front(snapshot, (baum_study_cost)c->front, &x, &y, out);
  }
  put_lines(snapshot, highlights, &x, &y, out);
  baum_i_put(out, "</svg></figure>\n");
}

/* What marks look like, around (0, 0): one for each highlight, and a small one. */
static void put_marks(baum_i_buffer *out)
{
  static const char *const SHAPES[BAUM_I_HIGHLIGHTS + 1] = {
    "M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0",                /* disc */
    "M-4 -4H4V4H-4Z",                                              /* square */
    "M0 -5.5L5 4H-5Z",                                             /* triangle */
    "M0 -6L5 0L0 6L-5 0Z",                                         /* diamond */
    "M0 5.5L5 -4H-5Z",                                             /* triangle upside down */
    "M-1.5 -5H1.5V-1.5H5V1.5H1.5V5H-1.5V1.5H-5V-1.5H-1.5Z",        /* plus */
    "M-5 -3L-3 -5L0 -2L3 -5L5 -3L2 0L5 3L3 5L0 2L-3 5L-5 3L-2 0Z", /* cross */
    "M0 -5.5L5.2 -1.7L3.2 4.5H-3.2L-5.2 -1.7Z",                    /* pentagon */
    "M-2 0a2 2 0 1 0 4 0a2 2 0 1 0 -4 0",
  };
  baum_i_put(out, "<svg width=\"0\" height=\"0\" aria-hidden=\"true\" class=\"marks\"><defs>\n");
  for (int k = 0; k <= BAUM_I_HIGHLIGHTS; k++) {
    baum_i_putf(out, "<path id=\"k%d\" d=\"%s\"/>\n", k, SHAPES[k]);
  }
  baum_i_put(out, "</defs></svg>\n");
}

static void put_legend(const baum_i_snapshot *snapshot, const baum_i_highlights *highlights,
                       baum_i_buffer *out)
{
  baum_i_put(out, "<ul class=\"legend\">\n");
  for (int k = 0; k < highlights->count; k++) {
    baum_i_putf(out,
                "<li><svg viewBox=\"-16 -8 32 16\" aria-hidden=\"true\" class=\"line c%d\">"
                "<path d=\"M-16 0H16\"/><use href=\"#k%d\"/></svg>",
                k, k);
    const baum_study_method *method = &snapshot->methods[highlights->methods[k]];
    baum_i_put_html(out, method->name);
    baum_i_putf(out, "%s</li>\n", baum_i_way(method));
  }
  if (snapshot->method_count > highlights->count) {
    baum_i_putf(out,
                "<li><svg viewBox=\"-16 -8 32 16\" aria-hidden=\"true\" class=\"line grey0\">"
                "<path d=\"M-16 0H16\"/><use href=\"#k%d\"/></svg>%d others</li>\n",
                BAUM_I_HIGHLIGHTS, snapshot->method_count - highlights->count);
  }
  baum_i_put(out, "<li><svg viewBox=\"-16 -8 32 16\" aria-hidden=\"true\"><path class=\"front\" "
                  "d=\"M-16 0H16\"/></svg>the front</li></ul>\n");
}

void baum_i_put_charts(const baum_i_snapshot *snapshot, const baum_i_highlights *highlights,
                       baum_i_buffer *out)
{
  put_marks(out);
  put_legend(snapshot, highlights, out);
  baum_i_put(out, "<div class=\"charts\">\n");
  for (size_t k = 0; k < sizeof CHARTS / sizeof CHARTS[0]; k++) {
    put_chart(snapshot, highlights, &CHARTS[k], out);
  }
  baum_i_put(out, "</div>\n");
}
