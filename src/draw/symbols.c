/* SPDX-License-Identifier: BSD-3-Clause */
/* Draws joints and forces with the usual symbols of engineering. The table at the end has a line
 * for each kind of joint and force. */
#include "draw/symbols.h"

#include <string.h>

#include "mechanism/identify.h"
#include "mechanism/kinds.h"

void baum_i_symbol_shape(const baum_i_symbol *s, baum_i_style style, baum_i_form form, int body,
                         double radius, int count, const double (*points)[3])
{
  const double size = radius * s->drawing->unit;
  baum_i_draw(s->drawing, baum_i_shape_of(style, form, s->element, body, body, size), count,
              points);
}

void baum_i_symbol_between(const baum_i_symbol *s, baum_i_style style, const baum_i_place *from,
                           int side, const baum_i_place *to, double radius, double shift)
{
  const double *a = from->point[side];
  const double *b = to->point[1];
  const double points[3][3] = {
    {a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {0.0, shift * s->drawing->unit, 0.0}};
  const baum_i_shape shape = baum_i_shape_of(style, BAUM_I_BETWEEN, s->element, from->body[side],
                                             to->body[1], radius * s->drawing->unit);
  baum_i_draw(s->drawing, shape, shift == 0.0 ? 2 : 3, points);
}

static void draw_path(const baum_i_symbol *s, const baum_i_shape *shape, int side, int count,
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
  baum_i_symbol_shape(s, shape->style, shape->form, s->place->body[side], shape->radius, count,
                      (const double(*)[3])points);
}

void baum_i_symbol_line(const baum_i_symbol *s, baum_i_style style, int side, double radius,
                        int count, const double (*xy)[2], const double along[3],
                        const double across[3])
{
  const baum_i_shape shape = {.style = style, .form = BAUM_I_LINE, .radius = radius};
  draw_path(s, &shape, side, count, xy, along, across);
}

void baum_i_symbol_area(const baum_i_symbol *s, baum_i_style style, int side, int count,
                        const double (*xy)[2], const double along[3], const double across[3])
{
  const baum_i_shape shape = {.style = style, .form = BAUM_I_AREA};
  draw_path(s, &shape, side, count, xy, along, across);
}

void baum_i_symbol_axis(const baum_i_symbol *s, baum_i_style style, int side, double radius,
                        double reach)
{
  const double xy[2][2] = {{-reach, 0.0}, {reach, 0.0}};
  baum_i_symbol_line(s, style, side, radius, 2, xy, s->place->axis[side], s->place->axis[side]);
}

void baum_i_symbol_point(const baum_i_symbol *s, baum_i_style style, int side, double radius)
{
  const double *at = s->place->point[side];
  const double points[2][3] = {{at[0], at[1], at[2]}, {0.0, 0.0, 1.0}};
  bool ball = s->drawing->spatial;
  baum_i_symbol_shape(s, style, ball ? BAUM_I_BALL : BAUM_I_DISC, s->place->body[side], radius,
                      ball ? 1 : 2, points);
}

baum_i_place baum_i_move_place(const baum_i_symbol *s, double by, const double along[3])
{
  baum_i_place moved = *s->place;
  baum_i_add_scaled3(by * s->drawing->unit, along, moved.point[0]);
  return moved;
}

const baum_i_place *baum_i_place_of(const baum_i_symbol *s, baum_joint_id id)
{
  const baum_i_place *place = &s->drawing->places[baum_i_joint_index(s->drawing->mechanism, id)];
  return place->element ? place : NULL;
}

/* ---- the table of kinds ---- */

typedef struct kind {
  const baum_i_definition *const *definition;
  void (*draw)(const baum_i_symbol *s);
  int conditions; /* sum of the conditions whose violation is drawn; see baum_i_draw_gaps() */
} kind;

static const kind KINDS[] = {
  {&baum_i_planar_revolute_definition, baum_i_draw_pin, BAUM_I_GAP_POINTS},
  {&baum_i_planar_distance_definition, baum_i_draw_rod, BAUM_I_GAP_LENGTH},
  {&baum_i_planar_translational_definition, baum_i_draw_guide,
   BAUM_I_GAP_LINE | BAUM_I_GAP_PARALLEL},
  {&baum_i_planar_fixed_definition, baum_i_draw_weld, BAUM_I_GAP_POINTS | BAUM_I_GAP_TURN},
  {&baum_i_planar_pin_in_slot_definition, baum_i_draw_slot, BAUM_I_GAP_LINE},
  {&baum_i_planar_rack_and_pinion_definition, baum_i_draw_rack, 0},
  {&baum_i_planar_gear_definition, baum_i_draw_gear, 0},
  {&baum_i_planar_curve_definition, baum_i_draw_curve, 0},
  {&baum_i_planar_knife_edge_definition, baum_i_draw_blade, 0},
  {&baum_i_spatial_spherical_definition, baum_i_draw_ball, BAUM_I_GAP_POINTS},
  {&baum_i_spatial_revolute_definition, baum_i_draw_hinge, BAUM_I_GAP_POINTS | BAUM_I_GAP_PARALLEL},
  {&baum_i_spatial_universal_definition, baum_i_draw_cross, BAUM_I_GAP_POINTS | BAUM_I_GAP_NORMAL},
  {&baum_i_spatial_cylindrical_definition, baum_i_draw_cylinder,
   BAUM_I_GAP_LINE | BAUM_I_GAP_PARALLEL},
  {&baum_i_spatial_prismatic_definition, baum_i_draw_slide,
   BAUM_I_GAP_LINE | BAUM_I_GAP_PARALLEL | BAUM_I_GAP_TURN},
  {&baum_i_spatial_planar_definition, baum_i_draw_plane, BAUM_I_GAP_PLANE | BAUM_I_GAP_PARALLEL},
  {&baum_i_spatial_fixed_definition, baum_i_draw_clamp,
   BAUM_I_GAP_POINTS | BAUM_I_GAP_PARALLEL | BAUM_I_GAP_TURN},
  {&baum_i_spatial_distance_definition, baum_i_draw_rod, BAUM_I_GAP_LENGTH},
  {&baum_i_spatial_point_on_line_definition, baum_i_draw_point_on_line, BAUM_I_GAP_LINE},
  {&baum_i_spatial_point_on_plane_definition, baum_i_draw_plane_point, BAUM_I_GAP_PLANE},
  {&baum_i_spatial_curve_definition, baum_i_draw_curve, 0},
  {&baum_i_spatial_rolling_disc_definition, baum_i_draw_rolling_disc, 0},
  {&baum_i_spatial_knife_edge_definition, baum_i_draw_skate, 0},
  {&baum_i_spatial_screw_definition, baum_i_draw_cylinder, BAUM_I_GAP_LINE | BAUM_I_GAP_PARALLEL},
  {&baum_i_spatial_constant_velocity_definition, baum_i_draw_ball, BAUM_I_GAP_POINTS},
  {&baum_i_coupling_definition, baum_i_draw_coupling, 0},
  {&baum_i_driver_definition, baum_i_draw_driver, 0},
  {&baum_i_spline_driver_definition, baum_i_draw_driver, 0},
  {&baum_i_user_constraint_definition, baum_i_draw_user, 0},
  {&baum_i_planar_spring_definition, baum_i_draw_spring, 0},
  {&baum_i_planar_torsion_spring_definition, baum_i_draw_torsion, 0},
  {&baum_i_planar_load_definition, baum_i_draw_planar_load, 0},
  {&baum_i_spatial_spring_definition, baum_i_draw_spring, 0},
  {&baum_i_spatial_cable_definition, baum_i_draw_cable, 0},
  {&baum_i_spatial_load_definition, baum_i_draw_spatial_load, 0},
  {&baum_i_spatial_torsion_spring_definition, baum_i_draw_spatial_torsion, 0},
  {&baum_i_spatial_bushing_definition, baum_i_draw_bushing, 0},
  {&baum_i_joint_spring_definition, baum_i_draw_joint_spring, 0},
  {&baum_i_joint_load_definition, baum_i_draw_joint_load, 0},
  {&baum_i_user_force_definition, baum_i_draw_user, 0},
};

void baum_i_draw_symbol(baum_i_drawing *drawing, int number)
{
  const baum_mechanism *m = drawing->mechanism;
  const baum_i_element *element = number < m->joint_count
                                    ? &m->joints[number]->element
                                    : &m->forces[number - m->joint_count]->element;
  const baum_i_symbol s = {drawing, number, element, &drawing->places[number]};
  for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k++) {
    if (*KINDS[k].definition == element->definition) {
      KINDS[k].draw(&s);
      baum_i_draw_gaps(drawing, s.place, KINDS[k].conditions);
    }
  }
}
