/* SPDX-License-Identifier: BSD-3-Clause */
/* Draws one sample of a motion as an SVG picture. The picture contains the shapes, the paths of
 * points up to this sample, and reactions as arrows. The view covers the whole motion, sampled at
 * about a hundred instants, so that pictures of several samples of a motion usually have the same
 * view. */
#include <string.h>

#include <baum/draw.h>

#include "base/alloc.h"
#include "base/file.h"
#include "draw/svg.h"
#include "mechanism/identify.h"
#include "simulate/run.h"

enum { SEEN = 100, ARC = 24 };
static const double REACH = 12.0;  /* length of the longest arrow, in drawing units */
static const double NEAREST = 0.5; /* [px] smallest distance between points of a path */
/* Arrows shorter than this fraction of the longest one are not drawn. */
static const double SMALLEST = 0.01;
static const double LINE = 22.0; /* [px] height of a scale: an arrow and its value */

/* The two kinds of reactions. Arrows of forces and arrows of moments have separate scales. */
typedef enum effort { FORCE, MOMENT, EFFORTS } effort;
static const char *const COLOURS[EFFORTS] = {"#be123c", "#8b5cf6"};
static const char *const UNITS[EFFORTS] = {"N", "N m"};

/* A joint reaction. `column` is its first column in the rows of a page. */
typedef struct reaction {
  const baum_i_place *place;
  int column;
  bool spatial;
} reaction;

typedef struct figure {
  baum_i_picture picture;
  const baum_page *page;
  baum_i_spatial_frame *frames; /* (body_count + 1) frames of the bodies in the picture */
  reaction *reactions;          /* (reaction_count) */
  int reaction_count;
  int width;            /* number of columns in a row */
  double most[EFFORTS]; /* largest force [N] and largest moment [N m] over all samples */
} figure;

/* ---- samples ---- */

static const double *row_of(const figure *f, int64_t sample)
{
  return f->page->rows + sample * f->width;
}

static const double *positions_of(const figure *f, int64_t sample)
{
  return f->picture.drawing->motion.q + sample * f->width;
}

static void set_frames(figure *f, int64_t sample)
{
  const baum_mechanism *m = f->picture.drawing->mechanism;
  for (int k = 0; k <= m->body_count; k++) {
    f->frames[k] = baum_i_drawing_frame(m->bodies[k], positions_of(f, sample));
  }
}

/* Finds the position of a traced point at a sample, in the axes of the picture. */
static void find_trace(const figure *f, int trace, int64_t sample, int *body, double at[3])
{
  const baum_mechanism *m = f->picture.drawing->mechanism;
  const baum_channel channel = baum_i_channel(f->page->traces, trace);
  double place[3];
  *body = baum_i_body_index(m, channel.body);
  baum_i_spatial_frame frame = baum_i_drawing_frame(m->bodies[*body], positions_of(f, sample));
  baum_i_turn(frame.axes, channel.point, place);
  baum_i_add_scaled3(1.0, frame.r, place);
  baum_i_turn(f->picture.view, place, at);
}

/* ---- reactions ---- */

static baum_status find_reactions(figure *f)
{
  const baum_mechanism *m = f->picture.drawing->mechanism;
  int column = 0;
  f->reactions = baum_i_alloc((size_t)f->page->channel_count, sizeof *f->reactions);
  if (!f->reactions) {
    return baum_i_fail_memory();
  }
  for (int k = 0; k < f->page->channel_count; k++) {
    int width = 0;
    const baum_channel c = baum_i_channel(f->page->channels, k);
    (void)baum_i_check_channels(m, &c, 1, &width);
    if (baum_i_page_is_reaction(m, &c)) {
      const baum_i_place *place = &f->picture.drawing->places[baum_i_joint_index(m, c.joint)];
      f->reactions[f->reaction_count++] = (reaction){place, column, width == 6};
    }
    column += width;
  }
  return BAUM_OK;
}

/* Copies the force or the moment of a reaction at a sample, as a vector in ground axes. Returns the
 * length of this vector. */
