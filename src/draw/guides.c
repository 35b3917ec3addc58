/* SPDX-License-Identifier: BSD-3-Clause */
/* Symbols of joints whose bodies slide along each other. */
#include <string.h>

#include <baum/planar_joints.h>
#include <baum/spatial_points.h>

#include "draw/symbols.h"
#include "mechanism/kinds.h"

/* Half the length of a guide, in units, if there are fewer than two samples of a motion. */
static const double REACH = 11.0;

/* A guide on body_a. Its place is the middle of the path of body_b's point. `half` is half the
 * length of the guide, in units. */
typedef struct guide {
  baum_i_place place;
  baum_i_symbol symbol; /* the symbol at this place */
  double half;
} guide;

/* Returns the displacement [m] of body_b's point relative to body_a's point along the axis. */
static double displacement(const baum_i_place *place, const baum_i_spatial_frame *a,
                           const baum_i_spatial_frame *b)
{
  double at[3], on_a[3];
  baum_i_turn(b->axes, place->point[1], at);
  baum_i_add_scaled3(1.0, b->r, at);
  baum_i_add_scaled3(-1.0, a->r, at);
  baum_i_turn_back(a->axes, at, on_a);
  return baum_i_dot3(place->axis[0], on_a) - baum_i_dot3(place->axis[0], place->point[0]);
}

static void find_guide(const baum_i_symbol *s, double margin, guide *out)
{
  enum { SAMPLES = 100 };
  const baum_mechanism *m = s->drawing->mechanism;
  const baum_i_place *place = s->place;
  const baum_i_samples *motion = &s->drawing->motion;
  double low = INFINITY, high = -INFINITY;
  for (int64_t k = 0; k < motion->count; k += 1 + motion->count / SAMPLES) {
    const double *q = motion->q + k * motion->stride;
    const baum_i_spatial_frame a = baum_i_drawing_frame(m->bodies[place->body[0]], q);
    const baum_i_spatial_frame b = baum_i_drawing_frame(m->bodies[place->body[1]], q);
    low = fmin(low, displacement(place, &a, &b));
    high = fmax(high, displacement(place, &a, &b));
  }
  if (!isfinite(high - low)) {
    low = high =
      displacement(place, &s->drawing->design[place->body[0]], &s->drawing->design[place->body[1]]);
  }
  /* The extent of the motion is unknown if there is only one sample, as in a live page. */
  out->half = motion->count > 1 ? 0.5 * (high - low) / s->drawing->unit + margin : REACH;
  out->place = *place;
  baum_i_add_scaled3(0.5 * (low + high), place->axis[0], out->place.point[0]);
  out->symbol = *s;
  out->symbol.place = &out->place;
}

/* Draws the edge of the ground along a planar guide. */
static void draw_edge(const guide *g, double below)
{
  double up[3];
  baum_i_find_free_side(&g->symbol, up);
  const double along[3] = {up[1], -up[0], 0.0};
  baum_i_draw_hatch(&g->symbol, 0, g->half, below, along, up);
}

void baum_i_draw_guide(const baum_i_symbol *s)
{
  guide g;
  find_guide(s, 4.0, &g);
  if (s->place->body[0] == 0) {
    draw_edge(&g, 2.0);
  } else {
    baum_i_symbol_axis(&g.symbol, BAUM_I_ROD, 0, 0.35, g.half);
  }
}

void baum_i_draw_slot(const baum_i_symbol *s)
{
  guide g;
  find_guide(s, 1.5, &g);
  if (s->place->body[0] == 0) {
    draw_edge(&g, 1.1);
  }
  baum_i_symbol_axis(&g.symbol, BAUM_I_SLOT, 0, 0.75, g.half);
  baum_i_symbol_point(s, BAUM_I_JOINT, 1, 0.5);
}

/* Draws a rack. Its pitch line is at a distance of y units from the place, in the direction `left`.
 * The rack is on the left of the pitch line if `side` is 1, and on the right if `side` is -1. */
static void draw_teeth(const guide *g, double y, double side, const double left[3])
{
  enum { TEETH = 28 };
  static const double tooth[4][2] = {{0.05, -0.5}, {0.25, 0.6}, {0.55, 0.6}, {0.75, -0.5}};
  double xy[4 * TEETH + 2][2];
  const double step = fmax(1.6, 2.0 * g->half / TEETH);
  const int teeth = (int)(2.0 * g->half / step);
  const double end = 0.5 * teeth * step;
  for (int k = 0; k < 4 * teeth; k++) {
    xy[k][0] = -end + (k / 4 + tooth[k % 4][0]) * step;
    xy[k][1] = y - side * tooth[k % 4][1];
  }
  for (int k = 0; k < 2; k++) {
    xy[4 * teeth + k][0] = k ? -end : end;
    xy[4 * teeth + k][1] = y + 1.5 * side;
  }
  baum_i_symbol_area(&g->symbol, BAUM_I_BODY, 0, 4 * teeth + 2, (const double(*)[2])xy,
                     g->place.axis[0], left);
}

