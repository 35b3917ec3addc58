/* SPDX-License-Identifier: BSD-3-Clause */
/* Writes a run as one HTML page. The page consists of the template page.html and of the data that
 * the script of this template draws.
 *
 * The data are in JSON. Their numbers are in a table of 16-bit integers, which is written column by
 * column in base64. In each column, 0 stands for the smallest value, 65534 for the largest value,
 * and 65535 for a missing value. The first column is the time. The columns of q, of reactions and
 * of plots follow in this order.
 */
#include <stdint.h>
#include <string.h>

#include <baum/draw.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/sized.h"
#include "draw/drawing.h"
#include "mechanism/identify.h"
#include "simulate/run.h"

enum { FRAMES = 600, MARKED_COLUMNS = 150, NO_NUMBER = 65535 };
/* Placeholders in the template. The data of the page replace DATA, and the script that draws solids
 * replaces SOLIDS. */
static const char DATA[] = "\"DATA\"", SOLIDS[] = "// SOLIDS\n";

/* The contents of page.html and solids.js, in C files that cmake/Embed.cmake generates. */
extern const unsigned char baum_i_page_html[], baum_i_solids_js[];

/* A column of the table. */
typedef struct column {
  const double *values; /* address of the value in the first sample */
  int64_t stride;
  bool angle; /* values are angles and are stored modulo 2 pi, from -pi to pi */
  bool plotted;
} column;

typedef struct table {
  const baum_mechanism *mechanism;
  const baum_page *page;
  int width; /* number of columns in a row */
  int64_t *frames;
  int frame_count;
  column *columns; /* (column_count) */
  int column_count;
} table;

void baum_page_init(baum_page *page, size_t caller_size)
{
  const baum_page defaults = {.struct_size = sizeof defaults};
  baum_i_give_sized(page, caller_size, &defaults, sizeof defaults);
}

/* ---- checks ---- */

static baum_status check_traces(const baum_mechanism *m, const baum_page *page, const char *call)
{
  int width;
  BAUM_I_TRY(baum_i_check_channels(m, page->traces, page->trace_count, &width));
  for (int k = 0; k < page->trace_count; k++) {
    const baum_channel trace = baum_i_channel(page->traces, k);
    if (trace.quantity != BAUM_BODY_POSE ||
        baum_i_frame_of(m->bodies[baum_i_body_index(m, trace.body)]) == BAUM_I_FRAME_NONE) {
      return baum_i_fail(BAUM_ERR_ARGUMENT,
                         "%s: traces[%d] must be the pose of a body, but not of user coordinates",
                         call, k);
    }
  }
  return BAUM_OK;
}

/* Checks a list that the caller gives. It must have at least `least` entries. Both of its arrays
 * must be given unless the list is empty. */
static baum_status check_list(const char *call, const char *names, int64_t count, int64_t least,
                              const void *array, const void *other)
{
  bool fine = count == 0 || (array && other);
  return count >= least && fine
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT, "%s: the page needs %s", call, names);
}

static const char *mark_kind_name(const baum_page *page, int k)
{
  switch (page->mark_kinds ? page->mark_kinds[k] : BAUM_MARK_WARNING) {
  case BAUM_MARK_WARNING: return "warning";
  case BAUM_MARK_SINGULAR: return "singular";
  case BAUM_MARK_EVENT: return "event";
  default: return NULL;
  }
}

static baum_status check_marks(const baum_page *page, const char *call)
{
  for (int k = 0; k < page->mark_count; k++) {
    if (!mark_kind_name(page, k)) {
      return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: mark_kinds[%d] is %d, not a baum_mark_kind", call,
                         k, page->mark_kinds[k]);
    }
  }
  return BAUM_OK;
}

static baum_status check_given(const baum_page *page, const char *call)
{
  BAUM_I_TRY(
    check_list(call, "count > 0, times and rows", page->count, 1, page->times, page->rows));
  BAUM_I_TRY(check_list(call, "channel_count > 0 and channels", page->channel_count, 1,
                        page->channels, page->channels));
  BAUM_I_TRY(check_list(call, "trace_count >= 0, and traces if it is > 0", page->trace_count, 0,
                        page->traces, page->traces));
  BAUM_I_TRY(check_list(call, "plot_count >= 0, and plots and plot_labels if it is > 0",
                        page->plot_count, 0, page->plots, page->plot_labels));
  BAUM_I_TRY(check_list(call, "mark_count >= 0, and mark_times and mark_texts if it is > 0",
                        page->mark_count, 0, page->mark_times, page->mark_texts));
  return check_marks(page, call);
}

