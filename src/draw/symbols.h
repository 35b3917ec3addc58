/* SPDX-License-Identifier: BSD-3-Clause */
/* Symbols of joints and forces. Lengths are in drawing units, unless another unit is
 * given. */
#ifndef BAUM_I_DRAW_SYMBOLS_H
#define BAUM_I_DRAW_SYMBOLS_H

#include "draw/drawing.h"

/* The joint or force whose symbol is drawn. */
typedef struct baum_i_symbol {
  baum_i_drawing *drawing;
  int number;
  const baum_i_element *element;
  const baum_i_place *place; /* place->element is NULL if the element has no place */
} baum_i_symbol;

/* ---- symbols.c ---- */

void baum_i_symbol_shape(const baum_i_symbol *s, baum_i_style style, baum_i_form form, int body,
                         double radius, int count, const double (*points)[3]);

/* Connect the point of the place `from` on its body number `side` (0 or 1) with the point of the
 * place `to` on body_b. Springs and dampers are shifted to the left by `shift`. */
void baum_i_symbol_between(const baum_i_symbol *s, baum_i_style style, const baum_i_place *from,
                           int side, const baum_i_place *to, double radius, double shift);

/* Draw a line or an area. Each row of xy gives a corner: its distances from the point of the place
 * in the directions `along` and `across`, in drawing units. */
void baum_i_symbol_line(const baum_i_symbol *s, baum_i_style style, int side, double radius,
                        int count, const double (*xy)[2], const double along[3],
                        const double across[3]);
void baum_i_symbol_area(const baum_i_symbol *s, baum_i_style style, int side, int count,
                        const double (*xy)[2], const double along[3], const double across[3]);

/* Draw a straight line along the axis of the place, from -reach to reach. */
void baum_i_symbol_axis(const baum_i_symbol *s, baum_i_style style, int side, double radius,
                        double reach);
void baum_i_symbol_point(const baum_i_symbol *s, baum_i_style style, int side, double radius);

/* Return a copy of the place of the symbol, with its point on body_a moved `by` units in the
 * direction `along`. */
baum_i_place baum_i_move_place(const baum_i_symbol *s, double by, const double along[3]);

/* Return the place of a joint, or NULL if the joint has no place. */
const baum_i_place *baum_i_place_of(const baum_i_symbol *s, baum_joint_id id);

/* ---- ground.c ---- */

/* Draw the edge of the ground with hatches below it. */
void baum_i_draw_hatch(const baum_i_symbol *s, int side, double half, double below,
                       const double along[3], const double across[3]);

/* Draw the foot of a joint on the ground. The foot is below the joint in the direction of gravity,
 * or above the joint if the other body hangs from it. */
void baum_i_draw_foot(const baum_i_symbol *s);

/* Draw the wall to which a body is fixed. The wall is on the side that faces away from the body. */
void baum_i_draw_wall(const baum_i_symbol *s);

/* Draw the ground at one end of a planar spring, on the side that faces away from the other end. */
void baum_i_draw_anchor(const baum_i_symbol *s, int side);

/* Find the direction from a planar guide on the ground to its free side. This is the upper side. If
 * the guide is vertical, the free side is the side on which the mechanism is. */
void baum_i_find_free_side(const baum_i_symbol *s, double up[3]);

/* ---- one function for each kind: pins.c, guides.c, loads.c ---- */

void baum_i_draw_pin(const baum_i_symbol *s);
void baum_i_draw_rod(const baum_i_symbol *s);
void baum_i_draw_weld(const baum_i_symbol *s);
void baum_i_draw_gear(const baum_i_symbol *s);
void baum_i_draw_ball(const baum_i_symbol *s);
void baum_i_draw_hinge(const baum_i_symbol *s);
void baum_i_draw_cross(const baum_i_symbol *s);
void baum_i_draw_plane(const baum_i_symbol *s);
void baum_i_draw_plane_point(const baum_i_symbol *s);
void baum_i_draw_clamp(const baum_i_symbol *s);
void baum_i_draw_rolling_disc(const baum_i_symbol *s);
void baum_i_draw_skate(const baum_i_symbol *s);

void baum_i_draw_guide(const baum_i_symbol *s);
void baum_i_draw_slot(const baum_i_symbol *s);
void baum_i_draw_rack(const baum_i_symbol *s);
void baum_i_draw_curve(const baum_i_symbol *s);
void baum_i_draw_blade(const baum_i_symbol *s);
void baum_i_draw_cylinder(const baum_i_symbol *s);
void baum_i_draw_slide(const baum_i_symbol *s);
void baum_i_draw_point_on_line(const baum_i_symbol *s);
/* Draw an arrow beside a guide. */
void baum_i_draw_guide_arrow(const baum_i_symbol *s, baum_i_style style);

void baum_i_draw_spring(const baum_i_symbol *s);
void baum_i_draw_cable(const baum_i_symbol *s);
void baum_i_draw_torsion(const baum_i_symbol *s);
void baum_i_draw_spatial_torsion(const baum_i_symbol *s);
void baum_i_draw_bushing(const baum_i_symbol *s);
void baum_i_draw_planar_load(const baum_i_symbol *s);
void baum_i_draw_spatial_load(const baum_i_symbol *s);
void baum_i_draw_coupling(const baum_i_symbol *s);
void baum_i_draw_joint_spring(const baum_i_symbol *s);
void baum_i_draw_joint_load(const baum_i_symbol *s);
void baum_i_draw_driver(const baum_i_symbol *s);
void baum_i_draw_user(const baum_i_symbol *s);

#endif
