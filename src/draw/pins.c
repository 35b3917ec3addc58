/* SPDX-License-Identifier: BSD-3-Clause */
/* Symbols of joints whose bodies meet at a point or in a plane. */
#include <math.h>

#include <baum/planar_joints.h>
#include <baum/spatial_points.h>

#include "draw/symbols.h"
#include "mechanism/identify.h"

static const double X[3] = {1.0, 0.0, 0.0}, Y[3] = {0.0, 1.0, 0.0};

void baum_i_draw_pin(const baum_i_symbol *s)
{
  baum_i_draw_foot(s);
  baum_i_symbol_point(s, BAUM_I_JOINT, 1, 0.5);
}

void baum_i_draw_rod(const baum_i_symbol *s)
{
  baum_i_draw_foot(s);
  baum_i_symbol_between(s, BAUM_I_ROD, s->place, 0, s->place, 0.35, 0.0);
  baum_i_symbol_point(s, BAUM_I_JOINT, 0, 0.4);
  baum_i_symbol_point(s, BAUM_I_JOINT, 1, 0.4);
}

static const double SQUARE[4][2] = {{-0.8, -0.8}, {0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}};

void baum_i_draw_weld(const baum_i_symbol *s)
{
  baum_i_draw_wall(s);
  baum_i_symbol_area(s, BAUM_I_JOINT, 1, 4, SQUARE, X, Y);
}

void baum_i_draw_gear(const baum_i_symbol *s)
{
  const baum_planar_gear_def *def = s->element->def;
  const baum_body_id ids[2] = {def->body_a, def->body_b};
  for (int k = 0; k < 2; k++) {
    double disc[2][3] = {{0.0}, {0.0, 0.0, 1.0}};
    int body = baum_i_body_index(s->drawing->mechanism, ids[k]);
    double radius =
      baum_i_gear_radius(s->drawing, s->drawing->mechanism->joints[s->number], body, disc[0]);
    if (radius > 0.0) {
      baum_i_symbol_shape(s, BAUM_I_PITCH, BAUM_I_DISC, body, radius / s->drawing->unit, 2,
                          (const double(*)[3])disc);
    }
  }
}

/* ---- space ---- */

void baum_i_draw_ball(const baum_i_symbol *s)
{
  baum_i_draw_foot(s);
  baum_i_symbol_point(s, BAUM_I_JOINT, s->place->body[0] == 0 ? 0 : 1, 1.2);
}

/* Draws the axis of each body. The two axes coincide if the constraints of the joint are
 * satisfied. */
static void draw_axes(const baum_i_symbol *s, double reach)
{
  baum_i_symbol_axis(s, BAUM_I_PITCH, 0, 0.0, reach);
  baum_i_symbol_axis(s, BAUM_I_PITCH, 1, 0.0, reach);
}

void baum_i_draw_hinge(const baum_i_symbol *s)
{
  baum_i_draw_foot(s);
  draw_axes(s, 4.0);
  baum_i_symbol_axis(s, BAUM_I_JOINT, 0, 1.0, 1.5);
  baum_i_symbol_axis(s, BAUM_I_JOINT, 1, 0.45, 2.4);
}

void baum_i_draw_cross(const baum_i_symbol *s)
{
  baum_i_draw_foot(s);
  draw_axes(s, 4.0);
  baum_i_symbol_axis(s, BAUM_I_JOINT, 0, 0.55, 2.4);
  baum_i_symbol_axis(s, BAUM_I_JOINT, 1, 0.55, 2.4);
}

static void draw_square(const baum_i_symbol *s, int side, double half)
{
  const double square[5][2] = {
    {-half, -half}, {half, -half}, {half, half}, {-half, half}, {-half, -half}};
  double x[3], y[3];
  baum_i_complete_axes(s->place->axis[side], x, y);
  if (side == 0) {
    baum_i_symbol_line(s, BAUM_I_GUIDE, side, 0.2, 5, square, x, y);
  } else {
    baum_i_symbol_area(s, BAUM_I_JOINT, side, 4, square, x, y);
  }
}

/* Draws a pad that slides on a plane. */
void baum_i_draw_plane(const baum_i_symbol *s)
{
  draw_square(s, 0, 8.0);
  draw_square(s, 1, 2.5);
}

void baum_i_draw_plane_point(const baum_i_symbol *s)
{
  draw_square(s, 0, 8.0);
  baum_i_symbol_point(s, BAUM_I_JOINT, 1, 0.9);
}

/* Draws a cube. */
void baum_i_draw_clamp(const baum_i_symbol *s)
{
  const double *at = s->place->point[1];
  const double half = 1.1 * s->drawing->unit;
  const double box[2][3] = {{at[0], at[1], at[2]}, {half, half, half}};
  baum_i_draw_foot(s);
  baum_i_symbol_shape(s, BAUM_I_JOINT, BAUM_I_BOX, s->place->body[1], 0.0, 2, box);
}

/* Draws the largest circle and the axis of the disc. */
void baum_i_draw_rolling_disc(const baum_i_symbol *s)
{
  const baum_spatial_rolling_disc_def *def = s->element->def;
  const int body = baum_i_body_index(s->drawing->mechanism, def->body_b);
  double disc[2][3], axle[2][3];
  const double half = s->drawing->unit / sqrt(baum_i_dot3(def->axis_b, def->axis_b));
  for (int i = 0; i < 3; i++) {
    disc[0][i] = def->centre[i];
    disc[1][i] = def->axis_b[i];
    axle[0][i] = def->centre[i] - half * def->axis_b[i];
    axle[1][i] = def->centre[i] + half * def->axis_b[i];
  }
  baum_i_symbol_shape(s, BAUM_I_PITCH, BAUM_I_DISC, body, def->radius / s->drawing->unit, 2,
                      (const double(*)[3])disc);
  baum_i_symbol_shape(s, BAUM_I_JOINT, BAUM_I_LINE, body, 0.4, 2, (const double(*)[3])axle);
}

/* Draws a thin disc that is perpendicular to the axis. It stands for a blade or a wheel. */
void baum_i_draw_skate(const baum_i_symbol *s)
{
  const double *at = s->place->point[0], *axis = s->place->axis[0];
  const double disc[2][3] = {{at[0], at[1], at[2]}, {axis[0], axis[1], axis[2]}};
  baum_i_symbol_shape(s, BAUM_I_PITCH, BAUM_I_DISC, s->place->body[0], 2.5, 2, disc);
  baum_i_symbol_axis(s, BAUM_I_JOINT, 0, 0.4, 0.8);
}
