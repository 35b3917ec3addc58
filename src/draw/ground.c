/* SPDX-License-Identifier: BSD-3-Clause */
/* Draws the ground at joints and springs. */
#include <string.h>

#include "draw/symbols.h"

/* Finds the direction of gravity. In the plane, only the planar part of gravity counts. */
static void find_down(const baum_i_drawing *drawing, double down[3])
{
  const double *g = drawing->mechanism->gravity;
  down[0] = g[0];
  down[1] = g[1];
  down[2] = drawing->spatial ? g[2] : 0.0;
  double size = sqrt(baum_i_dot3(down, down));
  for (int i = 0; i < 3; i++) {
    int usual = drawing->spatial ? 2 : 1;
    down[i] = size > 0.0 ? down[i] / size : i == usual ? -1.0 : 0.0;
  }
}

/* Finds the direction from a joint on the ground to the other body. It is the direction of the sum
 * of the vectors from the joint to the centre of mass and to all joints of this body. The direction
 * is zero if this sum is too short. */
static void find_link(const baum_i_symbol *s, int side, double link[3])
{
  const baum_i_drawing *drawing = s->drawing;
  const int body = s->place->body[1 - side];
  const double *joint = s->place->point[side];
  memcpy(link, drawing->design[body].r, 3 * sizeof *link);
  baum_i_add_scaled3(-1.0, joint, link);
  int count;
  const baum_i_place_end *ends = baum_i_ends_of(drawing, body, &count);
  for (int k = 0; k < count; k++) {
    double at[3];
    const baum_i_place *place = &drawing->places[ends[k].place];
    baum_i_to_ground(&drawing->design[body], place->point[ends[k].side], at);
    baum_i_add_scaled3(-1.0, joint, at);
    baum_i_add_scaled3(1.0, at, link);
  }
  double size = sqrt(baum_i_dot3(link, link));
  for (int i = 0; i < 3; i++) {
    link[i] = size > drawing->unit ? link[i] / size : 0.0;
  }
}

void baum_i_draw_hatch(const baum_i_symbol *s, int side, double half, double below,
                       const double along[3], const double across[3])
{
  enum { MOST = 40 };
  /* One line draws all hatches. After each hatch, the line returns to the edge. */
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
  baum_i_symbol_line(s, BAUM_I_GROUND, side, 0.0, count + 1, (const double(*)[2])xy, along, across);
}

/* Draws the edge of the ground, normal to the direction `up` in the plane. */
static void draw_edge(const baum_i_symbol *s, int side, double half, double below,
                      const double up[3])
{
  const double along[3] = {up[1], -up[0], 0.0};
  baum_i_draw_hatch(s, side, half, below, along, up);
}

/* Draws a leg and, at its end, a square with hatches. */
static void draw_plate(const baum_i_symbol *s, int side, const double up[3])
{
  static const double leg[2][2] = {{0.0, 0.0}, {-2.4, 0.0}};
  static const double plate[11][2] = {{-2.2, -2.2}, {2.2, -2.2}, {2.2, 2.2}, {-2.2, 2.2},
                                      {-2.2, -2.2}, {2.2, 2.2},  {2.2, 0.0}, {0.0, -2.2},
                                      {-2.2, -2.2}, {-2.2, 0.0}, {0.0, 2.2}};
  double x[3], y[3];
  baum_i_place below = *s->place;
  baum_i_symbol moved = *s;
  baum_i_complete_axes(up, x, y);
  baum_i_symbol_line(s, BAUM_I_GROUND, side, 0.4, 2, leg, up, up);
  baum_i_add_scaled3(-2.4 * s->drawing->unit, up, below.point[side]);
  moved.place = &below;
  baum_i_symbol_line(&moved, BAUM_I_GROUND, side, 0.0, 11, plate, x, y);
}

void baum_i_draw_foot(const baum_i_symbol *s)
{
  static const double foot[4][2] = {{0.0, 0.0}, {-1.5, -2.4}, {1.5, -2.4}, {0.0, 0.0}};
  /* A body hangs from a joint if the direction from the joint to the body is nearly that of
   * gravity: the cosine of the angle between them must be at least HANGS. */
  static const double HANGS = 0.7;
  double up[3], link[3];
  for (int side = 0; side < 2; side++) {
    if (s->place->body[side] != 0) {
      continue;
    }
    find_down(s->drawing, up);
    find_link(s, side, link);
    const double sign = baum_i_dot3(link, up) < HANGS ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++) {
      up[i] *= sign;
    }
    if (s->drawing->spatial) {
      draw_plate(s, side, up);
      continue;
    }
    const double along[3] = {up[1], -up[0], 0.0};
    baum_i_symbol_line(s, BAUM_I_GROUND, side, 0.0, 4, foot, along, up);
    draw_edge(s, side, 2.1, 2.4, up);
  }
}

void baum_i_draw_wall(const baum_i_symbol *s)
{
  double down[3], link[3];
  for (int side = 0; side < 2; side++) {
    if (s->place->body[side] == 0) {
      find_down(s->drawing, down);
      find_link(s, side, link);
      const double left[3] = {-down[1], down[0], 0.0};
      const double vertical = baum_i_dot3(link, down), level = baum_i_dot3(link, left);
      const bool is_level = fabs(level) > fabs(vertical);
      const double *nearest = is_level ? left : down;
      const double sign = (is_level ? level : vertical) > 0.0 ? 1.0 : -1.0;
      draw_edge(s, side, 3.0, 0.0, (const double[3]){sign * nearest[0], sign * nearest[1], 0.0});
    }
  }
}

void baum_i_draw_anchor(const baum_i_symbol *s, int side)
{
  const int other = s->place->body[1 - side];
  double to[3];
  if (s->place->body[side] != 0 || s->drawing->spatial) {
    return;
  }
  baum_i_to_ground(&s->drawing->design[other], s->place->point[1 - side], to);
  baum_i_add_scaled3(-1.0, s->place->point[side], to);
  double length = sqrt(baum_i_dot3(to, to));
  if (length > 0.0) {
    draw_edge(s, side, 2.1, 0.0, (const double[3]){to[0] / length, to[1] / length, 0.0});
  }
}

void baum_i_find_free_side(const baum_i_symbol *s, double up[3])
{
  /* A guide is considered vertical if the cosine of the angle between its normal and gravity is
   * below this. */
  static const double LEVEL = 0.2;
  const baum_i_drawing *drawing = s->drawing;
  const double *axis = s->place->axis[0];
  double down[3], middle[3] = {0.0};
  find_down(drawing, down);
  up[0] = -axis[1];
  up[1] = axis[0];
  up[2] = 0.0;
  for (int k = 1; k <= drawing->mechanism->body_count; k++) {
    baum_i_add_scaled3(1.0, drawing->design[k].r, middle);
    baum_i_add_scaled3(-1.0, s->place->point[0], middle);
  }
  double towards = -baum_i_dot3(up, down);
  towards = fabs(towards) > LEVEL ? towards : baum_i_dot3(up, middle);
  for (int i = 0; i < 2 && towards < 0.0; i++) {
    up[i] = -up[i];
  }
}