/* Copies the caller's page. Fields that are missing in the struct of an older version keep their
 * defaults. */
static baum_status take_page(const baum_page *given, const char *call, baum_page *page)
{
  if (!given) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: page is NULL", call);
  }
  *page = baum_page_default();
  return baum_i_take_sized(page, sizeof *page, given, call, " of the page", "baum_page_default()");
}

baum_status baum_i_page_check(const baum_mechanism *m, const baum_page *given, const char *call,
                              baum_page *page, int *width)
{
  BAUM_I_TRY(baum_i_check_frozen(m, call));
  BAUM_I_TRY(take_page(given, call, page));
  BAUM_I_TRY(check_given(page, call));
  BAUM_I_TRY(baum_i_check_channels(m, page->channels, page->channel_count, width));
  if (page->trace_count > 0) {
    BAUM_I_TRY(check_traces(m, page, call));
  }
  for (int k = 0; k < page->channel_count; k++) {
    if (baum_i_channel(page->channels, k).quantity == BAUM_Q) {
      return BAUM_OK;
    }
  }
  return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: BAUM_Q is not among the channels of the page", call);
}

/* ---- the table ---- */

static double value_at(const column *c, int64_t sample)
{
  double x = c->values[sample * c->stride];
  return c->angle ? remainder(x, BAUM_I_REVOLUTION) : x;
}

static void add_column(table *t, const double *values, int64_t stride, bool plotted)
{
  t->columns[t->column_count++] = (column){values, stride, false, plotted};
}

bool baum_i_page_is_reaction(const baum_mechanism *m, const baum_channel *c)
{
  return c->quantity == BAUM_JOINT_REACTION &&
         m->joints[baum_i_joint_index(m, c->joint)]->type->width > 0;
}

/* Adds the columns of q to the table, and marks those which are angles of planar bodies. */
static void add_positions(table *t, const double *q)
{
  const int first = t->column_count;
  for (int k = 0; k < t->mechanism->nq; k++) {
    add_column(t, q + k, t->width, false);
  }
  for (int k = 1; k <= t->mechanism->body_count; k++) {
    const baum_i_body *body = t->mechanism->bodies[k];
    if (baum_i_frame_of(body) == BAUM_I_FRAME_BODY) {
      t->columns[first + body->q + 2].angle = true;
    }
  }
}

/* Writes the list of reactions and adds their columns to the table. */
static void put_reactions(table *t, baum_i_drawing *drawing, baum_i_buffer *out)
{
  const baum_page *page = t->page;
  const char *gap = "";
  int place = 0;
  for (int k = 0; k < page->channel_count; k++) {
    int width = 0;
    const baum_channel c = baum_i_channel(page->channels, k);
    (void)baum_i_check_channels(t->mechanism, &c, 1, &width);
    if (baum_i_page_is_reaction(t->mechanism, &c)) {
      int joint = baum_i_joint_index(t->mechanism, c.joint);
      const baum_i_place *at = &drawing->places[joint];
      baum_i_putf(out, "%s\n{\"joint\":\"", gap);
      baum_i_put_user_text(out, t->mechanism->joints[joint]->element.name, BAUM_I_JSON);
      baum_i_putf(out, "\",\"body\":%d,\"point\":[%.6g,%.6g,%.6g],\"column\":%d,\"size\":%d}",
                  at->body[1], at->point[1][0], at->point[1][1], at->point[1][2], t->column_count,
                  width);
      for (int i = 0; i < width; i++) {
        add_column(t, page->rows + place + i, t->width, false);
      }
      gap = ",";
    }
    place += width;
  }
}

int baum_i_page_positions(const baum_mechanism *m, const baum_page *page)
{
  int place = 0;
  for (int k = 0; k < page->channel_count; k++) {
    int width = 0;
    const baum_channel c = baum_i_channel(page->channels, k);
    if (c.quantity == BAUM_Q) {
      break;
    }
    (void)baum_i_check_channels(m, &c, 1, &width);
    place += width;
  }
  return place;
}

static void put_plots(table *t, baum_i_buffer *out)
{
  const baum_page *page = t->page;
  const int stride = page->plot_stride > 0 ? page->plot_stride : page->plot_count;
  for (int k = 0; k < page->plot_count; k++) {
    baum_i_put(out, k ? ",\n{\"label\":\"" : "\n{\"label\":\"");
    baum_i_put_user_text(out, page->plot_labels[k] ? page->plot_labels[k] : "", BAUM_I_JSON);
    baum_i_putf(out, "\",\"column\":%d}", t->column_count);
    add_column(t, page->plots + k, stride, true);
  }
}

