/* SPDX-License-Identifier: BSD-3-Clause */
/* Draws the usual engineering symbols of joints and forces. Each kind has a line in the table at
 * the end. Lengths are in units. */
#include <string.h>

#include <baum/elements.h>
#include <baum/planar.h>
#include <baum/planar_joints.h>
#include <baum/spatial.h>
#include <baum/spline.h>

#include "draw/drawing.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/identify.h"
#include "mechanism/kinds.h"

static const double REACH = 11.0; /* half the length of a guide without samples */

/* The joint or force that a function draws. */
typedef struct symbol {
  baum_i_drawing *drawing;
  int number;
  const baum_i_element *element;
  const baum_i_place *place; /* its element is NULL if the kind has no place */
} symbol;

static void draw(const symbol *s, baum_i_style style, baum_i_form form, int body, double radius,
                 int count, const double (*points)[3])
{
  const double size = radius * s->drawing->unit;
  baum_i_draw(s->drawing, baum_i_shape_of(style, form, s->element, body, body, size), count,
              points);
}

static void draw_between(const symbol *s, baum_i_style style, const baum_i_place *from, int side,
                         const baum_i_place *to, double radius)
{
  const double *a = from->point[side];
  const double *b = to->point[1];
  const double points[2][3] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}};
  const baum_i_shape shape = baum_i_shape_of(style, BAUM_I_BETWEEN, s->element, from->body[side],
                                             to->body[1], radius * s->drawing->unit);
  baum_i_draw(s->drawing, shape, 2, points);
}

/* Draws a line through points that are x and y units from the point of the place, along two
 * directions. */
static void draw_line(const symbol *s, baum_i_style style, int side, double radius, int count,
                      const double (*xy)[2], const double along[3], const double across[3])
{
  enum { MOST = 128 };
  double points[MOST][3];
  for (int k = 0; k < count && k < MOST; k++) {
    for (int i = 0; i < 3; i++) {
      points[k][i] =
        s->place->point[side][i] + s->drawing->unit * (xy[k][0] * along[i] + xy[k][1] * across[i]);
    }
  }
  draw(s, style, BAUM_I_LINE, s->place->body[side], radius, count, (const double(*)[3])points);
}

/* A straight line along the axis, from -reach to reach units. */
static void draw_axis(const symbol *s, baum_i_style style, int side, double radius, double reach)
{
  const double xy[2][2] = {{-reach, 0.0}, {reach, 0.0}};
  draw_line(s, style, side, radius, 2, xy, s->place->axis[side], s->place->axis[side]);
}

static void draw_point(const symbol *s, baum_i_style style, int side, double radius)
{
  const double *at = s->place->point[side];
  const double points[2][3] = {{at[0], at[1], at[2]}, {0.0, 0.0, 1.0}};
  bool ball = s->drawing->spatial;
  draw(s, style, ball ? BAUM_I_BALL : BAUM_I_DISC, s->place->body[side], radius, ball ? 1 : 2,
       points);
}

/* For joints whose points coincide when they are assembled: a red line shows the gap between
 * them. */
static void draw_gap(const symbol *s)
{
  draw_between(s, BAUM_I_GAP, s->place, 0, s->place, 0.3);
}

/* Draws the symbol of the ground: a line with hatches below it. It is a single line that returns to
 * the edge after each hatch. */
static void draw_hatch(const symbol *s, int side, double half, double below, const double along[3],
                       const double across[3])
{
  enum { MOST = 40 };
  double xy[3 * MOST + 2][2] = {{-half, -below}};
  int count = 1;
  const double step = fmax(1.0, 2.0 * half / MOST);
  for (double x = -half + 0.9 * step; x <= half + 1e-9 && count < 3 * MOST; x += step) {
    const double hatch[3][2] = {{x, -below}, {x - 0.8, -below - 0.9}, {x, -below}};
    memcpy(xy[count], hatch, sizeof hatch);
    count += 3;
  }
  xy[count][0] = half;
  xy[count][1] = -below;
  draw_line(s, BAUM_I_GROUND, side, 0.0, count + 1, (const double(*)[2])xy, along, across);
}

