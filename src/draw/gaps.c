/* SPDX-License-Identifier: BSD-3-Clause */
/* Draws gaps, which are red lines that show the constraint violation of a joint. They connect
 * points that should coincide, or a point with the line, plane or sphere on which it should be.
 * They also connect the tips of axes that should be parallel. Pictures omit lines that are too
 * short to be seen. Joints that relate coordinates (gears, racks, couplings and drivers) have no
 * red lines.
 */
#include <string.h>

#include "base/alloc.h"
#include "draw/drawing.h"

/* TIP is the distance between the joint and the tips of its axes. ENDLESS is half the length with
 * which an infinite line is drawn. Both are in drawing units. */
static const double TIP = 4.0, ENDLESS = 1000.0;

typedef struct gaps {
  baum_i_drawing *drawing;
  const baum_i_place *place;
  int what;
} gaps;

/* Draws the gap at the joint. The end on body_a is shifted by on_a in the axes of body_a, and the
 * end on body_b is shifted by on_b in the axes of body_b. */
static void draw_gap(const gaps *g, const double on_a[3], const double on_b[3])
{
  const baum_i_place *place = g->place;
  const double *a = place->point[0], *b = place->point[1], *axis = place->axis[0];
  const double reach = ENDLESS * g->drawing->unit;
  const double length =
    g->what & BAUM_I_GAP_LENGTH ? baum_i_find_number(place->element, "length") : 0.0;
  double points[3][3] = {{0.0}};
  for (int i = 0; i < 3; i++) {
    points[0][i] = b[i] + on_b[i];
    points[1][i] = a[i] + on_a[i] - (g->what & BAUM_I_GAP_LINE ? reach * axis[i] : 0.0);
    points[2][i] = g->what & BAUM_I_GAP_LINE ? a[i] + on_a[i] + reach * axis[i] : axis[i];
  }
  if (g->what & BAUM_I_GAP_LENGTH) {
    points[2][0] = length;
  }
  const baum_i_form form = g->what & BAUM_I_GAP_LINE     ? BAUM_I_TO_LINE
                           : g->what & BAUM_I_GAP_PLANE  ? BAUM_I_TO_PLANE
                           : g->what & BAUM_I_GAP_LENGTH ? BAUM_I_TO_SPHERE
                                                         : BAUM_I_BETWEEN;
  const baum_i_shape shape = baum_i_shape_of(BAUM_I_GAP, form, place->element, place->body[1],
                                             place->body[0], 0.3 * g->drawing->unit);
  baum_i_draw(g->drawing, shape, form == BAUM_I_BETWEEN ? 2 : 3, (const double(*)[3])points);
}

/* Draws the gaps between the tips of a direction on body_a and the tips of the same direction on
 * body_b. */
static void draw_tips(const gaps *g, const double along_a[3], const double along_b[3])
{
  for (int sign = -1; sign <= 1; sign += 2) {
    double on_a[3] = {0.0}, on_b[3] = {0.0};
    baum_i_add_scaled3(sign * TIP * g->drawing->unit, along_a, on_a);
    baum_i_add_scaled3(sign * TIP * g->drawing->unit, along_b, on_b);
    draw_gap(g, on_a, on_b);
  }
}

/* Draws the gap between the tip of body_b's axis and the plane that is normal to body_a's axis. */
static void draw_angle(const gaps *g)
{
  const double zero[3] = {0.0, 0.0, 0.0};
  const gaps plane = {g->drawing, g->place, BAUM_I_GAP_PLANE};
  double tip[3] = {0.0};
  baum_i_add_scaled3(TIP * g->drawing->unit, g->place->axis[1], tip);
  draw_gap(&plane, zero, tip);
}

/* Draws gaps for a joint in which body_b slides on a plane of body_a. They connect this plane with
 * the tips of two directions on body_b that should be parallel to the plane. */
static void draw_tilt(const gaps *g)
{
  const double zero[3] = {0.0, 0.0, 0.0};
  double x[3], y[3];
  baum_i_complete_axes(g->place->axis[1], x, y);
  draw_tips(g, zero, x);
  draw_tips(g, zero, y);
}

/* Chooses a direction on body_a that is normal to the axis, and the direction on body_b that should
 * coincide with it. Draws gaps between the tips of these two directions. */
static void draw_turn(const gaps *g)
{
  double x[3], y[3], on_b[3];
  const double angle = baum_i_has_field(g->place->element, "angle")
                         ? baum_i_find_number(g->place->element, "angle")
                         : (double)NAN;
  baum_i_complete_axes(g->place->axis[0], x, y);
  baum_i_draw_turn(g->drawing, g->place->body[0], g->place->body[1], x, on_b);
  if (!isnan(angle)) { /* planar definitions may prescribe the relative orientation */
    on_b[0] = cos(angle) * x[0] + sin(angle) * x[1];
    on_b[1] = cos(angle) * x[1] - sin(angle) * x[0];
  }
  draw_tips(g, x, on_b);
}