static double find_effort(const figure *f, const reaction *r, effort what, int64_t sample,
                          double out[3])
{
  const double *x = row_of(f, sample) + r->column;
  for (int i = 0; i < 3; i++) {
    out[i] = r->spatial ? x[3 * (int)what + i] : 0.0;
  }
  if (!r->spatial && what == FORCE) {
    out[0] = x[0];
    out[1] = x[1];
  } else if (!r->spatial) {
    out[2] = x[2];
  }
  return sqrt(baum_i_dot3(out, out));
}

static void find_largest(figure *f)
{
  double x[3];
  for (int64_t k = 0; k < f->page->count; k++) {
    for (int i = 0; i < f->reaction_count; i++) {
      for (int what = FORCE; what < EFFORTS; what++) {
        f->most[what] = fmax(f->most[what], find_effort(f, &f->reactions[i], what, k, x));
      }
    }
  }
  if (f->most[MOMENT] < 1e-9 * f->most[FORCE] * f->picture.drawing->unit) {
    f->most[MOMENT] = 0.0; /* the moments are only rounding errors */
  }
}

/* Finds both ends of the arrow that shows a reaction, projected to the picture. Returns its length
 * as a fraction of the largest arrow's length, or 0 if there is no arrow. */
static double find_arrow(const figure *f, const reaction *r, effort what, int64_t sample,
                         double ends[2][3])
{
  double x[3], seen[3];
  double size = find_effort(f, r, what, sample, x);
  double share = f->most[what] > 0.0 && isfinite(size) ? size / f->most[what] : 0.0;
  baum_i_picture_project(&f->picture, r->place->body[1], r->place->point[1], ends[0]);
  baum_i_turn(f->picture.view, x, seen);
  for (int i = 0; i < 3; i++) {
    ends[1][i] = ends[0][i];
  }
  if (share > 0.0) {
    baum_i_add_scaled3(REACH * f->picture.drawing->unit / f->most[what], seen, ends[1]);
  }
  return share;
}

/* ---- the view ---- */

static void include_sample(figure *f, int64_t sample, baum_i_box *box)
{
  double ends[2][3];
  int body;
  set_frames(f, sample);
  baum_i_picture_include(&f->picture, box);
  for (int k = 0; k < f->page->trace_count; k++) {
    find_trace(f, k, sample, &body, ends[0]);
    baum_i_box_include(box, ends[0][0], ends[0][1], 0.0);
  }
  for (int k = 0; k < f->reaction_count; k++) {
    for (int what = FORCE; what < EFFORTS; what++) {
      (void)find_arrow(f, &f->reactions[k], what, sample, ends);
      baum_i_box_include(box, ends[1][0], ends[1][1], 0.0);
    }
  }
}

static void include_motion(figure *f, int64_t sample, baum_i_box *box)
{
  const int64_t last = f->page->count - 1;
  const int64_t steps = last < SEEN ? last : SEEN;
  for (int64_t k = 0; k <= steps; k++) {
    include_sample(f, steps > 0 ? k * last / steps : 0, box);
  }
  include_sample(f, sample, box);
}

/* ---- paths and reactions on top of the shapes ---- */

static void put_stroke(const figure *f, const char *colour)
{
  baum_i_putf(f->picture.out, "\" fill=\"none\" stroke=\"%s\" stroke-width=\"2.0\"/>", colour);
}

static void put_name(const figure *f, const char *what, const baum_i_element *element)
{
  baum_i_putf(f->picture.out, "<g><title>%s", what);
  baum_i_put_user_text(f->picture.out, element->name, BAUM_I_XML);
  baum_i_put(f->picture.out, "</title>");
}