static const double X[3] = {1.0, 0.0, 0.0}, Y[3] = {0.0, 1.0, 0.0};

/* ---- the plane ---- */

static void draw_ground_pin(const symbol *s)
{
  static const double foot[4][2] = {{0.0, 0.0}, {-1.5, -2.4}, {1.5, -2.4}, {0.0, 0.0}};
  for (int side = 0; side < 2; side++) {
    if (s->place->body[side] == 0) {
      draw_line(s, BAUM_I_GROUND, side, 0.0, 4, foot, X, Y);
      draw_hatch(s, side, 2.1, 2.4, X, Y);
    }
  }
}

static void draw_pin(const symbol *s)
{
  draw_ground_pin(s);
  draw_point(s, BAUM_I_JOINT, 1, 0.5);
  draw_gap(s);
}

static void draw_rod(const symbol *s)
{
  draw_between(s, BAUM_I_ROD, s->place, 0, s->place, 0.35);
  draw_point(s, BAUM_I_JOINT, 0, 0.4);
  draw_point(s, BAUM_I_JOINT, 1, 0.4);
}

static void draw_weld(const symbol *s)
{
  static const double square[5][2] = {
    {-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}, {-0.5, -0.5}};
  if (s->place->body[0] == 0) {
    draw_hatch(s, 0, 2.0, 0.0, X, Y);
  }
  draw_line(s, BAUM_I_JOINT, 1, 0.25, 5, square, X, Y);
  draw_gap(s);
}

/* A guide on body_a. Its place is in the middle of the path of body_b's point; `half` is half of
 * its length in units. */
typedef struct guide {
  baum_i_place place;
  symbol symbol; /* of that place */
  double half;
} guide;

/* Displacement of body_b's point from body_a's point along the axis [m]. */
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

static void find_guide(const symbol *s, double margin, guide *out)
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
  /* One sample, as in a live page, does not tell how far the motion goes. */
  out->half = motion->count > 1 ? 0.5 * (high - low) / s->drawing->unit + margin : REACH;
  out->place = *place;
  baum_i_add_scaled3(0.5 * (low + high), place->axis[0], out->place.point[0]);
  out->symbol = *s;
  out->symbol.place = &out->place;
}

static void draw_guide(const symbol *s)
{
  guide g;
  find_guide(s, 4.0, &g);
  const double *axis = s->place->axis[0];
  const double up[3] = {-axis[1], axis[0], 0.0};
  if (s->place->body[0] == 0) {
    draw_hatch(&g.symbol, 0, g.half, 2.0, axis, up);
  } else {
    draw_axis(&g.symbol, BAUM_I_ROD, 0, 0.35, g.half);
  }
}

static void draw_slot(const symbol *s)
{
  guide g;
  find_guide(s, 1.5, &g);
  draw_axis(&g.symbol, BAUM_I_SLOT, 0, 0.75, g.half);
  draw_point(s, BAUM_I_JOINT, 1, 0.5);
}

/* The rack is on the left of the axis for a positive radius. */
static void draw_rack(const symbol *s)
{
  guide g;
  find_guide(s, 4.0, &g);
  const double *axis = s->place->axis[0];
  const double left[3] = {-axis[1], axis[0], 0.0};
  double centre[3];
  baum_i_draw_move(s->drawing, s->place->body[1], s->place->body[0], s->place->point[1], centre);
  baum_i_add_scaled3(-1.0, g.place.point[0], centre);
  double y =
    (baum_i_dot3(centre, left) + baum_i_find_number(s->element, "radius")) / s->drawing->unit;
  double side = baum_i_find_number(s->element, "radius") > 0.0 ? 1.0 : -1.0;
  const double rack[2][2] = {{-g.half, y}, {g.half, y}};
  const double back[4][2] = {
    {-g.half, y}, {-g.half, y + 1.2 * side}, {g.half, y + 1.2 * side}, {g.half, y}};
  draw_line(&g.symbol, BAUM_I_ROD, 0, 0.0, 4, back, axis, left);
  draw_line(&g.symbol, BAUM_I_PITCH, 0, 0.0, 2, rack, axis, left);
}

