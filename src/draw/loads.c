/* SPDX-License-Identifier: BSD-3-Clause */
/* Symbols of springs, dampers and loads, and of elements that act on joints: couplings, drivers and
 * user functions. */
#include <string.h>

#include <baum/elements.h>
#include <baum/planar.h>
#include <baum/spatial.h>
#include <baum/spline.h>

#include "draw/symbols.h"
#include "mechanism/general/coordinate.h"
#include "mechanism/identify.h"
#include "mechanism/kinds.h"

static const double X[3] = {1.0, 0.0, 0.0}, Y[3] = {0.0, 1.0, 0.0};

/* Draws a spring and its damper. They are side by side in the plane, and coaxial in space. */
void baum_i_draw_spring(const baum_i_symbol *s)
{
  bool damps = baum_i_find_number(s->element, "damping") > 0.0;
  bool pulls = baum_i_find_number(s->element, "stiffness") > 0.0 || !damps;
  const double apart = damps && pulls && !s->drawing->spatial ? 1.0 : 0.0;
  if (damps) {
    baum_i_symbol_between(s, BAUM_I_DAMPER, s->place, 0, s->place, 0.6, -0.9 * apart);
  }
  if (pulls) {
    baum_i_symbol_between(s, BAUM_I_SPRING, s->place, 0, s->place, 1.1, 1.2 * apart);
  }
  for (int side = 0; side < 2; side++) {
    baum_i_draw_anchor(s, side);
    baum_i_symbol_point(s, BAUM_I_JOINT, side, 0.3);
  }
}

/* Draws a cable as straight lines with a dot at each point. */
void baum_i_draw_cable(const baum_i_symbol *s)
{
  const baum_spatial_cable_def *def = s->element->def;
  for (int k = 0; k < def->point_count; k++) {
    const int more = k + 1 < def->point_count ? 1 : 0;
    double points[2][3] = {{0.0}};
    memcpy(points, def->points + (ptrdiff_t)3 * k, (size_t)(3 * (1 + more)) * sizeof **points);
    const int body = baum_i_body_index(s->drawing->mechanism, def->bodies[k]);
    if (more) {
      const int next = baum_i_body_index(s->drawing->mechanism, def->bodies[k + 1]);
      const baum_i_shape line = baum_i_shape_of(BAUM_I_ROD, BAUM_I_BETWEEN, s->element, body, next,
                                                0.15 * s->drawing->unit);
      baum_i_draw(s->drawing, line, 2, (const double(*)[3])points);
    }
    baum_i_symbol_shape(s, BAUM_I_JOINT, BAUM_I_BALL, body, 0.4, 1, (const double(*)[3])points);
  }
}

static void draw_spiral(const baum_i_symbol *s, const double x[3], const double y[3])
{
  enum { POINTS = 72 };
  double xy[POINTS][2];
  for (int k = 0; k < POINTS; k++) {
    double angle = 2.5 * BAUM_I_REVOLUTION * k / (POINTS - 1), radius = 0.7 + 0.03 * k;
    xy[k][0] = radius * cos(angle);
    xy[k][1] = radius * sin(angle);
  }
  baum_i_symbol_line(s, BAUM_I_SPRING, 1, 0.0, POINTS, (const double(*)[2])xy, x, y);
}

/* Draws the spring at the last joint between its two bodies. If no joint connects these bodies,
 * draws the spring at the centre of mass of body_b. */
void baum_i_draw_torsion(const baum_i_symbol *s)
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
  const baum_i_symbol spiral = {s->drawing, s->number, s->element, &at};
  draw_spiral(&spiral, X, Y);
}

/* Draws an arc with an arrow tip, in the plane of the vectors x and y. */
static void draw_arc(const baum_i_symbol *s, baum_i_style style, int side, const double x[3],
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
  for (int k = 0; k < 3; k++) { /* the arrow tip at the end of the arc */
    double r = radius + (k == 0 ? -0.6 : k == 1 ? 0.0 : 0.6), angle = end - (k == 1 ? 0.0 : 0.35);
    xy[ARC + k][0] = r * cos(angle);
    xy[ARC + k][1] = r * sin(angle);
  }
  memcpy(xy[POINTS - 1], xy[ARC - 1], sizeof *xy);
  baum_i_symbol_line(s, style, side, 0.0, POINTS, (const double(*)[2])xy, x, y);
}