static void put_trace(const figure *f, int trace, int64_t sample)
{
  const double near = NEAREST / f->picture.scale;
  double at[3], last[3] = {INFINITY, INFINITY, 0.0};
  bool drawn = false;
  int body =
    baum_i_body_index(f->picture.drawing->mechanism, baum_i_channel(f->page->traces, trace).body);
  put_name(f, "path of ", &f->picture.drawing->mechanism->bodies[body]->element);
  baum_i_put(f->picture.out, "<path d=\"");
  for (int64_t k = 0; k <= sample; k++) {
    find_trace(f, trace, k, &body, at);
    if (!isfinite(at[0] + at[1]) ||
        (k < sample && hypot(at[0] - last[0], at[1] - last[1]) < near)) {
      continue;
    }
    baum_i_picture_put_point(&f->picture, drawn ? "L" : "M", at);
    memcpy(last, at, sizeof last);
    drawn = true;
  }
  put_stroke(f, baum_i_picture_colour(body));
  baum_i_put(f->picture.out, "</g>\n");
}

/* Draws an arrow with one or two tips. */
static void put_arrow(const figure *f, const double ends[2][3], int tips, const char *colour)
{
  const double d[2] = {ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]};
  const double size = f->picture.drawing->unit / fmax(hypot(d[0], d[1]), f->picture.drawing->unit);
  baum_i_put(f->picture.out, "<path d=\"");
  baum_i_picture_put_point(&f->picture, "M", ends[0]);
  baum_i_picture_put_point(&f->picture, "L", ends[1]);
  for (int tip = 0; tip < tips; tip++) {
    for (int k = 0; k < 3; k++) {
      double back = size * ((k == 1 ? 0.0 : 1.2) + 0.8 * tip), side = size * 0.5 * (k - 1);
      const double at[3] = {ends[1][0] - back * d[0] + side * d[1],
                            ends[1][1] - back * d[1] - side * d[0], 0.0};
      baum_i_picture_put_point(&f->picture, k == 0 ? "M" : "L", at);
    }
  }
  put_stroke(f, colour);
}

/* Draws a planar moment as an arc about its point. The arc is counter-clockwise if the moment is
 * positive. The arc of the largest moment is almost a whole revolution. */
static void put_arc(const figure *f, const double centre[3], double share)
{
  const double radius = 2.0 * f->picture.drawing->unit, whole = 0.95 * BAUM_I_REVOLUTION * share;
  double ends[2][3] = {{0.0}};
  baum_i_put(f->picture.out, "<path d=\"");
  for (int k = 0; k <= ARC; k++) {
    memcpy(ends[0], ends[1], sizeof ends[0]);
    ends[1][0] = centre[0] + radius * cos(whole * k / ARC);
    ends[1][1] = centre[1] + radius * sin(whole * k / ARC);
    baum_i_picture_put_point(&f->picture, k == 0 ? "M" : "L", ends[1]);
  }
  put_stroke(f, COLOURS[MOMENT]);
  put_arrow(f, (const double(*)[3])ends, 1, COLOURS[MOMENT]);
}

static void put_reaction(const figure *f, const reaction *r, int64_t sample)
{
  double ends[2][3];
  put_name(f, "reaction of ", r->place->element);
  if (find_arrow(f, r, FORCE, sample, ends) >= SMALLEST) {
    put_arrow(f, (const double(*)[3])ends, 1, COLOURS[FORCE]);
  }
  double share = find_arrow(f, r, MOMENT, sample, ends);
  if (share >= SMALLEST && r->spatial) {
    put_arrow(f, (const double(*)[3])ends, 2, COLOURS[MOMENT]);
  } else if (share >= SMALLEST) {
    put_arc(f, ends[0], copysign(share, row_of(f, sample)[r->column + 2]));
  }
  baum_i_put(f->picture.out, "</g>\n");
}

/* Tells whether the picture has a scale for this kind of reaction. Planar moments are shown as
 * arcs, which have no scale. */
static bool has_scale(const figure *f, effort what)
{
  return f->most[what] > 0.0 && (what == FORCE || f->picture.drawing->spatial);
}

/* Draws the scale as an arrow with its value. The value is the largest force or moment, rounded
 * down to 1, 2 or 5 times a power of ten. Returns the height of the scale [px]. */