/* The rack is to the left of the pinion if the radius of the pinion is positive. */
void baum_i_draw_rack(const baum_i_symbol *s)
{
  guide g;
  find_guide(s, 4.0, &g);
  const double radius = baum_i_find_number(s->element, "radius");
  const double *axis = s->place->axis[0];
  const double left[3] = {-axis[1], axis[0], 0.0};
  double disc[2][3] = {{0.0}, {0.0, 0.0, 1.0}};
  double centre[3];
  memcpy(disc[0], s->place->point[1], sizeof disc[0]);
  baum_i_draw_move(s->drawing, s->place->body[1], s->place->body[0], s->place->point[1], centre);
  baum_i_add_scaled3(-1.0, g.place.point[0], centre);
  double y = (baum_i_dot3(centre, left) + radius) / s->drawing->unit;
  const double line[2][2] = {{-g.half, y}, {g.half, y}};
  draw_teeth(&g, y, radius > 0.0 ? 1.0 : -1.0, left);
  baum_i_symbol_line(&g.symbol, BAUM_I_PITCH, 0, 0.0, 2, line, axis, left);
  baum_i_symbol_shape(s, BAUM_I_PITCH, BAUM_I_DISC, s->place->body[1],
                      fabs(radius) / s->drawing->unit, 2, (const double(*)[3])disc);
}

/* Draws a blade as it looks from above: long, and pointed at both ends. */
void baum_i_draw_blade(const baum_i_symbol *s)
{
  static const double outline[4][2] = {{-3.0, 0.0}, {0.0, -0.6}, {3.0, 0.0}, {0.0, 0.6}};
  const double *axis = s->place->axis[0];
  const double left[3] = {-axis[1], axis[0], 0.0};
  baum_i_symbol_area(s, BAUM_I_JOINT, 0, 4, outline, axis, left);
}

/* ---- a curve F = 0 in the plane, or F = G = 0 in space ---- */

/* Evaluates F, G and their gradients at a point. For planar curves, G is z. Returns false if the
 * user function fails. */
static bool evaluate_curve(const baum_i_symbol *s, const double at[3], double value[2],
                           double gradient[2][3])
{
  double f[20] = {0.0};
  if (s->element->definition == baum_i_planar_curve_definition) {
    const baum_planar_curve_def *def = s->element->def;
    const bool fine = def->curve(at, f, def->user) == 0;
    f[3] = 0.0;
    memset(f + 10, 0, 10 * sizeof *f);
    f[10] = at[2];
    f[13] = 1.0;
    if (!fine) {
      return false;
    }
  } else {
    const baum_spatial_curve_def *def = s->element->def;
    if (def->curve(at, f, def->user) != 0) {
      return false;
    }
  }
  for (int k = 0; k < 2; k++) {
    value[k] = f[10 * k];
    memcpy(gradient[k], f + (ptrdiff_t)10 * k + 1, 3 * sizeof *f);
  }
  return true;
}

/* Moves a point onto the curve by five Newton steps of least norm, and finds the tangent of the
 * curve there. Returns false if the curve has no tangent or the user function fails. */
static bool find_on_curve(const baum_i_symbol *s, double at[3], double tangent[3])
{
  for (int k = 0; k < 5; k++) {
    double f[2], n[2][3];
    if (!evaluate_curve(s, at, f, n)) {
      return false;
    }
    const double ff = baum_i_dot3(n[0], n[0]);
    const double fg = baum_i_dot3(n[0], n[1]);
    const double gg = baum_i_dot3(n[1], n[1]);
    const double square = ff * gg - fg * fg;
    if (!(square > 0.0) || !isfinite(f[0]) || !isfinite(f[1]) || !isfinite(square)) {
      return false;
    }
    baum_i_add_scaled3((fg * f[1] - gg * f[0]) / square, n[0], at);
    baum_i_add_scaled3((fg * f[0] - ff * f[1]) / square, n[1], at);
    baum_i_cross(n[1], n[0], tangent);
    for (int i = 0; i < 3; i++) {
      tangent[i] /= sqrt(square);
    }
  }
  return true;
}

/* Largest numbers of steps in one direction: CURVE_STEPS along a closed curve, and TRACK_STEPS
 * along an open curve. Each step is one unit long. */
enum { CURVE_STEPS = 240, TRACK_STEPS = 60 };

typedef struct path {
  double points[2 * CURVE_STEPS + 1][3]; /* in the axes of body_a */
  int first, last;
  bool closed;
} path;

/* Follows the curve from the starting point in one direction, until it closes or ends, but for at
 * most `most` steps. */