static void draw_vector(const baum_i_symbol *s, baum_i_style style, baum_body_id id, bool follows,
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
void baum_i_draw_planar_load(const baum_i_symbol *s)
{
  const baum_planar_load_def *def = s->element->def;
  const double point[3] = {def->point[0], def->point[1], 0.0};
  const double force[3] = {def->force[0], def->force[1], 0.0};
  const double down[3] = {0.0, -1.0, 0.0};
  const int body = baum_i_body_index(s->drawing->mechanism, def->body);
  baum_i_place at = {.body = {body, body}};
  memcpy(at.point[1], point, sizeof point);
  const baum_i_symbol arc = {s->drawing, s->number, s->element, &at};
  draw_vector(s, BAUM_I_LOAD, def->body, def->follows_body, point, force);
  if (def->torque != 0.0) {
    draw_arc(&arc, BAUM_I_LOAD, 1, X, def->torque > 0.0 ? Y : down);
  }
}

void baum_i_draw_spatial_load(const baum_i_symbol *s)
{
  const baum_spatial_load_def *def = s->element->def;
  draw_vector(s, BAUM_I_LOAD, def->body, def->follows_body, def->point, def->force);
  draw_vector(s, BAUM_I_MOMENT, def->body, def->follows_body, def->point, def->moment);
}

void baum_i_draw_coupling(const baum_i_symbol *s)
{
  const baum_coupling_def *def = s->element->def;
  const baum_i_place *a = baum_i_place_of(s, def->joint_a);
  const baum_i_place *b = baum_i_place_of(s, def->joint_b);
  if (a && b) {
    baum_i_symbol_between(s, BAUM_I_COUPLING, a, 1, b, 0.0, 0.0);
  }
}

static bool is_angle(const baum_i_symbol *s, baum_joint_id id, baum_joint_coordinate which)
{
  const baum_i_joint_coordinate c = baum_i_joint_coordinate_of(s->drawing->mechanism, id, which);
  return baum_i_is_angle(&c);
}

/* Draws a spring as a spiral about its axis if it acts on an angle, and as a coil along its axis if
 * it acts on a displacement. */
void baum_i_draw_joint_spring(const baum_i_symbol *s)
{
  const baum_joint_spring_def *def = s->element->def;
  const baum_i_place *place = baum_i_place_of(s, def->joint);
  double x[3], y[3];
  if (!place) {
    return;
  }
  const baum_i_symbol spring = {s->drawing, s->number, s->element, place};
  if (is_angle(s, def->joint, def->coordinate)) {
    baum_i_complete_axes(place->axis[1], x, y);
    draw_spiral(&spring, x, y);
  } else {
    baum_i_symbol_between(&spring, BAUM_I_SPRING, place, 0, place, 1.1, 0.0);
    baum_i_draw_anchor(&spring, 0);
  }
}

/* Draws the spring as a spiral about its axis, at its point on body_b. */
void baum_i_draw_spatial_torsion(const baum_i_symbol *s)
{
  double x[3], y[3];
  baum_i_complete_axes(s->place->axis[1], x, y);
  draw_spiral(s, x, y);
  baum_i_draw_anchor(s, 0);
}

/* Draws two spirals in perpendicular planes, at the point on body_b. */
void baum_i_draw_bushing(const baum_i_symbol *s)
{
  double x[3], y[3];
  baum_i_complete_axes(s->place->axis[1], x, y);
  draw_spiral(s, x, y);
  draw_spiral(s, s->place->axis[1], x);
  baum_i_draw_anchor(s, 0);
}

/* Draws a driver or a load of a joint as an arc about the axis of the joint if it acts on an angle,
 * and as an arrow along this axis if it acts on a displacement. */
static void draw_effort(const baum_i_symbol *s, baum_i_style style, baum_joint_id id,
                        baum_joint_coordinate which, bool backward)
{
  const baum_i_place *place = baum_i_place_of(s, id);
  if (!place) {
    return;
  }
  baum_i_place at = *place;
  const int side = which == BAUM_COORDINATE_ANGLE_B ? 1 : 0;
  for (int i = 0; backward && i < 3; i++) {
    at.axis[side][i] *= -1.0;
  }
  const baum_i_symbol symbol = {s->drawing, s->number, s->element, &at};
  double x[3], y[3];
  baum_i_complete_axes(at.axis[side], x, y);
  if (is_angle(s, id, which)) {
    draw_arc(&symbol, style, side, x, y);
  } else {
    baum_i_draw_guide_arrow(&symbol, style);
  }
}

void baum_i_draw_driver(const baum_i_symbol *s)
{
  const bool spline = s->element->definition == baum_i_spline_driver_definition;
  const baum_spline_driver_def *by_spline = s->element->def;
  const baum_driver_def *by_law = s->element->def;
  const baum_joint_id id = spline ? by_spline->joint : by_law->joint;
  const baum_joint_coordinate which = spline ? by_spline->coordinate : by_law->coordinate;
  draw_effort(s, BAUM_I_DRIVER, id, which, false);
}

/* Draws the arrow in the direction in which a positive input drives the coordinate. */
void baum_i_draw_joint_load(const baum_i_symbol *s)
{
  const baum_joint_load_def *def = s->element->def;
  draw_effort(s, BAUM_I_LOAD, def->joint, def->coordinate, def->effort < 0.0);
}

/* Draws user constraints and forces as a dot on each of their bodies. */
void baum_i_draw_user(const baum_i_symbol *s)
{
  const baum_mechanism *m = s->drawing->mechanism;
  int joint = s->number < m->joint_count;
  const baum_i_span *span =
    joint ? &m->joints[s->number]->span : &m->forces[s->number - m->joint_count]->span;
  const double origin[1][3] = {{0.0, 0.0, 0.0}};
  for (int k = 0; k < span->body_count; k++) {
    if (baum_i_frame_of(m->bodies[span->bodies[k]]) != BAUM_I_FRAME_NONE) {
      baum_i_symbol_shape(s, BAUM_I_USER, BAUM_I_BALL, span->bodies[k], 0.5, 1, origin);
    }
  }
}