static void draw_gear(const symbol *s)
{
  const baum_planar_gear_def *def = s->element->def;
  const baum_body_id ids[2] = {def->body_a, def->body_b};
  for (int k = 0; k < 2; k++) {
    double disc[2][3] = {{0.0}, {0.0, 0.0, 1.0}};
    int body = baum_i_body_index(s->drawing->mechanism, ids[k]);
    double radius =
      baum_i_gear_radius(s->drawing, s->drawing->mechanism->joints[s->number], body, disc[0]);
    if (radius > 0.0) {
      draw(s, BAUM_I_PITCH, BAUM_I_DISC, body, radius / s->drawing->unit, 2,
           (const double(*)[3])disc);
    }
  }
}

/* ---- a curve F = 0 ---- */

/* Moves a point onto the curve by Newton's method; false if the curve has no tangent there. */
static bool find_on_curve(const baum_planar_curve_def *def, double xy[2], double tangent[2])
{
  for (int k = 0; k < 5; k++) {
    double f[6] = {0.0};
    if (def->curve(xy, f, def->user) != 0) {
      return false;
    }
    double square = f[1] * f[1] + f[2] * f[2];
    if (!(square > 0.0) || !isfinite(f[0]) || !isfinite(square)) {
      return false;
    }
    xy[0] -= f[0] * f[1] / square;
    xy[1] -= f[0] * f[2] / square;
    tangent[0] = -f[2] / sqrt(square);
    tangent[1] = f[1] / sqrt(square);
  }
  return true;
}

/* Follows the curve in both directions until it closes or is as long as the mechanism. */
static void draw_curve(const symbol *s)
{
  enum { STEPS = 120 };
  const baum_planar_curve_def *def = s->element->def;
  const double h = s->drawing->unit;
  double points[2 * STEPS + 1][3] = {{0.0}};
  double start[3];
  baum_i_draw_move(s->drawing, s->place->body[1], s->place->body[0], s->place->point[1], start);
  int first = STEPS, last = STEPS;
  for (int way = -1; way <= 1; way += 2) {
    double xy[2] = {start[0], start[1]}, tangent[2];
    for (int k = 0; k < STEPS && find_on_curve(def, xy, tangent); k++) {
      int at = STEPS + way * k;
      points[at][0] = xy[0];
      points[at][1] = xy[1];
      first = at < first ? at : first;
      last = at > last ? at : last;
      if (k > 3 && way < 0 && hypot(xy[0] - points[STEPS][0], xy[1] - points[STEPS][1]) < h) {
        memcpy(points[at], points[STEPS], sizeof *points);
        draw(s, BAUM_I_GUIDE, BAUM_I_LINE, s->place->body[0], 0.15, STEPS - at + 1,
             (const double(*)[3])points + at);
        draw_point(s, BAUM_I_JOINT, 1, 0.4);
        return;
      }
      xy[0] += way * h * tangent[0];
      xy[1] += way * h * tangent[1];
    }
  }
  if (last > first) {
    draw(s, BAUM_I_GUIDE, BAUM_I_LINE, s->place->body[0], 0.15, last - first + 1,
         (const double(*)[3])points + first);
  }
  draw_point(s, BAUM_I_JOINT, 1, 0.4);
}

/* ---- space ---- */

static void draw_ball(const symbol *s)
{
  draw_point(s, BAUM_I_JOINT, 1, 1.2);
  draw_gap(s);
}

static void draw_hinge(const symbol *s)
{
  draw_axis(s, BAUM_I_JOINT, 0, 1.0, 1.5);
  draw_axis(s, BAUM_I_JOINT, 1, 0.45, 2.4);
  draw_gap(s);
}

static void draw_cross(const symbol *s)
{
  draw_axis(s, BAUM_I_JOINT, 0, 0.45, 1.8);
  draw_axis(s, BAUM_I_JOINT, 1, 0.45, 1.8);
  draw_gap(s);
}

static void draw_sleeve(const symbol *s)
{
  guide g;
  find_guide(s, 4.0, &g);
  draw_axis(&g.symbol, BAUM_I_GUIDE, 0, 0.4, g.half);
  draw_axis(s, BAUM_I_JOINT, 1, 1.0, 1.8);
}

