/* SPDX-License-Identifier: BSD-3-Clause */
/* Finds the centres and pitch circles of gear wheels and pinions. */
#include <string.h>

#include <baum/planar_joints.h>

#include "draw/drawing.h"
#include "mechanism/identify.h"
#include "mechanism/kinds.h"

/* In drawing units: the height of teeth above the pitch circle, and the width of an internal
 * gear outside its pitch circle. */
static const double TOOTH = 0.6, RING = 1.8;

/* Finds the centre of a wheel. It is the point of the first revolute joint of the body, or the
 * centre of mass if the body has no revolute joint. */
static void find_centre(const baum_i_drawing *drawing, int body, double centre[3])
{
  centre[0] = centre[1] = centre[2] = 0.0;
  int count;
  const baum_i_place_end *ends = baum_i_ends_of(drawing, body, &count);
  for (int k = 0; k < count; k++) {
    const baum_i_place *place = &drawing->places[ends[k].place];
    if (place->element->definition == baum_i_planar_revolute_definition) {
      centre[0] = place->point[ends[k].side][0];
      centre[1] = place->point[ends[k].side][1];
      return;
    }
  }
}

/* Users may give numbers of teeth as the radii of a gear. The radii are therefore scaled so that
 * the pitch circles touch. */
double baum_i_gear_radius(const baum_i_drawing *drawing, const baum_i_joint *joint, int body,
                          double centre[3])
{
  const baum_planar_gear_def *def = joint->element.def;
  int a = baum_i_body_index(drawing->mechanism, def->body_a);
  int b = baum_i_body_index(drawing->mechanism, def->body_b);
  if (body != a && body != b) {
    return 0.0;
  }
  double at_a[3], at_b[3];
  find_centre(drawing, a, at_a);
  find_centre(drawing, b, at_b);
  memcpy(centre, body == a ? at_a : at_b, sizeof at_a);
  baum_i_draw_move(drawing, a, 0, (const double[3]){at_a[0], at_a[1], 0.0}, at_a);
  baum_i_draw_move(drawing, b, 0, (const double[3]){at_b[0], at_b[1], 0.0}, at_b);
  double between = hypot(at_b[0] - at_a[0], at_b[1] - at_a[1]);
  double sum = fabs(def->radius_a + def->radius_b);
  double radius = fabs(body == a ? def->radius_a : def->radius_b);
  return sum > 0.0 ? radius * between / sum : 0.0;
}

double baum_i_wheel_radius(const baum_i_drawing *drawing, int body, double centre[3])
{
  for (int k = 0; k < drawing->gear_count; k++) {
    const baum_i_joint *joint = drawing->mechanism->joints[drawing->gears[k]];
    const baum_planar_gear_def *def = joint->element.def;
    const double radius = baum_i_gear_radius(drawing, joint, body, centre);
    const bool is_a = baum_i_body_index(drawing->mechanism, def->body_a) == body;
    const bool is_ring = (is_a ? def->radius_a : def->radius_b) < 0.0;
    if (radius > 0.0) {
      return radius + (is_ring ? RING : TOOTH) * drawing->unit;
    }
  }
  int count;
  const baum_i_place_end *ends = baum_i_ends_of(drawing, body, &count);
  for (int k = 0; k < count; k++) {
    const baum_i_place *place = &drawing->places[ends[k].place];
    if (ends[k].side == 1 &&
        place->element->definition == baum_i_planar_rack_and_pinion_definition) {
      memcpy(centre, place->point[1], 3 * sizeof *centre);
      return fabs(baum_i_find_number(place->element, "radius")) + TOOTH * drawing->unit;
    }
  }
  return 0.0;
}