static double put_scale(const figure *f, effort what, double below)
{
  const baum_i_picture *p = &f->picture;
  const double ten = pow(10.0, floor(log10(f->most[what]))), first = f->most[what] / ten;
  const double size = ten * (first >= 5.0 ? 5.0 : first >= 2.0 ? 2.0 : 1.0);
  const double x = 12.0, y = p->size[1] - below - 0.5 * LINE;
  const double length = REACH * p->drawing->unit * size / f->most[what];
  double ends[2][3] = {{p->left + x / p->scale, p->top - y / p->scale, 0.0}};
  memcpy(ends[1], ends[0], sizeof ends[1]);
  ends[1][0] += length;
  put_arrow(f, (const double(*)[3])ends, 1, COLOURS[what]);
  baum_i_putf(p->out,
              "<text x=\"%.1f\" y=\"%.1f\" font-family=\"sans-serif\" font-size=\"13\" "
              "fill=\"#78828c\">%g %s</text>\n",
              x + length * p->scale + 8.0, y + 4.5, size, UNITS[what]);
  return LINE;
}

/* ---- the picture ---- */

static baum_status put_figure(figure *f, int64_t sample)
{
  baum_i_box box = BAUM_I_EMPTY_BOX;
  double below = 0.0;
  baum_i_picture_set_view(&f->picture);
  find_largest(f);
  include_motion(f, sample, &box);
  baum_i_picture_begin(&f->picture, &box, LINE * (has_scale(f, FORCE) + has_scale(f, MOMENT)));
  BAUM_I_TRY(baum_i_picture_put_shapes(&f->picture));
  for (int k = 0; k < f->page->trace_count; k++) {
    put_trace(f, k, sample);
  }
  for (int k = 0; k < f->reaction_count; k++) {
    put_reaction(f, &f->reactions[k], sample);
  }
  for (int what = FORCE; what < EFFORTS; what++) {
    below += has_scale(f, what) ? put_scale(f, what, below) : 0.0;
  }
  baum_i_put(f->picture.out, "</svg>\n");
  return f->picture.out->failed ? baum_i_fail_memory() : BAUM_OK;
}

static baum_status check_sample(const baum_mechanism *m, const baum_page *page, int64_t sample,
                                const char *call, int width)
{
  if (sample < 0 || sample >= page->count) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "%s: sample is %lld, must be 0 to %lld", call,
                       (long long)sample, (long long)page->count - 1);
  }
  const double *q = page->rows + sample * width + baum_i_page_positions(m, page);
  for (int k = 0; k < m->nq; k++) {
    if (!isfinite(q[k])) {
      return baum_i_fail(BAUM_ERR_NOT_FINITE, "%s: q[%d] is %g, must be finite", call, k, q[k]);
    }
  }
  return BAUM_OK;
}

static baum_status make(const baum_mechanism *m, const baum_page *page, int64_t sample, int width,
                        baum_i_buffer *out)
{
  baum_i_drawing drawing;
  figure f = {.picture = {.drawing = &drawing, .out = out}, .page = page, .width = width};
  const baum_i_samples motion = {page->rows + baum_i_page_positions(m, page), page->count, width};
  baum_status status = baum_i_drawing_create(m, &motion, &drawing);
  f.picture.frames = f.frames = baum_i_alloc((size_t)m->body_count + 1, sizeof *f.frames);
  if (status == BAUM_OK) {
    status = f.frames ? find_reactions(&f) : baum_i_fail_memory();
  }
  if (status == BAUM_OK) {
    status = put_figure(&f, sample);
  }
  baum_i_free(f.reactions);
  baum_i_free(f.frames);
  baum_i_drawing_release(&drawing);
  return status;
}

baum_status baum_page_svg(const baum_mechanism *mechanism, const baum_page *page, int64_t sample,
                          char *text, size_t capacity, size_t *size)
{
  const char *call = "baum_page_svg";
  int width;
  baum_page checked;
  BAUM_I_TRY(baum_i_page_check(mechanism, page, call, &checked, &width));
  BAUM_I_TRY(check_sample(mechanism, &checked, sample, call, width));
  baum_i_buffer out = {0};
  baum_status status = make(mechanism, &checked, sample, width, &out);
  if (status == BAUM_OK) {
    status = baum_i_give_text(&out, call, text, capacity, size);
  }
  baum_i_buffer_clear(&out);
  return status;
}
