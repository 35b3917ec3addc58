/* SPDX-License-Identifier: BSD-3-Clause */
/* The definitions of every_element.c, for the table of kinds in every_element_kinds.c. */
#ifndef BAUM_TEST_EVERY_ELEMENT_GOOD_H
#define BAUM_TEST_EVERY_ELEMENT_GOOD_H

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

#endif