void baum_i_draw_gap_to_line(baum_i_drawing *drawing, const baum_i_place *place, int count,
                             const double (*line)[3])
{
  double(*points)[3] = baum_i_alloc((size_t)count + 1, sizeof *points);
  if (!points) {
    drawing->failed = true;
    return;
  }
  memcpy(points[0], place->point[1], sizeof *points);
  memcpy(points[1], line, (size_t)count * sizeof *points);
  const baum_i_shape shape = baum_i_shape_of(BAUM_I_GAP, BAUM_I_TO_LINE, place->element,
                                             place->body[1], place->body[0], 0.3 * drawing->unit);
  baum_i_draw(drawing, shape, count + 1, (const double(*)[3])points);
  baum_i_free(points);
}

void baum_i_draw_gaps(baum_i_drawing *drawing, const baum_i_place *place, int conditions)
{
  const double zero[3] = {0.0, 0.0, 0.0};
  const gaps g = {drawing, place, place->element ? conditions : 0};
  bool given =
    !(g.what & BAUM_I_GAP_LENGTH) || !isnan(baum_i_find_number(place->element, "length"));
  if (g.what == 0 || !given) {
    return;
  }
  draw_gap(&g, zero, zero);
  if (g.what & BAUM_I_GAP_NORMAL) {
    draw_angle(&g);
  }
  if (g.what & BAUM_I_GAP_PARALLEL && g.what & BAUM_I_GAP_PLANE) {
    draw_tilt(&g);
  } else if (g.what & BAUM_I_GAP_PARALLEL) {
    draw_tips(&g, place->axis[0], place->axis[1]);
  }
  if (g.what & BAUM_I_GAP_TURN) {
    draw_turn(&g);
  }
}

/* ---- ends ---- */

/* Moves `to` to the nearest point of a line that is fixed on another body. */
static void find_nearest(const baum_i_spatial_frame *frame, const double (*line)[3], int count,
                         const double from[3], double to[3])
{
  double least = INFINITY, begin[3], end[3];
  baum_i_to_ground(frame, line[0], begin);
  for (int k = 1; k < count; k++) {
    double along[3], near[3];
    baum_i_to_ground(frame, line[k], end);
    for (int i = 0; i < 3; i++) {
      along[i] = end[i] - begin[i];
      near[i] = from[i] - begin[i];
    }
    double share = baum_i_dot3(near, along) / baum_i_dot3(along, along);
    baum_i_add_scaled3(-fmin(fmax(share, 0.0), 1.0), along, near);
    if (baum_i_dot3(near, near) < least) {
      least = baum_i_dot3(near, near);
      for (int i = 0; i < 3; i++) {
        to[i] = from[i] - near[i];
      }
    }
    memcpy(begin, end, sizeof end);
  }
}

static void find_on_plane(const baum_i_spatial_frame *frame, const double (*plane)[3],
                          const double from[3], double to[3])
{
  double point[3], normal[3];
  baum_i_to_ground(frame, plane[0], point);
  baum_i_turn(frame->axes, plane[1], normal);
  const double height = baum_i_dot3(normal, from) - baum_i_dot3(normal, point);
  baum_i_add_scaled3(-height, normal, to);
}

static void find_on_sphere(const baum_i_spatial_frame *frame, const double (*sphere)[3],
                           const double from[3], double to[3])
{
  double away[3];
  baum_i_to_ground(frame, sphere[0], to);
  for (int i = 0; i < 3; i++) {
    away[i] = from[i] - to[i];
  }
  const double distance = sqrt(baum_i_dot3(away, away));
  baum_i_add_scaled3(distance > 0.0 ? sphere[1][0] / distance : 0.0, away, to);
}

static void find_tip(const baum_i_spatial_frame *frame, const double vector[3], double length,
                     double to[3])
{
  double along[3];
  baum_i_turn(frame->axes, vector, along);
  baum_i_add_scaled3(length / sqrt(baum_i_dot3(along, along)), along, to);
}

void baum_i_find_ends(const baum_i_drawing *drawing, const baum_i_spatial_frame *frames,
                      const baum_i_shape *shape, double from[3], double to[3])
{
  const double(*points)[3] = (const double(*)[3])drawing->points + shape->first;
  const baum_i_spatial_frame *other = &frames[shape->other];
  baum_i_to_ground(&frames[shape->body], points[0], from);
  memcpy(to, from, 3 * sizeof *to);
  if (shape->form == BAUM_I_BETWEEN) {
    baum_i_to_ground(other, points[1], to);
  } else if (shape->form == BAUM_I_ARROW) {
    find_tip(other, points[1], 8.0 * drawing->unit, to);
  } else if (shape->form == BAUM_I_TO_LINE) {
    find_nearest(other, points + 1, shape->count - 1, from, to);
  } else if (shape->form == BAUM_I_TO_PLANE) {
    find_on_plane(other, points + 1, from, to);
  } else if (shape->form == BAUM_I_TO_SPHERE) {
    find_on_sphere(other, points + 1, from, to);
  }
}
