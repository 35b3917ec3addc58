/* SPDX-License-Identifier: BSD-3-Clause */
/* The definitions of every_element.c. The table of kinds in every_element_kinds.c uses them. */
#ifndef BAUM_TEST_EVERY_ELEMENT_GOOD_H
#define BAUM_TEST_EVERY_ELEMENT_GOOD_H

#include <string.h>

#include "every_element.h"

void good_planar_body(const every_element *parts, any_def *to);
void good_planar_particle(const every_element *parts, any_def *to);
void good_coordinates(const every_element *parts, any_def *to);
void good_planar_revolute(const every_element *parts, any_def *to);
void good_planar_distance(const every_element *parts, any_def *to);
void good_planar_translational(const every_element *parts, any_def *to);
void good_planar_fixed(const every_element *parts, any_def *to);
void good_driver(const every_element *parts, any_def *to);
void good_user_constraint(const every_element *parts, any_def *to);
void good_planar_spring(const every_element *parts, any_def *to);
void good_planar_load(const every_element *parts, any_def *to);
void good_user_force(const every_element *parts, any_def *to);
void good_planar_torsion_spring(const every_element *parts, any_def *to);
void good_planar_pin_in_slot(const every_element *parts, any_def *to);
void good_planar_rack_and_pinion(const every_element *parts, any_def *to);
void good_planar_gear(const every_element *parts, any_def *to);
void good_coupling(const every_element *parts, any_def *to);
void good_planar_curve(const every_element *parts, any_def *to);
void good_spline_driver(const every_element *parts, any_def *to);
void good_spatial_body(const every_element *parts, any_def *to);
void good_spatial_particle(const every_element *parts, any_def *to);
void good_spatial_spherical(const every_element *parts, any_def *to);
void good_spatial_revolute(const every_element *parts, any_def *to);
void good_spatial_universal(const every_element *parts, any_def *to);
void good_spatial_cylindrical(const every_element *parts, any_def *to);
void good_spatial_prismatic(const every_element *parts, any_def *to);
void good_spatial_planar(const every_element *parts, any_def *to);
void good_spatial_fixed(const every_element *parts, any_def *to);
void good_spatial_distance(const every_element *parts, any_def *to);
void good_spatial_point_on_line(const every_element *parts, any_def *to);
void good_spatial_point_on_plane(const every_element *parts, any_def *to);
void good_spatial_spring(const every_element *parts, any_def *to);
void good_spatial_load(const every_element *parts, any_def *to);
void good_spatial_screw(const every_element *parts, any_def *to);
void good_spatial_constant_velocity(const every_element *parts, any_def *to);
void good_spatial_torsion_spring(const every_element *parts, any_def *to);
void good_spatial_bushing(const every_element *parts, any_def *to);
void good_joint_spring(const every_element *parts, any_def *to);
void good_joint_load(const every_element *parts, any_def *to);
void good_planar_knife_edge(const every_element *parts, any_def *to);
void good_spatial_rolling_disc(const every_element *parts, any_def *to);
void good_spatial_curve(const every_element *parts, any_def *to);
void good_spatial_knife_edge(const every_element *parts, any_def *to);
void good_spatial_cable(const every_element *parts, any_def *to);

/* The table of kinds has one spatial body and one spatial particle. These functions add the further
 * spatial bodies that the elements need. They are in every_element_spatial.c. */
baum_status every_element_add_spatial_bodies(every_element *parts);
baum_status every_element_add_coin(every_element *parts);
baum_status every_element_add_nut(every_element *parts);
baum_status every_element_add_skate(every_element *parts);

/* Counts a call of a user function. `user` points to an every_fault, or is NULL. If the call has to
 * fail, the function writes NaN into `out`, or returns the member `answer` of the every_fault. */
int every_element_answer(void *user, double t, double *out);

/* Defines good_NAME(). Usage: GOOD(name) { return the definition, made with `parts`; } */
#define GOOD(NAME)                                                 \
  static baum_##NAME##_def NAME##_def(const every_element *parts); \
  void good_##NAME(const every_element *parts, any_def *to)        \
  {                                                                \
    baum_##NAME##_def def = NAME##_def(parts);                     \
    memset(to, 0, sizeof *to);                                     \
    memcpy(to, &def, sizeof def);                                  \
  }                                                                \
  static baum_##NAME##_def NAME##_def(const every_element *parts)

#endif