/* ---- frames ---- */

/* Marks the samples in which the first MARKED_COLUMNS plotted columns have their smallest and their
 * largest values. Returns the number of these columns. */
static int mark_extremes(const table *t, bool *kept)
{
  int marked = 0;
  for (int k = 0; k < t->column_count && marked < MARKED_COLUMNS; k++) {
    const column *c = &t->columns[k];
    int64_t low = 0, high = 0;
    for (int64_t i = 1; c->plotted && i < t->page->count; i++) {
      low = value_at(c, i) < value_at(c, low) ? i : low;
      high = value_at(c, i) > value_at(c, high) ? i : high;
    }
    if (c->plotted) {
      kept[low] = kept[high] = true;
      marked++;
    }
  }
  return marked;
}

/* Chooses the samples that the page contains. If there are more than FRAMES samples, the page
 * contains samples at equal intervals, and the samples in which a plotted column has an extreme
 * value. Otherwise it contains all samples. */
static baum_status choose_frames(table *t)
{
  const int64_t n = t->page->count;
  bool *kept = baum_i_alloc((size_t)n, sizeof *kept);
  t->frames = baum_i_alloc(FRAMES, sizeof *t->frames);
  if (!kept || !t->frames) {
    baum_i_free(kept);
    return baum_i_fail_memory();
  }
  const int64_t even = n > FRAMES ? FRAMES - 2 * mark_extremes(t, kept) : n;
  for (int64_t k = 0; k < even; k++) {
    kept[even > 1 ? k * (n - 1) / (even - 1) : 0] = true;
  }
  for (int64_t i = 0; i < n; i++) {
    if (kept[i]) {
      t->frames[t->frame_count++] = i;
    }
  }
  baum_i_free(kept);
  return BAUM_OK;
}

/* ---- values ---- */

static void find_range(const table *t, const column *c, double range[2])
{
  range[0] = INFINITY;
  range[1] = -INFINITY;
  for (int k = 0; k < t->frame_count; k++) {
    double x = value_at(c, t->frames[k]);
    if (isfinite(x)) {
      range[0] = fmin(range[0], x);
      range[1] = fmax(range[1], x);
    }
  }
  if (!(range[1] >= range[0]) || !isfinite(range[1] - range[0])) {
    range[0] = range[1] = 0.0;
  }
}

static void put_ranges(const table *t, baum_i_buffer *out)
{
  for (int k = 0; k < t->column_count; k++) {
    double range[2];
    find_range(t, &t->columns[k], range);
    baum_i_putf(out, "%s[%.17g,%.17g]", k ? "," : "", range[0], range[1]);
  }
}

static unsigned quantize(double x, const double range[2])
{
  if (!isfinite(x) || x < range[0] || x > range[1]) {
    return NO_NUMBER;
  }
  double width = range[1] - range[0];
  return width > 0.0 ? (unsigned)((x - range[0]) / width * (NO_NUMBER - 1) + 0.5) : 0;
}

/* Base64 encoder (RFC 4648) that takes one byte at a time. */
typedef struct encoder {
  baum_i_buffer *out;
  uint32_t bits;
  int bytes; /* number of bytes in `bits` */
  char text[401];
  int used;
} encoder;

static void flush(encoder *e)
{
  e->text[e->used] = '\0';
  baum_i_put(e->out, e->text);
  e->used = 0;
}

static void put_group(encoder *e)
{
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  uint32_t bits = e->bits << 8 * (3 - e->bytes);
  for (int k = 0; k < 4; k++) {
    e->text[e->used++] = (char)(k <= e->bytes ? digits[bits >> (18 - 6 * k) & 63] : '=');
  }
  e->bits = 0;
  e->bytes = 0;
  if (e->used == 400) {
    flush(e);
  }
}

static void put_byte(encoder *e, unsigned byte)
{
  e->bits = e->bits << 8 | byte;
  e->bytes++;
  if (e->bytes == 3) {
    put_group(e);
  }
}

static void put_values(const table *t, baum_i_buffer *out)
{
  encoder e = {.out = out};
  for (int k = 0; k < t->column_count; k++) {
    double range[2];
    find_range(t, &t->columns[k], range);
    for (int i = 0; i < t->frame_count; i++) {
      unsigned value = quantize(value_at(&t->columns[k], t->frames[i]), range);
      put_byte(&e, value & 255);
      put_byte(&e, value >> 8);
    }
  }
  if (e.bytes > 0) {
    put_group(&e);
  }
  flush(&e);
}

