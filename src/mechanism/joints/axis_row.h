/* SPDX-License-Identifier: BSD-3-Clause */
/* Distance of body_b's marker from body_a's along a direction fixed in body_a: the first row of the
 * translational joint, with the normal of its axis, and its coordinate, with the axis itself.
 */
#ifndef BAUM_I_MECHANISM_JOINTS_AXIS_ROW_H
#define BAUM_I_MECHANISM_JOINTS_AXIS_ROW_H

#include "mechanism/joints/planar_rows.h"

/* direction: unit vector in the axes of body_a. */
double baum_i_axis_value(const baum_i_planar_pair *pair, const double direction[2]);

void baum_i_axis_gradient(const baum_i_planar_pair *pair, const double direction[2],
                          double gradient[6]);

/* So that gradient . a = value'' + gamma. */
double baum_i_axis_gamma(const baum_i_planar_pair *pair, const double direction[2]);

/* Sets every entry. */
void baum_i_axis_linearize(const baum_i_planar_pair *pair, const double direction[2],
                           const double w[6], double lambda, baum_i_coordinate_blocks *out);

#endif