static void draw_point_on_line(const symbol *s)
{
  guide g;
  find_guide(s, 3.0, &g);
  draw_axis(&g.symbol, BAUM_I_GUIDE, 0, 0.25, g.half);
  draw_point(s, BAUM_I_JOINT, 1, 0.9);
}

static void draw_plane(const symbol *s)
{
  static const double square[5][2] = {
    {-8.0, -8.0}, {8.0, -8.0}, {8.0, 8.0}, {-8.0, 8.0}, {-8.0, -8.0}};
  double x[3], y[3];
  baum_i_complete_axes(s->place->axis[0], x, y);
  draw_line(s, BAUM_I_GUIDE, 0, 0.2, 5, square, x, y);
  draw_point(s, BAUM_I_JOINT, 1, 0.9);
}

static void draw_clamp(const symbol *s)
{
  draw_point(s, BAUM_I_JOINT, 1, 0.8);
  draw_gap(s);
}

/* ---- forces ---- */

static void draw_spring(const symbol *s)
{
  bool damps = baum_i_find_number(s->element, "damping") > 0.0;
  bool pulls = baum_i_find_number(s->element, "stiffness") > 0.0;
  if (damps) {
    draw_between(s, BAUM_I_DAMPER, s->place, 0, s->place, 0.6);
  }
  if (pulls || !damps) {
    draw_between(s, BAUM_I_SPRING, s->place, 0, s->place, 1.1);
  }
  draw_point(s, BAUM_I_JOINT, 0, 0.3);
  draw_point(s, BAUM_I_JOINT, 1, 0.3);
}

static void draw_spiral(const symbol *s, const double x[3], const double y[3])
{
  enum { POINTS = 40 };
  double xy[POINTS][2];
  for (int k = 0; k < POINTS; k++) {
    double angle = 2.5 * BAUM_I_REVOLUTION * k / (POINTS - 1), radius = 0.7 + 0.055 * k;
    xy[k][0] = radius * cos(angle);
    xy[k][1] = radius * sin(angle);
  }
  draw_line(s, BAUM_I_SPRING, 1, 0.0, POINTS, (const double(*)[2])xy, x, y);
}

/* Draws the spring at the pin between the bodies, or else at the centre of mass of body_b. */
static void draw_torsion(const symbol *s)
{
  const baum_planar_torsion_spring_def *def = s->element->def;
  const baum_mechanism *m = s->drawing->mechanism;
  baum_i_place at = {
    .body = {baum_i_body_index(m, def->body_a), baum_i_body_index(m, def->body_b)}};
  for (int k = 0; k < m->joint_count; k++) {
    const baum_i_place *place = &s->drawing->places[k];
    if (place->element && place->body[0] + place->body[1] == at.body[0] + at.body[1] &&
        (place->body[0] == at.body[0] || place->body[0] == at.body[1])) {
      memcpy(at.point[1], place->point[place->body[1] == at.body[1]], sizeof at.point[1]);
    }
  }
  const symbol spiral = {s->drawing, s->number, s->element, &at};
  draw_spiral(&spiral, X, Y);
}

/* Draws an arc with an arrow tip in the plane of x and y. */
static void draw_arc(const symbol *s, baum_i_style style, int side, const double x[3],
                     const double y[3])
{
  enum { ARC = 22, POINTS = ARC + 4 };
  const double radius = 2.3, end = 4.4;
  double xy[POINTS][2];
  for (int k = 0; k < ARC; k++) {
    double angle = 0.6 + (end - 0.6) * k / (ARC - 1);
    xy[k][0] = radius * cos(angle);
    xy[k][1] = radius * sin(angle);
  }
  for (int k = 0; k < 3; k++) { /* the arrow tip */
    double r = radius + (k == 0 ? -0.6 : k == 1 ? 0.0 : 0.6), angle = end - (k == 1 ? 0.0 : 0.35);
    xy[ARC + k][0] = r * cos(angle);
    xy[ARC + k][1] = r * sin(angle);
  }
  memcpy(xy[POINTS - 1], xy[ARC - 1], sizeof *xy);
  draw_line(s, style, side, 0.0, POINTS, (const double(*)[2])xy, x, y);
}