static void follow_curve(const baum_i_symbol *s, const double start[3], int direction, int most,
                         path *out)
{
  const double h = s->drawing->unit;
  const double *origin = s->place->point[0];
  const double *middle = out->points[CURVE_STEPS];
  double x[3] = {start[0] - origin[0], start[1] - origin[1], start[2] - origin[2]}, tangent[3];
  for (int k = 0; k < most && find_on_curve(s, x, tangent); k++) {
    const int at = CURVE_STEPS + direction * k;
    double *point = out->points[at];
    double away[3];
    for (int i = 0; i < 3; i++) {
      point[i] = origin[i] + x[i];
      away[i] = point[i] - middle[i];
    }
    *(direction < 0 ? &out->first : &out->last) = at;
    if (k > 3 && baum_i_dot3(away, away) < h * h) {
      memcpy(point, middle, sizeof *out->points);
      out->closed = true;
      return;
    }
    baum_i_add_scaled3(direction * h, tangent, x);
  }
}

/* Finds the points of a curve. If the curve is open, finds only the points within TRACK_STEPS steps
 * on either side of the starting point. */
static void find_path(const baum_i_symbol *s, path *out)
{
  double start[3];
  baum_i_draw_move(s->drawing, s->place->body[1], s->place->body[0], s->place->point[1], start);
  out->first = out->last = CURVE_STEPS;
  follow_curve(s, start, -1, CURVE_STEPS, out);
  if (!out->closed) {
    const int least = CURVE_STEPS - TRACK_STEPS;
    out->first = out->first < least ? least : out->first;
    follow_curve(s, start, 1, TRACK_STEPS, out);
  }
}

/* Draws the curve. A closed curve on a body in the plane is drawn as a cam, and all other curves as
 * tracks. */
void baum_i_draw_curve(const baum_i_symbol *s)
{
  const bool planar = s->element->definition == baum_i_planar_curve_definition;
  const int body = s->place->body[0];
  path curve = {.closed = false};
  find_path(s, &curve);
  const int count = curve.last - curve.first + 1;
  double(*points)[3] = curve.points + curve.first;
  if (curve.closed && body != 0 && planar) {
    baum_i_symbol_shape(s, BAUM_I_WHEEL, BAUM_I_AREA, body, 0.0, count, (const double(*)[3])points);
  } else if (count > 1) {
    baum_i_symbol_shape(s, BAUM_I_GUIDE, BAUM_I_LINE, body, 0.15, count,
                        (const double(*)[3])points);
  }
  if (count > 1) {
    baum_i_draw_gap_to_line(s->drawing, s->place, count, (const double(*)[3])points);
  }
  baum_i_symbol_point(s, BAUM_I_JOINT, 1, planar ? 0.4 : 0.9);
}

/* ---- space ---- */

/* Draws the rail that is fixed on body_a. If body_a is the ground, the rail has feet under its
 * ends. */
static void draw_rail(const baum_i_symbol *s, double radius, guide *g)
{
  find_guide(s, 6.0, g);
  baum_i_symbol_axis(&g->symbol, BAUM_I_GUIDE, 0, radius, g->half);
  for (int sign = -1; sign <= 1 && s->place->body[0] == 0; sign += 2) {
    const baum_i_place end = baum_i_move_place(&g->symbol, sign * g->half, g->place.axis[0]);
    baum_i_symbol foot = g->symbol;
    foot.place = &end;
    baum_i_draw_foot(&foot);
  }
}

void baum_i_draw_cylinder(const baum_i_symbol *s)
{
  guide g;
  draw_rail(s, 0.5, &g);
  baum_i_symbol_axis(s, BAUM_I_JOINT, 1, 1.1, 1.8);
}

/* Draws a square sleeve. Its shape shows that it cannot rotate about its rail. */
void baum_i_draw_slide(const baum_i_symbol *s)
{
  static const double face[4][2] = {{-2.4, -1.3}, {2.4, -1.3}, {2.4, 1.3}, {-2.4, 1.3}};
  guide g;
  double across[2][3];
  const double *axis = s->place->axis[1];
  draw_rail(s, 0.5, &g);
  baum_i_complete_axes(axis, across[0], across[1]);
  for (int k = 0; k < 4; k++) {
    baum_i_place place = *s->place;
    const baum_i_symbol moved = {s->drawing, s->number, s->element, &place};
    baum_i_add_scaled3((k < 2 ? 1.3 : -1.3) * s->drawing->unit, across[k % 2], place.point[1]);
    baum_i_symbol_area(&moved, BAUM_I_JOINT, 1, 4, face, axis, across[1 - k % 2]);
  }
}

void baum_i_draw_point_on_line(const baum_i_symbol *s)
{
  guide g;
  draw_rail(s, 0.25, &g);
  baum_i_symbol_point(s, BAUM_I_JOINT, 1, 0.9);
}

/* ---- drivers ---- */

void baum_i_draw_guide_arrow(const baum_i_symbol *s, baum_i_style style)
{
  static const double arrow[5][2] = {{-4.0, 3.0}, {4.0, 3.0}, {3.0, 3.6}, {4.0, 3.0}, {3.0, 2.4}};
  guide g;
  double up[3], y[3];
  find_guide(s, 0.0, &g);
  if (s->drawing->spatial) {
    baum_i_complete_axes(s->place->axis[0], up, y);
  } else {
    baum_i_find_free_side(s, up);
  }
  baum_i_symbol_line(&g.symbol, style, 0, 0.0, 5, arrow, s->place->axis[0], up);
}