/* ---- the page ---- */

static void put_traces(const table *t, baum_i_buffer *out)
{
  for (int k = 0; k < t->page->trace_count; k++) {
    const baum_channel trace = baum_i_channel(t->page->traces, k);
    baum_i_putf(out, "%s{\"body\":%d,\"point\":[%.6g,%.6g,%.6g]}", k ? "," : "",
                baum_i_body_index(t->mechanism, trace.body), trace.point[0], trace.point[1],
                trace.point[2]);
  }
}

static void put_marks(const baum_page *page, baum_i_buffer *out)
{
  for (int k = 0; k < page->mark_count; k++) {
    baum_i_putf(out, "%s{\"t\":%s,\"kind\":\"%s\",\"text\":\"", k ? "," : "",
                baum_i_exact(page->mark_times[k], "null").text, mark_kind_name(page, k));
    baum_i_put_user_text(out, page->mark_texts[k] ? page->mark_texts[k] : "", BAUM_I_JSON);
    baum_i_put(out, "\"}");
  }
}

static baum_status put_page(table *t, baum_i_drawing *drawing, baum_i_buffer *out)
{
  const char *page = (const char *)baum_i_page_html;
  const char *place = strstr(page, DATA), *after = place + strlen(DATA);
  const char *script = strstr(after, SOLIDS);
  const char *title = t->page->title ? t->page->title : "Mechanism";
  t->columns = baum_i_alloc((size_t)t->width + (size_t)t->page->plot_count + 1, sizeof *t->columns);
  if (!t->columns) {
    return baum_i_fail_memory();
  }
  baum_i_putf(out, "%.*s{\"title\":\"", (int)(place - page), page);
  baum_i_put_user_text(out, title, BAUM_I_JSON);
  baum_i_put(out, "\",\n\"drawing\":");
  baum_i_put_drawing(drawing, out);
  add_column(t, t->page->times, 1, false);
  add_positions(t, drawing->motion.q);
  baum_i_put(out, ",\n\"reactions\":[");
  put_reactions(t, drawing, out);
  baum_i_put(out, "],\n\"plots\":[");
  put_plots(t, out);
  baum_i_put(out, "],\n\"traces\":[");
  put_traces(t, out);
  baum_i_put(out, "],\n\"marks\":[");
  put_marks(t->page, out);
  BAUM_I_TRY(choose_frames(t));
  baum_i_putf(out, "],\n\"frames\":%d,\"ranges\":[", t->frame_count);
  put_ranges(t, out);
  baum_i_put(out, "],\n\"values\":\"");
  put_values(t, out);
  baum_i_putf(out, "\"}%.*s%s", (int)(script - after), after,
              drawing->spatial ? (const char *)baum_i_solids_js : "");
  baum_i_put(out, script + strlen(SOLIDS));
  return out->failed ? baum_i_fail_memory() : BAUM_OK;
}

static baum_status make(const baum_mechanism *mechanism, const baum_page *page, const char *call,
                        baum_i_buffer *out)
{
  baum_page checked;
  table t = {.mechanism = mechanism, .page = &checked};
  BAUM_I_TRY(baum_i_page_check(mechanism, page, call, &checked, &t.width));
  baum_i_drawing drawing;
  const baum_i_samples motion = {checked.rows + baum_i_page_positions(mechanism, &checked),
                                 checked.count, t.width};
  baum_status status = baum_i_drawing_create(mechanism, &motion, &drawing);
  if (status == BAUM_OK) {
    status = put_page(&t, &drawing, out);
  }
  baum_i_drawing_release(&drawing);
  baum_i_free(t.columns);
  baum_i_free(t.frames);
  return status;
}

baum_status baum_page_print(const baum_mechanism *mechanism, const baum_page *page, char *text,
                            size_t capacity, size_t *size)
{
  const char *call = "baum_page_print";
  baum_i_buffer out = {0};
  baum_status status = make(mechanism, page, call, &out);
  if (status == BAUM_OK) {
    status = baum_i_give_text(&out, call, text, capacity, size);
  }
  baum_i_buffer_clear(&out);
  return status;
}

baum_status baum_page_write(const baum_mechanism *mechanism, const baum_page *page,
                            const char *path)
{
  const char *call = "baum_page_write";
  baum_i_buffer out = {0};
  baum_status status = make(mechanism, page, call, &out);
  if (status == BAUM_OK) {
    status = baum_i_give_file(&out, call, path);
  }
  baum_i_buffer_clear(&out);
  return status;
}