static void draw_vector(const symbol *s, baum_i_style style, baum_body_id id, bool follows,
                        const double point[3], const double vector[3])
{
  const int body = baum_i_body_index(s->drawing->mechanism, id);
  const double points[2][3] = {{point[0], point[1], point[2]}, {vector[0], vector[1], vector[2]}};
  const baum_i_shape shape =
    baum_i_shape_of(style, BAUM_I_ARROW, s->element, body, follows ? body : 0, 0.0);
  if (baum_i_dot3(vector, vector) > 0.0) {
    baum_i_draw(s->drawing, shape, 2, points);
  }
}

/* Draws a force as an arrow and a torque as an arc. */
static void draw_planar_load(const symbol *s)
{
  const baum_planar_load_def *def = s->element->def;
  const double point[3] = {def->point[0], def->point[1], 0.0};
  const double force[3] = {def->force[0], def->force[1], 0.0};
  const double down[3] = {0.0, -1.0, 0.0};
  const int body = baum_i_body_index(s->drawing->mechanism, def->body);
  baum_i_place at = {.body = {body, body}};
  memcpy(at.point[1], point, sizeof point);
  const symbol arc = {s->drawing, s->number, s->element, &at};
  draw_vector(s, BAUM_I_LOAD, def->body, def->follows_body, point, force);
  if (def->torque != 0.0) {
    draw_arc(&arc, BAUM_I_LOAD, 1, X, def->torque > 0.0 ? Y : down);
  }
}

static void draw_spatial_load(const symbol *s)
{
  const baum_spatial_load_def *def = s->element->def;
  draw_vector(s, BAUM_I_LOAD, def->body, def->follows_body, def->point, def->force);
  draw_vector(s, BAUM_I_MOMENT, def->body, def->follows_body, def->point, def->moment);
}

/* ---- joints of joints, functions ---- */

static const baum_i_place *place_of(const symbol *s, baum_joint_id id)
{
  const baum_i_place *place = &s->drawing->places[baum_i_joint_index(s->drawing->mechanism, id)];
  return place->element ? place : NULL;
}

static void draw_coupling(const symbol *s)
{
  const baum_coupling_def *def = s->element->def;
  const baum_i_place *a = place_of(s, def->joint_a);
  const baum_i_place *b = place_of(s, def->joint_b);
  if (a && b) {
    draw_between(s, BAUM_I_COUPLING, a, 1, b, 0.0);
  }
}

static bool is_angle(const symbol *s, baum_joint_id id, baum_joint_coordinate which)
{
  const baum_i_joint_coordinate c = baum_i_joint_coordinate_of(s->drawing->mechanism, id, which);
  return baum_i_is_angle(&c);
}

/* Draws a spiral about the axis of an angle, or a coil along the axis of a displacement. */
static void draw_joint_spring(const symbol *s)
{
  const baum_joint_spring_def *def = s->element->def;
  const baum_i_place *place = place_of(s, def->joint);
  double x[3], y[3];
  if (!place) {
    return;
  }
  const symbol spring = {s->drawing, s->number, s->element, place};
  if (is_angle(s, def->joint, def->coordinate)) {
    baum_i_complete_axes(place->axis[1], x, y);
    draw_spiral(&spring, x, y);
  } else {
    draw_between(&spring, BAUM_I_SPRING, place, 0, place, 1.1);
  }
}

/* Draws an arc about the axis of an angle, or an arrow along the axis of a displacement. */
static void draw_driver(const symbol *s)
{
  static const double arrow[5][2] = {{-4.0, 3.0}, {4.0, 3.0}, {3.0, 3.6}, {4.0, 3.0}, {3.0, 2.4}};
  const bool spline = s->element->definition == baum_i_spline_driver_definition;
  const baum_spline_driver_def *by_spline = s->element->def;
  const baum_driver_def *by_law = s->element->def;
  const baum_joint_id id = spline ? by_spline->joint : by_law->joint;
  const baum_joint_coordinate which = spline ? by_spline->coordinate : by_law->coordinate;
  const baum_i_place *place = place_of(s, id);
  if (!place) {
    return;
  }
  const symbol driven = {s->drawing, s->number, s->element, place};
  double x[3], y[3];
  baum_i_complete_axes(place->axis[0], x, y);
  if (is_angle(s, id, which)) {
    draw_arc(&driven, BAUM_I_DRIVER, 0, x, y);
    return;
  }
  guide g;
  find_guide(&driven, 0.0, &g);
  const double *axis = place->axis[0];
  const double left[3] = {-axis[1], axis[0], 0.0};
  const double *up = s->drawing->spatial ? x : left;
  draw_line(&g.symbol, BAUM_I_DRIVER, 0, 0.0, 5, arrow, axis, up);
}

/* Draws user constraints and forces as a dot on each of their bodies. */
static void draw_user(const symbol *s)
{
  const baum_mechanism *m = s->drawing->mechanism;
  int joint = s->number < m->joint_count;
  const baum_i_span *span =
    joint ? &m->joints[s->number]->span : &m->forces[s->number - m->joint_count]->span;
  const double origin[1][3] = {{0.0, 0.0, 0.0}};
  for (int k = 0; k < span->body_count; k++) {
    if (baum_i_frame_of(m->bodies[span->bodies[k]]) != BAUM_I_FRAME_NONE) {
      draw(s, BAUM_I_USER, BAUM_I_BALL, span->bodies[k], 0.5, 1, origin);
    }
  }
}

/* ---- the table ---- */

typedef struct kind {
  const baum_i_definition *const *definition;
  void (*draw)(const symbol *s);
} kind;

static const kind KINDS[] = {
  {&baum_i_planar_revolute_definition, draw_pin},
  {&baum_i_planar_distance_definition, draw_rod},
  {&baum_i_planar_translational_definition, draw_guide},
  {&baum_i_planar_fixed_definition, draw_weld},
  {&baum_i_planar_pin_in_slot_definition, draw_slot},
  {&baum_i_planar_rack_and_pinion_definition, draw_rack},
  {&baum_i_planar_gear_definition, draw_gear},
  {&baum_i_planar_curve_definition, draw_curve},
  {&baum_i_spatial_spherical_definition, draw_ball},
  {&baum_i_spatial_revolute_definition, draw_hinge},
  {&baum_i_spatial_universal_definition, draw_cross},
  {&baum_i_spatial_cylindrical_definition, draw_sleeve},
  {&baum_i_spatial_prismatic_definition, draw_sleeve},
  {&baum_i_spatial_planar_definition, draw_plane},
  {&baum_i_spatial_fixed_definition, draw_clamp},
  {&baum_i_spatial_distance_definition, draw_rod},
  {&baum_i_spatial_point_on_line_definition, draw_point_on_line},
  {&baum_i_spatial_point_on_plane_definition, draw_plane},
  {&baum_i_coupling_definition, draw_coupling},
  {&baum_i_driver_definition, draw_driver},
  {&baum_i_spline_driver_definition, draw_driver},
  {&baum_i_user_constraint_definition, draw_user},
  {&baum_i_planar_spring_definition, draw_spring},
  {&baum_i_planar_torsion_spring_definition, draw_torsion},
  {&baum_i_planar_load_definition, draw_planar_load},
  {&baum_i_spatial_spring_definition, draw_spring},
  {&baum_i_spatial_load_definition, draw_spatial_load},
  {&baum_i_joint_spring_definition, draw_joint_spring},
  {&baum_i_user_force_definition, draw_user},
};

void baum_i_draw_symbol(baum_i_drawing *drawing, int number)
{
  const baum_mechanism *m = drawing->mechanism;
  const baum_i_element *element = number < m->joint_count
                                    ? &m->joints[number]->element
                                    : &m->forces[number - m->joint_count]->element;
  const symbol s = {drawing, number, element, &drawing->places[number]};
  for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k++) {
    if (*KINDS[k].definition == element->definition) {
      KINDS[k].draw(&s);
    }
  }
}
